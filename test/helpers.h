/* helpers.h: what several tests need: scenes from text, renders in batches, comparison of two renders. */
#ifndef ASBDPT_TEST_HELPERS_H
#define ASBDPT_TEST_HELPERS_H

#include "integrators/method.h"
#include "scene/scene.h"
#include "test.h"

/* scene_from_text: parse and prepare a scene given as text. A failure is a failed check; returns false. */
bool scene_from_text(struct test *t, const char *text, struct scene *out);

/* scene_from_file: the same for a file, at the given resolution (0: as it is) with a box filter. */
bool scene_from_file(struct test *t, const char *path, int width, int height, struct scene *out);

/* A render repeated with different seeds: the batches are independent, whatever the pixels of one have in common. */
struct batches {
    int n_batches;
    long n;        /* values per batch: tiles * 3 */
    double *value; /* [n_batches * n], owned */
};

/* render_batches: render `n_batches` times with `spp` samples and average over square tiles of `tile` pixels. */
struct batches render_batches(struct test *t, const struct scene *scene, const char *method, int max_depth, int spp,
                              int n_batches, int tile, uint64_t seed);
void batches_free(struct batches *b);

/* batches_p: Welch's test for every tile and channel; returns one p-value for "all means are equal": the smallest,
 * corrected by Sidak for their number. *ratio (may be NULL): total mean of a over total mean of b. */
double batches_p(const struct batches *a, const struct batches *b, double *ratio);

/* batches_mean: mean over batches and tiles with its standard error. */
double batches_mean(const struct batches *b, double *standard_error);

/* mean_p: two-sided p-value of "the expectation is `expected`" for the batches' overall mean, by Student's t. */
double mean_p(const struct batches *b, double expected);

/* Whether a file exists (for data that users may not have). */
bool file_exists(const char *path);

#endif
