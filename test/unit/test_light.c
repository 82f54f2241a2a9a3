/* test_light.c: the choice among lights, their powers, and the texels of their images. test_light_sent.c has the
 * densities that lights state. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
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

/* As many cells as there can be: the sky stands between lamps, so that their runs are one more. */
static void test_most_cells(struct test *t)
{
    enum { WIDTH = 64, HEIGHT = 32, LAMPS = 512 };
    static float pixels[WIDTH * HEIGHT * 3];
    static char text[LAMPS * 32];
    char path[256];
    struct error err = {.text = ""};
    struct scene scene;
    for (int i = 0; i < WIDTH * HEIGHT * 3; i++)
        pixels[i] = 1;
    snprintf(path, sizeof path, "%s/even.pfm", test_tmp(t));
    CHECK(t, image_write(path, WIDTH, HEIGHT, pixels, &err), "%s", err.text);
    size_t n = (size_t)snprintf(text, sizeof text, "WorldBegin LightSource \"point\"\n"
                                "LightSource \"infinite\" \"string mapname\" \"%s\"\n", path);
    for (int i = 1; i < LAMPS; i++)
        n += (size_t)snprintf(text + n, sizeof text - n, "LightSource \"point\"\n");
    snprintf(text + n, sizeof text - n, "WorldEnd");
    if (!scene_from_text(t, text, &scene))
        return;
    CHECK(t, scene.lights.n_cells == LIGHT_CELLS, "%d cells, not %d", scene.lights.n_cells, LIGHT_CELLS);
    scene_free(&scene);
}

void test_light(struct test *t)
{
    test_most_cells(t);
    test_choice(t);
    test_stored_map(t);
    test_shared_picture(t);
}

/* --- the suite light-choice ----------------------------------------------------------------------------------- */

/* --- the choice --------------------------------------------------------------------------------------- */

/* %d lamps, of which every seventh is dark and number i has power 1 + i; two skies. */
static bool scene_of_lamps(struct test *t, int lamps, struct scene *out)
{
    static char text[1 << 16];
    int n = snprintf(text, sizeof text, "WorldBegin LightSource \"infinite\"\n"
                                        "LightSource \"infinite\" \"rgb L\" [0 3 0]\n");
    for (int i = 0; i < lamps; i++) {
        int I = i % 7 == 3 ? 0 : 1 + i;
        n += snprintf(text + n, sizeof text - (size_t)n, "LightSource \"point\" \"rgb I\" [%d %d %d]\n", I, I, I);
    }
    snprintf(text + n, sizeof text - (size_t)n, "Shape \"sphere\" WorldEnd\n");
    return scene_from_text(t, text, out);
}

/* Cells of one lamp or of two: all that emit are equally likely, the sky like two, whose cells are chosen by power. */
static void test_probabilities(struct test *t)
{
    static const int lamps[] = {5, 400};
    for (int k = 0; k < 2; k++) {
        struct scene scene;
        if (!scene_of_lamps(t, lamps[k], &scene))
            return;
        struct scene *even = scene_uniform(&scene);
        const struct light_set *by_power = &scene.lights, *set = &even->lights;
        int bright = lamps[k] - (lamps[k] + 3) / 7, sky = set->light[set->sky].cell;
        double each = 1.0 / (bright + 2), sky_pmf = 0, least = 1, most = 0;
        for (int cell = 0; cell < sky; cell++)
            for (int i = 0; i < 64; i++) { /* points of the cell's lamps: 1 is the density of a point light */
                const double u[3] = {(i + 0.5) / 64, 0.5, 0.5};
                struct light_point at;
                if (!CHECK(t, light_sample_cell(set, &even->geo, cell, u, &at), "cell %d", cell))
                    break;
                bool dark = set->light[at.light].power == 0; /* a cell of such lamps alone is never chosen */
                least = dark ? least : fmin(least, at.pdf);
                most = fmax(most, at.pdf);
                CHECK(t, !dark || at.pdf == 0, "%d lamps: number %d is dark, and chosen", lamps[k], at.light);
            }
        for (int cell = sky; cell < set->n_cells; cell++) {
            double ratio = alias_pmf(&set->choice, cell) / alias_pmf(&by_power->choice, cell);
            sky_pmf += alias_pmf(&set->choice, cell);
            CHECK(t, fabs(ratio / (alias_pmf(&set->choice, sky) / alias_pmf(&by_power->choice, sky)) - 1) < 1e-9,
                  "a cell of the sky is not chosen by power");
        }
        CHECK(t, fabs(least / each - 1) < 1e-9 && fabs(most / each - 1) < 1e-9, "%d lamps: %g to %g, not %g", lamps[k],
              least, most, each);
        CHECK(t, fabs(sky_pmf / (2 * each) - 1) < 1e-9, "%d lamps: two skies have %g, not %g", lamps[k], sky_pmf,
              2 * each);
        scene_uniform_free(even);
        scene_free(&scene);
    }
}

/* --- pictures ----------------------------------------------------------------------------------------- */

/* z from -3 to 3, the wall at z = 1, the camera before it. %g: how high it is; below 2 some light gets over it. */
static const char ROOMS[] =
    "LookAt 0 1 -2.9  0 .8 1  0 1 0 Camera \"perspective\" \"float fov\" 60\n"
    "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8 PixelFilter \"box\" WorldBegin\n"
    "LightSource \"point\" \"point from\" [.5 1.2 -1] \"rgb I\" [.2 .3 .4]\n"
    "LightSource \"point\" \"point from\" [-1 .4 2] \"rgb I\" [30 20 10]\n"
    "LightSource \"point\" \"point from\" [1 .4 2] \"rgb I\" [30 30 30]\n"
    "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [200 200 200]\n"
    QUAD("-1 .01 2  -1 .01 2.5  -.5 .01 2.5  -.5 .01 2")
    "AttributeEnd Material \"matte\" \"rgb Kd\" [.6 .5 .4]\n"
    QUAD("-2 0 -3  2 0 -3  2 0 3  -2 0 3") QUAD("-2 2 -3  2 2 -3  2 2 3  -2 2 3") QUAD("-2 0 3  2 0 3  2 2 3  -2 2 3")
    QUAD("-2 0 -3  -2 0 3  -2 2 3  -2 2 -3") QUAD("2 0 -3  2 0 3  2 2 3  2 2 -3")
    QUAD("-2 0 1  2 0 1  2 %g 1  -2 %g 1") "WorldEnd\n";

enum { SPP = 8, BATCHES = 64 };

/* Light tracing finds nothing else than s >= 2; both halves and the whole by each strategy, by a known one of power. */
static void test_means(struct test *t)
{
    static const char *const ways[] = {
        "pt lightsamplestrategy=uniform", "bdpt lightsamplestrategy=uniform", "lt lightsamplestrategy=uniform", "pt",
        "bdpt", "asbdpt lightsamplestrategy=uniform", "asbdpt select=vertices lightsamplestrategy=uniform"};
    struct scene scene;
    if (!scene_from_format(t, &scene, ROOMS, 1.9, 1.9))
        return;
    struct batches known = render_batches(t, &scene, set_method(&scene, "bdpt lightsamplestrategy=power"), 3, 8 * SPP,
                                          BATCHES, 8, 71);
    for (size_t i = 0; i < sizeof ways / sizeof ways[0]; i++) {
        double ratio;
        struct batches b = render_batches(t, &scene, set_method(&scene, ways[i]), 3, 4 * SPP, BATCHES, 8, 72);
        double p = batches_p(&b, &known, &ratio);
        TEST_ACCEPT(t, p, "%s: %.4f of the light", ways[i], ratio);
        batches_scale(&b, 1.3);
        p = batches_p(&b, &known, &ratio);
        TEST_REJECT(t, p, "%s: 30 %% more is %.4f of the light", ways[i], ratio);
        batches_free(&b);
    }
    batches_free(&known);
    scene_free(&scene);
}

/* Half the mean squared difference of two renders. */
static double noise(struct test *t, struct scene *scene, const char *way)
{
    float pixels[2][8 * 8 * 3];
    double sum = 0;
    for (int i = 0; i < 2; i++) {
        const char *integrator = set_method(scene, way);
        const struct render_job o = {.integrator = method_of(scene, integrator), .seed = 80 + (uint64_t)i,
                                         .end = 64, .max_depth = 1, .n_threads = 1};
        render_pixels(t, scene, &o, pixels[i]);
    }
    for (int i = 0; i < 8 * 8 * 3; i++)
        sum += sqr(pixels[0][i] - pixels[1][i]) / 2;
    return sum;
}

/* Of direct light, uniform is the best of the two that know nothing where the weak lamp is all that is seen; the guide
 * is best. Without it pt and bdpt are as by power, to the byte. */
static void test_noise_of_choice(struct test *t)
{
    static const char *const methods[] = {"pt", "bdpt"};
    struct scene scene;
    if (!scene_from_format(t, &scene, ROOMS, 2.0, 2.0))
        return;
    for (int i = 0; i < 2; i++) {
        char way[3][64];
        double error[3];
        static const char *const how[3] = {"lightsamplestrategy=power", "lightsamplestrategy=uniform", "guide=on"};
        const struct render_job o = {.end = 2, .max_depth = 3, .n_threads = 1, .seed = 4};
        for (int k = 0; k < 3; k++) {
            snprintf(way[k], sizeof way[k], "%s %s", methods[i], how[k]);
            error[k] = noise(t, &scene, way[k]);
        }
        CHECK(t, error[1] < 0.5 * error[0] && error[2] < 0.5 * error[1], "%s: squared errors %g, %g, %g", methods[i],
              error[0], error[1], error[2]);
        snprintf(way[1], sizeof way[1], "%s guide=off", methods[i]);
        CHECK(t, same_picture(t, &scene, way[1], way[0], o), "%s: no guide is not power", methods[i]);
        CHECK(t, same_picture(t, &scene, methods[i], way[2], o), "%s: the guide is not the default", methods[i]);
        CHECK(t, !same_picture(t, &scene, methods[i], way[0], o), "%s: the guide changes nothing", methods[i]);
    }
    scene_free(&scene);
}

/* light-choice: lightsamplestrategy and guide: every method obeys them, and they change the noise alone.
 *
 * A room behind a wall has four strong lamps; the weak one before the wall is all that the camera's side sees. Power
 * chooses it rarely, "uniform" once in five times, the guide nearly always. All agree in the mean, and the errors are in
 * that order.
 */
void test_light_choice(struct test *t)
{
    test_probabilities(t);
    test_means(t);
    test_noise_of_choice(t);
}
