/* lvc.c: the light vertex cache: all light vertices of a tile's pool are equally likely.          [Davidovic 2014]
 *
 * Each eye vertex (t >= 2) draws C of the V connectible vertices of the K light sub-paths, each with probability 1/V:
 *     (1/C) sum over draws of F(v) V / K
 * has BDPT's expectation. It takes each vertex C/V times, where BDPT, with one of K sub-paths, takes it 1/K times:
 * C K/V times as often, about C/l, l being the expected number of connectible vertices of a light sub-path. That is the
 * count, with no credit. l is frozen before the render: the pool's own V/K would make a vertex' weight depend on what
 * else is in the pool, which biases small pools. s = 0, s = 1 and t = 1 stay as they are, lights are chosen by power.
 *
 * Tests: test_asbdpt.c.
 */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

#include "base/number.h"
#include "rivals/plain.h"
#include "rivals/records.h"

struct lvc_state {
    struct frozen frozen;
    int connections; /* 0: as many as a light sub-path has vertices; else draws */
};

struct lvc {
    struct light_pool pool; /* the first, see pooled.h */
    struct candidates found;
};

static void begin(void *scratch, const void *state, const struct tile_pass *pass, long iteration)
{
    struct lvc *v = scratch;
    (void)state;
    (void)pass;
    (void)iteration;
    v->found = candidates_find(&v->pool);
}

/* C draws for one eye vertex, stratified over the pool. */
static void draw(void *scratch, const void *state, struct pooled_pixel *p, const struct vertex *z, int t)
{
    const struct lvc *v = scratch;
    const struct lvc_state *s = state;
    int V = v->found.n, C = V > 0 ? s->frozen.numbers.draws[z->eye_end] : 0;
    const struct choice choice = {1.0 / V, 1 / (C * (1.0 / V) * v->pool.n)};
    for (int c = 0; c < C; c++) {
        /* below V, since what is drawn is a multiple of 2^-32 */
        int i = (int)((c + sampler_number(&p->draws, DRAW_LIGHT_END)) / C * V);
        pooled_join(p, &v->found.item[i < V ? i : V - 1], z, t, choice);
    }
}

/* Where light sub-paths have no vertex to connect to there is nothing to be counted. */
static void prepare(const struct render_job *job, struct preparation *out)
{
    struct lvc_state *s = out->state;
    double l = light_vertices_expected(job);
    int C = s->connections > 0 ? s->connections : int_within(ceil(l), 1, 1024);
    s->frozen.numbers.draws[FIRST_HIT] = s->frozen.numbers.draws[LATER_HIT] = C;
    plain_prepare(job, out);
    for (int end = 0; end < EYE_ENDS && l > 0; end++)
        s->frozen.counts.connect[end] /= l;
}

#define AT(member) offsetof(struct lvc_state, member)
static const struct field PARAMETERS[] = {
    {"connections", FIELD_INTEGER, AT(connections), 4, 0, 1024,
     "light vertices drawn for each eye vertex; 0, as in the paper: as many as a light sub-path has on average", NULL},
    {"pathpixels", FIELD_INTEGER, AT(frozen.numbers.path_pixels), 1, 1, DEFAULT_TILE_SIZE * DEFAULT_TILE_SIZE,
     "pixels for each light sub-path", NULL},
    SERVICES(false, 1, 1, DEFAULT_TILE_SIZE, 1),
    {.name = NULL}};

const struct method method_lvc = {
    .name = "lvc", .help = "light vertex cache [Davidovic 2014]: light vertices drawn uniformly from a tile's",
    .why = "C draws for each eye vertex from the V connectible vertices of the tile's K light sub-paths, all equally "
           "likely; scale V / (C K)",
    .parameters = PARAMETERS,
    .state_size = sizeof(struct lvc_state), .scratch_size = sizeof(struct lvc),
    .numbers = {.light_points = 1, .path_tracing = true}, .rr_threshold = DEFAULT_RR_THRESHOLD, .prepare = prepare,
    .render = pooled_render,
    .scratch_free = light_pool_free,
    .begin = begin, .draw = draw};
