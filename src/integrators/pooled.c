/* pooled.c: see pooled.h. */
#include "integrators/pooled.h"

#include <stdlib.h>

const char *const METRICS[] = {"constant", "throughput", "importance", NULL};

void light_pool_free(void *scratch)
{
    struct light_pool *pool = scratch;
    arena_free(&pool->arena);
    free(pool->vertex);
}

void light_pool_fill(struct light_pool *pool, const struct tile_pass *pass, const struct frozen *f, long iteration)
{
    size_t longest = (size_t)f->max_depth + 1;
    arena_reset(&pool->arena);
    pool->n = 0;
    pool->used = 0;
    for (int i = 0, x, y; pass_pixel(pass, i, &x, &y); i += f->numbers.path_pixels) {
        pool->vertex = mem_grow(pool->vertex, &pool->capacity, pool->used + longest, sizeof *pool->vertex);
        struct vertex *path = &pool->vertex[pool->used];
        int length = pixel_light_path(pass, &f->counts, x, y, (uint64_t)iteration, &pool->arena, path);
        pool->start[pool->n] = pool->used;
        pool->length[pool->n++] = length;
        pool->used += (size_t)length;
    }
}

/* Fisher and Yates, from the inside out. [Durstenfeld 1964] */
void light_pool_shuffle(const struct light_pool *pool, const struct tile_pass *pass, long iteration, int *order)
{
    int x, y;
    pixels_get(pass->tile->pixels, 0, &x, &y);
    struct sampler sampler = pixel_sampler(pass, RNG_SHUFFLE, x, y, iteration);
    for (int i = 0; i < pool->n; i++) {
        /* at most i, since what is drawn is below 1 by more than rounding can add */
        int j = (int)(sampler_number(&sampler, DRAW_ORDER) * (i + 1));
        order[i] = order[j];
        order[j] = i;
    }
}

struct candidates candidates_find(struct light_pool *pool)
{
    struct candidates c = {arena_alloc(&pool->arena, pool->used * sizeof *c.item), 0};
    for (int k = 0; k < pool->n; k++) {
        const struct vertex *path = light_pool_path(pool, k);
        for (int i = 1; i < pool->length[k]; i++)
            if (vertex_connectible(&path[i]))
                c.item[c.n++] = (struct candidate){&path[i], i + 1, rgb_luminance(path[i].beta)};
    }
    return c;
}

void pooled_fill(const struct preparation *m, const struct tile_pass *pass, long iteration)
{
    const struct frozen *f = m->state;
    if (f->numbers.path_pixels == 0)
        return;
    light_pool_fill(pass->work->scratch, pass, f, iteration);
    if (m->method->begin != NULL)
        m->method->begin(pass->work->scratch, f, pass, iteration);
}

/* The weights count one sub-path per path_pixels pixels of the film. The tile has pool->n, which is rounded up: `scale`
 * makes up for the difference. */
struct pooled_pixel pooled_begin(const struct preparation *m, const struct tile_pass *pass, int x, int y, int number,
                                 long iteration)
{
    const struct frozen *f = m->state;
    struct pooled_pixel p = {.eye = pass->work->eye, .number = number};
    p.sample = pixel_sample_begin(pass, &f->counts, x, y, iteration);
    p.sample.light_points = f->numbers.light_points;
    p.n = pixel_eye_path(pass, &p.sample, pass->work->eye, f->max_depth + 2);
    p.draws = pixel_sampler(pass, RNG_SELECT, x, y, iteration);
    int each = f->numbers.path_pixels;
    if (each > 0 && number % each == 0) {
        const struct light_pool *pool = pass->work->scratch;
        p.light = light_pool_path(pool, number / each);
        p.n_light = pool->length[number / each];
        p.scale = pixels_count(pass->tile->pixels) / ((double)pool->n * each);
    }
    return p;
}

void pooled_connect(const struct preparation *m, const struct tile_pass *pass, struct pooled_pixel *p)
{
    const struct method *method = m->method;
    const struct frozen *f = m->state;
    if (f->numbers.path_pixels == 0)
        return;
    if (method->connect != NULL)
        method->connect(pass->work->scratch, f, p);
    for (int t = 2; method->draw != NULL && t <= p->n && t <= f->max_depth; t++)
        if (vertex_connectible(&p->eye[t - 1]))
            method->draw(pass->work->scratch, f, p, &p->eye[t - 1], t);
}

void pooled_end(struct pooled_pixel *p)
{
    if (p->light != NULL)
        pixel_splat_path(&p->sample, p->light, p->n_light, p->scale);
    pixel_sample_end(&p->sample);
}

void pooled_render(const struct preparation *m, const struct tile_pass *pass)
{
    for (long iteration = pass->first; iteration < pass->end; iteration++) {
        pooled_fill(m, pass, iteration);
        for (int i = 0, x, y; pass_pixel(pass, i, &x, &y); i++) {
            arena_reset(&pass->work->arena);
            struct pooled_pixel p = pooled_begin(m, pass, x, y, i, iteration);
            pixel_sum_eye(&p.sample, p.eye, p.n);
            pooled_connect(m, pass, &p);
            pooled_end(&p);
        }
    }
}
