/* findings.h: what the results say, in sentences. Every number and every verdict in them is computed.
 *
 * A verdict needs a 95 % confidence interval that does not hold 1; else the sentence says that it is undecided.
 *
 * Used by: report, summary. Tests: test_report.c.
 */
#ifndef ASBDPT_FINDINGS_H
#define ASBDPT_FINDINGS_H

#include "lab/results.h"

enum { FINDINGS_MAX = 16, FINDING_SIZE = 700 };

struct findings {
    char text[FINDINGS_MAX][FINDING_SIZE]; /* [n] plain text */
    int n;
};

enum verdict { VERDICT_GAIN, VERDICT_LOSS, VERDICT_UNDECIDED };

/* verdict_of: does the interval of a ratio of errors lie below 1, above 1, or around it? */
enum verdict verdict_of(struct interval ratio);

void findings_scene(const struct results *r, const struct scene_results *s, struct findings *out);
void findings_total(const struct results *r, struct findings *out);

#endif
