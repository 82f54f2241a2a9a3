/* figures.h: the plots of an experiment as SVG text, and which results each shows.
 *
 * Axes are linear or logarithmic, with ticks at round numbers; lines have markers of their own shape, so that they
 * can be told apart without colour, and error bars. Colours were chosen to stay apart for readers who lack one kind of
 * cone.
 *
 * Tests: test_report.c.
 */
#ifndef ASBDPT_FIGURES_H
#define ASBDPT_FIGURES_H

#include "lab/results.h"

enum figure { FIGURE_CONVERGENCE, FIGURE_SAMPLES, FIGURE_BIAS, FIGURE_SWEEP /* and one more for each other sweep */ };

/* figure_count: how many there are of a plan's scene. figure_path: plots/..., below the plan's directory. */
static inline int figure_count(const struct plan *p) { return FIGURE_SWEEP + p->n_sweeps; }
void figure_path(const struct scene_results *s, int which, char *out, size_t size);

/* figure_write: figure number `which`, an enum figure, as an SVG file that needs nothing else. */
void figure_write(FILE *f, const struct scene_results *s, int which);

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
