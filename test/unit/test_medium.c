/* test_medium.c: media alone, against closed forms and quadrature. That all strategies weigh paths through them as one
 * is in test_mis.c. */
#include <math.h>
#include <stdio.h>

#include "base/maths.h"
#include "caustics/visible.h"
#include "transport/vertex.h"
#include "agree.h"
#include "helpers.h"
#include "suites.h"

#define VIEW                                                                                                           \
    "Integrator \"bdpt\" Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4 PixelFilter \"box\"\n"

static const char *const WAYS[] = {"pt", "bdpt", "asbdpt", "asbdpt select=pool", "lt"};

/* Does the mean of all channels come out, by the first of these ways? And would it be noticed if it were 5 % off? */
static void expect(struct test *t, const char *text, double wanted, int ways, int depth, int spp)
{
    struct scene scene;
    if (!scene_from_text(t, text, &scene))
        return;
    for (int i = 0; i < ways; i++) {
        struct batches b = render_batches(t, &scene, set_method(&scene, WAYS[i]), depth, spp, 16, 4, 5 + (uint64_t)i);
        double mean = batches_mean(&b, NULL);
        TEST_ACCEPT(t, mean_p(&b, wanted), "%s: %.5f, not %.5f", WAYS[i], mean, wanted);
        TEST_REJECT(t, mean_p(&b, 1.05 * wanted), "%s: 5 %% more than %.5f", WAYS[i], wanted);
        batches_free(&b);
    }
    scene_free(&scene);
}

#define BLACK "Material \"matte\" \"rgb Kd\" [0 0 0]\n"

/* In a closed room whose walls shine with 1 nothing can be seen of fog that scatters all it takes. The walls are black,
 * or see-through; these bound the fog, or stand in it just before black ones. */
static void test_furnace(struct test *t)
{
    static const char *const WALLS[] = {BLACK,
                                        "Material \"none\" MediumInterface \"fog\" \"\"",
                                        BLACK "Shape \"sphere\" \"float radius\" 1.0001 Material \"none\""};
    for (int i = 0; i < 6; i++) {
        char text[1024];
        snprintf(text, sizeof text, VIEW "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" "
                 "\"rgb sigma_a\" [0 0 0] \"rgb sigma_s\" [.1 .2 .3] \"float g\" %g MediumInterface \"fog\" \"fog\"\n"
                 "LookAt 0 0 0 0 0 1 0 1 0 Camera \"perspective\" \"float fov\" 60 WorldBegin\n"
                 "AttributeBegin %s AreaLightSource \"diffuse\" \"bool twosided\" \"true\"\n"
                 "Shape \"sphere\" AttributeEnd WorldEnd", 0.8 * (i % 2) - 0.4, WALLS[i / 2]);
        expect(t, text, 1, 3, 10, 16);
    }
}

/* A point light in fog without end, scattered once, along the one ray that is seen: the integral over that ray. */
static void test_once(struct test *t)
{
    const double sigma_s[3] = {0.3, 0.5, 0.2}, sigma_t[3] = {0.4, 0.7, 0.5}, x = 0.7, z = 1.2;
    for (int i = 0; i < 3; i++) {
        enum { STEPS = 100000 };
        double g = 0.5 * i - 0.5, wanted = 0;
        for (int k = 0; k < STEPS; k++) {
            double d = 40 * (k + 0.5) / STEPS, r = hypot(x, z - d), cosine = (z - d) / r; /* of the turn */
            double phase = (1 - g * g) / (4 * PI * pow(1 + g * g - 2 * g * cosine, 1.5));
            for (int c = 0; c < 3; c++)
                wanted += 40.0 / STEPS * sigma_s[c] * phase * 5 * exp(-sigma_t[c] * (d + r)) / (r * r) / 3;
        }
        char text[1024];
        snprintf(text, sizeof text, VIEW "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\n"
                 "\"rgb sigma_a\" [.1 .2 .3] \"rgb sigma_s\" [.3 .5 .2] \"float g\" %g MediumInterface \"fog\"\n"
                 "LookAt 0 0 0 0 0 1 0 1 0 Camera \"perspective\" \"float fov\" .01 WorldBegin\n"
                 "LightSource \"point\" \"rgb I\" [5 5 5] \"point from\" [%g 0 %g] WorldEnd", g, x, z);
        expect(t, text, wanted, 4, 1, 192);
    }
}

/* --- media without a bound, under lights at infinity ------------------------------------------------------ */

/* With nothing in the scene but the camera the medium about it ends on a sphere of radius 1. Above the lights stands a
 * MediumInterface, which does not matter. */
static void endless(char *text, size_t size, const char *sigma_a, const char *sigma_s, double g, const char *light)
{
    snprintf(text, size, VIEW "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [%s]\n"
             "\"rgb sigma_s\" [%s] \"float g\" %g MediumInterface \"fog\"\n"
             "LookAt 0 0 0 0 0 1 0 1 0 Camera \"perspective\" \"float fov\" %s WorldBegin\n"
             "MediumInterface \"\" \"fog\" LightSource %s WorldEnd", sigma_a, sigma_s, g,
             light[1] == 'd' ? ".01" : "60", light);
}

/* Of a sky of 1 fog that absorbs leaves exp(-sigma); of fog that scatters all it takes nothing is seen. */
static void test_sky(struct test *t)
{
    char text[1024];
    endless(text, sizeof text, ".1 .3 .9", "0 0 0", 0, "\"infinite\"");
    expect(t, text, (exp(-0.1) + exp(-0.3) + exp(-0.9)) / 3, 3, 3, 64);
    endless(text, sizeof text, "0 0 0", ".1 .3 .5", 0.3, "\"infinite\"");
    expect(t, text, 1, 3, 12, 24);
}

/* The sun, scattered once along the one ray that is seen. */
static void test_sun(struct test *t)
{
    enum { STEPS = 20000 };
    const double sigma_s[3] = {0.3, 0.5, 0.2}, sigma_t[3] = {0.4, 0.7, 0.5}, wz = 0.6, g = 0.4;
    double wanted = 0, phase = (1 - g * g) / (4 * PI * pow(1 + g * g - 2 * g * wz, 1.5));
    for (int k = 0; k < STEPS; k++) {
        double d = (k + 0.5) / STEPS, out = sqrt(1 - d * d + sqr(d * wz)) - d * wz;
        for (int c = 0; c < 3; c++)
            wanted += sigma_s[c] * phase * 5 * exp(-sigma_t[c] * (d + out)) / STEPS / 3;
    }
    char text[1024];
    endless(text, sizeof text, ".1 .2 .3", ".3 .5 .2", g,
            "\"distant\" \"rgb L\" [5 5 5] \"point from\" [.8 0 .6] \"point to\" [0 0 0]");
    expect(t, text, wanted, 3, 1, 192);
}

/* --- interfaces in one place -------------------------------------------------------------------------------- */

/* Two slabs that absorb, one on the other: they share a face. Below the lower lies a floor, in its face, or between
 * them a sheet that lets half of the light through, lit from below; the sun is seen on it. All is turned, or not. */
static void test_coplanar(struct test *t)
{
#define BOX(low, high)                                                                                                 \
    "Shape \"trianglemesh\" \"integer indices\"\n"                                                                     \
    "[0 3 2 0 2 1 4 5 6 4 6 7 0 1 5 0 5 4 3 7 6 3 6 2 0 4 7 0 7 3 1 2 6 1 6 5]\n"                                      \
    "\"point P\" [-4 " low " -4 4 " low " -4 4 " high " -4 -4 " high " -4\n"                                           \
    "-4 " low " 4 4 " low " 4 4 " high " 4 -4 " high " 4]\n"
    const double ink[3] = {0.1, 0.3, 0.9}, tar[3] = {0.4, 0.2, 0.1}, cos_i = 1 / sqrt(1.45), cos_o = 1 / sqrt(1.25);
    for (int i = 0; i < 4; i++) {
        bool sheet = i % 2 == 1;
        char text[3000];
        double wanted = 0;
        for (int c = 0; c < 3; c++)
            wanted += 3 / PI * 0.5 * cos_i / 3 *
                      (sheet ? exp(-0.5 * tar[c] / cos_o - 0.5 * ink[c] / cos_i)
                             : exp(-0.5 * (tar[c] + ink[c]) * (1 / cos_o + 1 / cos_i)));
        snprintf(text, sizeof text,
                 VIEW
                 "MakeNamedMedium \"ink\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [.1 .3 .9]\n"
                 "\"rgb sigma_s\" [0 0 0]\n"
                 "MakeNamedMedium \"tar\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [.4 .2 .1]\n"
                 "\"rgb sigma_s\" [0 0 0]\n"
                 "LookAt .6 %s .8  0 %s 0  1 0 0 Rotate %d .3 1 .2 Camera \"orthographic\"\n"
                 "\"float screenwindow\" [-1 1 -1 1] WorldBegin Rotate %d .3 1 .2\n"
                 "LightSource \"distant\" \"rgb L\" [3 3 3] \"point from\" [.6 %d -.3] \"point to\" [0 0 0]\n"
                 "AttributeBegin Material \"%s\" \"rgb Kd\" [%s] \"rgb Ks\" [0 0 0]\n"
                 "Translate 0 %s 0 " QUAD("%s")
                 "AttributeEnd Material \"\" MediumInterface \"ink\" \"\"\n" BOX("0", ".5")
                 "MediumInterface \"tar\" \"\"\n" BOX(".5", "1") "WorldEnd",
                 sheet ? "2.5" : "2", sheet ? ".5" : "0", i < 2 ? 0 : -33, i < 2 ? 0 : 33, sheet ? -1 : 1,
                 sheet ? "translucent" : "matte", sheet ? "1 1 1" : ".5 .5 .5", sheet ? ".5" : "0",
                 sheet ? "-3.9 0 -3.9 -3.9 0 3.9 3.9 0 3.9 3.9 0 -3.9" : "-5 0 -5 -5 0 5 5 0 5 5 0 -5");
        expect(t, text, wanted, 3, 1, 128);
    }
}

/* Within a medium a region is one for all directions, and no surface's. */
static void test_regions_within(struct test *t)
{
    struct regions r;
    struct vertex v = {.kind = VERTEX_MEDIUM, .p = {0.5, 0.5, 0.5}, .wo = {0, 0, 1}};
    regions_init(&r, vec(0, 0, 0), vec(1, 1, 1), 4, 100);
    v.bsdf.transmits = true;
    uint64_t key = regions_key(&r, v.p, vertex_side(&v));
    v.wo = vec(-1, 0, 0);
    CHECK(t, regions_key(&r, v.p, vertex_side(&v)) == key, "another direction is another region");
    for (int i = 0; i < 6; i++) {
        const double n[3] = {(i == 0) - (i == 1), (i == 2) - (i == 3), (i == 4) - (i == 5)};
        CHECK(t, regions_key(&r, v.p, vec(n[0], n[1], n[2])) != key, "a surface has a medium's region %d", i);
    }
    regions_free(&r);
}

/* A point in a medium may be as close to a surface as rounding lets it be. Walks meet that surface, and connections at
 * either end are stopped by it; a point on a surface sees nothing so close. */
static void test_close(struct test *t)
{
    static const char wall[] =
        "LookAt 0 0 0 0 0 1 0 1 0 Camera \"perspective\" WorldBegin LightSource \"infinite\" Shape \"trianglemesh\" "
        "\"integer indices\" [ 0 1 2 ] \"point P\" [ -9999 -9999 1000 9999 -9999 1000 0 9999 1000 ] WorldEnd";
    struct scene scene;
    if (!scene_from_text(t, wall, &scene))
        return;
    for (int back = 0; back < 2; back++) {
        double side = back ? 1 : -1;
        struct vertex z = {.kind = VERTEX_MEDIUM, .prim_id = WITHIN_MEDIUM, .p = {0, 0, 1000 + side * 3e-5}};
        vec3 far = {0, 0, 1000 - 10 * side}, w = {0, 0, -side};
        struct surface at;
        struct ray ray = {z.p, w, end_margin(z.p, z.prim_id), INFINITY, z.prim_id, 0};
        CHECK(t, scene_intersect(&scene, &ray, &at), "a walk passes a wall next to where it was scattered");
        CHECK(t, !scene_visible(&scene, z.p, WITHIN_MEDIUM, far, WITHIN_MEDIUM), "a connection from there passes it");
        CHECK(t, !scene_visible(&scene, far, WITHIN_MEDIUM, z.p, WITHIN_MEDIUM), "a connection to there passes it");
        CHECK(t, !scene_lit_from(&scene, z.p, WITHIN_MEDIUM, w), "light from infinity passes it");
        CHECK(t, !scene_lit(&scene, z.p, WITHIN_MEDIUM, far, 0), "light of a point passes it");
        CHECK(t, scene_visible(&scene, z.p, 7, far, WITHIN_MEDIUM), "a point on a surface sees what is next to it");
    }
    scene_free(&scene);
}

void test_medium(struct test *t)
{
    test_regions_within(t);
    test_close(t);
    test_furnace(t);
    test_once(t);
    test_sky(t);
    test_sun(t);
    test_coplanar(t);
}

/* --- the suite media ------------------------------------------------------------------------------------------ */

/* `spp` of bdpt bring the noise down so far that what is `planted` is seen. Light sub-paths alone do not show what is
 * behind glass; eye sub-paths do not find a thread of light before long, nor chains of mmlt a lamp behind glass. */
#define POOLED "asbdpt, asbdpt select=pool, asbdpt select=vertices, lvc, cbdpt, mbdpt"
static const struct {
    const char *name;
    int depth, spp;
    double planted;
    const char *quick, *pooled, *chains; /* methods, and pt, in place of quick ones where there are none: */
    int pt;                              /* so many times the samples */
} SCENES[] = {{"scenes/media/fog-cornell", 6, 12, 0.3, "lt, asbdpt", "lt, " POOLED, "pssmlt, mmlt", 4},
              {"scenes/media/laser", 5, 8, 0.5, "lt, asbdpt", "lt, " POOLED, "pssmlt, mmlt", 0},
              {"scenes/media/milk-ball", 8, 8, 0.25, "asbdpt", POOLED, "pssmlt", 4},
              {"scenes/media/murky-water", 8, 16, 0.8, "", POOLED, "pssmlt", 4},
              {"scenes/media/nested", 6, 4, 0.3, "", "lt, " POOLED, "pssmlt, mmlt", 4},
              {"scenes/media/inside", 6, 8, 0.8, "", "lt, " POOLED, "pssmlt, mmlt", 4}};

/* Batches of a Markov chain are few and far from normal: nothing is planted. */
static void test_all(struct test *t, bool quick)
{
    enum { SIZE = 16, BATCHES = 12 };
    for (size_t i = 0; i < sizeof SCENES / sizeof SCENES[0]; i++) {
        struct agreement a = {SCENES[i].name, SIZE, SIZE, SCENES[i].depth, "bdpt", quick ? SCENES[i].quick
                              : SCENES[i].pooled, SCENES[i].spp, SCENES[i].spp, BATCHES, quick ? SIZE : SIZE / 2, false,
                              SCENES[i].planted};
        check_agreements(t, &a, a.ways[0] != '\0', quick ? 1 : 4);
        bool by_pt = !quick || a.ways[0] == '\0';
        a.ways = "pt";
        a.spp *= SCENES[i].pt;
        check_agreements(t, &a, by_pt && a.spp > 0, quick ? 1 : 4);
        a.ways = SCENES[i].chains;
        a.spp = SCENES[i].spp;
        a.planted = 0;
        check_agreements(t, &a, !quick, 4);
    }
}

/* media: the scenes of scenes/media by all methods that render media: each has the expectation of bdpt, and a
 * planted fault is found. test_medium.c has closed forms, test_strategies.c one strategy after another. */
void test_media(struct test *t) { test_all(t, true); }
void test_media_long(struct test *t) { test_all(t, false); }
