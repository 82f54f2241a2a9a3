/* test_mis.c: the O(1) weights of mis.h and the values of connections against all densities multiplied out (oracle.h),
 * on random paths over every kind of vertex, light and integrator. The bound: 1e-9 relative to the weight, plus 1e-12.
 * A path's oracle weights sum to 1 by construction, so agreement for every strategy is the partition of unity. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "caustics/derived.h"
#include "lab/files.h"
#include "lab/numbers.h"
#include "tables/emission.h"
#include "helpers.h"
#include "oracle.h"
#include "suites.h"

#define PERSPECTIVE "\"perspective\" \"float fov\" 50 "

/* A room with every kind of vertex, and sheets that walks meet on both sides; %s takes the camera and the lights. */
static const char ROOM[] =
    "Integrator \"bdpt\" LookAt 0 1 -3.2  0 1 0  0 1 0\n"
    "Camera %s\n"
    "Film \"image\" \"integer xresolution\" 32 \"integer yresolution\" 32\n"
    "WorldBegin\n"
    "%s%s\n"
    "Material \"matte\" \"rgb Kd\" [.7 .6 .5] " QUAD("-2 0 -2  2 0 -2  2 0 2  -2 0 2")
    "Material \"substrate\" \"rgb Kd\" [.3 .5 .2] \"float uroughness\" .2 \"float vroughness\" .1\n"
    QUAD("-2 0 2  2 0 2  2 3 2  -2 3 2")
    "  \"normal N\" [.3 0 -1  -.3 0 -1  -.3 .2 -1  .3 .2 -1]\n"
    "Material \"mirror\" " QUAD("-2 0 -2  -2 0 2  -2 3 2  -2 3 -2")
    "Material \"metal\" \"float roughness\" .2 " QUAD("2 0 -2  2 0 2  2 3 2  2 3 -2")
    "Material \"matte\" " QUAD("1 .3 1  1.8 .3 -.6  1.8 1.8 -.6  1 1.8 1")
    "Material \"translucent\" \"rgb Ks\" [0 0 0] " QUAD("-1.5 1.2 1  -.5 1.2 1.5  -.5 2.4 1.5  -1.5 2.4 1")
    "Material \"glass\" \"float index\" 1.3 " QUAD("-2 .2 -2  0 .2 -2  0 .2 2  -2 .2 2")
    "Material \"glass\" \"float index\" 1.5\n"
    "TransformBegin Translate .3 .8 0 Shape \"sphere\" \"float radius\" .6 TransformEnd\n"
    "Material \"glass\" \"float index\" 1.4 \"float uroughness\" .3 \"float vroughness\" .3\n"
    "TransformBegin Translate -.8 .5 .5 Shape \"sphere\" \"float radius\" .4 TransformEnd\n"
    "WorldEnd\n";

/* A ball of fog, in it one of milk, among all that; and milk in a lampshade. */
static const char MEDIA[] =
    "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [.1 .2 0] \"rgb sigma_s\" [1 .7 0]\n"
    "MakeNamedMedium \"milk\" \"string type\" \"homogeneous\" \"rgb sigma_s\" [3 4 5] \"float g\" -.4\n"
    "AttributeBegin Material \"\" Translate 0 .9 -.6 MediumInterface \"fog\" \"\"\n"
    "Shape \"sphere\" \"float radius\" .8\n"
    "MediumInterface \"milk\" \"fog\" Translate -.2 .2 0 Shape \"sphere\" \"float radius\" .3 AttributeEnd\n"
    "AttributeBegin Material \"translucent\" MediumInterface \"milk\" \"\" Translate 1 1.9 -.5\n"
    "Shape \"sphere\" \"float radius\" .3 AttributeEnd\n";

/* With which of them lights fit in the room; 0: with and without. */
enum { WITHOUT_MEDIA = 1, WITH_MEDIA };
struct variant {
    const char *name, *camera, *lights;
    int where;
};

static const struct variant VARIANTS[] = {
    {"area", PERSPECTIVE,
     "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [5 5 5]\n"
     "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [-1 2.9 -1  1 2.9 -1  0 2.9 1] AttributeEnd", 0},
    {"two-sided sphere light, lens", PERSPECTIVE "\"float lensradius\" .1 \"float focaldistance\" 3",
     "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [5 5 5] \"bool twosided\" \"true\"\n"
     "Translate 0 2 0 Shape \"sphere\" \"float radius\" .3 AttributeEnd", 0},
    {"point and spot", PERSPECTIVE,
     "LightSource \"point\" \"rgb I\" [3 3 3] \"point from\" [0 2.5 0]\n"
     "LightSource \"spot\" \"rgb I\" [9 9 9] \"point from\" [1 2.5 0] \"point to\" [0 0 0]", 0},
    {"distant and infinite", PERSPECTIVE "\"float lensradius\" .05 \"float focaldistance\" 2",
     "LightSource \"distant\" \"rgb L\" [3 3 3] \"point from\" [1 4 -1] \"point to\" [0 0 0]\n"
     "LightSource \"infinite\" \"rgb L\" [1 1 1]", 0},
    {"see-through lamps", PERSPECTIVE,
     "AttributeBegin Material \"none\" AreaLightSource \"diffuse\" \"rgb L\" [2 2 2] \"bool twosided\" \"true\"\n"
     "TransformBegin Translate .3 .8 0 Shape \"sphere\" \"float radius\" .9 TransformEnd\n"
     "AreaLightSource \"diffuse\" \"rgb L\" [5 5 5] "
     QUAD("-1.9 2 -1.9  1.9 2 -1.9  1.9 2.2 1.9  -1.9 2.2 1.9") "AttributeEnd", WITHOUT_MEDIA},
    {"see-through lamps, one in fog and one around smoke", PERSPECTIVE,
     "AttributeBegin Material \"none\" AreaLightSource \"diffuse\" \"rgb L\" [2 2 2] \"bool twosided\" \"true\"\n"
     "MakeNamedMedium \"smoke\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [.3 .2 .1] \"rgb sigma_s\" [1 2 3]\n"
     QUAD("-1.9 2.3 -1.9  1.9 2.3 -1.9  1.9 2.5 1.9  -1.9 2.5 1.9")
     "MediumInterface \"fog\" TransformBegin Translate .4 .9 -.7 Shape \"sphere\" \"float radius\" .2 TransformEnd\n"
     "MediumInterface \"smoke\" \"\" Translate -1.2 1.5 -1.2 Shape \"sphere\" \"float radius\" .5 AttributeEnd", WITH_MEDIA},
    {"orthographic, area and distant", "\"orthographic\" \"float screenwindow\" [-1.5 1.5 -1 1.5]",
     "LightSource \"distant\" \"rgb L\" [3 3 3] \"point from\" [1 4 -1] \"point to\" [0 0 0]\n"
     "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [5 5 5]\n"
     "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [-1 2.9 -1  1 2.9 -1  0 2.9 1] AttributeEnd", 0},
    {"environment, infinite and spot", "\"environment\"",
     "LightSource \"infinite\" \"rgb L\" [1 1 1]\n"
     "LightSource \"spot\" \"rgb I\" [9 9 9] \"point from\" [1 2.5 0] \"point to\" [0 0 0]", 0},
    {"two infinite lights", PERSPECTIVE,
     "LightSource \"infinite\" \"rgb L\" [3 3 3] LightSource \"infinite\" \"rgb L\" [1 1 1]", 0},
    {"a turned map and a constant sky", PERSPECTIVE,
     "TransformBegin Rotate 40 1 2 3 LightSource \"infinite\" \"string mapname\" \"sky.pfm\" TransformEnd\n"
     "LightSource \"infinite\" \"rgb L\" [1 1 1]", 0},
    {"1024 lamps, several to a cell", PERSPECTIVE,
     "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [5 5 5] \"bool twosided\" \"true\"\n"
     "Shape \"loopsubdiv\" \"integer nlevels\" 4"
     "\"integer indices\" [0 2 1 0 1 3 0 3 2 1 2 3] \"point P\" [0 2.9 0 -1 1.6 -.8  1 1.5 -.8  0 1.6 1]\n"
     "AttributeEnd", 0},
};

/* A map of a bright spot. */
static bool write_map(struct test *t)
{
    enum { W = 32, H = 16 };
    static float pixels[W * H * 3];
    struct error err = {.text = ""};
    char path[256];
    for (int i = 0; i < W * H * 3; i++)
        pixels[i] = i / 3 == 5 * W + 7 ? 300 : 0.5f;
    snprintf(path, sizeof path, "%s/sky.pfm", test_tmp(t));
    return CHECK(t, image_write(path, W, H, pixels, &err), "%s", err.text);
}

/* Regions met at random, some of whose lights and pairs are worth more than others, and rays from lights that go some
 * ways rather than others: learnt from nothing. */
static struct tables learn_nothing(const struct scene *scene)
{
    enum { POINTS = 2000, RAYS = 5000 };
    struct tables l = NO_TABLES;
    struct rng r = rng_stream(7, RNG_TEST, 0, 0);
    const struct light_set *lights = &scene->lights;
    double *base;
    struct axis emission = emission_axis_new(lights, &base);
    struct axis cells = {lights->n_cells, NULL, NULL}, one = {1, NULL, NULL};
    double *e = mem_alloc((size_t)lights->n_cells, sizeof *e), even[1000];
    int at[POINTS];
    regions_init(&l.regions, vec(-2, 0, -2), vec(2, 3, 2), 9, 1000);
    for (int i = 0; i < POINTS; i++) {
        vec3 p = vec(4 * rng_uniform(&r) - 2, 3 * rng_uniform(&r), 4 * rng_uniform(&r) - 2);
        at[i] = regions_add(&l.regions, regions_key(&l.regions, p, on_sphere(&r)));
    }
    struct axis places = regions_axis(&l.regions);
    l.guide = table_learn(places.n, cells.n);
    l.pairs = table_learn(places.n, places.n);
    l.emission = table_learn(1, emission.n);
    for (int i = 0; i < POINTS; i++) {
        int cell = (int)rng_below(&r, (uint32_t)cells.n);
        table_add(&l.guide, places, cells, at[i], cell, 1 + cell % 3 + i % 5, 1);
        table_add(&l.pairs, places, places, at[i], at[rng_below(&r, POINTS)], exp(8 * rng_uniform(&r)), 1);
    }
    for (int i = 0; i < RAYS; i++) {
        const double u[2] = {rng_uniform(&r), rng_uniform(&r)};
        int column = emission_column((int)rng_below(&r, (uint32_t)cells.n), u);
        table_add(&l.emission, one, emission, 0, column, exp(8 * (u[0] - u[1])) + i % 3, 1);
    }
    for (int i = 0; i < cells.n; i++)
        e[i] = alias_pmf(&lights->choice, i);
    for (int i = 0; i < places.n; i++)
        even[i] = 1.0 / places.n;
    table_build(&l.guide, places, cells, e, 0.1, false, true);
    table_build(&l.pairs, places, places, even, 0.1, false, false);
    table_build(&l.emission, one, emission, base, 0.1, true, true);
    emission_axis_free(&emission, base);
    free(e);
    return l;
}

struct comparison {
    struct test *t;
    const char *name;
    const struct scene *scene;
    const struct counts *counts;
    double worst, worst_value; /* largest relative differences */
    long compared, lamps; /* weights, and of those how many of s = 0 on see-through lamps */
    long values[4];       /* of s = 0, s = 1, t = 1, pairs */
    double skew; /* the planted fault: production weights and values are multiplied by it */
};

static void compare_value(struct comparison *c, rgb got, const struct vertex *light, int s, const struct vertex *eye,
                          int t)
{
    rgb value;
    if (!oracle_value(c->scene, c->counts, light, s, eye, t, &value))
        return;
    double most = fmax(fmax(value.r, value.g), value.b);
    double difference = fmax(fmax(fabs(got.r * c->skew - value.r), fabs(got.g * c->skew - value.g)),
                             fabs(got.b * c->skew - value.b)) / most;
    if (!(difference <= c->worst_value))
        c->worst_value = difference;
    c->values[t == 1 ? 2 : s < 2 ? s : 3]++;
}

/* The length of a path (caustics/derived.h) is that by the middle of the lens. */
static void compare_length(struct comparison *c, const struct vertex *light, int s, const struct vertex *eye, int t)
{
    const struct camera *camera = &c->scene->camera;
    const struct joined j = {.s = s, .t = t, .path = light, .z = t > 1 ? &eye[t - 1] : NULL};
    const struct vertex *next = t > 1 ? &eye[1] : &light[s - 1];
    struct vertex path[16];
    memcpy(path, eye, (size_t)t * sizeof *path);
    path[0].p = next->kind == VERTEX_ESCAPED ? camera->position : camera_sample_lens(camera, next->p, 0.5, 0.5);
    double got = path_length(c->scene, &j), expected = oracle_length(c->scene, light, s, path, t);
    CHECK(c->t, fabs(got - expected) < 1e-9 * expected, "%s: a path by (%d,%d) is %.12g long, not %.12g", c->name, s, t,
          got, expected);
}

static void compare(struct comparison *c, struct connection got, const struct vertex *light, int s,
                    const struct vertex *eye, int t)
{
    double weight[65];
    if (rgb_is_black(got.value) || !oracle_weights(c->scene, c->counts, light, s, eye, t, weight))
        return;
    double difference = fabs(got.weight * c->skew - weight[s]) / (weight[s] + 1e-3);
    if (!(difference <= c->worst))
        c->worst = difference;
    compare_value(c, got.value, light, s, eye, t);
    compare_length(c, light, s, eye, t);
    c->compared++;
}

/* s = 0: of a path that ends on a see-through lamp met on the way to z_{t-1}, the lamp is the last vertex. */
static void compare_hit(struct comparison *c, const struct vertex *eye, int t)
{
    const struct vertex *lamp = eye[t - 1].lamp;
    struct vertex path[16];
    long before = c->compared;
    memcpy(path, eye, (size_t)t * sizeof *path);
    if (lamp != NULL)
        path[t - 1] = *lamp;
    compare(c, connect_s0(c->scene, c->counts, &eye[t - 2], &eye[t - 1]), NULL, 0, path, t);
    c->lamps += lamp != NULL ? c->compared - before : 0;
}

/* An escaping ray meets the whole sky, so a direction of it has one density and one cell, whichever layer is drawn. */
static void compare_direct(struct comparison *c, const struct vertex *eye, int t, struct sampler *sampler)
{
    const struct light_set *lights = &c->scene->lights;
    struct vertex y;
    int cell;
    struct connection got = connect_s1(c->scene, c->counts, &eye[t - 1], sampler, 0, 1, &y);
    if (y.light < 0)
        return;
    if (lights->light[y.light].kind == LIGHT_INFINITE)
        CHECK(c->t, fabs(light_pdf_sky(lights, y.wo, &cell) / y.pdf_fwd - 1) < 1e-9 && cell == y.place,
              "%s: a direction of cell %d, drawn with %g, is of cell %d", c->name, y.place, y.pdf_fwd, cell);
    compare(c, got, &y, 1, eye, t);
}

static void compare_lens(struct comparison *c, const struct vertex *light, int s, struct sampler *sampler)
{
    struct vertex z;
    double raster[2];
    if (lens_point(c->scene, &light[s - 1], sampler, &z, raster))
        compare(c, connect_vertices(c->scene, c->counts, &light[s - 1], &z), light, s, &z, 1);
}

static void compare_paths(struct comparison *c, int n_paths)
{
    enum { MAX = 8 };
    struct vertex eye[MAX], light[MAX];
    struct arena arena = {NULL, NULL};
    for (int i = 0; i < n_paths; i++) {
        arena_reset(&arena);
        struct sampler a = sampler_start(test_seed(c->t), RNG_EYE, 1, (uint64_t)i);
        struct sampler b = sampler_start(test_seed(c->t), RNG_LIGHT, 1, (uint64_t)i);
        struct sampler d = sampler_start(test_seed(c->t), RNG_CONNECT, 1, (uint64_t)i);
        struct walk we = {c->scene, c->counts, &arena, &a, 0}, wl = {c->scene, c->counts, &arena, &b, 0};
        double raster[2];
        sampler_pair(&d, DRAW_FILM_POINT, raster);
        int n_eye = path_eye(&we, 32 * raster[0], 32 * raster[1], eye, MAX);
        int n_light = path_light(&wl, light, MAX, NULL);
        for (int t = 2; t <= n_eye; t++) {
            if (t > 2)
                compare_hit(c, eye, t);
            if (eye[t - 1].kind != VERTEX_ESCAPED)
                compare_direct(c, eye, t, &d);
            for (int s = 2; s <= n_light; s++)
                compare(c, connect_vertices(c->scene, c->counts, &light[s - 1], &eye[t - 1]), light, s, eye, t);
        }
        for (int s = 2; s <= n_light; s++)
            compare_lens(c, light, s, &d);
    }
    arena_free(&arena);
}

void test_mis(struct test *t)
{
    const double bound = 1e-9;
    /* hit, direct, pair, lens */
    const struct tables *none = &NO_TABLES;
    const struct counts all = {{1, 1}, {1, 1}, {1, 1}, 1024, none, {0, 0}, {1, 1}};
    const struct counts pt = {{1, 1}, {1, 1}, {0, 0}, 0, none, {0, 0}, {1, 1}}, lt = {.lens = 1024, .tables = none};
    const struct counts uneven = {{3, 1}, {6, 1.5}, {8, 0.7}, 300, none, {0, 0}, {1, 1}};
    const struct counts first = {{2, 0}, {3, 0}, {4, 0}, 300, none, {0, 0}, {1, 1}};
    const struct counts later = {{0, 2}, {0, 3}, {0, 4}, 300, none, {0, 0}, {1, 1}};
    const struct counts mixed = {{2, 0}, {0, 3}, {4, 0}, 300, none, {0, 0}, {1, 1}};
    const struct counts bounded = {{1, 1}, {2, 1.5}, {8, 0.7}, 300, none, {2, 0.3}, {1, 1}};
    const struct {
        const char *name;
        const struct counts *counts;
    } sets[] = {{"bdpt", &all}, {"pt", &pt}, {"lt", &lt}, {"uneven counts", &uneven}, {"first hits alone", &first},
                {"later hits alone", &later}, {"first or later hits", &mixed}, {"a bound of draws", &bounded}};
    long values[4] = {0};

    if (!write_map(t))
        return;
    for (size_t i = 0; i < 2 * sizeof VARIANTS / sizeof VARIANTS[0]; i++) {
        char text[8192];
        size_t v = i / 2;
        bool media = i % 2 == 1;
        if (VARIANTS[v].where == (media ? WITHOUT_MEDIA : WITH_MEDIA))
            continue;
        snprintf(text, sizeof text, ROOM, VARIANTS[v].camera, media ? MEDIA : "", VARIANTS[v].lights);
        struct scene scene;
        if (!scene_from_text(t, text, &scene))
            return;
        struct tables all_known = learn_nothing(&scene);
        for (size_t k = 0; k < 8 * (sizeof sets / sizeof sets[0]); k += media ? 7 : 1) {
            struct counts counts = *sets[k / 8].counts;
            bool direct = k % 2 == 1, pairs = k / 2 % 2 == 1, emission = k / 4 % 2 == 1;
            struct tables known = all_known;
            known.guide = direct ? all_known.guide : NO_TABLES.guide;
            known.pairs = pairs ? all_known.pairs : NO_TABLES.pairs;
            known.emission = emission ? all_known.emission : NO_TABLES.emission;
            counts.tables = &known;
            struct comparison c = {.t = t, .name = VARIANTS[v].name, .scene = &scene, .counts = &counts, .skew = 1};
            compare_paths(&c, 500);
            CHECK(t, c.worst < bound && c.compared > 100,
                  "%s, %s%s%s%s: %ld weights, largest difference %.3g (bound %g)", VARIANTS[v].name, sets[k / 8].name,
                  direct ? ", direct" : "", pairs ? ", pairs" : "", emission ? ", emission" : "",
                  c.compared, c.worst, bound);
            CHECK(t, c.worst_value < bound, "%s, %s: values differ by %.3g", VARIANTS[v].name, sets[k / 8].name,
                  c.worst_value);
            for (int kind = 0; kind < 4; kind++)
                values[kind] += c.values[kind];
            CHECK(t, c.lamps > 100 || scene.kd_lamps.n_nodes == 0 || counts.s0[LATER_HIT] == 0,
                  "%s: only %ld of see-through lamps", VARIANTS[v].name, c.lamps);
        }
        struct comparison planted = {.t = t, .name = VARIANTS[v].name, .scene = &scene, .counts = &all,
                                     .skew = 1 + 1e-8};
        compare_paths(&planted, 50);
        CHECK(t, planted.worst > bound, "a weight wrong by 1e-8 was not noticed");
        CHECK(t, planted.worst_value > bound, "a value wrong by 1e-8 was not noticed");
        tables_free(&all_known);
        scene_free(&scene);
    }
    for (int i = 0; i < 4; i++)
        CHECK(t, values[i] > 1000, "only %ld values of kind %d", values[i], i);
}
