/* race.h: how often does this scene need light sub-paths? A race before the render decides it (doc/method.md).
 *
 * Runners differ in their numbers of samples. None gives light up: every runner keeps all strategies, the path tracers
 * in one of RARE iterations of a tile. Only if all lobes are diffuse, path tracers trace no light sub-paths at all:
 * then s = 0 and s = 1 find all light.
 *
 * The least variance of a sample times its price wins [Grittmann 2022]. Prices count vertices and connections, so the
 * same runner wins on every machine. Each runner renders SAMPLES samples of some pixels twice, with random numbers that
 * the render does not use; splats anywhere in the cell of a pixel count as its own. A runner that meets light
 * in less than 1/BLIND_SHARE as many pixels as another cannot win. A path tracer must be CAUTION times as cheap: it may
 * have missed bright samples, and to pick it wrongly may cost twenty times, to trace light sub-paths in vain hardly two.
 * prepare.h says what is learnt before.
 *
 * Tests: test_race.c.
 */
#ifndef ASBDPT_RACE_H
#define ASBDPT_RACE_H

#include "integrators/method.h"

enum { RACE_LEAST_PIXELS = 32 * 32 }; /* a smaller picture is rendered by the first: too few pixels show anything */

/* race_begin: add the runners to *p, whose numbers are those of the first.
 * race: let them compete in *p, with what it has learnt, and set p->winner: the first if the job is cancelled.
 * race_winner: the number of the best of runners that have all been judged.
 * race_blind: has it met so little light that it cannot win? */
void race_begin(const struct scene *scene, struct prepared *p);
void race(const struct render_job *job, struct prepared *p);
int race_winner(const struct runner runner[RUNNERS]);
bool race_blind(const struct runner *k);

#endif
