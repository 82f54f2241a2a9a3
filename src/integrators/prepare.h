/* prepare.h: from a row of a method to its first sample: tables are learnt (learn.h), a race may decide on the numbers
 * of samples (race.h), and the counts in the weights follow (counts.h).
 *
 * Tests: test_render.c, test_asbdpt.c, test_race.c.
 */
#ifndef ASBDPT_PREPARE_H
#define ASBDPT_PREPARE_H

#include "integrators/method.h"

/* method_prepare: prepare, by the parameters that method_read has read.
 * method_release: release what method_read and method_prepare have made. */
void method_prepare(const struct render_job *job, struct prepared *p);
void method_release(struct prepared *p);

/* What a method has chosen for itself. */
enum { METHOD_NUMBERS = 16 };
struct method_number {
    const char *name; /* static; NULL: the one before was the last */
    double value;
};

/* method_numbers: what was chosen for this scene, for --stats; runners with variance times price over the winner's. */
void method_numbers(const struct prepared *p, struct method_number out[METHOD_NUMBERS]);

#endif
