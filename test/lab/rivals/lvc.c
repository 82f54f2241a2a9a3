/* lvc.c: the light vertex cache: all light vertices of a tile's pool are equally likely.          [Davidovic 2014]
 *
 * Each eye vertex (t >= 2) draws C of the V connectible vertices of the K light sub-paths, each with probability 1/V:
 *     (1/C) sum over draws of F(v) V / K
 * has BDPT's expectation. It takes each vertex C/V times, where BDPT, with one of K sub-paths, takes it 1/K times:
 * C K/V times as often, about C/l, l being the expected number of connectible vertices of a light sub-path. That is the
 * count, with no credit by default. l is learnt before the render: the pool's own V/K would make a vertex' weight
 * depend on what else is in the pool, which biases small pools. s = 0, s = 1 and t = 1 stay as they are, lights are
 * chosen by power.
 *
 * Tests: test_asbdpt.c.
 */
#include <math.h>

#include "base/number.h"
#include "integrators/loop.h"

static struct cache *build(const struct prepared *p, const struct tile_pass *pass, long iteration)
{
    (void)p, (void)iteration;
    pool_find_candidates(&pass->work->pool);
    return NULL;
}

static bool draw(const struct prepared *p, const struct cache *cache, struct sample *sample, const struct vertex *z,
                 int i, int n, struct drawn *out)
{
    const struct pool *pool = &sample->pass->work->pool;
    int V = pool->n_candidates;
    (void)p, (void)cache, (void)z;
    if (V == 0)
        return false;
    /* below V, since what is drawn is a multiple of 2^-32; stratified over the pool */
    int v = (int)((i + sampler_number(&sample->choice, DRAW_LIGHT_END)) / n * V);
    *out = drawn_vertex(pool->candidate[v < V ? v : V - 1], 1.0 / V);
    return true;
}

static void prepare(const struct render_job *job, struct prepared *p)
{
    bool as_many = p->numbers.draws[FIRST_HIT] == 0;
    (void)job;
    for (int hit = 0; hit < EYE_HITS && as_many; hit++)
        if (p->numbers.draws[hit] == 0)
            p->numbers.draws[hit] = int_within(ceil(p->tables->light_vertices), 1, 1024);
}

static const struct field PARAMETERS[] = {
    PARAMETER("connections", FIELD_INTEGER, numbers.draws[FIRST_HIT], 4, 0, 1024,
              "light vertices drawn for each eye vertex; 0, as in the paper: as many as a light sub-path has on "
              "average", NULL),
    PARAMETER("pathpixels", FIELD_INTEGER, numbers.path_pixels, 1, 1, DEFAULT_TILE_SIZE * DEFAULT_TILE_SIZE,
              "pixels for each light sub-path", NULL),
    PARAMETER_LATER(-1), PARAMETER_CREDITS(false), PARAMETER_BOUND(false), PARAMETER_RACE(false), PARAMETER_POINTS(1),
    PARAMETER_GUIDE(false), PARAMETER_EMISSION(1), PARAMETER_TILES(DEFAULT_TILE_SIZE, 1),
    {.name = NULL}};

const struct method method_lvc = {
    .name = "lvc", .help = "light vertex cache [Davidovic 2014]: light vertices drawn uniformly from a tile's",
    .parameters = PARAMETERS, .numbers = NUMBERS_OF_PT, .rr_threshold = DEFAULT_RR_THRESHOLD, .vertices = true,
    .prepare = prepare, .build = build, .draw = draw, .render = selection_render};
