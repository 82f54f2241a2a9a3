/* equal_page.h: what `asbdpt-lab equal-time` found, for a reader in a hurry: one sentence, and one page of HTML.
 *
 * The page, equal-time.html beside family.png and errors.png, has the sentence, the ratios with their intervals, crops
 * at equal time, and where the errors are.
 *
 * Tests: test_equal_time.c, test/cli.sh.
 */
#ifndef ASBDPT_EQUAL_PAGE_H
#define ASBDPT_EQUAL_PAGE_H

#include "lab/equal_time.h"

/* equal_overall: geometric mean over the scenes of a method's ratios, with its 95 % interval; NaN if one is missing.
 * equal_seeds_wanted: how many seeds would narrow an interval that holds 1 until it does not, if the ratio stays. */
struct interval equal_overall(const struct equal_time *e, int method, enum equal_error which);
double equal_seeds_wanted(struct interval ratio, int n_seeds);

/* equal_verdict: the sentence. */
void equal_verdict(FILE *f, const struct equal_time *e);

/* equal_page_write: the page and its pictures, from those that equal_run has kept. False with a message. */
bool equal_page_write(const struct equal_time *e, struct error *err);

#endif
