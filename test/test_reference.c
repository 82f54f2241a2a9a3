/* test_reference.c: all integrators against the stored references of the scenes (ref/), tile by tile; the
 * dissertation's bins, with the same samples, are found out. */
#include <stdio.h>

#include "helpers.h"
#include "tests.h"

enum { TILE = 8 }; /* pixels; smaller ones have means too skewed for the few samples of the quick test */

/* The stored picture with its errors, in tiles. */
static bool load_reference(struct test *t, const char *name, int *width, int *height, struct batches *out)
{
    char path[256];
    struct side side = {0};
    snprintf(path, sizeof path, "ref/%s.pfm", name);
    bool ok = read_reference(t, path, &side);
    *width = side.width;
    *height = side.height;
    if (ok)
        *out = batches_tiles(&side.pixels, side.width, side.height, TILE);
    batches_free(&side.pixels);
    return ok;
}

static const struct integrator_case {
    const char *name, *integrator, *select;
} CASES[] = {
    {"pt", "pt", NULL},         {"lt", "lt", NULL},                 {"bdpt", "bdpt", NULL},
    {"pool", "asbdpt", "pool"}, {"vertices", "asbdpt", "vertices"}, {"bins", "asbdpt", "bins"},
    {"subspaces", "asbdpt", "subspaces"},
};
/* bit i: CASES[i] */
enum { PT = 1, LT = 2, BDPT = 4, POOL = 8, VERTICES = 16, BINS = 32, SUBSPACES = 64, N_CASES = 7 };

static void test_integrator(struct test *t, const struct integrator_case *c, const char *name, struct scene *scene,
                            const struct batches *reference, int spp, int n_batches, uint64_t seed, bool must_hold)
{
    if (c->select != NULL)
        settings_set(&scene->settings, "select", c->select, "test");
    struct batches b = render_batches(t, scene, c->integrator, 0, spp, n_batches, TILE, seed);
    struct verdict v = verify_batches(&b, reference, seed);
    if (must_hold) {
        TEST_ACCEPT(t, v.smallest, "%s by %s against its reference, worst tile %ld", name, c->name, v.where / 3);
        TEST_ACCEPT(t, v.mean, "%s by %s against its reference, ratio of the means %.4f +- %.4f", name, c->name,
                    v.ratio, v.ratio_error);
        TEST_ACCEPT(t, v.uniform, "%s by %s against its reference, p-values of all tiles", name, c->name);
    } else {
        TEST_REJECT(t, v.p, "%s by %s against its reference, ratio of the means %.4f +- %.4f", name, c->name, v.ratio,
                    v.ratio_error);
    }
    batches_free(&b);
}

static void test_scene(struct test *t, const char *name, int integrators, int spp)
{
    char path[256];
    struct scene scene;
    struct batches reference;
    int width, height;
    if (!load_reference(t, name, &width, &height, &reference))
        return;
    snprintf(path, sizeof path, "scenes/%s.pbrt", name);
    if (scene_from_file(t, path, width, height, &scene)) {
        for (int i = 0; i < N_CASES; i++)
            if (integrators >> i & 1)
                test_integrator(t, &CASES[i], name, &scene, &reference, spp, 16, 860 + (uint64_t)i, 1 << i != BINS);
        scene_free(&scene);
    }
    batches_free(&reference);
}

/* The few samples of the quick version are enough where a tile's mean is nearly normal: not for pt where light is
 * rare. */
void test_references(struct test *t)
{
    test_scene(t, "cornell-box", PT | LT | BDPT | POOL | VERTICES | SUBSPACES | BINS, 16);
    test_scene(t, "cornell-box-modified", BDPT | SUBSPACES, 8);
    test_scene(t, "veach-ajar", BDPT | VERTICES | SUBSPACES, 8);
    test_scene(t, "bathroom", BDPT | SUBSPACES, 8);
    test_scene(t, "living-room", BDPT | VERTICES | SUBSPACES, 8);
    test_scene(t, "caustic-glass", BDPT | SUBSPACES, 8);
    test_scene(t, "sky", BDPT | SUBSPACES, 8);
    test_scene(t, "spot", BDPT | SUBSPACES, 8);
    test_scene(t, "corridor", SUBSPACES, 8);
    test_scene(t, "many-lights", SUBSPACES, 8);
    test_scene(t, "forest", BDPT | SUBSPACES, 8);
}

/* Light tracing cannot see what reaches the lens by way of a mirror or glass only: lt has the boxes alone. */
void test_references_long(struct test *t)
{
    test_scene(t, "cornell-box", PT | LT | BDPT | POOL | VERTICES | SUBSPACES | BINS, 256);
    test_scene(t, "cornell-box-modified", PT | LT | BDPT | POOL | VERTICES | SUBSPACES | BINS, 256);
    test_scene(t, "veach-ajar", PT | BDPT | POOL | VERTICES | SUBSPACES, 256);
    test_scene(t, "bathroom", PT | BDPT | POOL | VERTICES | SUBSPACES, 256);
    test_scene(t, "living-room", PT | BDPT | POOL | VERTICES | SUBSPACES, 256);
    test_scene(t, "caustic-glass", BDPT | POOL | VERTICES | SUBSPACES, 64); /* pt finds no caustics of a spot light */
    test_scene(t, "sky", PT | BDPT | POOL | VERTICES | SUBSPACES, 64);
    test_scene(t, "spot", PT | BDPT | POOL | VERTICES | SUBSPACES, 64);
    test_scene(t, "corridor", PT | BDPT | POOL | VERTICES | SUBSPACES, 64);
    test_scene(t, "many-lights", PT | BDPT | POOL | VERTICES | SUBSPACES, 64);
    test_scene(t, "forest", PT | BDPT | POOL | VERTICES | SUBSPACES, 64);
}
