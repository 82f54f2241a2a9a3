/* tiling.c: how a film is cut into tiles: squares, or pixels that are interleaved with those of other tiles. */
#include "base/sampler.h"
#include "render/render.h"

struct tiling tiling_of(struct pixel_rect film, const struct pass_size *size)
{
    struct tiling t = {film, *size, (rect_width(film) + size->tile - 1) / size->tile,
                       (rect_height(film) + size->tile - 1) / size->tile, 0};
    t.step = lattice_step(tiling_count(&t));
    return t;
}

/* On one axis, of `n` tiles: number `tile` is number `own` of a group of *together, which shares [*begin, *end). Groups
 * are of up to `spread` tiles, and as like in size as can be. */
static void interleave(const struct pass_size *size, int n, int tile, int *begin, int *end, int *together, int *own)
{
    int groups = (n + size->spread - 1) / size->spread, group = (int)((int64_t)tile * groups / n);
    int first = (int)(((int64_t)group * n + groups - 1) / groups);
    int next = (int)((((int64_t)group + 1) * n + groups - 1) / groups);
    if (next < n)
        *end = *begin + next * size->tile;
    *begin += first * size->tile;
    *together = next - first;
    *own = tile - first;
}

struct tile_pixels tiling_pixels(const struct tiling *t, int64_t i)
{
    struct tile_pixels p = {.rect = t->film};
    i = i * t->step % tiling_count(t);
    interleave(&t->size, t->nx, (int)(i % t->nx), &p.rect.x0, &p.rect.x1, &p.nx, &p.x);
    interleave(&t->size, t->ny, (int)(i / t->nx), &p.rect.y0, &p.rect.y1, &p.ny, &p.y);
    return p;
}
