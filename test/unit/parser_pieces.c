/* parser_pieces.c: what the parser is made of: names, numbers against strtod, spectra, messages. */
#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/rng.h"
#include "helpers.h"
#include "parser/lexer.h"
#include "parser/parser.h"
#include "parser/spectrum.h"
#include "parser/symbols.h"
#include "parser_parts.h"

/* More names than chains: all are found, the newest first, and forgotten again. */
static void check_symbols(struct test *t)
{
    enum { N = 5000 };
    struct symbols table = {0};
    char name[32];
    int wrong = 0;
    for (int i = 0; i < 2 * N; i++) {
        snprintf(name, sizeof name, "%d", i % N);
        wrong += symbols_find(&table, name) != (i < N ? -1 : i - N);
        symbols_add(&table, name, i);
    }
    symbols_forget(&table, N);
    for (int i = 0; i < N; i++) {
        snprintf(name, sizeof name, "%d", i);
        wrong += symbols_find(&table, name) != i;
    }
    symbols_free(&table);
    CHECK(t, wrong == 0 && symbols_find(&table, "0") == -1, "%d names are wrong", wrong);
}

/* Any character ends a number of an .spd file that is no part of one, and a heading is passed over. */
static void check_spectrum_files(struct test *t)
{
    for (int c = 1; c < 256; c++) {
        char path[256], text[64];
        struct scene scene;
        if (strchr("0123456789.+-eE#", c) != NULL)
            continue;
        snprintf(path, sizeof path, "%s/any.spd", test_tmp(t));
        snprintf(text, sizeof text, "Wave Value%c\n# 1 2\n400%c1\r\n%c7e+2%c%c1.0", c, c, c, c, c);
        write_bytes(path, text, strlen(text));
        if (!scene_from_text(t, "WorldBegin LightSource \"point\" \"spectrum I\" \"any.spd\" WorldEnd", &scene))
            return;
        rgb L = scene.lights.light[0].L;
        CHECK(t, fabs(L.r - 1.20028) < 1e-5 && fabs(L.g - 0.949689) < 1e-6, "with character %d it is %g %g", c, L.r, L.g);
        scene_free(&scene);
    }
}

/* A line ends in LF, CR LF or CR, and counts once; a comment ends with it. */
static void check_line_ends(struct test *t)
{
    static const char *const END[] = {"\n", "\r\n", "\r"};
    for (int i = 0; i < 3; i++) {
        char text[64];
        struct arena arena = {NULL, NULL};
        struct messages messages = {0};
        snprintf(text, sizeof text, "1%s# 7%s%s2", END[i], END[i], END[i]);
        struct source_file file = {"lines", text, text + strlen(text), false};
        struct lexer l = {.arena = &arena, .messages = &messages};
        double number[2] = {0, 0};
        lexer_enter(&l, &file);
        bool ok = lexer_number(&l, &number[0]) && lexer_number(&l, &number[1]);
        CHECK(t, ok && number[1] == 2 && l.line == 4, "ends of kind %d: %g in line %d", i, number[1], l.line);
    }
}

/* One number through the lexer. */
static bool lex_number(const char *text, double *out)
{
    struct arena arena = {NULL, NULL};
    struct messages messages = {0};
    char *copy = mem_copy_text(text);
    struct source_file file = {"number", copy, copy + strlen(copy), true};
    struct lexer l = {.arena = &arena, .messages = &messages};
    lexer_enter(&l, &file);
    bool ok = lexer_number(&l, out) && lexer_peek(&l) == TOKEN_END;
    lexer_leave(&l);
    return ok;
}

static void check_numbers(struct test *t)
{
    static const char *const FORMAT[] = {"%.3f", "%.6g", "%.9g", "%.17g", "%.20e", "%+.2e", "%.0f", "%.25f"};
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 1, 0);
    int wrong = 0;
    for (int i = 0; i < 40000; i++) {
        char text[512];
        double x = (rng_uniform(&r) - .5) * pow(10, floor(rng_uniform(&r) * 60) - 30), got = 0;
        snprintf(text, sizeof text, FORMAT[i % 8], x);
        if (!lex_number(text, &got) || got != strtod(text, NULL))
            if (wrong++ == 0)
                CHECK(t, false, "%s is read as %.17g", text, got);
    }
    CHECK(t, wrong == 0, "%d numbers are not read as strtod reads them", wrong);
    static const char *const BAD[] = {"", ".", "-", "+.", "1e", "1e+", "--1", "1.2.3", "1f", "e5", "inf"};
    double got;
    for (size_t i = 0; i < sizeof BAD / sizeof BAD[0]; i++)
        CHECK(t, !lex_number(BAD[i], &got), "'%s' is not a number", BAD[i]);
    CHECK(t, lex_number("0x10", &got) && got == 16, "as strtod, and pbrt-v3, read it");
    CHECK(t, lex_number("-0", &got) && got == 0 && signbit(got), "-0 keeps its sign");
}

static bool within(rgb c, double r, double g, double b, double most)
{
    return fabs(c.r - r) <= most && fabs(c.g - g) <= most && fabs(c.b - b) <= most;
}

/* Expected colours were computed with the CIE 1931 tables in steps of 1 nm, scaled to Y = 1 for a constant spectrum. */
static void check_spectra(struct test *t)
{
    double flat[1][2] = {{500, 1}}, unsorted[4][2] = {{700, .6}, {500, .9}, {600, .2}, {400, .1}};
    double mixed[4][2] = {{700, 1}, {500, 1}, {500, 0}, {400, 0}}, up[4][2] = {{400, 0}, {500, 0}, {500, 1}, {700, 1}};
    double down[4][2] = {{400, 1}, {500, 1}, {500, 0}, {700, 0}};
    rgb whole = spectrum_from_samples(flat, 1), a = spectrum_from_samples(mixed, 4), b = spectrum_from_samples(up, 4);
    CHECK(t, fabs(rgb_luminance(whole) - 1) < 1e-4, "a constant spectrum has Y = its value");
    CHECK(t, within(spectrum_blackbody(3000, 1), 0.73663, 0.35123, 0.11322, 0.01), "3000 K");
    CHECK(t, within(spectrum_blackbody(6500, 1), 0.92418, 0.87135, 0.91716, 0.01), "6500 K");
    CHECK(t, rgb_is_black(spectrum_blackbody(0, 1)), "0 K is black");
    CHECK(t, within(spectrum_from_samples(unsorted, 4), .1745, .6016, .4721, 0.01), "unsorted samples");
    CHECK(t, within(a, b.r, b.g, b.b, 0), "a step whose samples are out of order goes up");
    a = rgb_add(spectrum_from_samples(down, 4), b);
    CHECK(t, within(a, whole.r, whole.g, whole.b, 1e-9), "steps up and down are the whole");
}

/* --- what reaches the terminal ------------------------------------------------------------------------- */

static void check_cleaning(struct test *t)
{
    static const char *const TEXTS[][2] = {
        {"plain ~", "plain ~"},
        {"\x1b[31m\x7f\a\n\r", "?[31m????"},
        {"gr\xc3\xbcn \xe2\x82\xac \xf0\x9f\x98\x80", "gr\xc3\xbcn \xe2\x82\xac \xf0\x9f\x98\x80"},
        {"latin gr\xfcn", "latin gr?n"},
        {"control \xc2\x9b" "1m, cut \xe2\x82", "control ??1m, cut ??"},
        {"overlong \xc0\x9b \xe0\x82\x9b, surrogate \xed\xa0\x80", "overlong ?? ???, surrogate ???"},
        {"beyond \xf4\x90\x80\x80 \xf8\x88\x80\x80\x80", "beyond ???? ?????"}};
    for (size_t i = 0; i < sizeof TEXTS / sizeof TEXTS[0]; i++) {
        struct error err;
        error_set(&err, "%s", TEXTS[i][0]);
        CHECK(t, strcmp(err.text, TEXTS[i][1]) == 0, "text %d is cleaned to \"%s\"", (int)i, err.text);
    }
}

/* A name in UTF-8 is quoted as it is, an escape sequence is not; a byte is a column. */
static void check_odd_bytes(struct test *t)
{
    static const char TEXT_OF[] = "WorldBegin\n Include \"gr\xc3\xbcn\x1b[31m\\n\xff\" # \xc3\xa9\nWorldEnd\n";
    char path[TEXT], want[2 * TEXT];
    snprintf(path, sizeof path, "%s/odd.pbrt", test_tmp(t));
    write_bytes(path, TEXT_OF, sizeof TEXT_OF - 1);
    struct error err = {.text = ""};
    struct scene s;
    CHECK(t, !parse_scene(path, NULL, &s, NULL, &err), "an odd name is accepted");
    snprintf(want, sizeof want, "%s:2:10: %s/gr\xc3\xbcn?[31m\\n?: cannot open", path, test_tmp(t));
    CHECK(t, strncmp(err.text, want, strlen(want)) == 0, "a name of odd bytes, expected %s, got\n%s", want, err.text);
    write_bytes(path, "\xEF\xBB\xBFWorldBegin", 13);
    CHECK(t, !parse_scene(path, NULL, &s, NULL, &err) && strstr(err.text, ":1:1: a byte order mark that") != NULL, "%s",
          err.text);
}

void check_parser_pieces(struct test *t)
{
    check_symbols(t);
    check_numbers(t);
    check_spectrum_files(t);
    check_line_ends(t);
    check_spectra(t);
    check_cleaning(t);
    check_odd_bytes(t);
}
