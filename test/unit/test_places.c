/* test_places.c: surfaces in one place (geometry/kdtree.h): walks, shadow rays and light sub-paths agree on which is
 * there.
 *
 * The light of a lamp that lies in a ceiling, or in another lamp, has a known value for all methods. In random scenes
 * with such places, each by itself: a point of a light is lit for another point if and only if a walk from there meets
 * that light, and the light sends something there.
 */
#include <stdio.h>
#include <stdlib.h>

#include "base/number.h"
#include "base/rng.h"
#include "caustics/visible.h"
#include "lab/numbers.h"
#include "lab/stats.h"
#include "helpers.h"
#include "random_scene.h"
#include "suites.h"

/* --- a known value ------------------------------------------------------------------------------------ */

/* A floor of albedo 1/2 below a ceiling at y = 2 with a square lamp from -1/2 to 1/2 in it, radiance 5 downwards, seen
 * from below that. %s: the inverse of a turn, the turn, ceiling and lamp. */
static const char ROOM[] =
    "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4 PixelFilter \"box\"\n"
    "LookAt 0 1.5 0  0 0 0  0 0 1 %s Camera \"perspective\" \"float fov\" 30 WorldBegin %s\n"
    "Material \"matte\" \"rgb Kd\" [ .5 .5 .5 ]\n%s"
    "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -2 0 -2 2 0 -2 2 0 2 -2 0 2 ]\n"
    "WorldEnd\n";

#define SQUARE(X0, X1, Z) "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" " \
    "[ " X0 " 2 -" Z " " X1 " 2 -" Z " " X1 " 2 " Z " " X0 " 2 " Z " ]\n"
#define CEILING SQUARE("-2", "2", "2")
#define LIGHT(L, SIDES) "AreaLightSource \"diffuse\" \"rgb L\" [ " L " " L " " L " ] \"bool twosided\" \"" SIDES "\" "
#define LAMP "AttributeBegin " LIGHT("5", "false") SQUARE("-.5", ".5", ".5") "AttributeEnd\n" /* shines downwards */

static const struct {
    const char *name, *text;
} PLACES[] = {
    {"a lamp in the ceiling", CEILING LAMP},
    {"a lamp that comes before its ceiling", LAMP CEILING},
    {"in a ceiling that is a disk",
     "AttributeBegin Rotate -90 1 0 0 Shape \"disk\" \"float height\" 2 \"float radius\" 3 AttributeEnd " LAMP},
    {"in two ceilings", CEILING "Material \"mirror\" " SQUARE("-3", "2", "1") LAMP "Material \"matte\" "},
    {"two-sided", CEILING "AttributeBegin " LIGHT("5", "true") SQUARE("-.5", ".5", ".5") "AttributeEnd\n"},
    {"see-through", CEILING "AttributeBegin Material \"none\" " LIGHT("5", "false") SQUARE("-.5", ".5", ".5")
                            "AttributeEnd\n"},
    {"in a lamp of less rank", LAMP "AttributeBegin " LIGHT("9", "true") SQUARE(".5", "-.5", ".5") "AttributeEnd\n"},
    {"in a larger one that faces away", "AttributeBegin ReverseOrientation " LIGHT("9", "false") SQUARE("-1", "1", "1")
                                        "AttributeEnd\n" LAMP},
    {"of two that overlap", CEILING "AttributeBegin " LIGHT("5", "false") SQUARE("-.5", ".2", ".5")
                            SQUARE("-.1", ".5", ".5") "AttributeEnd\n"},
    {"back to back", "AttributeBegin ReverseOrientation " LIGHT("9", "false") SQUARE("-.5", ".5", ".5")
                     "AttributeEnd\n" LAMP},
};
enum { N_PLACES = sizeof PLACES / sizeof PLACES[0] };

/* A turn of everything, in which the same plane is rounded to float point by point. */
static const char *const TURNS[][2] = {{"", ""},
                                       {"Rotate 37 1 2 3", "Rotate -37 1 2 3"},
                                       {"Translate 3 -2 5 Rotate -61 2 -1 1", "Rotate 61 2 -1 1 Translate -3 2 -5"}};

/* Radiance of the floor, in the mean over what is seen of it, by midpoints. */
static double floor_radiance(double lamp_from, double lamp_to)
{
    enum { N = 24 };
    double half = 1.5 * tan(15 * PI / 180), sum = 0;
    for (int i = 0; i < N * N; i++)
        for (int k = 0; k < N * N; k++) {
            double x = half * (2 * (i % N + 0.5) / N - 1), z = half * (2 * (i / N + 0.5) / N - 1);
            double dx = lamp_from + (lamp_to - lamp_from) * (k % N + 0.5) / N - x, dz = (k / N + 0.5) / N - 0.5 - z;
            sum += 4 / sqr(dx * dx + dz * dz + 4); /* cos cos / d^2, the height being 2 */
        }
    return 0.5 / PI * 5 * sum * (lamp_to - lamp_from) / ((double)N * N * N * N);
}

static void check_value(struct test *t, int i, int turn, const char *way, double expected)
{
    char text[4096];
    struct scene scene;
    snprintf(text, sizeof text, ROOM, TURNS[turn][1], TURNS[turn][0], PLACES[i].text);
    if (!scene_from_text(t, text, &scene))
        return;
    const char *integrator = set_method(&scene, way);
    struct batches b = render_batches(t, &scene, integrator, 1, 256, 8, 4, 5);
    TEST_ACCEPT(t, mean_p(&b, expected), "%s, %s %s: %.5g, not %.5g", way, PLACES[i].name, TURNS[turn][0],
                batches_mean(&b, NULL), expected);
    batches_free(&b);
    scene_free(&scene);
}

/* --- agreement ---------------------------------------------------------------------------------------- */

static vec3 in_ball(struct rng *r, double radius)
{
    vec3 w = on_sphere(r);
    return mul(w, radius * rng_uniform(r));
}

/* Of an eye walk from z in direction w: the light that shines at it first, or the surface. */
static struct surface seen_from(const struct scene *s, vec3 z, vec3 w)
{
    struct ray ray = {z, w, ray_margin(z), INFINITY, 0, 0};
    struct surface at = {.light = -1}, lamp;
    bool met = scene_intersect(s, &ray, &at);
    return scene_lamp(s, &ray, false, met ? &at : NULL, &lamp) ? lamp : at;
}

/* Of a light sub-path from a point of a light in direction w: does it reach z, or another light in the place of this
 * one, where it should end? */
static bool reaches(const struct scene *s, const struct light_point *y, vec3 w, vec3 z)
{
    double margin = ray_margin(y->p), distance = length(sub(z, y->p));
    struct ray ray = {y->p, w, -GRAZING * margin, INFINITY, y->prim_id, 0};
    struct surface at = {.p = z};
    if (!scene_intersect(s, &ray, &at))
        at.p = add(y->p, mul(w, 2 * distance));
    double way = length(sub(at.p, y->p));
    struct surface end = way < distance ? at : (struct surface){.p = z};
    return !scene_lamp_stops(s, &ray, &end) && (way > distance || way <= margin);
}

/* Do all agree on points of lights? Returns how many are lit. */
static int check_lights(struct test *t, uint64_t scene, const struct scene *s, double unit, struct rng *r)
{
    int lit = 0, area = 0;
    while (area < s->lights.n && s->lights.light[area].kind != LIGHT_AREA)
        area++;
    for (int i = 0; i < 1000 && area < s->lights.n; i++) {
        const struct light *l = &s->lights.light[rng_below(r, (uint32_t)s->lights.n)];
        struct light_point y;
        const double u[3] = {rng_uniform(r), rng_uniform(r), rng_uniform(r)};
        vec3 z = in_ball(r, 4 * unit);
        if (l->kind != LIGHT_AREA || !light_sample_cell(&s->lights, &s->geo, l->cell, u, &y))
            continue;
        vec3 w = normalize(sub(z, y.p));
        if (rgb_is_black(light_Le(&s->lights, &y, w)) || fabs(dot(w, y.n)) < 1e-3)
            continue;
        struct surface seen = seen_from(s, z, neg(w));
        bool sees = seen.light >= 0 && seen.prim_id == y.prim_id && length(sub(seen.p, y.p)) < 1e-5 * unit;
        bool shadow = scene_lit(s, z, 0, y.p, y.prim_id), sent = reaches(s, &y, w, z);
        CHECK(t, shadow == sees && sent == sees,
              "scene %llu, light %d: %s by a walk, %s by a shadow ray, %s by the light", (unsigned long long)scene,
              y.light, sees ? "seen" : "not seen", shadow ? "lit" : "dark", sent ? "reached" : "not reached");
        lit += sees;
    }
    return lit;
}

/* Is it the same surface from both sides? Not so of lights, which may shine to different ones. Returns how many. */
static int check_sides(struct test *t, uint64_t scene, const struct scene *s, double unit, struct rng *r)
{
    int n = 0;
    for (int i = 0; i < 1000; i++) {
        vec3 o = in_ball(r, 4 * unit), d = on_sphere(r);
        struct ray there = {o, d, 0, INFINITY, 0, 0};
        struct hit a, b;
        if (!kd_closest(&s->kd, &s->geo, &there, &a) || shape_is_light(&s->geo, a.prim))
            continue;
        double step = 1e-4 * unit;
        struct ray back = {add(o, mul(d, a.t + step)), neg(d), 0, 2 * step, 0, 0};
        bool met = kd_closest(&s->kd, &s->geo, &back, &b) && fabs(b.t - step) < 1e-9 * unit;
        n += met;
        CHECK(t, !met || b.prim == a.prim, "scene %llu: %d from one side, %d from the other", (unsigned long long)scene,
              a.prim, b.prim);
    }
    return n;
}

static void check_agreement(struct test *t)
{
    enum { SCENES = 480 };
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 104, 0);
    char top[1024];
    int lit = 0, sides = 0;
    top_directory(top, sizeof top);
    for (uint64_t i = 0; i < SCENES; i++) {
        struct random_scene made = random_scene(i, top, false);
        struct scene s;
        if (made.placed && scene_from_text(t, made.text, &s)) {
            lit += check_lights(t, i, &s, made.unit, &r);
            sides += check_sides(t, i, &s, made.unit, &r);
            scene_free(&s);
        }
        free(made.text);
    }
    CHECK(t, lit > 10000 && sides > 10000, "only %d points of lights are lit, %d of surfaces met", lit, sides);
}

/* A label in the plane of a wall, all turned at random, is there whole if it comes first in the file: under a sky of 1 it
 * shows its albedo, seen and lit from any side, by all methods. If it has that of the wall, it cannot be seen at all. */
static void test_labels(struct test *t, int n)
{
    static const char *const WAYS[] = {"pt", "bdpt", "asbdpt"};
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 105, 0);
    for (int i = 0; i < n; i++) {
        struct scene scene;
        vec3 axis = on_sphere(&r), at = mul(on_sphere(&r), 3 * rng_uniform(&r)), eye = mul(on_sphere(&r), 3);
        bool same = i % 2 == 0, first = rng_uniform(&r) < 0.5;
        double angle = 360 * rng_uniform(&r), label = same ? 0.8 : 0.1;
        eye.z = fabs(eye.z) + 0.3;
        char wall[512], text[512];
        snprintf(wall, sizeof wall, "Material \"matte\" \"rgb Kd\" [.8 .8 .8] Shape \"trianglemesh\" \"point P\" "
                 "[-9 -9 0 9 -9 0 9 9 0 -9 9 0] \"integer indices\" [0 1 2 0 2 3]\n");
        snprintf(text, sizeof text, "Material \"matte\" \"rgb Kd\" [%g %g %g] Shape \"trianglemesh\" \"point P\" "
                 "[-1 -1 0 1.3 -.7 0 .1 1.1 0] \"integer indices\" [0 1 2]\n", label, label, label);
        if (!scene_from_format(t, &scene,
                               "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4 PixelFilter \"box\"\n"
                               "LookAt %g %g %g 0 0 0 .1 1 .2 Translate %g %g %g Rotate %g %g %g %g\n"
                               "Camera \"perspective\" \"float fov\" .3 WorldBegin LightSource \"infinite\"\n"
                               "Rotate %g %g %g %g Translate %g %g %g %s%s WorldEnd", eye.x, eye.y, eye.z, -at.x, -at.y,
                               -at.z, -angle, axis.x, axis.y, axis.z, angle, axis.x, axis.y, axis.z, at.x, at.y, at.z,
                               first || !same ? text : wall, first || !same ? wall : text))
            continue;
        struct batches b = render_batches(t, &scene, WAYS[i % 3], 1, 256, 8, 4, 900 + (uint64_t)i);
        double mean = batches_mean(&b, NULL);
        TEST_ACCEPT(t, mean_p(&b, label), "label %d by %s: %.5f, not %g", i, WAYS[i % 3], mean, label);
        TEST_REJECT(t, mean_p(&b, 0.9 * label), "label %d by %s: 10 %% less", i, WAYS[i % 3]);
        batches_free(&b);
        scene_free(&scene);
    }
}

/* Every place by every method, in one of the turns or in all. */
static void test_values(struct test *t, bool all)
{
    static const char *const WAYS[] = {"pt", "lt", "bdpt", "asbdpt"};
    double expected = floor_radiance(-0.5, 0.5);
    for (int i = 0; i < N_PLACES; i++)
        for (int k = 0; k < 12; k++)
            if (all || k / 4 == (i + k % 4) % 3)
                check_value(t, i, k / 4, WAYS[k % 4], expected);
}

void test_places(struct test *t)
{
    check_agreement(t);
    test_labels(t, 24);
    test_values(t, false);
}

void test_places_long(struct test *t)
{
    test_labels(t, 60);
    test_values(t, true);
}
