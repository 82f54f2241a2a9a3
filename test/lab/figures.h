/* figures.h: the plots of an experiment as SVG text, and which results each shows.
 *
 * Axes are linear or logarithmic, with ticks at round numbers; lines have markers of their own shape, so that they
 * can be told apart without colour, and error bars. Colours follow the reader's light or dark setting; those of the
 * compared variants were chosen to stay apart for readers who lack one kind of cone.
 *
 * Tests: test_report.c.
 */
#ifndef ASBDPT_FIGURES_H
#define ASBDPT_FIGURES_H

#include "lab/results.h"

enum figure { FIGURE_CONVERGENCE, FIGURE_SAMPLES, FIGURE_BIAS, FIGURE_PATHS, FIGURE_RESTART, N_FIGURES };

/* figure_name: for file names. */
const char *figure_name(enum figure f);

/* figure_write:
 *   id          a word unique in the page, for references inside the picture
 *   standalone  a file of its own (with its style); else a part of a page that has figure_style's text */
void figure_write(FILE *f, const struct scene_results *s, enum figure which, const char *id, bool standalone);

/* figure_style: the CSS that plots need. */
void figure_style(FILE *f);

/* An axis: from the range of the data to a position between 0 and 1. */
struct plot_axis {
    bool logarithmic;
    double low, high; /* low < high; both > 0 when logarithmic */
};

/* axis_make: an axis that holds [low, high] with a margin; widened when both are the same. */
struct plot_axis axis_make(bool logarithmic, double low, double high);
double axis_position(const struct plot_axis *a, double value);

/* axis_ticks: round numbers within the axis, rising. Linear: 1, 2 or 5 times a power of ten apart, 4 to 11 of them.
 * Logarithmic: the multiples 1 to 9 of powers of ten; *major tells which deserve a number. Returns how many. */
enum { AXIS_MAX_TICKS = 64 };
int axis_ticks(const struct plot_axis *a, double tick[AXIS_MAX_TICKS], bool major[AXIS_MAX_TICKS]);

#endif
