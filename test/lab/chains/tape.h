/* tape.h: numbers that a sample has consumed, so that it can be made again, or changed a little.
 *
 * A sampler whose numbers come from a tape gets number[at], if there is one; else a fresh number, which is appended. So
 * the same tape, set back to at = 0, gives again what it has recorded.
 *
 * Tests: test_chains.c.
 */
#ifndef ASBDPT_TAPE_H
#define ASBDPT_TAPE_H

#include "base/sampler.h"

struct tape {
    struct number_source source; /* the first, so that it is the tape's */
    struct sampler fresh;        /* where numbers come from that are not recorded */
    double *number;              /* [n], each in [0,1); owned */
    size_t n, at, capacity;
};

/* tape_append: record n numbers.
 * tape_play: a sampler that gets the tape's numbers from `at` on, and then those of `fresh`. */
void tape_append(struct tape *t, const double *u, size_t n);
struct sampler tape_play(struct tape *t, struct sampler fresh);

#endif
