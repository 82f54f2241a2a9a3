/* strategies.c: see strategies.h. */
#include "lab/strategies.h"

#include <stdlib.h>

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
