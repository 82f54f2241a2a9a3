/* asbdpt.c: the default, `select = subspaces`: eye vertices draw light vertices by their worth to the eye's region.
 *
 * A light vertex y_{s-1} represents the sub-path y_0 ... y_{s-1} that ends there. An eye vertex z draws C of the light
 * vertices v that the K sub-paths of a tile and iteration have; usually C = 3 at a first hit, else 1, and K = 32 x 32.
 * Let ratio(e,l) tell what a light vertex in region l is worth to an eye vertex in region e: the mean light that trial
 * connections have brought before the render (learn.h), relative to all l (table.h). Let L_v be the luminance of
 * beta_v. Then
 *     P(v|z) = ratio(e(z), l(v)) L_v / sum over the pool.
 * It draws by bisection of cumulative sums, first the region, then the vertex: that keeps the C strata of an eye vertex
 * apart, and a region draws too rarely to pay for an alias table.
 *
 * Why is it unbiased? What is drawn is divided by C K P. So for a given pool, the expectation of the draws is the mean
 * over its K sub-paths of what BDPT would connect, whatever P > 0 is. P depends on nothing that the eye vertex does
 * later, and tables do not change.
 *
 * How many samples is that, where BDPT takes one? Each of the K sub-paths might have had its vertex at y, and y is
 * drawn C P(y|z) times: C K P(y|z). The sum over the pool is about K N times the mean of L, as ratios have the mean 1
 * and a light sub-path has N connectible vertices. Other strategies cannot know L of a walk that they have not made, so
 * to them it is the mean: C ratio / N is left. With the credit of a draw and the bound (counts.h) the strategies count
 * as
 *     n = x / (1 + x / M),      x = 2 C ratio(e(z), l(y)) / N,      M = K / 4
 * samples, K being that of a full tile. Any n that is a function of the path alone keeps the weights valid.
 *
 * [Su 2022] has subspaces of eye and light sub-paths and a matrix of probabilities between them. Here the regions are
 * cubes, and the table is learnt from trial connections.
 *
 * Tests: test_asbdpt.c.
 */
#include <string.h>

#include "integrators/loop.h"

/* The candidates in one region. */
struct group {
    int region, first, n;
    double L; /* sum of their L */
};

struct cache {
    const struct vertex **candidate; /* [n], sorted by region */
    double *before;              /* [n], sum of L of the candidates before it in its group */
    struct group *group;         /* [n_groups], in the order of their regions */
    int n_groups;
    double **sums; /* [regions][n_groups + 1] cumulative sums of ratio(e,.) L over the groups; NULL until a draw needs
                    * them */
};

/* --- the pool's vertices by region ------------------------------------------------------------------- */

/* The groups, with places for their members, but no members yet.
 *   group_of  out, [n_regions], number of the region's group, if it has one; on the way its number of candidates */
static void make_groups(struct cache *cache, struct pool *pool, int *group_of, int n_regions)
{
    memset(group_of, 0, (size_t)n_regions * sizeof *group_of);
    for (int i = 0; i < pool->n_candidates; i++)
        group_of[pool->candidate[i]->place]++;
    cache->group = arena_alloc(&pool->arena, (size_t)n_regions * sizeof *cache->group);
    cache->n_groups = 0;
    for (int region = 0, first = 0; region < n_regions; region++) {
        int n = group_of[region];
        if (n == 0)
            continue;
        group_of[region] = cache->n_groups;
        cache->group[cache->n_groups++] = (struct group){region, first, 0, 0};
        first += n;
    }
}

static struct cache *build(const struct prepared *p, const struct tile_pass *pass, long iteration)
{
    struct pool *pool = &pass->work->pool;
    struct arena *arena = &pool->arena;
    int n_regions = p->tables->regions.n;
    struct cache *cache = arena_alloc(arena, sizeof *cache);
    int *group_of = arena_alloc(arena, (size_t)n_regions * sizeof *group_of);
    (void)iteration;
    pool_find_candidates(pool);
    make_groups(cache, pool, group_of, n_regions);
    cache->candidate = arena_alloc(arena, (size_t)pool->n_candidates * sizeof *cache->candidate);
    cache->before = arena_alloc(arena, (size_t)pool->n_candidates * sizeof *cache->before);
    for (int i = 0; i < pool->n_candidates; i++) {
        const struct vertex *y = pool->candidate[i];
        struct group *g = &cache->group[group_of[y->place]];
        cache->candidate[g->first + g->n] = y;
        cache->before[g->first + g->n++] = g->L;
        g->L += rgb_worth(y->beta);
    }
    cache->sums = arena_alloc(arena, (size_t)n_regions * sizeof *cache->sums);
    for (int e = 0; e < n_regions; e++)
        cache->sums[e] = NULL;
    return cache;
}

/* --- drawing ----------------------------------------------------------------------------------------- */

/* The cumulative sums of an eye region, made at the first draw from it. */
static const double *sums_of_region(const struct cache *cache, struct arena *arena, const struct table *pairs, int e)
{
    if (cache->sums[e] != NULL)
        return cache->sums[e];
    double *sums = cache->sums[e] = arena_alloc(arena, ((size_t)cache->n_groups + 1) * sizeof *sums);
    sums[0] = 0;
    for (int g = 0; g < cache->n_groups; g++)
        sums[g + 1] = sums[g] + table_ratio(pairs, e, cache->group[g].region) * cache->group[g].L;
    return sums;
}

/* Draw a region, then a vertex; stratified over both. */
static bool draw(const struct prepared *p, const struct cache *cache, struct sample *sample, const struct vertex *z,
                 int i, int n, struct drawn *out)
{
    if (cache->n_groups == 0)
        return false;
    const double *sums = sums_of_region(cache, &sample->pass->work->pool.arena, &p->tables->pairs, z->place);
    double total = sums[cache->n_groups], target = (i + sampler_number(&sample->choice, DRAW_LIGHT_END)) / n * total;
    int k = cumulative_find(sums, cache->n_groups, target);
    const struct group *g = &cache->group[k];
    double share = sums[k + 1] - sums[k], within = (target - sums[k]) / share * g->L;
    const struct vertex *y = cache->candidate[g->first + cumulative_find(&cache->before[g->first], g->n, within)];
    *out = drawn_vertex(y, share / total * rgb_worth(y->beta) / g->L);
    return true;
}

/* --- the loop ---------------------------------------------------------------------------------------- */

/* After a race (race.h) only one of `every` iterations may have light sub-paths. What is drawn then counts `every`
 * times. In the other iterations K = 0: they are those of a path tracer. */
static void render_iteration(const struct prepared *p, const struct tile_pass *pass, long iteration)
{
    loop_fill(p, pass, iteration);
    const int K = pass->work->pool.n;
    const struct cache *cache = K > 0 ? p->method->build(p, pass, iteration) : NULL;
    const double every = numbers_every(&p->numbers);
    for (int i = 0; pass_goes_on(pass, i); i++) {
        struct sample sample;
        arena_reset(&pass->work->arena);
        int n = loop_begin(p, pass, i, iteration, &sample);
        for (int t = 2; t <= n; t++) {
            const struct vertex *z = &sample.eye[t - 1];
            const bool joins = K > 0 && t <= pass->job->max_depth && vertex_connectible(z);
            const int C = joins ? p->numbers.draws[z->eye_hit] : 0;
            struct drawn drawn;
            sample_s0(&sample, t);
            sample_s1(&sample, t);
            for (int j = 0; j < C; j++) /* s >= 2 */
                if (p->method->draw(p, cache, &sample, z, j, C, &drawn))
                    sample_pairs(&sample, &drawn, t, every / (C * K) / drawn.pmf);
        }
        loop_splat(p, &sample); /* t = 1 */
        sample_end(&sample);
    }
}

void selection_render(const struct prepared *p, const struct tile_pass *pass)
{
    for (long iteration = pass->first; iteration < pass->end; iteration++)
        render_iteration(p, pass, iteration);
}

/* --- the method ----------------------------------------------------------------------------------------- */

static const struct field PARAMETERS[] = {
    PARAMETER("connections", FIELD_INTEGER, numbers.draws[FIRST_HIT], 3, 0, 1024,
              "light vertices drawn for each eye vertex that the camera sees", NULL),
    PARAMETER_LATER(1),
    PARAMETER("pathpixels", FIELD_INTEGER, numbers.path_pixels, 1, 0, DEFAULT_TILE_SIZE * DEFAULT_TILE_SIZE,
              "pixels for each light sub-path; 0: trace none", NULL),
    PARAMETER_DELTA(0.1), PARAMETER_CREDITS(true), PARAMETER_BOUND(true),
    PARAMETER_RACE(true), PARAMETER_POINTS(2), PARAMETER_GUIDE(true), PARAMETER_EMISSION(0.2),
    PARAMETER_TILES(MAX_TILE_SIZE, POOL_SPREAD),
    {.name = NULL}};

const struct method method_subspaces = {
    .name = "asbdpt", .select = "subspaces", .help = "light vertices by what they are worth where the eye vertex is",
    .parameters = PARAMETERS, .rr_threshold = DEFAULT_RR_THRESHOLD,
    .vertices = true, .learns_use = true, .learns_pairs = true, .build = build, .draw = draw,
    .render = selection_render};
