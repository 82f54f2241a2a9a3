/* test_light.c: the choice among lights, their powers, and the texels of their images. test_light_sent.c has the
 * densities that lights state. */
#include <math.h>
#include <stdio.h>

#include "base/rng.h"
#include "caustics/lamp.h"
#include "lab/files.h"
#include "lab/stats.h"
#include "helpers.h"
#include "suites.h"

static const char LIGHTS[] =
    "WorldBegin\n"
    "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [1 2 3]\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [0 0 1  2 0 1  0 3 1] AttributeEnd\n"
    "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"bool twosided\" \"true\"\n"
    "Shape \"disk\" \"float radius\" 2 AttributeEnd\n"
    "LightSource \"point\" \"rgb I\" [1 1 1]\n"
    "LightSource \"spot\" \"rgb I\" [1 1 1] \"point from\" [0 0 0] \"point to\" [0 0 1] \"float coneangle\" 60\n"
    "WorldEnd\n";

static void test_choice(struct test *t)
{
    enum { DRAWS = 20000 };
    struct scene scene;
    if (!scene_from_text(t, LIGHTS, &scene))
        return;
    double counts[4] = {0}, expected[4], total = 0;
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 6, 0);
    CHECK(t, scene.lights.n == 4, "%d lights", scene.lights.n);
    for (int i = 0; i < DRAWS; i++) {
        double u[3] = {rng_uniform(&r), rng_uniform(&r), rng_uniform(&r)};
        struct light_point at;
        CHECK(t, lamp_point(&scene.lights, &scene.geo, u, &at), "no light point");
        counts[at.light]++;
    }
    for (int i = 0; i < 4; i++)
        total += scene.lights.light[i].power;
    for (int i = 0; i < 4; i++)
        expected[i] = DRAWS * scene.lights.light[i].power / total;
    TEST_ACCEPT(t, stats_chi2_test(counts, expected, 4), "choice of lights by power");
    expected[0] *= 1.2;
    TEST_REJECT(t, stats_chi2_test(counts, expected, 4), "choice of lights with a wrong power");
    double area = 3, wanted = PI * area * rgb_luminance(rgb_make(1, 2, 3));
    CHECK(t, fabs(scene.lights.light[0].power / wanted - 1) < 1e-6, "area light power %g, expected %g",
          scene.lights.light[0].power, wanted);
    scene_free(&scene);
}

/* The numbers of a map are taken as they stand in its file, also those of 8-bit pictures, which are written as sRGB. */
static void test_stored_map(struct test *t)
{
    static const char *const names[] = {"grey.pfm", "grey.png", "grey.ppm"};
    float pixels[2 * 3];
    for (int i = 0; i < 2 * 3; i++)
        pixels[i] = 0.5f;
    for (int i = 0; i < 3; i++) {
        char path[256];
        struct error err = {.text = ""};
        const struct budget memory = budget_new(0, "");
        snprintf(path, sizeof path, "%s/%s", test_tmp(t), names[i]);
        CHECK(t, image_write(path, 2, 1, pixels, &err), "%s", err.text);
        struct envmap *e = envmap_load(path, &memory, &err);
        if (!CHECK(t, e != NULL, "%s", err.text))
            continue;
        double expected = i == 0 ? 0.5 : 188 / 255.0, L = envmap_lookup(e, vec(1, 0, 0)).g;
        CHECK(t, fabs(L - expected) < 1e-6 && fabs(e->mean.g - expected) < 1e-6, "%s: %g, mean %g, not %g", names[i], L,
              e->mean.g, expected);
        envmap_free(e);
    }
}

/* Lights that name the same file share its map, and textures its image. What is no picture leaves nothing behind. A map
 * may be as large as memory allows. */
static void test_shared_picture(struct test *t)
{
    static const float pixels[2 * 3] = {1, 2, 3, 4, 5, 6};
    static const char TEXT_OF[] =
        "WorldBegin LightSource \"infinite\" \"string mapname\" \"a.pfm\" LightSource \"infinite\" \"string mapname\"\n"
        "\"a.pfm\" LightSource \"infinite\" \"string mapname\" \"b.pfm\"\n"
        "Texture \"1\" \"float\" \"imagemap\" \"string filename\" \"a.pfm\"\n"
        "Texture \"2\" \"float\" \"imagemap\" \"string filename\" \"a.pfm\"\n"
        "Texture \"3\" \"float\" \"imagemap\" \"string filename\" \"b.pfm\" WorldEnd";
    char path[2][256];
    struct error err = {.text = ""};
    const struct budget memory = budget_new(0, "");
    struct light_set set = {0};
    struct scene s;
    for (int i = 0; i < 2; i++) {
        snprintf(path[i], sizeof path[i], "%s/%c.pfm", test_tmp(t), 'a' + i);
        CHECK(t, image_write(path[i], 2, 1, pixels, &err), "%s", err.text);
    }
    if (scene_from_text(t, TEXT_OF, &s)) {
        const struct light *l = s.lights.layer;
        CHECK(t, l[0].frame->env != NULL && l[0].frame->env == l[1].frame->env &&
                     l[2].frame->env != l[0].frame->env && s.lights.n_maps == 2, "a map and another");
        CHECK(t, s.textures.n_images == 2, "%d images of two files", s.textures.n_images);
        scene_free(&s);
    }
    CHECK(t, light_read_map(&set, "missing.pfm", &memory, &err) < 0 && set.n_maps == 0, "a missing file");
    for (int i = 0; i < 2; i++) { /* two texels of 12 bytes, and 44 for the tables */
        const struct budget small = budget_new(2 * 56 - i, "");
        struct envmap *e = envmap_load(path[0], &small, &err);
        CHECK(t, (e != NULL) == (i == 0) && (i == 0 || strstr(err.text, "a.pfm: this needs 0.0 MB more") != NULL),
              "%s", err.text);
        envmap_free(e);
    }
}

void test_light(struct test *t)
{
    test_choice(t);
    test_stored_map(t);
    test_shared_picture(t);
}
