/* light_pool.c: the light sub-paths of a tile, shared by all its pixels; see select.h. */
#include <stdlib.h>

#include "integrators/select.h"
#include "transport/pixel_sample.h"

void light_pool_free(struct light_pool *pool)
{
    arena_free(&pool->arena);
    free(pool->vertex);
}

/* Trace the sub-paths of the tile's pixels 0, path_pixels, 2 path_pixels ... for one iteration. */
static void fill(struct light_pool *pool, const struct tile_pass *pass, const struct mis_counts *counts,
                 int path_pixels, long iteration)
{
    size_t longest = (size_t)pass->job->max_depth + 1;
    int number = 0;
    arena_reset(&pool->arena);
    pool->n = 0;
    pool->used = 0;
    for (int y = pass->rect.y0; y < pass->rect.y1; y++)
        for (int x = pass->rect.x0; x < pass->rect.x1; x++, number++) {
            if (number % path_pixels != 0)
                continue;
            pool->vertex = mem_grow(pool->vertex, &pool->capacity, pool->used + longest, sizeof *pool->vertex);
            struct vertex *path = &pool->vertex[pool->used];
            pool->start[pool->n] = pool->used;
            pool->length[pool->n] = pixel_light_path(pass, counts, x, y, (uint64_t)iteration, &pool->arena, path);
            pool->used += (size_t)pool->length[pool->n];
            pool->n++;
        }
}

/* Fisher and Yates, from the inside out. [Durstenfeld 1964] */
void light_pool_shuffle(const struct light_pool *pool, const struct tile_pass *pass, long iteration, int *order)
{
    struct sampler sampler = pixel_sampler(pass, RNG_SHUFFLE, pass->rect.x0, pass->rect.y0, iteration);
    for (int i = 0; i < pool->n; i++) {
        int j = (int)(sampler_number(&sampler, DRAW_ORDER) * (i + 1)); /* a sample is below 1 by more than rounding can add */
        order[i] = order[j];
        order[j] = i;
    }
}

double select_throughput(const struct vertex *light, int n) { return n < 1 ? 0 : rgb_mean(light[n - 1].beta); }

/* t = 1 for sub-path k. The weights count one in path_pixels for the whole film; the tile has `n`, rounded up. */
static void splat(const struct light_pool *pool, const struct tile_pass *pass, struct pixel_sample *g, int path_pixels,
                  int k)
{
    double pixels = (double)rect_width(pass->rect) * rect_height(pass->rect);
    pixel_splat_path(g, light_pool_path(pool, k), pool->length[k], pixels / ((double)pool->n * path_pixels));
}

static void render_pixel(const struct selection *sel, const struct tile_pass *pass, const struct pool_choice *choice,
                         int x, int y, int number, long iteration)
{
    struct light_pool *pool = pass->work->scratch; /* with which every scratch begins, see select.h */
    struct pool_pixel p = {.eye = pass->work->eye, .number = number};
    arena_reset(&pass->work->arena);
    p.sample = pixel_sample_begin(pass, &sel->counts, x, y, iteration);
    p.sample.lights = sel->lights;
    p.n = pixel_eye_path(pass, &p.sample, iteration, pass->work->eye, sel->max_depth + 2);
    p.draws = pixel_sampler(pass, RNG_SELECT, x, y, iteration);
    pixel_sum_eye(&p.sample, p.eye, p.n);
    if (choice->connect != NULL)
        choice->connect(pool, sel, &p);
    for (int t = 2; choice->connect_drawn != NULL && t <= p.n && t <= sel->max_depth; t++)
        if (vertex_connectible(&p.eye[t - 1]))
            choice->connect_drawn(pool, sel, &p.sample, &p.eye[t - 1], t, &p.draws);
    if (number % sel->path_pixels == 0)
        splat(pool, pass, &p.sample, sel->path_pixels, number / sel->path_pixels);
    tile_add_eye(pass->tile, x, y, p.sample.sum);
}

void light_pool_render(const struct selection *sel, const struct tile_pass *pass, const struct pool_choice *choice)
{
    for (long i = pass->first; i < pass->end; i++) {
        fill(pass->work->scratch, pass, &sel->counts, sel->path_pixels, i);
        choice->begin(pass->work->scratch, sel, pass, i);
        int number = 0;
        for (int y = pass->rect.y0; y < pass->rect.y1; y++)
            for (int x = pass->rect.x0; x < pass->rect.x1; x++)
                render_pixel(sel, pass, choice, x, y, number++, i);
    }
}
