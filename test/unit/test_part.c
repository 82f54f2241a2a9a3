/* test_part.c: films as files (render/part.h).
 *
 * Facts: the bytes of a small film, known on paper; what is written is read back, whatever the sums are; parts add up.
 * Faults: every byte of a file changed, every length it can be cut to, bytes behind its end: all are noticed. So are
 * impossible numbers with the right checks; other lines with the right checks are in the fuzzer's corpus. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/file.h"
#include "base/rng.h"
#include "base/version.h"
#include "render/part.h"
#include "image/zlib.h"
#include "helpers.h"
#include "suites.h"

/* A film, the part that it is of, and the file's name. */
struct fixture {
    char path[256], identity[32];
    struct part part;
    struct film film;
};

static void set_up(struct test *t, int width, int height, struct fixture *f)
{
    struct part p = {.width = width, .height = height, .place = {0, 0, width, height}, .scale = 1, .planned = 8,
                     .first = 2, .end = 7};
    struct pixel_rect rect = {0, 0, width, height};
    snprintf(f->path, sizeof f->path, "%s/film.part", test_tmp(t));
    strcpy(f->identity, "version 0\n");
    f->part = p;
    f->part.identity = f->identity;
    film_init(&f->film, rect, width, height);
}

static void clean_up(struct fixture *f)
{
    film_free(&f->film);
    remove(f->path);
}

/* The file as bytes, to be freed. */
static uint8_t *bytes_of(struct test *t, const struct fixture *f, size_t *n)
{
    uint8_t *data = NULL;
    struct error err = {.text = ""};
    struct file_output file;
    CHECK(t, file_create(f->path, &file, &err), "%s", err.text);
    part_write(&file, &f->part, &f->film);
    CHECK(t, file_commit(&file, &err) && file_read(f->path, &data, n, &err), "%s", err.text);
    return data;
}

static bool load(const char *path, struct film *film)
{
    struct part p;
    struct error err;
    FILE *f = part_open(path, &p, &err);
    if (f == NULL)
        return false;
    bool ok = part_add(f, path, &p, film, &err);
    part_free(&p);
    return ok;
}

/* Do these bytes make a part for a film of this size? */
static bool accepted(const struct fixture *f, const uint8_t *data, size_t n, int width, int height)
{
    struct pixel_rect rect = {0, 0, width, height};
    struct film film;
    write_bytes(f->path, data, n);
    film_init(&film, rect, width, height);
    bool ok = load(f->path, &film);
    film_free(&film);
    return ok;
}

/* Digits 0, -1, 63, 64, -65 and 2^62, of which the last has nine bytes. */
static void test_bytes(struct test *t)
{
    static const char TEXT[] = "asbdpt part 9\nsamples 2 7\ndone 3 1\nleft-out 4\nhalves 0\nsize 1 1\n"
                               "film 1 1, window 0 0\n"
                               "scale 1\nspp 8\nversion 0\ncheck ";
    static const uint8_t SUMS[] = {255, 7,   0,   1,   126, 12,  128, 1,   129, 1,
                                   128, 128, 128, 128, 128, 128, 128, 128, 128, 1,
                                   255, 7,   6,   0,   0,   255, /* and what splats have brought */
                                   7,   4,   0,   0};            /* in a block of two samples */
    const struct exact_sum sums[3] = {{{0, 0, 0}, 0}, {{0, -1, 63}, 7}, {{64, -65, INT64_MAX / 2 + 1}, 12}};
    struct pixel_rect one = {0, 0, 1, 1};
    struct fixture f;
    struct film back;
    size_t n = 0, text = sizeof TEXT - 1 + 9;
    set_up(t, 1, 1, &f);
    film_init(&back, one, 1, 1);
    for (int i = 0; i < 3; i++)
        f.film.sum[i] = sums[i];
    f.film.iterations = 3;
    f.film.passes = 1;
    f.film.block.splat[1] = 3;
    f.film.block.in[0] = true;
    f.film.block.iterations = 2;
    f.film.nonfinite = 4;
    uint8_t *data = bytes_of(t, &f, &n);
    CHECK(t, n == text + sizeof SUMS + 4 && memcmp(data, TEXT, sizeof TEXT - 1) == 0 &&
                 memcmp(data + text, SUMS, sizeof SUMS) == 0, "the text, the sums, or the length %d", (int)n);
    CHECK(t, load(f.path, &back) && back.iterations == 3 && back.passes == 1 && back.nonfinite == 4 &&
                 back.block.splat[0] == 0 && back.block.splat[1] == 3 && back.block.in[0] && back.block.n_in == 1 &&
                 back.block.iterations == 2, "numbers");
    for (int i = 0; i < 3; i++)
        CHECK(t, memcmp(back.sum[i].digit, sums[i].digit, sizeof sums[i].digit) == 0, "the digits of sum %d", i);
    free(data);
    film_free(&back);
    clean_up(&f);
}

static void fill(struct film *film, struct rng *r, int terms)
{
    int n = rect_width(film->rect) * rect_height(film->rect) * 3;
    for (int i = 0; i < terms; i++)
        exact_add(&film->sum[(int)(rng_uniform(r) * n)], ldexp(rng_uniform(r) - 0.3, (int)(80 * rng_uniform(r)) - 40));
}

static bool same(const struct film *a, const struct film *b)
{
    int n = rect_width(a->rect) * rect_height(a->rect) * 3;
    for (int i = 0; i < n; i++)
        if (a->sum[i].top != b->sum[i].top || memcmp(a->sum[i].digit, b->sum[i].digit, sizeof a->sum[i].digit) != 0)
            return false;
    return true;
}

/* Larger than the buffers of writing and reading. */
static void test_round_trip(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 30, 0);
    struct fixture a, b, sum;
    size_t n;
    set_up(t, 100, 50, &a);
    set_up(t, 100, 50, &b);
    set_up(t, 100, 50, &sum);
    fill(&a.film, &r, 30000);
    fill(&b.film, &r, 30000);
    free(bytes_of(t, &a, &n));
    CHECK(t, load(a.path, &sum.film) && same(&a.film, &sum.film), "read back");
    free(bytes_of(t, &b, &n));
    CHECK(t, load(b.path, &sum.film) && !same(&a.film, &sum.film), "a second");
    for (int i = 0; i < 3 * 100 * 50; i++)
        exact_join(&a.film.sum[i], &b.film.sum[i]);
    CHECK(t, same(&a.film, &sum.film), "the sum of two parts");
    clean_up(&a);
    clean_up(&b);
    clean_up(&sum);
}

/* Every byte changed, every length; a film that differs in one side alone takes nothing. */
static void test_damage(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 31, 0);
    struct fixture f;
    size_t n = 0;
    set_up(t, 4, 3, &f);
    fill(&f.film, &r, 60);
    uint8_t *data = bytes_of(t, &f, &n);
    CHECK(t, accepted(&f, data, n, 4, 3) && !accepted(&f, data, n + 1, 4, 3), "as it was written; a byte behind");
    CHECK(t, !accepted(&f, data, n, 4, 4) && !accepted(&f, data, n, 5, 3), "for a film of another size");
    for (size_t i = 0; i < n; i++) {
        uint8_t kept = data[i];
        data[i] ^= (uint8_t)(1 << i % 8);
        CHECK(t, !accepted(&f, data, n, 4, 3), "byte %d changed", (int)i);
        data[i] = kept;
        CHECK(t, !accepted(&f, data, i, 4, 3), "cut to %d bytes", (int)i);
    }
    free(data);
    clean_up(&f);
}

/* A program whose pictures are others has another estimator, and its films are not taken. */
static void test_estimator(struct test *t)
{
    struct scene scene;
    struct error err = {.text = ""};
    char line[64];
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", 4, 4, &scene))
        return;
    struct render_job o = {.integrator = method_named("bdpt"), .end = 4, .planned = 4, .max_depth = 5};
    struct prepared prepared;
    CHECK(t, job_settle(&o, &scene, &prepared, &err), "%s", err.text);
    struct part ours = part_describe(&o), other = part_describe(&o);
    snprintf(line, sizeof line, "version %s, estimator %d\n", VERSION, ESTIMATOR);
    bool named = strncmp(ours.identity, line, strlen(line)) == 0;
    if (CHECK(t, named, "the lines begin with: %.40s", ours.identity)) {
        CHECK(t, part_same(&ours, "a.part", &other, &err), "%s", err.text);
        other.identity[strlen(line) - 2]++;
        CHECK(t, !part_same(&ours, "a.part", &other, &err) && strstr(err.text, "estimator") != NULL, "%s", err.text);
    }
    part_free(&ours);
    part_free(&other);
    scene_free(&scene);
}

/* Numbers that no part has are refused, though they are written as those of a part are. */
static void test_impossible(struct test *t)
{
    for (int i = 0; i < 7; i++) {
        struct fixture f;
        size_t n = 0;
        set_up(t, 4, 3, &f);
        switch (i) {
        case 1: f.part.first = f.part.end; break;
        case 2: f.part.planned = f.part.end - 1; break;
        case 3: f.part.scale = -1; break;
        case 4: f.part.place.x = 1; break;
        case 5: f.film.iterations = f.part.end - f.part.first + 1; break;
        case 6: f.film.nonfinite = -1; break;
        default: break; /* as it should be */
        }
        uint8_t *data = bytes_of(t, &f, &n);
        CHECK(t, accepted(&f, data, n, 4, 3) == (i == 0), "numbers of case %d are %s", i, i == 0 ? "refused" : "taken");
        free(data);
        clean_up(&f);
    }
}

/* A digit at the end of its range is refused, not left to overflow when the render goes on. */
static void test_forged_digits(struct test *t)
{
    static const int64_t DIGITS[] = {INT64_MAX, INT64_MIN, INT64_MAX / 2 + 2};
    for (int i = 0; i < 3; i++) {
        struct fixture f;
        size_t n = 0;
        set_up(t, 1, 1, &f);
        f.film.sum[1].digit[0] = DIGITS[i];
        uint8_t *data = bytes_of(t, &f, &n);
        CHECK(t, !accepted(&f, data, n, 1, 1), "a digit of %g is taken", (double)DIGITS[i]);
        free(data);
        clean_up(&f);
    }
}

void test_part(struct test *t)
{
    test_estimator(t);
    test_impossible(t);
    test_forged_digits(t);
    test_bytes(t);
    test_round_trip(t);
    test_damage(t);
}
