/* vertices.c: `select = vertices`, `lvc`: every eye vertex draws light vertices from one table over a tile's pool.
 *
 * A light vertex y_{s-1} *is* the sub-path y_0 ... y_{s-1} that leads to it: a pool of vertices to draw from, as the
 * light vertex cache [Davidovic 2014], which draws uniformly. All connectible ones of the K sub-paths of a tile and
 * iteration, one for every `path_pixels` pixels, go into one alias table with
 *     q_v = L_v n(x_v) / sum,      L_v = luminance(beta_v),      n(x) = 2 C ((1 - delta) E(x) / mean + delta),
 * E being the importance of the place (importance.h), defensively mixed [Hesterberg 1995], and `mean` its expectation
 * over a light sub-path, and each eye vertex (t >= 2) draws C of them. The sum over all vertices of all K sub-paths,
 * divided by K, is what BDPT estimates with one sub-path; drawing v with probability q_v and weighting with 1/q_v
 * estimates the same sum, so
 *     (1/C) sum over draws of F(v) / (K q_v)
 * has BDPT's expectation. s = 0, s = 1 and t = 1 stay as they are, every pooled sub-path being splat once.
 *
 * The MIS weights know about it: strategies s >= 2, t >= 2 ending at light position x take about n(x) samples per
 * pixel, a function of the surface point alone, so all strategies of a path agree on it (mis.h). The 2 is a credit,
 * which s = 1 has too (VERTICES_CREDIT of asbdpt.c says why); any frozen count is unbiased.
 *
 * `select = lvc` is the light vertex cache itself, a rival: all V vertices are equally likely, q_v = 1/V. An eye vertex
 * takes each of them C/V times, where BDPT, with one of K sub-paths, takes it 1/K times: C K/V times as often, about
 * C/l, l being the expected number of connectible vertices of a light sub-path. That is the count, with no credit. l is
 * frozen by a pre-pass: the pool's own V/K would make a vertex' weight depend on what else is in the pool, which biases
 * small pools.
 *
 * Tests: test_asbdpt.c.
 */
#include <stdlib.h>

#include "base/alias.h"
#include "base/number.h"
#include "integrators/select.h"
#include "transport/pixel_sample.h"

struct vertices {
    struct light_pool pool; /* the first, see select.h */
    const struct vertex **candidate; /* [n], connectible light vertices; owned */
    int *s;                          /* [n], vertices of the light sub-path ending there; owned */
    double *q;                       /* [n], weights of the table; owned */
    size_t candidate_capacity, s_capacity, q_capacity;
    struct alias_table table;
};

static void *new_scratch(const void *selection)
{
    (void)selection;
    return mem_alloc(1, sizeof(struct vertices));
}

static void free_scratch(void *scratch)
{
    struct vertices *v = scratch;
    light_pool_free(&v->pool);
    free(v->candidate);
    free(v->s);
    free(v->q);
    alias_free(&v->table);
    free(v);
}

/* The weight of a vertex in the table. One that carries no usable amount of light is never drawn. */
static double weight_of(const struct selection *sel, const struct vertex *y, struct tile *tile)
{
    if (sel->select == SELECT_LVC)
        return 1;
    double q = rgb_luminance(y->beta) * mis_connect_count(&sel->counts, y->light_region, 0, true);
    if (q >= 0 && fits_float(q))
        return q;
    tile->nonfinite++;
    return 0;
}

/* The table over the pool's connectible vertices y_1, y_2 ... */
static void begin(void *scratch, const struct selection *sel, const struct tile_pass *pass, long iteration)
{
    struct vertices *v = scratch;
    size_t n = 0;
    (void)iteration;
    for (int k = 0; k < v->pool.n; k++) {
        const struct vertex *path = light_pool_path(&v->pool, k);
        for (int i = 1; i < v->pool.length[k]; i++) {
            if (!vertex_connectible(&path[i]))
                continue;
            v->candidate = mem_grow(v->candidate, &v->candidate_capacity, n + 1, sizeof *v->candidate);
            v->s = mem_grow(v->s, &v->s_capacity, n + 1, sizeof *v->s);
            v->q = mem_grow(v->q, &v->q_capacity, n + 1, sizeof *v->q);
            v->candidate[n] = &path[i];
            v->s[n] = i + 1;
            v->q[n++] = weight_of(sel, &path[i], pass->tile);
        }
    }
    alias_build(&v->table, v->q, (int)n);
}

/* For trace.h: draw c of C. */
static void tell(const struct vertices *v, struct trace *trace, int t, int i, int c, int C, double u, double q,
                 double scale)
{
    const struct vertex *y = v->candidate[i];
    if (trace->n_draws == 0)
        trace_note(trace, "alias table over the V = %d connectible vertices of the tile's K = %d light sub-paths",
                   v->table.n, v->pool.n);
    trace_choose(trace, t, y - (v->s[i] - 1), v->s[i], v->s[i], q, scale,
                 "draw %d of C = %d, u = %.4f in [%d/%d, %d/%d): vertex %d of V, region %d; scale 1 / (C K q)", c + 1,
                 C, u, c, C, c + 1, C, i, y->light_region);
}

/* C draws for one eye vertex, stratified over the table. */
static void connect_drawn(void *scratch, const struct selection *sel, struct pixel_sample *g,
                          const struct vertex *z, int t, struct sampler *sampler)
{
    const struct vertices *v = scratch;
    int C = v->table.n > 0 ? (int)sel->connections[0] : 0;
    for (int c = 0; c < C; c++) {
        double q, u = (c + sampler_number(sampler, DRAW_LIGHT_END)) / C;
        int i = alias_sample(&v->table, u, &q, NULL);
        double scale = 1 / (C * q * v->pool.n);
        if (g->trace != NULL)
            tell(v, g->trace, t, i, c, C, u, q, scale);
        if (v->s[i] + t <= g->max_depth + 2)
            pixel_sum_pair(g, v->candidate[i], v->s[i], z, t, scale);
    }
}

static void render(const void *selection, const struct tile_pass *pass)
{
    static const struct pool_choice choice = {begin, NULL, connect_drawn};
    light_pool_render(selection, pass, &choice);
}

const struct tile_renderer render_vertices = {render, new_scratch, free_scratch};
