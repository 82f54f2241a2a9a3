/* format_values.c: the lists of parameters of doc/scene-format.md, tried out: "float `radius` (1), `zmin`; no meaning:
 * `x`" says of a type that setting radius to 1 changes nothing, that another radius and zmin do, and x does not.
 *
 * The last cell of a row lists parameters, each between backticks, behind the word for their type. In parentheses
 * behind a name comes the default, also of the names before it that have the same type and none of their own: numbers,
 * or words between backticks, of which the last is another value. After a ; comes another number. Brackets have as many
 * words as the parameter has numbers. A parenthesis that begins with another word is a remark. */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "parser/parser.h"
#include "parser_parts.h"

enum { LINE = 1024, MOST_PARAMETERS = 32 };

struct listed {
    char type[16], name[32];
    char remark[160]; /* what is in the parentheses */
    int n;            /* numbers, by the brackets; 0: as the type wants */
    bool ignored, closed; /* closed: no parenthesis belongs to it any more */
};

/* --- reading a list ------------------------------------------------------------------------------------- */

static bool is_type(const char *word)
{
    static const char *const TYPES[] = {"integer", "float", "bool",   "string", "colour", "point",
                                        "point2",  "vector", "normal", "rgb",    NULL};
    int i = 0;
    while (TYPES[i] != NULL && strcmp(TYPES[i], word) != 0)
        i++;
    return TYPES[i] != NULL;
}

/* The remark in the parentheses at *at belongs to the last parameter and to those of its type before it. */
static const char *read_remark(const char *at, struct listed *item, int n)
{
    const char *end = strchr(at, ')');
    for (int i = n - 1; i >= 0 && !item[i].closed && strcmp(item[i].type, item[n - 1].type) == 0; i--) {
        snprintf(item[i].remark, sizeof item[i].remark, "%.*s", (int)(end - at - 1), at + 1);
        item[i].closed = true;
    }
    return end;
}

static int read_list(const char *list, struct listed item[MOST_PARAMETERS])
{
    struct listed next = {.type = "float"};
    int n = 0, used;
    char word[32];
    for (const char *p = list; *p != '\0' && n < MOST_PARAMETERS; p++) {
        if (*p == '`' && sscanf(p, "`%31[^`]`%n", next.name, &used) == 1) {
            item[n++] = next;
            p += used - 1;
        } else if (*p == '(' && n > 0) {
            p = read_remark(p, item, n);
        } else if (*p == '[' && n > 0) {
            for (; *p != ']'; p++)
                item[n - 1].n += *p == ' ' || *p == '[';
            item[n - 1].closed = p[1] != ' ' || p[2] != '(';
        } else if (*p == ';') {
            for (int i = 0; i < n; i++)
                item[i].closed = true;
        } else if (isalpha((unsigned char)*p) && sscanf(p, "%31[a-z0-9]%n", word, &used) == 1) {
            if (is_type(word))
                strcpy(next.type, word);
            next.ignored |= strcmp(word, "meaning") == 0;
            p += used - 1;
        }
    }
    return n;
}

/* --- values ---------------------------------------------------------------------------------------------- */

/* Of some no number will do: a name, a type, another value. Ones that the type needs stand in its TYPE_NEEDS. */
static const char *const VALUES[][3] = {
    {"bumpmap", "texture", "\"bump\""}, {"alpha", "float", "0"}, {"shadowalpha", "float", "0"},
    {"mapname", "string", "\"parts/map.pfm\""}, {"N", "normal", "[ 0 1 0 0 1 0 0 1 0 ]"},
    {"S", "vector", "[ 0 1 0 0 1 0 0 1 0 ]"}, {"uv", "float", "[ 0 0 1 0 0 1 ]"}, {"st", "float", "[ 0 0 1 0 0 1 ]"}};

/* The number a text begins with, also as a fraction; false if it begins with none. */
static bool read_number(const char **text, double *out)
{
    char *end;
    while (**text == ' ')
        ++*text;
    *out = strtod(*text, &end);
    bool found = end > *text && !isalpha((unsigned char)**text);
    if (found && *end == '/')
        *out /= strtod(end + 1, &end);
    *text = end;
    return found;
}

/* A parameter with n equal numbers, or, if `ramp`, with n that alternate. */
static void put_numbers(char out[LINE], const struct listed *p, double value, int n, bool ramp)
{
    const char *type = strcmp(p->type, "colour") == 0 ? "rgb" : p->type;
    int used = snprintf(out, LINE, "\"%s %s\" [", type, p->name);
    for (int i = 0; i < n; i++)
        used += snprintf(out + used, LINE - (size_t)used, " %.17g", !ramp ? value : i % 2 == 0 ? .25 : .75 + .1 * i);
    snprintf(out + used, LINE - (size_t)used, " ]");
}

static int numbers_of(const struct listed *p)
{
    bool three = strcmp(p->type, "colour") == 0 || strcmp(p->type, "point") == 0 || strcmp(p->type, "vector") == 0;
    return p->n > 0 ? p->n : three ? 3 : 1;
}

/* The parameter with its default, as a scene has it; false if the page gives none. */
static bool put_default(const struct listed *p, char out[LINE])
{
    const char *at = p->remark;
    char word[32];
    double value;
    if (strcmp(p->type, "bool") == 0 && sscanf(at, "%31[a-z]", word) == 1)
        return snprintf(out, LINE, "\"bool %s\" \"%s\"", p->name, word) > 0;
    if (strcmp(p->type, "string") == 0 && sscanf(at, "`%31[^`]`", word) == 1)
        return snprintf(out, LINE, "\"string %s\" \"%s\"", p->name, word) > 0;
    if (!read_number(&at, &value))
        return false;
    put_numbers(out, p, value, numbers_of(p), false);
    if (numbers_of(p) > 1 && strcmp(p->type, "colour") != 0) { /* all are written down */
        char numbers[LINE];
        snprintf(numbers, sizeof numbers, "%.*s", (int)strcspn(p->remark, ",:;"), p->remark);
        snprintf(out, LINE, "\"%s %s\" [ %.200s ]", p->type, p->name, numbers);
    }
    return true;
}

/* The parameter with another value. */
static void put_other(const struct listed *p, char out[LINE])
{
    const char *at = p->remark, *semicolon = strchr(p->remark, ';'), *quote = strrchr(p->remark, '`');
    double value;
    bool known = read_number(&at, &value), whole = strcmp(p->type, "integer") == 0;
    for (size_t i = 0; i < sizeof VALUES / sizeof VALUES[0]; i++)
        if (strcmp(VALUES[i][0], p->name) == 0 && p->remark[0] == (p->name[0] == 'S' ? 't' : '\0')) {
            snprintf(out, LINE, "\"%s %s\" %s", VALUES[i][1], p->name, VALUES[i][2]);
            return;
        }
    if (strcmp(p->type, "bool") == 0) {
        snprintf(out, LINE, "\"bool %s\" \"%s\"", p->name, strncmp(p->remark, "true", 4) == 0 ? "false" : "true");
    } else if (strcmp(p->type, "string") == 0) {
        while (quote != NULL && quote > p->remark && quote[-1] != '`')
            quote--;
        snprintf(out, LINE, "\"string %s\" \"%.*s\"", p->name, quote != NULL ? (int)strcspn(quote, "`") : 1,
                 quote != NULL ? quote : "x");
    } else {
        at = semicolon != NULL ? semicolon + 1 : at;
        double other = !known ? 0.5 + 1.5 * whole : whole ? value + 1 : value / 2 + 0.11;
        if (semicolon != NULL)
            read_number(&at, &other);
        put_numbers(out, p, other, numbers_of(p), numbers_of(p) > 1 && strcmp(p->type, "colour") != 0);
    }
}

/* --- trying ---------------------------------------------------------------------------------------------- */

/* Parameters without which a type makes nothing; those of both names are not tried. */
static const char *const TYPE_NEEDS[][2] = {
    {"Shape \"trianglemesh\"", "\"integer indices\" [ 0 1 2 ] \"point P\" [ 0 0 0 1 0 0 0 1 0 ]"},
    {"Shape \"loopsubdiv\"", "\"integer indices\" [ 0 1 2 ] \"point P\" [ 0 0 0 1 0 0 0 1 0 ]"},
    {"Shape \"plymesh\"", "\"string filename\" \"parts/triangle.ply\""},
    {"Shape \"curve\"", "\"point P\" [ 0 0 0 1 0 0 1 1 0 2 0 0 3 0 0 3 1 0 4 0 0 ]"},
    {"Material \"mix\"", "\"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"b\""},
    {"Material \"fourier\"", "\"string bsdffile\" \"features/layered.bsdf\""},
    {"Texture \"t\" \"float\" \"imagemap\"", "\"string filename\" \"parts/grey.tga\""}};

/* What comes of a scene, in words: its messages, and what it holds; to be given to free(). */
static char *outcome(struct test *t, const struct type_text *type, const char *needs, const char *parameter)
{
    char path[TEXT];
    struct error err;
    struct scene s;
    struct hearing *heard = mem_alloc(1, sizeof *heard);
    struct message_sink sink = {hear_message, heard};
    char *text = mem_alloc(4, LINE);
    int n = snprintf(text, 4 * LINE, "%s\n%s %s %s\n%s\n", type->before, type->directive, needs, parameter,
                     type->after);
    snprintf(path, sizeof path, "%s/format.pbrt", test_tmp(t));
    write_bytes(path, text, (size_t)n);
    free(text);
    bool ok = parse_scene(path, NULL, &s, &sink, &err);
    char *words = ok ? scene_in_words(t, &s) : mem_copy_text("refused");
    if (ok)
        scene_free(&s);
    size_t room = strlen(words) + 2 * MAX_WARNINGS * TEXT, used = 0;
    char *all = mem_alloc(room, 1);
    for (int i = 0; i < heard->errors.n; i++)
        used += (size_t)snprintf(all + used, room - used, "%s\n", heard->errors.text[i]);
    for (int i = 0; i < heard->warnings.n; i++)
        used += (size_t)snprintf(all + used, room - used, "%s\n", heard->warnings.text[i]);
    strcat(all, words);
    free(words);
    free(heard);
    return all;
}

static void check_parameter(struct test *t, const struct type_text *type, const char *needs, const char *plain,
                            const struct listed *p)
{
    char value[LINE];
    bool has_default = !p->ignored && put_default(p, value);
    char *set = has_default ? outcome(t, type, needs, value) : NULL;
    CHECK(t, !has_default || strcmp(plain, set) == 0, "%s: with %s, the page's default, comes\n%s\nand without\n%s",
          type->directive, value, set, plain);
    free(set);
    put_other(p, value);
    set = outcome(t, type, needs, value);
    CHECK(t, strstr(set, "is not used") == NULL && strstr(set, "refused") == NULL &&
                 (strcmp(plain, set) == 0) == p->ignored,
          "%s: with %s, which should %s, comes\n%s\nand without\n%s", type->directive, value,
          p->ignored ? "change nothing" : "be read", set, plain);
    free(set);
}

/* Of a type that no parameter has, the message says which it has; of a name with a letter more, which was meant. */
static void check_mistake(struct test *t, const struct type_text *type, const char *needs, const struct listed *p)
{
    char value[LINE], wanted[LINE];
    snprintf(value, sizeof value, "\"vector2 %s\" [ 1 2 ]", p->name);
    snprintf(wanted, sizeof wanted, " is not used: \"%s\" is a%s", p->name,
             strcmp(p->name, "bumpmap") == 0 ? " float or a texture" :
             strcmp(p->type, "colour") == 0 || strcmp(p->type, "rgb") == 0 ? " colour (rgb)" :
             strcmp(p->type, "integer") == 0 ? "n integer" : "");
    char *said = outcome(t, type, needs, value);
    CHECK(t, strstr(said, wanted) != NULL, "%s with %s is not told%s but\n%s", type->directive, value, wanted, said);
    free(said);
    snprintf(value, sizeof value, "\"float %sx\" 1", p->name);
    snprintf(wanted, sizeof wanted, "%sx\" of", p->name);
    said = outcome(t, type, needs, value);
    const char *message = strstr(said, wanted);
    snprintf(wanted, sizeof wanted, "; did you mean \"%s\"?\n", p->name);
    CHECK(t, message != NULL && (strlen(p->name) < 2 || strstr(message, wanted) != NULL), "%s with %s is told\n%s",
          type->directive, value, said);
    free(said);
}

void check_format_values(struct test *t, const struct type_text *type, const char *list)
{
    struct listed item[MOST_PARAMETERS];
    int n = read_list(list, item);
    const char *needs = "";
    for (size_t i = 0; i < sizeof TYPE_NEEDS / sizeof TYPE_NEEDS[0]; i++)
        if (strcmp(TYPE_NEEDS[i][0], type->directive) == 0)
            needs = TYPE_NEEDS[i][1];
    char *plain = outcome(t, type, needs, ""), *bare = outcome(t, type, "", "");
    CHECK(t, strstr(plain, "refused") == NULL, "%s %s is refused: %s", type->directive, needs, plain);
    CHECK(t, needs[0] == '\0' || strstr(bare, "format.pbrt") != NULL, "%s needs no parameters", type->directive);
    for (int i = 0; i < n; i++) {
        char quoted[40];
        snprintf(quoted, sizeof quoted, " %s\"", item[i].name);
        bool ribbon = strcmp(type->directive, "Shape \"curve\"") == 0 && item[i].name[0] == 'N'; /* see ok-curves */
        if (strstr(needs, quoted) == NULL && !ribbon && field_find(type->fields, item[i].name) != NULL)
            check_parameter(t, type, needs, plain, &item[i]);
        if (strstr(needs, quoted) == NULL && !item[i].ignored && field_find(type->fields, item[i].name) != NULL)
            check_mistake(t, type, needs, &item[i]);
    }
    free(plain);
    free(bare);
}
