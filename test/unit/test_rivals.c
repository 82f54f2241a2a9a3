/* test_rivals.c: other methods of choosing what to connect (test/lab/rivals): each has the expectation of path
 * tracing. Pools of one, two and four light sub-paths are tested too, where a fault of 1/K is as large as what is
 * measured. Where a method must equal another one, it does. test_asbdpt.c has lvc and cbdpt. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "agree.h"
#include "helpers.h"
#include "suites.h"

/* --- expectation ------------------------------------------------------------------------------------- */

/* A slope beside the wall that lights it, and behind a low fence, from above: what comes from there, and the density of
 * what is taken over, differs by more than ten from the first to the last of the pixels, and they are all alike. */
static const char SLOPE[] =
    "LookAt .5 10 0  .5 0 0  0 0 1 Camera \"perspective\" \"float fov\" .72\n"
    "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 1 PixelFilter \"box\" WorldBegin\n"
    "LightSource \"spot\" \"point from\" [1 1.6 0] \"point to\" [0 .1 0] \"rgb I\" [9 9 9]\n"
    "\"float coneangle\" 15 Material \"matte\" \"rgb Kd\" [.6 .6 .6]\n"
    QUAD(".5 .5 -2  .5 .5 2  .5 .6 2  .5 .6 -2")
    QUAD("0 0 -2  0 0 2  2 2 2  2 2 -2")
    "Material \"uber\" \"rgb Kd\" [.5 .5 .5] \"rgb Kr\" [.4 .4 .4] \"rgb Ks\" [0 0 0]\n"
    QUAD("0 0 -2  0 0 2  0 1 2  0 1 -2") "WorldEnd\n";

/* A floor that scatters and mirrors, a wall, and a lamp as large as both, which s = 0 and s = 1 find alike. A guide
 * that has learnt where the lamp is draws other directions than the BSDF. */
static const char LAMP[] =
    "LookAt 0 -2 1.8  0 -.4 0  0 0 1 Camera \"perspective\" \"float fov\" 40\n"
    "Film \"image\" \"integer xresolution\" 32 \"integer yresolution\" 32 PixelFilter \"box\" WorldBegin\n"
    "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] Shape \"trianglemesh\"\n"
    "\"integer indices\" [0 1 2 0 2 3] \"point P\" [-1 -1 1.2  -1 1 1.2  1 1 1.2  1 -1 1.2] AttributeEnd\n"
    "Material \"uber\" \"rgb Kd\" [.5 .5 .5] \"rgb Kr\" [.4 .4 .4] \"rgb Ks\" [0 0 0]\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-1 -1 0  1 -1 0  1 1 0  -1 1 0]\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-1 1 0  1 1 0  1 1 1  -1 1 1]\n"
    "WorldEnd\n";

/* Two rooms, where connections matter most, as one tile of 3x3 pixels, with one, two and four or five light sub-paths;
 * a third of the pixels have records. Every kind of scene; paths that pt does not make, of delta lights behind specular
 * surfaces, those that share its eye sub-paths do not. */
#define EVERY                                                                                                          \
    "mbdpt, mbdpt matrix=pixel pathpixels=1, pcbdpt connections=2, ris, ris subpaths=20 records=.01,"                  \
    "ris2 presampled=20 records=.01, spcbpt,"                                                                          \
    "spcbpt guide=on, restir neighbours=20"
#define SHARED "restirgi guide=on, restirgi neighbours=20, ppg cell=100 combine=off"
static const struct agreement EXPECTATIONS[] = {
    {"doc/mini/rooms", 3, 3, 4, "bdpt",
     "mbdpt pathpixels=9, mbdpt pathpixels=5 key=throughput, mbdpt matrix=pixel key=throughput,"
     "lvc connections=0, pcbdpt records=.3 subpaths=1,"
     "pcbdpt records=.3 subpaths=4 connections=2, ris records=.3 subpaths=1, ris records=.3 subpaths=2,"
     "ris records=.3 subpaths=4, ris2 records=.3 presampled=2 subpaths=2, spcbpt pathpixels=9,"
     "spcbpt pathpixels=5 subspaces=3 connections=1, spcbpt pathpixels=2 guide=on emission=.2,"
     "restir candidates=1 neighbours=2,"
     "restir candidates=4 neighbours=8, restirgi neighbours=8", 64, 64, 16, 1, true, 0.2},
    {"scenes/test/light-kinds", 16, 16, 4, "bdpt", EVERY, 2, 2, 12, 8, true, 0.1},
    {"scenes/test/mirror-glass", 16, 16, 4, "bdpt", EVERY, 2, 2, 12, 8, true, 0.1},
    {"scenes/test/all-materials", 16, 16, 4, "bdpt", EVERY, 2, 2, 12, 8, true, 0.1},
    {"scenes/test/light-kinds", 24, 24, 4, "pt", SHARED, 2, 2, 12, 12, true, 0.2},
    {"scenes/test/light-area-infinite", 12, 12, 3, "pt", "restirgi guide=on", 48, 48, 12, 12, true, 0.2},
    {"scenes/test/mirror-glass", 24, 24, 4, "pt", SHARED, 8, 8, 12, 12, true, 0.2},
    {"scenes/test/all-materials", 24, 24, 4, "pt", SHARED, 2, 2, 12, 12, true, 0.2},
    {SLOPE, 0, 0, 4, "pt", "restirgi neighbours=8", 512, 512, 16, 1, false, 0.1},
    {LAMP, 0, 0, 4, "pt", "ppg cell=50, ppg cell=1000", 8, 8, 16, 32, false, 0.15}};
enum { N_EXPECTATIONS = sizeof EXPECTATIONS / sizeof EXPECTATIONS[0] };

/* All methods that can have credits, with all services that they can have (lab/methods.h), and with each alone. */
static void test_services(struct test *t, int more)
{
    static const char *const alone[] = {"credits=on", "bound=on", "later=1", "lightpoints=2", "guide=on"};
    static char all[METHODS_TEXT], ways[METHODS_TEXT];
    const struct agreement agreements[] = {
        {"doc/mini/rooms", 6, 6, 4, "bdpt", ways, 16, 8, 16, 6, true, 0.2},
        {"scenes/test/light-kinds", 16, 16, 4, "bdpt", ways, 2, 2, 16, 16, true, 0.1}};
    struct methods served;
    struct error err = {.text = ""};
    int n = 0, rows = 0;
    methods_all(all);
    if (!CHECK(t, methods_add_halves(all, 1u << HALF_SERVICES, &served, &err), "%s", err.text))
        return;
    for (const struct measured *m = served.item; m < served.item + served.n; m++) {
        struct settings s = measured_settings(m, NULL);
        const struct method *row = method_find(m->integrator, &s, NULL);
        settings_clear(&s);
        if (method_has(row, "credits") == NULL)
            continue;
        rows++;
        n += snprintf(ways + n, sizeof ways - (size_t)n, n > 0 ? ",%s" : "%s", m->text);
        for (size_t k = 0; k < sizeof alone / sizeof alone[0]; k++) {
            char name[16];
            snprintf(name, sizeof name, "%.*s", (int)strcspn(alone[k], "="), alone[k]);
            if (method_has(row, name) != NULL)
                n += snprintf(ways + n, sizeof ways - (size_t)n, ",%s %s", method_name(row), alone[k]);
        }
    }
    for (char *c = ways; *c != '\0'; c++)
        *c = *c == ':' ? ' ' : *c;
    CHECK(t, rows >= 10, "%d methods have credits", rows);
    check_agreements(t, agreements, 2, more);
}

/* In three pixels, where sub-paths of a rank would meet too often if the lattice were not shifted at random. */
static const struct agreement THREE_PIXELS = {"doc/mini/rooms", 3, 1, 4, "bdpt", "mbdpt pathpixels=1",
                                              1024, 1024, 32, 3, true, 0};

/* The two rooms with pools of a hundred light vertices, in which records differ. */
static const struct agreement ROOMS = {
    "doc/mini/rooms", 16, 16, 4, "bdpt",
    "pcbdpt records=.02, ris records=.02 subpaths=30, ris2 records=.02 presampled=30, spcbpt, restir neighbours=20,"
    "restirgi neighbours=20, ppg cell=300 combine=off", 8, 8, 16, 8, true, 0};

/* The bias of pathgraph falls with the radius: it is seen where vertices share across half a room, and not with the
 * same samples where they share nearby. */
static void test_bias(struct test *t, int more)
{
    struct scene scene;
    if (!scene_from_file(t, "doc/mini/rooms.pbrt", 16, 16, &scene))
        return;
    struct batches pt = render_batches(t, &scene, "pt", 4, 48 * more, 16, 4, 211);
    struct batches near = render_batches(t, &scene, set_method(&scene, "pathgraph radius=.1"), 4, 48 * more, 16, 4,
                                         212);
    struct batches far = render_batches(t, &scene, set_method(&scene, "pathgraph radius=.5 cluster=64"), 4, 48 * more,
                                        16, 4, 212);
    check_agree(t, &near, &pt, false, 0, "rooms: pathgraph radius=.1 against pt");
    double ratio, p = batches_p(&far, &pt, &ratio);
    TEST_REJECT(t, p, "pathgraph shares across the room, ratio %.4f", ratio);
    batches_free(&far);
    batches_free(&pt);
    scene_free(&scene);
}

/* Under an even sky all that is white shines like it: nothing is wrong with a neighbour's light. White ends no walk but
 * by a threshold of roulette above 1. */
static const char CORNER[] =
    "LookAt 1 2 3  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 20\n"
    "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 16 WorldBegin\n"
    "LightSource \"infinite\" \"rgb L\" [1 1 1] Material \"matte\" \"rgb Kd\" [1 1 1]\n"
    QUAD("-4 0 0  4 0 0  4 0 4  -4 0 4")
    QUAD("-4 0 0  4 0 0  4 4 0  -4 4 0") "WorldEnd\n";

/* In a sphere that shines every point receives the same: merging moves nothing. */
static const char SHINING[] =
    "LookAt 0 0 0  0 0 1  0 1 0 Camera \"perspective\" \"float fov\" 60\n"
    "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 16 PixelFilter \"box\" WorldBegin\n"
    "Material \"matte\" \"rgb Kd\" [.5 .5 .5] AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\n"
    "ReverseOrientation Shape \"sphere\" \"float radius\" 1 WorldEnd\n";

static void test_furnace(struct test *t, int more)
{
    static const struct {
        const char *text, *way;
        int depth;
        double light;
    } cases[] = {{CORNER, "pathgraph radius=1 cluster=64 iterations=0", 30, 1},
                 {CORNER, "pathgraph radius=.1 iterations=20", 30, 1},
                 {CORNER, "restirgi neighbours=20 rrthreshold=1.5", 30, 1},
                 {SHINING, "vcm radius=.05 alpha=1", 5, 2 - 1 / 32.0}}; /* 1 + 1/2 + ... */
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        struct scene scene;
        if (!scene_from_text(t, cases[k].text, &scene))
            return;
        const char *integrator = set_method(&scene, cases[k].way);
        struct batches b = render_batches(t, &scene, integrator, cases[k].depth, 40 * more, 16, 16, 221);
        double error, mean = batches_mean(&b, &error);
        TEST_ACCEPT(t, mean_p(&b, cases[k].light), "furnace by %s: %.5f +- %.5f", cases[k].way, mean, error);
        batches_scale(&b, 1.01);
        TEST_REJECT(t, mean_p(&b, cases[k].light), "furnace by %s made 1 %% brighter", cases[k].way);
        batches_free(&b);
        scene_free(&scene);
    }
}

/* --- limits ------------------------------------------------------------------------------------------ */

enum { SIDE = 16 };

static void render_image(struct test *t, struct scene *scene, const char *method, int depth, float *image)
{
    struct render_job o = {.integrator = set_row(scene, method), .end = 4, .n_threads = 2, .max_depth = depth};
    render_pixels(t, scene, &o, image);
}

/* Largest difference of two methods, relative. */
static double differ(struct test *t, struct scene *scene, const char *a, const char *b, int depth)
{
    static float x[SIDE * SIDE * 3], y[SIDE * SIDE * 3];
    double worst = 0;
    render_image(t, scene, a, depth, x);
    render_image(t, scene, b, depth, y);
    for (int i = 0; i < scene->width * scene->height * 3; i++)
        worst = fmax(worst, fabs((double)x[i] - (double)y[i]) / (fabs((double)x[i]) + 1e-6));
    return worst;
}

/* A light in a closed white ball. */
static const char WHITE[] =
    "Camera \"perspective\" Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 16\n"
    "WorldBegin LightSource \"point\" Material \"matte\" \"rgb Kd\" [1 1 1] Shape \"sphere\" \"float radius\" 2\n"
    "WorldEnd\n";

/* Where one method is another: with the same random numbers they make the same picture, up to `bound`: where the same
 * sums are added in another order that is not to the byte. Beside each stands one that is near, and is not. */
static void test_limits(struct test *t)
{
    static const struct {
        const char *scene;
        int side, depth;
        const char *a, *b, *other;
        double bound;
    } cases[] = {
        {"light-kinds", 1, 4, "mbdpt pathpixels=1", "bdpt guide=off", "cbdpt connections=2", 0},
        {"mirror-glass", SIDE, 4, "restir candidates=1 neighbours=0 worth=1", "bdpt guide=off",
         "restir candidates=1 neighbours=9 worth=1", 1e-6},
        {"light-kinds", SIDE, 4, "restir candidates=1 neighbours=0 worth=1", "bdpt guide=off",
         "restir candidates=2 neighbours=0 worth=1", 1e-6},
        /* without records the choice is uniform; where light sub-paths have two vertices, two draws count like one */
        {"white", SIDE, 2, "pcbdpt records=0 connections=2 subpaths=256", "lvc connections=2",
         "pcbdpt records=.1 connections=2 subpaths=256", 0},
        {"all-materials", SIDE, 4, "ris weights=counts records=.02 subpaths=200",
         "pcbdpt normals=0 records=.02 connections=1", "pcbdpt records=.02 connections=1", 0},
        /* of one light sub-path every draw counts like one: the arrays of the path give what the recursion does */
        {"light-kinds", SIDE, 4, "ris records=0 subpaths=1", "pcbdpt records=0 subpaths=1",
         "ris records=0 subpaths=2", 1e-5},
        {"light-kinds", SIDE, 4, "ris records=0 subpaths=1 credits=on guide=on lightpoints=2",
         "pcbdpt records=0 subpaths=1 credits=on guide=on lightpoints=2", "ris records=0 subpaths=1 credits=on", 1e-5},
        {"mirror-glass", SIDE, 4, "ris records=0 subpaths=1", "pcbdpt records=0 subpaths=1",
         "ris records=.1 subpaths=1", 1e-5},
        {"all-materials", SIDE, 4, "ris records=0 subpaths=1", "pcbdpt records=0 subpaths=1",
         "ris records=0 subpaths=100", 1e-5},
        /* in one subspace there is nothing to learn; where all L are equal, draws are uniform */
        {"light-kinds", SIDE, 4, "spcbpt subspaces=1 steps=9", "spcbpt subspaces=1 steps=0",
         "spcbpt subspaces=4 steps=9", 0},
        {"all-materials", SIDE, 4, "spcbpt delta=1 steps=9", "spcbpt delta=1 steps=0", "spcbpt delta=.5 steps=0", 1e-9},
        {"white", SIDE, 2, "spcbpt subspaces=1", "lvc connections=3", "spcbpt subspaces=1 connections=1", 0.01},
        {"all-materials", SIDE, 4, "vcm radius=1e-7", "bdpt guide=off", "vcm radius=.6 alpha=1", 1e-6},
        {"mirror-glass", SIDE, 4, "restirgi neighbours=0", "pt guide=off", "restirgi neighbours=5", 0},
        {"light-kinds", SIDE, 4, "vcm radius=1e-7 guide=on", "bdpt", "vcm radius=1e-7", 1e-6},
        {"light-kinds", SIDE, 4, "restirgi neighbours=0 guide=on", "pt", "restirgi neighbours=0", 0},
        {"mirror-glass", SIDE, 4, "ppg training=0", "pt guide=off", "ppg training=1", 0},
        {"mirror-glass", SIDE, 4, "pathgraph cluster=1", "pt guide=off", "pathgraph cluster=2", 1e-6},
        {"all-materials", SIDE, 4, "pathgraph cluster=1", "pt guide=off", "pathgraph radius=.2", 1e-6},
        {"white", SIDE, 4, "pathgraph radius=.1 iterations=0", "pt", "pathgraph radius=1", 0.1}, /* light is even */
        {"white", SIDE, 4, "pathgraph radius=.02", "pt guide=off", "pathgraph radius=1", 0.1},
        {"all-materials", SIDE, 4, "pathgraph iterations=4", "pathgraph", "pathgraph iterations=3", 0},
        {"all-materials", SIDE, 4, "pathgraph cluster=1", "pathgraph cluster=1 iterations=0", "pathgraph", 1e-6},
        {"light-kinds", SIDE, 6, "pathgraph cluster=1", "pt guide=off", "pathgraph radius=.2", 1e-6},
        {"all-materials", SIDE, 4, "pathgraph radius=1e-6", "pt guide=off", "pathgraph radius=.2", 1e-6},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char path[256];
        struct scene scene;
        snprintf(path, sizeof path, "scenes/test/%s.pbrt", cases[i].scene);
        if (!(strcmp(cases[i].scene, "white") == 0 ? scene_from_text(t, WHITE, &scene)
                                                    : scene_from_file(t, path, cases[i].side, cases[i].side, &scene)))
            continue;
        double same = differ(t, &scene, cases[i].a, cases[i].b, cases[i].depth);
        double other = differ(t, &scene, cases[i].other, cases[i].b, cases[i].depth);
        CHECK(t, same <= cases[i].bound, "%s: %s is not %s: %g", cases[i].scene, cases[i].a, cases[i].b, same);
        CHECK(t, other > 1e-3, "%s: %s is %s: %g", cases[i].scene, cases[i].other, cases[i].b, other);
        scene_free(&scene);
    }
}

void test_rivals_long(struct test *t)
{
    check_agreements(t, EXPECTATIONS, N_EXPECTATIONS, 8);
    test_services(t, 8);
    test_furnace(t, 8);
    check_agreements(t, &ROOMS, 1, 8);
    test_bias(t, 8);
}

void test_rivals(struct test *t)
{
    check_agreements(t, EXPECTATIONS, N_EXPECTATIONS, 1);
    test_services(t, 1);
    test_furnace(t, 1);
    check_agreements(t, &THREE_PIXELS, 1, 1);
    test_limits(t);
}

/* --- the suite family ----------------------------------------------------------------------------------------- */

enum { BATCHES = 16, DEPTH = 5, WIDTH = 8, TILE = 4 };

/* Of seeds of their own. */
static struct batches by(struct test *t, struct scene *scene, const char *way, long spp)
{
    uint64_t seed = test_seed(t) + (strcmp(way, "pt") != 0);
    return independent_batches(t, scene, set_method(scene, way), DEPTH, spp, BATCHES, TILE, seed);
}

/* Are they the same, as far as they can be told apart? */
static void compare(struct test *t, const char *what, const char *way, const struct batches *b,
                    const struct batches *pt, double error)
{
    struct verdict v = verify_batches(b, pt, test_seed(t));
    char text[256];
    snprintf(text, sizeof text, "%s: %s, %.5f +- %.5f of pt; mean, p = %.2g; tiles, p = %.2g", what, way, v.ratio,
             v.ratio_error, v.mean, v.smallest);
    if (strstr(way, "bins") != NULL) {
        TEST_REJECT(t, v.p, "%s", text);
        return;
    }
    CHECK(t, v.ratio_error < error, "%s: too few samples", text);
    TEST_ACCEPT(t, v.p, "%s", text);
}

/* So many samples of pt, of bins (none under the sky, where they are off by less than can be seen here), of the others,
 * of chains, and independent states of these: as many as it takes. */
static const struct {
    const char *path;
    long pt, bins, spp, chains, states;
} SCENES[] = {{"doc/mini/rooms.pbrt", 4096, 2048, 2048, 8192, 1 << 20},
              {"scenes/cornell-box.pbrt", 512, 1024, 1024, 1024, 1 << 17},
              {"scenes/forest.pbrt", 1024, 2048, 256, 4096, 1 << 19},
              {"scenes/sky.pbrt", 256, 0, 256, 256, 1 << 18},
              {"scenes/test/light-kinds.pbrt", 256, 256, 256, 512, 1 << 17},
              {"scenes/test/all-materials.pbrt", 512, 256, 320, 640, 1 << 20}};

static void test_six_scenes(struct test *t)
{
    static const char *const ways[] = {"lvc", "cbdpt", "mbdpt", "pcbdpt", "ris", "ris2", "spcbpt", "restir", "restirgi",
                                       "ppg",
                                       "asbdpt select=pool", "asbdpt select=vertices", "asbdpt select=subspaces",
                                       "asbdpt select=bins"};
    static const char *const chains[] = {"pssmlt", "mmlt", "mlt"};
    for (size_t i = 0; i < sizeof SCENES / sizeof SCENES[0]; i++) {
        struct scene scene;
        const char *path = SCENES[i].path;
        if (!scene_from_file(t, path, WIDTH, WIDTH, &scene))
            continue;
        struct batches pt = by(t, &scene, "pt", SCENES[i].pt);
        for (size_t k = 0; k < sizeof ways / sizeof ways[0]; k++) {
            bool bins = strstr(ways[k], "bins") != NULL;
            if (bins && SCENES[i].bins == 0)
                continue;
            struct batches b = by(t, &scene, ways[k], bins ? SCENES[i].bins : SCENES[i].spp);
            compare(t, path, ways[k], &b, &pt, 0.003);
            batches_free(&b);
        }
        for (size_t k = 0; k < sizeof chains / sizeof chains[0]; k++) {
            char way[128];
            snprintf(way, sizeof way, "%s starts=%ld", chains[k], SCENES[i].states * test_effort(t));
            struct batches b = by(t, &scene, way, SCENES[i].chains);
            compare(t, path, way, &b, &pt, 0.003);
            batches_free(&b);
        }
        batches_free(&pt);
        scene_free(&scene);
    }
}

/* Two rooms in four pixels, where a fault of 1/K is a hundred times what is allowed: K = 1, 2, 4. */
static void test_few_sub_paths(struct test *t)
{
    static const char *const ways[] = {"lvc", "cbdpt connections=2", "mbdpt", "pcbdpt records=.3", "ris records=.3",
                                       "ris2 records=.3 presampled=2", "spcbpt", "asbdpt select=subspaces",
                                       "asbdpt select=vertices connections=2"};
    struct scene scene;
    if (!scene_from_file(t, "doc/mini/rooms.pbrt", 2, 2, &scene))
        return;
    struct batches pt = by(t, &scene, "pt", 1 << 13);
    for (size_t k = 0; k < sizeof ways / sizeof ways[0]; k++)
        for (int K = 1; K <= 4; K *= 2) {
            char way[128];
            bool has_records = strstr(ways[k], "records") != NULL;
            snprintf(way, sizeof way, "%s %s=%d", ways[k], has_records ? "subpaths" : "pathpixels",
                     has_records ? K : 4 / K);
            struct batches b = by(t, &scene, way, 1 << 12);
            compare(t, "two rooms in four pixels", way, &b, &pt, 0.006);
            batches_free(&b);
        }
    batches_free(&pt);
    scene_free(&scene);
}

/* family: every selection and chain, restir, restirgi and ppg agree with pt to three thousandths of the mean.
 * They do so in six scenes, and with pools of one, two and four light sub-paths. The dissertation's bins, with the same
 * samples, are rejected. */
void test_family_long(struct test *t)
{
    test_few_sub_paths(t);
    test_six_scenes(t);
}
