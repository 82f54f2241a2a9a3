/* test_drawn.c: what is drawn comes as often as is stated: light vertices of a fixed pool by every method that chooses
 * among them, lights by power and by the guide, and rays that leave lights.
 *
 * Methods are those of the method table that build something from a pool. bins has no pool: test_bins.c predicts what
 * it draws. Stratified draws scatter less than independent ones, so their p is near 1. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "integrators/loop.h"
#include "lab/stats.h"
#include "rivals/ris.h"
#include "tables/emission.h"
#include "bench.h"
#include "helpers.h"
#include "suites.h"
#include "tally.h"

enum { DRAWS = 100000, SIDE = 8, DEPTH = 4, OFTEN = 256, WAYS = RECORDS_NEAR + 1 };

/* What observers need to know. */
struct seen {
    struct tally *c;
    const struct pool *pool;
    const struct cache *ris; /* the same, of ris_join */
};

/* --- draws from a pool --------------------------------------------------------------------------------- */

/* A method that has a pool, which does not change, and an eye vertex. */
struct drawer {
    struct bench b;
    struct tile_pass pass;
    struct sample sample;
    int number; /* of the pixel */
};

/* How many of the light vertices that a cache of ris.h has are y, and their factors u. */
static int copies(const struct cache *r, const struct vertex *y, double *u)
{
    int n = 0;
    for (int v = 0; v < r->V; v++)
        if (r->found[v] == y) {
            *u = r->u != NULL ? r->u[v] : 1;
            n++;
        }
    return n;
}

/* The probability that is stated. Methods that draw by ris_draw state it of one copy, relative to u and to a sub-path
 * of the whole pool. */
static double stated(const struct drawer *d, const struct cache *cache, const struct drawn *drawn)
{
    double u = 1;
    return d->b.prepared.method->draw != ris_draw ? drawn->pmf
        : drawn->pmf * copies(cache, &drawn->path[drawn->first], &u) * u * d->b.work->pool.n / cache->K;
}

static struct drawn draw_one(const struct drawer *d, const struct cache *cache, const struct vertex *z, uint64_t k,
                             int i, int n)
{
    struct sample sample = d->sample;
    struct drawn out = {.end = 0};
    sample.choice = sampler_start(d->b.job.seed, RNG_TEST, k, 4 + (uint64_t)z->eye_hit);
    sample.i = d->number;
    d->b.prepared.method->draw(&d->b.prepared, cache, &sample, z, i, n, &out);
    return out;
}

/* Do numbers of the sample decide? Else all is decided when the cache is built. */
static bool draws_by_sample(const struct drawer *d, const struct cache *cache, const struct vertex *z)
{
    const struct drawn first = draw_one(d, cache, z, 0, 0, 1);
    for (uint64_t k = 1; k < 100; k++) {
        struct drawn other = draw_one(d, cache, z, k, 0, 1);
        if (other.path + other.first != first.path + first.first)
            return true;
    }
    return false;
}

/* A cache of the same pool. The arena is emptied from time to time: the pool is then traced again, by the same
 * numbers. */
static const struct cache *build_again(struct drawer *d, uint64_t k)
{
    if (k % OFTEN == 0)
        loop_fill(&d->b.prepared, &d->pass, 0);
    d->b.work->pool.n_candidates = 0;
    return d->b.prepared.method->build(&d->b.prepared, &d->pass, (long)(hash_mix(k) >> 34));
}

static size_t thing_of(const struct drawer *d, const struct drawn *drawn)
{
    return (size_t)(drawn->path + drawn->first - d->b.work->pool.vertex);
}

/* 10^5 draws by an eye vertex, in turn in all of its strata. */
static void check_vertex(struct test *t, struct drawer *d, const struct cache *cache, const struct vertex *z,
                         const char *name)
{
    int C = d->b.prepared.numbers.draws[z->eye_hit];
    struct tally c = tally_new(WAYS, d->b.work->pool.used + 1);
    for (uint64_t k = 0; k < 2 * DRAWS; k++) {
        struct drawn drawn = draw_one(d, cache, z, k, (int)(k % (uint64_t)C), C);
        c.collects = k < DRAWS;
        tally_note(&c, thing_of(d, &drawn), stated(d, cache, &drawn));
    }
    tally_judge(t, &c, DRAWS, 1, name, z->eye_hit == FIRST_HIT ? "first hit" : "later hit");
    tally_free(&c);
}

/* The same of 10^5 indices, each of which has drawn for all pixels: the draws of one, and those of all. */
static void check_indices(struct test *t, struct drawer *d, const struct vertex *z, const char *name)
{
    int n = d->b.tile.n_pixels, C = d->b.prepared.numbers.draws[z->eye_hit], own = d->number;
    struct tally one = tally_new(WAYS, d->b.work->pool.used + 1), all = tally_new(WAYS, d->b.work->pool.used + 1);
    for (uint64_t k = 0; k < 2 * DRAWS; k++) {
        const struct cache *cache = build_again(d, k);
        one.collects = all.collects = k < DRAWS;
        for (int i = 0; i < n * C; i++) {
            d->number = i / C;
            struct drawn drawn = draw_one(d, cache, z, k, i % C, C);
            tally_note(&all, thing_of(d, &drawn), drawn.pmf);
            if (i == own * C + (int)(k % (uint64_t)C))
                tally_note(&one, thing_of(d, &drawn), drawn.pmf);
        }
    }
    tally_judge(t, &one, DRAWS, 1, name, "a pixel");
    tally_judge(t, &all, (double)DRAWS * n * C, 1, name, "all pixels");
    tally_free(&one);
    tally_free(&all);
}

/* An eye sub-path that two vertices may draw. */
static bool see(struct test *t, struct drawer *d, const char *name)
{
    for (; pass_goes_on(&d->pass, d->number); d->number++) {
        arena_reset(&d->b.work->arena);
        int n = loop_begin(&d->b.prepared, &d->pass, d->number, 0, &d->sample);
        if (n > 3 && vertex_connectible(&d->sample.eye[1]) && vertex_connectible(&d->sample.eye[2]))
            return true;
    }
    return CHECK(t, false, "%s: no eye sub-path that can draw", name);
}

static void check_draws(struct test *t, struct drawer *d, const char *name)
{
    if (!see(t, d, name))
        return;
    const struct cache *cache = build_again(d, 0);
    if (draws_by_sample(d, cache, &d->sample.eye[1])) {
        check_vertex(t, d, cache, &d->sample.eye[1], name);
        check_vertex(t, d, cache, &d->sample.eye[2], name);
    } else {
        check_indices(t, d, &d->sample.eye[1], name);
    }
}

/* --- methods that draw on their own -------------------------------------------------------------------- */

static void note_joined(void *context, const struct sample *sample, const struct joined *path)
{
    const struct seen *seen = context;
    const struct vertex *y = path->s >= 2 && path->t == 2 ? &path->path[path->s - 1] : NULL;
    double u;
    (void)sample;
    if (y != NULL)
        tally_note(seen->c, (size_t)(y - seen->pool->vertex),
                   path->pmf * (seen->ris != NULL ? copies(seen->ris, y, &u) : 1));
}

/* By ris.c's own weights: one technique for each record nearby, and one without. */
static void check_ris(struct test *t, struct drawer *d, const char *name)
{
    struct cache r = {.scene = NULL};
    const struct vertex *z = &d->sample.eye[1];
    d->number = 0;
    if (!see(t, d, name))
        return;
    ris_begin(&r, &d->b.prepared, &d->pass, 1);
    struct tally c = tally_new(WAYS, r.pool->used + 1);
    struct seen seen = {&c, r.pool, &r};
    const struct observer observer = {.context = &seen, .joined = note_joined};
    d->pass.observer = &observer;
    for (uint64_t k = 0; k < 2 * DRAWS; k++) {
        c.collects = k < DRAWS;
        d->sample.choice = sampler_start(d->b.job.seed, RNG_TEST, k, 1);
        ris_join(&r, &d->sample, z, 2);
    }
    tally_judge(t, &c, DRAWS, WAYS, name, "by each technique");
    d->pass.observer = NULL;
    tally_free(&c);
    ris_end(&r);
}

/* The first stage of ris2: light vertices in proportion to L. */
static void check_presampled(struct test *t, struct drawer *d, const char *name)
{
    struct pool *pool = &d->b.work->pool;
    const struct ris *own = d->b.prepared.own;
    loop_fill(&d->b.prepared, &d->pass, 0);
    struct tally c = tally_new(WAYS, pool->used + 1);
    long draws = 0, passes = 2 * DRAWS / own->presampled;
    for (long k = 0; k < passes; k++) {
        build_again(d, (uint64_t)k);
        struct cache r = {.own = own, .found = pool->candidate, .V = pool->n_candidates};
        ris2_presample(&r, &d->pass, &pool->arena, (long)(hash_mix((uint64_t)k) >> 34));
        c.collects = k < passes / 2;
        draws += c.collects ? 0 : own->presampled;
        for (int v = 0; v < r.V; v++)
            tally_note(&c, (size_t)(r.found[v] - pool->vertex), 1 / (r.u[v] * own->presampled));
    }
    tally_judge(t, &c, (double)draws, 1, name, "first stage");
    tally_free(&c);
}

/* A method that draws while it renders: every eye sub-path of two vertices draws one light sub-path. */
struct whole {
    struct tally c;
    struct seen seen;
    const struct method *method;
    long eyes; /* that draw */
    bool chooses;
};

static void note_walked(void *context, const struct sample *sample, enum transport mode, const struct vertex *path,
                        int n)
{
    struct whole *w = context;
    (void)sample, (void)path;
    w->eyes += mode == RADIANCE && n > 1 && !w->c.collects;
}

static void note_whole(void *context, const struct sample *sample, const struct joined *path)
{
    struct whole *w = context;
    w->chooses = w->chooses || path->pmf < 1;
    if (path->s == 2)
        note_joined(&w->seen, sample, path);
}

static struct cache *build_fixed(const struct prepared *p, const struct tile_pass *pass, long iteration)
{
    const struct whole *w = pass->observer->context;
    loop_fill(p, pass, 0);
    return w->method->build(p, pass, iteration);
}

static void check_whole(struct test *t, struct drawer *d, const char *name)
{
    const struct method *method = d->b.prepared.method;
    struct method fixed = *method;
    struct whole w = {.c = tally_new(WAYS, d->b.work->pool.used + 1), .method = method};
    const struct observer observer = {.context = &w, .walked = note_walked, .joined = note_whole};
    int passes = 2 * DRAWS / (SIDE * SIDE);
    w.seen = (struct seen){&w.c, &d->b.work->pool, NULL};
    fixed.build = method->build != NULL ? build_fixed : NULL;
    fixed.draw = NULL;
    d->b.prepared.method = &fixed;
    d->pass.observer = &observer;
    for (int i = 0; i < passes; i++) {
        w.c.collects = i < passes / 2;
        d->pass.first = (long)(hash_mix((uint64_t)i) >> 34);
        d->pass.end = d->pass.first + 1;
        method->render(&d->b.prepared, &d->pass);
        if (i == 0 && !w.chooses)
            break; /* each pixel has a light sub-path of its own */
    }
    if (w.chooses)
        tally_judge(t, &w.c, (double)w.eyes, 1, name, "first vertices");
    d->pass.observer = NULL;
    d->b.prepared.method = method;
    tally_free(&w.c);
}

/* --- all methods ---------------------------------------------------------------------------------------- */

static bool has_own(const struct method *m, const char *name)
{
    return m->own != NULL && field_find(m->own, name) != NULL;
}

static bool draws(const struct method *m) { return m->draw != NULL; }

/* Without a race, which may find that nothing is to be drawn. */
static void check_method(struct test *t, struct scene *scene, const struct method *m)
{
    struct drawer d = {.number = 0};
    char way[128];
    snprintf(way, sizeof way, "%s%s", method_name(m), method_has(m, "race") != NULL ? " race=off" : "");
    if (!bench_new(t, scene, set_method(scene, way), draws(m) ? DEPTH : 2, 0, &d.b))
        return;
    d.pass = bench_pass(&d.b, 0, 1);
    loop_fill(&d.b.prepared, &d.pass, 0);
    for (int k = 0; k < d.b.work->pool.n; k++)
        CHECK(t, d.b.work->pool.length[k] > 0, "%s: sub-path %d is empty, as its neighbour may be", way, k);
    if (draws(m))
        check_draws(t, &d, way);
    else
        check_whole(t, &d, way);
    if (has_own(m, "weights"))
        check_ris(t, &d, way);
    if (has_own(m, "presampled"))
        check_presampled(t, &d, way);
    bench_free(&d.b);
}

static void test_methods(struct test *t)
{
    struct scene scene;
    int n = 0;
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", SIDE, SIDE, &scene))
        return;
    for (const struct method *const *m = method_rows; *m != NULL; m++)
        if ((*m)->build != NULL) {
            check_method(t, &scene, *m);
            n++;
        }
    CHECK(t, n > 9, "only %d methods build something from a pool", n);
    scene_free(&scene);
}

/* --- lights --------------------------------------------------------------------------------------------- */

/* A sky with an image, two lamps and more points of light than there are cells for lamps, above a floor. */
static bool load_lights(struct test *t, struct scene *out)
{
    enum { POINTS = 2000, LINE = 100, SIZE = 1000 + POINTS * LINE };
    char *text = mem_alloc(SIZE, 1), top[512];
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 890, 0);
    size_t used = (size_t)snprintf(text, SIZE,
        "LookAt 0 2 -5  0 0 0  0 1 0 Camera \"perspective\" Film \"image\" \"integer xresolution\" 8 "
        "\"integer yresolution\" 8 WorldBegin\n"
        "LightSource \"infinite\" \"string mapname\" \"%sscenes/test/colours.tga\"\n"
        "Material \"matte\" Shape \"sphere\" \"float radius\" 9 " QUAD("-3 0 -3  3 0 -3  3 0 3  -3 0 3")
        "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [9 9 9]\n" QUAD("-1 2 -1  1 2 -1  1 2 1  -1 2 1")
        "Shape \"disk\" AttributeEnd\n", top_directory(top, sizeof top));
    for (int i = 0; i < POINTS; i++)
        used += (size_t)snprintf(text + used, SIZE - used,
                                 "LightSource \"point\" \"point from\" [%.3f %.3f %.3f] \"rgb I\" [%.3f 1 1]\n",
                                 4 * rng_uniform(&r) - 2, 0.2 + rng_uniform(&r), 4 * rng_uniform(&r) - 2,
                                 5 * rng_uniform(&r));
    snprintf(text + used, SIZE - used, "WorldEnd");
    bool ok = scene_from_text(t, text, out);
    free(text);
    return ok;
}

/* s = 1 draws a cell by the row of the eye vertex, then a light in it, then a point. Things are the sky's cells and all
 * other lights; the density of a point on one is the same everywhere. */
static void check_lights(struct test *t, const struct scene *scene, const struct bench *b, const struct vertex *z,
                         const char *name)
{
    const struct light_set *lights = &scene->lights;
    const struct table *direct = &b->prepared.counts.tables->guide;
    struct tally c = tally_new(WAYS, (size_t)(lights->n + lights->n_cells));
    for (uint64_t k = 0; k < 2 * DRAWS; k++) {
        struct sampler sampler = sampler_start(b->job.seed, RNG_TEST, k, 2);
        struct light_point at;
        double pdf;
        c.collects = k < DRAWS;
        if (!light_draw(scene, &b->prepared.counts, z, &sampler, (int)(k % 2), 2, &at, &pdf) || pdf == 0)
            continue;
        const struct light *light = &lights->light[at.light];
        if (light->kind == LIGHT_INFINITE)
            tally_note(&c, (size_t)(lights->n + at.cell),
                       alias_pmf(&lights->choice, at.cell) * table_ratio(direct, z->place, at.cell));
        else
            tally_note(&c, (size_t)at.light,
                       pdf * (light->kind == LIGHT_AREA ? shape_area(&scene->geo, light->prim) : 1));
    }
    tally_judge(t, &c, DRAWS, 1, name, "lights");
    tally_free(&c);
}

/* Light sub-paths draw a cell and a bin of its rays; by power all bins of a cell are equally likely. */
static void check_rays(struct test *t, const struct scene *scene, const struct bench *b, const char *name)
{
    const struct light_set *lights = &scene->lights;
    const struct table *emission = &b->prepared.counts.tables->emission;
    double *base;
    struct axis axis = emission_axis_new(lights, &base);
    struct tally c = tally_new(WAYS, (size_t)axis.n);
    for (uint64_t k = 0; k < 2 * DRAWS; k++) {
        struct sampler sampler = sampler_start(b->job.seed, RNG_TEST, k, 3);
        double u[3], square[2], pdf;
        int left_by;
        struct light_point y0;
        struct ray ray;
        u[0] = sampler_number(&sampler, DRAW_LIGHT);
        sampler_pair(&sampler, DRAW_LIGHT_POINT, &u[1]);
        sampler_pair(&sampler, DRAW_EMISSION, square);
        emission_sample(emission, lights, &scene->geo, u, square, &y0, &ray, &pdf, &left_by);
        int column = emission_column_of(lights, &y0, ray.o, ray.d);
        c.collects = k < DRAWS;
        tally_note(&c, (size_t)column, base[column] * table_ratio(emission, 0, column));
    }
    tally_judge(t, &c, DRAWS, 1, name, "rays that leave lights");
    tally_free(&c);
    emission_axis_free(&axis, base);
}

static void test_lights_drawn(struct test *t)
{
    static const char *const WAYS_TO[] = {"lvc", "lvc guide=on emission=.2"};
    struct scene scene;
    if (!load_lights(t, &scene))
        return;
    for (int i = 0; i < 2; i++) {
        struct drawer d = {.number = 0};
        if (!bench_new(t, &scene, set_method(&scene, WAYS_TO[i]), DEPTH, 0, &d.b))
            continue;
        const struct tables *known = d.b.prepared.counts.tables;
        CHECK(t, (known->guide.rows > 0) == (i > 0) && (known->emission.rows > 0) == (i > 0), "%s: tables of %d and "
              "%d rows", WAYS_TO[i], known->guide.rows, known->emission.rows);
        d.pass = bench_pass(&d.b, 0, 1);
        loop_fill(&d.b.prepared, &d.pass, 0);
        if (see(t, &d, WAYS_TO[i]))
            check_lights(t, &scene, &d.b, &d.sample.eye[1], WAYS_TO[i]);
        check_rays(t, &scene, &d.b, WAYS_TO[i]);
        bench_free(&d.b);
    }
    scene_free(&scene);
}

/* --- the test itself ------------------------------------------------------------------------------------ */

/* Draws of a hundred things, of which the last `lost` of each row are never drawn; the p-value. */
static double planted(struct test *t, double lost)
{
    enum { THINGS = 100 };
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 891, (uint64_t)(1000 * lost));
    double before[THINGS + 1] = {0}, sum;
    struct tally c = tally_new(WAYS, THINGS);
    for (int i = 0; i < THINGS; i++)
        before[i + 1] = before[i] + (i == 0 ? 50 : 1 + i % 3);
    for (int k = 0; k < 2 * DRAWS; k++) {
        c.collects = k < DRAWS;
        int i = cumulative_find(before, THINGS, rng_uniform(&r) * (1 - lost) * before[THINGS]);
        tally_note(&c, (size_t)i, (before[i + 1] - before[i]) / before[THINGS]);
    }
    double p = tally_p(&c, DRAWS, &sum);
    tally_free(&c);
    return p;
}

void test_drawn(struct test *t)
{
    test_methods(t);
    test_lights_drawn(t);
    TEST_ACCEPT(t, planted(t, 0), "planted: nothing is lost");
    TEST_REJECT(t, planted(t, 0.03), "planted: 3 %% are never drawn");
    TEST_REJECT(t, planted(t, 0.005), "planted: half a per cent is never drawn");
}
