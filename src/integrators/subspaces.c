/* subspaces.c: `select = subspaces`: every eye vertex draws light vertices by their expected contribution to its
 * region.
 *
 * As in vertices.c a light vertex represents the sub-path that ends there, and an eye vertex draws C of the light
 * vertices that the K sub-paths of a tile and iteration have. Here the probability depends on both ends. Let h(e,l) be
 * the worth of a light vertex in region l to an eye vertex in region e (pairs.h), and L_v the luminance of beta_v. Then
 *     P(v|z) = h(e(z), l(v)) L_v / sum over the pool,
 * and a draw has the factor 1 / (C K P). For a fixed pool the expectation is the mean over its sub-paths, whatever P
 * is, so the estimate is unbiased for every table. A draw has two steps, first the region and then the vertex, each by
 * bisection of cumulative sums. So the C strata of one eye vertex are distributed over space. (An alias table for each
 * region e would need all vertices. The sums of a region e need only the regions that have any.)
 *
 * The MIS weights take this into account: the strategies count as 2 C h(e(z), l(y)) samples, a function of the two
 * surface points at the ends of the edge. 2 is the credit of a draw (DRAW_CREDIT).
 * [Su 2022] has subspaces of eye and light sub-paths and a matrix of probabilities between them. Here the regions are
 * cells of grids, and the table is learnt from trial connections.
 *
 * Tests: test_asbdpt.c.
 */
#include <stddef.h>
#include <string.h>

#include "base/alias.h"
#include "integrators/pooled.h"
#include "integrators/services.h"

struct subspaces_state {
    struct frozen frozen;
    double delta;
    int probe;
};

/* The candidates in one region. */
struct group {
    int region, first, n;
    double L; /* sum of their L */
};

/* Everything but the pool is made in each iteration, and is in the pool's arena. */
struct subspaces {
    struct light_pool pool;      /* the first, see pooled.h */
    struct candidate *candidate; /* [n], sorted by region */
    double *before;              /* [n], sum of L of the candidates before it in its group */
    struct group *group;         /* [n_groups], in the order of their regions */
    int n_groups;
    double **row; /* [eye regions][n_groups + 1] cumulative sums of h(e,.) L over the groups; NULL: not made yet */
};

/* --- the pool's vertices by region ------------------------------------------------------------------- */

/* Make the groups: they have places for their members, but no members yet.
 *   group_of  out, [n_regions], number of the region's group, if it has one */
static void make_groups(struct subspaces *v, const struct candidates *found, int *group_of, int n_regions)
{
    memset(group_of, 0, (size_t)n_regions * sizeof *group_of);
    for (int i = 0; i < found->n; i++)
        group_of[found->item[i].y->light_region] += found->item[i].L > 0;
    v->group = arena_alloc(&v->pool.arena, (size_t)n_regions * sizeof *v->group);
    v->n_groups = 0;
    for (int region = 0, first = 0; region < n_regions; region++) {
        int n = group_of[region];
        if (n == 0)
            continue;
        group_of[region] = v->n_groups;
        v->group[v->n_groups++] = (struct group){region, first, 0, 0};
        first += n;
    }
}

static void begin(void *scratch, const void *state, const struct tile_pass *pass, long iteration)
{
    struct subspaces *v = scratch;
    const struct tables *tables = &((const struct subspaces_state *)state)->frozen.tables;
    struct arena *arena = &v->pool.arena;
    const struct candidates found = candidates_find(&v->pool);
    int *group_of = arena_alloc(arena, (size_t)tables->light.n * sizeof *group_of);
    (void)pass;
    (void)iteration;
    make_groups(v, &found, group_of, tables->light.n);
    v->candidate = arena_alloc(arena, (size_t)found.n * sizeof *v->candidate);
    v->before = arena_alloc(arena, (size_t)found.n * sizeof *v->before);
    for (int i = 0; i < found.n; i++) {
        struct candidate c = found.item[i];
        if (!(c.L > 0))
            continue;
        struct group *g = &v->group[group_of[c.y->light_region]];
        v->candidate[g->first + g->n] = c;
        v->before[g->first + g->n++] = g->L;
        g->L += c.L;
    }
    v->row = arena_alloc(arena, (size_t)tables->eye.n * sizeof *v->row);
    for (int e = 0; e < tables->eye.n; e++)
        v->row[e] = NULL;
}

/* --- drawing ----------------------------------------------------------------------------------------- */

/* The cumulative sums of an eye region, made at the first draw from it. */
static const double *row_of_region(struct subspaces *v, const struct tables *tables, int e)
{
    if (v->row[e] != NULL)
        return v->row[e];
    const double *h = pairs_row(&tables->pairs, e);
    double *row = v->row[e] = arena_alloc(&v->pool.arena, ((size_t)v->n_groups + 1) * sizeof *row);
    row[0] = 0;
    for (int g = 0; g < v->n_groups; g++)
        row[g + 1] = row[g] + h[v->group[g].region] * v->group[g].L;
    return row;
}

/* Draw a region, then a vertex, with the number u. */
static const struct candidate *find(const struct subspaces *v, const double *row, double u, double *pmf)
{
    double total = row[v->n_groups], target = u * total;
    int number = cumulative_find(row, v->n_groups, target);
    const struct group *g = &v->group[number];
    double share = row[number + 1] - row[number], within = (target - row[number]) / share * g->L;
    int i = g->first + cumulative_find(&v->before[g->first], g->n, within);
    *pmf = share / total * v->candidate[i].L / g->L;
    return &v->candidate[i];
}

/* C stratified draws for one eye vertex. */
static void draw(void *scratch, const void *state, struct pooled_pixel *p, const struct vertex *z, int t)
{
    struct subspaces *v = scratch;
    const struct subspaces_state *s = state;
    if (v->n_groups == 0)
        return;
    int C = s->frozen.numbers.draws[z->eye_end];
    const double *row = row_of_region(v, &s->frozen.tables, z->eye_region);
    for (int c = 0; c < C; c++) {
        struct choice choice;
        const struct candidate *y = find(v, row, (c + sampler_number(&p->draws, DRAW_LIGHT_END)) / C, &choice.pmf);
        choice.scale = 1 / (C * choice.pmf * v->pool.n);
        pooled_join(p, y, z, t, choice);
    }
}

/* --- preparing --------------------------------------------------------------------------------------- */

enum {
    LIGHT_CELLS = 16, /* number of light regions along the diagonal */
    DRAW_CREDIT = 2   /* stratified draws have less variance than independent ones */
};

static void prepare(const struct render_job *job, struct preparation *out)
{
    struct subspaces_state *s = out->state;
    const struct learn_options own = {.importance = true, .pairs = true, .light_cells = LIGHT_CELLS,
                                      .levels = REGION_LEVELS, .delta = s->delta};
    if (s->probe && services_trace_paths(job, out))
        return;
    services_learn(job, out, own);
    services_settle(job, out, DRAW_CREDIT);
    s->frozen.counts.most = fmin(sqr(out->size.tile), pixel_light_count(job)) / s->frozen.numbers.path_pixels;
}

#define AT(member) offsetof(struct subspaces_state, member)
static const struct field PARAMETERS[] = {
    {"connections", FIELD_INTEGER, AT(frozen.numbers.draws[FIRST_HIT]), 3, 1, 1024,
     "light vertices drawn for each eye vertex that the camera sees", NULL},
    {"later", FIELD_INTEGER, AT(frozen.numbers.draws[LATER_HIT]), 1, 1, 1024,
     "light vertices drawn for each other eye vertex", NULL},
    {"pathpixels", FIELD_INTEGER, AT(frozen.numbers.path_pixels), 1, 1, DEFAULT_TILE_SIZE * DEFAULT_TILE_SIZE,
     "pixels for each light sub-path", NULL},
    {"delta", FIELD_NUMBER, AT(delta), 0.1, 1e-6, 1, "share of draws that ignore what was learnt", NULL},
    {"probe", FIELD_WORD, AT(probe), true, 0, 0,
     "check first whether light sub-paths are worth their time, and trace paths if they are not", OFF_ON},
    SERVICES(true, 0.2, 4, MAX_TILE_SIZE, POOL_SPREAD),
    {.name = NULL}};

const struct method method_subspaces = {
    .name = "asbdpt", .select = "subspaces", .help = "light vertices by what they are worth where the eye vertex is",
    .why = "C draws for each eye vertex from the connectible vertices of the tile's K light sub-paths, in proportion "
           "to h(e,l) luminance(beta), by the regions of both; scale 1 / (C K P)",
    .parameters = PARAMETERS,
    .state_size = sizeof(struct subspaces_state), .scratch_size = sizeof(struct subspaces),
    .numbers = {.light_points = 2, .path_tracing = true}, .rr_threshold = DEFAULT_RR_THRESHOLD, .prepare = prepare,
    .render = pooled_render, .scratch_free = light_pool_free, .begin = begin, .draw = draw};
