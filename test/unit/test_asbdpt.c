/* test_asbdpt.c: selection of light sub-paths: the unbiased selections agree with path tracing, the dissertation's
 * does not. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "agree.h"
#include "bench.h"
#include "helpers.h"
#include "suites.h"

/* --- bias -------------------------------------------------------------------------------------------- */

/* Against the stored reference bdpt passes and bins does not. */
static void test_bias(struct test *t)
{
    struct scene scene;
    struct batches reference;
    int width, height;
    enum { DEPTH = 6 }; /* the reference's; set_method clears the scene's own */
    if (!load_reference(t, "cornell-box", 16, &width, &height, &reference) ||
        !scene_from_file(t, "scenes/cornell-box.pbrt", width, height, &scene))
        return;
    double ratio;
    struct batches bdpt = render_batches(t, &scene, "bdpt", DEPTH, 2, 16, 16, 53);
    struct batches bins = render_batches(t, &scene, set_method(&scene, "asbdpt select=bins"), DEPTH, 2, 16, 16, 53);
    double p = batches_p(&bdpt, &reference, &ratio), p_bins = batches_p(&bins, &reference, &ratio);
    TEST_ACCEPT(t, p, "Cornell box against its reference, bdpt");
    TEST_REJECT(t, p_bins, "Cornell box against its reference, bins: ratio %.4f", ratio);
    batches_free(&bins);
    batches_free(&bdpt);
    scene_free(&scene);
    batches_free(&reference);
}

/* --- agreement ---------------------------------------------------------------------------------------- */

/* The others make the picture that bdpt makes of the same eye sub-paths, which is a sharper test. */
#define EVERY                                                                                                          \
    "asbdpt select=pool metric=importance, asbdpt select=vertices connections=3, asbdpt select=subspaces race=off,"   \
    "lvc connections=2, cbdpt connections=2"
/* Services, each alone, on a method whose choice learns nothing; and what rivals have of them. */
#define ALONE                                                                                                          \
    "lvc guide=on, lvc emission=0.2, lvc tile=5 spread=3, lvc lightpoints=3, lvc race=on,"                             \
    "asbdpt select=pool guide=off emission=0.2"
#define RIVALS                                                                                                         \
    "pcbdpt guide=on emission=0.2 tile=9 spread=2 records=.05 lightpoints=2, mbdpt lightpoints=2,"                     \
    "ris emission=0.2 tile=9 spread=2 records=.05, ris2 emission=0.2 tile=9 spread=2 records=.05,"                     \
    "spcbpt guide=on emission=0.2 tile=9 spread=2 lightpoints=2, cbdpt race=on lightpoints=2,"                         \
    "restir guide=on emission=0.2 tile=9 spread=2"
/* A box of red walls with a lamp whose red is below 0, which is all that they leave of its light. */
#define NARROW                                                                                                         \
    "LookAt 0 0 -.9  0 0 1  0 1 0 Camera \"perspective\" \"float fov\" 90 PixelFilter \"box\"\n"                        \
    "Film \"image\" \"integer xresolution\" 12 \"integer yresolution\" 12\n"                                            \
    "WorldBegin AttributeBegin AreaLightSource \"diffuse\" \"spectrum L\" [515 0 520 9 525 0] Translate 0 .99 0\n"     \
    "Rotate 90 1 0 0 Shape \"disk\" \"float radius\" .3 AttributeEnd\n"                                              \
    "Material \"matte\" \"rgb Kd\" [.9 0 0] Shape \"trianglemesh\" \"integer indices\" [0 3 1 0 2 3 4 5 7 4 7 6\n"    \
    "0 1 5 0 5 4 2 7 3 2 6 7 0 6 2 0 4 6 1 3 7 1 7 5] \"point P\" [-1 -1 -1 1 -1 -1 -1 1 -1 1 1 -1 -1 -1 1 1 -1 1\n"    \
    "-1 1 1 1 1 1] WorldEnd"
static const struct agreement QUICK[] = {
    {NARROW, 12, 12, 5, "bdpt", "asbdpt select=pool, asbdpt select=vertices, asbdpt race=off, lvc", 4, 4, 16, 6, true,
     0.1},
    {NARROW, 12, 12, 5, "pt", "lt", 32, 32, 16, 6, false, 0.1},
    {"scenes/cornell-box", 16, 16, 4, "bdpt",
     "asbdpt select=pool metric=constant, asbdpt select=pool metric=throughput, asbdpt select=pool metric=importance,"
     "asbdpt select=vertices connections=2, asbdpt select=subspaces, asbdpt select=subspaces connections=2,"
     "asbdpt guide=off emission=1 tile=16 spread=1, asbdpt select=pool emission=0.2,"
     "asbdpt select=vertices emission=0.2 tile=32, mbdpt emission=0.2 spread=2,"
     "cbdpt connections=3 emission=0.2, lvc connections=1, cbdpt connections=3", 1, 1, 16, 16, true, 0.1},
    /* one tile of 3x3 pixels, whose light sub-paths are one for every 1, 2, 5 or 8 of them: 9, 5, 2 and 2 */
    {"scenes/cornell-box-modified", 3, 3, 4, "bdpt",
     "asbdpt select=vertices connections=2 pathpixels=1, asbdpt select=vertices connections=2 pathpixels=2,"
     "asbdpt select=vertices connections=2 pathpixels=5, asbdpt select=vertices connections=2 pathpixels=8,"
     "asbdpt select=subspaces pathpixels=2 race=off, asbdpt select=subspaces pathpixels=5 race=off,"
     "asbdpt select=subspaces pathpixels=9 race=off, lvc connections=1 pathpixels=5, lvc connections=1 pathpixels=9,"
     "cbdpt connections=3 pathpixels=2, cbdpt connections=3 pathpixels=5, cbdpt connections=1 pathpixels=9",
     64, 64, 16, 3, true, 0.1},
    {"scenes/test/light-kinds", 18, 12, 4, "bdpt", ALONE ", " RIVALS, 4, 4, 16, 8, true, 0.1},
    {"scenes/media/inside", 18, 12, 4, "bdpt", ALONE, 2, 2, 16, 8, true, 0.6},
    {"scenes/test/light-kinds", 16, 16, 4, "bdpt", EVERY, 2, 2, 16, 8, true, 0.1},
    {"scenes/test/mirror-glass", 16, 16, 4, "bdpt", EVERY, 2, 2, 16, 8, true, 0.1},
    {"scenes/test/all-materials", 16, 16, 4, "bdpt", EVERY, 2, 2, 16, 8, true, 0.1},
    {"scenes/test/smooth-normals", 16, 16, 4, "bdpt", EVERY, 2, 2, 16, 8, true, 0.1}};
/* Cameras, copies and holes; services where they matter. */
static const struct agreement LONG[] = {
    {"scenes/test/thin-lens", 16, 16, 4, "bdpt", EVERY, 4, 4, 16, 8, true, 0},
    {"scenes/test/negative-scale", 16, 16, 4, "bdpt", EVERY, 4, 4, 16, 8, true, 0},
    {"scenes/test/alpha", 16, 16, 4, "bdpt", EVERY, 4, 4, 16, 8, true, 0},
    {"scenes/test/instances", 16, 16, 4, "bdpt", EVERY, 4, 4, 16, 8, true, 0},
    {"scenes/many-lights", 18, 12, 4, "bdpt", ALONE ", " RIVALS, 64, 64, 16, 8, true, 0},
    {"scenes/media/inside", 18, 12, 4, "bdpt", ALONE, 32, 32, 16, 8, true, 0}};

/* What small pictures of few lights do not have: columns far to the right, paths of many edges. */
#define POOLED "asbdpt select=pool, asbdpt select=vertices, asbdpt race=off, lvc connections=2"
static const struct agreement LARGE[] = {
    {"scenes/cornell-box-modified", 136, 5, 4, "bdpt", POOLED, 2, 2, 16, 8, true, 0},
    {"scenes/corridor", 18, 6, 12, "bdpt", POOLED, 4, 4, 16, 6, true, 0}};

/* n lamps and a sky above a room without a ceiling, in a crop window. So many lamps share cells, and with the sky there
 * are more than 256 cells. */
static void test_many_lamps(struct test *t, int n)
{
    static const struct agreement by = {"many lamps", 24, 16, 3, "bdpt",
                                        "asbdpt race=off, asbdpt select=vertices guide=on", 4, 4, 16, 8, true, 0};
    enum { LINE = 120 };
    size_t size = (size_t)(n + 12) * LINE, used = 0;
    char *text = mem_alloc(size, 1);
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 881, (uint64_t)n);
    struct scene scene;
    used += (size_t)snprintf(text, size, "LookAt 0 3 -6  0 1 0  0 1 0 Camera \"perspective\" \"float fov\" 60\n"
                             "PixelFilter \"box\" Film \"image\" \"integer xresolution\" 48\n"
                             "\"integer yresolution\" 32 \"float cropwindow\" [.25 .75 .4 .9]\n"
                             "WorldBegin LightSource \"infinite\" \"rgb L\" [.1 .1 .1]\n");
    for (int i = 0; i < n; i++) {
        double x = 6 * rng_uniform(&r) - 3, y = 0.2 + 2 * rng_uniform(&r), z = 6 * rng_uniform(&r) - 3;
        double I = (1 + 30 * rng_uniform(&r)) / n;
        used += (size_t)snprintf(text + used, size - used, "LightSource \"point\" \"point from\" [%.3f %.3f %.3f] "
                                 "\"rgb I\" [%g %g %g]\n", x, y, z, I, I, I);
    }
    snprintf(text + used, size - used, "Material \"matte\" " QUAD("-3.1 0 -3.1  3.1 0 -3.1  3.1 0 3.1  -3.1 0 3.1")
             QUAD("-3.1 0 3.1  3.1 0 3.1  3.1 3 3.1  -3.1 3 3.1") "WorldEnd\n");
    if (scene_from_text(t, text, &scene)) {
        CHECK(t, scene.lights.n_cells > 256, "%d lamps and a sky: %d cells", n, scene.lights.n_cells);
        check_agreement_in(t, &scene, &by, 1);
        scene_free(&scene);
    }
    free(text);
}

/* --- bins age ----------------------------------------------------------------------------------------- */

/* Until something is older than `maxage` iterations nobody could tell whether it would be replaced; then pictures
 * differ, as they do from where the bins are thrown away. */
#define BINS "asbdpt select=bins "
static void test_age(struct test *t)
{
    static const struct {
        const char *a, *b;
        int same; /* iterations */
    } cases[] = {{BINS "maxage=24 restart=0", BINS "maxage=0 restart=0", 25},
                 {BINS "maxage=3 restart=0", BINS "maxage=0 restart=0", 4},
                 {BINS "maxage=5 restart=0", BINS "maxage=7 restart=0", 6},
                 {BINS "maxage=0 restart=8", BINS "maxage=0 restart=0", 8}};
    struct scene scene;
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", 12, 12, &scene))
        return;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        for (int more = 0; more < 2; more++) {
            struct render_job o = {.end = cases[i].same + more, .max_depth = 4, .n_threads = 1};
            CHECK(t, same_picture(t, &scene, cases[i].a, cases[i].b, o) == (more == 0),
                  "%s and %s: after %d iterations pictures %s", cases[i].a, cases[i].b, cases[i].same + more,
                  more == 0 ? "differ" : "are the same");
        }
    scene_free(&scene);
}

/* --- cbdpt with one light sub-path is BDPT --------------------------------------------------- */

/* And with two sub-paths it is something else. */
static void test_one_path(struct test *t)
{
    const struct render_job o = {.end = 20, .max_depth = 4};
    struct scene scene;
    if (!scene_from_file(t, "scenes/test/light-kinds.pbrt", 40, 24, &scene))
        return;
    CHECK(t, same_picture(t, &scene, "bdpt guide=off", "cbdpt connections=1", o), "cbdpt with M = 1 is not bdpt");
    CHECK(t, !same_picture(t, &scene, "bdpt guide=off", "cbdpt connections=2", o), "cbdpt with M = 2 is bdpt");
    scene_free(&scene);
}

/* --- how many light vertices the cache expects -------------------------------------------------------- */

/* A light in a closed white ball: all vertices but the light point are to be connected to. */
static const char BALL[] = "Camera \"perspective\" WorldBegin LightSource \"point\"\n"
                           "Material \"matte\" \"rgb Kd\" [1 1 1] Shape \"sphere\" \"float radius\" 2 WorldEnd\n";

/* A spot light on a mirror, which throws all of it onto a ceiling; from there it meets the mirror again or leaves. */
static const char MIRROR[] =
    "Camera \"perspective\" WorldBegin\n"
    "LightSource \"spot\" \"point from\" [0 1 0] \"point to\" [0 0 0] \"float coneangle\" 10\n"
    "Material \"mirror\" " QUAD("-2 0 -2  2 0 -2  2 0 2  -2 0 2")
    "Material \"matte\" " QUAD("-2 3 -2  2 3 -2  2 3 2  -2 3 2") "WorldEnd\n";

/* The count of lvc is C / l, known here exactly. A scene without any light vertex must not make it infinite. */
static void test_expected_vertices(struct test *t)
{
    static const struct {
        const char *name, *text;
        int depth;
        double count;
    } cases[] = {{"ball", BALL, 4, 3.0 / 4}, {"ball", BALL, 1, 3}, {"mirror", MIRROR, 3, 3}, {"mirror", MIRROR, 1, 3}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct scene scene;
        struct bench b;
        if (!scene_from_text(t, cases[i].text, &scene) ||
            !bench_new(t, &scene, set_method(&scene, "lvc connections=3"), cases[i].depth, 0, &b))
            return;
        const double *count = b.prepared.counts.pair;
        CHECK(t, count[FIRST_HIT] == cases[i].count && count[LATER_HIT] == cases[i].count,
              "%s, maxdepth %d: lvc counts %g and %g draws, not %g", cases[i].name, cases[i].depth, count[FIRST_HIT],
              count[LATER_HIT], cases[i].count);
        bench_free(&b);
        scene_free(&scene);
    }
}

/* Draws of subspaces count as less than a quarter of a full tile's light sub-paths, those of lvc have no bound. */
static void test_bound(struct test *t)
{
    static const struct {
        const char *name;
        double M;
    } cases[] = {{"asbdpt race=off", 256}, {"asbdpt race=off tile=16 pathpixels=4", 16}, {"lvc", INFINITY}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct scene scene;
        struct bench b;
        if (!scene_from_text(t, BALL, &scene) || !bench_new(t, &scene, set_method(&scene, cases[i].name), 4, 0, &b))
            return;
        const struct counts *c = &b.prepared.counts;
        for (int end = 0; end < EYE_HITS; end++)
            CHECK(t, c->pair[end] > 0 && fabs(c->bound[end] - c->pair[end] / cases[i].M) < 1e-12,
                  "%s: draws that count as %g have the bound %g, not %g", cases[i].name, c->pair[end],
                  c->pair[end] / c->bound[end], cases[i].M);
        bench_free(&b);
        scene_free(&scene);
    }
}

/* --- the weights know what samples are worth ---------------------------------------------------------- */

/* Mean over pixels of the variance between batches. */
static double variance_of(struct test *t, const struct scene *scene, const char *integrator)
{
    struct batches b = render_batches(t, scene, integrator, 4, 64, 6, 1, 73);
    double sum = 0;
    for (long i = 0; i < b.n; i++)
        sum += batches_moments(&b, i).variance / (double)b.n;
    batches_free(&b);
    return sum;
}

/* An object under an even sky: the first bounce finds it best. Were light points alone counted for more than they are,
 * they would take over weight from it, and asbdpt would have more variance than bdpt for as many samples. */
static void test_even_sky(struct test *t)
{
    struct scene scene;
    if (!scene_from_file(t, "scenes/features/light-infinite.pbrt", 20, 12, &scene))
        return;
    double bdpt = variance_of(t, &scene, "bdpt");
    double asbdpt = variance_of(t, &scene, set_method(&scene, "asbdpt race=off"));
    CHECK(t, asbdpt < 0.95 * bdpt, "variance under an even sky: asbdpt %g, bdpt %g", asbdpt, bdpt);
    scene_free(&scene);
}

/* --- what draws count for ------------------------------------------------------------------------------ */

/* Draws of one tile pass: divided by the probability, their number and that of the light sub-paths, as a fact. */
struct draws {
    double number, paths; /* C and K */
    bool whole;           /* sub-paths are drawn, not vertices for an eye region */
    int spoilt;           /* every sub-path is, or every 2nd; 0: none */
    double delta;         /* of pool, whose importance is throughput; 0: no probability is known */
    const struct method *method;
    long told;
    double worst; /* largest relative difference */
    double q[256], unlike; /* [paths] what the formula says; the largest relative difference from it */
    const struct pool *pool;
    double astray; /* of whole sub-paths: the largest relative difference from what the table says */
    /* Of the eye region that is looked at, -1: any: */
    const struct vertex *drawn[256]; /* [n] unlike ones, whose probabilities sum to: */
    int n, region;
    double sum, least;
};

static void note_draw(void *context, const struct sample *sample, const struct joined *path)
{
    struct draws *d = context;
    const struct vertex *what = path->s < 2 || d->whole ? path->path : &path->path[path->s - 1];
    int i = 0;
    (void)sample;
    if (path->s < 2 || path->t < 2)
        return;
    d->told++;
    d->worst = most_of(d->worst, fabs(path->scale * path->pmf * d->number * d->paths - 1));
    for (int k = 0; d->whole && k < d->pool->n; k++) {
        if (d->pool->length[k] == 0 || pool_path(d->pool, k) != what)
            continue;
        d->astray = most_of(d->astray, fabs(path->pmf / alias_pmf(&d->pool->alias, k) - 1));
        if (d->delta > 0)
            d->unlike = most_of(d->unlike, fabs(path->pmf / d->q[k] - 1));
    }
    d->region = d->region < 0 ? path->z->place : d->region;
    while (i < d->n && d->drawn[i] != what)
        i++;
    if (i < d->n || i == 256 || (!d->whole && d->region != path->z->place))
        return;
    d->drawn[d->n++] = what;
    d->sum += path->pmf;
    d->least = d->n == 1 ? path->pmf : fmin(d->least, path->pmf);
}

/* The furthest vertices get throughputs by which nothing can be chosen, or very small and very large ones. */
static struct cache *spoil(const struct prepared *p, const struct tile_pass *pass, long iteration)
{
    static const double useless[] = {-1e9, NAN, INFINITY, -INFINITY};
    struct draws *d = pass->observer->context;
    struct pool *pool = &pass->work->pool;
    double sum = 0;
    for (int k = 0; k < pool->n; k++) {
        struct vertex *path = &pool->vertex[pool->start[k]], *last = path + pool->length[k] - 1;
        if (pool->length[k] > 0 && d->spoilt > 0 && k % d->spoilt == 0)
            last->beta = rgb_grey(useless[k / d->spoilt % 4]);
        else if (pool->length[k] > 0 && d->delta > 0)
            last->beta = rgb_scale(last->beta, pow(10, k % 7 - 3));
        sum += d->q[k] = d->delta > 0 ? path_throughput(path, pool->length[k]) : 0;
    }
    for (int k = 0; k < pool->n; k++)
        d->q[k] = (1 - d->delta) * d->q[k] / sum + d->delta / d->paths;
    return d->method->build(p, pass, iteration);
}

static void check_draws(struct test *t, struct scene *scene, const char *way, struct draws d, double least)
{
    struct bench b;
    const struct observer observer = {.context = &d, .joined = note_draw};
    if (!bench_new(t, scene, set_method(scene, way), 4, 1 - test_seed(t), &b))
        return;
    struct tile_pass pass = bench_pass(&b, 0, 1);
    pass.observer = &observer;
    d.pool = &pass.work->pool;
    struct method spoiling = *b.prepared.method;
    d.method = b.prepared.method;
    spoiling.build = spoil;
    b.prepared.method = d.spoilt > 0 || d.delta > 0 ? &spoiling : d.method;
    b.prepared.method->render(&b.prepared, &pass);
    b.prepared.method = d.method;
    CHECK(t, d.told > 100 && d.worst < 1e-9, "%s: %ld draws, what they count for is off by %g", way, d.told, d.worst);
    double useless = d.spoilt == 1 ? 1 : 0.1; /* if nothing is of any use delta is 1 */
    bool left = d.spoilt == 0 || fabs(d.least * d.paths - useless) < 1e-9;
    bool right = d.sum < 1 + 1e-9 && d.sum > least && d.unlike < 1e-9 && left;
    /* The others say nothing of q if what was drawn is not told with the q of its own. */
    if (CHECK(t, right || d.astray < 1e-9, "%s: the pmf of a draw is not its table's: a factor of %g", way,
              d.astray + 1)) {
        CHECK(t, d.sum < 1 + 1e-9, "%s: probabilities of %d that were drawn sum to %g", way, d.n, d.sum);
        CHECK(t, d.sum > least, "%s: too few, %d, are drawn: their probabilities sum to %g", way, d.n, d.sum);
        CHECK(t, d.unlike < 1e-9, "%s: q of a sub-path is off by a factor of %g", way, d.unlike + 1);
        CHECK(t, left, "%s: what is no importance has %g times the probability that delta leaves it", way,
              d.least * d.paths / useless);
    }
    bench_free(&b);
}

/* 256 pixels. Where they share one light sub-path, whatever can be drawn is drawn soon: with the
 * seed 1, whose sub-path is short enough for every eye vertex. */
void test_draws(struct test *t)
{
    struct scene scene;
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", 16, 16, &scene))
        return;
    check_draws(t, &scene, "asbdpt select=pool", (struct draws){.number = 1, .paths = 256, .whole = true}, 0.5);
    check_draws(t, &scene, "asbdpt select=pool metric=throughput delta=0.3",
                (struct draws){.number = 1, .paths = 256, .whole = true, .delta = 0.3}, 0.01);
    for (int spoilt = 2; spoilt > 0; spoilt--)
        check_draws(t, &scene, "asbdpt select=pool metric=throughput",
                    (struct draws){.number = 1, .paths = 256, .whole = true, .spoilt = spoilt}, 0.4);
    check_draws(t, &scene, "asbdpt select=vertices connections=3 pathpixels=4",
                (struct draws){.number = 3, .paths = 64, .region = -1}, 0);
    check_draws(t, &scene, "asbdpt select=vertices connections=3 pathpixels=256",
                (struct draws){.number = 3, .paths = 1, .region = -1}, 0.999);
    check_draws(t, &scene, "asbdpt connections=3 later=3 pathpixels=4 race=off",
                (struct draws){.number = 3, .paths = 64, .region = -1}, 0);
    check_draws(t, &scene, "asbdpt connections=3 later=3 pathpixels=256 race=off",
                (struct draws){.number = 3, .paths = 1, .region = -1}, 0.999);
    scene_free(&scene);
}

void test_asbdpt(struct test *t)
{
    test_bias(t);
    test_age(t);
    check_agreements(t, QUICK, sizeof QUICK / sizeof QUICK[0], 1);
    check_agreements(t, LARGE, sizeof LARGE / sizeof LARGE[0], 1);
    test_many_lamps(t, 2000);
    test_one_path(t);
    test_expected_vertices(t);
    test_bound(t);
    test_even_sky(t);
}

void test_asbdpt_long(struct test *t)
{
    check_agreements(t, LONG, sizeof LONG / sizeof LONG[0], 1);
    test_many_lamps(t, 300);
}
