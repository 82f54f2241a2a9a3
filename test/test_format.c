/* test_format.c: doc/scene-format.md against the tables that the parser goes by.
 *
 * In the page's tables the last cell of a row lists parameters and the one before it types, each between backticks,
 * values and remarks in parentheses. A row must list the parameters of its types and no others, every type must have a
 * row, and every type that is refused must be named in its section.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "helpers.h"
#include "parser/parse.h"
#include "tests.h"

enum { MAX_WORDS = 64, WORD = 40 };

/* The words between backticks of a cell. */
struct words {
    char word[MAX_WORDS][WORD];
    int n;
};

static bool has(const struct words *w, const char *word)
{
    for (int i = 0; i < w->n; i++)
        if (strcmp(w->word[i], word) == 0)
            return true;
    return false;
}

static struct words words_of(const char *begin, const char *end, bool also_in_parentheses)
{
    struct words w = {.n = 0};
    int depth = 0;
    for (const char *p = begin; p < end; p++) {
        depth += *p == '(' ? 1 : *p == ')' ? -1 : 0;
        if (*p != '`')
            continue;
        size_t n = strcspn(p + 1, "`");
        if (n > 0 && n < WORD && w.n < MAX_WORDS && (depth == 0 || also_in_parentheses))
            snprintf(w.word[w.n++], WORD, "%.*s", (int)n, p + 1);
        p += n + 1;
    }
    return w;
}

static const char MAPPING[] = "mapping uscale vscale udelta vdelta v1 v2";

/* Parameters of a texture's mapping stand in a table of their own; a row refers to it by that word. */
static bool is_of_mapping(const char *name)
{
    const char *at = strstr(MAPPING, name);
    size_t n = strlen(name);
    return at != NULL && (at == MAPPING || at[-1] == ' ') && (at[n] == ' ' || at[n] == '\0');
}

static const struct object_type *find_type(const struct object_type *const *tables, const char *name)
{
    for (; *tables != NULL; tables++)
        for (const struct object_type *t = *tables; t->name != NULL; t++)
            if (strcmp(t->name, name) == 0)
                return t;
    return NULL;
}

/* One row; the types it is about are added to *seen. */
static void check_row(struct test *t, const struct object_type *const *tables, const char *line, const char *end,
                      struct words *seen)
{
    while (end > line && (end[-1] == ' ' || end[-1] == '|'))
        end--;
    const char *last = end, *before;
    while (last > line && strncmp(last, " | ", 3) != 0)
        last--;
    for (before = last - 1; before > line && before[0] != '|'; before--)
        ;
    struct words types = words_of(before, last, true), listed = words_of(last, end, false), known = {.n = 0};
    bool maps = false;
    for (const char *p = last; p + 7 <= end; p++)
        maps = maps || (strncmp(p, "mapping", 7) == 0 && p[-1] == ' ');
    for (int i = 0; i < types.n; i++) {
        const struct object_type *type = find_type(tables, types.word[i]);
        if (strcmp(types.word[i], "none") == 0 || strcmp(types.word[i], "srgb") == 0 || types.word[i][0] == '"')
            continue; /* these have no table */
        if (!CHECK(t, type != NULL && type->parameter != NULL, "the page has a type `%s`, the parser has not",
                   types.word[i]))
            continue;
        strcpy(seen->word[seen->n++ % MAX_WORDS], types.word[i]);
        for (const struct parameter *row = type->parameter; row->name != NULL; row++) {
            snprintf(known.word[known.n++ % MAX_WORDS], WORD, "%s", row->name);
            CHECK(t, has(&listed, row->name) || (maps && is_of_mapping(row->name)),
                  "`%s`: the page does not list `%s`", types.word[i], row->name);
        }
    }
    for (int i = 0; known.n > 0 && i < listed.n; i++)
        CHECK(t, has(&known, listed.word[i]), "`%s`: the page lists `%s`, which the parser does not read",
              types.word[0], listed.word[i]);
}

static void check_section(struct test *t, const char *page, const char *heading,
                          const struct object_type *const *tables)
{
    struct words seen = {.n = 0};
    const char *begin = strstr(page, heading);
    if (!CHECK(t, begin != NULL, "no section %s", heading))
        return;
    begin += strlen(heading);
    const char *stop = strstr(begin, "\n## ");
    char *section = mem_copy_text(begin);
    if (stop != NULL)
        section[stop - begin] = '\0';
    for (const char *line = section; line != NULL; line = strchr(line, '\n') != NULL ? strchr(line, '\n') + 1 : NULL)
        if (line[0] == '|' && strstr(line, "`") != NULL)
            check_row(t, tables, line, line + strcspn(line, "\n"), &seen);
    const char *refused = strstr(section, "Refused by name: ");
    for (; *tables != NULL; tables++)
        for (const struct object_type *type = *tables; type->name != NULL; type++)
            if (type->parameter != NULL)
                CHECK(t, has(&seen, type->name), "the page has no row for `%s`", type->name);
            else
                CHECK(t, refused != NULL && strstr(refused, type->name) != NULL, "%s is not named as refused",
                      type->name);
    free(section);
}

/* The tables of those directives that have one. */
static void check_directives(struct test *t, const char *page, const char *heading, const struct directive *d)
{
    const struct object_type *tables[16];
    int n = 0;
    for (; d->name != NULL; d++)
        if (d->types != NULL)
            tables[n++] = d->types;
    tables[n] = NULL;
    check_section(t, page, heading, tables);
}

void test_format(struct test *t)
{
    struct error err;
    size_t size;
    char *page = text_read("doc/scene-format.md", &size, &err);
    if (!CHECK(t, page != NULL, "run the tests at the top of the tree"))
        return;
    const struct object_type *const materials[] = {MATERIAL_TYPES, NULL}, *const textures[] = {TEXTURE_TYPES, NULL};
    check_directives(t, page, "\n## Options\n", OPTION_DIRECTIVES);
    check_directives(t, page, "\n## Shapes\n", SHAPE_DIRECTIVES);
    check_section(t, page, "\n## Materials\n", materials);
    check_section(t, page, "\n## Textures\n", textures);
    check_directives(t, page, "\n## Lights\n", LIGHT_DIRECTIVES);
    free(page);
}
