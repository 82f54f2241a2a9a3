/* planes.c: see planes.h. */
#include "lab/planes.h"

#include <stdlib.h>
#include <string.h>

#include "base/os.h"
#include "transport/sample.h"

struct plane_slot {
    const struct planes *planes;
    struct tile *tile; /* [planes->n], owned */
};

/* Number of the plane, which follows those of lights. */
static int alpha_plane(const struct planes *p) { return p->n_groups; }
static int eye_plane(const struct planes *p) { return p->n_groups + p->alpha; }
static int square_plane(const struct planes *p) { return eye_plane(p) + 1; }

void planes_init(struct planes *p, const struct scene *scene, const struct film *picture, bool lights, bool alpha,
                 bool variance, int n_threads)
{
    *p = (struct planes){.picture = picture, .lights = &scene->lights, .alpha = alpha, .variance = variance,
                         .n_groups = lights ? scene->lights.n_groups : 0};
    p->n = p->n_groups + alpha + 2 * variance;
    p->n_slots = OBSERVED_SLOTS * (n_threads < 1 ? os_cores() : n_threads);
    p->film = mem_alloc((size_t)p->n, sizeof *p->film);
    p->slot = mem_alloc((size_t)p->n_slots, sizeof *p->slot);
    for (int i = 0; i < p->n; i++)
        film_init(&p->film[i], picture->rect, picture->full_width, picture->full_height);
    for (int i = 0; i < p->n_slots; i++)
        p->slot[i] = (struct plane_slot){p, mem_alloc((size_t)p->n, sizeof(struct tile))};
}

void planes_free(struct planes *p)
{
    for (int i = 0; i < p->n; i++)
        film_free(&p->film[i]);
    for (int i = 0; i < p->n_slots; i++) {
        for (int k = 0; k < p->n; k++)
            tile_free(&p->slot[i].tile[k]);
        free(p->slot[i].tile);
    }
    free(p->film);
    free(p->slot);
    memset(p, 0, sizeof *p);
}

/* --- paths -------------------------------------------------------------------------------------------- */

/* NaN, infinities and values beyond FLT_MAX are left out, as of the picture. */
static rgb term(rgb c) { return rgb_fits_float(c) ? c : rgb_black(); }

/* A sample's value has come from `before` to `after`. */
static void step(struct tile *t, const struct sample *s, rgb after, rgb before)
{
    struct exact_sum *sum = &t->sum[3 * (size_t)pixels_cell(t->pixels, s->x, s->y)];
    const double plus[3] = {after.r, after.g, after.b}, minus[3] = {before.r, before.g, before.b};
    for (int c = 0; c < 3; c++) {
        exact_add(&sum[c], plus[c]);
        exact_add(&sum[c], -minus[c]);
    }
}

static void add_path(void *context, const struct sample *sample, const struct joined *path)
{
    const struct plane_slot *slot = context;
    const struct planes *p = slot->planes;
    if (rgb_is_black(path->c->value))
        return;
    int light = path->path != NULL ? path->path[0].light : path->c->light;
    struct tile *of_light = p->n_groups > 0 ? &slot->tile[p->lights->light[light].group] : NULL;
    struct tile *square = p->variance ? &slot->tile[square_plane(p)] : NULL;
    rgb after = term(rgb_add(sample->value, path->added)), before = term(sample->value);
    if (path->t == 1) {
        if (of_light != NULL)
            tile_add_splat(of_light, path->px, path->py, path->added);
        if (square != NULL)
            tile_add_splat(square, path->px, path->py, path->added);
        return;
    }
    if (of_light != NULL)
        step(of_light, sample, after, before);
    if (square != NULL) {
        step(&slot->tile[eye_plane(p)], sample, after, before);
        step(square, sample, rgb_mul(after, after), rgb_mul(before, before));
    }
}

/* Does the lens see a layer of the sky? */
static bool sky_seen(const struct light_set *set)
{
    bool seen = false;
    for (int i = 0; i < set->n_layers; i++)
        seen |= !set->layer[i].hidden;
    return seen;
}

/* Does the lens see anything there, be it light? */
static bool covered(const struct scene *scene, const struct vertex *eye, int n)
{
    const struct vertex *z = n > 1 ? &eye[1] : NULL;
    return z != NULL && (z->kind != VERTEX_ESCAPED || z->lamp != NULL || sky_seen(&scene->lights));
}

static void add_alpha(void *context, const struct sample *sample, enum transport mode, const struct vertex *path,
                      int n)
{
    const struct plane_slot *slot = context;
    if (mode == RADIANCE && covered(sample->pass->job->scene, path, n))
        step(&slot->tile[alpha_plane(slot->planes)], sample, rgb_grey(sample->filter_weight), rgb_black());
}

/* --- tiles -------------------------------------------------------------------------------------------- */

static struct observer begin(void *context, int slot, const struct tile *tile)
{
    struct planes *p = context;
    for (int i = 0; i < p->n; i++)
        tile_start(&p->slot[slot].tile[i], tile->pixels, tile->film_rect, tile->filter);
    return (struct observer){.context = &p->slot[slot], .walked = p->alpha ? add_alpha : NULL,
                             .joined = p->n_groups > 0 || p->variance ? add_path : NULL};
}

/* The planes' blocks of samples are those of the picture. */
static void follow(struct planes *p)
{
    for (int i = 0; i < p->n; i++) {
        struct film *f = &p->film[i];
        if (p->picture->iterations > f->iterations) {
            f->block.iterations = p->picture->iterations - f->iterations;
            film_end_block(f);
        }
        f->block.iterations = p->picture->block.iterations;
    }
}

/* Squares of what splats add to pixels. */
static void square_splats(struct film *f, struct tile *t)
{
    for (const struct splat *s = t->splat; s < t->splat + t->n_splats; s++) {
        struct pixel_rect range = splat_pixels(s, t->filter, f->rect);
        for (int y = range.y0; y < range.y1; y++)
            for (int x = range.x0; x < range.x1; x++) {
                float part[3];
                size_t at = 3 * ((size_t)(y - f->rect.y0) * (size_t)rect_width(f->rect) + (size_t)(x - f->rect.x0));
                for (size_t c = 0; splat_part(s, t->filter, x, y, part) && c < 3; c++)
                    exact_add(&f->sum[at + c], sqr((double)part[c]));
            }
    }
    t->n_splats = 0;
}

static void end(void *context, int slot)
{
    struct planes *p = context;
    follow(p);
    if (p->variance)
        square_splats(&p->film[square_plane(p)], &p->slot[slot].tile[square_plane(p)]);
    for (int i = 0; i < p->n; i++)
        film_merge_tile(&p->film[i], &p->slot[slot].tile[i]);
}

struct observers planes_observers(struct planes *p) { return (struct observers){p, begin, end}; }

void planes_end(struct planes *p) { follow(p); }

/* --- pictures ----------------------------------------------------------------------------------------- */

const struct film *planes_alpha(const struct planes *p) { return p->alpha ? &p->film[alpha_plane(p)] : NULL; }

void planes_variance(const struct planes *p, double scale, float *out)
{
    const struct film *eye = &p->film[eye_plane(p)], *square = &p->film[square_plane(p)];
    for (size_t i = 0; i < 3 * rect_pixels(eye->rect); i++) {
        double k = (double)(eye->iterations + (eye->block.in[i / 3] ? eye->block.iterations : 0));
        double variance = (film_value(square, i) - sqr(film_value(eye, i)) / k) / (k * (k - 1));
        out[i] = k < 2 ? INFINITY : float_within(sqr(scale) * fmax(variance, 0));
    }
}
