/* test_emission.c: how light sub-paths leave the lights (emission.h): draws have the density that is stated. The
 * numbers of a ray are found again for every kind of light, and what is learnt is what the rays show. The table itself
 * is tested in test_table.c. That the image is the same for every table is in test_asbdpt.c. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/rng.h"
#include "caustics/lamp.h"
#include "lab/numbers.h"
#include "lab/stats.h"
#include "tables/emission.h"
#include "transport/path.h"
#include "helpers.h"
#include "suites.h"

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

enum { SIDE = 8, WORTH = 50000 };

/* Some bins and some lights are worth much more than others, some nothing. */
static struct table random_table(const struct scene *s, struct rng *r, double delta)
{
    double *base;
    struct axis axis = emission_axis_new(&s->lights, &base);
    const struct axis one = {1, NULL, NULL};
    struct table out = table_learn(1, axis.n);
    for (int i = 0; i < WORTH; i++) {
        int cell = (int)rng_below(r, (uint32_t)s->lights.n_cells), bin = (int)rng_below(r, SIDE * SIDE);
        const double u[2] = {(bin / SIDE + rng_uniform(r)) / SIDE, (bin % SIDE + rng_uniform(r)) / SIDE};
        double worth = bin % 7 * (1 + cell % 5);
        table_add(&out, one, axis, 0, emission_column(cell, u), worth * worth, 1);
    }
    table_build(&out, one, axis, base, delta, true, true);
    emission_axis_free(&axis, base);
    return out;
}

static bool draw_ray(const struct scene *s, struct rng *r, const struct table *table, struct light_point *at,
                     struct ray *ray, double *pdf)
{
    const double u[3] = {rng_uniform(r), rng_uniform(r), rng_uniform(r)};
    const double direction[2] = {rng_uniform(r), rng_uniform(r)};
    int column;
    emission_sample(table, &s->lights, &s->geo, u, direction, at, ray, pdf, &column);
    return *pdf > 0;
}

/* Columns come as often as e times the ratio says, not as often as e does. The density is that of any point of the
 * ray. */
static void check_emitted(struct test *t, const struct scene *s)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 31, 0);
    double *base;
    struct axis axis = emission_axis_new(&s->lights, &base);
    struct table table = random_table(s, &r, 0.2);
    size_t n = (size_t)axis.n;
    double *count = mem_alloc(3 * n, sizeof *count), *wanted = count + n, *power = wanted + n, over = 0, least = 1;
    long draws = 400000L * test_effort(t), off = 0;
    for (long i = 0; i < draws; i++) {
        struct light_point at;
        struct ray ray;
        double pdf;
        if (!CHECK(t, draw_ray(s, &r, &table, &at, &ray, &pdf), "nothing is drawn"))
            break;
        vec3 p = add(ray.o, mul(ray.d, 10 * rng_uniform(&r)));
        count[emission_column_of(&s->lights, &at, p, ray.d)]++;
        over += light_pdf_emission(&s->lights, &at, ray.d) / pdf / (double)draws;
        off += fabs(emission_pdf(&table, &s->lights, &at, p, ray.d) / pdf - 1) > 1e-6;
    }
    for (size_t i = 0; i < n; i++) {
        power[i] = (double)draws * base[i];
        wanted[i] = power[i] * table_ratio(&table, 0, (int)i);
        least = fmin(least, table_ratio(&table, 0, (int)i));
    }
    TEST_ACCEPT(t, stats_chi2_test(count, wanted, n), "bins drawn by the table, %d cells", s->lights.n_cells);
    TEST_REJECT(t, stats_chi2_test(count, power, n), "bins drawn by power");
    CHECK(t, least >= 0.2, "a ratio is %g", least);
    CHECK(t, off <= draws / 10000, "%ld of %ld rays have another density: some may lie on the border of a bin", off,
          draws);
    CHECK(t, fabs(over - 1) < 0.02, "the mean of power's density over the table's is %g", over);
    free(count);
    table_free(&table);
    emission_axis_free(&axis, base);
}

/* What a light sub-path carries is what is emitted over the density of its ray. */
static void test_carried(struct test *t, const struct scene *s)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 32, 0);
    struct tables known = {.emission = random_table(s, &r, 0.2)};
    struct counts aimed = {.s0 = {1, 1}, .tables = &known};
    struct arena arena = {NULL, NULL};
    int met = 0, apart = 0;
    for (uint64_t i = 0; i < 2000; i++) {
        struct sampler sampler = sampler_start(test_seed(t), RNG_TEST, i, 0), same = sampler;
        struct walk w = {s, &aimed, &arena, &sampler, 0};
        struct vertex path[2];
        struct light_point at;
        struct ray ray;
        double u[3], direction[2], pdf;
        int column;
        arena_reset(&arena);
        if (path_light(&w, path, 2, NULL) < 2)
            continue;
        u[0] = sampler_number(&same, DRAW_LIGHT);
        sampler_pair(&same, DRAW_LIGHT_POINT, &u[1]);
        sampler_pair(&same, DRAW_EMISSION, direction);
        double emitted =
            emission_sample(&known.emission, &s->lights, &s->geo, u, direction, &at, &ray, &pdf, &column).g;
        CHECK(t, fabs(path[1].beta.g * at.pdf * pdf / emitted - 1) < 1e-9, "%g carried, %g emitted with density %g",
              path[1].beta.g, emitted, at.pdf * pdf);
        apart += fabs(light_pdf_emission(&s->lights, &at, ray.d) / pdf - 1) > 0.01;
        met++;
    }
    CHECK(t, met > 500 && apart > 100, "%d sub-paths, %d densities that differ", met, apart);
    arena_free(&arena);
    tables_free(&known);
}

/* --- the table --------------------------------------------------------------------------------------- */

static const char ONE[] = "WorldBegin LightSource \"point\" Shape \"sphere\" WorldEnd";

/* The numbers of the ray that a table makes of `direction`; *ratio: of its density and that of power. */
static void numbers_of(const struct scene *s, const struct table *table, double number, const double direction[2],
                       double out[2], double *ratio)
{
    const double u[3] = {number, 0.5, 0.5};
    struct light_point at;
    struct ray ray;
    double pdf;
    int column;
    emission_sample(table, &s->lights, &s->geo, u, direction, &at, &ray, &pdf, &column);
    light_emission_numbers(&s->lights, &at, ray.o, ray.d, out);
    *ratio = pdf / light_pdf_emission(&s->lights, &at, ray.d);
}

/* delta = 1: one light's rays are those of emission by power. What is drawn rises with the number it is drawn by, so
 * strata remain strata. */
static void test_limits(struct test *t)
{
    struct scene s;
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 33, 0);
    const double last = 1 - DBL_EPSILON / 2, end[2] = {last, last};
    double ratio, found[2], before = -1;
    if (!scene_from_text(t, ONE, &s))
        return;
    struct table even = random_table(&s, &r, 1), e = random_table(&s, &r, 0.1);
    for (int i = 0; i < 1000; i++) {
        const double u[2] = {rng_uniform(&r), rng_uniform(&r)}, rising[2] = {(i + 0.5) / 1000, 0.5};
        numbers_of(&s, &even, rng_uniform(&r), u, found, &ratio);
        CHECK(t, fabs(found[0] - u[0]) < 1e-6 && fabs(found[1] - u[1]) < 1e-6 && ratio == 1,
              "(%g,%g) becomes (%g,%g), ratio %g", u[0], u[1], found[0], found[1], ratio);
        numbers_of(&s, &e, 0.5, rising, found, &ratio);
        CHECK(t, found[0] > before, "a number that is larger becomes %g after %g", found[0], before);
        before = found[0];
    }
    numbers_of(&s, &e, last, end, found, &ratio);
    CHECK(t, found[0] <= 1 && found[1] <= 1 && ratio > 0, "the last number becomes (%g,%g)", found[0], found[1]);
    table_free(&even);
    table_free(&e);
    scene_free(&s);
}

/* With many rays the ratio goes as the root of the mean square. */
static void test_root(struct test *t)
{
    struct scene s;
    enum { RAYS = 64000 };
    const double delta = 0.25;
    const struct axis one = {1, NULL, NULL};
    if (!scene_from_text(t, ONE, &s))
        return;
    double *base;
    struct axis axis = emission_axis_new(&s.lights, &base);
    struct table e = table_learn(1, axis.n);
    for (int i = 0; i < RAYS; i++) { /* on one half 3, on the other every fourth time 8, whose root of the mean is 4 */
        const double u[2] = {(i % 64 + 0.5) / 64, (i / 64 % 8 + 0.5) / 8};
        table_add(&e, one, axis, 0, emission_column(0, u), u[0] < 0.5 ? 9 : i % 4 == 0 ? 64 : 0, 1);
    }
    table_build(&e, one, axis, base, delta, true, true);
    for (int k = 0; k < 2; k++) {
        const double u[2] = {k, k};
        double ratio = table_ratio(&e, 0, emission_column(0, u)), expected = delta + (1 - delta) * (3 + k) / 3.5;
        CHECK(t, fabs(ratio / expected - 1) < 2e-3, "ratio %g, not %g", ratio, expected);
    }
    table_free(&e);
    emission_axis_free(&axis, base);
    scene_free(&s);
}

void test_emission(struct test *t)
{
    struct scene one, many; /* one sky, and several whose sum is drawn by cells */
    if (!lights(t, 0, &one) || !lights(t, 8, &many))
        return;
    CHECK(t, many.lights.n_layers == 9, "%d skies", many.lights.n_layers);
    test_numbers(t, &one);
    check_emitted(t, &one);
    check_emitted(t, &many);
    test_carried(t, &many);
    test_limits(t);
    test_root(t);
    scene_free(&one);
    scene_free(&many);
}
