/* plot.h: line plots as SVG text.
 *
 * Axes are linear or logarithmic, with ticks at round numbers; lines have markers of their own shape, so that they
 * can be told apart without colour, and error bars. Colours follow the reader's light or dark setting.
 *
 * Used by: figures. Tests: test_report.c.
 */
#ifndef ASBDPT_PLOT_H
#define ASBDPT_PLOT_H

#include <stdbool.h>
#include <stdio.h>

enum { PLOT_MAX_POINTS = 64, PLOT_MAX_LINES = 8, PLOT_MAX_TICKS = 64 };

struct plot_line {
    const char *label;
    int n;
    double x[PLOT_MAX_POINTS], y[PLOT_MAX_POINTS];
    double error[PLOT_MAX_POINTS]; /* half length of the error bar; NaN or 0: none */
};

struct plot {
    const char *title, *description; /* the description is for those who cannot see the picture */
    const char *x_label, *y_label;
    bool log_x, log_y;
    bool zero_line;  /* draw y = 0; linear y only */
    bool data_ticks; /* ticks of the x axis at the first line's points */
    int n;
    struct plot_line line[PLOT_MAX_LINES];
};

/* An axis: from the range of the data to a position between 0 and 1. */
struct axis {
    bool logarithmic;
    double low, high; /* low < high; both > 0 when logarithmic */
};

/* axis_make: an axis that holds [low, high] with a margin; widened when both are the same. */
struct axis axis_make(bool logarithmic, double low, double high);
double axis_position(const struct axis *a, double value);

/* axis_ticks: round numbers within the axis, rising. Linear: 1, 2 or 5 times a power of ten apart, 4 to 11 of them.
 * Logarithmic: the multiples 1 to 9 of powers of ten; *major tells which deserve a number. Returns how many. */
int axis_ticks(const struct axis *a, double tick[PLOT_MAX_TICKS], bool major[PLOT_MAX_TICKS]);

/* plot_write: points that are not finite, or not positive on a logarithmic axis, are left out.
 *   id          a word unique in the page, for references inside the picture
 *   standalone  a file of its own (with its style); else a part of a page that has plot_style's text */
void plot_write(FILE *f, const struct plot *p, const char *id, bool standalone);

/* plot_style: the CSS that plots need. */
void plot_style(FILE *f);

#endif
