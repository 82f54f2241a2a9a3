/* strategies.c: see strategies.h. */
#include "lab/strategies.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/maths.h"
#include "base/mem.h"
#include "base/number.h"
#include "lab/compare.h"
#include "lab/sheet.h"

int strategy_count(int max_depth) { return strategy_index(0, max_depth + 3); }

/* Paths of n = s + t vertices have n strategies (t = 1 .. n) and come after the 2 + ... + (n-1) of shorter ones. */
int strategy_index(int s, int t)
{
    int n = s + t;
    return n * (n - 1) / 2 - 1 + s;
}

void strategies_init(struct strategy_images *images, struct pixel_rect rect, int max_depth)
{
    size_t n = rect_pixels(rect) * 3 * (size_t)strategy_count(max_depth);
    const struct strategy_images black = {max_depth, rect, 0, mem_alloc(n, sizeof(double)),
                                          mem_alloc(n, sizeof(double))};
    *images = black;
}

void strategies_free(struct strategy_images *images)
{
    free(images->unweighted);
    free(images->weighted);
}

static void take(void *context, const struct path_told *p, size_t pixel, double factor)
{
    struct strategy_images *images = context;
    size_t at = 3 * ((size_t)strategy_index(p->s, p->t) * rect_pixels(images->rect) + pixel);
    for (size_t c = 0; c < 3; c++) {
        double unweighted = (double)p->unweighted[c] * factor;
        images->unweighted[at + c] += unweighted;
        images->weighted[at + c] += unweighted * (double)p->weight;
    }
}

bool strategies_render(const struct scene *scene, const struct render_job *options, struct strategy_images *images,
                       struct error *err)
{
    const struct path_taker taker = {images, take};
    struct film film;
    film_init(&film, images->rect, scene->width, scene->height);
    bool ok = paths_render(scene, options, &film, &taker, err);
    images->iterations += film.iterations;
    film_free(&film);
    return ok;
}

float *strategies_picture(const struct strategy_images *images, double scale, int s, int t, bool weighted)
{
    size_t n = rect_pixels(images->rect) * 3;
    const double *sum = weighted ? images->weighted : images->unweighted;
    float *out = mem_alloc(n, sizeof *out);
    sum += n * (size_t)strategy_index(s, t);
    for (size_t i = 0; i < n; i++)
        out[i] = float_within(scale * sum[i] / (double)images->iterations);
    return out;
}

/* --- the pyramid ----------------------------------------------------------------------------------------- */

enum { GAP = 4, LEFT = 88, TOP = 40, SHEET_WIDTH = 1024, CELL_MIN = 48, CELL_MAX = 192 };
static const double PERCENTILE = 90; /* of a row's lit values that stay below white */

/* How strategies are laid out: pictures of one size, shrunk or enlarged by whole factors. */
struct layout {
    int first, depth; /* the rows: from the first that holds light */
    int columns;
    int shrink, enlarge;
    int width, height; /* of a cell */
    double scale;      /* of the images' values */
};

static struct layout lay_out(const struct strategy_images *images, double scale)
{
    int w = rect_width(images->rect), h = rect_height(images->rect), depth = images->max_depth;
    struct layout l = {.depth = depth < PYRAMID_DEPTH ? depth : PYRAMID_DEPTH, .scale = scale};
    l.columns = l.depth + 2;
    int wanted = (SHEET_WIDTH - LEFT) / l.columns - GAP;
    wanted = wanted < CELL_MIN ? CELL_MIN : wanted > CELL_MAX ? CELL_MAX : wanted;
    l.shrink = w > wanted ? (w + wanted / 2) / wanted : 1; /* to the nearest */
    l.shrink = l.shrink < h ? l.shrink : h;                /* a picture may be wide and low */
    l.enlarge = w < wanted ? wanted / w : 1;
    l.width = w / l.shrink * l.enlarge;
    l.height = h / l.shrink * l.enlarge;
    return l;
}

/* The value that most of the sum of a row's weighted shares is below, where there is light; 0 without light. */
static double row_brightness(const struct layout *l, const struct strategy_images *images, int depth)
{
    size_t n = rect_pixels(images->rect) * 3;
    float *total = mem_alloc(n, sizeof *total);
    for (int s = 0; s <= depth + 1; s++) {
        float *share = strategies_picture(images, l->scale, s, depth + 2 - s, true);
        for (size_t i = 0; i < n; i++)
            total[i] += share[i];
        free(share);
    }
    long lit = 0; /* what is black would have any exposure */
    for (size_t i = 0; i < n; i++)
        if (total[i] > 0)
            total[lit++] = total[i];
    double bright = picture_percentile(total, lit, PERCENTILE);
    free(total);
    return bright > 0 ? bright : 0;
}

/* The power of two, at least 1, that raises most of a row up to white. */
static double row_exposure(const struct layout *l, const struct strategy_images *images, int depth)
{
    double bright = row_brightness(l, images, depth);
    return bright > 0 && bright < 1 ? ldexp(1, int_within(floor(-m_log2(bright)), 0, 16)) : 1;
}

/* One pyramid, its top left at (0,y). */
static void draw_pyramid(struct sheet *sheet, const struct layout *l, const struct strategy_images *images, int y,
                         bool weighted)
{
    char text[100];
    sheet_text(sheet, GAP, y + GAP, 2, SHEET_INK, weighted ? "weighted: what each strategy adds"
                                                                    : "each strategy alone");
    for (int s = 0; s < l->columns; s++) {
        snprintf(text, sizeof text, "s=%d", s);
        sheet_text(sheet, LEFT + s * (l->width + GAP), y + TOP - FONT_HEIGHT - GAP, 1, SHEET_INK, text);
    }
    for (int depth = l->first; depth <= l->depth; depth++) {
        double exposure = row_exposure(l, images, depth);
        int top = y + TOP + (depth - l->first) * (l->height + GAP);
        snprintf(text, sizeof text, "%d bounce%s", depth, depth == 1 ? "" : "s");
        sheet_text(sheet, GAP, top, 1, SHEET_INK, text);
        snprintf(text, sizeof text, "%.0fx brighter", exposure);
        sheet_text(sheet, GAP, top + FONT_HEIGHT + GAP, 1, SHEET_INK, exposure > 1 ? text : "");
        for (int s = 0; s <= depth + 1; s++) {
            float *whole = strategies_picture(images, l->scale, s, depth + 2 - s, weighted);
            sheet_cell(sheet, LEFT + s * (l->width + GAP), top, whole, rect_width(images->rect),
                       rect_height(images->rect), l->shrink, l->enlarge, exposure);
            free(whole);
        }
    }
}

bool pyramid_write(const char *directory, const struct strategy_images *images, double scale, struct error *err)
{
    struct layout l = lay_out(images, scale);
    struct sheet sheet;
    while (l.first < l.depth && row_brightness(&l, images, l.first) <= 0)
        l.first++;
    int half = TOP + (l.depth + 1 - l.first) * (l.height + GAP);
    sheet_init(&sheet, LEFT + l.columns * (l.width + GAP), 2 * half, SHEET_PAPER);
    draw_pyramid(&sheet, &l, images, 0, false);
    draw_pyramid(&sheet, &l, images, half, true);
    return sheet_write(&sheet, directory, "pyramid.png", err);
}
