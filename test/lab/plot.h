/* plot.h: figures as SVG text: panels with axes, and in them lines, points with bars, and words.
 *
 * The caller lays panels out; lines and points belong to the last of them. Axes are linear or logarithmic, with ticks
 * at round numbers. A class is a colour: one of six for lines, which also differ by their markers, or a verdict's.
 * Readers who lack one kind of cone can tell the colours apart.
 *
 * Tests: test_report.c, test_equal_time.c.
 */
#ifndef ASBDPT_LAB_PLOT_H
#define ASBDPT_LAB_PLOT_H

#include <stdbool.h>
#include <stdio.h>

enum { AXIS_MAX_TICKS = 32 };

struct plot_axis {
    bool logarithmic;
    double low, high; /* low < high; both > 0 when logarithmic */
    double tick[AXIS_MAX_TICKS]; /* [n_ticks] within the axis, rising */
    int n_ticks;
};

/* axis_make: an axis that holds [low, high] with a margin, wider if both are the same; from 1 to 10 if low > high, as
 * nothing is shown then. Ticks are 1, 2 or 5 times a power of ten apart, or at such numbers on a logarithmic axis.
 * axis_position: from 0 to 1 within the axis. */
struct plot_axis axis_make(bool logarithmic, double low, double high);
double axis_position(const struct plot_axis *a, double value);

struct plot {
    FILE *f;
    int left, top, width, height; /* of the last panel */
    struct plot_axis x, y;
};

struct plot plot_begin(FILE *f, int width, int height, const char *title);
void plot_end(struct plot *p);

/* plot_panel: a frame at (left, top) with numbers at the ticks of both axes and the axes' names, which may be "". */
void plot_panel(struct plot *p, int left, int top, int width, int height, const char *x_label, const char *y_label);

/* plot_line: through n points; those that an axis cannot show are left out. plot_point: a marker, what it says when
 * pointed at, and a bar from low to high, along x if `across`; NaN: no bar. What is beyond the panel is drawn at its
 * edge. plot_text: words at a place of the figure. anchor: "start", "middle" or "end"; turn: degrees. */
void plot_line(struct plot *p, int colour, int n, const double *x, const double *y);
void plot_point(struct plot *p, const char *class, int marker, double x, double y, double low, double high, bool across,
                const char *title);
void plot_text(struct plot *p, int x, int y, const char *anchor, int turn, const char *text);

/* plot_key: a line's sample at a place of the figure, with its name. plot_colour: the class of line number k. */
void plot_key(struct plot *p, int colour, int x, int y, const char *text);
const char *plot_colour(int k);

#endif
