/* pool.c: `select = pool`: the smallest unbiased repair of the dissertation's estimator.
 *
 * The K light sub-paths of a tile and iteration (as many as BDPT would trace) get importances I_k and probabilities
 *     q_k = (1 - delta) I_k / sum I + delta / K,                                               [Hesterberg 1995]
 * a defensive mixture: nothing that can contribute is out of reach.
 * Vose's alias table [Vose 1991] over q has K bins of at most two sub-paths, the dissertation's bins. Every bin is
 * visited by exactly one pixel, in random order; a threshold picks one of its two, which is connected as in BDPT with
 *     W = 1 / (K q_k)
 * on the strategies s >= 2, t >= 2. Over the draw, given the pool, a pixel's expectation is the pool's mean,
 * sum_k q_k F(k) / (K q_k): unbiased for any I that does not look at the eye sub-path. Sub-paths are splat (t = 1)
 * once each, chosen or not. With I constant every bin holds one sub-path: BDPT with the pixels' sub-paths permuted.
 *
 * Tests: test_asbdpt.c.
 */
#include <stdlib.h>

#include "base/alias.h"
#include "integrators/select.h"
#include "transport/pixel_sample.h"
#include "base/number.h"

struct pool {
    struct light_pool paths;
    double q[MAX_TILE_SIZE * MAX_TILE_SIZE];
    int order[MAX_TILE_SIZE * MAX_TILE_SIZE]; /* bin visited by each pixel */
    struct alias_table table;
};

static void *new_scratch(const void *selection)
{
    (void)selection;
    return mem_alloc(1, sizeof(struct pool));
}

static void free_scratch(void *scratch)
{
    struct pool *p = scratch;
    light_pool_free(&p->paths);
    alias_free(&p->table);
    free(p);
}

static double path_importance(const struct selection *sel, const struct vertex *path, int n)
{
    switch (sel->metric) {
    case METRIC_CONSTANT: return 1;
    case METRIC_THROUGHPUT: return select_throughput(path, n);
    case METRIC_IMPORTANCE: return importance_of_path(&sel->importance, path, n);
    }
    return 1;
}

static void build_table(struct pool *p, const struct selection *sel)
{
    int K = p->paths.n;
    double sum = 0;
    for (int k = 0; k < K; k++) {
        double q = path_importance(sel, light_pool_path(&p->paths, k), p->paths.length[k]);
        sum += p->q[k] = q >= 0 && fits_float(q) ? q : 0; /* what delta leaves to all is enough to choose it by */
    }
    double delta = sum > 0 ? sel->delta : 1;
    for (int k = 0; k < K; k++)
        p->q[k] = (delta < 1 ? (1 - delta) * p->q[k] / sum : 0) + delta / K;
    alias_build(&p->table, p->q, K);
}

static void render_pixel(const struct tile_pass *pass, const struct selection *sel, struct pool *p, int x, int y,
                         int number, long iteration)
{
    arena_reset(&pass->work->arena);
    struct vertex *eye = pass->work->eye;
    struct pixel_sample g = pixel_sample_begin(pass, &sel->counts, x, y, iteration);
    int n = pixel_eye_path(pass, &g, iteration, eye, g.max_depth + 2);
    struct sampler draw = pixel_sampler(pass, RNG_SELECT, x, y, iteration);
    double q;
    int k = alias_sample_bin(&p->table, p->order[number], sampler_next(&draw), &q, NULL);

    rgb sum = pixel_sum_eye(&g, eye, n);
    double W = 1 / (p->paths.n * q);
    sum = rgb_add(sum, pixel_sum_pairs(&g, eye, n, light_pool_path(&p->paths, k), p->paths.length[k], W));
    pixel_splat_path(&g, light_pool_path(&p->paths, number), p->paths.length[number], 1);
    tile_add_eye(pass->tile, x, y, sum);
}

static void render(const void *selection, const struct tile_pass *pass)
{
    const struct selection *sel = selection;
    struct pool *p = pass->work->scratch;
    for (long i = pass->first; i < pass->end; i++) {
        light_pool_fill(&p->paths, pass, &sel->counts, 1, i);
        build_table(p, sel);
        light_pool_shuffle(&p->paths, pass, i, p->order);
        int number = 0;
        for (int y = pass->rect.y0; y < pass->rect.y1; y++)
            for (int x = pass->rect.x0; x < pass->rect.x1; x++)
                render_pixel(pass, sel, p, x, y, number++, i);
    }
}

const struct tile_renderer render_pool = {render, new_scratch, free_scratch};
