/* probe.h: are light sub-paths worth their time in this scene? Samples before the render decide it.
 *
 * The probe takes some samples of some pixels by BDPT, with random numbers that the render does not use, and observes
 * their paths (observer.h). The second moment of a path tracer's estimate is larger than that of BDPT's by the expected
 * sum of
 *     X^2 (1/P - 1)
 * over the paths of a BDPT sample. X is the contribution of a path, and P the share of the strategies s <= 1 in its
 * weights. Paths that are rare fireflies to a path tracer are frequent in BDPT, so few samples show them. To measure P,
 * the probe takes the same sample a second time with half the counts for s >= 2. Weights of s <= 1 become 2 / (1 + P)
 * times as large, the others 1 / (1 + P) times. Direct light often has little noise: its second moment is the square of
 * its mean. So its sum is multiplied by the share of the variance in the second moment.
 *
 * Squares are divided by the square of the pixel's brightness: 3/4 of its own light plus 1/4 of the mean of all pixels,
 * so that pixels which are dark by chance do not dominate.
 *
 * Tests: test_probe.c.
 */
#ifndef ASBDPT_PROBE_H
#define ASBDPT_PROBE_H

#include "transport/tile_pass.h"

/* light_paths_useful: is that sum larger than 0.4 times BDPT's own variance? If not, a path tracer has at most 1.4
 * times the variance, and its samples take less time. Light sub-paths that are chosen well gain more than BDPT's, so
 * they can be useful where a path tracer is better than BDPT. Also true if job->watch ends the probe. */
bool light_paths_useful(const struct render_job *job);

#endif
