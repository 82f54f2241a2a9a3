/* plan.h: how many samples should each kind of strategy take? From what a probe found, and what they cost.
 *
 * Let a pixel's estimate have the variance A + sum_c b_c / n_c and the cost k + sum_c n_c k_c, where c are the kinds of
 * samples whose number is free (probe.h), b_c is the variance of one sample of the kind once the eye sub-path is given,
 * and A is the variance that the eye sub-path brings. The product of both, which is the squared error at equal time, is
 * smallest for
 *     n_c = sqrt(b_c / k_c) sqrt(k / A).
 * Costs are counted in rays, not in seconds: the choice must be the same on every machine. The same product says
 * whether light sub-paths pay at all. [Grittmann 2022] chooses among given candidates by it.
 *
 * Pure functions: of numbers, to numbers. Tests: test_pilot.c.
 */
#ifndef ASBDPT_PLAN_H
#define ASBDPT_PLAN_H

#include "learning/probe.h"
#include "tables/importance.h"

/* Samples of each kind, of one eye vertex or of one pixel. */
struct plan {
    double n[N_KINDS]; /* LIGHT_PATH 0: there are no light sub-paths, and no draws */
};

extern const struct plan PLAN_TRIED; /* while a probe looks on */

/* In units of a ray that looks for the closest hit. */
struct costs {
    double fixed, each[N_KINDS];
};

/* plan_costs: from the vertices that sub-paths have in the mean. */
struct costs plan_costs(const struct importance *means);

/* plan_paths_pay: are light sub-paths worth what they cost, by as many samples as planned? */
bool plan_paths_pay(const struct costs *c, const struct noise *s, const struct plan *p);

/* plan_numbers: by what was found when PLAN_TRIED was tried; the usual ones if nothing was. */
struct plan plan_numbers(const struct costs *c, const struct noise *s);

#endif
