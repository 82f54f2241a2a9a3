/* test_part.c: films as files (render/part.h).
 *
 * Facts: the bytes of a small film, known on paper; what is written is read back, whatever the sums are; parts add up.
 * Faults: every byte of a file changed, every length it can be cut to, bytes behind its end: all are noticed. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/rng.h"
#include "base/version.h"
#include "render/part.h"
#include "helpers.h"
#include "tests.h"

static struct part small_part(char *identity, int width, int height)
{
    struct part p = {.identity = identity, .width = width, .height = height, .scale = 1, .first = 2, .end = 7};
    return p;
}

static bool load(const char *path, struct film *film, struct error *err)
{
    struct part p;
    FILE *f = part_open(path, &p, err);
    if (f == NULL)
        return false;
    bool fits = p.width == rect_width(film->rect) && p.height == rect_height(film->rect);
    bool ok = fits && part_add(f, path, &p, film, err);
    if (!fits)
        fclose(f);
    part_free(&p);
    return ok;
}

/* Digits 0, -1, 63, 64, -65 and 2^62, of which the last has nine bytes. */
static void test_bytes(struct test *t)
{
    static const char TEXT[] = "asbdpt part 1\nversion 0\nsize 1 1\nscale 1\nsamples 2 7\ndone 3 1\nleft-out 4\ncheck ";
    static const uint8_t SUMS[] = {255, 7,   0,   1,   126, 12,  128, 1,   129, 1,
                                   128, 128, 128, 128, 128, 128, 128, 128, 128, 1};
    struct pixel_rect one = {0, 0, 1, 1};
    const struct exact_sum red = {{0, 0, 0}, 0}, green = {{0, -1, 63}, 7}, blue = {{64, -65, INT64_MAX / 2 + 1}, 12};
    char path[256], identity[] = "version 0\nsize 1 1\nscale 1\n";
    struct part p = small_part(identity, 1, 1);
    struct film film, back;
    struct error err = {""};
    uint8_t *data = NULL;
    size_t n = 0;
    snprintf(path, sizeof path, "%s/bytes.part", test_tmp(t));
    film_init(&film, one, 1, 1);
    film_init(&back, one, 1, 1);
    film.sum[0] = red;
    film.sum[1] = green;
    film.sum[2] = blue;
    film.iterations = 3;
    film.passes = 1;
    film.nonfinite = 4;
    CHECK(t, part_save(path, &p, &film, &err) && file_read(path, &data, &n, &err), "%s", err.text);
    size_t text = sizeof TEXT - 1 + 9;
    CHECK(t, n == text + sizeof SUMS + 4 && memcmp(data, TEXT, sizeof TEXT - 1) == 0, "the text, or the length %d",
          (int)n);
    CHECK(t, n == text + sizeof SUMS + 4 && memcmp(data + text, SUMS, sizeof SUMS) == 0, "the sums");
    CHECK(t, load(path, &back, &err), "%s", err.text);
    CHECK(t, memcmp(&back.sum[2].digit, &blue.digit, sizeof blue.digit) == 0, "large digits");
    CHECK(t, back.iterations == 3 && back.passes == 1 && back.nonfinite == 4 && back.sum[1].digit[1] == -1, "numbers");
    free(data);
    film_free(&film);
    film_free(&back);
    remove(path);
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
    struct pixel_rect rect = {3, 4, 103, 54};
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 30, 0);
    char path[256], identity[] = "version 0\nsize 100 50\nscale 1\n";
    struct part p = small_part(identity, 100, 50);
    struct film a, b, sum;
    struct error err = {""};
    snprintf(path, sizeof path, "%s/large.part", test_tmp(t));
    film_init(&a, rect, 200, 200);
    film_init(&b, rect, 200, 200);
    film_init(&sum, rect, 200, 200);
    fill(&a, &r, 30000);
    fill(&b, &r, 30000);
    CHECK(t, part_save(path, &p, &a, &err) && load(path, &sum, &err) && same(&a, &sum), "read back: %s", err.text);
    CHECK(t, part_save(path, &p, &b, &err) && load(path, &sum, &err) && !same(&a, &sum), "a second: %s", err.text);
    for (int i = 0; i < 3 * 100 * 50; i++)
        exact_join(&a.sum[i], &b.sum[i]);
    CHECK(t, same(&a, &sum), "the sum of two parts");
    film_free(&a);
    film_free(&b);
    film_free(&sum);
    remove(path);
}

static bool accepted(const char *path, const uint8_t *data, size_t n)
{
    struct pixel_rect rect = {0, 0, 4, 3};
    struct film film;
    struct error err;
    write_bytes(path, data, n);
    film_init(&film, rect, 4, 3);
    bool ok = load(path, &film, &err);
    film_free(&film);
    return ok;
}

static void test_damage(struct test *t)
{
    struct pixel_rect rect = {0, 0, 4, 3};
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 31, 0);
    char path[256], identity[] = "version 0\nsize 4 3\nscale 1\n";
    struct part p = small_part(identity, 4, 3);
    struct film film;
    struct error err = {""};
    uint8_t *data = NULL;
    size_t n = 0;
    snprintf(path, sizeof path, "%s/damaged.part", test_tmp(t));
    film_init(&film, rect, 4, 3);
    fill(&film, &r, 60);
    if (CHECK(t, part_save(path, &p, &film, &err) && file_read(path, &data, &n, &err), "%s", err.text)) {
        CHECK(t, accepted(path, data, n), "the file as it was written");
        CHECK(t, !accepted(path, data, n + 1), "a byte behind the end"); /* file_read has put a zero there */
        for (size_t i = 0; i < n; i++) {
            uint8_t kept = data[i];
            data[i] ^= (uint8_t)(1 << i % 8);
            CHECK(t, !accepted(path, data, n), "byte %d changed", (int)i);
            data[i] = kept;
            CHECK(t, !accepted(path, data, i), "cut to %d bytes", (int)i);
        }
    }
    free(data);
    film_free(&film);
    remove(path);
}

/* A program whose pictures are others has another estimator, and its films are not taken. */
static void test_estimator(struct test *t)
{
    struct scene scene;
    struct error err = {""};
    char line[64];
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", 4, 4, &scene))
        return;
    struct render_options o = {.integrator = integrator_find("bdpt"), .end = 4, .planned = 4, .max_depth = 5};
    struct part ours = part_describe(&scene, &o), other = part_describe(&scene, &o);
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

void test_part(struct test *t)
{
    test_estimator(t);
    test_bytes(t);
    test_round_trip(t);
    test_damage(t);
}
