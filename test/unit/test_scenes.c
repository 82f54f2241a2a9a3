/* test_scenes.c: the scenes of scenes/test: known radiance, pairs of light kinds, all integrators. */
#define _POSIX_C_SOURCE 200809L

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "parser/parser.h"
#include "agree.h"
#include "helpers.h"
#include "suites.h"

/* p-value of "the expectation lies between low and high". */
static double within_p(const struct batches *b, double low, double high)
{
    double error, mean = batches_mean(b, &error);
    return mean >= low && mean <= high ? 1 : mean_p(b, mean < low ? low : high);
}

/* Expected radiance, as the comments of the scene files derive it; `low` to `high` where the depth limit cuts a little
 * off. */
static void test_analytic(struct test *t)
{
    static const struct {
        const char *name;
        double low, high;
        int spp;
    } cases[] = {
        {"furnace-sphere", 2 * (1 - 0.5 / 4096), 2 * (1 - 0.5 / 4096), 4},
        {"furnace-open", 0.998, 1, 2},
        {"disk-light", 0.4, 0.4, 16},
        {"two-sided-lamp", 0.25, 0.25, 16},
        {"lamp-in-lamp", 0.4, 0.4, 16},
        {"glass-sheets", 1.6 - 2e-6, 1.6, 32},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char path[256];
        struct scene scene;
        snprintf(path, sizeof path, "scenes/test/%s.pbrt", cases[i].name);
        if (!scene_from_file(t, path, 0, 0, &scene))
            continue;
        static const char *const methods[] = {"pt", "bdpt", "asbdpt"};
        for (int m = 0; m < 3; m++) {
            struct batches b = render_batches(t, &scene, methods[m], 0, cases[i].spp, 8, 64, 820 + (uint64_t)m);
            double error, mean = batches_mean(&b, &error);
            TEST_ACCEPT(t, within_p(&b, cases[i].low, cases[i].high), "%s by %s: %.5f +- %.5f, expected %.5f",
                        cases[i].name, methods[m], mean, error, cases[i].high);
            batches_scale(&b, 1.15);
            TEST_REJECT(t, within_p(&b, cases[i].low, cases[i].high), "%s by %s made 15 %% brighter", cases[i].name,
                        methods[m]);
            batches_free(&b);
        }
        scene_free(&scene);
    }
}

/* What all methods see in the first pixel, to the last digit; lt if the eye sees it directly. */
static void check_shown_by(struct test *t, const struct scene *scene, uint64_t seed, double expected, bool directly,
                           const char *what)
{
    static const char *const methods[] = {"pt", "bdpt", "asbdpt", "lt"};
    for (int m = 0; m < (directly ? 4 : 3); m++) {
        struct batches b = render_batches(t, scene, methods[m], directly ? 2 : 6, 4, 2, 4, seed);
        CHECK(t, fabs(b.value[0] - expected) < 1e-9, "%s: %s: %g, not %g", methods[m], what, b.value[0], expected);
        batches_free(&b);
    }
}

static void check_shown(struct test *t, const struct scene *scene, uint64_t seed, double expected, const char *what)
{
    check_shown_by(t, scene, seed, expected, true, what);
}

/* Two centimetres above a ground of 2000 km, flat or round, and twenty metres from the origin, something casts its
 * shadow; beside it the ground is lit and not in its own. */
static void test_contact(struct test *t)
{
    static const char *const grounds[] = {
        QUAD("-1e6 0 -1e6  1e6 0 -1e6  1e6 0 1e6  -1e6 0 1e6"),
        "AttributeBegin Translate 0 -1e6 0 Shape \"sphere\" \"float radius\" 1e6 AttributeEnd"};
    for (int i = 0; i < 4; i++) {
        struct scene scene;
        if (!scene_from_format(t, &scene,
                               "LookAt 20.1 .01 0  20.1 0 0  1 0 0 Camera \"perspective\" \"float fov\" 10\n"
                               "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4 WorldBegin\n"
                               "LightSource \"point\" \"point from\" [20 5 0] %s\n"
                               "Translate %d .02 0 Rotate 90 1 0 0 Shape \"disk\" \"float radius\" .5 WorldEnd\n",
                               grounds[i / 2], 20 + i % 2 * 5))
            continue;
        if (i % 2 == 0)
            check_shown(t, &scene, 835, 0, "the ground under a disk");
        struct batches b = render_batches(t, &scene, "pt", 1, 4, 2, 4, 836);
        double lit = i % 2 * 0.5 * INV_PI * 5 / pow(25.01, 1.5);
        CHECK(t, fabs(b.value[0] - lit) < 1e-5, "ground %d is lit with %g, not %g", i, b.value[0], lit);
        batches_free(&b);
        scene_free(&scene);
    }
}

/* A surface without material is not there. If it shines, the first on the way is seen, to the last digit, on each of
 * its sides that shines, but no light behind it: neither a lamp nor the sky. */
static void test_lamps(struct test *t)
{
    static const char text[] =
        "LookAt 0 0 %g  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 10\n"
        "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4 WorldBegin %s\n"
        "Material \"none\" Shape \"sphere\" Translate 0 0 .5 Shape \"disk\" \"float radius\" 2\n"
        "AreaLightSource \"diffuse\" \"rgb L\" [3 3 3] Shape \"disk\" \"float radius\" 2\n"
        "AreaLightSource \"diffuse\" \"rgb L\" [.5 .5 .5] \"bool twosided\" \"true\" Translate 0 0 -1\n"
        QUAD("-2 -2 0  2 -2 0  2 2 0  -2 2 0") "WorldEnd\n";
    static const char sky[] = "LightSource \"infinite\" \"rgb L\" [.25 .25 .25]";
    static const char wall[] = "Material \"matte\" \"rgb Kd\" [0 0 0] Shape \"disk\" \"float radius\" 9";
    static const char touching[] =
        "Material \"matte\" \"rgb Kd\" [0 0 0] Shape \"disk\" \"float radius\" 9 \"float height\" -.5";
    static const struct {
        double z;
        const char *behind;
        double expected;
    } cases[] = {{5, "", 3},    {-5, "", .5},   {.2, "", .5},  {-.2, "", 0},     {5, sky, 3},     {-5, sky, .5},
                 {-.2, sky, 0}, {5, wall, 3},   {-5, wall, .5}, {.2, wall, 0},    {.2, touching, .5}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char filled[1024];
        struct scene scene;
        snprintf(filled, sizeof filled, text, cases[i].z, cases[i].behind);
        if (!scene_from_text(t, filled, &scene))
            continue;
        check_shown(t, &scene, 830, cases[i].expected, filled);
        scene_free(&scene);
    }
}

/* Lights one behind the other, drawn at random: see-through or black behind, hidden or not, of one side or two, and panes
 * that bend nothing. Of each piece of the eye's way that panes cut, the first see-through light counts, else what is at
 * its end; before the first pane those that are hidden do not. */
static void test_stack(struct test *t, struct rng *r, int number)
{
    static const char *const KIND[] = {"Material \"none\"", "Material \"none\"", "Material \"matte\" \"rgb Kd\" [0 0 0]",
                                       "Material \"glass\" \"float eta\" 1"};
    enum { PANE = 3, LAYERS = 5 };
    char text[4096];
    double expected = 0, shown = 0;
    bool pane = false, lamp = false, open = true;
    bool sky = rng_uniform(r) < 0.6, sky_hidden = rng_uniform(r) < 0.4;
    int used = snprintf(text, sizeof text, "LookAt 0 0 9  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 10\n"
                        "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4 WorldBegin %s%s\n",
                        !sky ? "" : "LightSource \"infinite\" \"rgb L\" [.25 .25 .25]",
                        sky && sky_hidden ? " \"bool visible\" \"false\"" : "");
    for (int i = 0; i < LAYERS; i++) {
        int kind = (int)(4 * rng_uniform(r));
        bool two_sided = rng_uniform(r) < 0.5, back = rng_uniform(r) < 0.5, hidden = rng_uniform(r) < 0.5;
        double L = (back && !two_sided) || (hidden && !pane) ? 0 : i + 1;
        used += snprintf(text + used, sizeof text - (size_t)used, "AttributeBegin %s Translate 0 0 %d ", KIND[kind], -i);
        if (kind != PANE)
            used += snprintf(text + used, sizeof text - (size_t)used, "Rotate %d 1 0 0 AreaLightSource \"diffuse\" "
                             "\"rgb L\" [%d %d %d] \"bool twosided\" \"%s\" \"bool visible\" \"%s\" ", back ? 180 : 0, i + 1,
                             i + 1, i + 1, two_sided ? "true" : "false", hidden ? "false" : "true");
        used += snprintf(text + used, sizeof text - (size_t)used, "Shape \"disk\" \"float radius\" 9 AttributeEnd\n");
        if (!open || (kind < 2 && (lamp || (hidden && !pane))))
            continue;
        shown = kind == PANE || lamp ? shown : L;
        lamp = kind < 2;
        if (kind >= 2) {
            expected += shown;
            shown = 0;
            lamp = false;
            pane |= kind == PANE;
            open = kind == PANE;
        }
    }
    expected += !open ? 0 : lamp ? shown : sky && (pane || !sky_hidden) ? 0.25 : 0;
    struct scene scene;
    snprintf(text + used, sizeof text - (size_t)used, "WorldEnd\n");
    if (!scene_from_text(t, text, &scene))
        return;
    check_shown_by(t, &scene, 840 + (uint64_t)number, expected, !pane, text);
    scene_free(&scene);
}

static void test_stacks(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 5, 0);
    for (int i = 0; i < 100; i++)
        test_stack(t, &r, i);
}

/* Alpha 0 is a hole, to the eye and to light, and so is shadowalpha 0; any other alpha is solid, as in pbrt. */
static void test_holes(struct test *t)
{
    static const char text[] =
        "LookAt 0 0 -4  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 10\n"
        "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4 WorldBegin\n"
        "Texture \"a\" \"float\" \"checkerboard\" \"float tex1\" %s \"float tex2\" %s\n"
        "LightSource \"point\" \"point from\" [0 0 -3] \"rgb I\" [9 9 9]\n"
        "Material \"matte\" \"rgb Kd\" [1 1 1] " QUAD("-3 -3 0  3 -3 0  3 3 0  -3 3 0")
        "Material \"matte\" \"rgb Kd\" [0 0 0] "
        QUAD("-3 -3 %s  3 -3 %s  3 3 %s  -3 3 %s") "\"texture %s\" \"a\" WorldEnd\n";
    static const struct {
        const char *value, *z, *name;
        bool lit;
    } cases[] = {{"0", "-1", "alpha", true},  {"0.5", "-1", "alpha", false}, {"1", "-1", "alpha", false},
                 {"0", "-1", "shadowalpha", true}, {"1", "-1", "shadowalpha", false}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct scene scene;
        const char *z = cases[i].z;
        if (!scene_from_format(t, &scene, text, cases[i].value, cases[i].value, z, z, z, z, cases[i].name))
            continue;
        struct batches b = render_batches(t, &scene, "bdpt", 2, 4, 2, 4, 829);
        CHECK(t, (b.value[0] > 0.1) == cases[i].lit, "behind %s %s the wall shows %g", cases[i].name, cases[i].value,
              b.value[0]);
        batches_free(&b);
        scene_free(&scene);
    }
}

/* Partial derivatives are there where a material may read them, and left out elsewhere: a row of triangles along x,
 * with and without vertex normals. */
static void test_partials(struct test *t)
{
    static const char start[] =
        "Camera \"perspective\" WorldBegin Texture \"b\" \"float\" \"constant\" \"float value\" 1\n"
        "MakeNamedMaterial \"m\" \"string type\" \"matte\" MakeNamedMaterial \"n\" \"string type\" \"matte\"\n";
    static const struct {
        const char *material;
        bool read;
    } cases[] = {
        {"\"matte\"", false},
        {"\"matte\" \"texture bumpmap\" \"b\"", true},
        {"\"plastic\" \"float roughness\" 0.2", false},
        {"\"metal\" \"float uroughness\" 0.1 \"float vroughness\" 0.3", true},
        {"\"glass\" \"float uroughness\" 0.2 \"float vroughness\" 0.2", false},
        {"\"glass\" \"float uroughness\" 0.2 \"texture vroughness\" \"b\"", true},
        {"\"mix\" \"string namedmaterial1\" \"m\" \"string namedmaterial2\" \"n\"", true},
    };
    enum { N = sizeof cases / sizeof cases[0] };
    char text[8192];
    int used = snprintf(text, sizeof text, "%s", start);
    for (int i = 0; i < 2 * N; i++)
        used += snprintf(
            text + used, sizeof text - (size_t)used,
            "Material %s Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [%d 0 0  %d 0 0  %d 1 0]%s\n",
            cases[i % N].material, 2 * i, 2 * i + 1, 2 * i, i < N ? "" : " \"normal N\" [0 0 1  0.1 0 1  0 0.1 1]");
    snprintf(text + used, sizeof text - (size_t)used, "WorldEnd");
    struct scene scene;
    if (!scene_from_text(t, text, &scene))
        return;
    for (int i = 0; i < 2 * N; i++) {
        struct ray ray = {vec(2 * i + 0.25, 0.25, 1), vec(0, 0, -1), 0, INFINITY, 0, 0};
        struct surface at = {.u = 0};
        bool read = cases[i % N].read;
        if (!CHECK(t, scene_intersect(&scene, &ray, &at), "triangle %d is there", i))
            continue;
        CHECK(t, read == (length(at.dpdu) > 0.5 && length(at.dpdv) > 0.5), "%s: partials %g %g", cases[i % N].material,
              length(at.dpdu), length(at.dpdv));
        CHECK(t, (read && i >= N) == (length(at.dndu) > 0), "%s: change of normal %g", cases[i % N].material,
              length(at.dndu));
    }
    scene_free(&scene);
}

/* A spot of light two pixels wide through filters with negative parts: eye paths draw from the filter and carry its
 * weight, light paths are spread by it; pixel by pixel they agree. (At an edge a pixel's mean would count a few
 * samples: batches that count alike seem to have no variance, and Welch's test raises false alarms.) */
static void test_filter_spot(struct test *t)
{
    static const char text[] =
        "LookAt 0 0 -4  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 20\n"
        "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8 PixelFilter \"%s\"\n"
        "WorldBegin LightSource \"point\" \"point from\" [.03 .05 -.25] \"rgb I\" [.1 .1 .1]\n"
        "Material \"matte\" \"rgb Kd\" [.8 .8 .8] " QUAD("-3 -3 0  3 -3 0  3 3 0  -3 3 0") "WorldEnd\n";
    static const char *const filters[] = {"mitchell", "sinc"};
    for (int i = 0; i < 2; i++) {
        struct scene scene;
        if (!scene_from_format(t, &scene, text, filters[i]))
            continue;
        double ratio;
        struct batches pt = render_batches(t, &scene, "pt", 1, 64, 16, 1, 826);
        struct batches lt = render_batches(t, &scene, "lt", 1, 96, 16, 1, 827);
        double p = batches_p(&pt, &lt, &ratio);
        TEST_ACCEPT(t, p, "a spot through the %s filter: pt against lt, ratio %.4f", filters[i], ratio);
        scene.filter = filter_of("triangle");
        struct batches other = render_batches(t, &scene, "pt", 1, 64, 16, 1, 828);
        TEST_REJECT(t, batches_p(&other, &lt, &ratio), "a spot through the triangle instead of the %s filter",
                    filters[i]);
        batches_free(&pt);
        batches_free(&lt);
        batches_free(&other);
        scene_free(&scene);
    }
}

/* Two kinds of light in one room: the density with which a light is chosen is where integrators differ. Every second
 * pair has all kinds. */
static void test_light_pairs(struct test *t, int spp, size_t step)
{
    static const char *const pairs[] = {"area-infinite", "area-point",     "distant-area", "distant-infinite",
                                        "distant-point", "point-infinite", "spot-area",    "spot-distant",
                                        "spot-infinite", "spot-point"};
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i += step) {
        char name[64];
        snprintf(name, sizeof name, "scenes/test/light-%s", pairs[i]);
        const struct agreement a = {name, 16, 16, 4, "pt", "bdpt, asbdpt", 2 * spp, spp, 12, 8, false, 0.2};
        check_agreements(t, &a, 1, 1);
    }
}

/* A scene by four integrators: were a strategy lost in one of them, their weights would no longer add up to 1 for
 * all. */
static void test_four(struct test *t, const char *name, int spp)
{
    const struct agreement a = {name, 24, 24, 4, "pt", "lt, bdpt, asbdpt", 2 * spp, spp, 12, 12, false, 0.05};
    check_agreements(t, &a, 1, 1);
}

void test_scenes(struct test *t)
{
    test_analytic(t);
    test_contact(t);
    test_lamps(t);
    test_stacks(t);
    test_holes(t);
    test_partials(t);
    test_filter_spot(t);
    test_light_pairs(t, 4, 2);
    test_four(t, "scenes/test/pass-through", 16); /* see-through lamps, one of them around a ball */
}

/* Other cameras, too, which test_strategies.c has for the quick suite. */
void test_scenes_long(struct test *t)
{
    test_light_pairs(t, 200, 1);
    test_four(t, "scenes/test/pass-through", 400);
    test_four(t, "scenes/test/orthographic", 400);
    test_four(t, "scenes/test/environment", 400);
}

/* --- the suite features --------------------------------------------------------------------------------------- */

static const char FEATURES[] = "scenes/features";
enum { MAX_SCENES = 200, NAME = 64, TEXT = 512, SIZE = 12, SPP = 4, BATCHES = 10, TILE = 6 };

/* What a scene's warnings are compared with. */
struct expected {
    struct test *test;
    const char *name;
    FILE *file; /* the scene, before its next "# warn: " */
};

/* The rest of the next line "# warn: ..." of the comment at the head; false if there is none. */
static bool next_warning(FILE *f, char text[TEXT])
{
    char line[TEXT];
    while (f != NULL && fgets(line, sizeof line, f) != NULL && line[0] == '#')
        if (strncmp(line, "# warn: ", 8) == 0) {
            line[strcspn(line, "\n")] = '\0';
            strcpy(text, line + 8);
            return true;
        }
    return false;
}

static void hear(void *context, bool is_error, const char *text)
{
    struct expected *e = context;
    char wanted[TEXT];
    bool any = !is_error && next_warning(e->file, wanted);
    CHECK(e->test, any && strstr(text, wanted) != NULL, "%s: warned \"%s\", expected \"%s\"", e->name, text,
          any ? wanted : "nothing");
}

static bool load(struct test *t, const char *name, struct scene *scene)
{
    char path[TEXT], listed[TEXT], missed[TEXT];
    struct error err = {.text = ""};
    snprintf(path, sizeof path, "%s/%s", FEATURES, name);
    struct expected expected = {t, name, fopen(scene_path(t, path, listed), "r")};
    struct message_sink sink = {hear, &expected};
    bool ok = CHECK(t, parse_scene(scene_path(t, path, listed), NULL, scene, &sink, &err), "%s", err.text);
    CHECK(t, !next_warning(expected.file, missed), "%s: no warning \"%s\"", name, missed);
    if (expected.file != NULL)
        fclose(expected.file);
    if (!ok)
        return false;
    CHECK(t, scene->integrator != NULL && scene->film_filename != NULL, "%s: no integrator or no file name", name);
    scene->width = scene->height = SIZE;
    scene_prepare(scene);
    return true;
}

static void check_scene(struct test *t, const char *name, int number)
{
    struct scene scene;
    double error;
    if (!load(t, name, &scene))
        return;
    uint64_t seed = 2000 + 2 * (uint64_t)number;
    struct batches pt = render_batches(t, &scene, "pt", 0, 2 * SPP, BATCHES, TILE, seed);
    struct batches bdpt = render_batches(t, &scene, "bdpt", 0, SPP, BATCHES, TILE, seed + 1);
    CHECK(t, batches_mean(&pt, &error) > 0.01, "%s is black", name);
    check_agree(t, &bdpt, &pt, false, 1, "%s: bdpt against pt", name);
    batches_free(&pt);
    scene_free(&scene);
}

static int by_name(const void *a, const void *b) { return strcmp(a, b); }

/* features: the scenes of scenes/features, one for each element of the scene format.
 *
 * Each is loaded, must give the warnings of its "# warn: " lines and no others, and is rendered by path tracing and by
 * BDPT, which must agree and not be black.
 */
void test_features(struct test *t)
{
    static char name[MAX_SCENES][NAME];
    char directory[TEXT] = "";
    int n = 0;
    if (scene_path(t, "scenes/features/stage.inc", directory) == directory)
        *strrchr(directory, '/') = '\0'; /* where the lists lie as files */
    DIR *d = opendir(directory);
    for (struct dirent *e = d != NULL ? readdir(d) : NULL; e != NULL; e = readdir(d)) {
        size_t length = strlen(e->d_name);
        if (length > 5 && length < NAME && strcmp(e->d_name + length - 5, ".pbrt") == 0 && n < MAX_SCENES)
            strcpy(name[n++], e->d_name);
    }
    if (d != NULL)
        closedir(d);
    CHECK(t, n >= 40, "only %d scenes in %s: run the tests at the top of the tree", n, FEATURES);
    qsort(name, (size_t)n, NAME, by_name);
    for (int i = 0; i < n; i++)
        check_scene(t, name[i], i);
}
