/* race.h: how often does this scene need light sub-paths? A race before the render decides it (doc/method.md).
 *
 * Runners differ in their numbers of samples. None gives light up: every runner keeps all strategies, the path tracers
 * in one of RARE iterations of a tile. Only if all lobes are diffuse, path tracers trace no light sub-paths at all:
 * then s = 0 and s = 1 find all light.
 *
 * The least variance of a sample times its price wins [Grittmann 2022]. Prices count vertices and connections, so the
 * same runner wins on every machine. Each runner renders SAMPLES samples of some pixels twice, with random numbers that
 * the render does not use; splats anywhere in the cell of a pixel count as its own. A runner that meets light
 * in less than 1/BLIND_SHARE as many pixels as another of its stage cannot win.
 *
 * The race has two stages. First two path tracers, with as many light points as RUNNER_ALL and with one, compete with
 * RUNNER_QUARTER, and little has been learnt for any. The better path tracer wins if light sub-paths cannot help, since
 * direct light at first hits makes two thirds of the variance of RUNNER_ONE_POINT, or do not help, since RUNNER_QUARTER
 * has more than USELESS of the variance of the first path tracer. Else all is learnt, and the others compete, too.
 *
 * Tests: test_race.c.
 */
#ifndef ASBDPT_RACE_H
#define ASBDPT_RACE_H

#include "integrators/method.h"

enum { RACE_LEAST_PIXELS = 32 * 32 }; /* a smaller picture is rendered by the first: too few pixels show anything */

/* race_begin: add the runners to *p, whose numbers are those of the first.
 * race_early: the first stage in *p, which has learnt as little as path tracers need. Does one of them win?
 * race: let all others compete in *p, which is prepared for the first.
 * Both set p->winner. If the job is cancelled, race_early says no and the first wins. */
void race_begin(const struct scene *scene, struct prepared *p);
bool race_early(const struct render_job *job, struct prepared *p);
void race(const struct render_job *job, struct prepared *p);

#endif
