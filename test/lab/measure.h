/* measure.h: the one engine of all measurements: it carries out a plan.
 *
 * Every picture is a record of the store (store.h): of a scene, a method with its settings, a seed, a size and a number
 * of samples; so is every price. What is there is not measured again, whichever command left it there; what was
 * interrupted goes on where it stopped. A scene or a method that makes another picture begins again; a program that
 * is only faster does not notice: delete store/ to measure its prices again.
 *
 * Pictures after a rising number of samples come from one film, so that a run yields a whole convergence curve.
 *
 * At equal time prices come first: in three rounds the first method and another are timed by turns on one thread, with
 * few samples, and what each prepares by itself. Then the samples that each can have are arithmetic, and pictures may
 * be rendered on as many threads as there are, on a busy machine: no time is taken of them that counts.
 *
 * Squared errors (results.h) are those against a reference, stored, given or rendered, which is kept in reference/. At
 * equal time each method is tested against it first (mark.h); errors of those that pass come from pairs, which are less
 * noisy, if there are three seeds or more and the reference was not given. Fewer seeds are refused without a stored
 * reference whose noise is known: one made here is as noisy as they are.
 *
 * Tests: test_report.c, test_equal_time.c.
 */
#ifndef ASBDPT_LAB_MEASURE_H
#define ASBDPT_LAB_MEASURE_H

#include "lab/results.h"

/* measure: fill `out`, to be released with results_free also on failure. Returns false with a message. A scene that
 * cannot be loaded, or has no reference that will do, leaves the plan with a message if there are others. */
bool measure(struct plan *plan, struct results *out, struct error *err);

#endif
