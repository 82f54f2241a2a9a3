/* prepare.h: what happens between a row of a method and its first sample: tables are learnt (learn.h), a race may
 * decide on the numbers of samples (race.h), and the counts in the weights follow (counts.h).
 *
 * Tests: test_render.c, test_asbdpt.c, test_race.c.
 */
#ifndef ASBDPT_PREPARE_H
#define ASBDPT_PREPARE_H

#include "integrators/method.h"

/* method_prepare: read the parameters and prepare.
 *   out  after success, method_release releases it
 * Returns false with a message if a parameter is not valid. */
bool method_prepare(const struct method *m, const struct render_job *job, struct prepared *out, struct error *err);
void method_release(struct prepared *p);

/* method_numbers: what was chosen for this scene, for --stats; runners with variance times price over the winner's. */
void method_numbers(const struct prepared *p, struct film_number out[FILM_NUMBERS]);

/* method_counts: p->counts, of p->numbers and p->tables. */
void method_counts(const struct render_job *job, struct prepared *p, bool credits);

#endif
