/* test_render.c: whole renders: radiance known on paper, agreement of the integrators, reproducibility, crop,
 * filters. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/parallel.h"
#include "lab/stats.h"
#include "render/render.h"
#include "helpers.h"
#include "tests.h"

/* --- radiance known on paper ------------------------------------------------------------------------- */

/* A closed sphere of albedo 1/2 that emits 1 everywhere: every ray sees 1 + 1/2 + 1/4 + ..., cut at the depth. Direct
 * light of a disk of radius R at height h on the floor's centre: E = pi L R^2 / (R^2 + h^2), radiance kd E / pi. */
static const struct known {
    const char *name, *text;
    double expected;
    int depth, spp, size;
    uint64_t seed;
} KNOWN[] = {
    {"a furnace",
     "Camera \"perspective\" \"float fov\" 60\n"
     "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 16\n"
     "WorldBegin Material \"matte\" \"rgb Kd\" [.5 .5 .5] AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\n"
     "ReverseOrientation Shape \"sphere\" \"float radius\" 2 WorldEnd\n",
     1.9375, 4, 16, 16, 11},
    {"light of a disk",
     "LookAt 0 0.2 -1  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" .2\n"
     "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4\n"
     "WorldBegin Material \"matte\" \"rgb Kd\" [.6 .6 .6]\n"
     "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-5 0 -5  5 0 -5  5 0 5  -5 0 5]\n"
     "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [4 4 4] Translate 0 2 0 Rotate 90 1 0 0\n"
     "Shape \"disk\" \"float radius\" 1.5 AttributeEnd WorldEnd\n",
     0.6 * 4 * 1.5 * 1.5 / (1.5 * 1.5 + 4), 1, 512, 4, 13},
};

static void test_known(struct test *t, const struct known *k, const char *integrator)
{
    struct scene scene;
    if (!scene_from_text(t, k->text, &scene))
        return;
    double error;
    struct batches b = render_batches(t, &scene, integrator, k->depth, k->spp, 8, k->size, k->seed);
    double mean = batches_mean(&b, &error);
    TEST_ACCEPT(t, mean_p(&b, k->expected), "%s in %s: %.5f +- %.5f, expected %.5f", integrator, k->name, mean, error,
                k->expected);
    TEST_REJECT(t, mean_p(&b, k->expected * 1.05), "%s in %s, 5 %% brighter than it is", integrator, k->name);
    batches_free(&b);
    scene_free(&scene);
}

static void choose(struct scene *scene, const struct method *m)
{
    settings_clear(&scene->settings);
    if (m->select != NULL)
        settings_set(&scene->settings, "select", m->select, "test");
}

/* No shapes at all: every ray sees the sky. */
static void test_empty(struct test *t)
{
    static const char text[] =
        "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8\n"
        "WorldBegin LightSource \"infinite\" \"rgb L\" [.25 .5 .75] WorldEnd\n";
    struct scene scene;
    if (!scene_from_text(t, text, &scene))
        return;
    for (const struct method *const *m = method_list(); *m != NULL; m++) {
        choose(&scene, *m);
        struct batches b = render_batches(t, &scene, (*m)->name, 3, 2, 2, 8, 12);
        CHECK(t, fabs(b.value[0] - 0.25) < 1e-6 && fabs(b.value[2] - 0.75) < 1e-6, "%s: the sky is %g %g %g",
              (*m)->name, b.value[0], b.value[1], b.value[2]);
        batches_free(&b);
    }
    scene_free(&scene);
}

/* --- integrators agree ----------------------------------------------------------------------------------- */

static void agree(struct test *t, const struct scene *scene, const char *name, const char *a, int spp_a, const char *b,
                  int spp_b, int depth)
{
    double ratio;
    struct batches x = render_batches(t, scene, a, depth, spp_a, 12, 8, 21);
    struct batches y = render_batches(t, scene, b, depth, spp_b, 12, 8, 22);
    double p = batches_p(&x, &y, &ratio);
    TEST_ACCEPT(t, p, "%s: %s against %s, ratio of the means %.4f", name, a, b, ratio);
    batches_scale(&x, 1.1);
    TEST_REJECT(t, batches_p(&x, &y, &ratio), "%s: %s made 10 %% brighter against %s", name, a, b);
    batches_free(&x);
    batches_free(&y);
}

/* Everything at once: glass, mirror, rough metal, a lens and five kinds of light. Caustics of delta lights through
 * glass are invisible to pt and, seen on diffuse surfaces, visible to bdpt: glass casts its shadow only on mirrors
 * here. */
static const char EVERYTHING[] =
    "LookAt 0 1.5 -4  0 1 0  0 1 0\n"
    "Camera \"perspective\" \"float fov\" 50 \"float lensradius\" .05 \"float focaldistance\" 4\n"
    "Film \"image\" \"integer xresolution\" 24 \"integer yresolution\" 24\n"
    "WorldBegin\n"
    "%s\n"
    "Material \"matte\" \"rgb Kd\" [.7 .6 .5]\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-2 0 -2  2 0 -2  2 0 2  -2 0 2]\n"
    "Material \"metal\" \"float roughness\" .3\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-2 0 2  2 0 2  2 3 2  -2 3 2]\n"
    "Material \"plastic\" \"rgb Kd\" [.2 .4 .2] \"float roughness\" .2\n"
    "TransformBegin Translate .8 .6 .5 Shape \"sphere\" \"float radius\" .6 TransformEnd\n"
    "%s\n"
    "WorldEnd\n";

static const char AREA[] =
    "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [6 6 6]\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-1 3 -1  1 3 -1  1 3 1  -1 3 1]\n"
    "AttributeEnd\n";
static const char DELTAS[] =
    "LightSource \"point\" \"rgb I\" [3 3 3] \"point from\" [-1 2.5 0]\n"
    "LightSource \"spot\" \"rgb I\" [9 9 9] \"point from\" [1 2.5 -1] \"point to\" [0 0 0]\n"
    "LightSource \"distant\" \"rgb L\" [1 1 1] \"point from\" [1 4 -1] \"point to\" [0 0 0]\n";
static const char SKY[] = "LightSource \"infinite\" \"rgb L\" [.4 .5 .6]\n";
static const char SPECULAR[] =
    "Material \"mirror\"\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-2 0 -2  -2 0 2  -2 3 2  -2 3 -2]\n"
    "Material \"glass\"\n"
    "TransformBegin Translate -.7 .7 0 Shape \"sphere\" \"float radius\" .5 TransformEnd\n";

static void test_agreement(struct test *t)
{
    static const struct {
        const char *name, *light1, *light2, *light3, *objects;
        bool light_tracing; /* all paths are within reach of lt */
    } cases[] = {
        {"area light, diffuse and glossy", AREA, "", "", "", true},
        {"point, spot, distant", DELTAS, "", "", "", true},
        {"area and sky, mirror and glass", AREA, SKY, "", SPECULAR, false},
        {"all lights together", AREA, DELTAS, SKY, "", true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char lights[2048], text[8192];
        snprintf(lights, sizeof lights, "%s%s%s", cases[i].light1, cases[i].light2, cases[i].light3);
        snprintf(text, sizeof text, EVERYTHING, lights, cases[i].objects);
        struct scene scene;
        if (!scene_from_text(t, text, &scene))
            return;
        agree(t, &scene, cases[i].name, "bdpt", 16, "pt", 32, 4);
        if (cases[i].light_tracing)
            agree(t, &scene, cases[i].name, "bdpt", 16, "lt", 32, 3);
        scene_free(&scene);
    }
}

/* --- reproducibility --------------------------------------------------------------------------------- */

/* In two parts, the first of which may be empty. */
static float *render_pixels(struct test *t, const struct scene *scene, const char *integrator, int threads,
                            uint64_t seed, long middle, long end)
{
    struct pixel_rect crop = render_crop(scene);
    struct film film;
    struct error err;
    struct render_options o = {.integrator = integrator, .seed = seed, .end = middle, .planned = end,
                               .n_threads = threads, .max_depth = 4};
    film_init(&film, crop, scene->width, scene->height);
    CHECK(t, render_scene(scene, &o, &film, &err), "%s", err.text);
    o.first = middle;
    o.end = end;
    CHECK(t, render_scene(scene, &o, &film, &err), "%s", err.text);
    float *pixels = mem_alloc(rect_pixels(crop) * 3, sizeof *pixels);
    film_develop(&film, 1, pixels);
    film_free(&film);
    return pixels;
}

static void test_thread_counts(struct test *t)
{
    char text[8192];
    struct scene scene;
    snprintf(text, sizeof text, EVERYTHING, AREA, SPECULAR);
    if (!scene_from_text(t, text, &scene))
        return;
    scene.crop[2] = 0.25; /* two tiles */
    scene.crop[3] = 0.5;
    size_t bytes = rect_pixels(render_crop(&scene)) * 3 * sizeof(float);
    for (const struct method *const *m = method_list(); *m != NULL; m++) {
        const char *name = (*m)->name;
        choose(&scene, *m);
        float *one = render_pixels(t, &scene, name, 1, 5, 0, 40), *seven = render_pixels(t, &scene, name, 7, 5, 0, 40);
        float *split = render_pixels(t, &scene, name, 3, 5, 32, 40);
        float *other = render_pixels(t, &scene, name, 2, 6, 0, 40);
        CHECK(t, memcmp(one, seven, bytes) == 0, "%s depends on the number of threads", name);
        CHECK(t, memcmp(one, split, bytes) == 0, "%s: a render in two parts differs", name);
        CHECK(t, memcmp(one, other, bytes) != 0, "%s: the seed has no effect", name);
        free(one);
        free(seven);
        free(split);
        free(other);
    }
    scene_free(&scene);
}

/* The length of blocks says how often a render is at the end of one; it does not change the picture. */
struct ends {
    const struct film *film;
    long n;
};

static bool count_end(void *context, double done)
{
    struct ends *e = context;
    e->n += done > 0 && e->film->passes == 0;
    return true;
}

static void blocks(struct test *t, const char *integrator, int size, int spp, int longest)
{
    struct scene scene;
    struct film film[2];
    struct error err;
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", size, size, &scene))
        return;
    for (int i = 0; i < 2; i++) {
        struct ends ends = {&film[i], 0};
        struct render_options o = {.integrator = integrator, .end = spp, .block = i == 1 ? 1 : longest,
                                   .n_threads = 2, .progress = count_end, .progress_context = &ends};
        film_init(&film[i], render_crop(&scene), size, size);
        CHECK(t, render_scene(&scene, &o, &film[i], &err), "%s", err.text);
        CHECK(t, ends.n == (i == 1 ? spp : 1), "block %d: %ld ends", o.block, ends.n);
    }
    for (int i = 0; i < size * size * 3; i++)
        CHECK(t, film_value(&film[0], (size_t)i) == film_value(&film[1], (size_t)i), "value %d differs", i);
    film_free(&film[0]);
    film_free(&film[1]);
    scene_free(&scene);
}

static void test_blocks(struct test *t)
{
    blocks(t, "bdpt", 20, 6, 0);  /* four tiles */
    blocks(t, "lt", 20, 150, 150); /* the first tile holds more splats than wait for the end of its pass */
}

/* --- Russian roulette -------------------------------------------------------------------------------- */

/* Each integrator has its own default threshold, whatever parameters of other integrators are set; the user's wins. */
static void test_roulette_defaults(struct test *t)
{
    static const struct {
        const char *integrator, *select, *threshold, *as; /* threshold NULL: the default, which is to be `as` */
    } cases[] = {{"pt", "bins", NULL, "0.5"},     {"bdpt", "bins", NULL, "0.5"},   {"asbdpt", "vertices", NULL, "0.5"},
                 {"asbdpt", "bins", NULL, "0"},   {"bdpt", "bins", "0.5", "0.5"},  {"bdpt", "bins", "0", "0"},
                 {"asbdpt", "bins", "0.5", "0.5"}};
    char text[8192];
    snprintf(text, sizeof text, EVERYTHING, AREA, SPECULAR);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct scene scene;
        if (!scene_from_text(t, text, &scene))
            return;
        size_t bytes = (size_t)scene.width * (size_t)scene.height * 3 * sizeof(float);
        settings_set(&scene.settings, "select", cases[i].select, "test");
        if (cases[i].threshold != NULL)
            settings_set(&scene.settings, "rrthreshold", cases[i].threshold, "test");
        float *got = render_pixels(t, &scene, cases[i].integrator, 2, 7, 0, 4);
        settings_set(&scene.settings, "rrthreshold", cases[i].as, "test");
        float *same = render_pixels(t, &scene, cases[i].integrator, 2, 7, 0, 4);
        settings_set(&scene.settings, "rrthreshold", cases[i].as[1] == '\0' ? "0.5" : "0", "test");
        float *other = render_pixels(t, &scene, cases[i].integrator, 2, 7, 0, 4);
        CHECK(t, memcmp(got, same, bytes) == 0 && memcmp(got, other, bytes) != 0,
              "%s with select %s, rrthreshold %s: not as with %s", cases[i].integrator, cases[i].select,
              cases[i].threshold == NULL ? "not set" : cases[i].threshold, cases[i].as);
        free(got);
        free(same);
        free(other);
        scene_free(&scene);
    }
}

/* --- crop and filter --------------------------------------------------------------------------------- */

/* Means of the lower right quarter, once cut out of the full frame, once rendered as a crop window. */
static void test_crop(struct test *t, const char *integrator, int spp, uint64_t seed)
{
    char text[8192];
    struct scene scene;
    snprintf(text, sizeof text, EVERYTHING, AREA, "");
    if (!scene_from_text(t, text, &scene))
        return;
    struct batches full = render_batches(t, &scene, integrator, 3, spp, 12, 12, seed);
    scene.crop[0] = scene.crop[2] = 0.5;
    struct batches part = render_batches(t, &scene, integrator, 3, 3 * spp, 12, 12, seed + 2);
    for (int i = 0; i < full.n_batches; i++) /* keep only the last of the 2x2 tiles of the full frame */
        memmove(&full.value[3 * i], &full.value[12 * i + 9], 3 * sizeof full.value[0]);
    full.n = 3;
    double ratio, p = batches_p(&part, &full, &ratio);
    TEST_ACCEPT(t, p, "a crop window against the full frame, %s: ratio %.4f", integrator, ratio);
    batches_free(&full);
    batches_free(&part);
    scene_free(&scene);
}

/* A flat field (the camera in a furnace of directly seen light is constant) must stay flat up to the frame's edge under
 * every filter, and a scene's mean must not depend on the filter; t = 1 alone, as lt, is the severe case. */
static void test_filters(struct test *t)
{
    static const char flat[] =
        "LookAt 0 0 3  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 30\n"
        "Film \"image\" \"integer xresolution\" 12 \"integer yresolution\" 12 PixelFilter \"%s\"\n"
        "WorldBegin LightSource \"infinite\" \"rgb L\" [1 1 1] Material \"matte\" \"rgb Kd\" [.5 .5 .5]\n"
        "Shape \"disk\" \"float radius\" 1.5 WorldEnd\n";
    static const char *const names[] = {"box", "triangle", "gaussian", "mitchell", "sinc"};
    for (int i = 0; i < 5; i++) {
        char text[2048];
        struct scene scene;
        snprintf(text, sizeof text, flat, names[i]);
        if (!scene_from_text(t, text, &scene))
            return;
        /* A disk of albedo 1/2 under a sky of 1 has radiance 1/2, in every pixel: tiles of one pixel show edges. */
        struct batches b = render_batches(t, &scene, "lt", 1, 256, 16, 3, 41);
        struct batches expected = batches_new(b.n_batches, b.n, false);
        for (long k = 0; k < b.n * b.n_batches; k++)
            expected.value[k] = 0.5;
        double ratio, p = batches_p(&b, &expected, &ratio);
        TEST_ACCEPT(t, p, "flat field by light tracing under the %s filter: ratio %.4f", names[i], ratio);
        for (long k = 0; k < b.n * b.n_batches; k++)
            expected.value[k] = 0.5 * 1.25;
        TEST_REJECT(t, batches_p(&b, &expected, &ratio), "the same 20 %% too dark, %s filter", names[i]);
        batches_free(&b);
        batches_free(&expected);
        scene_free(&scene);
    }
}

void test_render(struct test *t)
{
    for (int i = 0; i < 2; i++) {
        test_known(t, &KNOWN[i], "pt");
        test_known(t, &KNOWN[i], "bdpt");
    }
    test_empty(t);
    test_agreement(t);
    test_thread_counts(t);
    test_blocks(t);
    test_roulette_defaults(t);
    test_crop(t, "bdpt", 16, 31);
    test_crop(t, "lt", 32, 32);
    test_filters(t);
}
