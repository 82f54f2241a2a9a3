/* paths.c: see paths.h. */
#include "lab/paths.h"

#include <math.h>
#include <stdlib.h>

#include "base/os.h"
#include "caustics/derived.h"
#include "lab/methods.h"

/* The paths of one tile pass. */
struct list {
    struct path_told *item; /* [n], owned */
    size_t n, capacity;
};

struct lists {
    struct list *of; /* [slots], owned */
    const struct scene *scene;
    struct pixel_rect film;
    const struct path_taker *taker;
};

static void joined(void *context, const struct sample *sample, const struct joined *p)
{
    struct list *list = context;
    rgb value = rgb_scale(p->c->value, p->scale);
    if (rgb_is_black(value) || !rgb_fits_float(value) || !rgb_fits_float(p->added) || !fits_float(p->c->weight))
        return;
    list->item = mem_grow(list->item, &list->capacity, list->n + 1, sizeof *list->item);
    const struct path_told told = {p->s, p->t, sample->x, sample->y, p->px, p->py,
                                   {(float)value.r, (float)value.g, (float)value.b}, (float)p->c->weight,
                                   path_length(sample->pass->job->scene, p)};
    list->item[list->n++] = told;
}

static struct observer begin(void *context, int slot, const struct tile *tile)
{
    (void)tile;
    struct lists *l = context;
    l->of[slot].n = 0;
    const struct observer o = {.context = &l->of[slot], .joined = joined};
    return o;
}

static size_t pixel_of(const struct lists *l, int x, int y)
{
    return (size_t)(y - l->film.y0) * (size_t)rect_width(l->film) + (size_t)(x - l->film.x0);
}

static void spread(const struct lists *l, const struct path_told *p)
{
    const struct filter *f = &l->scene->filter;
    const struct splat s = {.px = p->px, .py = p->py};
    struct pixel_rect range = splat_pixels(&s, f, l->film);
    for (int y = range.y0; y < range.y1; y++)
        for (int x = range.x0; x < range.x1; x++)
            l->taker->take(l->taker->context, p, pixel_of(l, x, y),
                           filter_eval(f, p->px - (x + 0.5), p->py - (y + 0.5)));
}

static void end(void *context, int slot)
{
    const struct lists *l = context;
    const struct list *list = &l->of[slot];
    for (const struct path_told *p = list->item; p < list->item + list->n; p++)
        if (p->t == 1)
            spread(l, p);
        else
            l->taker->take(l->taker->context, p, pixel_of(l, p->x, p->y), 1);
}

bool paths_render(const struct scene *scene, const struct render_job *options, struct film *film,
                  const struct path_taker *taker, struct error *err)
{
    struct render_job o = *options;
    struct lists lists = {NULL, scene, film->rect, taker};
    const struct observers observers = {&lists, begin, end};
    if (!method_observable(options->integrator, err))
        return false;
    o.n_threads = options->n_threads < 1 ? os_cores() : options->n_threads;
    o.observers = &observers;
    o.block = options->block > 0 ? options->block : 1; /* short passes: their paths are kept until it is their turn */
    int slots = o.n_threads * OBSERVED_SLOTS;
    lists.of = mem_alloc((size_t)slots, sizeof *lists.of);
    bool ok = render_by(scene, &o, film, err);
    for (int i = 0; i < slots; i++)
        free(lists.of[i].item);
    free(lists.of);
    return ok;
}

/* --- gates ------------------------------------------------------------------------------------------- */

struct gate_sums {
    const struct gates *gates;
    size_t pixels;
    double *sum;
};

static void take_by_gate(void *context, const struct path_told *p, size_t pixel, double factor)
{
    const struct gate_sums *g = context;
    double number = floor((p->length - g->gates->begin) / g->gates->width);
    if (!(number >= 0 && number < g->gates->n))
        return;
    double *at = &g->sum[3 * ((size_t)number * g->pixels + pixel)];
    for (int c = 0; c < 3; c++)
        at[c] += (double)p->unweighted[c] * (double)p->weight * factor;
}

bool gates_render(const struct scene *scene, const struct render_job *options, const struct gates *gates,
                  struct film *film, double *sum, struct error *err)
{
    struct gate_sums sums = {gates, rect_pixels(film->rect), sum};
    const struct path_taker taker = {&sums, take_by_gate};
    const struct method *m = options->integrator;
    if (method_merges(m))
        return error_set(err, "%s adds paths of many lengths at once: no gate can tell them apart", m->name);
    return paths_render(scene, options, film, &taker, err);
}
