/* race.h: how often does this scene need light sub-paths? A race before the render decides it.
 *
 * Runners differ in their numbers of samples (struct numbers). None gives light up: whatever the first can make, every
 * runner makes at least one RARE-th as often, in one of RARE iterations of a tile. Only where all lobes are diffuse the
 * path tracers have no light sub-paths at all.
 *
 * The race minimises the variance of a sample times its price [Grittmann 2022]. Each runner takes SAMPLES samples of
 * some pixels twice, with random numbers that the render does not use. A pixel is one of a cell of pixels, and splats
 * anywhere in the cell count as its own. The variance is the squared difference of the two, plus the squares of what is
 * made in one of k iterations, times k: that is sampled in every iteration, but weighed as in the render. Both are
 * relative to the brightness of pixel and picture, and grow only in proportion above FIREFLY. Light that the camera
 * sees directly is left out: it is the same for all. The price counts vertices and connections, so the same runner wins
 * on every machine.
 *
 * Light sub-paths cannot help against the noise of direct light at first hits. The path tracers compete first, one with
 * as many light points as the first runner, and one with a single one. If that noise is twice all other of the latter,
 * the better of the two wins before more is learnt about light sub-paths than they need.
 *
 * Tests: test_race.c.
 */
#ifndef ASBDPT_RACE_H
#define ASBDPT_RACE_H

#include "integrators/method.h"

enum { RACE_LEAST_PIXELS = 32 * 32 }; /* a smaller picture is rendered by the first: too few pixels show anything */

/* What each runner is for users, by enum runner_name. */
extern const char *const runner_helps[RUNNERS];

/* race_begin: add the runners to *p, whose numbers are those of the first.
 * race_early: does a path tracer win, before more is learnt than it needs itself?
 * race: let all others compete in *p, which is prepared for the first.
 * Both set p->winner. If job->watch ends a race, the first wins. */
void race_begin(const struct scene *scene, struct prepared *p);
bool race_early(const struct render_job *job, struct prepared *p);
void race(const struct render_job *job, struct prepared *p);

#endif
