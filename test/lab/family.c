/* family.c: see family.h. */
#include "lab/family.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/maths.h"
#include "base/mem.h"
#include "image/image.h"
#include "lab/figures.h"
#include "lab/table.h"
#include "lab/compare.h"
#include "lab/markup.h"
#include "lab/sheet.h"

/* "subspaces" of "asbdpt:select=subspaces". */
static const char *short_name(const struct equal_time *e, int method)
{
    const char *text = e->plan->methods.item[method].text, *select = strstr(text, "select=");
    return select != NULL ? select + strlen("select=") : text;
}

/* --- tables ------------------------------------------------------------------------------------------ */

/* Samples of a method over those of the first, geometric mean over scenes: its price. */
static double price(const struct equal_time *e, int method)
{
    double sum = 0;
    for (const struct equal_scene *s = e->scene; s < e->scene + e->n_scenes; s++)
        for (int i = 0; i < e->plan->n_seeds; i++)
            sum += m_log((double)s->render[0][i].spp / (double)s->render[method][i].spp);
    return m_exp(sum / (e->n_scenes * e->plan->n_seeds));
}

/* A ratio and what it is of. */
static void add_of(struct table *t, double ratio, const char *of)
{
    if (isfinite(ratio))
        table_add(t, ratio, "%.3g %s", ratio, of);
    else
        table_add_missing(t, 1);
}

static void summary_table(FILE *f, const struct equal_time *e)
{
    struct table t;
    table_begin(&t, "Squared error over that of %s after the same CPU time: geometric means over scenes, and the ends "
                    "of rmse8; below 1 is a gain. Price: time of a sample over that of %s", short_name(e, 0),
                short_name(e, 0));
    table_column(&t, "method");
    table_column(&t, "price");
    for (int k = 0; k < N_EQUAL_ERRORS; k++)
        table_column(&t, "%s", EQUAL_NAMES[k]);
    table_column(&t, "best");
    table_column(&t, "worst");
    for (int v = 1; v < e->plan->methods.n; v++) {
        struct equal_summary s[N_EQUAL_ERRORS];
        char of[32];
        table_add(&t, NAN, "%s", short_name(e, v));
        table_add(&t, price(e, v), "%.2f", price(e, v));
        for (int k = 0; k < N_EQUAL_ERRORS; k++) {
            s[k] = equal_summarize(e, v, (enum equal_error)k);
            snprintf(of, sizeof of, "of %d", s[k].n);
            add_of(&t, s[k].mean, of);
        }
        add_of(&t, s[0].best, s[0].best_scene);
        add_of(&t, s[0].worst, s[0].worst_scene);
    }
    table_markdown(f, &t);
    table_free(&t);
}

static void ratio_table(FILE *f, const struct equal_time *e, enum equal_error which)
{
    struct table t;
    table_begin(&t, "%s: squared error over that of %s, with its 95 %% interval over %d seed%s", EQUAL_NAMES[which],
                short_name(e, 0), e->plan->n_seeds, e->plan->n_seeds == 1 ? "" : "s");
    table_column(&t, "scene");
    for (int v = 1; v < e->plan->methods.n; v++)
        table_column(&t, "%s", short_name(e, v));
    for (const struct equal_scene *s = e->scene; s < e->scene + e->n_scenes; s++) {
        table_add(&t, NAN, "%s, %dx%d", s->name, s->width, s->height);
        for (int v = 1; v < e->plan->methods.n; v++)
            table_add_interval(&t, equal_ratio(e, s, v, which));
    }
    table_markdown(f, &t);
    table_free(&t);
}

void family_tables(FILE *f, const struct equal_time *e)
{
    fputs("# The family at equal time\n\n", f);
    summary_table(f, e);
    fputs("![Ratios of all methods in all scenes](family.svg)\n\n![Crops of all pictures](family.png)\n\n", f);
    for (int k = 0; k < N_EQUAL_ERRORS; k++)
        ratio_table(f, e, (enum equal_error)k);
    equal_notes(f, e);
}

/* --- the figure -------------------------------------------------------------------------------------- */

enum { LEFT = 96, TOP = 156, ROW = 20, COLUMN = 72, PANEL = 64, LEAST_WIDTH = 680, BELOW = 60 };
static const double LEAST = 0.05, MOST = 20; /* ratios outside stand at the edge */

static double place(const struct plot_axis *a, int column, double ratio)
{
    return LEFT + column * COLUMN + PANEL * axis_position(a, clamp(ratio, a->low, a->high));
}

/* A panel's frame: a line for each power of ten. */
static void write_panel(FILE *f, const struct equal_time *e, const struct plot_axis *a, int column, int bottom)
{
    int x = LEFT + column * COLUMN;
    double tick[AXIS_MAX_TICKS];
    bool major[AXIS_MAX_TICKS];
    int n = axis_ticks(a, tick, major);
    xml_print(f, "<text transform=\"translate(%d %d) rotate(-40)\">%s</text>\n", x + PANEL / 2, TOP - 8,
              e->scene[column].name);
    for (int i = 0; i < n; i++) {
        double power = m_log10(tick[i]), at = place(a, column, tick[i]);
        if (fabs(power - floor(power + 0.5)) < 1e-9)
            fprintf(f, "<path class=\"%s\" d=\"M%.1f %dV%d\"/>\n<text class=\"n\" x=\"%.1f\" y=\"%d\">%g</text>\n",
                    fabs(power) < 0.5 ? "one" : "grid", at, TOP, bottom, at, bottom + 12, tick[i]);
    }
}

/* A method in a scene: its interval, its ratio, and hollow that of means over 8x8 pixels. */
static void write_ratio(FILE *f, const struct equal_time *e, const struct plot_axis *a, int column, int method)
{
    const struct equal_scene *s = &e->scene[column];
    struct interval r = equal_ratio(e, s, method, EQUAL_RMSE8);
    double blocks = equal_ratio(e, s, method, EQUAL_BLOCKS).value, y = TOP + ROW * (method - 0.5);
    const char *class = r.high < 1 ? "gain" : r.low > 1 ? "loss" : "open";
    if (isfinite(r.value) && isfinite(r.high))
        fprintf(f, "<path class=\"%s\" d=\"M%.1f %.1fH%.1f\"/>\n", class, place(a, column, r.low), y,
                place(a, column, r.high));
    if (isfinite(r.value))
        fprintf(f, "<circle class=\"%s\" cx=\"%.1f\" cy=\"%.1f\" r=\"3.2\"><title>%.3g</title></circle>\n", class,
                place(a, column, r.value), y, r.value);
    if (isfinite(blocks))
        fprintf(f, "<path class=\"blocks\" d=\"M%.1f %.1fl4 4l-4 4l-4 -4z\"/>\n", place(a, column, blocks), y - 4);
}

void family_figure(FILE *f, const struct equal_time *e)
{
    struct plot_axis axis = axis_make(true, LEAST, MOST);
    int methods = e->plan->methods.n, bottom = TOP + ROW * (methods - 1), width = LEFT + 110 + COLUMN * e->n_scenes;
    width = width < LEAST_WIDTH ? LEAST_WIDTH : width;
    xml_print(f, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\" height=\"%d\" "
              "role=\"img\" aria-labelledby=\"t\" font-family=\"system-ui,sans-serif\" font-size=\"12\">\n<title "
              "id=\"t\">Squared error over that of %s after the same CPU time</title>\n", width, bottom + BELOW, width,
              bottom + BELOW, short_name(e, 0));
    fputs("<style>path{fill:none;stroke-width:1.6}.grid{stroke:#ddd;stroke-width:1}.one{stroke:#555;stroke-width:1}"
          ".n{font-size:9px;text-anchor:middle}circle.gain{fill:#0b62a8}path.gain{stroke:#0b62a8}"
          "circle.loss{fill:#b3400a}path.loss{stroke:#b3400a}circle.open{fill:#3d444d}path.open{stroke:#3d444d}"
          ".blocks{stroke:#12733a;stroke-width:1}.m{text-anchor:end}</style>\n"
          "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n", f);
    for (int c = 0; c < e->n_scenes; c++)
        write_panel(f, e, &axis, c, bottom);
    for (int v = 1; v < methods; v++) {
        xml_print(f, "<text class=\"m\" x=\"%d\" y=\"%d\">%s</text>\n", LEFT - 8, TOP + ROW * v - 6, short_name(e, v));
        for (int c = 0; c < e->n_scenes; c++)
            write_ratio(f, e, &axis, c, v);
    }
    xml_print(f, "<text x=\"8\" y=\"%d\">Squared error over that of %s after the same CPU time: left of the line is a "
              "gain.</text>\n<text x=\"8\" y=\"%d\">Dot and bar: rmse8, its 95 %s interval; diamond: means over 8x8 "
              "pixels; what is beyond stands at the edge.</text>\n</svg>\n", bottom + 34, short_name(e, 0),
              bottom + 50, "%");
}

/* --- the strip of crops ------------------------------------------------------------------------------ */

enum { CROP = 48, SCALE = 2, GAP = 6, NAMES = 22 };

/* The middle of a picture of the scene, in column method + 1; nothing where it was not kept. */
static void paste_crop(const struct equal_time *e, const struct equal_scene *s, int method, struct sheet *sheet, int y)
{
    char path[4096];
    int width, height;
    float crop[CROP * CROP * 3], *pixels;
    equal_picture(e, s, method, path, sizeof path);
    if ((pixels = image_read_linear(path, &width, &height, NULL, NULL)) == NULL)
        return;
    int w = width < CROP ? width : CROP, h = height < CROP ? height : CROP;
    for (int row = 0; row < h; row++)
        memcpy(crop + 3 * w * row, pixels + 3 * ((height - h) / 2 + row) * width + 3 * ((width - w) / 2),
               (size_t)w * 3 * sizeof *crop);
    sheet_paste(sheet, GAP + (method + 1) * (CROP * SCALE + GAP), y, crop, w, h, SCALE);
    free(pixels);
}

bool family_strip(const struct equal_time *e, struct error *err)
{
    struct sheet sheet;
    char path[4096];
    int methods = e->plan->methods.n, row = CROP * SCALE + NAMES;
    sheet_init(&sheet, GAP + (methods + 1) * (CROP * SCALE + GAP), NAMES + row * e->n_scenes, SHEET_PAPER);
    for (int v = -1; v < methods; v++)
        sheet_text(&sheet, GAP + (v + 1) * (CROP * SCALE + GAP), GAP, 1, SHEET_INK,
                   v < 0 ? "reference" : short_name(e, v));
    for (int i = 0; i < e->n_scenes; i++) {
        sheet_text(&sheet, GAP, NAMES + row * i + GAP, 1, SHEET_INK, e->scene[i].name);
        for (int v = -1; v < methods; v++)
            paste_crop(e, &e->scene[i], v, &sheet, 2 * NAMES + row * i);
    }
    snprintf(path, sizeof path, "%s/family.png", e->plan->directory);
    bool ok = image_write(path, sheet.width, sheet.height, sheet.pixels, err);
    sheet_free(&sheet);
    return ok;
}

bool family_write(const struct equal_time *e, struct error *err)
{
    return equal_write_file(e, "family.csv", equal_csv, err) && equal_write_file(e, "family.md", family_tables, err) &&
           equal_write_file(e, "family.svg", family_figure, err) && family_strip(e, err);
}
