/* test_part.c: films as files (render/part.h).
 *
 * Facts: the bytes of a small film, known on paper; what is written is read back, whatever the sums are; parts add up.
 * Faults: every byte of a file changed, every length it can be cut to, bytes behind its end: all are noticed. Forged
 * lines and digits with the right checks: whatever is taken for a part of the same picture says what that says. */
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
#include "tests.h"

static struct part small_part(char *identity, int width, int height)
{
    struct part p = {.identity = identity, .width = width, .height = height, .place = {0, 0, width, height}, .scale = 1,
                     .planned = 8, .first = 2, .end = 7};
    return p;
}

static bool load(const char *path, struct film *film, struct error *err)
{
    struct part p;
    FILE *f = part_open(path, &p, err);
    if (f == NULL)
        return false;
    bool ok = part_add(f, path, &p, film, err);
    part_free(&p);
    return ok;
}

/* Digits 0, -1, 63, 64, -65 and 2^62, of which the last has nine bytes. */
static void test_bytes(struct test *t)
{
    static const char TEXT[] = "asbdpt part 3\nsamples 2 7\ndone 3 1\nleft-out 4\ncarried 0\nsize 1 1\n"
                               "film 1 1, window 0 0\n"
                               "scale 1\nspp 8\nlearnt 0000000000000000\nversion 0\ncheck ";
    static const uint8_t SUMS[] = {255, 7,   0,   1,   126, 12,  128, 1,   129, 1,
                                   128, 128, 128, 128, 128, 128, 128, 128, 128, 1};
    struct pixel_rect one = {0, 0, 1, 1};
    const struct exact_sum red = {{0, 0, 0}, 0}, green = {{0, -1, 63}, 7}, blue = {{64, -65, INT64_MAX / 2 + 1}, 12};
    char path[256], identity[] = "version 0\n";
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

/* A checkpoint carries what was learnt, a part only its hash; cut, changed or longer it is refused. */
static void test_carried(struct test *t)
{
    enum { N = 100000 };
    struct pixel_rect one = {0, 0, 1, 1};
    char path[256], identity[] = "version 0\n";
    struct part p = small_part(identity, 1, 1), found;
    struct film film, back;
    struct error err = {""};
    uint8_t *data = NULL;
    size_t n = 0;
    snprintf(path, sizeof path, "%s/carried.part", test_tmp(t));
    film_init(&film, one, 1, 1);
    film.learnt.data = mem_alloc(N, 1);
    film.learnt.n = N;
    for (int i = 0; i < N; i++)
        film.learnt.data[i] = (uint8_t)(i % 251 * 7);
    for (int carries = 0; carries < 2; carries++) {
        p.carries = carries;
        film_init(&back, one, 1, 1);
        CHECK(t, part_save(path, &p, &film, &err) && load(path, &back, &err), "%s", err.text);
        CHECK(t, back.learnt.n == (carries ? N : 0) &&
                     (!carries || memcmp(back.learnt.data, film.learnt.data, N) == 0), "%lu bytes come back",
              (unsigned long)back.learnt.n);
        film_free(&back);
        FILE *f = part_open(path, &found, &err);
        if (CHECK(t, f != NULL && found.learnt != 0, "%s", err.text)) {
            fclose(f);
            part_free(&found);
        }
    }
    CHECK(t, file_read(path, &data, &n, &err), "%s", err.text);
    for (int way = 0; way < 3; way++) {
        film_init(&back, one, 1, 1);
        data[n - 7] ^= way == 1;
        write_bytes(path, data, way == 0 ? n - 1 : way == 2 ? n + 1 : n); /* a zero byte follows what was read */
        data[n - 7] ^= way == 1;
        CHECK(t, !load(path, &back, &err), "damage of kind %d is not noticed", way);
        film_free(&back);
    }
    free(data);
    film_free(&film);
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
    char path[256], identity[] = "version 0\n";
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
    char path[256], identity[] = "version 0\n";
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
    struct render_options o = {.integrator = "bdpt", .end = 4, .planned = 4, .max_depth = 5};
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

/* One fault in the lines: two change places, one is doubled or dropped, a number becomes another. */
static void forge_lines(struct rng *r, const char *const *line, int n, char *out)
{
    static const char *const NUMBERS[] = {"0", "-1", "1", "4", "9", "04", "+4", "4.0", "nan", "inf", "1e999",
                                          "2147483647", "2147483648", "9223372036854775807", "9223372036854775808",
                                          " ", ""};
    int kind = (int)(4 * rng_uniform(r)), a = 1 + (int)((n - 1) * rng_uniform(r));
    int b = 1 + (int)((n - 1) * rng_uniform(r));
    out[0] = '\0';
    for (int i = 0; i < n; i++) {
        const char *this = line[kind == 0 && i == a ? b : kind == 0 && i == b ? a : i];
        char *at = out + strlen(out);
        if (kind == 1 && i == b)
            at += sprintf(at, "%s\n", line[a]);
        if (kind == 2 && i == a)
            continue;
        strcpy(at, this);
        char *number = strpbrk(at, " ");
        if (kind == 3 && i == a && number != NULL) {
            char rest[64];
            char *second = strchr(number + 1, ' ');
            number = second != NULL && rng_uniform(r) < 0.5 ? second : number;
            strcpy(rest, number + 1 + strcspn(number + 1, " ,"));
            sprintf(number + 1, "%s%s", NUMBERS[(int)(17 * rng_uniform(r))], rest);
        }
        strcat(at, "\n");
    }
}

static void test_forged(struct test *t)
{
    static const char *const LINES[] = {"asbdpt part 3", "samples 2 7", "done 3 1", "left-out 4", "carried 0",
                                        "size 4 3",
                                        "film 4 3, window 0 0", "scale 1", "spp 8",
                                        "learnt 0000000000000000", "version 0",
                                        "seed 1"};
    enum { N_LINES = 12, ROUNDS = 1000, SUMS = 36 };
    char path[256], text[1024], identity[] = "version 0\nseed 1\n";
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 32, 0);
    struct part whole = small_part(identity, 4, 3);
    struct pixel_rect rect = {0, 0, 4, 3};
    int taken = 0, same_picture = 0;
    snprintf(path, sizeof path, "%s/forged.part", test_tmp(t));
    for (int round = 0; round < ROUNDS; round++) {
        struct part p;
        struct film film;
        struct error err = {""};
        forge_lines(&r, LINES, N_LINES, text);
        size_t n = strlen(text);
        n += (size_t)sprintf(text + n, "check %08lx\n", (unsigned long)checksum_crc32(0, (const uint8_t *)text, n));
        memset(text + n, 255, SUMS);
        bytes_of_bits(checksum_crc32(0, (const uint8_t *)text + n, SUMS), (uint8_t *)text + n + SUMS, 4, false);
        write_bytes(path, (const uint8_t *)text, n + SUMS + 4);
        FILE *f = part_open(path, &p, &err);
        CHECK(t, f != NULL || strstr(err.text, path) == err.text, "refused without its name: %s", err.text);
        if (f == NULL)
            continue;
        taken++;
        bool same = part_same(&p, path, &whole, &err);
        same_picture += same;
        CHECK(t, !same || strstr(text, "\nsize 4 3\nfilm 4 3, window 0 0\nscale 1\nspp 8\n"
                                      "learnt 0000000000000000\nversion 0\nseed 1\ncheck "),
              "taken for the same picture: %s", text);
        CHECK(t, p.done >= 0 && p.done <= p.end - p.first && p.end <= p.planned, "taken: %s", text);
        film_init(&film, rect, 4, 3);
        bool added = part_add(f, path, &p, &film, &err);
        CHECK(t, !added || (p.width == 4 && p.height == 3), "added to a film of another size: %s", text);
        film_free(&film);
        part_free(&p);
    }
    CHECK(t, taken > 10 && same_picture > 3 && same_picture < taken && taken < ROUNDS / 2,
          "%d of %d forged parts are taken, %d for the same picture", taken, ROUNDS, same_picture);
    remove(path);
}

/* A digit at the end of its range is refused, not left to overflow when the render goes on. */
static void test_forged_digits(struct test *t)
{
    static const int64_t DIGITS[] = {INT64_MAX, INT64_MIN, INT64_MAX / 2 + 2};
    struct pixel_rect one = {0, 0, 1, 1};
    char path[256], identity[] = "version 0\n";
    struct part p = small_part(identity, 1, 1);
    snprintf(path, sizeof path, "%s/digits.part", test_tmp(t));
    for (int i = 0; i < 3; i++) {
        struct film film, back;
        struct error err = {""};
        film_init(&film, one, 1, 1);
        film_init(&back, one, 1, 1);
        film.sum[1].digit[0] = DIGITS[i];
        CHECK(t, part_save(path, &p, &film, &err) && !load(path, &back, &err),
              "a digit of %g is taken", (double)DIGITS[i]);
        film_free(&film);
        film_free(&back);
    }
    remove(path);
}

/* A film that differs in one side alone takes nothing. */
static void test_other_size(struct test *t)
{
    struct pixel_rect whole = {0, 0, 4, 3};
    const struct pixel_rect others[] = {{0, 0, 4, 4}, {0, 0, 5, 3}};
    char path[256], identity[] = "version 0\n";
    struct part p = small_part(identity, 4, 3);
    struct film film;
    struct error err = {""};
    snprintf(path, sizeof path, "%s/size.part", test_tmp(t));
    film_init(&film, whole, 4, 3);
    CHECK(t, part_save(path, &p, &film, &err) && load(path, &film, &err), "%s", err.text);
    film_free(&film);
    for (int i = 0; i < 2; i++) {
        film_init(&film, others[i], 5, 4);
        CHECK(t, !load(path, &film, &err), "a film of %d x %d pixels takes a part of 4 x 3", others[i].x1,
              others[i].y1);
        film_free(&film);
    }
    remove(path);
}

void test_part(struct test *t)
{
    test_other_size(t);
    test_estimator(t);
    test_forged(t);
    test_forged_digits(t);
    test_bytes(t);
    test_carried(t);
    test_round_trip(t);
    test_damage(t);
}
