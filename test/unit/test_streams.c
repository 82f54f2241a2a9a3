/* test_streams.c: random numbers are named by seed, purpose, pixel and iteration, and different names give different
 * numbers. Tested from two sides: the numbers of a sampler, and the sub-paths that the integrators trace. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/sampler.h"
#include "bench.h"
#include "helpers.h"
#include "suites.h"

/* Every way of rendering; restarts make bins number its light sub-paths by blocks. */
static const char *const WAYS[] = {"pt", "lt", "bdpt", "asbdpt select=pool", "asbdpt select=vertices", "asbdpt", "lvc",
                                   "cbdpt connections=2", "mbdpt", "pcbdpt connections=2", "ris", "ris2", "spcbpt",
                                   "restir", "restirgi", "ppg", "asbdpt select=bins", "asbdpt select=bins restart=8",
                                   "asbdpt select=bins restart=0"};
enum { N_WAYS = sizeof WAYS / sizeof WAYS[0] };

/* --- pairs of equal keys ----------------------------------------------------------------------------- */

struct keys {
    uint64_t *key; /* [n], owned */
    size_t n, capacity;
};

static void add_key(struct keys *k, uint64_t key)
{
    k->key = mem_grow(k->key, &k->capacity, k->n + 1, sizeof *k->key);
    k->key[k->n++] = key;
}

static int compare_keys(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* How many keys equal another one. Empties the list. */
static long count_equal(struct keys *k)
{
    long equal = 0;
    if (k->n > 1)
        qsort(k->key, k->n, sizeof *k->key, compare_keys);
    for (size_t i = 1; i < k->n; i++)
        equal += k->key[i] == k->key[i - 1];
    free(k->key);
    memset(k, 0, sizeof *k);
    return equal;
}

/* --- the sampler ------------------------------------------------------------------------------------- */

/* The first 16 binary digits of one number of each of three points. */
static uint64_t digits_of(struct sampler s, int second)
{
    uint64_t key = 0;
    for (int d = DRAW_FILM_POINT; d < DRAW_FILM_POINT + 3; d++) {
        double u[2];
        sampler_pair(&s, (enum decision)d, u);
        key = key << 16 | (uint64_t)(u[second] * 65536);
    }
    return key;
}

/* Names as they occur: iterations in a row, of later blocks, of numberings that use the upper bits; neighbouring
 * pixels of small and of the largest films; seeds in a row; all purposes. */
static void add_names(struct keys *k, uint64_t seed, int second, uint64_t mask)
{
    static const uint64_t far[] = {0, 1u << 8, 1u << 16, 1u << 24, UINT64_C(1) << 32,
                                   UINT64_C(1) << 40, UINT64_C(1) << 63};
    for (int purpose = RNG_EYE; purpose <= RNG_RECORD; purpose++)
        for (uint64_t other = 0; other < 6; other++)
            for (size_t f = 0; f < sizeof far / sizeof far[0]; f++)
                for (uint64_t i = 0; i < 32; i++) {
                    uint64_t pixel = other == 3 ? 1 : other == 4 ? 1u << 28 : other == 5 ? (1u << 28) - 1 : 0;
                    uint64_t the_seed = seed + (other < 3 ? other : 0);
                    struct sampler s = sampler_start(the_seed, (enum rng_purpose)purpose, pixel, (far[f] + i) & mask);
                    add_key(k, digits_of(s, second));
                }
}

static void test_names(struct test *t)
{
    for (int second = 0; second < 2; second++) {
        struct keys k = {NULL, 0, 0};
        add_names(&k, test_seed(t), second, UINT64_MAX);
        long equal = count_equal(&k);
        CHECK(t, equal == 0, "%ld names share the first digits of their numbers %d, %d and %d", equal, second,
              second + 2, second + 4);
        add_names(&k, test_seed(t), second, UINT32_MAX);
        CHECK(t, count_equal(&k) > 0, "an iteration cut to 32 bits passes for a name");
    }
    struct keys k = {NULL, 0, 0};
    for (uint64_t i = 0; i < 1u << 17; i++)
        add_key(&k, digits_of(sampler_start(test_seed(t), RNG_EYE, 7, i), 0));
    CHECK(t, count_equal(&k) == 0, "a pixel's first 2^17 iterations repeat themselves");
}

/* --- sub-paths --------------------------------------------------------------------------------------- */

/* A tilted floor before a lamp outside the picture. Its red and green tell where a sub-path met it. */
static const char FLOOR[] = "Film \"image\" \"integer xresolution\" 2 \"integer yresolution\" 2 PixelFilter \"box\"\n"
                            "LookAt 0 0 5  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 60\n"
                            "WorldBegin\n"
                            "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [1 2 3]\n"
                            QUAD("-1 1.5 3  -1 2.5 3  1 2.5 3  1 1.5 3") "AttributeEnd\n"
                            "Texture \"place\" \"spectrum\" \"bilerp\" \"rgb v00\" [.1 .1 .5] \"rgb v01\" [.1 .9 .5]\n"
                            "\"rgb v10\" [.9 .1 .5] \"rgb v11\" [.9 .9 .5]\n"
                            "Material \"matte\" \"texture Kd\" \"place\" Rotate -30 1 0 0\n"
                            "Shape \"trianglemesh\" \"integer indices\" [0 2 1 0 3 2]\n"
                            "\"float uv\" [0 0  0 1  1 1  1 0]\n"
                            "\"point P\" [-5 -5 0  -5 5 0  5 5 0  5 -5 0]\n"
                            "WorldEnd\n";

enum { ITERATIONS = 2048 };

/* Keys of places, in units coarser than the rounding of a float; tries of one sub-path follow each other. */
static void add_place(struct keys *k, double x, double y)
{
    uint64_t a = (uint64_t)(x * 0x1p21), b = (uint64_t)(y * 0x1p21), last = k->n > 0 ? k->key[k->n - 1] : 0;
    if (fabs((double)a - (double)(last >> 32)) > 1 || fabs((double)b - (double)(last & UINT32_MAX)) > 1)
        add_key(k, a << 32 | b);
}

/* One key per sub-path: red and green relative to blue of what it brings by the strategy that joins it to the lens
 * (light) or the lamp (eye), whatever point of these. */
static void joined(void *context, const struct sample *sample, const struct joined *p)
{
    struct keys *const *light_or_eye = context;
    rgb c = p->c->value;
    (void)sample;
    if (c.b > 0 && p->s + p->t == 3 && p->s > 0)
        add_place(light_or_eye[p->s == 1], c.r / c.b, c.g / c.b);
}

/* Render by hand, block by block, as render.c does. */
static void trace_all(struct test *t, const struct scene *scene, const char *integrator, uint64_t seed,
                      struct keys *eye, struct keys *light)
{
    struct bench b;
    struct keys *light_or_eye[] = {light, eye};
    const struct observer observer = {.context = light_or_eye, .joined = joined};
    if (!bench_new(t, scene, integrator, 1, seed, &b))
        return;
    int block = b.prepared.size.block == 0 ? LONGEST_BLOCK : b.prepared.size.block;
    block = block < ITERATIONS ? block : ITERATIONS;
    for (long first = 0; first < ITERATIONS; first += block) {
        struct tile_pass pass = bench_pass(&b, first, first + block);
        pass.observer = &observer;
        b.prepared.method->render(&b.prepared, &pass);
    }
    bench_free(&b);
}

/* Where a walk from a pixel's lens by these numbers first hits; the sampler itself stays as it is. */
static vec3 first_hit(const struct tile_pass *pass, const struct counts *counts, struct sampler sampler)
{
    struct vertex path[3];
    double weight;
    struct walk w = {pass->job->scene, counts, &pass->work->arena, &sampler, 0};
    int n = path_eye_pixel(&w, 1, 1, path, 3, &weight);
    return n > 1 ? path[1].p : vec(0, 0, 0);
}

/* The same of a walk from a light. */
static vec3 first_lit(const struct tile_pass *pass, const struct counts *counts, struct sampler sampler)
{
    struct vertex path[3];
    struct walk w = {pass->job->scene, counts, &pass->work->arena, &sampler, 0};
    int n = path_light(&w, path, 3, NULL);
    return n > 1 ? path[1].p : vec(0, 0, 0);
}

/* A sample's light sub-path and end points have numbers of their own: by these, sub-paths are others than the
 * sample's. */
static void test_end_points(struct test *t)
{
    struct scene scene;
    struct bench b;
    if (!scene_from_text(t, FLOOR, &scene) || !bench_new(t, &scene, "bdpt", 2, 0, &b))
        return;
    const struct counts *counts = &b.prepared.counts;
    struct tile_pass pass = bench_pass(&b, 0, 1);
    struct sample sample = sample_begin(&pass, pixels_cell(b.tile.pixels, 1, 1), 0);
    struct vertex *path = sample.eye;
    int n = sample_eye_path(&sample, 3);
    CHECK(t, n > 1 && near3(first_hit(&pass, counts, sample_stream(&pass, RNG_EYE, 1, 1, 0)), path[1].p, 0),
          "an eye sub-path by its own numbers is another");
    CHECK(t, n > 1 && !near3(first_hit(&pass, counts, sample.sampler), path[1].p, 1e-6),
          "end points take the numbers of the eye sub-path");
    n = sample_light_path(&pass, sample.i, 0, &pass.work->arena, path);
    CHECK(t, n > 1 && near3(first_lit(&pass, counts, sample_stream(&pass, RNG_LIGHT, 1, 1, 0)), path[1].p, 0),
          "a light sub-path by its own numbers is another");
    CHECK(t, n > 1 && !near3(first_lit(&pass, counts, sample_stream(&pass, RNG_EYE, 1, 1, 0)), path[1].p, 1e-6),
          "light sub-paths take the numbers of eye sub-paths");
    bench_free(&b);
    scene_free(&scene);
}

/* --- sub-paths --------------------------------------------------------------------------------------- */

/* Four pixels, two seeds in a row: no sub-path comes twice. */
static void test_sub_paths(struct test *t)
{
    struct scene scene;
    if (!scene_from_text(t, FLOOR, &scene))
        return;
    for (int i = 0; i < N_WAYS; i++) {
        struct keys eye = {NULL, 0, 0}, light = {NULL, 0, 0};
        const char *integrator = set_method(&scene, WAYS[i]);
        for (uint64_t seed = 0; seed < 2; seed++)
            trace_all(t, &scene, integrator, seed, &eye, &light);
        CHECK(t, eye.n + light.n > ITERATIONS, "%s: only %lu sub-paths seen", WAYS[i],
              (unsigned long)(eye.n + light.n));
        long n_eye = (long)eye.n, n_light = (long)light.n, eyes = count_equal(&eye), lights = count_equal(&light);
        CHECK(t, eyes == 0, "%s: %ld of %ld eye sub-paths come twice", WAYS[i], eyes, n_eye);
        CHECK(t, lights == 0, "%s: %ld of %ld light sub-paths come twice", WAYS[i], lights, n_light);
    }
    scene_free(&scene);
}

void test_streams(struct test *t)
{
    test_names(t);
    test_end_points(t);
    test_sub_paths(t);
}
