/* probe.h: samples before the render, by which a method decides how to render.
 *
 * A probe takes some samples of some pixels, with random numbers that the render does not use. It measures their paths
 * by an observer (observer.h). Squares are divided by the square of the pixel's brightness: 3/4 of its own light plus
 * 1/4 of the mean of all pixels, so that pixels which are dark by chance do not dominate.
 *
 * Tests: test_probe.c.
 */
#ifndef ASBDPT_PROBE_H
#define ASBDPT_PROBE_H

#include "learning/patience.h"
#include "transport/counts.h"
#include "transport/pixel_sample.h"

/* Upper bound of a squared relative deviation. An image cuts such deviations off, too, at white. */
#define PROBE_CLIP 25.0

struct probe {
    const struct render_job *job; /* of the render */
    int64_t n; /* number of pixels, from a low-discrepancy sequence over the film; after probe_run: those measured */
    void *context;
    /* Take the samples of pixel number k at (x,y), called on several threads. */
    void (*measure)(struct probe *p, int64_t k, int x, int y, int thread);
    /* Of probe_run: */
    struct workspace *work;
    struct tile *tile; /* [n_threads] */
    struct patience patience;
};

/* probe_run: measure all pixels, or fewer if job->watch ends it. */
void probe_run(struct probe *p);

/* probe_sample: take one sample of a pixel, by all strategies whose counts are not 0; `joined` observes its paths.
 *   seed, iteration  the random numbers are a function of these and the pixel */
void probe_sample(const struct probe *p, const struct mis_counts *counts, uint64_t seed, int x, int y, long iteration,
                  int thread, const struct observer *joined);

/* probe_scale: the divisor of squares in a pixel of brightness `local`, if the mean brightness is `all`. */
static inline double probe_scale(double local, double all) { return sqr(0.75 * local + 0.25 * all) + 1e-30; }

/* --- credits: credit.c -------------------------------------------------------------------------------- */

/* How well do a pixel's samples estimate direct light at its first hit? The weights compare second moments, as if all
 * samples were independent (mis.h). But the random numbers of the first vertices have low discrepancy over the
 * iterations of a pixel (sampler.h). So the mean of N samples has less than 1/N of the variance of one sample. A sample
 * of s = 0 or s = 1 at the first hit therefore counts as
 *     E[X^2] / (N V_N)
 * samples, where X is its contribution and V_N the variance of the mean of N [Grittmann 2019]. Some pixels take 16
 * samples by path tracing, twice. Half the squared difference of the two means estimates V_16. */

/* credit_measure: measure the credits of direct light, with lights chosen by `tables`; the credit of draws is 1. It
 * takes about 0.64 samples per pixel of the image, but at least 2048 and at most 32768. */
struct credits credit_measure(const struct render_job *job, const struct tables *tables);

/* --- are light sub-paths worth their time: usefulness.c ----------------------------------------------- */

/* The second moment of a path tracer's estimate is larger than that of BDPT's by the expected sum of
 *     X^2 (1/P - 1)
 * over the paths of a BDPT sample. X is the contribution of a path, and P the share of the strategies s <= 1 in its
 * weights. Paths that are rare fireflies to a path tracer are frequent in BDPT, so few samples show them. To measure P,
 * the probe takes the same sample a second time with half the counts for s >= 2. Weights of s <= 1 become 2 / (1 + P)
 * times as large, the others 1 / (1 + P) times. Direct light often has little noise: its second moment is the square of
 * its mean. So its sum is multiplied by the share of the variance in the second moment.
 *
 * light_paths_useful: is that sum larger than BDPT's own variance? If so, a path tracer has more than twice the
 * variance, but takes a third of the time. Also true if job->watch ends the probe. */
bool light_paths_useful(const struct render_job *job);

#endif
