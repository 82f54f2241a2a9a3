/* pilot.h: how many samples should each kind of strategy take? Chosen before the render, by what some tiles show.
 *
 * Let a pixel's estimate have the variance A + sum_c b_c / n_c and the cost k + sum_c n_c k_c, where c are the kinds of
 * samples whose number is free (draws for the first hit, draws for later ones, light points for the first hit, light
 * sub-paths), b_c is the variance of one sample of the kind once the eye sub-path is given, and A is the variance that
 * the eye sub-path brings. The product of both, which is the squared error at equal time, is smallest for
 *     n_c = sqrt(b_c / k_c) sqrt(k / A).
 * noise.h measures A and b_c. Costs are counted in rays, not in seconds: the choice must be the same on every machine.
 * The same product says whether light sub-paths pay at all. [Grittmann 2022] chooses among given candidates by it.
 *
 * It also settles how much more the samples of s <= 1 are worth to the weights than independent ones: first_light.h.
 *
 * Tests: test_pilot.c, test_asbdpt.c.
 */
#ifndef ASBDPT_PILOT_H
#define ASBDPT_PILOT_H

#include "pilot/noise.h"

/* pilot_run: choose draws, lights, path_pixels and the counts that go with them.
 *   free_choice  may there be no light sub-paths?
 *   s            all but these complete. A number of tiles that the picture's size alone decides is rendered by
 *                `method`, unless job->watch ends it; then usual numbers are taken */
void pilot_run(const struct render_job *job, const struct pilot_method *method, bool free_choice,
               struct subspaces_state *s);

/* pilot_set_draws: C draws per eye vertex, whatever was chosen. */
void pilot_set_draws(struct subspaces_state *s, double C);

#endif
