/* test_format.c: every row of the tables of doc/scene-format.md and doc/pbrt-differences.md is true.
 *
 * Rows of types. The last cell of such a row lists parameters and the one before it types, each between backticks.
 * Every type that the parser knows must have a row, with its parameters and no others, and these are tried out
 * (format_values.c).
 * All other rows. A scene must show what the row says: one of test/data/fixtures/scenes.txt, which the suite `parser`
 * loads, or of scenes/features, which the suite `features` renders; or test/run/cli.sh, if it is no scene's affair. A
 * comment there, "# row: ", names the row by its first cell that is not empty. If the row speaks of a warning, or of
 * an error, a scene must cause one.
 */
#define _POSIX_C_SOURCE 200809L

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "fuzz/lists.h"
#include "parser/parse.h"
#include "parser/scene_files.h"
#include "parser_parts.h"
#include "suites.h"

enum { MOST_ROWS = 200, ROW = 2000 };

/* A row of a table. */
struct row {
    char text[ROW];      /* as it is, without the outer bars */
    char key[120];       /* its first cell that is not empty */
    char section[60];    /* the heading above it */
    bool is_tried;       /* it is of types, and its parameters have been tried */
    int scenes, warned, refused; /* that show it; those of them with such messages */
};

struct page {
    const char *path;
    bool differs; /* its tables have columns for pbrt-v3 and for this program */
    struct row row[MOST_ROWS];
    int n;
};

/* --- rows ----------------------------------------------------------------------------------------------- */

/* A copy of [n] characters without blanks at its ends. */
static void trimmed(char *out, size_t size, const char *text, size_t n)
{
    while (n > 0 && *text == ' ')
        text++, n--;
    while (n > 0 && text[n - 1] == ' ')
        n--;
    snprintf(out, size, "%.*s", (int)n, text);
}

static void add_row(struct page *p, const char *section, const char *line, size_t n)
{
    struct row *r = &p->row[p->n];
    p->n += p->n + 1 < MOST_ROWS;
    trimmed(r->text, sizeof r->text, line + 1, n - 2);
    snprintf(r->section, sizeof r->section, "%.*s", (int)strcspn(section, "\n"), section);
    for (const char *cell = line + 1; r->key[0] == '\0' && cell < line + n; cell += strcspn(cell, "|") + 1)
        trimmed(r->key, sizeof r->key, cell, strcspn(cell, "|"));
}

/* All rows but those of headings, which a row of dashes follows. */
static struct page *read_page(struct test *t, const char *path)
{
    struct page *p = mem_alloc(1, sizeof *p);
    struct error err;
    size_t size;
    char *text = text_read(path, &size, &err);
    const char *section = "";
    p->path = path;
    CHECK(t, text != NULL, "run the tests at the top of the tree");
    for (const char *line = text, *next; line != NULL; line = next) {
        next = strchr(line, '\n') != NULL ? strchr(line, '\n') + 1 : NULL;
        bool dashes = strncmp(line, "|---", 4) == 0, heading = next != NULL && strncmp(next, "|---", 4) == 0;
        if (strncmp(line, "## ", 3) == 0)
            section = line + 3;
        if (line[0] == '|' && !dashes && !heading)
            add_row(p, section, line, strcspn(line, "\n"));
    }
    free(text);
    return p;
}

/* --- rows of types --------------------------------------------------------------------------------------- */

/* Does a text hold this word between backticks? */
static bool holds(const char *text, const char *word)
{
    char quoted[64];
    snprintf(quoted, sizeof quoted, "`%s`", word);
    return strstr(text, quoted) != NULL;
}

/* The last two cells of a row. False if there are less. */
static bool last_cells(const struct row *r, char types[ROW], char list[ROW])
{
    const char *last = strrchr(r->text, '|');
    if (last == NULL)
        return false;
    snprintf(types, ROW, "%.*s", (int)(last - r->text), r->text);
    snprintf(list, ROW, "%s", last + 1);
    const char *first = strrchr(types, '|');
    if (first != NULL)
        memmove(types, first + 1, strlen(first));
    return true;
}

/* Has one of these types of a table a parameter of this name? */
static bool has_parameter(const struct object_type *type, const char *types, const char *name)
{
    for (; type->name != NULL; type++)
        if (holds(types, type->name) && field_find(type->fields, name) != NULL)
            return true;
    return false;
}

/* The list has all that the type has, and nothing that none of the row's types has. */
static void check_names(struct test *t, const struct object_type *table, const struct object_type *type,
                        const char *types, const char *list)
{
    char name[64];
    for (const struct field *f = type->fields; f->name != NULL; f++)
        CHECK(t, holds(list, f->name), "`%s`: the page does not list `%s`", type->name, f->name);
    int depth = 0, used;
    for (const char *p = list; *p != '\0'; p++) {
        depth += *p == '(' ? 1 : *p == ')' ? -1 : 0;
        if (*p != '`' || sscanf(p, "`%63[^`]`%n", name, &used) != 1)
            continue;
        p += used - 1;
        CHECK(t, depth > 0 || has_parameter(table, types, name), "`%s`: the page lists `%s`, which is not read",
              type->name, name);
    }
}

/* The parameters of textures that have a mapping are those of the list and all of the table of mappings. */
static void add_mappings(const struct page *p, char list[ROW])
{
    for (const struct row *r = p->row; strstr(list, "mapping") != NULL && r < p->row + p->n; r++)
        if (strcmp(r->section, "Textures") == 0 && strncmp(r->key, "`constant`", 10) != 0 &&
            strstr(r->text, "`udelta`") != NULL)
            strncat(list, strrchr(r->text, '|'), ROW - strlen(list) - 1);
    if (strstr(list, "mapping") != NULL)
        strncat(list, " `mapping`", ROW - strlen(list) - 1);
}

static void check_types(struct test *t, struct page *page, const char *section, const struct object_type *table,
                        struct type_text text)
{
    char types[ROW], list[ROW];
    const struct type_text start = text;
    for (const struct object_type *type = table; type->name != NULL; type++) {
        struct row *r = page->row;
        while (r < page->row + page->n && (strcmp(r->section, section) != 0 || !last_cells(r, types, list) ||
                                           !holds(types, type->name)))
            r++;
        if (!CHECK(t, r < page->row + page->n, "the page has no row for `%s`", type->name))
            continue;
        bool colour = table == TEXTURE_TYPES && strstr(list, "Colours only") != NULL;
        snprintf(text.directive, sizeof text.directive, "%.60s \"%.30s\"", colour ? "Texture \"t\" \"spectrum\""
                 : start.directive, type->name);
        text.fields = type->fields;
        check_format_values(t, &text, list);
        add_mappings(page, list);
        check_names(t, table, type, types, list);
        r->is_tried = true;
    }
}

/* What a mapping reads, by a texture that has one. */
static void check_mappings(struct test *t, struct page *page, struct type_text text)
{
    const struct object_type *type = TEXTURE_TYPES;
    while (strcmp(type->name, "uv") != 0)
        type++;
    text.fields = type->fields;
    static const char *const MAPPINGS[] = {"`uv`", "`planar`", "`spherical`", "`cylindrical`"};
    for (struct row *r = page->row; r < page->row + page->n; r++)
        for (int i = 0; i < 4; i++)
            if (strcmp(r->section, "Textures") == 0 && strcmp(r->key, MAPPINGS[i]) == 0 && !r->is_tried) {
                snprintf(text.directive, sizeof text.directive, "Texture \"t\" \"spectrum\" \"uv\" \"string mapping\" "
                         "\"%.*s\"", (int)strlen(r->key) - 2, r->key + 1);
                check_format_values(t, &text, strrchr(r->text, '|') + 1);
                r->is_tried = true;
            }
}

/* The tables of those directives that have one. */
static void check_directives(struct test *t, struct page *page, const char *section, const struct directive *d,
                             struct type_text text)
{
    for (; d->name != NULL; d++) {
        snprintf(text.directive, sizeof text.directive, "%s", d->name);
        if (d->types != NULL)
            check_types(t, page, section, d->types, text);
    }
}

static void check_all_types(struct test *t, struct page *page)
{
    static const char WORLD[] =
        "Film \"image\" WorldBegin Texture \"bump\" \"float\" \"windy\" MakeNamedMaterial \"a\" \"string type\" "
        "\"mirror\" MakeNamedMaterial \"b\" \"string type\" \"mirror\"";
    struct object_type types[MOST_TYPES];
    check_directives(t, page, "Options", OPTION_DIRECTIVES, (struct type_text){"", NULL, "", "WorldBegin WorldEnd"});
    parse_shape_types(types);
    check_types(t, page, "Shapes", types, (struct type_text){"Shape", NULL, WORLD, "WorldEnd"});
    parse_material_types(types);
    check_types(t, page, "Materials", types, (struct type_text){"Material", NULL, WORLD, "WorldEnd"});
    struct type_text texture = {"Texture \"t\" \"float\"", NULL, WORLD,
                                "Material \"matte\" \"texture sigma\" \"t\" WorldEnd"};
    check_types(t, page, "Textures", TEXTURE_TYPES, texture);
    check_mappings(t, page, texture);
    struct type_text light = {"", NULL, WORLD, "Shape \"sphere\" WorldEnd"};
    check_directives(t, page, "Lights", LIGHT_DIRECTIVES, light);
}

/* --- all other rows -------------------------------------------------------------------------------------- */

/* What a scene of so many characters says of itself: which rows does it show, and are there messages? */
static void read_scene(struct test *t, struct page *const *page, const char *name, const char *text, size_t size)
{
    static const char ROW_IS[] = "\n# row: ";
    char *scene = mem_alloc(size + 2, 1), key[120];
    snprintf(scene, size + 2, "\n%.*s", (int)size, text);
    bool warned = strstr(scene, "\n# warn: ") != NULL || strstr(scene, " 'warning: ") != NULL;
    bool refused = strstr(scene, "\n# expect: ") != NULL && strstr(scene, "\n# expect: ok\n") == NULL;
    for (const char *line = scene; (line = strstr(line, ROW_IS)) != NULL; line++) {
        const char *from = line + strlen(ROW_IS);
        trimmed(key, sizeof key, from, strcspn(from, "\n"));
        bool found = false;
        for (int i = 0; i < 2; i++)
            for (struct row *r = page[i]->row; r < page[i]->row + page[i]->n; r++)
                if (strcmp(r->key, key) == 0) {
                    found = true;
                    r->scenes++;
                    r->warned += warned;
                    r->refused += refused;
                }
        CHECK(t, found, "%s: there is no row \"%s\"", name, key);
    }
    free(scene);
}

static void read_list(struct test *t, struct page *const *page, const char *directory, const char *name)
{
    char *all = text_of(t, directory, name);
    struct list_file f;
    for (const char *at = all; list_next(&at, &f);)
        read_scene(t, page, f.name, f.text, f.size);
    free(all);
}

static void read_features(struct test *t, struct page *const *page)
{
    DIR *d = opendir("scenes/features");
    for (struct dirent *e = d != NULL ? readdir(d) : NULL; e != NULL; e = readdir(d))
        if (strstr(e->d_name, ".txt") != NULL)
            read_list(t, page, "scenes/features", e->d_name);
    if (d != NULL)
        closedir(d);
}

/* What is no scene's is the command line's. */
static void read_script(struct test *t, struct page *const *page)
{
    char *text = text_of(t, "test/run", "cli.sh");
    read_scene(t, page, "cli.sh", text, strlen(text));
    free(text);
}

static void check_row(struct test *t, const struct page *page, const struct row *r)
{
    const char *here = r->text; /* in a table of differences, behind what pbrt-v3 does */
    for (int i = 0; i < 2 && page->differs && strcmp(r->section, "Not read") != 0; i++)
        here = strchr(here, '|') + 1;
    bool error = strstr(here, "an error") != NULL || strstr(here, "refused") != NULL ||
                 strcmp(r->section, "Not read") == 0;
    bool warning = strstr(here, "a warning") != NULL;
    CHECK(t, r->is_tried || r->scenes > 0, "%s: no scene has \"# row: %s\"", page->path, r->key);
    CHECK(t, r->is_tried || !warning || r->warned > 0, "%s: \"%s\" speaks of a warning, no scene has one", page->path,
          r->key);
    CHECK(t, r->is_tried || !error || r->refused > 0, "%s: \"%s\" speaks of an error, no scene has one", page->path,
          r->key);
}

void test_format(struct test *t)
{
    struct page *const page[2] = {read_page(t, "doc/scene-format.md"), read_page(t, "doc/pbrt-differences.md")};
    page[1]->differs = true;
    link_parts(t);
    check_all_types(t, page[0]);
    read_list(t, page, "test/data/fixtures", "scenes.txt");
    read_features(t, page);
    read_script(t, page);
    for (int i = 0; i < 2; i++) {
        CHECK(t, page[i]->n > 25, "%s: only %d rows", page[i]->path, page[i]->n);
        for (int k = 0; k < page[i]->n; k++)
            check_row(t, page[i], &page[i]->row[k]);
        free(page[i]);
    }
}
