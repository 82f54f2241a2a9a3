/* plot.c: see plot.h. */
#include "lab/plot.h"

#include <math.h>

#include "base/maths.h"
#include "base/number.h"
#include "lab/markup.h"
#include "lab/numbers.h"

/* --- axes -------------------------------------------------------------------------------------------- */

static void linear_ticks(struct plot_axis *a)
{
    double raw = (a->high - a->low) / 8, power = m_pow(10, floor(log_ten(raw))), scaled = raw / power;
    double step = power * (scaled <= 1 ? 1 : scaled <= 2 ? 2 : scaled <= 5 ? 5 : 10);
    for (double i = ceil(a->low / step); i * step <= a->high && a->n_ticks < AXIS_MAX_TICKS; i++)
        a->tick[a->n_ticks++] = i * step;
}

/* At powers of ten, not all of them on a very long axis; on one of few powers also at 2 and 5, on a short one at every
 * digit. */
static void log_ticks(struct plot_axis *a)
{
    double decades = log_ten(a->high / a->low);
    int every = 1 + int_within(decades / 10, 0, 100);
    for (int power = int_within(floor(log_ten(a->low)), -324, 308); m_pow(10, power) <= a->high; power++)
        for (int digit = 1; digit <= 9; digit++) {
            double value = digit * m_pow(10, power);
            bool shown = decades < 0.7 || (digit == 1 && power % every == 0) ||
                         (decades < 2.2 && (digit == 2 || digit == 5));
            if (shown && value >= a->low && value <= a->high && a->n_ticks < AXIS_MAX_TICKS)
                a->tick[a->n_ticks++] = value;
        }
}

struct plot_axis axis_make(bool logarithmic, double low, double high)
{
    struct plot_axis a = {.logarithmic = logarithmic, .low = low <= high ? low : 1, .high = low <= high ? high : 10};
    if (logarithmic) {
        double margin = a.high > a.low ? m_pow(a.high / a.low, 0.06) : 1.5;
        a.low /= margin;
        a.high *= margin;
        log_ticks(&a);
    } else {
        double margin = a.high > a.low ? 0.06 * (a.high - a.low) : fmax(fabs(a.high), 1) * 0.1;
        a.low -= margin;
        a.high += margin;
        linear_ticks(&a);
    }
    return a;
}

double axis_position(const struct plot_axis *a, double value)
{
    if (a->logarithmic)
        return m_log(value / a->low) / m_log(a->high / a->low);
    return (value - a->low) / (a->high - a->low);
}

/* A place within the panel; what is beyond it is at its edge. */
static double place_x(const struct plot *p, double x)
{
    return p->left + p->width * axis_position(&p->x, clamp(x, p->x.low, p->x.high));
}

static double place_y(const struct plot *p, double y)
{
    return p->top + p->height * (1 - axis_position(&p->y, clamp(y, p->y.low, p->y.high)));
}

/* --- the figure -------------------------------------------------------------------------------------- */

enum { COLOURS = 6 };

const char *plot_colour(int k)
{
    static const char *const names[COLOURS] = {"c0", "c1", "c2", "c3", "c4", "c5"};
    return names[k % COLOURS];
}

struct plot plot_begin(FILE *f, int width, int height, const char *title)
{
    static const char *const colours[][2] = {
        {"c0", "#3d444d"}, {"c1", "#b3400a"}, {"c2", "#0b62a8"}, {"c3", "#12733a"}, {"c4", "#8b00e0"},
        {"c5", "#8a6a00"}, {"gain", "#0b62a8"}, {"loss", "#b3400a"}, {"open", "#3d444d"}, {"marked", "#b3400a"},
        {"scene", "#a8b0ba"}};
    struct plot p = {.f = f};
    xml_print(f, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\" height=\"%d\" "
              "role=\"img\" aria-labelledby=\"t\" font-family=\"system-ui,sans-serif\" font-size=\"12\">\n<title "
              "id=\"t\">%s</title>\n<style>path{fill:none;stroke-width:1.6}.grid{stroke:#ddd;stroke-width:1}"
              ".frame{stroke:#555;stroke-width:1}.number{font-size:10px}", width, height, width, height, title);
    for (size_t i = 0; i < sizeof colours / sizeof colours[0]; i++)
        xml_print(f, "path.%s{stroke:%s}path.m.%s{fill:%s}", colours[i][0], colours[i][1], colours[i][0],
                  colours[i][1]);
    fputs("path.m.marked,path.m.hollow{fill:#fff}</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n", f);
    return p;
}

void plot_end(struct plot *p) { fputs("</svg>\n", p->f); }

void plot_text(struct plot *p, int x, int y, const char *anchor, int turn, const char *text)
{
    xml_print(p->f, "<text transform=\"translate(%d %d) rotate(%d)\" text-anchor=\"%s\">%s</text>\n", x, y, turn,
              anchor, text);
}

void plot_panel(struct plot *p, int left, int top, int width, int height, const char *x_label, const char *y_label)
{
    p->left = left;
    p->top = top;
    p->width = width;
    p->height = height;
    for (int i = 0; i < p->x.n_ticks; i++) {
        double at = place_x(p, p->x.tick[i]);
        xml_print(p->f, "<path class=\"%s\" d=\"M%.1f %dv%d\"/><text class=\"number\" text-anchor=\"middle\" "
                  "x=\"%.1f\" y=\"%d\">%.6g</text>\n", p->x.tick[i] - 1 == 0 ? "frame" : "grid", at, top, height, at,
                  top + height + 13, p->x.tick[i]);
    }
    for (int i = 0; i < p->y.n_ticks; i++) {
        double at = place_y(p, p->y.tick[i]);
        xml_print(p->f, "<path class=\"%s\" d=\"M%d %.1fh%d\"/><text class=\"number\" text-anchor=\"end\" "
                  "x=\"%d\" y=\"%.1f\">%.6g</text>\n", p->y.tick[i] - 0 == 0 ? "frame" : "grid", left, at, width,
                  left - 4, at + 4, p->y.tick[i] - 0 == 0 ? 0 : p->y.tick[i]);
    }
    fprintf(p->f, "<path class=\"frame\" d=\"M%d %dv%dh%d\"/>\n", left, top, height, width);
    plot_text(p, left + width / 2, top + height + 28, "middle", 0, x_label);
    plot_text(p, left - 44, top + height / 2, "middle", -90, y_label);
}

/* Can the panel's axes show it? */
static bool drawable(const struct plot *p, double x, double y)
{
    return isfinite(x) && isfinite(y) && (!p->x.logarithmic || x > 0) && (!p->y.logarithmic || y > 0);
}

void plot_line(struct plot *p, int colour, int n, const double *x, const double *y)
{
    char step = 'M';
    fprintf(p->f, "<path class=\"%s\" d=\"", plot_colour(colour));
    for (int i = 0; i < n; i++)
        if (drawable(p, x[i], y[i])) {
            fprintf(p->f, "%c%.1f %.1f", step, place_x(p, x[i]), place_y(p, y[i]));
            step = 'L';
        }
    fputs("\"/>\n", p->f);
}

/* Marker number k: circle, square, triangle, diamond, and then all again, hollow. */
static void write_marker(struct plot *p, const char *class, int k, double x, double y, const char *title)
{
    static const char *const shape[] = {"m-3.4 0a3.4 3.4 0 1 0 6.8 0a3.4 3.4 0 1 0 -6.8 0z", "m-3 -3h6v6h-6z",
                                        "m0 -4l4 7h-8z", "m0 -4l4 4l-4 4l-4 -4z"};
    xml_print(p->f, "<path class=\"m %s%s\" d=\"M%.1f %.1f%s\"><title>%s</title></path>\n", class,
              k / 4 % 2 == 1 ? " hollow" : "", x, y, shape[k % 4], title);
}

void plot_point(struct plot *p, const char *class, int marker, double x, double y, double low, double high, bool across,
                const char *title)
{
    if (!drawable(p, x, y))
        return;
    if (isfinite(low) && isfinite(high) && across)
        fprintf(p->f, "<path class=\"%s\" d=\"M%.1f %.1fH%.1f\"/>\n", class, place_x(p, low), place_y(p, y),
                place_x(p, high));
    else if (isfinite(low) && isfinite(high))
        fprintf(p->f, "<path class=\"%s\" d=\"M%.1f %.1fV%.1f\"/>\n", class, place_x(p, x), place_y(p, low),
                place_y(p, high));
    write_marker(p, class, marker, place_x(p, x), place_y(p, y), title);
}

void plot_key(struct plot *p, int colour, int x, int y, const char *text)
{
    fprintf(p->f, "<path class=\"%s\" d=\"M%d %dh24\"/>\n", plot_colour(colour), x, y - 4);
    write_marker(p, plot_colour(colour), colour, x + 12, y - 4, text);
    plot_text(p, x + 30, y, "start", 0, text);
}
