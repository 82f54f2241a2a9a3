/* vertices.c: `select = vertices`: every eye vertex draws light vertices from one table over a tile's pool.
 *
 * As in the light vertex cache [Davidovic 2014], which draws uniformly, a pool of sub-paths is a pool of vertices. A
 * tile traces K sub-paths in an iteration. One alias table has all their connectible vertices, with
 *     q_v = L_v ratio(x_v) / sum,      L_v = luminance(beta_v).
 * The ratio (table.h) is large at places of which the camera can use much. Each eye vertex draws C vertices.
 *
 * The strategies s >= 2, t >= 2 with their light end at x count as about n(x) = 2 C ratio(x) / N samples in the MIS
 * weights, where N is the mean number of them in a light sub-path, and 2 the credit of a stratified draw. n is a
 * function of the surface point alone, so all strategies of a path compute the same n.
 *
 * Tests: test_asbdpt.c.
 */
#include "integrators/loop.h"

static struct cache *build(const struct prepared *p, const struct tile_pass *pass, long iteration)
{
    struct pool *pool = &pass->work->pool;
    (void)iteration;
    pool_find_candidates(pool);
    double *weight = arena_alloc(&pool->arena, (size_t)pool->n_candidates * sizeof *weight);
    for (int i = 0; i < pool->n_candidates; i++) {
        const struct vertex *y = pool->candidate[i];
        weight[i] = rgb_worth(y->beta) * table_ratio(&p->tables->pairs, 0, y->place);
    }
    alias_build(&pool->alias, weight, pool->n_candidates);
    return NULL;
}

static bool draw(const struct prepared *p, const struct cache *cache, struct sample *sample, const struct vertex *z,
                 int i, int n, struct drawn *out)
{
    const struct pool *pool = &sample->pass->work->pool;
    (void)p, (void)cache, (void)z;
    if (pool->alias.n == 0)
        return false;
    double pmf, u = (i + sampler_number(&sample->choice, DRAW_LIGHT_END)) / n; /* stratified over the table */
    const struct vertex *y = pool->candidate[alias_sample(&pool->alias, u, &pmf, NULL)];
    *out = drawn_vertex(y, pmf);
    return true;
}

/* A table of one row: what the camera can use in a region. */
static void prepare(const struct render_job *job, struct prepared *p)
{
    struct tables *t = p->tables;
    (void)job;
    const double *use = t->vertices != NULL ? t->use : NULL; /* NULL: there are no light sub-paths */
    t->pairs = table_of_row(use, t->vertices, t->regions.n, p->parameters.delta);
}

static const struct field PARAMETERS[] = {
    PARAMETER("connections", FIELD_INTEGER, numbers.draws[FIRST_HIT], 4, 1, 1024,
              "light vertices drawn for each eye vertex", NULL),
    PARAMETER("pathpixels", FIELD_INTEGER, numbers.path_pixels, 2, 1, DEFAULT_TILE_SIZE * DEFAULT_TILE_SIZE,
              "pixels for each light sub-path", NULL),
    PARAMETER_DELTA(0.1), PARAMETER_LATER(-1), PARAMETER_CREDITS(true), PARAMETER_BOUND(false),
    PARAMETER_RACE(false), PARAMETER_POINTS(1), PARAMETER_GUIDE(true), PARAMETER_EMISSION(1),
    PARAMETER_TILES(DEFAULT_TILE_SIZE, POOL_SPREAD),
    {.name = NULL}};

const struct method method_vertices = {
    .name = "asbdpt", .select = "vertices", .help = "one alias table over the light vertices of a tile",
    .parameters = PARAMETERS, .rr_threshold = DEFAULT_RR_THRESHOLD, .vertices = true,
    .learns_use = true, .prepare = prepare, .build = build, .draw = draw, .render = selection_render};
