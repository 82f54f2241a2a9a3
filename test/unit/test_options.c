/* test_options.c: the reader of options (library/options.h): every kind of option, its bounds, and what is refused and
 * why. Every row of a subcommand's table is read into its struct. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "cli/command.h"
#include "suites.h"

struct target {
    bool on;
    int integer, size[2], width[2], range[2];
    uint64_t seed;
    double number, window[4], lengths[2];
    double time;
    const char *text, *image, *word;
    struct texts texts, list, rest;
    struct settings pairs;
};

static const struct option SHARED[] = {
    {"--list", "FILE...", OPTION_LIST, offsetof(struct target, list), .help = "a list"},
    {"--seed", "N", OPTION_SEED, offsetof(struct target, seed), .fallback = "7", .help = "a seed"},
    {.name = NULL},
};

static const char *const WORDS[] = {"one", "two", "three", NULL};

static const struct option TABLE[] = {
    {"IMAGE", NULL, OPTION_TEXT, offsetof(struct target, image), .help = "a picture"},
    {"REST", NULL, OPTION_TEXTS, offsetof(struct target, rest), .help = "others"},
    {"--on", NULL, OPTION_ON, offsetof(struct target, on), .help = "on"},
    {"--integer", "N", OPTION_INTEGER, offsetof(struct target, integer), 2, 1 << 30, .alias = "-i", .help = "integer"},
    {"--number", "X", OPTION_NUMBER, offsetof(struct target, number), -0.5, 2, .fallback = "1.5", .help = "a number"},
    {"--time", "TIME", OPTION_TIME, offsetof(struct target, time), 0.5, 7200, .help = "a duration"},
    {"--window", "X0 X1 Y0 Y1", OPTION_WINDOW, offsetof(struct target, window), 0, 1, .help = "a window"},
    {"--range", "FIRST:END", OPTION_RANGE, offsetof(struct target, range), 0, 100, .help = "a range"},
    {"--lengths", "L0:L1", OPTION_LENGTHS, offsetof(struct target, lengths), 0, 1e9, .help = "lengths"},
    {"--size", "WIDTH[xHEIGHT]", OPTION_WIDTH, offsetof(struct target, size), 1, 65536, .help = "a size"},
    {"--width", "WIDTH[xHEIGHT]", OPTION_WIDTH, offsetof(struct target, width), 1, 65536, .help = "a width"},
    {"--word", "NAME", OPTION_WORD, offsetof(struct target, word), .help = "a word", .words = WORDS},
    {"--text", "TEXT", OPTION_TEXT, offsetof(struct target, text), .alias = "-t", .help = "a text"},
    {"--texts", "TEXT", OPTION_TEXTS, offsetof(struct target, texts), .help = "texts"},
    {"-P", "NAME=VALUE", OPTION_PAIRS, offsetof(struct target, pairs), .help = "pairs"},
    {.others = SHARED},
};

enum { MOST_WORDS = 64 };

/* Read a command line, words between blanks, "test" in front; `words` holds the text while the target is used. */
static bool read_line(const struct option *table, const char *line, char *words, void *out, struct error *err)
{
    char *argv[MOST_WORDS] = {"test"};
    int argc = 1;
    strcpy(words, line);
    for (char *word = strtok(words, " "); word != NULL && argc < MOST_WORDS; word = strtok(NULL, " "))
        argv[argc++] = word;
    return options_read(table, argc, argv, out, err);
}

static void check_accepted(struct test *t)
{
    struct target o = {0};
    struct error err = {.text = ""};
    char words[1024];
    CHECK(t, read_line(TABLE, "", words, &o, &err), "%s", err.text);
    CHECK(t, o.seed == 7 && o.number == 1.5 && o.image == NULL && o.integer == 0, "the fallbacks, and zeros");
    bool ok = read_line(TABLE, "a.png --on --integer=2 --number -0.5 --window 0 1 0.25 1e0 --size 65536x4096 "
                        "--width 65536 b c --range 0:100 --seed=18446744073709551615 -i1073741824 --text -x",
                        words, &o, &err);
    if (!CHECK(t, ok, "%s", err.text))
        return;
    CHECK(t, o.on && o.integer == 1 << 30 && o.number == -0.5, "flag, integer at its upper bound, number at its lower");
    CHECK(t, o.window[0] == 0 && o.window[1] == 1 && o.window[2] == 0.25 && o.window[3] == 1, "window");
    CHECK(t, o.size[0] == 65536 && o.size[1] == 4096 && o.width[0] == 65536 && o.width[1] == 0, "sizes");
    CHECK(t, o.seed == UINT64_MAX && strcmp(o.text, "-x") == 0, "seed, and a value that looks like an option");
    CHECK(t, strcmp(o.image, "a.png") == 0 && o.rest.n == 2 && strcmp(o.rest.item[1], "c") == 0, "operands in order");
    CHECK(t, o.range[0] == 0 && o.range[1] == 100, "a range");
    options_free(TABLE, &o);
    memset(&o, 0, sizeof o);
    ok = read_line(TABLE, "--on --window=0,0.5,0.25,1 --width 3x4 --texts 1 --texts=2=3 -Pa=b -P c= --list x - y -t=- "
                   "-i 2 --number=2 --time .5m --word=two", words, &o, &err);
    if (!CHECK(t, ok, "%s", err.text))
        return;
    CHECK(t, o.on && o.window[1] == 0.5 && o.window[3] == 1 && o.width[1] == 4, "window with commas, height");
    CHECK(t, o.texts.n == 2 && strcmp(o.texts.item[1], "2=3") == 0, "only the first = belongs to the option");
    CHECK(t, o.pairs.n == 2 && strcmp(o.pairs.item[0].name, "a") == 0 && strcmp(o.pairs.item[0].value, "b") == 0 &&
          strcmp(settings_find(&o.pairs, "c")->value, "") == 0, "pairs");
    CHECK(t, o.list.n == 3 && strcmp(o.list.item[1], "-") == 0, "a list ends at the next option; - is none");
    CHECK(t, strcmp(o.text, "-") == 0 && o.integer == 2 && o.number == 2, "a value behind =; other bounds");
    CHECK(t, strcmp(o.word, "two") == 0 && o.time == 30, "half a minute is %g s", o.time);
    options_free(TABLE, &o);
}

static void check_refused(struct test *t)
{
    static const struct {
        const char *line, *message; /* the message holds this */
    } WRONG[] = {
        {"--range 3", "expected FIRST:END, integers from 0 to 100"},
        {"--range 3:101", "expected FIRST:END, integers from 0 to 100"},
        {"--range -1:4", "expected FIRST:END, integers from 0 to 100"},
        {"--range 3:3", "nothing between 3 and 3"},
        {"--lengths 3:2", "nothing between 3 and 2"},
        {"--lengths 1:nan", "expected L0:L1, numbers from 0 to 1000000000"},
        {"--integer 1", "--integer 1: expected an integer from 2 to 1073741824"},
        {"--integer 1073741825", "expected an integer"},
        {"--integer 99999999999999999999", "expected an integer"},
        {"--integer +4", "expected an integer"},
        {"--integer 0x10", "expected an integer"},
        {"--integer=", "--integer: its value is empty"},
        {"-i4x", "expected an integer"},
        {"--number -0.6", "--number -0.6: expected a number from -0.5 to 2"},
        {"--number nan", "expected a number"},
        {"--on --time 3h", "--time 3h: expected a number from 0.5 to 7200, of seconds, or with a unit: 90s, 5m, 1h"},
        {"--on --time 3d", "expected a number"},
        {"--number inf", "expected a number"},
        {"--number 1e999", "expected a number"},
        {"--number x", "expected a number"},
        {"--window 0 1 0", "--window needs a value"},
        {"--window 0,1,0,1,0", "expected X0 X1 Y0 Y1"},
        {"--window 0,,0,1", "expected X0 X1 Y0 Y1"},
        {"--window 0 1 0 nan", "expected X0 X1 Y0 Y1, numbers from 0 to 1"},
        {"--window 0.5 0.5 0 1", "--window: there is nothing between"},
        {"--size 0", "expected WIDTH[xHEIGHT], integers from 1 to 65536"},
        {"--size 10x", "expected WIDTH[xHEIGHT]"},
        {"--size 4x18446744073709551617", "expected WIDTH[xHEIGHT]"},
        {"--size 0x10", "expected WIDTH[xHEIGHT]"},
        {"--size 60000x60000", "60000 x 60000 pixels are too many"},
        {"--width 65537", "expected WIDTH[xHEIGHT]"},
        {"--width 4x0", "expected WIDTH[xHEIGHT]"},
        {"--seed 18446744073709551616", "expected a whole number from 0 to 18446744073709551615"},
        {"--seed -1", "expected a whole number"},
        {"-P a", "expected name=value"},
        {"--word thre", "--word thre: expected \"one\", \"two\" or \"three\"; did you mean \"three\"?"},
        {"--text", "--text needs a value"},
        {"--list", "--list needs a value"},
        {"--on=1", "--on takes no value"},
        {"--integr 4", "unknown option --integr; did you mean \"--integer\"?"},
        {"--sede=4", "unknown option --sede=4; did you mean \"--size\"?"},
        {"--seedd=4", "unknown option --seedd=4; did you mean \"--seed\"?"},
        {"-p a", "unknown option -p; did you mean \"-P\"?"},
        {"--seeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeed=4", "unknown option --see"},
        {"--zzzzzzzzzz", "unknown option --zzzzzzzzzz"},
        {"--", "unknown option --"},
    };
    for (size_t i = 0; i < sizeof WRONG / sizeof WRONG[0]; i++) {
        struct target o = {0};
        struct error err = {.text = ""};
        char words[1024];
        CHECK(t, !read_line(TABLE, WRONG[i].line, words, &o, &err), "%s is wrong", WRONG[i].line);
        CHECK(t, strstr(err.text, WRONG[i].message) != NULL, "%s: %s", WRONG[i].line, err.text);
        options_free(TABLE, &o);
    }
}

static void check_required(struct test *t)
{
    static const struct option NEEDS[] = {
        {"IMAGE", NULL, OPTION_TEXT, offsetof(struct target, image), 1, .help = "a picture"},
        {"-o", "DIR", OPTION_TEXT, offsetof(struct target, text), 1, .help = "a directory"},
        {.name = NULL},
    };
    static const char *const WRONG[][2] = {{"-o x", "test needs a picture (IMAGE)"},
                                           {"x", "test needs a directory (-o)"},
                                           {"x -o y z", "z is one argument too many"}};
    for (int i = 0; i < 3; i++) {
        struct error err = {.text = ""};
        struct target o = {0};
        char words[64];
        CHECK(t, !read_line(NEEDS, WRONG[i][0], words, &o, &err), "%s is wrong", WRONG[i][0]);
        CHECK(t, strcmp(err.text, WRONG[i][1]) == 0, "%s", err.text);
    }
}

/* How many bytes the reader may write, and a value that it takes. */
static size_t target_size(const struct option *o, char *value, size_t size)
{
    snprintf(value, size, "%.10g", o->high);
    switch (o->kind) {
    case OPTION_ELSEWHERE:
    case OPTION_ON: value[0] = '\0'; return sizeof(bool);
    case OPTION_INTEGER: return sizeof(int);
    case OPTION_NUMBER:
    case OPTION_TIME: return sizeof(double);
    case OPTION_PIXEL: strcpy(value, "4,3"); return 2 * sizeof(int);
    case OPTION_WIDTH: strcpy(value, "4x3"); return 2 * sizeof(int);
    case OPTION_RANGE: strcpy(value, "3:7"); return 2 * sizeof(int);
    case OPTION_LENGTHS: strcpy(value, "3:7"); return 2 * sizeof(double);
    case OPTION_WINDOW: strcpy(value, "0.5 1 0 1"); return 4 * sizeof(double);
    case OPTION_SEED: strcpy(value, "5"); return sizeof(uint64_t);
    case OPTION_WORD: strcpy(value, o->words[0]); return sizeof(const char *);
    case OPTION_TEXT: strcpy(value, "x"); return sizeof(const char *);
    case OPTION_TEXTS:
    case OPTION_LIST:
    case OPTION_PAIRS: strcpy(value, "x=y"); return sizeof(struct settings);
    }
    return 0;
}

/* With what the subcommand needs, and the row itself: read, and its target is no longer what it was. */
static void check_row(struct test *t, const struct command *c, const struct option *row)
{
    char line[256] = "", words[256], value[64];
    size_t size = target_size(row, value, sizeof value);
    for (const struct option *o = c->options; o != NULL; o = options_next(o))
        if (o != row && o->low == 1 && (o->kind == OPTION_TEXT || o->kind == OPTION_TEXTS))
            strcat(strcat(line, o->name[0] == '-' ? o->name : ""), o->kind == OPTION_ON ? " " : " x ");
    for (int alias = 0; alias < (row->alias != NULL ? 2 : 1); alias++) {
        char whole[512];
        struct error err = {.text = ""};
        char *target = mem_alloc(1, c->size), *before = mem_alloc(1, c->size);
        const char *name = alias ? row->alias : row->name[0] == '-' ? row->name : "";
        snprintf(whole, sizeof whole, "%s%s %s", line, name, value);
        CHECK(t, row->offset + size <= c->size, "%s %s: the target lies outside the struct", c->name, row->name);
        CHECK(t, read_line(c->options, whole, words, target, &err), "%s %s: %s", c->name, whole, err.text);
        CHECK(t, memcmp(target + row->offset, before + row->offset, size) != 0,
              "%s %s: nothing is stored", c->name, whole);
        CHECK(t, (row->value != NULL) == (name[0] == '-' && value[0] != '\0'), "%s %s: help", c->name, row->name);
        options_free(c->options, target);
        free(target);
        free(before);
    }
}

void test_options(struct test *t)
{
    int rows = 0;
    check_accepted(t);
    check_refused(t);
    check_required(t);
    for (const struct command *const *c = program.commands; *c != NULL; c++)
        for (const struct option *o = (*c)->options; o != NULL; o = options_next(o), rows++)
            if (o->kind != OPTION_ELSEWHERE)
                check_row(t, *c, o);
    CHECK(t, rows > 50, "%d rows", rows);
}
