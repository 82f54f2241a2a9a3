/* test_file.c: images as files: written, read back, and every way in which this fails.
 *
 * Facts: what is written is read back, and is byte for byte what other programs expect. Faults: missing directories,
 * names without a known extension; nothing half-written is ever left behind. */
#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/mem.h"
#include "base/os.h"
#include "base/progress.h"
#include "base/rng.h"
#include "image/exr.h"
#include "image/image.h"
#include "lab/files.h"
#include "lab/numbers.h"
#include "helpers.h"
#include "suites.h"

/* A path in the directory for temporary files; valid until the next call with the same buffer. */
static const char *in_tmp(const struct test *t, const char *name, char *buffer, size_t size)
{
    snprintf(buffer, size, "%s/%s", test_tmp(t), name);
    return buffer;
}

/* A picture with a smooth part, noise, black, and numbers that are no light. */
static float *make_pixels(const struct test *t, int width, int height)
{
    static const float ODD[] = {-1, 0, 1e30f, -1e30f, 65504, 65520, 1e-7f, INFINITY, 1e-40f, 0.1f};
    float *p = mem_alloc((size_t)width * (size_t)height * 3, sizeof *p);
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 20, 0);
    for (int i = 0; i < width * height * 3; i++) {
        int x = i / 3 % width, y = i / 3 / width;
        double noise = ldexp(rng_uniform(&r), (int)rng_below(&r, 30) - 15);
        p[i] = i < 10 ? ODD[i] : (float)(y % 4 == 0 ? noise : y % 4 == 1 ? 0 : (x + 0.2 * (i % 3)) / width);
    }
    return p;
}

static void check_written(struct test *t, const char *name, int width, int height)
{
    char path[256];
    struct image img;
    struct error err = {.text = ""};
    float *p = make_pixels(t, width, height);
    bool halfs = file_has_extension(name, ".exr") && !file_has_extension(name, ".float.exr");
    in_tmp(t, name, path, sizeof path);
    write_bytes(path, "old", 3); /* is to be replaced */
    CHECK(t, image_write(path, width, height, p, &err), "%s", err.text);
    if (CHECK(t, image_read(path, NULL, &img, &err), "%s", err.text)) {
        CHECK(t, img.width == width && img.height == height && img.channels == 3, "%s: shape", name);
        int wrong = 0;
        for (int i = 0; i < width * height * 3; i++) {
            float kept = halfs ? half_to_float(float_to_half(p[i])) : p[i];
            bool same = img.u8 != NULL ? img.u8[i] == srgb_byte(p[i]) : img.f32[i] == kept;
            wrong += !same;
        }
        CHECK(t, wrong == 0, "%s, %d x %d: %d samples differ", name, width, height, wrong);
        CHECK(t, img.linear == (img.f32 != NULL), "%s: linear", name);
        image_free(&img);
    }
    CHECK(t, remove(path) == 0, "%s was there", path);
    free(p);
}

static void test_written(struct test *t)
{
    static const char *const NAMES[] = {"a.pfm", "a.float.exr", "a.exr", "a.EXR", "a.ppm", "a.png", "UPPER.PNG"};
    for (size_t i = 0; i < sizeof NAMES / sizeof NAMES[0]; i++) {
        check_written(t, NAMES[i], 1, 1);
        check_written(t, NAMES[i], 7, 1);
        check_written(t, NAMES[i], 1, 9);
        check_written(t, NAMES[i], 61, 47);
        check_written(t, NAMES[i], 300, 200);
    }
}

/* The very bytes that another program's reader expects. */
static void test_written_bytes(struct test *t)
{
    static const float PIXEL[6] = {1, 0, 2, -1, 0.5f, 0.25f};
    static const uint8_t PFM[] =
        "PF\n1 2\n-1.000000\n\0\0\x80\xbf\0\0\0\x3f\0\0\x80\x3e\0\0\x80\x3f\0\0\0\0\0\0\0\x40";
    static const uint8_t PPM[] = "P6\n1 2\n255\n\xff\0\xff\0\xbc\x89";
    static const struct {
        const char *name;
        const uint8_t *bytes;
        size_t n;
    } CASES[] = {{"b.pfm", PFM, sizeof PFM - 1}, {"b.ppm", PPM, sizeof PPM - 1}};
    for (size_t i = 0; i < 2; i++) {
        char path[256];
        uint8_t *data = NULL;
        size_t n = 0;
        struct error err = {.text = ""};
        in_tmp(t, CASES[i].name, path, sizeof path);
        CHECK(t, image_write(path, 1, 2, PIXEL, &err) && file_read(path, &data, &n, &err), "%s", err.text);
        CHECK(t, data != NULL && n == CASES[i].n && memcmp(data, CASES[i].bytes, n) == 0,
              "%s: other bytes than expected", CASES[i].name);
        CHECK(t, data != NULL && data[n] == 0, "%s: no zero byte behind the last", CASES[i].name);
        free(data);
        remove(path);
    }
}

static void check_no_write(struct test *t, const char *path, int size, const char *message)
{
    struct error err = {.text = ""};
    float *p = make_pixels(t, size, size);
    CHECK(t,
          !image_write(path, size, size, p, &err) && strstr(err.text, message) != NULL &&
              strncmp(err.text, path, strlen(path)) == 0,
          "%s: \"%s\" expected, got \"%s\"", path, message, err.text);
    free(p);
}

static void test_unwritable(struct test *t)
{
    char path[256];
    check_no_write(t, in_tmp(t, "none/a.png", path, sizeof path), 2, "cannot be created");
    check_no_write(t, in_tmp(t, "a.jpg", path, sizeof path), 2, "ends in one of .pfm");
    check_no_write(t, in_tmp(t, "a.pgm", path, sizeof path), 2, "ends in one of .pfm");
    check_no_write(t, in_tmp(t, "png", path, sizeof path), 2, "ends in one of .pfm");
    in_tmp(t, "dir.png", path, sizeof path);
    if (CHECK(t, os_make_directory(path), "%s cannot be made", path))
        check_no_write(t, path, 2, "cannot be");
    remove_tree(path);
    CHECK(t,
          image_writable("x.PFM") && image_writable("x.y.png") && !image_writable("x.pgm") && !image_writable(""),
          "image_writable");
}

/* A failure after the file was begun removes the temporary file and keeps the old one. */
static void test_commit(struct test *t)
{
    char path[256];
    struct error err = {.text = ""};
    struct file_output f;
    uint8_t *data = NULL;
    size_t n = 0;
    in_tmp(t, "kept", path, sizeof path);
    write_bytes(path, "old", 3);
    for (int abandon = 0; abandon < 2; abandon++) {
        if (!CHECK(t, file_create(path, &f, &err), "%s", err.text))
            return;
        char temporary[300];
        snprintf(temporary, sizeof temporary, "%s", f.temporary);
        CHECK(t, os_kind_of(temporary) == OS_FILE, "%s exists while writing", temporary);
        fputs("new", f.stream);
        if (abandon) {
            file_abandon(&f);
        } else {
            bool fails = remove(temporary) == 0; /* the last step, except where an open file cannot be removed */
            CHECK(t, file_commit(&f, &err) != fails, "%s", err.text);
            CHECK(t, !fails || strstr(err.text, "cannot be written") != NULL, "%s", err.text);
        }
        CHECK(t, os_kind_of(temporary) == OS_NOTHING, "%s is left behind", temporary);
        CHECK(t, file_read(path, &data, &n, &err) && n == 3, "the old file is gone");
        free(data);
    }
    remove(path);
}

static void check_no_read(struct test *t, const char *path, const char *message)
{
    struct image img;
    struct error err = {.text = ""};
    CHECK(t,
          !image_read(path, NULL, &img, &err) && strstr(err.text, message) != NULL &&
              strncmp(err.text, path, strlen(path)) == 0,
          "%s: \"%s\" expected, got \"%s\"", path, message, err.text);
    CHECK(t, img.u8 == NULL && img.f32 == NULL, "%s: something is left in the image", path);
}

static void test_unreadable(struct test *t)
{
    char path[256];
    struct image img;
    struct error err = {.text = ""};
    check_no_read(t, in_tmp(t, "absent.png", path, sizeof path), "cannot be opened");
    check_no_read(t, test_tmp(t), "cannot be"); /* read, or opened */
    static const struct {
        const char *name, *content, *message;
    } CASES[] = {
        {"empty.png", "", "signature"},          {"empty.pfm", "", "not a PFM"},
        {"empty.ppm", "", "not a PPM"},          {"empty.tga", "", "truncated"},
        {"what.jpg", "JFIF", "unknown image"}, {"env.exr", "v/1\1", "header is damaged or truncated"},
        {"p.png", "P3 1 1 7 ", "do not fit"},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        in_tmp(t, CASES[i].name, path, sizeof path);
        write_bytes(path, CASES[i].content, strlen(CASES[i].content));
        check_no_read(t, path, CASES[i].message);
        remove(path);
    }
    static const uint8_t TGA[18 + 3] = {[2] = 2, [12] = 1, [14] = 1, [16] = 24, [18] = 1, [19] = 2, [20] = 200};
    in_tmp(t, "red.TGA", path, sizeof path);
    write_bytes(path, TGA, sizeof TGA);
    if (CHECK(t, image_read(path, NULL, &img, &err), "%s", err.text)) {
        CHECK(t, img.decode[img.u8[0]] == (float)srgb_decode(200 / 255.0), "the table decodes bytes");
        image_free(&img);
    }
    remove(path);
}

/* --- progress ---------------------------------------------------------------------------------------- */

static void test_duration(struct test *t)
{
    static const struct {
        double seconds;
        const char *text;
    } CASES[] = {{0, "0 s"}, {59.4, "59 s"}, {59.6, "1 min 00 s"}, {200, "3 min 20 s"}, {3599.4, "59 min 59 s"},
                 {7500, "2 h 05 min"}, {86400, "1 day 0 h"}, {273600, "3 days 4 h"}, {-5, "0 s"}, {NAN, "0 s"}};
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        char text[32];
        progress_duration(CASES[i].seconds, text, sizeof text);
        CHECK(t, strcmp(text, CASES[i].text) == 0, "%g seconds are %s, not %s", CASES[i].seconds, CASES[i].text, text);
    }
}

/* What comes before the first of the work, as learning does, does not count; nor is there a guess at first. */
static void test_left(struct test *t)
{
    struct progress p;
    progress_start(&p, true);
    CHECK(t, progress_left(&p, 10, 0) == INFINITY && progress_left(&p, 20, 0.25) == INFINITY &&
                 progress_left(&p, 21, 0.25) == INFINITY, "too early for a guess");
    for (int i = 2; i <= 60; i++) {
        double left = progress_left(&p, 20 + i, 0.25 + i / 80.0);
        CHECK(t, fabs(left - (60 - i)) < 1e-9, "%g seconds are left, not %d", left, 60 - i);
    }
}

static void test_names(struct test *t)
{
    static const char *const CASE[][3] = {{"a/b/scene.pbrt", "c/d.ply", "a/b/c/d.ply"},
                                          {"scene.pbrt", "../d.ply", "../d.ply"},
                                          {"/scene.pbrt", "d.ply", "/d.ply"},
                                          {"a/scene.pbrt", "/d.ply", "/d.ply"},
                                          {"scene.pbrt", "-", "./-"}};
    for (int i = 0; i < 5; i++) {
        char *path = file_beside(CASE[i][0], CASE[i][1]);
        CHECK(t, strcmp(path, CASE[i][2]) == 0, "%s beside %s is %s", CASE[i][1], CASE[i][0], path);
        free(path);
    }
    CHECK(t, file_has_extension("a.b.PNG", ".png") && !file_has_extension("png", ".png") &&
          !file_has_extension("a.png.b", ".png"), "extensions");
}

/* Several files are written at once and ended in any order: each is removed from the list of temporary files, which is
 * gone through where the program ends early, and takes no other's place there. */
static void test_several(struct test *t)
{
    enum { FILES = 3, ROUNDS = 50 };
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 40, 0);
    struct file_output out[FILES];
    bool open[FILES] = {false};
    for (int i = 0; i < ROUNDS + FILES; i++) {
        int k = i < ROUNDS ? (int)rng_below(&r, FILES) : i - ROUNDS;
        char path[256], name[16];
        struct error err;
        snprintf(name, sizeof name, "several%d", k);
        if (open[k])
            file_abandon(&out[k]);
        else if (i < ROUNDS)
            CHECK(t, file_create(in_tmp(t, name, path, sizeof path), &out[k], &err), "%s", err.text);
        open[k] = i < ROUNDS && !open[k];
    }
}

void test_file(struct test *t)
{
    test_several(t);
    test_names(t);
    test_duration(t);
    test_left(t);
    test_written(t);
    test_written_bytes(t);
    test_unwritable(t);
    test_commit(t);
    test_unreadable(t);
}
