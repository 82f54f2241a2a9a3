/* race.h: how often does this scene need light sub-paths? A race before the render decides it.
 *
 * Runners differ in their numbers of samples (struct numbers). None gives light up: every runner keeps all strategies,
 * the path tracers in one of RARE = 32 iterations of a tile. Only if all lobes are diffuse, path tracers trace no light
 * sub-paths at all: then s = 0 and s = 1 find all light.
 *
 * The race minimises the variance of a sample times its price [Grittmann 2022]. Each runner takes SAMPLES = 4 samples
 * of some pixels twice, with random numbers that the render does not use. The film is cut into at most 16 x 16 cells,
 * and one pixel of each is sampled. Splats anywhere in a cell count as its pixel's. The variance is the squared
 * difference of the two, plus the squares of what is made in one of k iterations, times k: that is sampled in every
 * iteration, but weighed as in the render. Both are relative to the brightness of pixel and picture, and grow only in
 * proportion above FIREFLY = 11. Light that the camera sees directly is left out: it is the same for all. A runner that
 * meets light in less than half as many pixels as another cannot win. The price counts vertices and connections, so the
 * same runner wins on every machine.
 *
 * The race has two stages. First two path tracers, with as many light points as RUNNER_ALL and with one, compete with
 * RUNNER_QUARTER, and little has been learnt for any. The better path tracer wins if light sub-paths cannot help, since
 * direct light at first hits makes two thirds of the variance of RUNNER_ONE_POINT, or do not help, since RUNNER_QUARTER
 * has more than USELESS = 0.95 of the variance of the first path tracer. Else all is learnt, which often halves the
 * variance of RUNNER_QUARTER, and the others compete with it; what the first stage has found of it stays.
 *
 * Tests: test_race.c.
 */
#ifndef ASBDPT_RACE_H
#define ASBDPT_RACE_H

#include "integrators/method.h"

enum { RACE_LEAST_PIXELS = 32 * 32 }; /* a smaller picture is rendered by the first: too few pixels show anything */

/* What each runner is for users, by enum runner_number. */
extern const char *const runner_helps[RUNNERS];

/* race_begin: add the runners to *p, whose numbers are those of the first.
 * race_early: the first stage in *p, which has learnt as little as path tracers need. Does one of them win?
 * race: let all others compete in *p, which is prepared for the first.
 * Both set p->winner. If the job is cancelled, race_early says no and the first wins. */
void race_begin(const struct scene *scene, struct prepared *p);
bool race_early(const struct render_job *job, struct prepared *p);
void race(const struct render_job *job, struct prepared *p);

#endif
