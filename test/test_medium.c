/* test_medium.c: media by themselves: closed forms and quadrature. That all strategies weigh paths through them as one
 * is in test_mis.c. */
#include <math.h>
#include <stdio.h>

#include "base/maths.h"
#include "helpers.h"
#include "transport/vertex.h"
#include "tests.h"

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

/* In a closed room whose walls shine with 1 nothing can be seen of fog that scatters all it takes. */
static void test_furnace(struct test *t)
{
    for (int i = 0; i < 2; i++) {
        char text[1024];
        snprintf(text, sizeof text, VIEW "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" "
                 "\"rgb sigma_a\" [0 0 0] \"rgb sigma_s\" [.1 .2 .3] \"float g\" %g MediumInterface \"fog\" \"fog\"\n"
                 "LookAt 0 0 0 0 0 1 0 1 0 Camera \"perspective\" \"float fov\" 60 WorldBegin\n"
                 "Material \"matte\" \"rgb Kd\" [0 0 0] AreaLightSource \"diffuse\" \"bool twosided\" \"true\"\n"
                 "Shape \"sphere\" WorldEnd", 0.8 * i - 0.4);
        expect(t, text, 1, 3, 10, 16);
    }
}

/* A slab that absorbs, bounded by interfaces, before a surface that shines: exp(-sigma d). */
static void test_slab(struct test *t)
{
    static const char text[] =
        VIEW
        "MakeNamedMedium \"ink\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [.1 .3 .9] \"rgb sigma_s\" [0 0 0]"
        "MakeNamedMedium \"tar\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [.4 .2 .1] \"rgb sigma_s\" [0 0 0]"
        "LookAt 0 0 -5 0 0 0 0 1 0 Camera \"orthographic\" \"float screenwindow\" [-.1 .1 -.1 .1] WorldBegin\n"
        "AttributeBegin AreaLightSource \"diffuse\" \"bool twosided\" \"true\" \"rgb L\" [2 2 2] Material \"matte\"\n"
        "\"rgb Kd\" [0 0 0] Translate 0 0 4 Shape \"disk\" AttributeEnd Material \"\"\n"
        "AttributeBegin MediumInterface \"ink\" \"\"\n"
        "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3  6 5 4 7 6 4] \"point P\" [-1 -1 -1  -1 1 -1  1 1 -1\n"
        "  1 -1 -1  -1 -1 1  -1 1 1  1 1 1  1 -1 1]\n"
        "MediumInterface \"tar\" \"ink\" Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3  6 5 4 7 6 4]\n"
        "  \"point P\" [-1 -1 -.5  -1 1 -.5  1 1 -.5  1 -1 -.5  -1 -1 .25  -1 1 .25  1 1 .25  1 -1 .25]\n"
        "AttributeEnd WorldEnd";
    const double ink[3] = {0.1, 0.3, 0.9}, tar[3] = {0.4, 0.2, 0.1};
    double wanted = 0;
    for (int c = 0; c < 3; c++)
        wanted += 2 * exp(-1.25 * ink[c] - 0.75 * tar[c]) / 3;
    expect(t, text, wanted, 3, 3, 512);
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

/* Within a medium a region is one for all directions, and no surface's. */
static void test_regions(struct test *t)
{
    struct regions r;
    struct vertex v = {.kind = VERTEX_MEDIUM, .p = {0.5, 0.5, 0.5}, .wo = {0, 0, 1}};
    regions_init(&r, vec(0, 0, 0), vec(1, 1, 1), 4, 2, 100);
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

void test_medium(struct test *t)
{
    test_regions(t);
    test_furnace(t);
    test_slab(t);
    test_once(t);
}
