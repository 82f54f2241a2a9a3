/* findings.h: what the results say, in sentences. Every number and every outcome in them is computed.
 *
 * An outcome needs a 95 % confidence interval that does not hold 1; else the sentence says that it is undecided.
 *
 * Tests: test_report.c.
 */
#ifndef ASBDPT_FINDINGS_H
#define ASBDPT_FINDINGS_H

#include "lab/results.h"

enum { FINDINGS_MAX = 16, FINDING_SIZE = 700 };

struct findings {
    char text[FINDINGS_MAX][FINDING_SIZE]; /* [n] plain text */
    int n;
};

enum outcome { OUTCOME_GAIN, OUTCOME_LOSS, OUTCOME_UNDECIDED };

/* outcome_of: does the interval of a ratio of errors lie below 1, above 1, or around it? */
enum outcome outcome_of(struct interval ratio);

/* findings_make: about a scene, or about all scenes for NULL. */
void findings_make(const struct results *r, const struct scene_results *s, struct findings *out);

#endif
