/* gates.c: see gates.h. */
#include "lab/gates.h"

#include <math.h>

struct gate_sums {
    const struct gates *gates;
    size_t pixels;
    double *sum;
};

static void take(void *context, const struct path_told *p, size_t pixel, double factor)
{
    const struct gate_sums *g = context;
    double number = floor((p->length - g->gates->begin) / g->gates->width);
    if (!(number >= 0 && number < g->gates->n))
        return;
    double *at = &g->sum[3 * ((size_t)number * g->pixels + pixel)];
    for (int c = 0; c < 3; c++)
        at[c] += (double)p->unweighted[c] * (double)p->weight * factor;
}

bool gates_render(const struct scene *scene, const struct render_options *options, const struct gates *gates,
                  struct film *film, double *sum, struct error *err)
{
    struct gate_sums sums = {gates, rect_pixels(film->rect), sum};
    const struct path_taker taker = {&sums, take};
    const struct method *m = method_find(options->integrator, &scene->settings, err);
    if (m != NULL && m->merges)
        return error_set(err, "%s adds paths of many lengths at once: render one gate at a time", m->name);
    return m != NULL && paths_render(scene, options, film, &taker, err);
}
