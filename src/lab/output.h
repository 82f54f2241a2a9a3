/* output.h: everything an experiment leaves in its directory: pictures, plots, numbers and the report.
 *
 * Used by: cmd_experiment. Tests: test_report.c.
 */
#ifndef ASBDPT_OUTPUT_H
#define ASBDPT_OUTPUT_H

#include "lab/results.h"

/* output_write: images, plots, results.csv, runs.csv, results.json, results.md and report.html in plan->directory.
 * Returns false with a message. */
bool output_write(const struct results *r, struct error *err);

#endif
