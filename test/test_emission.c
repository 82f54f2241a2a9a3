/* test_emission.c: how light sub-paths leave the lights (emission.h): draws have the density that is stated. The
 * numbers of a ray are found again for every kind of light, and what is learnt is what the rays show. That the image is
 * the same for every table is in test_asbdpt.c. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/rng.h"
#include "caustics/lamp.h"
#include "lab/numbers.h"
#include "lab/stats.h"
#include "tables/emit.h"
#include "tables/tables.h"
#include "transport/path.h"
#include "helpers.h"
#include "tests.h"

/* Every kind of light, and every shape a lamp can have; %s: more of them. A ball gives the scene its size. */
static const char LIGHTS[] =
    "WorldBegin Shape \"sphere\" \"float radius\" 9\n"
    "LightSource \"point\" \"rgb I\" [1 2 3] \"point from\" [1 2 3]\n"
    "AttributeBegin Rotate 30 1 2 3 Scale 1 2 -.7\n"
    "LightSource \"spot\" \"rgb I\" [9 9 9] \"point from\" [1 2 3] \"point to\" [0 1 0] \"float coneangle\" 40\n"
    "AttributeEnd\n"
    "LightSource \"spot\" \"rgb I\" [2e5 2e5 2e5] \"point from\" [1 2 3] \"point to\" [0 1 0] \"float coneangle\" .4\n"
    "LightSource \"distant\" \"rgb L\" [.1 .1 .1] \"point from\" [1 4 -1] \"point to\" [0 0 0]\n"
    "LightSource \"infinite\" \"rgb L\" [.01 .01 .01]\n"
    "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] Shape \"sphere\"\n"
    QUAD("0 0 1  2 0 1  2 3 1  0 3 1")
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [0 0 1  2 0 1  0 0 3]\n"
    "Rotate 60 1 2 3 Shape \"disk\" Shape \"cylinder\" AttributeEnd\n"
    "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"bool twosided\" \"true\"\n"
    "Translate 4 0 0 Shape \"disk\" Shape \"cylinder\" AttributeEnd\n"
    "%s WorldEnd\n";

static bool lights(struct test *t, int skies, struct scene *out)
{
    char sky[1024] = "";
    for (int i = 0; i < skies; i++)
        snprintf(sky + strlen(sky), sizeof sky - strlen(sky), "LightSource \"infinite\" \"rgb L\" [%g %g %g]\n",
                 0.02 * i, 0.01, 0.01);
    return scene_from_format(t, out, LIGHTS, sky);
}

static bool sample_point(const struct scene *s, struct rng *r, struct light_point *at)
{
    const double u[3] = {rng_uniform(r), rng_uniform(r), rng_uniform(r)};
    return lamp_point(&s->lights, &s->geo, u, at);
}

/* --- numbers of rays --------------------------------------------------------------------------------- */

/* The numbers of a ray are those it was drawn with; at infinity any of its points will do. */
static void test_numbers(struct test *t, const struct scene *s)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 30, 0);
    int seen[16] = {0};
    double worst = 0;
    for (int i = 0; i < 20000; i++) {
        struct light_point at;
        struct ray ray;
        const double u[2] = {rng_uniform(&r), rng_uniform(&r)};
        double pdf, found[2];
        if (!sample_point(s, &r, &at))
            continue;
        light_sample_emission(&s->lights, &at, u, &ray, &pdf);
        vec3 p = add(ray.o, mul(ray.d, 10 * rng_uniform(&r)));
        light_emission_numbers(&s->lights, &at, p, ray.d, found);
        worst = fmax(worst, fmax(fabs(found[0] - u[0]), fabs(found[1] - u[1])));
        seen[s->lights.light[at.light].kind]++;
    }
    CHECK(t, worst < 1e-6, "the numbers of a ray are %g off", worst);
    for (int kind = LIGHT_AREA; kind <= LIGHT_INFINITE; kind++)
        CHECK(t, seen[kind] > 50, "kind %d was drawn %d times", kind, seen[kind]);
}

/* --- what is drawn ----------------------------------------------------------------------------------- */

/* Some bins and some lights are worth much more than others, some nothing. */
static struct emission random_table(const struct scene *s, struct rng *r, double delta)
{
    struct emission_sums l;
    enum { RAYS = 1000000, WORTH = 50000 };
    emission_sums_init(&l, &s->lights);
    for (int i = 0; i < WORTH; i++) {
        int cell = (int)rng_below(r, (uint32_t)s->lights.n_cells), bin = (int)rng_below(r, EMISSION_BINS);
        const double u[2] = {(bin / EMISSION_SIDE + rng_uniform(r)) / EMISSION_SIDE,
                             (bin % EMISSION_SIDE + rng_uniform(r)) / EMISSION_SIDE};
        emission_sums_add(&l, cell, u, bin % 7 * (1 + s->lights.light_of_cell[cell]));
    }
    struct emission out = emission_build(&l, RAYS, delta);
    return out;
}

/* Columns and bins come as often as q says, not as often as e does; rho is q over e. */
static void test_draws(struct test *t, const struct scene *s)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 31, 0);
    struct emission e = random_table(s, &r, 0.2);
    size_t n = (size_t)e.columns.n * EMISSION_BINS;
    double *count = mem_alloc(3 * n, sizeof *count), *wanted = count + n, *power = wanted + n, over = 0;
    long draws = 400000L * test_effort(t);
    for (long i = 0; i < draws; i++) {
        double u[2] = {rng_uniform(&r), rng_uniform(&r)}, rho;
        int column = emission_draw(&e, &s->lights, rng_uniform(&r), u, &rho) / e.columns.cells_each;
        size_t at = (size_t)(column * EMISSION_BINS + (int)(u[0] * EMISSION_SIDE) * EMISSION_SIDE +
                             (int)(u[1] * EMISSION_SIDE));
        count[at]++;
        over += 1 / rho / (double)draws;
        double expected = e.q[at] / e.columns.power[column] * EMISSION_BINS;
        CHECK(t, fabs(rho / expected - 1) < 1e-12, "rho is %g, not %g", rho, expected);
    }
    for (size_t i = 0; i < n; i++) {
        wanted[i] = (double)draws * e.q[i];
        power[i] = (double)draws * e.columns.power[i / EMISSION_BINS] / EMISSION_BINS;
    }
    TEST_ACCEPT(t, stats_chi2_test(count, wanted, n), "bins drawn by q, %d columns", e.columns.n);
    TEST_REJECT(t, stats_chi2_test(count, power, n), "bins drawn by power");
    CHECK(t, fabs(over - 1) < 0.02, "the mean of 1 / rho is %g", over);
    free(count);
    emission_free(&e);
}

/* What a light sub-path carries is divided by the density of its own light, not by that of all skies that it could come
 * from. */
static void test_carried(struct test *t, const struct scene *s)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 32, 0);
    struct tables known = {.emission = random_table(s, &r, 0.2)};
    struct mis_counts aimed = {.hit = {1, 1}, .tables = &known};
    struct arena arena = {NULL, NULL};
    int met = 0, apart = 0;
    for (uint64_t i = 0; i < 2000; i++) {
        struct sampler sampler = sampler_start(test_seed(t), RNG_TEST, i, 0), same = sampler;
        struct walk w = {s, &aimed, &arena, &sampler, 0};
        struct vertex path[2];
        struct light_point at;
        struct ray ray;
        double u[3], direction[2], pdf, of_all;
        arena_reset(&arena);
        if (path_light(&w, path, 2) < 2)
            continue;
        u[0] = sampler_number(&same, DRAW_LIGHT);
        sampler_pair(&same, DRAW_LIGHT_POINT, &u[1]);
        sampler_pair(&same, DRAW_EMISSION, direction);
        double emitted = emit_sample(&known.emission, &s->lights, &s->geo, u, direction, &at, &ray, &pdf, &of_all).g;
        CHECK(t, fabs(path[1].beta.g * at.pdf * pdf / emitted - 1) < 1e-9, "%g carried, %g emitted with density %g",
              path[1].beta.g, emitted, at.pdf * pdf);
        apart += fabs(of_all / pdf - 1) > 0.01;
        met++;
    }
    CHECK(t, met > 500 && apart > 100, "%d sub-paths, %d densities that differ", met, apart);
    arena_free(&arena);
    tables_free(&known);
}

/* --- the table --------------------------------------------------------------------------------------- */

static const char ONE[] = "WorldBegin LightSource \"point\" Shape \"sphere\" WorldEnd";

/* delta = 1: one light's rays are those of emission by power, to the last bit. What is drawn rises with the number it
 * is drawn by, so strata remain strata. */
static void test_limits(struct test *t)
{
    struct scene s;
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 33, 0);
    double rho, before[2] = {0, 0};
    if (!scene_from_text(t, ONE, &s))
        return;
    struct emission even = random_table(&s, &r, 1), e = random_table(&s, &r, 0.1);
    for (int i = 0; i < 1000; i++) {
        const double u[2] = {rng_uniform(&r), rng_uniform(&r)};
        double same[2] = {u[0], u[1]}, rising[2] = {i / 1000.0, i / 1000.0};
        emission_draw(&even, &s.lights, rng_uniform(&r), same, &rho);
        CHECK(t, same[0] == u[0] && same[1] == u[1] && rho == 1, "(%g,%g) becomes (%g,%g), rho %g", u[0], u[1], same[0],
              same[1], rho);
        emission_draw(&e, &s.lights, 0.5, rising, &rho);
        CHECK(t, rising[0] > before[0] || i == 0, "a number that is larger becomes %g after %g", rising[0], before[0]);
        before[0] = rising[0];
    }
    double last[2] = {1 - DBL_EPSILON / 2, 1 - DBL_EPSILON / 2};
    emission_draw(&e, &s.lights, last[0], last, &rho);
    CHECK(t, last[0] < 1 && last[1] < 1 && rho > 0, "the last number becomes (%g,%g)", last[0], last[1]);
    emission_free(&even);
    emission_free(&e);
    scene_free(&s);
}

/* With many rays t goes as the root of the mean square, with none of it known all is even. */
static void test_root(struct test *t)
{
    struct scene s;
    struct emission_sums l;
    enum { RAYS = 64000 };
    const double delta = 0.25;
    if (!scene_from_text(t, ONE, &s))
        return;
    emission_sums_init(&l, &s.lights);
    struct emission e = emission_build(&l, RAYS, delta);
    CHECK(t, e.q[0] == 1.0 / EMISSION_BINS && e.q[63] == 1.0 / EMISSION_BINS, "%g and %g of nothing", e.q[0], e.q[63]);
    emission_free(&e);
    emission_sums_init(&l, &s.lights);
    for (int i = 0; i < RAYS; i++) { /* on one half 3, on the other every fourth time 8, whose root of the mean is 4 */
        const double u[2] = {(i % 64 + 0.5) / 64, (i / 64 % 8 + 0.5) / 8};
        emission_sums_add(&l, 0, u, u[0] < 0.5 ? 3 : i % 4 == 0 ? 8 : 0);
    }
    e = emission_build(&l, RAYS, delta);
    double expected[2];
    for (int k = 0; k < 2; k++)
        expected[k] = (delta + (1 - delta) * (3 + k) / 3.5) / EMISSION_BINS;
    CHECK(t, fabs(e.q[0] / expected[0] - 1) < 2e-3 && fabs(e.q[63] / expected[1] - 1) < 2e-3,
          "%g and %g, not %g and %g", e.q[0], e.q[63], expected[0], expected[1]);
    emission_free(&e);
    scene_free(&s);
}

void test_emission(struct test *t)
{
    struct scene one, many; /* one sky, and so many that cells share columns */
    if (!lights(t, 0, &one) || !lights(t, 8, &many))
        return;
    CHECK(t, many.lights.n_cells > EMISSION_COLUMNS, "%d cells", many.lights.n_cells);
    test_numbers(t, &one);
    test_draws(t, &one);
    test_draws(t, &many);
    test_carried(t, &many);
    test_limits(t);
    test_root(t);
    scene_free(&one);
    scene_free(&many);
}
