/* together.c: see together.h. */
#include "rivals/together.h"

#include <string.h>

static void render_iteration(const struct preparation *m, const struct tile_pass *pass, connect_all_fn *connect_all,
                             long iteration)
{
    struct arena *arena = &pass->work->arena;
    int n = (int)rect_pixels(pass->rect);
    arena_reset(arena);
    struct pooled_pixel *all = arena_alloc(arena, (size_t)n * sizeof *all);
    for (int i = 0, x, y; pass_pixel(pass, i, &x, &y); i++) {
        all[i] = pooled_begin(m, pass, x, y, i, iteration);
        size_t size = (size_t)all[i].n * sizeof *all[i].eye;
        all[i].eye = memcpy(arena_alloc(arena, size), all[i].eye, size);
    }
    connect_all(pass->work->scratch, m->state, pass, all, n);
    for (int i = 0; i < n; i++)
        pooled_end(m, pass, &all[i]);
}

void together_render(const struct preparation *m, const struct tile_pass *pass, connect_all_fn *connect_all)
{
    for (long iteration = pass->first; iteration < pass->end; iteration++) {
        pooled_fill(m, pass, iteration);
        render_iteration(m, pass, connect_all, iteration);
    }
}
