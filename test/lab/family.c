/* family.c: see family.h. */
#include "lab/family.h"

#include <math.h>
#include <string.h>

#include "base/maths.h"
#include "base/number.h"
#include "lab/claims.h"
#include "lab/equal.h"
#include "lab/figures.h"
#include "lab/markup.h"
#include "lab/numbers.h"
#include "lab/sheet.h"
#include "lab/table.h"

/* The methods that a table or figure shows, the first of them that which all are compared with. */
struct view {
    int method[METHODS_MAX], n;
};

/* Those of a half, or all where there are no halves. */
static struct view view_of(const struct results *e, enum half half)
{
    struct view v = {.n = 0};
    for (int i = 0; i < e->plan->methods.n; i++)
        if (e->plan->methods.item[i].halves == 0 || (e->plan->methods.item[i].halves >> half & 1) != 0)
            v.method[v.n++] = i;
    return v;
}

static const char *label(const struct results *e, int method) { return e->plan->methods.item[method].label; }

static bool has_halves(const struct results *e)
{
    unsigned all = 0;
    for (int i = 0; i < e->plan->methods.n; i++)
        all |= e->plan->methods.item[i].halves;
    return all == 3;
}

/* --- tables ------------------------------------------------------------------------------------------ */

/* A ratio and what it is of. */
static void add_of(struct table *t, double ratio, const char *of)
{
    if (isfinite(ratio))
        table_add(t, ratio, "%.3g %s", ratio, of);
    else
        table_add_missing(t, 1);
}

static void summary_table(FILE *f, const struct results *e, enum half half)
{
    struct view view = view_of(e, half);
    struct table t;
    table_begin(&t, "Squared error over that of %s after the same CPU time: geometric mean over %d scene%s with "
                    "its 95 %% interval, and the ends of relmse; below 1 is a gain. Price: time of a sample over that "
                    "of %s",
                label(e, 0), e->plan->n_scenes, e->plan->n_scenes == 1 ? "" : "s", label(e, 0));
    table_column(&t, "method");
    table_column(&t, "price");
    for (int k = 0; k < N_SQUARES; k++)
        table_column(&t, "%s", EQUAL_NAMES[k]);
    table_column(&t, "best");
    table_column(&t, "worst");
    table_column(&t, "marked in");
    for (int i = 1; i < view.n; i++) {
        int v = view.method[i], n;
        struct equal_ends s = equal_ends(e, v, SQUARE_RELMSE);
        table_add(&t, NAN, "%s", label(e, v));
        table_add(&t, equal_price(e, v), "%.2f", equal_price(e, v));
        for (int k = 0; k < N_SQUARES; k++)
            table_add_interval(&t, equal_bootstrap(e, v, 0, (enum square)k, AT_EQUAL_TIME, NULL, &n));
        add_of(&t, s.best, s.best_scene);
        add_of(&t, s.worst, s.worst_scene);
        table_add(&t, results_marked(e, v), "%d", results_marked(e, v));
    }
    table_markdown(f, &t);
    table_free(&t);
}

static void ratio_table(FILE *f, const struct results *e, enum half half, enum square which)
{
    struct view view = view_of(e, half);
    struct table t;
    table_begin(&t, "%s: squared error over that of %s, with its 95 %% interval over %d seed%s", EQUAL_NAMES[which],
                label(e, 0), e->plan->n_seeds, e->plan->n_seeds == 1 ? "" : "s");
    table_column(&t, "method");
    for (const struct scene_results *s = e->scene; s < e->scene + e->plan->n_scenes; s++)
        table_column(&t, s->mark[0] == MARK_NONE ? "%s, %dx%d" : "%s, %dx%d (%s: %s)", s->name, s->width, s->height,
                     label(e, 0), MARKS[s->mark[0]]);
    for (int v = 1; v < view.n; v++) {
        table_add(&t, NAN, "%s", label(e, view.method[v]));
        for (int i = 0; i < e->plan->n_scenes; i++)
            table_add_marked(&t, equal_ratio(&e->scene[i], view.method[v], 0, which),
                             MARKS[e->scene[i].mark[view.method[v]]]);
    }
    table_markdown(f, &t);
    table_free(&t);
}

/* What was given, and what it came to. */
static void write_samples(FILE *f, const struct results *e)
{
    double spread = 0;
    for (const struct scene_results *s = e->scene; s < e->scene + e->plan->n_scenes; s++) {
        double seconds = (s->price[0].before + (double)equal_samples(s, 0)) * s->seconds;
        fprintf(f, "- %s: %.3g s of CPU; samples of each:", s->name, seconds);
        for (int v = 0; v < e->plan->methods.n; v++) {
            fprintf(f, "%s %ld", v > 0 ? "," : "", s->run[v][0].step[0].spp);
            spread = fmax(spread, s->price[v].spread);
        }
        fputs("\n", f);
    }
    fprintf(f, "\nPrices of a sample by rounds differ by %.0f %% at most.\n\n", 100 * spread);
}

/* What errors are against, and what the marks mean. */
static void write_light(FILE *f, const struct results *e)
{
    fputs("Errors are against a reference, whose own noise is subtracted as far as it is known. With two seeds or more "
          "each method's mean and blocks are tested against it. What is significantly darker misses light, what "
          "differs otherwise is biased. One page in a hundred has a false mark. With three seeds, and no reference "
          "given, errors of methods without a mark are half the squared differences of pairs of renders. ", f);
    for (const struct scene_results *s = e->scene; s < e->scene + e->plan->n_scenes; s++)
        if (s->lacks)
            fprintf(f, "Perhaps no method finds all light of %s, which has lights that nothing can hit and mirrors or "
                       "glass: there all errors are against the reference, by %s. ", s->name,
                    s->by != NULL ? s->by : "others");
}

static void write_notes(FILE *f, const struct results *e)
{
    fputs("rmse8: of the squared error of 8-bit values, which clip what is very bright; relmse: of the relative "
          "squared error of linear values; 8x8: the same of means over 8x8 pixels, which pixels that err together do "
          "not hide. ", f);
    write_light(f, e);
    fputs("Prices were measured by turns with the first method, on one thread, in three rounds, of which the medians "
          "count. Samples are those that the time affords, all that is prepared included.\n\n", f);
    write_samples(f, e);
    plan_write_command(f, e->plan);
}

/* What services bring to each method that has any: with them over without. */
static void services_table(FILE *f, const struct results *e)
{
    const struct methods *m = &e->plan->methods;
    struct table t;
    int n;
    table_begin(&t, "What services bring: squared error of a method with all of them over that of the same without, "
                    "after the same CPU time, geometric mean over scenes with its 95 %% interval");
    table_column(&t, "method");
    for (int k = 0; k < N_SQUARES; k++)
        table_column(&t, "%s", EQUAL_NAMES[k]);
    for (int v = 1; v < m->n; v++)
        for (int with = v + 1; with < m->n; with++)
            if (strcmp(m->item[v].label, m->item[with].label) == 0) {
                table_add(&t, NAN, "%s", m->item[v].label);
                for (int k = 0; k < N_SQUARES; k++)
                    table_add_interval(&t, equal_bootstrap(e, with, v, (enum square)k, AT_EQUAL_TIME, NULL, &n));
            }
    table_markdown(f, &t);
    table_free(&t);
}

static void write_half(FILE *f, const struct results *e, enum half half, const char *figure)
{
    summary_table(f, e, half);
    fprintf(f, "![Squared error over that of %s, methods in rows, scenes in columns, with intervals](%s)\n\n",
            label(e, 0), figure);
    for (int k = 0; k < N_SQUARES; k++)
        ratio_table(f, e, half, (enum square)k);
}

void family_tables(FILE *f, const struct results *e)
{
    bool both = has_halves(e);
    for (int h = 0; both && h < N_HALVES; h++) {
        fprintf(f, "## %s\n\n", HALVES[h]);
        write_half(f, e, (enum half)h, h == HALF_CHOICE ? "family-choice.svg" : "family.svg");
        claims_table(f, e, (enum half)h);
    }
    if (both)
        services_table(f, e);
    else
        write_half(f, e, HALF_SERVICES, "family.svg");
    fputs("![The middle of each picture](family.png)\n\n", f);
    write_notes(f, e);
}

/* --- the figure -------------------------------------------------------------------------------------- */

enum { LEFT = 264, TOP = 132, ROW = 20, COLUMN = 72, PANEL = 64, LEAST_WIDTH = 680, BELOW = 60 };
static const double LEAST = 0.05, MOST = 20; /* ratios outside stand at the edge */

static double place(const struct plot_axis *a, int column, double ratio)
{
    return LEFT + column * COLUMN + PANEL * axis_position(a, clamp(ratio, a->low, a->high));
}

/* A panel's frame: a line for each power of ten. */
static void write_panel(FILE *f, const struct results *e, const struct plot_axis *a, int column, int bottom)
{
    int x = LEFT + column * COLUMN;
    double tick[AXIS_MAX_TICKS];
    bool major[AXIS_MAX_TICKS];
    int n = axis_ticks(a, tick, major);
    xml_print(f, "<text transform=\"translate(%d %d) rotate(-40)\">%s</text>\n", x + PANEL / 2, TOP - 8,
              e->scene[column].name);
    for (int i = 0; i < n; i++) {
        double power = log_ten(tick[i]), at = place(a, column, tick[i]);
        if (fabs(power - floor(power + 0.5)) < 1e-9)
            fprintf(f, "<path class=\"%s\" d=\"M%.1f %dV%d\"/>\n<text class=\"n\" x=\"%.1f\" y=\"%d\">%g</text>\n",
                    fabs(power) < 0.5 ? "one" : "grid", at, TOP, bottom, at, bottom + 12, tick[i]);
    }
}

/* A method in a scene: its interval, its ratio, and hollow that of means over 8x8 pixels. */
static void write_ratio(FILE *f, const struct scene_results *s, const struct plot_axis *a, int column, int row,
                        int method)
{
    struct interval r = equal_ratio(s, method, 0, SQUARE_RELMSE);
    double blocks = equal_ratio(s, method, 0, SQUARE_BLOCKS).value, y = TOP + ROW * (row - 0.5);
    bool marked = s->mark[method] != MARK_NONE;
    const char *class = marked ? "marked" : r.high < 1 ? "gain" : r.low > 1 ? "loss" : "open";
    if (isfinite(r.value) && isfinite(r.high))
        fprintf(f, "<path class=\"%s\" d=\"M%.1f %.1fH%.1f\"/>\n", class, place(a, column, r.low), y,
                place(a, column, r.high));
    if (isfinite(r.value))
        fprintf(f, "<circle class=\"%s\" cx=\"%.1f\" cy=\"%.1f\" r=\"3.2\"><title>%.3g %s</title></circle>\n", class,
                place(a, column, r.value), y, r.value, MARKS[s->mark[method]]);
    if (isfinite(blocks))
        fprintf(f, "<path class=\"blocks\" d=\"M%.1f %.1fl4 4l-4 4l-4 -4z\"/>\n", place(a, column, blocks), y - 4);
}

static void write_figure(FILE *f, const struct results *e, enum half half)
{
    struct view view = view_of(e, half);
    struct plot_axis axis = axis_make(true, LEAST, MOST);
    int bottom = TOP + ROW * (view.n - 1);
    int width = LEFT + 56 + COLUMN * e->plan->n_scenes;
    width = width < LEAST_WIDTH ? LEAST_WIDTH : width;
    xml_print(f, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\" height=\"%d\" "
              "role=\"img\" aria-labelledby=\"t\" font-family=\"system-ui,sans-serif\" font-size=\"12\">\n<title "
              "id=\"t\">Squared error over that of %s after the same CPU time</title>\n", width, bottom + BELOW, width,
              bottom + BELOW, label(e, 0));
    fputs("<style>path{fill:none;stroke-width:1.6}.grid{stroke:#ddd;stroke-width:1}.one{stroke:#555;stroke-width:1}"
          ".n{font-size:9px;text-anchor:middle}circle.gain{fill:#0b62a8}path.gain{stroke:#0b62a8}"
          "circle.loss{fill:#b3400a}path.loss{stroke:#b3400a}circle.open{fill:#3d444d}path.open{stroke:#3d444d}"
          "circle.marked{fill:#fff;stroke:#b3400a}path.marked{stroke:#b3400a}"
          ".blocks{stroke:#12733a;stroke-width:1}.m{text-anchor:end}</style>\n"
          "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n", f);
    for (int c = 0; c < e->plan->n_scenes; c++)
        write_panel(f, e, &axis, c, bottom);
    for (int v = 1; v < view.n; v++) {
        xml_print(f, "<text class=\"m\" x=\"%d\" y=\"%d\">%s</text>\n", LEFT - 8, TOP + ROW * v - 6,
                  label(e, view.method[v]));
        for (int c = 0; c < e->plan->n_scenes; c++)
            write_ratio(f, &e->scene[c], &axis, c, v, view.method[v]);
    }
    xml_print(f, "<text x=\"8\" y=\"%d\">Squared error over that of %s after the same CPU time: left of the line is a "
              "gain.</text>\n<text x=\"8\" y=\"%d\">Dot and bar: relmse, its 95 %s interval; diamond: means over 8x8 "
              "pixels; hollow: misses light or biased.</text>\n</svg>\n", bottom + 34, label(e, 0), bottom + 50, "%");
}

static void family_choice_figure(FILE *f, const struct results *e) { write_figure(f, e, HALF_CHOICE); }
void family_figure(FILE *f, const struct results *e) { write_figure(f, e, HALF_SERVICES); }

/* --- the strip of crops ------------------------------------------------------------------------------ */

enum { CROP = 48, SCALE = 2, GAP = 6, NAMES = 22 };

/* The middle of a picture, in this column; nothing where there is none. */
static void paste_crop(const float *pixels, int width, int height, struct sheet *sheet, int column, int y)
{
    float crop[CROP * CROP * 3];
    int w = width < CROP ? width : CROP, h = height < CROP ? height : CROP;
    for (int row = 0; pixels != NULL && row < h; row++)
        memcpy(crop + 3 * w * row, pixels + 3 * ((height - h) / 2 + row) * width + 3 * ((width - w) / 2),
               (size_t)w * 3 * sizeof *crop);
    if (pixels != NULL)
        sheet_paste(sheet, GAP + column * (CROP * SCALE + GAP), y, crop, w, h, SCALE);
}

static bool write_strip(const struct results *e, struct error *err)
{
    struct sheet sheet;
    struct view view = view_of(e, HALF_SERVICES);
    int row = CROP * SCALE + NAMES;
    sheet_init(&sheet, GAP + (view.n + 1) * (CROP * SCALE + GAP), NAMES + row * e->plan->n_scenes, SHEET_PAPER);
    for (int v = -1; v < view.n; v++)
        sheet_text(&sheet, GAP + (v + 1) * (CROP * SCALE + GAP), GAP, 1, SHEET_INK,
                   v < 0 ? "reference" : label(e, view.method[v]));
    for (int i = 0; i < e->plan->n_scenes; i++) {
        const struct scene_results *s = &e->scene[i];
        sheet_text(&sheet, GAP, NAMES + row * i + GAP, 1, SHEET_INK, s->name);
        for (int v = -1; v < view.n; v++)
            paste_crop(v < 0 ? s->reference.pixels : s->image[view.method[v]], s->width, s->height, &sheet, v + 1,
                       2 * NAMES + row * i);
    }
    return sheet_write(&sheet, e->plan->directory, "family.png", err);
}

bool family_write(const struct results *r, const char *page, struct error *err)
{
    return results_write(r, "runs.csv", results_runs_csv, err) && results_write(r, page, family_tables, err) &&
           results_write(r, "family.svg", family_figure, err) &&
           (!has_halves(r) || results_write(r, "family-choice.svg", family_choice_figure, err)) && write_strip(r, err);
}
