/* options.c: see options.h. */
#include "library/options.h"

#include <ctype.h>
#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "image/image.h"

/* How far the arguments are read, and the option being read. */
struct reader {
    const struct option *table;
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
static bool is_texts(const struct option *o) { return o->kind >= OPTION_TEXTS; }
static bool looks_like_option(const char *text) { return text[0] == '-' && text[1] != '\0'; }

void texts_add(struct texts *texts, const char *text)
{
    texts->item = mem_append(texts->item, (size_t)texts->n, sizeof *texts->item);
    texts->item[texts->n++] = text;
}

bool texts_differ(const struct texts *outputs, struct error *err)
{
    for (int i = 0; i < outputs->n; i++)
        for (int k = 0; k < i; k++)
            if (strcmp(outputs->item[i], outputs->item[k]) == 0)
                return error_usage(err, "%s: an output needs a name of its own", outputs->item[i]);
    return true;
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

/* Seconds in a unit at *text, which moves behind it; 1 where there is none. */
static double scan_unit(const char **text)
{
    static const char UNITS[] = "smh";
    static const double SECONDS[] = {1, 60, 3600};
    const char *unit = **text != '\0' ? strchr(UNITS, **text) : NULL;
    *text += unit != NULL;
    return unit != NULL ? SECONDS[unit - UNITS] : 1;
}

/* Kinds of numbers: how many, how many of them at least, and the character between them. */
struct numbers {
    int n, least;
    char between;
    bool real, rising; /* rising: of two each the first is less */
};
enum { MOST_NUMBERS = 4 };
static const struct numbers NUMBERS[] = {
    [OPTION_INTEGER] = {1, 1, '\0', false, false}, [OPTION_NUMBER] = {1, 1, '\0', true, false},
    [OPTION_TIME] = {1, 1, '\0', true, false},     [OPTION_PIXEL] = {2, 2, ',', false, false},
    [OPTION_WIDTH] = {2, 1, 'x', false, false},    [OPTION_RANGE] = {2, 2, ':', false, true},
    [OPTION_LENGTHS] = {2, 2, ':', true, true},    [OPTION_WINDOW] = {4, 4, ',', true, true}};

/* The number at the beginning of *text, which moves behind it. False if there is none, or if it is out of range, as NaN
 * is of every range, and what overflows of every one with an end. */
static bool scan_number(const char **text, const struct option *o, double *out)
{
    bool real = NUMBERS[o->kind].real, begins = real || isdigit((unsigned char)**text); /* strtoull takes signs too */
    char *end;
    *out = real ? strtod(*text, &end) : (double)strtoull(*text, &end, 10);
    bool found = begins && end != *text;
    *text = end;
    if (found && o->kind == OPTION_TIME)
        *out *= scan_unit(text);
    return found && *out >= o->low && *out <= o->high;
}

static bool expected(struct reader *r, const char *text)
{
    const struct option *o = r->option;
    bool several = NUMBERS[o->kind].n > 1, real = NUMBERS[o->kind].real;
    return error_set(r->err, "%s %s: expected %s%s from %.10g to %.10g%s", o->name, text, several ? o->value : "",
                     several ? real ? ", numbers" : ", integers" : real ? "a number" : "an integer", o->low, o->high,
                     o->kind == OPTION_TIME ? ", of seconds, or with a unit: 90s, 5m, 1h" : "");
}

/* What is not there but need not be is 0. */
static bool scan_numbers(struct reader *r, double out[MOST_NUMBERS])
{
    const struct numbers *shape = &NUMBERS[r->option->kind];
    const char *text, *at;
    if (!next_value(r, &text))
        return false;
    at = text;
    bool ok = scan_number(&at, r->option, &out[0]);
    for (int i = 1; i < shape->n && ok; i++) {
        out[i] = 0;
        if (*at == '\0' && i >= shape->least)
            return true;
        if (*at == '\0' && r->option->kind == OPTION_WINDOW) {
            if (!next_value(r, &text))
                return false;
            at = text;
        } else {
            ok = *at == shape->between;
            at += ok;
        }
        ok = ok && scan_number(&at, r->option, &out[i]);
    }
    return (ok && *at == '\0') || expected(r, text);
}

static bool fit_together(const struct option *o, const double *v, struct error *err)
{
    const struct numbers *shape = &NUMBERS[o->kind];
    struct error why;
    for (int i = 1; shape->rising && i < shape->n; i += 2)
        if (!(v[i - 1] < v[i]))
            return error_set(err, "%s: there is nothing between %.10g and %.10g", o->name, v[i - 1], v[i]);
    return shape->between != 'x' || v[1] == 0 || picture_size_ok((uint64_t)v[0], (uint64_t)v[1], &why) ||
           error_set(err, "%s: %s", o->name, why.text);
}

static bool read_numbers(struct reader *r, void *target)
{
    double v[MOST_NUMBERS];
    if (!scan_numbers(r, v) || !fit_together(r->option, v, r->err))
        return false;
    for (int i = 0; i < NUMBERS[r->option->kind].n; i++)
        if (NUMBERS[r->option->kind].real)
            ((double *)target)[i] = v[i];
        else
            ((int *)target)[i] = (int)v[i];
    return true;
}

static bool read_seed(struct reader *r, uint64_t *out)
{
    const char *text;
    char *end;
    if (!next_value(r, &text))
        return false;
    errno = 0;
    uint64_t seed = strtoull(text, &end, 10);
    if (!isdigit((unsigned char)*text) || *end != '\0' || errno != 0)
        return error_set(r->err, "%s %s: expected a whole number from 0 to 18446744073709551615", r->option->name,
                         text);
    *out = seed;
    return true;
}

/* A text; of an option with words one of these. */
static bool read_text(struct reader *r, const char **out)
{
    const char *const *words = r->option->kind == OPTION_WORD ? r->option->words : NULL, *text;
    char list[NAMES_TEXT];
    if (!next_value(r, &text))
        return false;
    if (words != NULL && names_find(words, text) < 0)
        return error_set(r->err, "%s %s: expected %s%s", r->option->name, text, names_list(words, list),
                         near_of(text, words).text);
    *out = text;
    return true;
}

static bool read_pair(struct reader *r, struct settings *pairs)
{
    const char *text, *equals;
    if (!next_value(r, &text))
        return false;
    equals = strchr(text, '=');
    if (equals == NULL || equals == text)
        return error_set(r->err, "%s %s: expected name=value", r->option->name, text);
    char *name = mem_copy_text(text);
    name[equals - text] = '\0';
    settings_set(pairs, name, equals + 1, r->option->name);
    free(name);
    return true;
}

static bool read_texts(struct reader *r, struct texts *texts)
{
    const char *text;
    do {
        if (!next_value(r, &text))
            return false;
        texts_add(texts, text);
    } while (r->option->kind == OPTION_LIST && r->at + 1 < r->argc && !looks_like_option(r->argv[r->at + 1]));
    return true;
}

static bool read_value(struct reader *r, void *target)
{
    enum option_kind kind = r->option->kind;
    if (kind == OPTION_ELSEWHERE)
        return error_set(r->err, "%s: %s", r->option->name, r->option->help);
    if (kind == OPTION_ON)
        return *(bool *)target = true;
    if (kind == OPTION_SEED)
        return read_seed(r, target);
    if (kind == OPTION_PAIRS)
        return read_pair(r, target);
    if (kind == OPTION_TEXT || kind == OPTION_WORD)
        return read_text(r, target);
    return is_texts(r->option) ? read_texts(r, target) : read_numbers(r, target);
}

/* --- options ------------------------------------------------------------------------------------------ */

static bool is_called(const char *name, const char *argument, size_t length)
{
    return name != NULL && strncmp(name, argument, length) == 0 && name[length] == '\0';
}

/* The row of a name that ends after `length` letters, or NULL. */
static const struct option *find(const struct option *table, const char *argument, size_t length)
{
    const struct option *o = table;
    while (o != NULL && !is_called(o->name, argument, length) && !is_called(o->alias, argument, length))
        o = options_next(o);
    return o;
}

/* No option. Of its name only as much is compared as the longest name may have. */
static bool unknown(struct reader *r, const char *argument, size_t length)
{
    char name[NEAR_LONGEST + 2];
    snprintf(name, sizeof name, "%.*s", length < sizeof name ? (int)length : NEAR_LONGEST + 1, argument);
    struct near near = near_start(name);
    for (const struct option *o = r->table; o != NULL; o = options_next(o)) {
        near_try(&near, o->name[0] == '-' ? o->name : NULL);
        near_try(&near, o->alias);
    }
    return error_set(r->err, "unknown option %s%s", argument, near.text);
}

static bool read_option(struct reader *r, void *target)
{
    const char *argument = r->argv[r->at];
    size_t length = argument[1] == '-' ? strcspn(argument, "=") : 2; /* of the name */
    const struct option *o = find(r->table, argument, length);
    if (o == NULL)
        return unknown(r, argument, length);
    r->option = o;
    r->attached = argument[length] == '\0' ? NULL : argument + length + (argument[length] == '=');
    if (!read_value(r, target_of(o, target)))
        return false;
    return r->attached == NULL || error_set(r->err, "%s: %s takes no value", argument, o->name);
}

/* The texts that an option has, *n of them. */
static const char *const *texts_of(const struct option *o, void *target, int *n)
{
    const struct texts *texts = target_of(o, target);
    const char *const *one = target_of(o, target);
    *n = is_texts(o) ? texts->n : *one != NULL;
    return is_texts(o) ? (const char *const *)texts->item : one;
}

static bool is_given(const struct option *o, void *target)
{
    int n;
    texts_of(o, target, &n);
    return n > 0;
}

/* Operands fill their rows in order; a list takes all that are left. */
static bool read_operand(struct reader *r, void *target)
{
    const struct option *o = r->table;
    while (o != NULL && !(is_operand(o) && (is_texts(o) || !is_given(o, target))))
        o = options_next(o);
    if (o == NULL)
        return error_set(r->err, "%s is one argument too many", r->argv[r->at]);
    r->option = o;
    r->attached = r->argv[r->at];
    return read_value(r, target_of(o, target));
}

/* Is everything there that must be? */
static bool is_complete(const struct reader *r, void *target)
{
    for (const struct option *o = r->table; o != NULL; o = options_next(o))
        if ((is_texts(o) || o->kind == OPTION_TEXT) && o->low > 0 && !is_given(o, target))
            return error_set(r->err, "%s needs %s (%s)", r->argv[0], o->help, o->name);
    return true;
}

static bool read_all(struct reader *r, void *target)
{
    bool ok = true;
    for (r->at = 1; ok && r->at < r->argc; r->at++)
        ok = looks_like_option(r->argv[r->at]) ? read_option(r, target) : read_operand(r, target);
    return ok;
}

bool options_add(const struct option *table, int argc, char **argv, void *target, struct error *err)
{
    struct reader r = {.table = table, .argc = argc, .argv = argv, .err = err};
    return read_all(&r, target);
}

bool options_read(const struct option *table, int argc, char **argv, void *target, struct error *err)
{
    struct reader r = {.table = table, .argc = argc, .argv = argv, .err = err};
    bool ok = true;
    for (const struct option *o = table; ok && o != NULL; o = options_next(o)) {
        r.option = o;
        r.attached = o->fallback;
        ok = o->fallback == NULL || read_value(&r, target_of(o, target));
    }
    return ok && read_all(&r, target) && is_complete(&r, target);
}

void options_written(const struct option *table, void *target, struct texts *names)
{
    for (const struct option *o = table; o != NULL; o = options_next(o)) {
        int n = 0;
        const char *const *text = o->written ? texts_of(o, target, &n) : NULL;
        for (int i = 0; i < n; i++)
            texts_add(names, text[i]);
    }
}

void options_free(const struct option *table, void *target)
{
    for (const struct option *o = table; o != NULL; o = options_next(o))
        if (is_texts(o))
            free(((struct texts *)target_of(o, target))->item);
        else if (o->kind == OPTION_PAIRS)
            settings_clear(target_of(o, target));
}

/* --- help --------------------------------------------------------------------------------------------- */

void print_wrapped(const char *text, int column, int indent)
{
    enum { COLUMNS = 100 };
    for (const char *word = text; *word != '\0';) {
        int n = (int)strcspn(word, " ");
        if (column > indent && column + 1 + n > COLUMNS) {
            printf("\n%*s", indent, "");
            column = indent;
        } else if (word != text) {
            printf(" ");
            column++;
        }
        printf("%.*s", n, word);
        column += n;
        word += n + (word[n] == ' ');
    }
    printf("\n");
}

void options_print(const struct option *table)
{
    enum { HELP = 30 }; /* the column where the help begins */
    for (const struct option *o = table; o != NULL; o = options_next(o)) {
        if (o->kind == OPTION_ELSEWHERE)
            continue;
        char left[80], list[NAMES_TEXT], right[300 + NAMES_TEXT];
        bool fallback = o->fallback != NULL && o->fallback[0] != '\0';
        const char *values = o->list != NULL ? o->list(list) : o->words != NULL ? names_list(o->words, list) : "";
        snprintf(left, sizeof left, "%s%s%s %s", o->name, o->alias != NULL ? ", " : "",
                 o->alias != NULL ? o->alias : "", o->value != NULL ? o->value : "");
        snprintf(right, sizeof right, "%s%s%s%s%s%s", o->help, values[0] != '\0' ? ": " : "", values,
                 fallback ? " (default " : "", fallback ? o->fallback : "", fallback ? ")" : "");
        int width = printf("    %-25s ", left);
        if (width > HELP)
            printf("\n%*s", HELP, "");
        print_wrapped(right, HELP, HELP);
    }
}
