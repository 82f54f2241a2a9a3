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
#include "base/number.h"
#include "integrators/select.h"
#include "transport/pixel_sample.h"

struct pool {
    struct light_pool paths; /* the first, see select.h */
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

static void begin(void *scratch, const struct selection *sel, const struct tile_pass *pass, long iteration)
{
    struct pool *p = scratch;
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
    light_pool_shuffle(&p->paths, pass, iteration, p->order);
}

/* For trace.h: the bin that the pixel visits, and which of its two sub-paths it takes. */
static void tell(const struct pool *pool, struct trace *trace, int bin, double u, int k, double q, double W)
{
    const struct alias_bin *b = &pool->table.bin[bin];
    trace_note(trace, "alias table over the K = %d light sub-paths of the tile: K bins, each visited by one pixel",
               pool->paths.n);
    trace_note(trace, "q_k = (1 - delta) I_k / sum I + delta / K, I the sub-path's importance");
    trace_choose(trace, 0, light_pool_path(&pool->paths, k), pool->paths.length[k], 0, q, W,
                 "bin %d holds sub-paths %d (q = %.4g, up to u = %.4f) and %d (q = %.4g); u = %.4f: %d, W = 1 / (K q)",
                 bin, bin, b->pmf, b->threshold, (int)b->alias, b->alias_pmf, u, k);
}

static void connect(void *scratch, const struct selection *sel, struct pool_pixel *p)
{
    struct pool *pool = scratch;
    int bin = pool->order[p->number];
    double q, u = sampler_number(&p->draws, DRAW_LIGHT_END);
    (void)sel;
    int k = alias_sample_bin(&pool->table, bin, u, &q, NULL);
    double W = 1 / (pool->paths.n * q);
    if (p->sample.trace != NULL)
        tell(pool, p->sample.trace, bin, u, k, q, W);
    pixel_sum_pairs(&p->sample, p->eye, p->n, light_pool_path(&pool->paths, k), pool->paths.length[k], W);
}

static void render(const void *selection, const struct tile_pass *pass)
{
    static const struct pool_choice choice = {begin, connect, NULL};
    light_pool_render(selection, pass, &choice);
}

const struct tile_renderer render_pool = {render, new_scratch, free_scratch};
