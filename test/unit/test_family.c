/* test_family.c: every selection and chain, restir, restirgi and ppg agree with pt to three thousandths of the mean.
 * They do so in six scenes, and with pools of one, two and four light sub-paths. The dissertation's bins, with the same
 * samples, are rejected. */
#include <stdio.h>
#include <string.h>

#include "helpers.h"
#include "suites.h"

enum { BATCHES = 16, DEPTH = 5, SIDE = 8, TILE = 4 };

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
 * and independent states of chains: as many as it takes. */
static const struct {
    const char *path;
    long pt, bins, spp, states;
} SCENES[] = {{"doc/mini/rooms.pbrt", 4096, 2048, 2048, 1 << 17},
              {"scenes/cornell-box.pbrt", 512, 1024, 1024, 1 << 17},
              {"scenes/forest.pbrt", 1024, 2048, 256, 1 << 18},
              {"scenes/sky.pbrt", 256, 0, 256, 1 << 18},
              {"scenes/test/light-kinds.pbrt", 256, 256, 256, 1 << 16},
              {"scenes/test/all-materials.pbrt", 512, 256, 320, 1 << 17}};

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
        if (!scene_from_file(t, path, SIDE, SIDE, &scene))
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
            struct batches b = by(t, &scene, way, SCENES[i].spp);
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

void test_family_long(struct test *t)
{
    test_few_sub_paths(t);
    test_six_scenes(t);
}
