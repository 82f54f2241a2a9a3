/* worst.c: see worst.h. */
#include "lab/worst.h"

#include <stdlib.h>

#include "base/os.h"
#include "lab/methods.h"

static bool before(const struct brought *a, const struct brought *b)
{
    if (a->luminance != b->luminance)
        return a->luminance > b->luminance;
    if (a->iteration != b->iteration)
        return a->iteration < b->iteration;
    return a->y != b->y ? a->y < b->y : a->x < b->x;
}

static bool same_sample(const struct brought *a, const struct brought *b)
{
    return a->x == b->x && a->y == b->y && a->iteration == b->iteration;
}

void worst_offer(struct worst *w, struct brought b)
{
    int i = 0;
    while (i < w->n && !same_sample(&w->item[i], &b))
        i++;
    if (i == w->most) /* a sample that is not among them: it takes the place of the last, or none */
        i--;
    if (!(b.luminance > 0) || !fits_float(b.luminance) || (i < w->n && !before(&b, &w->item[i])))
        return;
    w->n += i == w->n;
    for (; i > 0 && before(&b, &w->item[i - 1]); i--)
        w->item[i] = w->item[i - 1];
    w->item[i] = b;
}

/* --- rendering --------------------------------------------------------------------------------------- */

static void offer(struct worst *w, const struct pixel_sample *s, rgb value, int x, int y)
{
    const struct brought b = {rgb_luminance(value), s->x, s->y, s->iteration, x, y};
    worst_offer(w, b);
}

static void joined(void *context, const struct pixel_sample *sample, const struct joined *path)
{
    const struct tile *tile = sample->tile;
    const struct splat s = {path->c->px, path->c->py, path->added, 0};
    float part[3];
    if (path->t > 1 || rgb_is_black(path->added) || !rgb_fits_float(path->added))
        return;
    struct pixel_rect range = splat_pixels(&s, tile->filter, tile->film_rect);
    for (int y = range.y0; y < range.y1; y++)
        for (int x = range.x0; x < range.x1; x++)
            if (splat_part(&s, tile->filter, x, y, part))
                offer(context, sample, rgb_make(part[0], part[1], part[2]), x, y);
}

static void ended(void *context, const struct pixel_sample *sample)
{
    offer(context, sample, sample->value, sample->x, sample->y);
}

/* A list for each tile pass under way. */
struct lists {
    struct worst *all, *of; /* of: [slots] */
};

static struct observer begin(void *context, int slot)
{
    struct lists *l = context;
    l->of[slot].n = 0;
    l->of[slot].most = l->all->most;
    const struct observer o = {&l->of[slot], NULL, joined, ended, NULL};
    return o;
}

static void end(void *context, int slot)
{
    struct lists *l = context;
    for (int i = 0; i < l->of[slot].n; i++)
        worst_offer(l->all, l->of[slot].item[i]);
}

bool worst_render(const struct scene *scene, const struct render_options *options, struct film *film,
                  struct worst *worst, struct error *err)
{
    struct render_options o = *options;
    struct lists lists = {.all = worst};
    const struct observers observers = {&lists, begin, end};
    const struct method *m = method_find(options->integrator, &scene->settings, err);
    if (m == NULL || !method_observable(m, err))
        return false;
    o.n_threads = options->n_threads < 1 ? os_cores() : options->n_threads;
    o.observers = &observers;
    lists.of = mem_alloc((size_t)(o.n_threads * OBSERVED_SLOTS), sizeof *lists.of);
    bool ok = render_scene(scene, &o, film, err);
    free(lists.of);
    return ok;
}
