/* test_parser.c: scene files: every directive and type is read, every error is found at its line and column.
 *
 * test/data/fixtures/scenes.txt is a list of scenes, as lists.h reads it. Every scene says in its first line what must
 * come of it: "# expect: ok", or LINE:COL and what the message of the first error holds, words with " ... " between
 * them where others come; further lines "# also: ..." say so of the other errors and "# warn: ..." of the warnings, in
 * order, "# has: ..." parts of what a scene holds (parser_words.c), "# mean: ..." the mean of its image of 8x8 pixels,
 * "# integrator: ..." the one that the user names, and "# row: ..." a row of a table that it shows (test_format.c).
 * Damaged scenes, which must be accepted or refused and never crash, are in test_hostile.c.
 */
#define _POSIX_C_SOURCE 200809L

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "parser/parse.h"
#include "parser/parser.h"
#include "parser/scene_files.h"
#include "base/mem.h"
#include "fuzz/lists.h"
#include "helpers.h"
#include "parser_parts.h"
#include "suites.h"

enum { MAX_FIXTURES = 400 };

/* Scenes; their files are made in the test's own directory. */
struct fixtures {
    struct list_file scene[MAX_FIXTURES];
    int n;
    char *all, *shown; /* what the texts lie in */
};

/* The scenes, and the one that doc/scene-format.md shows. */
static void read_fixtures(struct fixtures *f)
{
    struct error err;
    size_t size, shown_size = 0;
    f->all = text_read("test/data/fixtures/scenes.txt", &size, &err);
    f->shown = text_read("test/data/fixtures/errors-several.pbrt", &shown_size, &err);
    if (f->all == NULL || f->shown == NULL)
        return;
    for (const char *at = f->all; f->n + 1 < MAX_FIXTURES && list_next(&at, &f->scene[f->n]); f->n++)
        ;
    f->scene[f->n++] = (struct list_file){"errors-several.pbrt", f->shown, shown_size, false};
}

/* The file of a fixture, or of what has become of it. */
static void write_scene(struct test *t, char path[TEXT], const char *name, const void *text, size_t size)
{
    snprintf(path, TEXT, "%s/%s", test_tmp(t), name);
    remove(path); /* a new file is cheaper than an old one cut to nothing */
    write_bytes(path, text, size);
}

void link_parts(struct test *t)
{
    static const char *const FOLDERS[][2] = {
        {"test/data/fixtures/parts", "parts"}, {"test/data/fixtures/pictures", "pictures"},
        {"scenes/features", "features"}};
    char path[TEXT];
    struct error err;
    for (size_t i = 0; i < sizeof FOLDERS / sizeof FOLDERS[0]; i++) {
        snprintf(path, sizeof path, "%s/%s", test_tmp(t), FOLDERS[i][1]);
        CHECK(t, list_unpack(FOLDERS[i][0], path, &err), "%s", err.text);
    }
}

void hear_message(void *context, bool is_error, const char *text)
{
    struct hearing *all = context;
    struct heard *h = is_error ? &all->errors : &all->warnings;
    if (h->n < MAX_WARNINGS)
        snprintf(h->text[h->n++], TEXT, "%s", text);
}

/* Paths become what they are in test/data/fixtures. */
void leave_out_directory(struct test *t, char *text)
{
    char directory[TEXT];
    size_t n = (size_t)snprintf(directory, sizeof directory, "%s/", test_tmp(t));
    while ((text = strstr(text, directory)) != NULL)
        memmove(text, text + n, strlen(text + n) + 1);
}

/* The comment "# KEY: value" number k at the head of the text; empty if there are fewer. */
static void head_comment(const char *text, const char *key, int k, char out[TEXT])
{
    char start[32];
    snprintf(start, sizeof start, "# %s: ", key);
    out[0] = '\0';
    for (const char *line = text; *line == '#'; line = strchr(line, '\n') + 1) {
        if (strncmp(line, start, strlen(start)) == 0 && k-- == 0) {
            snprintf(out, TEXT, "%.*s", (int)strcspn(line + strlen(start), "\n"), line + strlen(start));
            return;
        }
        if (strchr(line, '\n') == NULL)
            return;
    }
}

/* --- expectations --------------------------------------------------------------------------------------- */

/* Are the words in the message, in this order? */
static bool holds(const char *message, const char *words)
{
    static const char GAP[] = " ... ";
    const char *gap = strstr(words, GAP);
    char part[TEXT];
    snprintf(part, sizeof part, "%.*s", gap != NULL ? (int)(gap - words) : TEXT - 1, words);
    const char *at = strstr(message, part);
    return at != NULL && (gap == NULL || holds(at + strlen(part), gap + strlen(GAP)));
}

static void check_refusal(struct test *t, const char *name, const char *path, const char *expect, const char *message)
{
    char file[TEXT], where[3 * TEXT];
    int line = 0, column = 0, used = 0;
    bool other_file = sscanf(expect, "%d:%d: %n", &line, &column, &used) != 2;
    if (other_file && sscanf(expect, "%511[^:]:%d:%d: %n", file, &line, &column, &used) == 3)
        snprintf(where, sizeof where, "%s/%s:%d:%d: ", test_tmp(t), file, line, column);
    else
        snprintf(where, sizeof where, "%s:%d:%d: ", path, line, column);
    CHECK(t, strncmp(message, where, strlen(where)) == 0, "%s: expected %s, got\n%s", name, where, message);
    CHECK(t, holds(message, expect + used), "%s: expected \"%s\", got\n%s", name, expect + used, message);
}

/* Messages from number `first` on against the lines "# KEY: ..." of the head. */
static void check_heard(struct test *t, const char *name, const char *text, const char *key, struct heard *heard,
                        int first)
{
    char expect[TEXT];
    int i = first;
    for (; i < heard->n; i++) {
        head_comment(text, key, i - first, expect);
        leave_out_directory(t, heard->text[i]);
        CHECK(t, expect[0] != '\0' && holds(heard->text[i], expect), "%s: said \"%s\", expected \"%s\"", name,
              heard->text[i], expect);
    }
    head_comment(text, key, i - first, expect);
    CHECK(t, expect[0] == '\0', "%s: nothing said of \"%s\"", name, expect);
}

/* The mean of all pixels by pt and by bdpt is so much, within a thousandth and 4.5 standard errors. */
static void check_mean(struct test *t, const char *name, const char *expect, struct scene *s)
{
    static const char *const METHODS[] = {"pt", "bdpt"};
    double want = strtod(expect, NULL), error;
    s->width = s->height = 8;
    scene_prepare(s);
    for (int i = 0; i < 2; i++) {
        struct batches b = render_batches(t, s, METHODS[i], 0, 16, 16, 8, test_seed(t));
        double mean = batches_mean(&b, &error);
        CHECK(t, fabs(mean - want) <= 0.001 * want + 4.5 * error && error < 0.02 * want,
              "%s: %s gives %g +- %g, not %g", name, METHODS[i], mean, error, want);
        batches_free(&b);
    }
}

static void check_fixture(struct test *t, const struct list_file *f)
{
    char path[TEXT], expect[TEXT], integrator[TEXT], *text = mem_alloc(f->size + 1, 1);
    const char *name = f->name;
    memcpy(text, f->text, f->size);
    write_scene(t, path, name, text, f->size);
    struct error err = {.text = ""};
    struct scene s;
    struct hearing *heard = mem_alloc(1, sizeof *heard);
    struct message_sink sink = {hear_message, heard};
    head_comment(text, "integrator", 0, integrator);
    const struct parse_options options = {.integrator = integrator[0] != '\0' ? integrator : NULL};
    bool ok = parse_scene(path, &options, &s, &sink, &err);
    head_comment(text, "expect", 0, expect);
    if (strcmp(expect, "ok") == 0)
        CHECK(t, ok, "%s: refused:\n%s", name, err.text);
    else if (CHECK(t, !ok, "%s: accepted, but expected: %s", name, expect))
        check_refusal(t, name, path, expect, err.text);
    CHECK(t, ok == (heard->errors.n == 0), "%s: %d errors", name, heard->errors.n);
    CHECK(t, ok || strncmp(heard->errors.text[0], err.text, TEXT - 1) == 0, "%s: the first error is another", name);
    CHECK(t, strstr(err.text, "secret") == NULL, "%s: a line of what is no scene is quoted:\n%s", name, err.text);
    check_heard(t, name, text, "also", &heard->errors, 1);
    check_heard(t, name, text, "warn", &heard->warnings, 0);
    if (ok) {
        check_contents(t, name, text, &s);
        head_comment(text, "mean", 0, expect);
        if (expect[0] != '\0')
            check_mean(t, name, expect, &s);
        scene_free(&s);
    }
    free(heard);
    free(text);
}

void test_parser(struct test *t)
{
    struct fixtures *f = mem_alloc(1, sizeof *f);
    read_fixtures(f);
    link_parts(t);
    if (CHECK(t, f->n >= 200, "only %d scenes in test/data/fixtures: run the tests at the top of the tree", f->n))
        for (int i = 0; i < f->n; i++)
            check_fixture(t, &f->scene[i]);
    free(f->all);
    free(f->shown);
    free(f);
    check_parser_pieces(t);
    check_parser_limits(t);
    struct error err;
    struct scene s;
    CHECK(t,
          !parse_scene("test/data/fixtures/none.pbrt", NULL, &s, NULL, &err) &&
              strstr(err.text, "none.pbrt: cannot open") != NULL,
          "a missing file");
    CHECK(t, !parse_scene("test/data/fixtures", NULL, &s, NULL, &err) &&
                 !parse_scene("test/data/fixtures/none.pbrt", NULL, &s, NULL, NULL),
          "a directory; nobody listens");
}
