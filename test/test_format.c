/* test_format.c: doc/scene-format.md lists the types and parameters of the parser's tables.
 *
 * In the page's tables the last cell of a row lists parameters and the one before it types, each between backticks,
 * values and remarks in parentheses. Every type must have a row, with its parameters and no others.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "helpers.h"
#include "parser/parse.h"
#include "tests.h"

/* Does a text hold this word between backticks? */
static bool holds(const char *text, const char *word)
{
    char quoted[64];
    snprintf(quoted, sizeof quoted, "`%s`", word);
    return strstr(text, quoted) != NULL;
}

/* The row about a type, cut into its two last cells. False if there is none. */
static bool find_row(const char *section, const char *type, char types[2000], char listed[2000])
{
    for (const char *line = strchr(section, '\n'); line != NULL; line = strchr(line + 1, '\n')) {
        if (line[1] != '|' || sscanf(line + 1, "%1999[^\n]", listed) != 1)
            continue;
        listed[strlen(listed) - 1] = '\0'; /* of its last bar */
        char *bar = strrchr(listed, '|');
        if (bar == NULL || bar == listed)
            continue;
        *bar = '\0';
        strcpy(types, strrchr(listed, '|'));
        memmove(listed, bar + 1, strlen(bar + 1) + 1);
        if (holds(types, type))
            return true;
    }
    return false;
}

/* Has one of these types of a table a parameter of this name? */
static bool has_parameter(const struct object_type *type, const char *types, const char *name)
{
    for (; type->name != NULL; type++)
        for (const struct field *row = type->fields; row->name != NULL; row++)
            if (holds(types, type->name) && strcmp(row->name, name) == 0)
                return true;
    return false;
}

static void check_type(struct test *t, const char *page, const char *section, const struct object_type *table,
                       const struct object_type *type)
{
    char types[2000], listed[2000], name[64];
    if (!CHECK(t, find_row(section, type->name, types, listed), "the page has no row for `%s`", type->name))
        return;
    if (strstr(listed, "mapping") != NULL) /* whose parameters are a table of their own */
        strncat(listed, strstr(page, "\nMapping, "), 1200);
    for (const struct field *row = type->fields; row->name != NULL; row++)
        CHECK(t, holds(listed, row->name), "`%s`: the page does not list `%s`", type->name, row->name);
    int depth = 0, used;
    for (const char *p = listed; *p != '\0' && *p != '\n'; p++) {
        depth += *p == '(' ? 1 : *p == ')' ? -1 : 0;
        if (*p != '`' || sscanf(p, "`%63[^`]`%n", name, &used) != 1)
            continue;
        p += used - 1;
        CHECK(t, depth > 0 || has_parameter(table, types, name), "`%s`: the page lists `%s`, which is not read",
              type->name, name);
    }
}

static void check_types(struct test *t, const char *page, const char *heading, const struct object_type *table)
{
    const char *section = strstr(page, heading);
    if (CHECK(t, section != NULL, "no section %s", heading))
        for (const struct object_type *type = table; type->name != NULL; type++)
            check_type(t, page, section, table, type);
}

/* The tables of those directives that have one. */
static void check_directives(struct test *t, const char *page, const char *heading, const struct directive *d)
{
    for (; d->name != NULL; d++)
        if (d->types != NULL)
            check_types(t, page, heading, d->types);
}

void test_format(struct test *t)
{
    struct error err;
    size_t size;
    char *page = text_read("doc/scene-format.md", &size, &err);
    if (!CHECK(t, page != NULL, "run the tests at the top of the tree"))
        return;
    check_directives(t, page, "\n## Options\n", OPTION_DIRECTIVES);
    struct object_type types[MOST_TYPES];
    parse_shape_types(types);
    check_types(t, page, "\n## Shapes\n", types);
    parse_material_types(types);
    check_types(t, page, "\n## Materials\n", types);
    check_types(t, page, "\n## Textures\n", TEXTURE_TYPES);
    check_directives(t, page, "\n## Lights\n", LIGHT_DIRECTIVES);
    free(page);
}
