/* probe.h: samples that no image is made of, to find out what a render should do.
 *
 * A probe takes some samples of some pixels, with random numbers that the render does not have, and reduces what an
 * observer is told of their paths (observer.h). Squares are relative to the brightness of the pixel: to the square of
 * 3/4 of its own light and 1/4 of the mean of all pixels, so that pixels which are dark by chance do not dominate.
 *
 * Tests: test_probe.c.
 */
#ifndef ASBDPT_PROBE_H
#define ASBDPT_PROBE_H

#include "learning/patience.h"
#include "transport/counts.h"
#include "transport/pixel_sample.h"

/* No squared relative deviation counts for more: an image's white is not far off. */
#define PROBE_CLIP 25.0

struct probe {
    const struct render_job *job; /* of the render */
    int64_t n; /* pixels: points 0 .. n-1 of an even sequence over the film; those measured after probe_run */
    void *context;
    /* Take the samples of pixel number k at (x,y), called on several threads. */
    void (*measure)(struct probe *p, int64_t k, int x, int y, int thread);
    /* What follows belongs to probe_run. */
    struct workspace *work;
    struct tile *tile; /* [n_threads] */
    struct patience patience;
};

/* probe_run: measure all pixels, or as many as job->watch allows. */
void probe_run(struct probe *p);

/* probe_sample: one sample of a pixel, of all strategies that the counts have; its paths are told to `joined`.
 *   seed, iteration  what the random numbers depend on, besides the pixel */
void probe_sample(const struct probe *p, const struct mis_counts *counts, uint64_t seed, int x, int y, long iteration,
                  int thread, const struct observer *joined);

/* probe_scale: what squares are divided by where the light is `local`, and `all` in the mean. */
static inline double probe_scale(double local, double all) { return sqr(0.75 * local + 0.25 * all) + 1e-30; }

/* --- credits: credit.c -------------------------------------------------------------------------------- */

/* How well do a pixel's samples estimate direct light at its first hit? The weights compare second moments, as if all
 * samples were independent (mis.h). The numbers of the eye sub-path's first vertices are not: over the iterations of a
 * pixel they are spread evenly (sampler.h), so the mean of N samples has less than 1/N of the variance of one. There a
 * sample of s = 0 or s = 1 counts as
 *     E[X^2] / (N V_N)
 * samples, where X is what it contributes and V_N the variance of the mean of N [Grittmann 2019]. Some pixels take 16
 * samples by path tracing, twice; half the squared difference of the two means estimates V_16. */

/* credit_measure: for lights as `tables` choose them; that of draws is 1. As many samples as the image has
 * pixels, or a few more, but at most 32768. */
struct credits credit_measure(const struct render_job *job, const struct tables *tables);

/* --- is this a scene for a path tracer: usefulness.c -------------------------------------------------- */

/* Are light sub-paths worth tracing? The second moment of a path tracer's estimate is larger than that of BDPT's by the
 * expected sum of
 *     X^2 (1/P - 1)
 * over the paths of a BDPT sample, where X is what a path contributes and P the share of the strategies s <= 1 in its
 * weights. BDPT finds often what are rare fireflies to a path tracer, so this sees them in few samples. P is found by
 * taking the same sample again with half the counts for s >= 2: weights of s <= 1 become 2 / (1 + P) times as large,
 * the others 1 / (1 + P). Direct light is often without noise, its second moment being the square of its mean: of its
 * sum only the share counts that variance has in the second moment.
 *
 * light_paths_useful: is that sum more than BDPT's own variance? A path tracer, which takes a third of the time, has
 * more than twice the variance then. Also true if job->watch ends it. */
bool light_paths_useful(const struct render_job *job);

#endif
