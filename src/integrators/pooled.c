/* pooled.c: see pooled.h. */
#include "integrators/pooled.h"

#include <stdlib.h>

void light_pool_free(struct light_pool *pool)
{
    arena_free(&pool->arena);
    free(pool->vertex);
}

/* Trace the sub-paths of the tile's pixels 0, path_pixels, 2 path_pixels ... for one iteration. */
static void fill(struct light_pool *pool, const struct tile_pass *pass, const struct frozen *f, long iteration)
{
    size_t longest = (size_t)f->max_depth + 1;
    arena_reset(&pool->arena);
    pool->n = 0;
    pool->used = 0;
    for (int i = 0, x, y; pass_pixel(pass, i, &x, &y); i += f->path_pixels) {
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
    struct sampler sampler = pixel_sampler(pass, RNG_SHUFFLE, pass->rect.x0, pass->rect.y0, iteration);
    for (int i = 0; i < pool->n; i++) {
        /* at most i, since what is drawn is below 1 by more than rounding can add */
        int j = (int)(sampler_number(&sampler, DRAW_ORDER) * (i + 1));
        order[i] = order[j];
        order[j] = i;
    }
}

void candidates_find(struct candidates *c, const struct light_pool *pool)
{
    c->n = 0;
    for (int k = 0; k < pool->n; k++) {
        const struct vertex *path = light_pool_path(pool, k);
        for (int i = 1; i < pool->length[k]; i++) {
            if (!vertex_connectible(&path[i]))
                continue;
            struct candidate found = {&path[i], i + 1, rgb_luminance(path[i].beta)};
            c->item = mem_grow(c->item, &c->capacity, (size_t)c->n + 1, sizeof *c->item);
            c->item[c->n++] = found;
        }
    }
}

/* t = 1 for sub-path k. The weights count one in path_pixels for the whole film; the tile has `n`, rounded up. */
static void splat(const struct light_pool *pool, const struct tile_pass *pass, struct pixel_sample *sample,
                  int path_pixels, int k)
{
    double pixels = (double)rect_width(pass->rect) * rect_height(pass->rect);
    pixel_splat_path(sample, light_pool_path(pool, k), pool->length[k], pixels / ((double)pool->n * path_pixels));
}

/* What the light sub-paths bring to a pixel, and to others by pixel `number`'s own. */
static void use_pool(const struct preparation *m, const struct tile_pass *pass, struct pooled_pixel *p)
{
    const struct method *method = m->method;
    const struct frozen *f = m->state;
    struct light_pool *pool = pass->work->scratch;
    if (method->connect != NULL)
        method->connect(pool, f, p);
    for (int t = 2; method->draw != NULL && t <= p->n && t <= f->max_depth; t++)
        if (vertex_connectible(&p->eye[t - 1]))
            method->draw(pool, f, p, &p->eye[t - 1], t);
    if (p->number % f->path_pixels == 0)
        splat(pool, pass, &p->sample, f->path_pixels, p->number / f->path_pixels);
}

static void render_pixel(const struct preparation *m, const struct tile_pass *pass, int x, int y, int number,
                         long iteration)
{
    const struct frozen *f = m->state;
    struct pooled_pixel p = {.eye = pass->work->eye, .number = number};
    arena_reset(&pass->work->arena);
    p.sample = pixel_sample_begin(pass, &f->counts, x, y, iteration);
    p.sample.lights = f->lights;
    p.n = pixel_eye_path(pass, &p.sample, iteration, pass->work->eye, f->max_depth + 2);
    p.draws = pixel_sampler(pass, RNG_SELECT, x, y, iteration);
    pixel_sum_eye(&p.sample, p.eye, p.n);
    if (f->path_pixels > 0)
        use_pool(m, pass, &p);
    pixel_sample_end(&p.sample);
}

void pooled_render(const struct preparation *m, const struct tile_pass *pass)
{
    const struct frozen *f = m->state;
    for (long iteration = pass->first; iteration < pass->end; iteration++) {
        if (f->path_pixels > 0) {
            fill(pass->work->scratch, pass, f, iteration);
            m->method->begin(pass->work->scratch, f, pass, iteration);
        }
        for (int i = 0, x, y; pass_pixel(pass, i, &x, &y); i++)
            render_pixel(m, pass, x, y, i, iteration);
    }
}
