/* helpers.h: what several tests need: scenes from text, renders in batches, comparison of two renders. */
#ifndef ASBDPT_TEST_HELPERS_H
#define ASBDPT_TEST_HELPERS_H

#include "base/file.h"
#include "integrators/integrator.h"
#include "lab/verify.h"
#include "scene/scene.h"
#include "test.h"

/* scene_from_text: parse and prepare a scene given as text. A failure is a failed check; returns false. */
bool scene_from_text(struct test *t, const char *text, struct scene *out);

/* scene_from_file: the same for a file, at the given resolution (0: as it is) with a box filter. */
bool scene_from_file(struct test *t, const char *path, int width, int height, struct scene *out);

/* render_batches: render `n_batches` times with `spp` samples and seeds of their own, and average over square tiles of
 * `tile` pixels. */
struct batches render_batches(struct test *t, const struct scene *scene, const char *integrator, int max_depth, int spp,
                              int n_batches, int tile, uint64_t seed);

/* mean_p: two-sided p-value of "the expectation is `expected`" for the batches' overall mean, by Student's t. */
double mean_p(const struct batches *b, double expected);

#endif
