/* ris.c: resampled connections: a light vertex is drawn by one of the records nearby, and the weights take into account
 * how well.
 *
 * An eye vertex chooses one of the three records next to it (records.h), or none, and draws one light vertex from the
 * record's PMF, or, without a record, uniformly. Each choice c is a technique of its own [Nabata 2020a]:
 *     X = w_{s,c} F(v) / (K P_c PMF_c(v)),   P_c = 1/4,
 *     w_{s,c} = p_s N_{s,c} / (p_hit + p_direct + sum of p_s' N_{s',c'}).
 * A draw shares the pool with all others, so it counts like
 *     N_{s,c} = P_c / (1/K + (1 - 1/K) max(eps, Q_c / h_c)),     (for the uniform choice h_c = 1, Q_c = l)
 * samples of BDPT, Q_c being the expectation of the sum of h_c over a light sub-path: its second moment. That is a
 * function of the path and of what is independent of it: the records, and for Q_c what the nearest records of the
 * iteration before have met. h_c is taken with the luminance L of a light walk that met no roulette, and which mirrors
 * throw back in full, so that all strategies find the same. N is no linear function of L, so the weights are sums over
 * the arrays of the path, not mis.h's recursion, and they cost shadow rays: does x_{i-1} see the records next to x_i?
 *
 * K sub-paths of a tile are drawn from; all are for t = 1. Unlike in the paper they and the records are a tile's, not
 * the picture's, and s = 1 takes light points of its own. A light sub-path is splat in any tile, so t = 1 has mis.h's
 * weight, with lvc.c's count of connections, and the others share what that leaves. In the first iteration the paper
 * takes its own Q, which is biased; here an iteration is made up before it. Of the services (services.h) it has those
 * that its weights count.
 *
 * `weights = counts` draws the same and has the weights of pcbdpt.c, whose draws by place alone it is to the byte.
 *
 * Tests: test_ris.c, test_rivals.c.
 */
#include "rivals/ris.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "caustics/surfaces.h"
#include "rivals/plain.h"
#include "rivals/together.h"
#include "tables/emit.h"
#include "transport/counts.h"

const char *const RIS_WEIGHTS[] = {"counts", "nabata", NULL};
static const double EPSILON = 1e-3; /* no draw counts for more than a thousand */

/* --- the numbers N ----------------------------------------------------------------------------------- */

/* The records next to an eye end x, and which of them the light end y sees; kept, since the edges of an eye sub-path
 * are asked for in every weight. */
struct sight {
    vec3 x, y;
    int n, near[RECORDS_NEAR];
    bool sees[RECORDS_NEAR];
};

static struct sight look(const struct ris *r, const struct vertex *x, const struct vertex *y)
{
    struct sight s = {.x = x->p, .y = y->p};
    s.n = records_near(&r->records, r->scene, x, 0, s.near);
    for (int i = 0; i < s.n; i++)
        s.sees[i] = record_sees(&r->records.item[s.near[i]], r->scene, y);
    return s;
}

/* N of one technique for a light end of luminance L. */
static double worth(const struct ris *r, double P, double L, double h, double Q)
{
    int M2 = r->state->presampled;
    double share = 1.0 / r->K, ratio = fmin(fmax(EPSILON, Q / h), 1e30);
    if (!(h > 0))
        return 0;
    if (M2 > 0)
        ratio = (1 - 1.0 / M2) * ratio + r->previous_g / (M2 * L);
    return P / (share + (1 - share) * ratio);
}

/* Of the technique without a record. */
static double worth_alone(const struct ris *r, double P, double L)
{
    return r->u == NULL ? worth(r, P, L, 1, r->state->vertices) : worth(r, P, L, L, r->previous_g);
}

/* Of all techniques of an edge: light, of luminance L, comes from wo to the light end y. */
static double worth_edge(const struct ris *r, const struct sight *s, double L, const struct vertex *y, vec3 wo)
{
    double P = 1.0 / (s->n + 1), sum = L > 0 ? worth_alone(r, P, L) : 0;
    for (int i = 0; i < s->n; i++) {
        const struct record *c = &r->records.item[s->near[i]];
        if (s->sees[i])
            sum += worth(r, P, L, L * record_worth(c, r->scene, y, wo), c->expected);
    }
    return sum;
}

double ris_worth(const struct ris *r, const struct vertex *y, const struct vertex *z)
{
    struct sight s = look(r, z, y);
    return worth_edge(r, &s, r->light_L[y - r->pool.vertex], y, y->wo);
}

/* --- the weights ------------------------------------------------------------------------------------- */

/* Luminance that a light walk keeps at v, from wo towards wi. */
static double kept(const struct vertex *v, vec3 wo, vec3 wi)
{
    struct bsdf_value b = bsdf_eval(&v->bsdf, wo, wi, IMPORTANCE);
    double wo_ng = abs_dot(wo, v->ng), cosine = abs_dot(wo, v->bsdf.shading.n) * abs_dot(wi, v->ng);
    return b.pdf > 0 && wo_ng > 0 ? rgb_luminance(b.f) * cosine / (wo_ng * b.pdf) : 0;
}

/* Luminance on arrival at x_1 of what x_0 sends in direction w. */
static double emitted(const struct scene *scene, const struct vertex *x0, vec3 w)
{
    const struct light_set *lights = &scene->lights;
    struct light_point at = vertex_light_point(x0);
    bool sky = x0->kind == VERTEX_ESCAPED || lights->light[x0->light].kind == LIGHT_INFINITE;
    if (sky)
        return rgb_luminance(light_Le_environment(lights, neg(w), false)) * PI * sqr(lights->radius) /
               light_pdf_environment(lights, neg(w));
    double pdf = (x0->kind == VERTEX_LIGHT ? x0->pdf_fwd : x0->pdf_origin) * light_pdf_emission(lights, &at, w);
    double cosine = length2(x0->ng) > 0 ? abs_dot(x0->ng, w) : 1;
    return pdf > 0 ? rgb_luminance(light_Le(lights, &at, w)) * cosine / pdf : 0;
}

/* Where two sub-paths are joined: the last vertex of one, the vertex before it, and what of the former the other end
 * decides: its density in the other walk, measured as its pdf_fwd, and that, 1/sr, of going on to the vertex before. */
struct path_end {
    const struct vertex *v, *before;
    double pdf_other, pdf_rev;
};

/* Sums over the strategies of one side, relative to one sample of the own. */
struct sums {
    double plain, lens; /* by the counts of mis.h: all but t = 1, and t = 1 */
    double N;           /* by N: all but t = 1 */
};

static void count(const struct ris *r, struct sums *a, double ratio, double plain, double N)
{
    a->plain += mis_raise(r->counts, ratio * plain);
    a->N += ratio * N;
}

static void sum_light_side(const struct ris *r, const struct path_end *end, struct sums *a)
{
    const struct vertex *v = end->v;
    double ratio = 1, pdf_other = end->pdf_other, pdf_rev = end->pdf_rev;
    for (bool passed = false;; v--) {
        ratio *= pdf_other / v->pdf_fwd;
        if (v->kind == VERTEX_LIGHT) {
            count(r, a, ratio, v->mis_c, v->mis_c);
            return;
        }
        bool direct = v[-1].kind == VERTEX_LIGHT;
        if (!passed && !v->prev_delta)
            count(r, a, ratio, direct ? 1 : r->counts->connect[LATER_HIT], direct ? 1 : r->light_n[v - r->pool.vertex]);
        passed = v->prev_delta;
        pdf_other = pdf_rev * area_before(r->scene, &v[-1], v);
        pdf_rev = v[-1].pdf_rev;
    }
}

/* The light walk arrives at the end with luminance L from wo; s = 0: the end is x_0. */
static void sum_eye_side(struct ris *r, int s, const struct path_end *end, double L, vec3 wo, struct sums *a)
{
    const struct vertex *v = end->v, *before = end->before;
    double ratio = 1, pdf_other = end->pdf_other, pdf_rev = end->pdf_rev;
    for (bool passed = false;; v = before--) {
        bool light = s == 0 && v == end->v;
        ratio *= pdf_other / v->pdf_fwd;
        if (before->kind == VERTEX_LENS) {
            if (!passed && !v->prev_delta)
                a->lens = mis_raise(r->counts, ratio * r->counts->splat);
            return;
        }
        if (!passed && !v->prev_delta && light)
            count(r, a, ratio, 1, 1);
        else if (!passed && !v->prev_delta) {
            const struct vertex *lens = before;
            while (lens->kind != VERTEX_LENS)
                lens--;
            struct sight *known = &r->sight[before - lens];
            if (memcmp(&known->x, &before->p, sizeof known->x) != 0 || memcmp(&known->y, &v->p, sizeof known->y) != 0)
                *known = look(r, before, v);
            count(r, a, ratio, r->counts->connect[LATER_HIT], worth_edge(r, known, L, v, wo));
        }
        if (light)
            L = emitted(r->scene, v, v->wo);
        else if (!passed)
            L *= kept(v, wo, v->wo);
        passed = v->prev_delta;
        wo = neg(v->wo);
        pdf_other = pdf_rev * area_before(r->scene, before, v);
        pdf_rev = before->pdf_rev;
    }
}

/*   s  0: y is NULL, z is on the light; 1: y is y_0; else 2: of s >= 2 */
static double weigh(struct ris *r, int s, const struct path_end *y, const struct path_end *z)
{
    struct sums a = {0, 0, 0};
    double own = s == 2 ? r->own : 1, all = s == 2 ? r->all : 1, L = 0;
    vec3 w = neg(z->v->wo);
    if (s > 0) {
        sum_light_side(r, y, &a);
        w = vertex_at_infinity(r->scene, y->v) ? neg(y->v->wo) : normalize(sub(z->v->p, y->v->p));
        L = s == 1 ? emitted(r->scene, y->v, w) : r->light_L[y->v - r->pool.vertex] * kept(y->v, y->v->wo, w);
    }
    sum_eye_side(r, s, z, L, neg(w), &a);
    a.plain += mis_raise(r->counts, s == 2 ? r->counts->connect[LATER_HIT] : 1);
    return own / (all + a.N) * a.plain / (a.plain + a.lens);
}

struct connection ris_hit(struct ris *r, const struct vertex *prev, const struct vertex *z, int t)
{
    struct connection c = connect_hit(r->scene, r->counts, prev, z, t);
    if (t == 2 || rgb_is_black(c.value))
        return c;
    const struct vertex *end = z->lamp != NULL ? z->lamp : z;
    bool escaped = end->kind == VERTEX_ESCAPED;
    struct light_point at = vertex_light_point(end);
    if (escaped) {
        at.light = -1;
        at.w = neg(end->wo);
    }
    double pdf_emit = emit_pdf(&counts_tables(r->counts)->emission, &r->scene->lights, &at,
                               escaped ? prev->p : end->p, end->wo);
    const struct path_end z_end = {end, prev, end->pdf_origin, pdf_emit};
    c.weight = weigh(r, 0, NULL, &z_end);
    return c;
}

struct connection ris_lit(struct ris *r, const struct lit *l)
{
    const struct vertex *z = l->z;
    struct connection c = connect_lit(r->scene, r->counts, l);
    struct vertex y;
    if (rgb_is_black(c.value))
        return c;
    vertex_light_end(r->scene, r->counts, &l->at, &y);
    double pdf_emit = emit_pdf(&counts_tables(r->counts)->emission, &r->scene->lights, &l->at, z->p, neg(l->w));
    double pdf_z = pdf_emit * abs_dot(z->ng, l->w) * l->spread;
    const struct path_end y_end = {&y, NULL, l->pdf_z * l->at_light, 0}, z_end = {z, z - 1, pdf_z, l->pdf_rev_z};
    c.weight = weigh(r, 1, &y_end, &z_end);
    return c;
}

struct connection ris_joint(struct ris *r, const struct joint *j)
{
    struct connection c = connect_joint(r->scene, r->counts, j);
    const struct path_end y_end = {j->y, j->y - 1, j->pdf_z * j->area_y, j->pdf_rev_y};
    const struct path_end z_end = {j->z, j->z - 1, j->pdf_y * j->area_z, j->pdf_rev_z};
    if (!rgb_is_black(c.value))
        c.weight = weigh(r, 2, &y_end, &z_end);
    return c;
}

/* --- an iteration ------------------------------------------------------------------------------------ */

/* What is drawn from in an iteration. */
static void gather(struct ris *r, const struct tile_pass *pass, long iteration)
{
    arena_reset(&r->arena);
    r->K = r->state->sub_paths < r->pool.n ? r->state->sub_paths : r->pool.n;
    r->found = candidates_find(&r->pool);
    while (r->K < r->pool.n && r->found.n > 0 &&
           r->found.item[r->found.n - 1].y >= light_pool_path(&r->pool, r->K))
        r->found.n--;
    r->g = 0;
    for (int v = 0; v < r->found.n; v++)
        r->g += r->found.item[v].L / r->K;
    if (r->state->presampled > 0)
        ris2_presample(r, pass, iteration);
    records_place(&r->records, pass, &r->state->frozen, iteration, r->state->records);
    records_fill(&r->records, pass->job->scene, &r->found, r->u);
}

/* Q of a record: the mean of what those of the iteration before have met that are next to it. */
static double expect(const struct ris *r, const struct record *c)
{
    int near[RECORDS_NEAR], n = records_near(&r->previous, r->scene, &c->z, 0, near);
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += r->previous.item[near[i]].sum / r->K;
    return n > 0 ? sum / n : 0;
}

/* L of all light vertices, and N of their edges as they are met from the light. */
static void weigh_light_paths(struct ris *r)
{
    r->light_L = arena_alloc(&r->arena, r->pool.used * sizeof *r->light_L);
    r->light_n = arena_alloc(&r->arena, r->pool.used * sizeof *r->light_n);
    for (int k = 0; k < r->K; k++) {
        const struct vertex *path = light_pool_path(&r->pool, k);
        double *L = &r->light_L[r->pool.start[k]], *n = &r->light_n[r->pool.start[k]];
        for (int i = 1; i < r->pool.length[k]; i++) {
            const struct vertex *y = &path[i - 1];
            vec3 w = neg(path[i].wo);
            L[i] = i == 1 ? emitted(r->scene, y, w) : L[i - 1] * (path[i].prev_delta ? 1 : kept(y, y->wo, w));
            n[i] = i == 1 ? 1 : ris_worth(r, y, &path[i]);
        }
    }
}

void ris_begin(void *scratch, const void *state, const struct tile_pass *pass, long iteration)
{
    struct ris *r = scratch;
    const struct ris_state *s = state;
    r->scene = pass->job->scene;
    if (s->nabata && iteration == pass->first) { /* the same whatever pass comes before this */
        light_pool_fill(&r->pool, pass, &s->frozen, iteration - 1);
        gather(r, pass, iteration - 1);
        light_pool_fill(&r->pool, pass, &s->frozen, iteration);
    }
    struct records last = r->records;
    r->records = r->previous;
    r->previous = last;
    r->previous_g = r->g;
    gather(r, pass, iteration);
    if (!s->nabata)
        return;
    memset(r->sight, 0, (size_t)(s->frozen.max_depth + 2) * sizeof *r->sight);
    for (int i = 0; i < r->records.n; i++)
        r->records.item[i].expected = expect(r, &r->records.item[i]);
    weigh_light_paths(r);
}

static void join(struct ris *r, struct pooled_pixel *p, const struct candidate *c, const struct vertex *z, int t,
                 struct choice choice)
{
    struct joint j;
    struct connection made = {.weight = 0};
    if (c->s + t > p->sample.max_depth + 2)
        return;
    if (connect_join(c->y, z, &j))
        made = ris_joint(r, &j);
    pixel_add(&p->sample, &made, c->s, t, c->y, z, choice);
}

/* One draw; N of its technique, and of all of its strategy, are left for `weigh`. */
void ris_draw(void *scratch, const void *state, struct pooled_pixel *pixel, const struct vertex *z, int t)
{
    struct ris *r = scratch;
    const struct ris_state *s = state;
    int V = r->found.n, which;
    if (V == 0)
        return;
    struct mixture m = records_mixture(&r->records, r->scene, z, 0, s->nabata, V);
    int v = mixture_draw(&m, sampler_number(&pixel->draws, DRAW_LIGHT_END), &which);
    const struct candidate *c = &r->found.item[v];
    double u = r->u != NULL ? r->u[v] : 1, P = mixture_pmf(&m, v), each = 1.0 / (m.m + 1);
    if (s->nabata) {
        double L = r->light_L[c->y - r->pool.vertex], N[RECORDS_NEAR + 1];
        r->all = N[m.m] = worth_alone(r, each, L);
        for (int i = 0; i < m.m; i++)
            r->all += N[i] = worth(r, each, L, m.record[i]->h[v] * L / (c->L * u), m.record[i]->expected);
        r->own = N[which];
        P = each * (which < m.m ? m.record[which]->h[v] / m.record[which]->sum : 1.0 / V);
    }
    const struct choice choice = {P, u / (P * r->K)};
    if (P > 0 && s->nabata)
        join(r, pixel, c, z, t, choice);
    else if (P > 0) /* a record that met nothing has nothing to offer */
        pooled_join(pixel, c, z, t, choice);
}

/* As pixel_sum_eye. */
static void sum_eye(struct ris *r, struct pooled_pixel *p)
{
    for (int t = 2; t <= p->n; t++) {
        const struct vertex *z = &p->eye[t - 1];
        struct connection hit = ris_hit(r, z - 1, z, t), lit = {.weight = 0};
        struct lit l;
        pixel_add(&p->sample, &hit, 0, t, NULL, z, NO_CHOICE);
        if (z->kind != VERTEX_SURFACE || t > p->sample.max_depth + 1)
            continue;
        if (connect_light_point(r->scene, r->counts, z, &p->sample.sampler, 0, 1, &l))
            lit = ris_lit(r, &l);
        pixel_add(&p->sample, &lit, 1, t, NULL, z, NO_CHOICE);
    }
}

void ris_render(const struct preparation *m, const struct tile_pass *pass)
{
    struct ris *r = pass->work->scratch;
    if (!r->state->nabata) {
        pooled_render(m, pass);
        return;
    }
    for (long iteration = pass->first; iteration < pass->end; iteration++) {
        pooled_fill(m, pass, iteration);
        for (int i = 0, x, y; pass_pixel(pass, i, &x, &y); i++) {
            arena_reset(&pass->work->arena);
            struct pooled_pixel p = pooled_begin(m, pass, x, y, i, iteration);
            sum_eye(r, &p);
            pooled_connect(m, pass, &p);
            pooled_end(&p);
        }
    }
}

/* --- the row ----------------------------------------------------------------------------------------- */

void ris_scratch_init(void *scratch, const void *state)
{
    struct ris *r = scratch;
    r->state = state;
    r->sight = mem_alloc((size_t)r->state->frozen.max_depth + 2, sizeof *r->sight);
    r->counts = &r->state->frozen.counts;
}

void ris_scratch_free(void *scratch)
{
    struct ris *r = scratch;
    light_pool_free(&r->pool);
    records_free(&r->records);
    records_free(&r->previous);
    arena_free(&r->arena);
    free(r->sight);
}

void ris_prepare(const struct render_job *job, struct preparation *out)
{
    struct ris_state *s = out->state;
    int M = s->sub_paths;
    plain_prepare(job, out);
    if (!s->nabata)
        return;
    s->vertices = light_vertices_expected(job);
    for (int end = 0; end < EYE_ENDS; end++)
        s->frozen.counts.connect[end] = M / ((M - 1) * s->vertices + 1);
}

#define AT(member) offsetof(struct ris_state, member)
static const struct field PARAMETERS[] = {
    {"weights", FIELD_WORD, AT(nabata), 1, 0, 0, "what draws count for", RIS_WEIGHTS},
    {"subpaths", FIELD_INTEGER, AT(sub_paths), 50, 1, 1e6, "light sub-paths that are drawn from",
     NULL},
    {"records", FIELD_NUMBER, AT(records), RECORDS_SHARE, 0, 1, "share of pixels that have records", NULL},
    RIS_SERVICES,
    {.name = NULL}};

const struct method method_ris = {
    .name = "ris", .check = surfaces_alone,
    .help = "resampling [Nabata 2020a]: light vertices drawn by a record nearby, with weights to suit",
    .why = "one draw for each eye vertex from the tile's light vertices, by one of the records nearby or uniformly; "
           "scale 1 / (K P)",
    .parameters = PARAMETERS, .state_size = sizeof(struct ris_state), .scratch_size = sizeof(struct ris),
    .numbers = NUMBERS_OF_BDPT, .rr_threshold = DEFAULT_RR_THRESHOLD, .prepare = ris_prepare, .render = ris_render,
    .scratch_init = ris_scratch_init, .scratch_free = ris_scratch_free, .begin = ris_begin, .draw = ris_draw};
