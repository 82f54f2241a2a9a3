/* first_light.h: how well do a pixel's numbers estimate the light that comes straight to its first hit?
 *
 * The weights compare samples by second moments, as if all were independent (mis.h). Those of the eye sub-path's first
 * vertices are not: over the iterations of a pixel they are spread evenly (sampler.h), and the light of a lamp that is
 * always there has hardly any variance at all. So strategies s = 0 and s = 1 deserve a credit there,
 *     E[X^2] / (N V_N),
 * where X is what a sample brings and V_N the variance of the mean of N samples of a pixel [Grittmann 2019]. It is
 * measured: some pixels take 16 samples by path tracing, twice, with numbers of their own; half the squared difference
 * of the two means is V_16.
 *
 * Tests: test_pilot.c.
 */
#ifndef ASBDPT_FIRST_LIGHT_H
#define ASBDPT_FIRST_LIGHT_H

#include "transport/pixel_sample.h"

struct first_light {
    double broad; /* of s = 0 and s = 1, for lights that both can find */
    double delta; /* of s = 1, for those that s = 0 cannot */
};

/* first_light_measure: for the lights as `tables` choose them. Traces as many eye sub-paths as the picture has pixels,
 * or a few more, but at most 32768, unless job->watch ends it.
 *   work  [job->n_threads] */
void first_light_measure(const struct render_job *job, const struct tables *tables, struct workspace *work,
                         struct first_light *out);

#endif
