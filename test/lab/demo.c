/* demo.c: see demo.h. */
#include "lab/demo.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/os.h"
#include "base/progress.h"
#include "look/compare.h"
#include "lab/equal_time.h"
#include "lab/plan_scene.h"
#include "lab/reference.h"

enum { GAP = 24, LABEL = 60, COLUMN = 480 };
static const double SOFT = 0.65; /* the grey of what matters less */

/* The demonstration under way. */
struct show {
    const struct demo *demo;
    struct scene scene;
    struct reference reference;
    int width, height, max_depth;
    float *picture[DEMO_SIDES]; /* owned */
    struct demo_side *side;     /* [DEMO_SIDES] */
    struct error *err;
};

/* --- rendering --------------------------------------------------------------------------------------- */

static bool render(struct show *s, int i, long spp)
{
    const struct demo *d = s->demo;
    struct render_options o = {.integrator = d->integrator[i], .seed = d->seed + (unsigned)i, .end = spp,
                               .n_threads = d->n_threads, .max_depth = s->max_depth};
    struct progress bar;
    struct film film;
    o.progress = progress_update;
    o.progress_context = &bar;
    film_init(&film, render_crop(&s->scene), s->width, s->height);
    progress_start(&bar, d->quiet);
    double start = os_cpu_seconds();
    bool ok = render_scene(&s->scene, &o, &film, s->err);
    s->side[i].seconds = fmax(os_cpu_seconds() - start, 1e-6);
    s->side[i].spp = spp;
    progress_end(&bar);
    if (ok)
        film_develop(&film, s->scene.film_scale, s->picture[i]);
    film_free(&film);
    return ok;
}

/* The second integrator's samples: what the first one's time has room for, by a short render, and corrected once if the
 * long one takes another time. */
static bool render_both(struct show *s)
{
    long calibration = s->demo->spp < EQUAL_CALIBRATION ? s->demo->spp : EQUAL_CALIBRATION;
    if (!render(s, 0, s->demo->spp) || !render(s, 1, calibration))
        return false;
    double target = s->side[0].seconds, growth = 1;
    for (int attempt = 0; attempt < 2; attempt++) {
        struct demo_side before = s->side[1];
        long spp = equal_samples(before.spp, before.seconds, growth, target);
        if (spp == before.spp || equal_met(before.seconds, target))
            break;
        if (!render(s, 1, spp))
            return false;
        growth = equal_growth(before.spp, before.seconds, spp, s->side[1].seconds);
    }
    return true;
}

/* The reference, and the scene at its size times the scale. */
static bool load_scene(struct show *s)
{
    const struct demo *d = s->demo;
    char name[256];
    struct reference *r = &s->reference;
    plan_scene_name(d->scene, name, sizeof name);
    if (!reference_find(d->reference, d->scene, name, r, s->err))
        return false;
    if (r->pixels == NULL)
        return error_set(s->err, "%s: there is no stored reference %s.pfm; give one with --reference", d->scene, name);
    if (!picture_size_ok((uint64_t)r->width * (uint64_t)d->scale, (uint64_t)r->height * (uint64_t)d->scale, s->err))
        return false;
    s->width = r->width * d->scale;
    s->height = r->height * d->scale;
    if (!plan_scene_read(d->scene, s->width, s->height, (int)r->max_depth, &s->scene, &s->max_depth, s->err))
        return false;
    if (!reference_is_of(r, &s->scene, d->reference != NULL, s->err)) {
        scene_free(&s->scene);
        return false;
    }
    settings_clear(&s->scene.settings); /* defaults: what a user gets */
    return true;
}

/* --- the picture ------------------------------------------------------------------------------------- */

/* Compare in the reference's size. */
static void measure(struct show *s)
{
    const struct reference *r = &s->reference;
    for (int i = 0; i < DEMO_SIDES; i++) {
        float *small = sheet_shrink(s->picture[i], s->width, s->height, s->demo->scale);
        s->side[i].rmse8 = compare_pixels(small, r->pixels, 3L * r->width * r->height).rmse8;
        free(small);
    }
}

/* One column: name and error, what it took, and the picture, each pixel a square of k x k.
 *   error  of which kind; NaN: unknown */
static void draw_column(struct sheet *sheet, int number, const char *name, const char *kind, double error,
                        const char *cost, const float *pixels, int width, int height, int k)
{
    int x = GAP + number * (width * k + GAP);
    char text[100] = "";
    if (isfinite(error))
        snprintf(text, sizeof text, "%s %.1f", kind, error);
    sheet_text(sheet, x, GAP, 3, SHEET_INK, name);
    sheet_text(sheet, x + width * k - sheet_text_width(text, 3), GAP, 3, SHEET_INK, text);
    sheet_text(sheet, x, GAP + 30, 2, SOFT, cost);
    sheet_paste(sheet, x, GAP + LABEL, pixels, width, height, k);
}

/* Both sides and the reference, with its own noise where that is known. */
static void draw_sheet(const struct show *s, struct sheet *sheet)
{
    const struct reference *r = &s->reference;
    int k = s->width < COLUMN ? COLUMN / s->width : 1;
    char cost[100];
    sheet_init(sheet, (DEMO_SIDES + 1) * (s->width * k + GAP) + GAP, LABEL + s->height * k + 2 * GAP, SHEET_PAPER);
    for (int i = 0; i < DEMO_SIDES; i++) {
        snprintf(cost, sizeof cost, "%ld samples per pixel, %.1f s of CPU", s->side[i].spp, s->side[i].seconds);
        draw_column(sheet, i, s->demo->integrator[i], "error", s->side[i].rmse8, cost, s->picture[i],
                    s->width, s->height, k);
    }
    snprintf(cost, sizeof cost, s->demo->scale > 1 ? "means of %d x %d pixels" : "stored", s->demo->scale,
             s->demo->scale);
    draw_column(sheet, DEMO_SIDES, "reference", "noise", r->noise8, cost, r->pixels, r->width, r->height,
                k * s->demo->scale);
}

bool demo_run(const struct demo *demo, struct demo_side out[DEMO_SIDES], struct sheet *picture, struct error *err)
{
    struct show s = {.demo = demo, .side = out, .err = err};
    bool ok = load_scene(&s);
    if (ok) {
        for (int i = 0; i < DEMO_SIDES; i++)
            s.picture[i] = mem_alloc((size_t)s.width * (size_t)s.height * 3, sizeof *s.picture[i]);
        ok = render_both(&s);
        scene_free(&s.scene);
    }
    if (ok) {
        measure(&s);
        draw_sheet(&s, picture);
    }
    for (int i = 0; i < DEMO_SIDES; i++)
        free(s.picture[i]);
    reference_free(&s.reference);
    return ok;
}
