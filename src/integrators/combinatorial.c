/* combinatorial.c: `select = combinatorial`: every eye sub-path is connected with M light sub-paths in all pairs.
 *
 * Combinatorial BDPT [Pajot 2011] traces sets of eye and of light sub-paths and connects every one of the first to
 * every one of the second. Here the sets are those of a tile and iteration with its K light sub-paths, of which the eye
 * sub-path of pixel p, in row order, takes M:
 *     pi(p M + m mod K),   m = 0 .. M-1,   pi a random permutation,
 * so that all are used equally often, none twice by one pixel, and pixels that share some, and err alike, lie anywhere
 * in the tile. The mean over the M of BDPT's sum of pairs,
 *     (1/M) sum_m sum_{s,t} w F(y_{s-1} of sub-path m, z_{t-1}),
 * has BDPT's expectation, since each is. The strategies s >= 2, t >= 2 take M samples per pixel, their count, though
 * these share the eye sub-path. s = 0, s = 1 and t = 1 stay as they are, every pooled sub-path being splat once.
 *
 * With more connections than sub-paths M is K, which is all there is to connect. With M = 1 pi is the identity, and the
 * method is BDPT to the byte.
 *
 * Tests: test_asbdpt.c.
 */
#include <stdlib.h>

#include "integrators/select.h"
#include "transport/pixel_sample.h"

struct combinatorial {
    struct light_pool pool; /* the first, see select.h */
    int M;
    int order[MAX_TILE_SIZE * MAX_TILE_SIZE]; /* pi */
};

static void *new_scratch(const void *selection)
{
    (void)selection;
    return mem_alloc(1, sizeof(struct combinatorial));
}

static void free_scratch(void *scratch)
{
    struct combinatorial *c = scratch;
    light_pool_free(&c->pool);
    free(c);
}

static void begin(void *scratch, const struct selection *sel, const struct tile_pass *pass, long iteration)
{
    struct combinatorial *c = scratch;
    int M = (int)sel->connections[0], K = c->pool.n;
    c->M = M < K ? M : K;
    light_pool_shuffle(&c->pool, pass, iteration, c->order);
    for (int k = 0; M == 1 && k < K; k++)
        c->order[k] = k;
}

static void connect(void *scratch, const struct selection *sel, struct pool_pixel *p)
{
    struct combinatorial *c = scratch;
    (void)sel;
    for (int m = 0; m < c->M; m++) {
        int k = c->order[(p->number * c->M + m) % c->pool.n];
        const struct vertex *light = light_pool_path(&c->pool, k);
        double scale = 1.0 / c->M;
        if (p->sample.trace != NULL)
            trace_choose(p->sample.trace, 0, light, c->pool.length[k], 0, 1.0 / c->pool.n, scale,
                         "number %d of %d: sub-path %d of the tile's K = %d, in random order", m + 1, c->M, k,
                         c->pool.n);
        pixel_sum_pairs(&p->sample, p->eye, p->n, light, c->pool.length[k], scale);
    }
}

static void render(const void *selection, const struct tile_pass *pass)
{
    static const struct pool_choice choice = {begin, connect, NULL};
    light_pool_render(selection, pass, &choice);
}

const struct tile_renderer render_combinatorial = {render, new_scratch, free_scratch};
