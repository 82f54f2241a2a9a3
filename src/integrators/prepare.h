/* prepare.h: from a row of a method to its first sample: tables are learnt (learn.h), a race may decide on the numbers
 * of samples (race.h), and the counts in the weights follow (counts.h).
 *
 * A method that learns much races twice: when it knows as little as a path tracer needs, and when it knows all. The first
 * race ends the matter if a path tracer wins it, and has a variance below CALM: then little can be gained. Noisier scenes
 * are never left so early, for in some rooms light sub-paths seem useless while little is known.
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

#endif
