/* figures.h: the plots of an experiment, and which results each shows.
 *
 * Used by: report, output. Tests: test_report.c.
 */
#ifndef ASBDPT_FIGURES_H
#define ASBDPT_FIGURES_H

#include "lab/plot.h"
#include "lab/results.h"

enum figure { FIGURE_CONVERGENCE, FIGURE_BIAS, FIGURE_PATHS, FIGURE_RESTART, N_FIGURES };

/* figure_name: for file names. */
const char *figure_name(enum figure f);

/* figure_make: fill a plot; its texts are borrowed from `text`.
 * Returns false when the experiment has nothing to show in it. */
struct figure_text {
    char title[400], description[600], x_label[64], y_label[64];
};
bool figure_make(const struct results *r, const struct scene_results *s, enum figure f, struct plot *out,
                 struct figure_text *text);

#endif
