/* select_pool.c: `select = pool`: the smallest unbiased repair of the dissertation's estimator.
 *
 * The tile traces K light sub-paths in an iteration, as many as BDPT. They have importances I_k and probabilities
 *     q_k = (1 - delta) I_k / sum I + delta / K,                                               [Hesterberg 1995]
 * a defensive mixture: every sub-path that can contribute has a chance. Vose's alias table [Vose 1991] over q has K
 * bins of at most two sub-paths, like the dissertation's bins. Each pixel visits one bin, in random order, and
 * draws one of its two sub-paths. It connects the sub-path as in BDPT and multiplies the strategies s >= 2, t >= 2 by
 *     W = 1 / (K q_k).
 * For a fixed pool, the expectation of a pixel is the mean over the pool, so the estimate is unbiased for any I that
 * does not depend on the eye sub-path. If I is constant, every bin has one sub-path, and this is BDPT with the pixels'
 * sub-paths permuted.
 *
 * Tests: test_asbdpt.c.
 */
#include "base/number.h"
#include "integrators/loop.h"
#include "learning/learn.h"

/* What a light sub-path is chosen by: nothing; the dissertation's measure, the mean over RGB of beta at the furthest
 * vertex; or how much of it the camera can use (learn.h). */
enum metric { METRIC_CONSTANT, METRIC_THROUGHPUT, METRIC_USE };
static const char *const METRICS[] = {"constant", "throughput", "importance", NULL};

static double importance_of(const struct prepared *p, const struct vertex *path, int n)
{
    return p->parameters.metric == METRIC_CONSTANT     ? 1
           : p->parameters.metric == METRIC_THROUGHPUT ? path_throughput(path, n)
                                                       : learnt_use(p->tables, path, 1, n);
}

/* What each pixel of the tile has drawn. */
static struct cache *build(const struct prepared *p, const struct tile_pass *pass, long iteration)
{
    struct pool *pool = &pass->work->pool;
    struct drawn *drawn = arena_alloc(&pool->arena, (size_t)pass->tile->n_pixels * sizeof *drawn);
    double *q = arena_alloc(&pool->arena, (size_t)pool->n * sizeof *q), sum = 0;
    int *order = arena_alloc(&pool->arena, (size_t)pool->n * sizeof *order);
    for (int k = 0; k < pool->n; k++) {
        double I = importance_of(p, pool_path(pool, k), pool->length[k]);
        sum += q[k] = I >= 0 && isfinite(I) ? I : 0; /* the defensive part remains */
    }
    double delta = sum > 0 ? p->parameters.delta : 1;
    for (int k = 0; k < pool->n; k++)
        q[k] = (delta < 1 ? (1 - delta) * q[k] / sum : 0) + delta / pool->n;
    alias_build(&pool->alias, q, pool->n);
    pool_shuffle(pool, pass, iteration, order);
    for (int i = 0; i < pass->tile->n_pixels; i++) {
        const int *at = pass->tile->pixel[i];
        struct sampler choice = sample_stream(pass, RNG_SELECT, at[0], at[1], (uint64_t)iteration);
        double pmf, u = sampler_number(&choice, DRAW_LIGHT_END);
        int k = alias_sample_bin(&pool->alias, order[i % pool->n], u, &pmf, NULL);
        drawn[i] = (struct drawn){pool_path(pool, k), 1, pool->length[k], pmf};
    }
    return (struct cache *)drawn;
}

static bool draw(const struct prepared *p, const struct cache *cache, struct sample *sample, const struct vertex *z,
                 int i, int n, struct drawn *out)
{
    (void)p, (void)z, (void)i, (void)n;
    *out = ((const struct drawn *)cache)[sample->i];
    return true;
}

static const struct field PARAMETERS[] = {
    PARAMETER("metric", FIELD_WORD, metric, METRIC_USE, 0, 0, "what a light sub-path is chosen by", METRICS),
    PARAMETER_DELTA(0.1), PARAMETER_CREDITS(false), PARAMETER_BOUND(false),
    PARAMETER_RACE(false), PARAMETER_POINTS(1), PARAMETER_GUIDE(true), PARAMETER_EMISSION(1),
    PARAMETER_TILES(DEFAULT_TILE_SIZE, POOL_SPREAD),
    {.name = NULL}};

const struct method method_pool = {
    .name = "asbdpt", .select = "pool",
    .help = "one alias table over the light sub-paths of a tile, weighted: unbiased", .parameters = PARAMETERS,
    .numbers = NUMBERS_OF_BDPT, .rr_threshold = DEFAULT_RR_THRESHOLD, .learns_use = true,
    .build = build, .draw = draw, .render = selection_render};
