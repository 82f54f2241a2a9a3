/* options.c: see options.h. */
#include "cli/options.h"

#include <ctype.h>
#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "image/picture.h"
#include "parser/symbols.h"

/* How far the arguments are read, and the option being read. */
struct reader {
    int argc, at; /* 0: those of fallbacks, before the first */
    char **argv;
    const char *attached; /* the option's value if it came in the same argument and is not used yet, else NULL */
    const struct option *option;
    struct error *err;
};

const struct option *options_next(const struct option *option)
{
    return option[1].name != NULL ? option + 1 : option[1].others;
}

static bool is_operand(const struct option *o) { return o->name[0] != '-'; }
static void *target_of(const struct option *o, void *target) { return (char *)target + o->offset; }
static bool looks_like_option(const char *text) { return text[0] == '-' && text[1] != '\0'; }

static bool has_texts(const struct option *o)
{
    return o->kind == OPTION_TEXTS || o->kind == OPTION_PAIRS || o->kind == OPTION_LIST;
}

void texts_add(struct texts *texts, const char *text)
{
    texts->item = mem_grow(texts->item, &texts->capacity, (size_t)texts->n + 1, sizeof *texts->item);
    texts->item[texts->n++] = text;
}

/* --- values ------------------------------------------------------------------------------------------- */

/* The next argument as the option's value; false with a message if there is none. */
static bool next_value(struct reader *r, const char **text)
{
    *text = r->attached;
    r->attached = NULL;
    if (*text == NULL && r->at + 1 < r->argc)
        *text = r->argv[++r->at];
    if (*text == NULL)
        return error_set(r->err, "%s needs a value: %s", r->option->name, r->option->value);
    return **text != '\0' || r->at == 0 || error_set(r->err, "%s: its value is empty", r->option->name);
}

/* The number at the beginning of *text, which moves behind it. False if there is none, or if it is out of range, as NaN
 * and what overflows are of every range. */
static bool scan_number(const char **text, const struct option *o, double *out)
{
    bool real = o->kind == OPTION_NUMBER || o->kind == OPTION_WINDOW;
    bool begins = real || isdigit((unsigned char)**text); /* strtoull takes signs too */
    char *end;
    *out = real ? strtod(*text, &end) : (double)strtoull(*text, &end, 10);
    bool found = begins && end != *text;
    *text = end;
    return found && *out >= o->low && *out <= o->high;
}

/* Numbers with a separator between them; those of a window may also be arguments of their own. */
static bool read_numbers(struct reader *r, int least, int most, const char *expected, double *out)
{
    const struct option *o = r->option;
    bool window = o->kind == OPTION_WINDOW, commas = window || o->kind == OPTION_PIXEL, ok = true;
    const char *text = "", *at = "";
    for (int n = 0; ok && n < most && (n < least || *at != '\0'); n++) {
        if (n > 0 && !(window && *at == '\0'))
            ok = *at++ == (commas ? ',' : o->kind == OPTION_RANGE ? ':' : 'x');
        else if (next_value(r, &text))
            at = text;
        else
            return false;
        ok = ok && scan_number(&at, o, &out[n]);
    }
    return (ok && *at == '\0') ||
           error_set(r->err, "%s %s: expected %s from %.10g to %.10g", o->name, text, expected, o->low, o->high);
}

static bool read_integer(struct reader *r, int *out)
{
    double v;
    if (!read_numbers(r, 1, 1, "an integer", &v))
        return false;
    *out = (int)v;
    return true;
}

static bool read_size(struct reader *r, int least, const char *expected, int *size)
{
    double v[2] = {0, 0};
    struct error why;
    if (!read_numbers(r, least, 2, expected, v))
        return false;
    size[0] = (int)v[0];
    size[1] = (int)v[1];
    return size[1] == 0 || picture_size_ok((uint64_t)v[0], (uint64_t)v[1], &why) ||
           error_set(r->err, "%s: %s", r->option->name, why.text);
}

static bool read_pixel(struct reader *r, int *pixel)
{
    double v[2];
    if (!read_numbers(r, 2, 2, "X,Y, each", v))
        return false;
    pixel[0] = (int)v[0];
    pixel[1] = (int)v[1];
    return true;
}

static bool read_window(struct reader *r, double *v)
{
    return read_numbers(r, 4, 4, "four numbers, each", v) &&
           ((v[0] < v[1] && v[2] < v[3]) || error_set(r->err, "%s: the window is empty", r->option->name));
}

static bool read_range(struct reader *r, int *range)
{
    double v[2];
    if (!read_numbers(r, 2, 2, "FIRST:END, each", v))
        return false;
    range[0] = (int)v[0];
    range[1] = (int)v[1];
    return range[0] < range[1] || error_set(r->err, "%s: there is nothing in the range", r->option->name);
}

static bool read_seed(struct reader *r, uint64_t *out)
{
    const char *text;
    char *end;
    if (!next_value(r, &text))
        return false;
    errno = 0;
    *out = strtoull(text, &end, 10);
    return (isdigit((unsigned char)*text) && *end == '\0' && errno == 0) ||
           error_set(r->err, "%s %s: expected a whole number from 0 to 18446744073709551615", r->option->name, text);
}

static bool read_texts(struct reader *r, struct texts *texts)
{
    const char *text;
    do {
        if (!next_value(r, &text))
            return false;
        const char *equals = strchr(text, '=');
        if (r->option->kind == OPTION_PAIRS && (equals == NULL || equals == text))
            return error_set(r->err, "%s %s: expected name=value", r->option->name, text);
        texts_add(texts, text);
    } while (r->option->kind == OPTION_LIST && r->at + 1 < r->argc && !looks_like_option(r->argv[r->at + 1]));
    return true;
}

static bool read_value(struct reader *r, void *target)
{
    switch (r->option->kind) {
    case OPTION_ON: *(bool *)target = true; return true;
    case OPTION_OFF: *(bool *)target = false; return true;
    case OPTION_INTEGER: return read_integer(r, target);
    case OPTION_NUMBER: return read_numbers(r, 1, 1, "a number", target);
    case OPTION_SEED: return read_seed(r, target);
    case OPTION_WINDOW: return read_window(r, target);
    case OPTION_PIXEL: return read_pixel(r, target);
    case OPTION_RANGE: return read_range(r, target);
    case OPTION_SIZE: return read_size(r, 2, "WIDTHxHEIGHT, each", target);
    case OPTION_WIDTH: return read_size(r, 1, "WIDTHxHEIGHT or WIDTH, each", target);
    case OPTION_TEXT: return next_value(r, target);
    case OPTION_TEXTS:
    case OPTION_PAIRS:
    case OPTION_LIST: return read_texts(r, target);
    }
    return false;
}

/* --- options ------------------------------------------------------------------------------------------ */

static bool unknown_option(const struct option *table, const char *argument, struct error *err)
{
    struct suggestion s = suggest_start(argument);
    for (const struct option *o = table; o != NULL; o = options_next(o))
        if (o->name[1] == '-')
            suggest_offer(&s, o->name);
    if (s.name == NULL)
        return error_set(err, "unknown option %s", argument);
    return error_set(err, "unknown option %s (did you mean %s?)", argument, s.name);
}

static bool is_called(const char *name, const char *argument, size_t length)
{
    return name != NULL && strncmp(name, argument, length) == 0 && name[length] == '\0';
}

static bool read_option(struct reader *r, const struct option *table, void *target)
{
    const char *argument = r->argv[r->at];
    size_t length = argument[1] == '-' ? strcspn(argument, "=") : 2; /* of the name */
    const struct option *o = table;
    while (o != NULL && !is_called(o->name, argument, length) && !is_called(o->alias, argument, length))
        o = options_next(o);
    if (o == NULL)
        return unknown_option(table, argument, r->err);
    r->option = o;
    r->attached = argument[length] == '\0' ? NULL : argument + length + (argument[length] == '=');
    if (!read_value(r, target_of(o, target)))
        return false;
    return r->attached == NULL || error_set(r->err, "%s: %s takes no value", argument, o->name);
}

const char *const *options_texts(const struct option *o, void *target, int *n)
{
    const struct texts *texts = target_of(o, target);
    const char *const *one = target_of(o, target);
    *n = has_texts(o) ? texts->n : *one != NULL;
    return has_texts(o) ? (const char *const *)texts->item : one;
}

static bool is_given(const struct option *o, void *target)
{
    int n;
    options_texts(o, target, &n);
    return n > 0;
}

/* Operands fill their rows in order; a list takes all that are left. */
static bool read_operand(struct reader *r, const struct option *table, void *target)
{
    const struct option *o = table;
    while (o != NULL && !(is_operand(o) && (has_texts(o) || !is_given(o, target))))
        o = options_next(o);
    if (o == NULL)
        return error_set(r->err, "%s is one argument too many", r->argv[r->at]);
    r->option = o;
    r->attached = r->argv[r->at];
    return read_value(r, target_of(o, target));
}

bool options_read(const struct option *table, int argc, char **argv, void *target, struct error *err)
{
    struct reader r = {.argc = argc, .argv = argv, .err = err};
    bool ok = true;
    for (const struct option *o = table; ok && o != NULL; o = options_next(o)) {
        r.option = o;
        r.attached = o->fallback;
        ok = o->fallback == NULL || read_value(&r, target_of(o, target));
    }
    for (r.at = 1; ok && r.at < argc; r.at++)
        ok = looks_like_option(argv[r.at]) ? read_option(&r, table, target) : read_operand(&r, table, target);
    for (const struct option *o = table; ok && o != NULL; o = options_next(o))
        if ((has_texts(o) || o->kind == OPTION_TEXT) && o->low > 0 && !is_given(o, target))
            ok = error_set(err, "%s needs %s (%s)", argv[0], o->help, o->name);
    return ok;
}

void options_free(const struct option *table, void *target)
{
    for (const struct option *o = table; o != NULL; o = options_next(o))
        if (has_texts(o))
            free(((struct texts *)target_of(o, target))->item);
}

/* --- help --------------------------------------------------------------------------------------------- */

const struct option *options_print(const struct option *table)
{
    const struct option *o = table;
    for (; o->name != NULL; o++) {
        char left[80], right[80] = "";
        snprintf(left, sizeof left, "%s%s%s %s", o->name, o->alias != NULL ? ", " : "",
                 o->alias != NULL ? o->alias : "", o->value != NULL ? o->value : "");
        if (o->fallback != NULL && o->fallback[0] != '\0')
            snprintf(right, sizeof right, " (default %s)", o->fallback);
        printf("    %-25s %s%s\n", left, o->help, right);
    }
    return o->others;
}
