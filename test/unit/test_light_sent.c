/* test_light_sent.c: what lights send: under transforms, by the cone of a spot, and every density of a draw as a fact,
 * by the area that a small square of random numbers becomes. */
#include <float.h>
#include <math.h>
#include <stdio.h>

#include "base/alias.h"
#include "base/rng.h"
#include "base/warp.h"
#include "caustics/lamp.h"
#include "lab/files.h"
#include "lab/numbers.h"
#include "helpers.h"
#include "suites.h"

/* One light around the origin, first in a space of its own, then with that space transformed. */
static bool light_under(struct test *t, const char *light, const char *path, const struct transform *m,
                        struct scene *out)
{
    char text[2048];
    int n = snprintf(text, sizeof text, "WorldBegin ConcatTransform [");
    for (int i = 0; i < 16; i++)
        n += snprintf(text + n, sizeof text - (size_t)n, " %.17g", i >= 12 ? i == 15 : m->m[i % 4][i / 4]);
    n += snprintf(text + n, sizeof text - (size_t)n, "]\n");
    n += snprintf(text + n, sizeof text - (size_t)n, light, path);
    snprintf(text + n, sizeof text - (size_t)n, "\nWorldEnd");
    return scene_from_text(t, text, out);
}

/* What the light sends in direction w, or what comes from there. */
static double light_along(const struct scene *s, const struct light_point *at, vec3 w)
{
    rgb Le = s->lights.n_layers > 0 ? light_Le_sky(&s->lights, w, true) : light_Le(&s->lights, at, w);
    return rgb_luminance(Le);
}

/* The density of light that comes from all directions of a map integrates to 1, and is what lamp_point draws by. Close
 * to a pole of the map the last bit of a direction decides on its sine, by which densities are divided. */
static void check_sky(struct test *t, const struct scene *s, struct rng *r)
{
    enum { N = 600, DRAWS = 20000 };
    double integral = 0;
    int cell;
    for (int i = 0; i < N; i++)
        for (int k = 0; k < 2 * N; k++) {
            vec3 w = warp_sphere((i + 0.5) / N, (k + 0.5) / (2 * N));
            integral += light_pdf_sky(&s->lights, w, &cell) * 4 * PI / (2.0 * N * N);
        }
    CHECK(t, fabs(integral - 1) < 0.01, "the density of a transformed map integrates to %g", integral);
    for (int i = 0; i < DRAWS; i++) {
        struct light_point at;
        double u[3] = {rng_uniform(r), rng_uniform(r), rng_uniform(r)};
        if (!lamp_point(&s->lights, &s->geo, u, &at))
            continue;
        double pdf = light_pdf_sky(&s->lights, at.w, &cell);
        vec3 v = normalize(transform_vector_back(&s->lights.layer[0].frame->to_world, at.w));
        double bound = 1e-6 + 4 * DBL_EPSILON / (1 - v.z * v.z);
        CHECK(t, fabs(pdf / at.pdf - 1) < bound && cell == at.cell, "a direction of density %g was drawn with %g", pdf,
              at.pdf);
    }
}

/* Lights of which light space matters, under random transforms: a direction of it gets what it got without them. */
static void test_transformed(struct test *t)
{
    enum { W = 16, H = 8, N = 4 };
    static const char *const lights[N] = {
        "LightSource \"spot\" \"float coneangle\" 40 \"float conedeltaangle\" 25 \"point to\" [1 2 -1] # %s\n",
        "LightSource \"infinite\" \"string mapname\" \"%s\"",
        "LightSource \"goniometric\" \"string mapname\" \"%s\"",
        "LightSource \"projection\" \"float fov\" 80 \"string mapname\" \"%s\""};
    static float pixels[W * H * 3];
    char path[256];
    struct error err = {.text = ""};
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 8, 0);
    struct transform id = transform_identity();
    for (int i = 0; i < W * H * 3; i++)
        pixels[i] = (float)(1 + (i / 3) % 5);
    snprintf(path, sizeof path, "%s/map.pfm", test_tmp(t));
    if (!CHECK(t, image_write(path, W, H, pixels, &err), "%s", err.text))
        return;
    for (int i = 0; i < 3 * N; i++) {
        struct scene plain, moved;
        struct transform m = random_affine(&r);
        struct light_point at;
        const double u[3] = {0.5, 0.5, 0.5};
        if (!light_under(t, lights[i % N], path, &id, &plain) || !light_under(t, lights[i % N], path, &m, &moved))
            return;
        CHECK(t, lamp_point(&moved.lights, &moved.geo, u, &at), "light %d: no point", i);
        double worst = 0;
        for (int k = 0; k < 1000; k++) {
            vec3 v = warp_sphere(rng_uniform(&r), rng_uniform(&r)), w = normalize(transform_vector(&m, v));
            worst = fmax(worst, fabs(light_along(&plain, &at, v) - light_along(&moved, &at, w)));
        }
        CHECK(t, worst < 1e-9, "light %d: its space is off by %g", i, worst);
        if (moved.lights.n_layers > 0)
            check_sky(t, &moved, &r);
        scene_free(&plain);
        scene_free(&moved);
    }
}

/* A map with numbers that are none, and directions that are none: every answer is a number, every cell exists. */
static void test_damaged_map(struct test *t)
{
    enum { W = 40, H = 20 };
    static float pixels[W * H * 3];
    static const float bad[4] = {NAN, INFINITY, -INFINITY, -3};
    const double none[] = {NAN, INFINITY, -INFINITY, 0, 1e308};
    char path[256];
    struct error err = {.text = ""};
    struct scene scene;
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 5, 0);
    for (int i = 0; i < W * H * 3; i++)
        pixels[i] = i % 5 == 0 ? bad[i / 5 % 4] : 1;
    snprintf(path, sizeof path, "%s/map.pfm", test_tmp(t));
    if (!CHECK(t, image_write(path, W, H, pixels, &err), "%s", err.text) ||
        !scene_from_format(t, &scene, "WorldBegin LightSource \"infinite\" \"string mapname\" \"%s\" WorldEnd\n", path))
        return;
    CHECK(t, scene.lights.choice.n == scene.lights.n_cells, "there is no table of choices");
    check_sky(t, &scene, &r);
    for (int i = 0; i < 500; i++) {
        rgb L = light_Le_sky(&scene.lights, on_sphere(&r), true);
        CHECK(t, L.r >= 0 && L.g >= 0 && L.b >= 0 && rgb_is_finite(L), "light of (%g %g %g)", L.r, L.g, L.b);
    }
    for (int i = 0; i < 5; i++) { /* a direction that is none stays in the tables */
        vec3 w = vec(none[i], none[(i + 1) % 5], none[i]);
        rgb L = light_Le_sky(&scene.lights, w, true);
        int cell;
        CHECK(t, rgb_is_finite(L) && !(light_pdf_sky(&scene.lights, w, &cell) < 0), "direction %d", i);
    }
    scene_free(&scene);
}

/* A spot is full inside the inner cone, nothing outside the outer one, and the fourth power of a ramp of the cosine
 * between, as in pbrt-v3; so too if the inner angle is negative. */
static void test_spot(struct test *t)
{
    static const double cases[][2] = {{40, 20}, {3, 5}, {1, 5}}; /* degrees: cone and edge */
    for (int i = 0; i < 3; i++) {
        struct scene s;
        double cone = cases[i][0], inner = cos((cone - cases[i][1]) * PI / 180), outer = cos(cone * PI / 180);
        if (!scene_from_format(t, &s, "WorldBegin LightSource \"spot\" \"float coneangle\" %g "
                               "\"float conedeltaangle\" %g WorldEnd", cone, cases[i][1]))
            return;
        for (int k = 0; k < 40; k++) {
            struct light_point at = {0};
            double angle = cone * PI / 180 * (k + 0.5) / 30, c = cos(angle);
            double ramp = c < outer ? 0 : c >= inner ? 1 : (c - outer) / (inner - outer);
            double got = light_along(&s, &at, vec(sin(angle), 0, c));
            CHECK(t, fabs(got - pow(ramp, 4)) < 1e-6, "spot %d: step %d has %g, not %g", i, k, got, pow(ramp, 4));
        }
        scene_free(&s);
    }
}

/* What lights with a picture send, by pbrt-v3's formulas [pbrt-v3 lights/goniometric.h, lights/projection.cpp], and that
 * their powers are what they send in all. Texels are so many that rows and columns are told apart. */
static double by_formula(const float *pixel, int w, int h, bool goniometric, double fov, vec3 d)
{
    double s, v;
    if (goniometric) { /* y is up */
        double phi = atan2(d.z, d.x);
        s = (phi < 0 ? phi + 2 * PI : phi) / (2 * PI);
        v = acos(d.y) / PI;
    } else {
        double aspect = (double)w / h, half = tan(fov * PI / 360), wide = aspect > 1 ? aspect : 1;
        s = 0.5 + 0.5 * d.x / (d.z * half * wide);
        v = 0.5 + 0.5 * d.y / (d.z * half * wide / aspect);
        if (!(d.z > 0 && s > 0 && s < 1 && v > 0 && v < 1))
            return 0;
    }
    double x = s * w - 0.5, y = v * h - 0.5, sum = 0;
    for (int k = 0; k < 4; k++) {
        double column = floor(x) + k % 2, row = floor(y) + k / 2;
        int i = ((int)column + w) % w, j = ((int)row + h) % h;
        sum += (1 - fabs(x - column)) * (1 - fabs(y - row)) * (double)pixel[3 * (j * w + i)];
    }
    return sum;
}

static void test_pictures_sent(struct test *t)
{
    enum { N = 400 };
    static const int SIZE[3][2] = {{24, 12}, {8, 20}, {9, 9}};
    static float pixels[24 * 20 * 3];
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 12, 0);
    for (int i = 0; i < 12; i++) {
        char path[256];
        struct error err = {.text = ""};
        struct scene s;
        bool goniometric = i % 2 == 0;
        int w = SIZE[i / 2 % 3][0], h = SIZE[i / 2 % 3][1];
        double fov = i == 11 ? 150 : 20 + 10 * i, worst = 0, all = 0;
        for (int k = 0; k < 3 * w * h; k++)
            pixels[k] = k % 3 == 0 ? (float)(1 + rng_uniform(&r)) : pixels[k - k % 3];
        snprintf(path, sizeof path, "%s/sent.pfm", test_tmp(t));
        CHECK(t, image_write(path, w, h, pixels, &err), "%s", err.text);
        if (!(goniometric ? scene_from_format(t, &s, "WorldBegin LightSource \"goniometric\" \"rgb I\" [2 2 2] "
                                              "\"string mapname\" \"sent.pfm\" WorldEnd")
                          : scene_from_format(t, &s, "WorldBegin LightSource \"projection\" \"rgb I\" [2 2 2] "
                                              "\"string mapname\" \"sent.pfm\" \"float fov\" %g WorldEnd", fov)))
            return;
        struct light_point at = {.light = 0};
        double cosine = s.lights.light[0].frame->cos_total;
        for (int k = 0; k < N * N; k++) {
            vec3 d = warp_sphere((k / N + rng_uniform(&r)) / N, (k % N + rng_uniform(&r)) / N);
            double got = light_Le(&s.lights, &at, d).g;
            worst = fmax(worst, fabs(got - 2 * by_formula(pixels, w, h, goniometric, fov, d)));
            all += got * 4 * PI / (N * N);
            CHECK(t, got == 0 || goniometric || d.z >= cosine * (1 - 1e-12), "light beyond the cone that is drawn");
        }
        CHECK(t, worst < 1e-9, "light %d of a picture of %dx%d is off by %g", i, w, h, worst);
        double power = s.lights.light[0].power / all; /* of a screen that of the cone around it */
        CHECK(t, fabs(power - 1) < (goniometric ? 0.02 : 1.2) && power > 0.98, "its power is %g of what it sends", power);
        scene_free(&s);
    }
}

/* --- densities, as facts ------------------------------------------------------------------------------- */

/* What a light makes of two random numbers: its point or direction of this cell, or, if y0 is given, what it sends from
 * there: a direction, or a place on the disk by which parallel rays enter. */
static vec3 made_of(const struct scene *s, int cell, const struct light_point *y0, double u1, double u2, double *pdf)
{
    const struct light_set *lights = &s->lights;
    struct light_point at;
    if (y0 == NULL) {
        const double in_cell[3] = {0.5, u1, u2};
        light_sample_cell(lights, &s->geo, cell, in_cell, &at);
        *pdf = at.pdf_cell;
        return lights->light[at.light].kind == LIGHT_INFINITE ? at.w : at.p;
    }
    const double u[2] = {u1, u2};
    enum light_kind kind = lights->light[y0->light].kind;
    struct ray ray;
    light_sample_emission(lights, y0, u, &ray, pdf);
    return kind == LIGHT_INFINITE || kind == LIGHT_DISTANT ? ray.o : ray.d;
}

/* Around almost any point (maps have edges) the area that a small square is drawn as, times the density, is its own. */
static void check_area(struct test *t, const struct scene *s, struct rng *r, int cell, const struct light_point *y0)
{
    enum { TRIED = 40 };
    const double h = 1e-6;
    double worst = 0, none;
    int right = 0;
    for (int i = 0; i < TRIED; i++) {
        double u = 0.01 + 0.98 * rng_uniform(r), v = 0.01 + 0.98 * rng_uniform(r), pdf;
        vec3 a = sub(made_of(s, cell, y0, u + h, v, &none), made_of(s, cell, y0, u - h, v, &none));
        vec3 b = sub(made_of(s, cell, y0, u, v + h, &none), made_of(s, cell, y0, u, v - h, &none));
        made_of(s, cell, y0, u, v, &pdf);
        double error = fabs(pdf * length(cross(a, b)) / (4 * h * h) - 1);
        worst = fmax(worst, error);
        right += error < 1e-4;
    }
    CHECK(t, right >= 0.9 * TRIED, "light %d, %s: %d of %d densities are wrong, by %g at most",
          s->lights.cell[cell].light, y0 != NULL ? "what it sends" : "its points", TRIED - right, TRIED, worst);
}

/* Light i of a scene: its choice counts, who meets it finds the same densities, and draws have them. The scene's sky is
 * 1 everywhere, or has a map. */
static void check_light(struct test *t, const struct scene *s, struct rng *r, int i, bool map)
{
    const struct light *l = &s->lights.light[i];
    int cells = l->kind == LIGHT_INFINITE ? s->lights.n_cells - l->cell : 1, found;
    int cell = l->cell + (int)rng_below(r, (uint32_t)cells);
    const double in_cell[3] = {0.2, 0.3, 0.6}, u[2] = {0.3, 0.7};
    struct light_point at;
    struct ray ray;
    double pdf;
    if (!CHECK(t, light_sample_cell(&s->lights, &s->geo, cell, in_cell, &at) && at.light == i && at.cell == cell,
               "light %d: no point", i))
        return;
    double pmf = alias_pmf(&s->lights.choice, cell);
    CHECK(t, fabs(at.pdf / (at.pdf_cell * pmf) - 1) < 1e-12, "light %d: its choice does not count", i);
    if (l->kind == LIGHT_INFINITE) {
        pdf = light_pdf_sky(&s->lights, at.w, &found);
        CHECK(t, fabs(pdf / at.pdf - 1) < 1e-9 && found == cell, "light %d: density %g, not %g", i, pdf, at.pdf);
    }
    if (l->kind == LIGHT_AREA) {
        struct surface on;
        CHECK(t, shape_sample(&s->geo, l->prim, 0.3, 0.6, &on, &pdf), "light %d: no point", i);
        on.light = i;
        pdf = light_pdf_surface(&s->lights, &s->geo, &on);
        CHECK(t, fabs(pdf / at.pdf - 1) < 1e-9, "light %d: density %g, not %g", i, pdf, at.pdf);
    }
    if (l->kind == LIGHT_AREA || (l->kind == LIGHT_INFINITE && !map)) {
        double sent = light_Le(&s->lights, &at, l->kind == LIGHT_AREA ? at.n : neg(at.w)).r;
        CHECK(t, sent == 1, "light %d sends %g, not 1", i, sent);
    }
    double emitted = light_sample_emission(&s->lights, &at, u, &ray, &pdf).r;
    double full = light_Le(&s->lights, &at, ray.d).r * (l->kind == LIGHT_AREA ? abs_dot(at.n, ray.d) : 1);
    CHECK(t, fabs(emitted - full) <= 1e-12 * full, "light %d emits %g, not %g", i, emitted, full);
    bool one_texel = l->kind == LIGHT_INFINITE && s->lights.n_layers == 1;
    if (one_texel || l->kind == LIGHT_AREA)
        check_area(t, s, r, cell, NULL);
    check_area(t, s, r, cell, &at);
}

static void test_densities(struct test *t)
{
    enum { W = 16, H = 8 };
    static const char WORLD[] =
        "WorldBegin Rotate 50 1 2 3 AreaLightSource \"diffuse\" \"rgb L\" [1 2 3] Shape \"trianglemesh\"\n"
        "\"integer indices\" [0 1 2] \"point P\" [0 0 1  2 0 1  0 3 1] Shape \"sphere\" AreaLightSource \"diffuse\"\n"
        "\"bool twosided\" \"true\" Shape \"disk\" LightSource \"point\" LightSource \"spot\" LightSource \"distant\"\n"
        "Scale 1 2 3 Rotate 40 3 1 2 LightSource \"spot\" LightSource \"projection\"\n"
        "LightSource \"goniometric\" \"string mapname\" \"densities.pfm\" %s WorldEnd\n";
    static const char *const SKIES[] = {"LightSource \"infinite\"",
                                        "LightSource \"infinite\" \"string mapname\" \"densities.pfm\"",
                                        "LightSource \"infinite\" \"string mapname\" \"densities.pfm\"\n"
                                        "LightSource \"infinite\""};
    static float pixels[W * H * 3];
    char path[256];
    struct error err = {.text = ""};
    struct scene s;
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 9, 0);
    for (int i = 0; i < W * H * 3; i++)
        pixels[i] = (float)(i % 7 == 0 ? 0 : 1 + (i / 3) % 5);
    pixels[3 * (2 * W + 3)] = 50;
    snprintf(path, sizeof path, "%s/densities.pfm", test_tmp(t));
    if (!CHECK(t, image_write(path, W, H, pixels, &err), "%s", err.text))
        return;
    for (int sky = 0; sky < 3; sky++) {
        if (!scene_from_format(t, &s, WORLD, SKIES[sky]))
            return;
        CHECK(t, s.lights.n == 10 && s.lights.n_layers == 1 + sky / 2, "%d lights, %d layers", s.lights.n,
              s.lights.n_layers);
        for (int i = 0; i < s.lights.n; i++)
            check_light(t, &s, &r, i, sky > 0);
        scene_free(&s);
    }
}

void test_light_sent(struct test *t)
{
    test_densities(t);
    test_transformed(t);
    test_damaged_map(t);
    test_spot(t);
    test_pictures_sent(t);
}
