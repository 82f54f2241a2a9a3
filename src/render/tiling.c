/* tiling.c: how a film is cut into tiles: squares, or squares of pixels that are interleaved with those of others. */
#include "base/sampler.h"
#include "render/render.h"

struct tiling tiling_of(struct pixel_rect film, const struct pass_size *size)
{
    struct tiling t = {film, *size, (rect_width(film) + size->tile - 1) / size->tile,
                       (rect_height(film) + size->tile - 1) / size->tile, 0};
    t.step = lattice_step(tiling_count(&t));
    return t;
}

/* On one axis, of `n` tiles: number `tile` takes every so manieth pixel of [*begin, *end), together with its group.
 * Groups are of up to `spread` tiles, and as like in size as can be. */
static void interleave(const struct pass_size *size, int n, int tile, int *begin, int *end, int *skip)
{
    int groups = (n + size->spread - 1) / size->spread, group = (int)((int64_t)tile * groups / n);
    int first = (int)(((int64_t)group * n + groups - 1) / groups);
    int next = (int)((((int64_t)group + 1) * n + groups - 1) / groups);
    if (next < n)
        *end = *begin + next * size->tile;
    *begin += first * size->tile + tile - first;
    *skip = next - first - 1;
}

struct pixel_rect tiling_rect(const struct tiling *t, int64_t i)
{
    struct pixel_rect rect = t->film;
    i = i * t->step % tiling_count(t);
    interleave(&t->size, t->nx, (int)(i % t->nx), &rect.x0, &rect.x1, &rect.skip_x);
    interleave(&t->size, t->ny, (int)(i / t->nx), &rect.y0, &rect.y1, &rect.skip_y);
    return rect;
}
