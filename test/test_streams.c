/* test_streams.c: random numbers have names (seed, purpose, pixel, iteration), and no two names may meet. Tested from
 * three sides: the numbers of a sampler, the sub-paths that the integrators trace, and the error of long renders, which
 * falls only as long as new iterations bring something new. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/sampler.h"
#include "lab/stats.h"
#include "render/render.h"
#include "helpers.h"
#include "tests.h"

/* Every way of rendering; restarts make bins number its light sub-paths by blocks. */
static const char *const WAYS[] = {"pt",
                                   "lt",
                                   "bdpt",
                                   "asbdpt select=pool",
                                   "asbdpt select=vertices",
                                   "asbdpt select=subspaces",
                                   "lvc",
                                   "cbdpt connections=2",
                                   "asbdpt select=bins restart=32",
                                   "asbdpt select=bins restart=8",
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
    for (int purpose = RNG_EYE; purpose < RNG_TEST; purpose++)
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
                            "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]\n"
                            "\"point P\" [-1 1.5 3  -1 2.5 3  1 2.5 3  1 1.5 3] AttributeEnd\n"
                            "Texture \"place\" \"spectrum\" \"bilerp\" \"rgb v00\" [.1 .1 .5] \"rgb v01\" [.1 .9 .5]\n"
                            "\"rgb v10\" [.9 .1 .5] \"rgb v11\" [.9 .9 .5]\n"
                            "Material \"matte\" \"texture Kd\" \"place\" Rotate -30 1 0 0\n"
                            "Shape \"trianglemesh\" \"integer indices\" [0 2 1 0 3 2]\n"
                            "\"float uv\" [0 0  0 1  1 1  1 0]\n"
                            "\"point P\" [-5 -5 0  -5 5 0  5 5 0  5 -5 0]\n"
                            "WorldEnd\n";

enum { ITERATIONS = 2048 };

/* One key per sub-path: red and green of what it brings by the strategy that joins it to the lens (light) or the lamp
 * (eye). */
static void add_records(const struct tile *tile, struct keys *eye, struct keys *light)
{
    for (size_t i = 0; i < tile->n_records; i++) {
        const struct strategy_record *r = &tile->record[i];
        uint32_t part[2];
        memcpy(&part[0], &r->unweighted[0], sizeof part[0]);
        memcpy(&part[1], &r->unweighted[1], sizeof part[1]);
        if ((r->s == 2 && r->t == 1) || (r->s == 1 && r->t == 2))
            add_key(r->s == 2 ? light : eye, (uint64_t)part[0] << 32 | part[1]);
    }
}

/* What it takes to render tile passes by hand, of the whole picture. */
struct hand {
    struct render_job job;
    struct preparation prepared;
    struct tile tile;
    struct workspace *work;
};

static bool hand_init(struct test *t, const struct scene *scene, const char *integrator, uint64_t seed, int max_depth,
                      struct hand *h)
{
    struct render_options o = {.integrator = integrator, .seed = seed, .max_depth = max_depth, .n_threads = 1};
    struct error err;
    memset(h, 0, sizeof *h);
    if (!CHECK(t, render_prepare(scene, &o, render_crop(scene), &h->job, &h->prepared, &err), "%s", err.text))
        return false;
    h->work = workspaces_new(1, h->job.max_depth);
    h->work->scratch = method_scratch(&h->prepared);
    return true;
}

static void hand_pass(struct hand *h, long first, long end, bool records)
{
    struct pixel_rect all = h->job.film_rect;
    struct tile_pass pass = {&h->job, all, first, end, &h->tile, h->work, NULL};
    tile_start(&h->tile, all, all, &h->job.scene->filter, records);
    h->prepared.method->render(&h->prepared, &pass);
}

static void hand_free(struct hand *h)
{
    tile_free(&h->tile);
    method_scratch_free(&h->prepared, h->work->scratch);
    workspaces_free(h->work, 1);
    method_release(&h->prepared);
}

static void trace_all(struct test *t, const struct scene *scene, const char *integrator, uint64_t seed,
                      struct keys *eye, struct keys *light)
{
    struct hand h;
    if (!hand_init(t, scene, integrator, seed, 1, &h))
        return;
    int block = h.prepared.size.block == 0 ? LONGEST_BLOCK : h.prepared.size.block;
    block = block < ITERATIONS ? block : ITERATIONS;
    for (long first = 0; first < ITERATIONS; first += block) {
        hand_pass(&h, first, first + block, true);
        add_records(&h.tile, eye, light);
    }
    hand_free(&h);
}

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
            trace_all(t, &scene, integrator, test_seed(t) + seed, &eye, &light);
        CHECK(t, eye.n + light.n > ITERATIONS, "%s: only %lu sub-paths seen", WAYS[i],
              (unsigned long)(eye.n + light.n));
        long n_eye = (long)eye.n, n_light = (long)light.n, eyes = count_equal(&eye), lights = count_equal(&light);
        CHECK(t, eyes == 0, "%s: %ld of %ld eye sub-paths come twice", WAYS[i], eyes, n_eye);
        CHECK(t, lights == 0, "%s: %ld of %ld light sub-paths come twice", WAYS[i], lights, n_light);
    }
    scene_free(&scene);
}

/* --- replay ------------------------------------------------------------------------------------------ */

/* Render two iterations of all pixels with the numbers of the tape, from its beginning, or record them. */
static void play_back(struct test *t, const struct scene *scene, const char *integrator, uint64_t seed,
                      struct tape *tape, struct film *film)
{
    struct hand h;
    film_init(film, render_crop(scene), scene->width, scene->height);
    if (!hand_init(t, scene, integrator, 5, 4, &h))
        return;
    h.job.seed = h.job.eye_seed = seed; /* what was learnt stays as it is */
    h.job.tape = tape;
    tape->at = 0;
    hand_pass(&h, 0, 2, false);
    film_merge_tile(film, &h.tile);
    hand_free(&h);
}

/* A recorded sample replayed under another seed gives its value to the last bit, whatever the method. */
static void test_replay(struct test *t)
{
    struct scene scene;
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", 6, 4, &scene))
        return;
    for (int i = 0; i < N_WAYS; i++) {
        struct tape tape = {.n = 0}, other = {.n = 0};
        struct film film[3];
        const char *integrator = set_method(&scene, WAYS[i]);
        play_back(t, &scene, integrator, 1, &tape, &film[0]);
        size_t recorded = tape.n;
        play_back(t, &scene, integrator, 2, &tape, &film[1]);
        play_back(t, &scene, integrator, 2, &other, &film[2]);
        CHECK(t, recorded > 100 && tape.n == recorded && films_equal(&film[0], &film[1]),
              "%s: a replay differs; %lu numbers", WAYS[i], (unsigned long)recorded);
        CHECK(t, !films_equal(&film[0], &film[2]), "%s: numbers of its own make no difference", WAYS[i]);
        for (int k = 0; k < 3; k++)
            film_free(&film[k]);
        free(tape.number);
        free(other.number);
    }
    scene_free(&scene);
}

/* --- long renders ------------------------------------------------------------------------------------ */

enum { FIRST = 128, STEPS = 3, LAST = FIRST << (STEPS - 1), SIDE = 5, VALUES = SIDE * SIDE * 3, PAIRS = 10 };

/* Sums of one render after 128, 256 and 512 iterations. */
struct history {
    struct film film;
    double sum[STEPS][VALUES];
};

static bool note_sums(void *context, double done)
{
    struct history *h = context;
    (void)done;
    for (int k = 0; k < STEPS; k++)
        if (h->film.passes == 0 && h->film.iterations == FIRST << k)
            for (int i = 0; i < VALUES; i++)
                h->sum[k][i] = film_value(&h->film, (size_t)i);
    return true;
}

/* P-value of "the expectation is at most 0", by Student's t over n values. */
static double not_positive_p(const double *x, int n)
{
    double sum = 0, square = 0;
    for (int i = 0; i < n; i++)
        sum += x[i];
    for (int i = 0; i < n; i++)
        square += (x[i] - sum / n) * (x[i] - sum / n);
    double t = sum / n / sqrt(square / (n - 1) / n), two_sided = stats_student_p(t, n - 1);
    return t > 0 ? two_sided / 2 : 1 - two_sided / 2;
}

/* What two renders with seeds of their own differ by: free of the expectation, and as likely as its negative. */
struct difference {
    double sum[STEPS][VALUES];
};

/* P-value of "the first iterations and as many after them are not positively correlated" in n differences. `repeated`
 * is the share of the second half that is planted to be the first again. Every value is divided by its standard
 * deviation, lest the few pixels at edges of the light decide everything. */
static double halves_p(const struct difference *d, int n, int step, double repeated)
{
    double *correlation = mem_alloc((size_t)n, sizeof *correlation);
    double(*half)[2] = mem_alloc((size_t)n, sizeof *half);
    for (int i = 0; i < VALUES; i++) {
        double square[2] = {0, 0};
        for (int k = 0; k < n; k++) {
            double first = d[k].sum[step][i], second = d[k].sum[step + 1][i] - first;
            half[k][0] = first;
            half[k][1] = (1 - repeated) * second + repeated * first;
            for (int side = 0; side < 2; side++)
                square[side] += half[k][side] * half[k][side] / n;
        }
        for (int k = 0; k < n && square[0] > 0 && square[1] > 0; k++)
            correlation[k] += half[k][0] * half[k][1] / sqrt(square[0] * square[1]);
    }
    double p = not_positive_p(correlation, n);
    free(half);
    free(correlation);
    return p;
}

/* Uncorrelated halves, at every doubling, are a squared error that falls as 1/n. Low-discrepancy points may make them
 * complement each other, so correlations below 0 are welcome; only the other side is tested. */
static void test_way_falls(struct test *t, const struct scene *scene, const char *way, const char *integrator)
{
    int n = PAIRS * test_effort(t);
    struct difference *d = mem_alloc((size_t)n, sizeof *d);
    struct history *h = mem_alloc(1, sizeof *h);
    for (int k = 0; k < 2 * n; k++) {
        struct render_options o = {.integrator = integrator, .seed = test_seed(t) * 1000 + (uint64_t)k, .end = LAST,
                                   .n_threads = 2, .max_depth = 4, .progress = note_sums, .progress_context = h};
        render_film(t, scene, &o, &h->film);
        film_free(&h->film);
        for (int step = 0; step < STEPS; step++)
            for (int i = 0; i < VALUES; i++)
                d[k / 2].sum[step][i] += k % 2 == 0 ? h->sum[step][i] : -h->sum[step][i];
    }
    for (int step = 0; step + 1 < STEPS; step++)
        TEST_ACCEPT(t, halves_p(d, n, step, 0), "%s: iterations before and after %d are correlated", way,
                    FIRST << step);
    TEST_REJECT(t, halves_p(d, n, STEPS - 2, 0.5), "%s: half of the second half is the first", way);
    free(h);
    free(d);
}

static void test_falls(struct test *t)
{
    struct scene scene;
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", SIDE, SIDE, &scene))
        return;
    for (int i = 0; i < N_WAYS; i++)
        if (strstr(WAYS[i], "restart=0") == NULL) /* one block: there is nothing to see before its end */
            test_way_falls(t, &scene, WAYS[i], set_method(&scene, WAYS[i]));
    scene_free(&scene);
}

void test_streams(struct test *t)
{
    test_names(t);
    test_replay(t);
    test_sub_paths(t);
    test_falls(t);
}
