/* cbdpt.c: combinatorial BDPT: every eye sub-path is connected with M light sub-paths in all pairs.
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
#include "integrators/loop.h"

struct cache {
    int order[POOL_PATHS]; /* pi */
};

static struct cache *build(const struct prepared *p, const struct tile_pass *pass, long iteration)
{
    struct pool *pool = &pass->work->pool;
    struct cache *cache = arena_alloc(&pool->arena, sizeof *cache);
    pool_shuffle(pool, pass, iteration, cache->order);
    for (int k = 0; p->numbers.draws[FIRST_HIT] == 1 && k < pool->n; k++)
        cache->order[k] = k;
    return cache;
}

/* The loop divides by n K times the probability: by the number of sub-paths that the pixel takes, n or all K. */
static bool draw(const struct prepared *p, const struct cache *cache, struct sample *sample, const struct vertex *z,
                 int i, int n, struct drawn *out)
{
    const struct pool *pool = &sample->pass->work->pool;
    int K = pool->n, M = n < K ? n : K;
    (void)p, (void)z;
    if (i >= M)
        return false;
    int k = cache->order[(sample->i * M + i) % K];
    *out = (struct drawn){pool_path(pool, k), 1, pool->length[k], 1.0 / (n > K ? n : K)};
    return true;
}

static const struct field PARAMETERS[] = {
    PARAMETER("connections", FIELD_INTEGER, numbers.draws[FIRST_HIT], 2, 1, 1024, "light sub-paths for each pixel",
              NULL),
    PARAMETER("pathpixels", FIELD_INTEGER, numbers.path_pixels, 1, 1, DEFAULT_TILE_SIZE * DEFAULT_TILE_SIZE,
              "pixels for each light sub-path", NULL),
    PARAMETER_LATER(-1), PARAMETER_CREDITS(false), PARAMETER_BOUND(false), PARAMETER_RACE(false), PARAMETER_POINTS(1),
    PARAMETER_GUIDE(false), PARAMETER_EMISSION(1), PARAMETER_TILES(DEFAULT_TILE_SIZE, 1),
    {.name = NULL}};

const struct method method_cbdpt = {
    .name = "cbdpt", .help = "combinatorial BDPT [Pajot 2011]: all pairs with M of a tile's light sub-paths",
    .parameters = PARAMETERS, .numbers = NUMBERS_OF_PT, .rr_threshold = DEFAULT_RR_THRESHOLD,
    .build = build, .draw = draw, .render = selection_render};
