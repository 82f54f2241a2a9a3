/* subspaces.c: `select = subspaces`: every eye vertex draws light vertices that are worth something where it is.
 *
 * As in vertices.c a light vertex stands for the sub-path that leads to it, and an eye vertex draws C of those that the
 * K sub-paths of a tile and iteration have. But the probability looks at both: with h(e,l) the worth of a light vertex
 * in region l to an eye vertex in region e (pairs.h), and L_v the luminance of beta_v,
 *     P(v|z) = h(e(z), l(v)) L_v / sum over the pool,
 * and a draw is weighted with 1 / (C K P). Given the pool, the expectation is the mean over its sub-paths whatever P
 * is, so this is unbiased for every table. It is drawn in two steps, region and then vertex, both by bisection of
 * cumulative sums, so that the C strata of one eye vertex lie over space. (One alias table for each region e that is
 * met would have to list all vertices; the sums of a region e list only the regions that hold any.)
 *
 * The MIS weights know it: the strategies count as credit C h(e(z), l(y)) samples (credit: pilot.c), a function of the
 * two surface points at the ends of the edge. [Su 2022] has subspaces of both kinds and a matrix of probabilities
 * between them; here the regions are cells of grids, and the table is learnt from trial connections.
 *
 * Tests: test_asbdpt.c.
 */
#include <stdlib.h>
#include <string.h>

#include "integrators/select.h"
#include "transport/pixel_sample.h"

/* A connectible vertex y_1, y_2 ... of the pool. */
struct candidate {
    const struct vertex *y;
    int s;            /* vertices of the light sub-path ending there */
    double L, before; /* luminance of beta; sum of those before it in its group */
};

/* The candidates that lie in one region. */
struct group {
    int region, first, n;
    double L; /* sum over them */
};

struct subspaces {
    struct light_pool pool; /* the first, see select.h */
    struct candidate *found, *candidate; /* [n], as traced and sorted by region; owned */
    size_t found_capacity, candidate_capacity;
    struct group *group; /* [n_groups], owned */
    size_t group_capacity;
    int *group_of; /* [light regions], owned */
    double *row;   /* [n_rows * n_groups] cumulative sums of h(e,.) L of the groups; owned */
    size_t row_capacity;
    int *row_of; /* [eye regions], row of a region, -1 if it was not met since the pool was filled; owned */
    int n, n_groups, n_rows;
};

static void *new_scratch(const void *selection)
{
    const struct selection *sel = selection;
    struct subspaces *v = mem_alloc(1, sizeof *v);
    v->group_of = mem_alloc((size_t)sel->learnt.light.n, sizeof *v->group_of);
    v->row_of = mem_alloc((size_t)sel->learnt.eye.n, sizeof *v->row_of);
    return v;
}

static void free_scratch(void *scratch)
{
    struct subspaces *v = scratch;
    light_pool_free(&v->pool);
    free(v->found);
    free(v->candidate);
    free(v->group);
    free(v->group_of);
    free(v->row);
    free(v->row_of);
    free(v);
}

/* --- the pool's vertices by region ------------------------------------------------------------------- */

static void find_candidates(struct subspaces *v)
{
    v->n = 0;
    for (int k = 0; k < v->pool.n; k++) {
        const struct vertex *path = light_pool_path(&v->pool, k);
        for (int i = 1; i < v->pool.length[k]; i++) {
            double L = rgb_luminance(path[i].beta);
            if (!vertex_connectible(&path[i]) || !(L > 0))
                continue;
            v->found = mem_grow(v->found, &v->found_capacity, (size_t)v->n + 1, sizeof *v->found);
            struct candidate c = {&path[i], i + 1, L, 0};
            v->found[v->n++] = c;
        }
    }
}

/* Groups in the order of their regions' numbers. */
static void make_groups(struct subspaces *v, int n_regions)
{
    memset(v->group_of, 0, (size_t)n_regions * sizeof *v->group_of);
    for (int i = 0; i < v->n; i++)
        v->group_of[v->found[i].y->light_region]++;
    v->n_groups = 0;
    for (int region = 0, first = 0; region < n_regions; region++) {
        int n = v->group_of[region];
        if (n == 0)
            continue;
        v->group = mem_grow(v->group, &v->group_capacity, (size_t)v->n_groups + 1, sizeof *v->group);
        struct group g = {region, first, 0, 0};
        v->group_of[region] = v->n_groups;
        v->group[v->n_groups++] = g;
        first += n;
    }
}

static void begin(void *scratch, const struct selection *sel, const struct tile_pass *pass, long iteration)
{
    struct subspaces *v = scratch;
    (void)pass;
    (void)iteration;
    find_candidates(v);
    make_groups(v, sel->learnt.light.n);
    v->candidate = mem_grow(v->candidate, &v->candidate_capacity, (size_t)v->n, sizeof *v->candidate);
    for (int i = 0; i < v->n; i++) {
        struct candidate c = v->found[i];
        struct group *g = &v->group[v->group_of[c.y->light_region]];
        c.before = g->L;
        g->L += c.L;
        v->candidate[g->first + g->n++] = c;
    }
    v->n_rows = 0;
    for (int e = 0; e < sel->learnt.eye.n; e++)
        v->row_of[e] = -1;
}

/* --- drawing ----------------------------------------------------------------------------------------- */

/* The cumulative sums of an eye region, made when it is first met. */
static const double *row_of_region(struct subspaces *v, const struct selection *sel, int e)
{
    size_t n = (size_t)v->n_groups;
    if (v->row_of[e] < 0) {
        const double *h = pairs_row(&sel->learnt.pairs, e);
        v->row = mem_grow(v->row, &v->row_capacity, (size_t)(v->n_rows + 1) * n, sizeof *v->row);
        double *row = &v->row[(size_t)v->n_rows * n], sum = 0;
        for (size_t g = 0; g < n; g++)
            row[g] = sum += h[v->group[g].region] * v->group[g].L;
        v->row_of[e] = v->n_rows++;
    }
    return &v->row[(size_t)v->row_of[e] * n];
}

static const struct candidate *draw(const struct subspaces *v, const double *row, double u, double *pmf)
{
    double total = row[v->n_groups - 1], target = u * total;
    int low = 0, high = v->n_groups - 1; /* the first group that ends beyond the target */
    while (low < high) {
        int middle = low + (high - low) / 2;
        if (row[middle] > target)
            high = middle;
        else
            low = middle + 1;
    }
    const struct group *g = &v->group[low];
    double before = low > 0 ? row[low - 1] : 0, share = row[low] - before;
    double within = (target - before) / share * g->L;
    int drawn = g->first, end = g->first + g->n; /* the last candidate that begins at or before it */
    while (end - drawn > 1) {
        int middle = drawn + (end - drawn) / 2;
        if (v->candidate[middle].before <= within)
            drawn = middle;
        else
            end = middle;
    }
    *pmf = share / total * v->candidate[drawn].L / g->L;
    return &v->candidate[drawn];
}

/* For trace.h: draw c of n for the eye vertex z. */
static void tell(const struct subspaces *v, const struct selection *sel, struct trace *trace, const struct vertex *z,
                 int t, const struct candidate *y, int c, int n, double P, double scale)
{
    double C = sel->connections[t > 2], h = pairs_row(&sel->learnt.pairs, z->eye_region)[y->y->light_region];
    if (trace->n_draws == 0)
        trace_note(trace, "the %d connectible vertices of the tile's K = %d light sub-paths, in %d regions", v->n,
                   v->pool.n, v->n_groups);
    trace_choose(trace, t, y->y - (y->s - 1), y->s, y->s, P, scale,
                 "draw %d of %d (C = %.4g): from eye region %d light region %d is worth h = %.4g; scale 1 / (C K P)",
                 c + 1, n, C, z->eye_region, y->y->light_region, h);
}

/* C draws on average for one eye vertex, stratified. */
static void connect_drawn(void *scratch, const struct selection *sel, struct pixel_sample *g,
                          const struct vertex *z, int t, struct sampler *sampler)
{
    struct subspaces *v = scratch;
    if (v->n == 0)
        return;
    double C = sel->connections[t > 2], whole = floor(C);
    int n = (int)whole + (C > whole && sampler_number(sampler, DRAW_HOW_MANY) < C - whole);
    const double *row = n > 0 ? row_of_region(v, sel, z->eye_region) : NULL;
    for (int c = 0; c < n; c++) {
        double pmf;
        const struct candidate *y = draw(v, row, (c + sampler_number(sampler, DRAW_LIGHT_END)) / n, &pmf);
        double scale = 1 / (C * pmf * v->pool.n);
        if (g->trace != NULL)
            tell(v, sel, g->trace, z, t, y, c, n, pmf, scale);
        if (y->s + t <= g->max_depth + 2)
            pixel_sum_pair(g, y->y, y->s, z, t, scale);
    }
}

static void render(const void *selection, const struct tile_pass *pass)
{
    static const struct pool_choice choice = {begin, NULL, connect_drawn};
    light_pool_render(selection, pass, &choice);
}

const struct tile_renderer render_subspaces = {render, new_scratch, free_scratch};
