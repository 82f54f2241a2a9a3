/* params_read.c: a parameter list from text to memory, see params.h. */
#include "parser/params.h"

#include <stdlib.h>
#include <string.h>

/* One row per spelling; the first of a type is its name in messages. */
static const struct {
    const char *name;
    enum param_type type;
} TYPES[] = {{"integer", PARAM_INTEGER},  {"float", PARAM_FLOAT},
             {"bool", PARAM_BOOL},        {"string", PARAM_STRING},
             {"texture", PARAM_TEXTURE},  {"point2", PARAM_POINT2},
             {"vector2", PARAM_VECTOR2},  {"point", PARAM_POINT},
             {"point3", PARAM_POINT},     {"vector", PARAM_VECTOR},
             {"vector3", PARAM_VECTOR},   {"normal", PARAM_NORMAL},
             {"rgb", PARAM_RGB},          {"color", PARAM_RGB},
             {"xyz", PARAM_XYZ},          {"blackbody", PARAM_BLACKBODY},
             {"spectrum", PARAM_SPECTRUM}};
enum { N_TYPES = sizeof TYPES / sizeof TYPES[0] };

const char *params_type_name(enum param_type type)
{
    for (int i = 0; i < N_TYPES; i++)
        if (TYPES[i].type == type)
            return TYPES[i].name;
    return "";
}

/* Split a copy of "type name" into item->type and ->name. The type is PARAM_TYPES, with a warning, where it cannot be
 * used. */
static void read_declaration(struct params *p, const struct token *t, struct param *item)
{
    char *text = arena_text(p->arena, t->text);
    const char *type = strtok(text, " \t"), *name = strtok(NULL, " \t");
    item->type = PARAM_TYPES;
    item->name = name != NULL ? name : t->text;
    for (int i = 0; i < N_TYPES && name != NULL; i++)
        if (strcmp(TYPES[i].name, type) == 0)
            item->type = TYPES[i].type;
    if (item->type == PARAM_TYPES)
        source_warn(p->messages, t->position,
                    "the parameter \"%.40s\" is passed over: it wants a type and a name, like \"float radius\"; types "
                    "are integer, float, bool, string, texture, point2, vector2, point, vector, normal, rgb, xyz, "
                    "blackbody and spectrum", t->text);
}

static bool wants_text(enum param_type type)
{
    return type == PARAM_BOOL || type == PARAM_STRING || type == PARAM_TEXTURE;
}

/* One more value. Returns true. */
static bool add_number(struct params *p, struct param *item, double number)
{
    p->number = mem_append(p->number, p->n_number, sizeof *p->number);
    p->number[p->n_number++] = number;
    item->n++;
    return true;
}

static bool add_text(struct params *p, struct param *item, const char *text)
{
    p->string = mem_append(p->string, p->n_string, sizeof *p->string);
    p->string[p->n_string++] = text;
    item->is_text = true;
    item->n++;
    return true;
}

/* One value that is not a plain number: a string, a bare true or false, a number with an appendix, or a mistake. */
static bool read_text(struct params *p, struct lexer *l, struct param *item)
{
    struct token t;
    char buffer[64];
    if (!lexer_next(l, &t)) {
        p->failed = true;
        return false;
    }
    if (t.kind == TOKEN_NUMBER && !item->is_text)
        return add_number(p, item, t.number);
    bool bare_bool = t.kind == TOKEN_WORD && (strcmp(t.text, "true") == 0 || strcmp(t.text, "false") == 0);
    bool text = t.kind == TOKEN_STRING || (item->type == PARAM_BOOL && bare_bool);
    if (!text || (item->n > 0 && !item->is_text))
        return params_fail(p, t.position, "\"%s\" wants %s here, not %s", item->name,
                           item->is_text || (item->n == 0 && wants_text(item->type)) ? "a quoted string" : "a number",
                           token_text(&t, buffer, sizeof buffer));
    return add_text(p, item, t.text);
}

static bool read_value(struct params *p, struct lexer *l, struct param *item)
{
    double number;
    return item->is_text || !lexer_number(l, &number) ? read_text(p, l, item) : add_number(p, item, number);
}

static bool read_values(struct params *p, struct lexer *l, struct param *item)
{
    if (lexer_peek(l) != TOKEN_OPEN)
        return read_value(p, l, item);
    struct token open;
    lexer_next(l, &open);
    for (;;) {
        enum token_kind next = lexer_peek(l);
        if (next == TOKEN_CLOSE)
            return lexer_next(l, &open);
        if (next == TOKEN_END)
            return params_fail(p, open.position, "this [ has no ]; close the list of values");
        if (!read_value(p, l, item))
            return false;
    }
}

/* Numbers where strings belong and the reverse: pbrt-v3 passes over such a parameter. */
static bool is_usable(struct params *p, const struct param *item)
{
    if (item->type == PARAM_TYPES)
        return false;
    if (item->type == PARAM_SPECTRUM || item->n == 0 || item->is_text == wants_text(item->type))
        return true;
    source_warn(p->messages, item->position, "\"%s %.40s\" is passed over: it wants %s", params_type_name(item->type),
                item->name, item->is_text ? "numbers, not strings" : "a quoted string, not a number");
    return false;
}

static bool read_items(struct params *p, struct lexer *l)
{
    while (lexer_peek(l) == TOKEN_STRING) {
        struct token t;
        if (!lexer_next(l, &t))
            return false;
        if (p->n == MAX_PARAMETERS)
            return params_fail(p, t.position, "more than %d parameters; nothing has so many", MAX_PARAMETERS);
        struct param item = {.position = t.position};
        read_declaration(p, &t, &item);
        size_t n_number = p->n_number, n_string = p->n_string;
        if (!read_values(p, l, &item))
            return false;
        if (is_usable(p, &item)) {
            p->item[p->n++] = item;
        } else {
            p->n_number = n_number;
            p->n_string = n_string;
        }
    }
    return true;
}

bool params_read(struct params *p, struct lexer *l)
{
    p->n = 0;
    p->n_number = p->n_string = 0;
    p->failed = false;
    bool ok = read_items(p, l);
    size_t numbers = 0, texts = 0;
    for (struct param *item = p->item; item < p->item + p->n; item++) { /* the arrays do not move any more */
        item->number = item->is_text ? NULL : p->number + numbers;
        item->text = item->is_text ? p->string + texts : NULL;
        *(item->is_text ? &texts : &numbers) += (size_t)item->n;
    }
    return ok;
}

/* n values in the arena. */
static void *copy_values(struct arena *arena, const void *values, int n, size_t size)
{
    void *copy = arena_alloc(arena, (size_t)n * size);
    return n > 0 ? memcpy(copy, values, (size_t)n * size) : copy;
}

struct param_list params_keep(const struct params *p)
{
    struct param_list kept = {copy_values(p->arena, p->item, p->n, sizeof *kept.item), p->n};
    for (struct param *item = kept.item; item < kept.item + kept.n; item++)
        if (item->is_text)
            item->text = copy_values(p->arena, item->text, item->n, sizeof *item->text);
        else
            item->number = copy_values(p->arena, item->number, item->n, sizeof *item->number);
    return kept;
}

void params_free(struct params *p)
{
    free(p->number);
    free(p->string);
}
