/* tally.h: are things drawn as often as is stated?
 *
 * A chi-square test needs the probability of each cell, also of what is never drawn, whose probability nobody states.
 * So a first set of draws collects the things that can be drawn, with their stated probabilities. A second set is
 * counted. Every thing is a cell, and what the first set has not met is one more, with the rest of the probability.
 */
#ifndef ASBDPT_TEST_TALLY_H
#define ASBDPT_TEST_TALLY_H

#include "test.h"

/* Things have numbers from 0 to below n. One that several techniques draw, each with a probability of its own, is
 * several things, at most `ways`. */
struct tally {
    size_t n, ways;
    double *stated, *counted; /* [n * ways]; owned */
    bool collects;            /* in the first set of draws, as at the beginning */
    int strange;              /* draws with a probability that is 0, or one too many for their thing */
};

struct tally tally_new(size_t ways, size_t n);
void tally_free(struct tally *c);

/* tally_note: a draw and its stated probability. */
void tally_note(struct tally *c, size_t thing, double pmf);

/* tally_p: the p-value of `draws` draws of the second set. *sum: of all stated probabilities. */
double tally_p(const struct tally *c, double draws, double *sum);

/* tally_judge: check that, and that probabilities sum to 1 at most, each thing having as many as it may. */
void tally_judge(struct test *t, const struct tally *c, double draws, size_t ways, const char *name, const char *what);

#endif
