/* results_file.h: the results as CSV and JSON, for other programs.
 *
 * results.csv  one line per scene, variant and number of samples: means over seeds with standard errors, ratios to
 *              BDPT with 95 % intervals; empty where unknown
 * runs.csv     one line per scene, variant, seed and number of samples: what was measured
 * results.json both, with the settings and the references
 *
 * Used by: output. Tests: test_report.c.
 */
#ifndef ASBDPT_RESULTS_FILE_H
#define ASBDPT_RESULTS_FILE_H

#include <stdio.h>

#include "lab/results.h"

void results_csv(FILE *f, const struct results *r);
void results_runs_csv(FILE *f, const struct results *r);
void results_json(FILE *f, const struct results *r);

#endif
