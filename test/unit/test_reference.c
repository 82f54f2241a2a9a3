/* test_reference.c: all integrators against the stored references of the scenes (ref/), tile by tile. The
 * dissertation's bins, with the same samples, are rejected. */
#include <stdio.h>

#include "helpers.h"
#include "suites.h"

enum { TILE = 18, BATCHES = 16 }; /* smaller tiles have means too skewed for the few samples of the quick test */

/* bit i: WAYS[i] */
enum { PT = 1, LT = 2, BDPT = 4, POOL = 8, VERTICES = 16, SUBSPACES = 32, BINS = 64, CAUSTICS = 128, N_WAYS = 8 };
static const struct {
    const char *name, *integrator;
} WAYS[N_WAYS] = {{"pt", "pt"},           {"lt", "lt"},           {"bdpt", "bdpt"}, {"pool", "asbdpt"},
                 {"vertices", "asbdpt"}, {"subspaces", "asbdpt"}, {"bins", "asbdpt"},     {"caustics", "caustics"}};

/* Light tracing cannot see what reaches the lens by way of a mirror or glass only: lt has the boxes alone. Few samples
 * are enough where a tile's mean is nearly normal: not for pt where light is rare. Behind glass under a spot light the
 * caustics of caustic connections alone are all there. All selections in the Cornell box: test_asbdpt.c. What
 * takes long to learn has no quick way. */
static const struct {
    const char *name;
    int quick, slow, slow_spp;
} SCENES[] = {{"cornell-box", PT | LT, PT | LT | BDPT | POOL | VERTICES | SUBSPACES | BINS, 256},
              {"cornell-box-modified", BDPT | SUBSPACES, PT | LT | BDPT | POOL | VERTICES | SUBSPACES | BINS, 256},
              {"veach-ajar", SUBSPACES, PT | BDPT | POOL | VERTICES | SUBSPACES, 256},
              {"bathroom", BDPT, PT | BDPT | POOL | VERTICES | SUBSPACES, 256},
              {"living-room", 0, PT | BDPT | POOL | VERTICES | SUBSPACES, 256},
              {"caustic-glass", CAUSTICS, CAUSTICS, 64},
              {"sky", SUBSPACES, PT | BDPT | POOL | VERTICES | SUBSPACES, 64},
              {"spot", SUBSPACES, PT | BDPT | POOL | VERTICES | SUBSPACES, 64},
              {"corridor", 0, PT | BDPT | POOL | VERTICES | SUBSPACES, 64},
              {"many-lights", 0, PT | BDPT | POOL | VERTICES | SUBSPACES, 64},
              {"forest", SUBSPACES, PT | BDPT | POOL | VERTICES | SUBSPACES, 64}};

static void test_way(struct test *t, const char *name, int way, struct scene *scene, const struct batches *reference,
                     int spp)
{
    uint64_t seed = 860 + (uint64_t)way;
    settings_set(&scene->settings, "select", WAYS[way].name, "test"); /* which asbdpt alone asks for */
    struct batches b = render_batches(t, scene, WAYS[way].integrator, 0, spp, BATCHES, TILE, seed);
    struct verdict v = verify_batches(&b, reference, seed);
    char what[256];
    snprintf(what, sizeof what, "%s by %s: mean %.4f +- %.4f, p = %.2g; tile %ld, p = %.2g; evenness, p = %.2g", name,
             WAYS[way].name, v.ratio, v.ratio_error, v.mean, v.where / 3, v.smallest, v.uniform);
    if (1 << way == BINS)
        TEST_REJECT(t, v.p, "%s", what);
    else
        TEST_ACCEPT(t, v.p, "%s", what);
    batches_free(&b);
}

static void test_scenes_by_reference(struct test *t, bool slow)
{
    for (size_t i = 0; i < sizeof SCENES / sizeof SCENES[0]; i++) {
        char path[256];
        struct scene scene;
        struct batches reference;
        int width, height, ways = slow ? SCENES[i].slow : SCENES[i].quick;
        if (ways == 0 || !load_reference(t, SCENES[i].name, TILE, &width, &height, &reference))
            continue;
        snprintf(path, sizeof path, "scenes/%s.pbrt", SCENES[i].name);
        if (scene_from_file(t, path, width, height, &scene)) {
            for (int way = 0; way < N_WAYS; way++)
                if (ways >> way & 1)
                    test_way(t, SCENES[i].name, way, &scene, &reference, slow ? SCENES[i].slow_spp : 2);
            scene_free(&scene);
        }
        batches_free(&reference);
    }
}

void test_reference(struct test *t) { test_scenes_by_reference(t, false); }
void test_reference_long(struct test *t) { test_scenes_by_reference(t, true); }
