/* demo.c: see demo.h. */
#include "lab/demo.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "image/picture.h"
#include "lab/pictures.h"
#include "lab/plan_scene.h"
#include "lab/timed.h"

enum { REFERENCE_TIMES = 32 }; /* as many samples as the first picture has */

/* The one that nobody has stored. */
static bool make_reference(const struct demo *d, struct reference *r, struct error *err)
{
    struct render_options o = {.integrator = METHOD_REFERENCE, .seed = ~d->seed, .end = REFERENCE_TIMES * d->spp,
                               .n_threads = d->n_threads};
    struct scene scene;
    struct timed took;
    if (!plan_scene_read(d->scene, 0, 0, 0, &scene, &o.max_depth, err))
        return false;
    settings_clear(&scene.settings);
    bool ok = timed_render(&scene, &o, &took, err);
    if (ok) {
        r->pixels = took.pixels;
        r->width = scene.width;
        r->height = scene.height;
        r->max_depth = o.max_depth;
        r->content = scene.content;
        r->noise8 = NAN;
    }
    scene_free(&scene);
    return ok;
}

/* The reference, and the scene at its size times the scale. */
static bool load_scene(const struct demo *d, struct subject *s, struct error *err)
{
    char name[256];
    struct reference *r = &s->reference;
    plan_scene_name(d->scene, name, sizeof name);
    s->scale = d->scale;
    s->n_threads = d->n_threads;
    if (!reference_find(d->reference, d->scene, name, r, err))
        return false;
    bool stored = r->pixels != NULL;
    if (!stored && !make_reference(d, r, err))
        return false;
    snprintf(r->origin, sizeof r->origin, "%s", stored ? "stored" : "rendered here");
    if (!picture_size_ok((uint64_t)r->width * (uint64_t)d->scale, (uint64_t)r->height * (uint64_t)d->scale, err))
        return false;
    if (!plan_scene_read(d->scene, r->width * d->scale, r->height * d->scale, (int)r->max_depth, &s->scene,
                         &s->max_depth, err))
        return false;
    if (reference_is_of(r, &s->scene, d->reference != NULL, err))
        return true;
    scene_free(&s->scene);
    return false;
}

static bool render(const struct demo *d, struct subject *s, struct equal_render *out, float **picture,
                   struct error *err)
{
    bool ok = true;
    for (int i = 0; ok && i < d->methods.n; i++) {
        struct equal_render r = {.seed = (long)(d->seed + (unsigned)i), .spp = d->spp, .growth = 1};
        r.target = i > 0 ? out[0].seconds : 0;
        ok = (i > 0 ? subject_render_in_time : subject_render)(s, &d->methods.item[i], &r, &picture[i], err);
        out[i] = r;
    }
    return ok;
}

/* All pictures and the reference, with its own noise where that is known. */
static void draw(const struct demo *d, const struct subject *s, const struct equal_render *out,
                 float *const *picture, struct sheet *sheet)
{
    const struct reference *r = &s->reference;
    int width = s->scene.width, height = s->scene.height, n = d->methods.n;
    int k = width < COLUMN_WIDTH ? COLUMN_WIDTH / width : 1;
    char cost[100];
    sheet_init(sheet, (n + 1) * (width * k + COLUMN_GAP) + COLUMN_GAP, COLUMN_LABEL + height * k + 2 * COLUMN_GAP,
               SHEET_PAPER);
    for (int i = 0; i < n; i++) {
        snprintf(cost, sizeof cost, "%ld spp, %.1f s; in 8x8 %.1f", out[i].spp, out[i].seconds, out[i].shown_blocks);
        draw_column(sheet, i, d->methods.item[i].text, "error", out[i].rmse8, cost, picture[i], width, height, k);
    }
    if (d->scale > 1)
        snprintf(cost, sizeof cost, "%.20s; %d x %d in one", r->origin, d->scale, d->scale);
    else
        snprintf(cost, sizeof cost, "%.20s", r->origin);
    draw_column(sheet, n, "reference", "noise", r->noise8, cost, r->pixels, r->width, r->height, k * d->scale);
}

bool demo_run(const struct demo *d, struct equal_render *out, struct sheet *picture, struct error *err)
{
    struct subject s = {.scale = 1};
    float *pixels[METHODS_MAX] = {NULL};
    bool ok = load_scene(d, &s, err);
    if (ok) {
        ok = render(d, &s, out, pixels, err);
        if (ok)
            draw(d, &s, out, pixels, picture);
        scene_free(&s.scene);
    }
    for (int i = 0; i < d->methods.n; i++)
        free(pixels[i]);
    reference_free(&s.reference);
    return ok;
}
