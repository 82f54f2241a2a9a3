/* figures.c: see figures.h. */
#include "lab/figures.h"

#include <math.h>
#include <string.h>

#include "base/maths.h"
#include "base/number.h"
#include "lab/markup.h"
#include "lab/numbers.h"

/* The picture's size and the frame of the data in it, in SVG units. */
enum { WIDTH = 640, LEFT = 68, RIGHT = 624, TOP = 40, BOTTOM = 330 };
enum { MAX_LINES = METHODS_MAX };

/* One line of a plot: a method after a rising number of samples. */
struct plot_line {
    const char *label;
    int n;
    double x[PLAN_MAX_STEPS], y[PLAN_MAX_STEPS];
    double error[PLAN_MAX_STEPS]; /* half length of the error bar; NaN or 0: none */
};

/* The x axis is logarithmic, with ticks at numbers of samples or at round seconds; the y axis too, unless the quantity
 * has a sign. */
struct plot {
    char title[400];
    const char *x_label, *y_label;
    bool over_seconds, signed_y;
    int n;
    struct plot_line line[MAX_LINES];
};

/* --- what is shown ----------------------------------------------------------------------------------- */

static const struct {
    const char *name, *title, *x_label, *y_label;
} TEXTS[FIGURE_SWEEP + 1] = {
    {"convergence", "error against time", "seconds of CPU", "RMSE, 8-bit scale"},
    {"samples", "error against samples", "samples per pixel", "RMSE, 8-bit scale"},
    {"bias", "signed mean error against samples", "samples per pixel", "mean error, percent"},
    {"sweep", NULL, "samples per pixel", "RMSE, 8-bit scale"},
};

static int kind_of(int which) { return which < FIGURE_SWEEP ? which : FIGURE_SWEEP; }

void figure_path(const struct scene_results *s, int which, char *out, size_t size)
{
    char number[16] = "";
    if (which >= FIGURE_SWEEP)
        snprintf(number, sizeof number, "-%d", which - FIGURE_SWEEP + 1);
    snprintf(out, size, "plots/%s-%s%s.svg", s->name, TEXTS[kind_of(which)].name, number);
}

static void add_line(const struct scene_results *s, int method, struct plot *out)
{
    struct plot_line *l = &out->line[out->n++];
    double scale = out->signed_y ? 100 : 1; /* percent */
    l->label = s->plan->methods.item[method].text;
    l->n = s->plan->n_steps;
    for (int i = 0; i < l->n; i++) {
        struct estimate e = results_mean(s, method, i, out->signed_y ? Q_MEAN_ERROR : Q_RMSE8);
        l->x[i] = out->over_seconds ? results_mean(s, method, i, Q_SECONDS).mean : (double)s->plan->spp[i];
        l->y[i] = scale * e.mean;
        l->error[i] = scale * e.error;
    }
}

static void make_plot(const struct scene_results *s, int which, struct plot *out)
{
    int kind = kind_of(which);
    const struct sweep *sweep = which >= FIGURE_SWEEP ? &s->plan->sweep[which - FIGURE_SWEEP] : NULL;
    memset(out, 0, sizeof *out);
    snprintf(out->title, sizeof out->title, "%.255s: %.120s", s->name, sweep != NULL ? sweep->text : TEXTS[kind].title);
    out->x_label = TEXTS[kind].x_label;
    out->y_label = TEXTS[kind].y_label;
    out->over_seconds = kind == FIGURE_CONVERGENCE;
    out->signed_y = kind == FIGURE_BIAS;
    for (int v = 0; v < (sweep != NULL ? 1 : s->plan->n_compared); v++)
        add_line(s, v, out);
    for (int i = 0; sweep != NULL && i < sweep->n; i++)
        add_line(s, sweep->method[i], out);
}

/* --- axes -------------------------------------------------------------------------------------------- */

struct plot_axis axis_make(bool logarithmic, double low, double high)
{
    struct plot_axis a = {logarithmic, low, high};
    if (logarithmic) {
        double margin = high > low ? m_pow(high / low, 0.06) : 1.5;
        a.low = low / margin;
        a.high = high * margin;
    } else {
        double margin = high > low ? 0.06 * (high - low) : fmax(fabs(high), 1) * 0.1;
        a.low = low - margin;
        a.high = high + margin;
    }
    return a;
}

double axis_position(const struct plot_axis *a, double value)
{
    if (a->logarithmic)
        return m_log(value / a->low) / m_log(a->high / a->low);
    return (value - a->low) / (a->high - a->low);
}

static int linear_ticks(const struct plot_axis *a, double tick[], bool major[])
{
    double raw = (a->high - a->low) / 8, power = m_pow(10, floor(log_ten(raw))), scaled = raw / power;
    double step = power * (scaled <= 1 ? 1 : scaled <= 2 ? 2 : scaled <= 5 ? 5 : 10);
    int n = 0;
    for (double i = ceil(a->low / step); i * step <= a->high && n < AXIS_MAX_TICKS; i++, n++) {
        tick[n] = i * step;
        major[n] = true;
    }
    return n;
}

/* Numbers stand at powers of ten, not all of them on a very long axis; on one of few powers also at 2 and 5, on a
 * short one at every digit. */
static int log_ticks(const struct plot_axis *a, double tick[], bool major[])
{
    double decades = log_ten(a->high / a->low);
    int n = 0, every = 1 + int_within(decades / 10, 0, 100);
    for (int power = int_within(floor(log_ten(a->low)), -324, 308); m_pow(10, power) <= a->high; power++)
        for (int digit = 1; digit <= 9; digit++) {
            double value = digit * m_pow(10, power);
            if (value < a->low || value > a->high || n >= AXIS_MAX_TICKS || (decades > 6 && digit != 1))
                continue;
            tick[n] = value;
            major[n] =
                decades < 0.7 || (digit == 1 && power % every == 0) || (decades < 2.2 && (digit == 2 || digit == 5));
            n++;
        }
    return n;
}

int axis_ticks(const struct plot_axis *a, double tick[AXIS_MAX_TICKS], bool major[AXIS_MAX_TICKS])
{
    return a->logarithmic ? log_ticks(a, tick, major) : linear_ticks(a, tick, major);
}

/* --- the frame --------------------------------------------------------------------------------------- */

static bool drawable(const struct plot *p, double x, double y)
{
    return isfinite(x) && isfinite(y) && x > 0 && (p->signed_y || y > 0);
}

/* The ends of an error bar; on a logarithmic axis the lower must not reach 0. */
static void bar_ends(const struct plot *p, const struct plot_line *l, int i, double *low, double *high)
{
    double e = isfinite(l->error[i]) ? l->error[i] : 0;
    *high = l->y[i] + e;
    *low = p->signed_y ? l->y[i] - e : fmax(l->y[i] - e, 0.2 * l->y[i]);
}

static void find_axes(const struct plot *p, struct plot_axis *x_axis, struct plot_axis *y_axis)
{
    double x0 = HUGE_VAL, x1 = -HUGE_VAL, y0 = HUGE_VAL, y1 = -HUGE_VAL;
    for (const struct plot_line *l = p->line; l < p->line + p->n; l++)
        for (int i = 0; i < l->n; i++) {
            double low, high;
            if (!drawable(p, l->x[i], l->y[i]))
                continue;
            bar_ends(p, l, i, &low, &high);
            x0 = fmin(x0, l->x[i]);
            x1 = fmax(x1, l->x[i]);
            y0 = fmin(y0, low);
            y1 = fmax(y1, high);
        }
    if (x0 > x1) { /* nothing to draw */
        x0 = y0 = 1;
        x1 = y1 = 10;
    }
    if (p->signed_y) { /* show 0 */
        y0 = fmin(y0, 0);
        y1 = fmax(y1, 0);
    }
    *x_axis = axis_make(true, x0, x1);
    *y_axis = axis_make(!p->signed_y, y0, y1);
}

static double screen_x(const struct plot_axis *a, double v) { return LEFT + (RIGHT - LEFT) * axis_position(a, v); }
static double screen_y(const struct plot_axis *a, double v) { return BOTTOM - (BOTTOM - TOP) * axis_position(a, v); }

static int x_ticks(const struct plot *p, const struct plot_axis *a, double tick[], bool major[])
{
    if (p->over_seconds)
        return axis_ticks(a, tick, major);
    for (int i = 0; i < p->line[0].n; i++) {
        tick[i] = p->line[0].x[i];
        major[i] = true;
    }
    return p->line[0].n;
}

static void write_x_axis(FILE *f, const struct plot *p, const struct plot_axis *a)
{
    double tick[AXIS_MAX_TICKS];
    bool major[AXIS_MAX_TICKS];
    int n = x_ticks(p, a, tick, major);
    for (int i = 0; i < n; i++) {
        double x = screen_x(a, tick[i]);
        fprintf(f, "<path class=\"%s\" d=\"M%.1f %dV%d\"/>\n", major[i] ? "pg" : "pm", x, TOP, BOTTOM);
        if (major[i])
            fprintf(f, "<text class=\"pt\" text-anchor=\"middle\" x=\"%.1f\" y=\"%d\">%.6g</text>\n", x, BOTTOM + 18,
                    tick[i]);
    }
    xml_print(f, "<text class=\"pt\" text-anchor=\"middle\" x=\"%d\" y=\"%d\">%s</text>\n", (LEFT + RIGHT) / 2,
              BOTTOM + 38, p->x_label);
}

static void write_y_axis(FILE *f, const struct plot *p, const struct plot_axis *a)
{
    double tick[AXIS_MAX_TICKS];
    bool major[AXIS_MAX_TICKS];
    int n = axis_ticks(a, tick, major);
    for (int i = 0; i < n; i++) {
        double y = screen_y(a, tick[i]);
        fprintf(f, "<path class=\"%s\" d=\"M%d %.1fH%d\"/>\n", major[i] ? "pg" : "pm", LEFT, y, RIGHT);
        if (major[i])
            fprintf(f, "<text class=\"pt\" text-anchor=\"end\" x=\"%d\" y=\"%.1f\">%.6g</text>\n", LEFT - 6, y + 4,
                    fabs(tick[i]) < 1e-12 ? 0 : tick[i]);
    }
    xml_print(f, "<text class=\"pt\" text-anchor=\"middle\" transform=\"translate(16 %d) rotate(-90)\">%s</text>\n",
              (TOP + BOTTOM) / 2, p->y_label);
    if (p->signed_y)
        fprintf(f, "<path class=\"pz\" d=\"M%d %.1fH%d\"/>\n", LEFT, screen_y(a, 0), RIGHT);
}

/* --- lines ------------------------------------------------------------------------------------------- */

/* Marker number k about (x,y): circle, square, triangle, diamond, and then all again, hollow. */
static void write_marker(FILE *f, int k, double x, double y)
{
    static const char *const shape[] = {"m-4 0a4 4 0 1 0 8 0a4 4 0 1 0 -8 0z", "m-3.6 -3.6h7.2v7.2h-7.2z",
                                        "m0 -4.8l4.6 8h-9.2z", "m0 -5l5 5l-5 5l-5 -5z"};
    fprintf(f, "<path class=\"pk%d%s\" d=\"M%.1f %.1f%s\"/>\n", k, k / 4 % 2 == 1 ? " ph" : "", x, y, shape[k % 4]);
}

static void write_line(FILE *f, const struct plot *p, int k, const struct plot_axis *xa, const struct plot_axis *ya)
{
    const struct plot_line *l = &p->line[k];
    char step = 'M';
    xml_print(f, "<g><title>%s</title>\n<path class=\"pl%d\" d=\"", l->label, k);
    for (int i = 0; i < l->n; i++)
        if (drawable(p, l->x[i], l->y[i])) {
            fprintf(f, "%c%.1f %.1f", step, screen_x(xa, l->x[i]), screen_y(ya, l->y[i]));
            step = 'L';
        }
    fputs(step == 'M' ? "M0 0\"/>\n" : "\"/>\n", f);
    for (int i = 0; i < l->n; i++) {
        if (!drawable(p, l->x[i], l->y[i]))
            continue;
        double low, high, x = screen_x(xa, l->x[i]);
        bar_ends(p, l, i, &low, &high);
        if (high > l->y[i]) {
            double a = screen_y(ya, low), b = screen_y(ya, high);
            fprintf(f, "<path class=\"pl%d pe\" d=\"M%.1f %.1fV%.1fm-3 0h6M%.1f %.1fh6\"/>\n", k, x, a, b, x - 3, a);
        }
        write_marker(f, k, x, screen_y(ya, l->y[i]));
    }
    fputs("</g>\n", f);
}

/* The legend fills rows below the plot. */
static void write_legend(FILE *f, const struct plot *p)
{
    for (int k = 0; k < p->n; k++) {
        int x = LEFT + (k % 2) * 285, y = BOTTOM + 60 + (k / 2) * 20;
        fprintf(f, "<path class=\"pl%d\" d=\"M%d %dh24\"/>\n", k, x, y - 4);
        write_marker(f, k, x + 12, y - 4);
        xml_print(f, "<text class=\"pt\" x=\"%d\" y=\"%d\">%s</text>\n", x + 30, y, p->line[k].label);
    }
}

/* --- the whole --------------------------------------------------------------------------------------- */

static void write_style(FILE *f, const struct plot *p)
{
    static const char *const colours[] = {"#3d444d", "#b3400a", "#0b62a8", "#12733a", "#8b00e0", "#8a6a00"};
    fputs("<style>\n.plot{color:#1b1f24;background:#fff;font:13px system-ui,sans-serif}\n"
          ".pt{fill:currentColor}.ptitle{fill:currentColor;font-weight:600;font-size:15px}\n"
          ".pg,.pm,.pz,.pf{stroke:currentColor;fill:none}.pg{stroke-opacity:.22}.pm{stroke-opacity:.08}\n"
          ".pz{stroke-opacity:.7;stroke-dasharray:2 3}.pf{stroke-opacity:.6}\n"
          "[class^=pl]{fill:none;stroke-width:2}.pe{stroke-width:1.3}.ph{fill:none!important}\n", f);
    for (int k = 0; k < p->n; k++)
        fprintf(f, ".pl%d{stroke:%s}.pk%d{fill:%s;stroke:%s}\n", k, colours[k % 6], k, colours[k % 6], colours[k % 6]);
    fputs("</style>\n", f);
}

/* What the plot shows at its right end, in words, for those who cannot see it. */
static void write_description(FILE *f, const struct plot *p)
{
    xml_print(f, "%s against %s. Last points:", p->y_label, p->x_label);
    for (int k = 0; k < p->n; k++) {
        const struct plot_line *l = &p->line[k];
        xml_print(f, "%s %s %.4g at %.4g", k > 0 ? "," : "", l->label, l->y[l->n - 1], l->x[l->n - 1]);
    }
}

void figure_write(FILE *f, const struct scene_results *s, int which)
{
    struct plot p;
    struct plot_axis xa, ya;
    make_plot(s, which, &p);
    find_axes(&p, &xa, &ya);
    int height = BOTTOM + 50 + 20 * ((p.n + 1) / 2);
    xml_print(f, "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" viewBox=\"0 0 %d %d\" width=\"%d\" "
              "height=\"%d\" role=\"img\" aria-labelledby=\"t d\">\n<title id=\"t\">%s</title>\n<desc id=\"d\">",
              WIDTH, height, WIDTH, height, p.title);
    write_description(f, &p);
    fputs("</desc>\n", f);
    write_style(f, &p);
    xml_print(f, "<text class=\"ptitle\" x=\"%d\" y=\"24\">%s</text>\n", LEFT, p.title);
    write_x_axis(f, &p, &xa);
    write_y_axis(f, &p, &ya);
    fprintf(f, "<path class=\"pf\" d=\"M%d %dV%dH%d\"/>\n", LEFT, TOP, BOTTOM, RIGHT);
    for (int k = 0; k < p.n; k++)
        write_line(f, &p, k, &xa, &ya);
    write_legend(f, &p);
    fputs("</svg>\n", f);
}
