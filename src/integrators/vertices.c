/* vertices.c: `select = vertices`: every eye vertex draws light vertices from one table over a tile's pool.
 *
 * A light vertex y_{s-1} represents the sub-path y_0 ... y_{s-1} that ends there. So a pool of sub-paths is a pool of
 * vertices, as in the light vertex cache [Davidovic 2014], which draws uniformly. A tile traces K sub-paths in an
 * iteration, one for every `path_pixels` pixels. One alias table has all their connectible vertices, with
 *     q_v = L_v n(x_v) / sum,      L_v = luminance(beta_v),      n(x) = 2 C ((1 - delta) E(x) / mean + delta).
 * E is the importance of the place (importance.h), and `mean` its expectation over a light sub-path. The mixture is
 * defensive [Hesterberg 1995]. Each eye vertex (t >= 2) draws C vertices. BDPT estimates, with one sub-path, the sum
 * over all vertices of all K sub-paths divided by K. A draw of v with probability q_v and factor 1/q_v estimates the
 * same sum, so
 *     (1/C) sum over draws of F(v) / (K q_v)
 * has BDPT's expectation. s = 0, s = 1 and t = 1 are as in BDPT; every sub-path of the pool is splat once.
 *
 * The MIS weights take this into account: strategies s >= 2, t >= 2 with their light end at x take about n(x) samples
 * per pixel. n is a function of the surface point alone, so all strategies of a path compute the same n (mis.h). The
 * factor 2 is a credit for stratified draws. Any count that does not change is unbiased.
 *
 * Tests: test_asbdpt.c.
 */
#include <stddef.h>

#include "base/alias.h"
#include "base/number.h"
#include "integrators/pooled.h"
#include "integrators/services.h"
#include "transport/counts.h"

enum { IMPORTANCE_CELLS = 64 }; /* along the scene's diagonal */

struct vertices_state {
    struct frozen frozen;
    double delta;
};

struct vertices {
    struct light_pool pool; /* the first, see pooled.h */
    struct candidates found;
    struct alias_table table;
};

static void free_scratch(void *scratch)
{
    struct vertices *v = scratch;
    light_pool_free(&v->pool);
    alias_free(&v->table);
}

/* --- drawing ----------------------------------------------------------------------------------------- */

/* A vertex without a usable weight is never drawn. */
static void begin(void *scratch, const void *state, const struct tile_pass *pass, long iteration)
{
    struct vertices *v = scratch;
    const struct vertices_state *s = state;
    (void)iteration;
    v->found = candidates_find(&v->pool);
    double *weight = arena_alloc(&v->pool.arena, (size_t)v->found.n * sizeof *weight);
    for (int i = 0; i < v->found.n; i++) {
        const struct candidate *c = &v->found.item[i];
        double q = c->L * n_connect(&s->frozen.counts, c->y->light_region, 0, FIRST_HIT);
        bool usable = q >= 0 && isfinite(q);
        weight[i] = usable ? q : 0;
        pass->tile->nonfinite += !usable;
    }
    alias_build(&v->table, weight, v->found.n);
}

/* C draws for one eye vertex, stratified over the table. */
static void draw(void *scratch, const void *state, struct pooled_pixel *p, const struct vertex *z, int t)
{
    const struct vertices *v = scratch;
    const struct vertices_state *s = state;
    int C = v->table.n > 0 ? s->frozen.numbers.draws[z->eye_end] : 0;
    for (int c = 0; c < C; c++) {
        struct choice choice;
        int i = alias_sample(&v->table, (c + sampler_number(&p->draws, DRAW_LIGHT_END)) / C, &choice.pmf, NULL);
        choice.scale = 1 / (C * choice.pmf * v->pool.n);
        pooled_join(p, &v->found.item[i], z, t, choice);
    }
}

/* --- preparing --------------------------------------------------------------------------------------- */

/* h(l) = (1 - delta) E(l) / mean + delta, the same for all eye vertices. */
static struct pairs pairs_from_importance(const struct tables *t, double delta)
{
    double *row = mem_alloc((size_t)t->light.n, sizeof *row);
    for (int y = 0; y < t->light.n; y++)
        row[y] = (1 - delta) * importance_in(&t->importance, y) / t->importance.mean + delta;
    return pairs_from_row(row, t->light.n);
}

static void prepare(const struct render_job *job, struct preparation *out)
{
    const struct vertices_state *s = out->state;
    struct frozen *f = out->state;
    const struct learn_options own = {.importance = true, .light_cells = IMPORTANCE_CELLS, .levels = 1};
    services_learn(job, out, own);
    f->numbers.draws[LATER_HIT] = f->numbers.draws[FIRST_HIT];
    if (f->tables.importance.mean > 0)
        f->tables.pairs = pairs_from_importance(&f->tables, s->delta);
    services_settle(job, out, 2);
}

#define AT(member) offsetof(struct vertices_state, member)
static const struct field PARAMETERS[] = {
    {"connections", FIELD_INTEGER, AT(frozen.numbers.draws[FIRST_HIT]), 4, 1, 1024,
     "light vertices drawn for each eye vertex", NULL},
    {"pathpixels", FIELD_INTEGER, AT(frozen.numbers.path_pixels), 2, 1, DEFAULT_TILE_SIZE * DEFAULT_TILE_SIZE,
     "pixels for each light sub-path", NULL},
    {"delta", FIELD_NUMBER, AT(delta), 0.1, 1e-6, 1, "share of draws that ignore it", NULL},
    SERVICES(true, 1, 2, DEFAULT_TILE_SIZE, POOL_SPREAD),
    {.name = NULL}};

const struct method method_vertices = {
    .name = "asbdpt", .select = "vertices", .help = "one alias table over the light vertices of a tile",
    .why = "C draws for each eye vertex from an alias table over the connectible vertices of the tile's K light "
           "sub-paths, q in proportion to luminance(beta) n(x); scale 1 / (C K q)",
    .parameters = PARAMETERS,
    .state_size = sizeof(struct vertices_state), .scratch_size = sizeof(struct vertices),
    .numbers = {.light_points = 1, .path_tracing = true}, .rr_threshold = DEFAULT_RR_THRESHOLD, .prepare = prepare,
    .render = pooled_render, .scratch_free = free_scratch, .begin = begin, .draw = draw};
