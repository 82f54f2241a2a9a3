/* pool.c: `select = pool`: the smallest unbiased repair of the dissertation's estimator.
 *
 * The tile traces K light sub-paths in an iteration, as many as BDPT. They have importances I_k and probabilities
 *     q_k = (1 - delta) I_k / sum I + delta / K.                                               [Hesterberg 1995]
 * This is a defensive mixture: every sub-path that can contribute has a chance.
 * Vose's alias table [Vose 1991] over q has K bins of at most two sub-paths, like the dissertation's bins. Each pixel
 * visits exactly one bin, in random order, and draws one of its two sub-paths. It connects the sub-path as in BDPT and
 * multiplies the strategies s >= 2, t >= 2 by
 *     W = 1 / (K q_k).
 * For a fixed pool, the expectation of a pixel is sum_k q_k F(k) / (K q_k), the mean over the pool. So the estimate is
 * unbiased for any I that does not depend on the eye sub-path. Every sub-path is splat (t = 1) once, drawn or not. If I
 * is constant, every bin has one sub-path, and this is BDPT with the pixels' sub-paths permuted.
 *
 * Tests: test_asbdpt.c.
 */
#include <stddef.h>

#include "base/alias.h"
#include "base/number.h"
#include "integrators/pooled.h"
#include "integrators/services.h"

struct pool_state {
    struct frozen frozen;
    int metric, grid;
    double delta;
};

struct pool {
    struct light_pool paths; /* the first, see pooled.h */
    double q[MAX_TILE_SIZE * MAX_TILE_SIZE];
    int order[MAX_TILE_SIZE * MAX_TILE_SIZE]; /* the bin that each pixel visits */
    struct alias_table table;
};

static void free_scratch(void *scratch)
{
    struct pool *p = scratch;
    light_pool_free(&p->paths);
    alias_free(&p->table);
}

static double importance_of(const struct pool_state *s, const struct vertex *path, int n)
{
    return s->metric == METRIC_CONSTANT     ? 1
           : s->metric == METRIC_THROUGHPUT ? path_throughput(path, n)
                                            : path_importance(&s->frozen.tables.importance, path, n);
}

static void begin(void *scratch, const void *state, const struct tile_pass *pass, long iteration)
{
    struct pool *p = scratch;
    const struct pool_state *s = state;
    int K = p->paths.n;
    double sum = 0;
    for (int k = 0; k < K; k++) {
        double q = importance_of(s, light_pool_path(&p->paths, k), p->paths.length[k]);
        sum += p->q[k] = q >= 0 && isfinite(q) ? q : 0; /* the defensive part remains */
    }
    double delta = sum > 0 ? s->delta : 1;
    for (int k = 0; k < K; k++)
        p->q[k] = (delta < 1 ? (1 - delta) * p->q[k] / sum : 0) + delta / K;
    alias_build(&p->table, p->q, K);
    light_pool_shuffle(&p->paths, pass, iteration, p->order);
}

static void connect(void *scratch, const void *state, struct pooled_pixel *p)
{
    struct pool *pool = scratch;
    struct choice choice;
    (void)state;
    double u = sampler_number(&p->draws, DRAW_LIGHT_END);
    int k = alias_sample_bin(&pool->table, pool->order[p->number], u, &choice.pmf, NULL);
    choice.scale = 1 / (pool->paths.n * choice.pmf);
    pixel_sum_pairs(&p->sample, p->eye, p->n, light_pool_path(&pool->paths, k), pool->paths.length[k], choice);
}

static void prepare(const struct render_job *job, struct preparation *out)
{
    const struct pool_state *s = out->state;
    const struct learn_options own = {.importance = s->metric == METRIC_IMPORTANCE, .light_cells = s->grid,
                                      .levels = 1};
    services_learn(job, out, own);
    services_settle(job, out, 1);
}

#define AT(member) offsetof(struct pool_state, member)
static const struct field PARAMETERS[] = {
    {"metric", FIELD_WORD, AT(metric), METRIC_IMPORTANCE, 0, 0, "what a light sub-path is chosen by", METRICS},
    {"delta", FIELD_NUMBER, AT(delta), 0.1, 1e-6, 1, "share of draws that ignore it", NULL},
    {"grid", FIELD_INTEGER, AT(grid), 64, 1, 100000, "cells of the importance along the scene's diagonal", NULL},
    SERVICES(true, 1, 1, DEFAULT_TILE_SIZE, POOL_SPREAD),
    {.name = NULL}};

const struct method method_pool = {
    .name = "asbdpt", .select = "pool",
    .help = "one alias table over the light sub-paths of a tile, weighted: unbiased",
    .why = "alias table over the K light sub-paths of the tile, one bin for each pixel; q_k = (1 - delta) I_k / sum I "
           "+ delta / K, I the sub-path's importance; scale 1 / (K q)",
    .parameters = PARAMETERS,
    .state_size = sizeof(struct pool_state), .scratch_size = sizeof(struct pool),
    .numbers = NUMBERS_OF_BDPT, .rr_threshold = DEFAULT_RR_THRESHOLD,
    .prepare = prepare,
    .render = pooled_render, .scratch_free = free_scratch, .begin = begin, .connect = connect};
