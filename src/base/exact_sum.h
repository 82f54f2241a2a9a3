/* exact_sum.h: sums of floating-point numbers that do not depend on the order of their terms.
 *
 * Digits to the base 2^24 at fixed places of the number line hold the sum, each in a 64-bit integer. A term is cut at
 * these places into up to three whole numbers below 2^24, which are added; integers are added exactly, in any order.
 * Of all places a sum keeps three, the highest of which is that of its largest term. Whatever a term has below them is
 * left out, sooner or later: where a larger term comes last, the lowest places go then. What is kept is the same in
 * either case, since a place knows nothing of its neighbours: nothing is carried from one to the next while there are
 * terms to come. So the digits are a function of the set of terms alone, sums may be added up from parts, and pictures
 * rendered in pieces are those rendered at once, to the byte. [Demmel & Nguyen 2015] sum doubles on the same principle.
 *
 * At least 48 bits below the leading one of the largest term are kept, and 2^38 terms may be added to any sum of sums
 * before a digit overflows. What is not a number or not below 2^144 is no term, and nothing is left of what is below
 * 2^-216.
 * Tests: test_film.c. */
#ifndef ASBDPT_EXACT_SUM_H
#define ASBDPT_EXACT_SUM_H

#include <stdbool.h>
#include <stdint.h>

enum { EXACT_DIGITS = 3, EXACT_PLACES = 13 };

/* All zeros is the empty sum. */
struct exact_sum {
    int64_t digit[EXACT_DIGITS]; /* the highest first: in units of 2^24 to the power top - 7, top - 8, top - 9 */
    int top;                     /* 0 .. EXACT_PLACES - 1 */
};

/* exact_add: one term more. exact_join: all terms of another sum more; false, and the sum stays as it was, if a digit
 * would go beyond 2^62. exact_value: the sum, rounded. */
void exact_add(struct exact_sum *sum, double term);
bool exact_join(struct exact_sum *sum, const struct exact_sum *other);
double exact_value(const struct exact_sum *sum);

#endif
