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
 * takes its own Q, which is biased; here an iteration is made up before it. With credits, N has that of a draw, and
 * s = 0 and s = 1 at a first hit have that of direct light; N has a bound of its own.
 *
 * `weights = counts` draws the same and has the weights of pcbdpt.c, whose draws by place alone it is to the byte.
 *
 * Tests: test_rival_parts.c, test_rivals.c.
 */
#include "rivals/ris.h"

#include <string.h>

#include "caustics/derived.h"
#include "caustics/surfaces.h"
#include "rivals/together.h"
#include "tables/emission.h"

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

static struct sight look(const struct cache *r, const struct vertex *x, const struct vertex *y)
{
    struct sight s = {.x = x->p, .y = y->p};
    s.n = records_near(&r->records, r->scene, x, 0, s.near);
    for (int i = 0; i < s.n; i++)
        s.sees[i] = record_sees(&r->records.item[s.near[i]], r->scene, y);
    return s;
}

/* N of one technique for a light end of luminance L. */
static double worth(const struct cache *r, double P, double L, double h, double Q)
{
    int M2 = r->own->presampled;
    double share = 1.0 / r->K, ratio = fmin(fmax(EPSILON, Q / h), 1e30);
    if (!(h > 0))
        return 0;
    if (M2 > 0)
        ratio = (1 - 1.0 / M2) * ratio + r->previous_g / (M2 * L);
    return r->credit * P / (share + (1 - share) * ratio);
}

/* Of the technique without a record. */
static double worth_alone(const struct cache *r, double P, double L)
{
    return r->u == NULL ? worth(r, P, L, 1, r->vertices) : worth(r, P, L, L, r->previous_g);
}

/* Of all techniques of an edge: light, of luminance L, comes from wo to the light end y. */
static double worth_edge(const struct cache *r, const struct sight *s, double L, const struct vertex *y, vec3 wo)
{
    double P = 1.0 / (s->n + 1), sum = L > 0 ? worth_alone(r, P, L) : 0;
    for (int i = 0; i < s->n; i++) {
        const struct record *c = &r->records.item[s->near[i]];
        if (s->sees[i])
            sum += worth(r, P, L, L * record_worth(c, r->scene, y, wo), c->expected);
    }
    return sum;
}

double ris_worth(const struct cache *r, const struct vertex *y, const struct vertex *z)
{
    struct sight s = look(r, z, y);
    return worth_edge(r, &s, r->light_L[y - r->pool->vertex], y, y->wo);
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
    struct light_point at = vertex_light_point(scene, x0);
    double pdf = at.pdf * light_pdf_emission(&scene->lights, &at, w);
    return pdf > 0 ? rgb_luminance(light_Le(&scene->lights, &at, w)) * vertex_cosine(x0, w) / pdf : 0;
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

static void count(struct sums *a, double ratio, double plain, double N)
{
    a->plain += ratio * plain;
    a->N += ratio * N;
}

/* s = 1: of an eye vertex z and a point of a light's cell. */
static void count_direct(const struct cache *r, struct sums *a, double ratio, const struct vertex *z, enum eye_hit hit,
                         int cell)
{
    double n = n_s1(r->counts, z->place, hit, cell);
    count(a, ratio, n, n);
}

static void sum_light_side(const struct cache *r, const struct path_end *end, struct sums *a)
{
    const struct vertex *v = end->v;
    double ratio = 1, pdf_other = end->pdf_other, pdf_rev = end->pdf_rev;
    for (bool passed = false;; v--) {
        ratio *= pdf_other / v->pdf_fwd;
        if (v->kind == VERTEX_LIGHT) {
            count(a, ratio, v->mis_c, v->mis_c);
            return;
        }
        bool direct = v[-1].kind == VERTEX_LIGHT;
        if (!passed && !v->prev_delta)
            direct ? count_direct(r, a, ratio, v, LATER_HIT, v[-1].place)
                   : count(a, ratio, r->counts->pair[LATER_HIT], r->light_n[v - r->pool->vertex]);
        passed = v->prev_delta;
        pdf_other = pdf_rev * v->g;
        pdf_rev = vertex_pdf_rev(&v[-1], v, IMPORTANCE);
    }
}

/* The light walk arrives at the end with luminance L from wo; s = 0: the end is x_0. */
static void sum_eye_side(struct cache *r, int s, const struct path_end *end, double L, vec3 wo, struct sums *a)
{
    const struct vertex *v = end->v, *before = end->before;
    double ratio = 1, pdf_other = end->pdf_other, pdf_rev = end->pdf_rev;
    for (bool passed = false;; v = before--) {
        bool light = s == 0 && v == end->v;
        ratio *= pdf_other / v->pdf_fwd;
        if (before->kind == VERTEX_LENS) {
            if (!passed && !v->prev_delta)
                a->lens = ratio * r->counts->lens;
            return;
        }
        if (!passed && !v->prev_delta && light)
            count_direct(r, a, ratio, before, before->eye_hit, vertex_light_point(r->scene, v).cell);
        else if (!passed && !v->prev_delta) {
            const struct vertex *lens = before;
            while (lens->kind != VERTEX_LENS)
                lens--;
            struct sight *known = &r->sight[before - lens];
            if (memcmp(&known->x, &before->p, sizeof known->x) != 0 || memcmp(&known->y, &v->p, sizeof known->y) != 0)
                *known = look(r, before, v);
            count(a, ratio, r->counts->pair[LATER_HIT], worth_edge(r, known, L, v, wo));
        }
        if (light)
            L = emitted(r->scene, v, v->wo);
        else if (!passed)
            L *= kept(v, wo, v->wo);
        passed = v->prev_delta;
        wo = neg(v->wo);
        pdf_other = pdf_rev * v->g;
        pdf_rev = vertex_pdf_rev(before, v, RADIANCE);
    }
}

/*   s  0: y is NULL, z is on the light; 1: y is y_0; else 2: of s >= 2
 *   n  its count, if s < 2 */
static double weigh(struct cache *r, int s, double n, const struct path_end *y, const struct path_end *z)
{
    struct sums a = {0, 0, 0};
    double own = s == 2 ? r->one : n, all = s == 2 ? r->all : n, L = 0;
    vec3 w = neg(z->v->wo);
    if (s > 0) {
        sum_light_side(r, y, &a);
        w = vertex_at_infinity(r->scene, y->v) ? neg(y->v->wo) : normalize(sub(z->v->p, y->v->p));
        L = s == 1 ? emitted(r->scene, y->v, w) : r->light_L[y->v - r->pool->vertex] * kept(y->v, y->v->wo, w);
    }
    sum_eye_side(r, s, z, L, neg(w), &a);
    a.plain += s == 2 ? r->counts->pair[LATER_HIT] : n;
    return own / (all + a.N) * a.plain / (a.plain + a.lens);
}

struct connection ris_hit(struct cache *r, const struct vertex *prev, const struct vertex *z, int t)
{
    struct connection c = connect_s0(r->scene, r->counts, prev, z);
    if (t == 2 || rgb_is_black(c.value))
        return c;
    const struct vertex *end = z->lamp != NULL ? z->lamp : z;
    struct light_point at = vertex_light_point(r->scene, end);
    double pdf_emit = emission_pdf(&r->counts->tables->emission, &r->scene->lights, &at,
                                   end->kind == VERTEX_ESCAPED ? prev->p : end->p, end->wo);
    const struct path_end z_end = {end, prev, at.pdf, pdf_emit};
    c.weight = weigh(r, 0, r->counts->s0[prev->eye_hit], NULL, &z_end);
    return c;
}

struct connection ris_lit(struct cache *r, const struct lit *l)
{
    const struct vertex *z = l->z;
    struct connection c = connect_lit(r->scene, r->counts, l);
    if (rgb_is_black(c.value))
        return c;
    struct vertex y = light_vertex(r->scene, r->counts, &l->at);
    y.mis_c = y.mis_c > 0 ? r->counts->s0[z->eye_hit] : 0;
    double pdf_emit = emission_pdf(&r->counts->tables->emission, &r->scene->lights, &l->at, z->p, neg(l->w));
    double pdf_z = pdf_emit * vertex_cosine(z, l->w) * l->falloff;
    const struct path_end y_end = {&y, NULL, l->pdf_z * l->at_light, 0}, z_end = {z, z - 1, pdf_z, l->pdf_rev_z};
    c.weight = weigh(r, 1, n_s1(r->counts, z->place, z->eye_hit, l->at.cell), &y_end, &z_end);
    return c;
}

struct connection ris_joint(struct cache *r, const struct joint *j)
{
    struct connection c = connect_joint(r->scene, r->counts, j);
    const struct path_end y_end = {j->y, j->y - 1, j->pdf_z * j->area_y, j->pdf_rev_y};
    const struct path_end z_end = {j->z, j->z - 1, j->pdf_y * j->area_z, j->pdf_rev_z};
    if (!rgb_is_black(c.value))
        c.weight = weigh(r, 2, 0, &y_end, &z_end);
    return c;
}

/* --- drawing ----------------------------------------------------------------------------------------- */

/* What is drawn from in an iteration. */
static void gather(struct cache *r, const struct prepared *p, const struct tile_pass *pass, struct arena *arena,
                   long iteration)
{
    struct pool *pool = &pass->work->pool;
    r->own = p->own;
    r->scene = pass->job->scene;
    r->counts = pass->counts;
    r->credit = p->parameters.credits ? PAIR_CREDIT : 1;
    r->pool = pool;
    r->K = r->own->sub_paths < pool->n ? r->own->sub_paths : pool->n;
    pool_find_candidates(pool);
    r->found = pool->candidate;
    r->V = pool->n_candidates;
    while (r->K < pool->n && r->V > 0 && r->found[r->V - 1] >= pool_path(pool, r->K))
        r->V--;
    r->g = 0;
    for (int v = 0; v < r->V; v++)
        r->g += rgb_worth(r->found[v]->beta) / r->K;
    if (r->own->presampled > 0)
        ris2_presample(r, pass, arena, iteration);
    r->records = records_place(p, pass, arena, iteration, r->own->records);
    records_fill(&r->records, arena, r->scene, r->found, r->V, r->u);
}

struct cache *ris_build(const struct prepared *p, const struct tile_pass *pass, long iteration)
{
    struct arena *arena = &pass->work->pool.arena;
    struct cache *r = arena_alloc(arena, sizeof *r);
    *r = (struct cache){.scene = NULL};
    gather(r, p, pass, arena, iteration);
    return r;
}

/* A record that met nothing has nothing to offer. */
bool ris_draw(const struct prepared *p, const struct cache *r, struct sample *sample, const struct vertex *z,
              int i, int n, struct drawn *out)
{
    int which;
    (void)p;
    if (r->V == 0)
        return false;
    struct mixture m = records_mixture(&r->records, r->scene, z, r->own->normals, false, r->V);
    int v = mixture_draw(&m, (i + sampler_number(&sample->choice, DRAW_LIGHT_END)) / n, &which);
    double u = r->u != NULL ? r->u[v] : 1;
    *out = drawn_vertex(r->found[v], mixture_pmf(&m, v) * r->K / r->pool->n / u); /* of all that the pool has */
    return true;
}

/* --- drawing with weights to suit -------------------------------------------------------------------- */

/* Q of a record: the mean of what those of the iteration before have met that are next to it. */
static double expect(const struct cache *r, const struct record *c)
{
    int near[RECORDS_NEAR], n = records_near(&r->previous, r->scene, &c->z, 0, near);
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += r->previous.item[near[i]].sum / r->K;
    return n > 0 ? sum / n : 0;
}

/* L of all light vertices, and N of their edges as they are met from the light. */
static void weigh_light_paths(struct cache *r, struct arena *arena)
{
    r->light_L = arena_alloc(arena, r->pool->used * sizeof *r->light_L);
    r->light_n = arena_alloc(arena, r->pool->used * sizeof *r->light_n);
    for (int k = 0; k < r->K; k++) {
        const struct vertex *path = pool_path(r->pool, k);
        double *L = &r->light_L[r->pool->start[k]], *n = &r->light_n[r->pool->start[k]];
        for (int i = 1; i < r->pool->length[k]; i++) {
            const struct vertex *y = &path[i - 1];
            vec3 w = neg(path[i].wo);
            L[i] = i == 1 ? emitted(r->scene, y, w) : L[i - 1] * (path[i].prev_delta ? 1 : kept(y, y->wo, w));
            n[i] = i == 1 ? 1 : ris_worth(r, y, &path[i]);
        }
    }
}

static void fill(struct cache *r, const struct prepared *p, const struct tile_pass *pass, long iteration)
{
    struct arena *arena = &r->arena[iteration % 2 != 0];
    arena_reset(arena);
    loop_fill(p, pass, iteration);
    gather(r, p, pass, arena, iteration);
}

void ris_begin(struct cache *r, const struct prepared *counted, const struct tile_pass *pass, long iteration)
{
    struct arena *arena = &r->arena[iteration % 2 != 0];
    size_t n_sights = (size_t)pass->job->max_depth + 2;
    r->vertices = counted->tables->light_vertices;
    if (iteration == pass->first) /* the same whatever pass comes before this */
        fill(r, counted, pass, iteration - 1);
    r->previous = r->records;
    r->previous_g = r->g;
    fill(r, counted, pass, iteration);
    r->sight = memset(arena_alloc(arena, n_sights * sizeof *r->sight), 0, n_sights * sizeof *r->sight);
    for (int i = 0; i < r->records.n; i++)
        r->records.item[i].expected = expect(r, &r->records.item[i]);
    weigh_light_paths(r, arena);
}

void ris_end(struct cache *r)
{
    arena_free(&r->arena[0]);
    arena_free(&r->arena[1]);
}

/* N of the draw's technique, and of all of its strategy, are left for `weigh`. */
void ris_join(struct cache *r, struct sample *sample, const struct vertex *z, int t)
{
    int which;
    if (r->V == 0)
        return;
    struct mixture m = records_mixture(&r->records, r->scene, z, 0, true, r->V);
    int v = mixture_draw(&m, sampler_number(&sample->choice, DRAW_LIGHT_END), &which);
    const struct vertex *y = r->found[v];
    const struct drawn drawn = drawn_vertex(y, 1);
    int s = drawn.end;
    double u = r->u != NULL ? r->u[v] : 1, each = 1.0 / (m.m + 1);
    double L = r->light_L[y - r->pool->vertex];
    double N[RECORDS_NEAR + 1], P = each * (which < m.m ? m.record[which]->h[v] / m.record[which]->sum : 1.0 / r->V);
    r->all = N[m.m] = worth_alone(r, each, L);
    for (int i = 0; i < m.m; i++)
        r->all += N[i] = worth(r, each, L, m.record[i]->h[v] * L / (rgb_worth(y->beta) * u), m.record[i]->expected);
    r->one = N[which];
    struct joint j;
    struct connection made = {.weight = 0};
    if (!(P > 0) || s + t > sample->pass->job->max_depth + 2)
        return;
    if (connect_join(y, z, &j))
        made = ris_joint(r, &j);
    sample_add(sample, (struct joined){.s = s, .t = t, .path = drawn.path, .z = z, .c = &made, .pmf = P,
                                       .scale = u / (P * r->K)});
}

/* As sample_alone. */
static void sum_eye(struct cache *r, struct sample *sample, int n)
{
    for (int t = 2; t <= n; t++) {
        const struct vertex *z = &sample->eye[t - 1];
        struct connection hit = ris_hit(r, z - 1, z, t);
        int points = sample->pass->counts->light_points[z->eye_hit];
        sample_add(sample, (struct joined){.t = t, .z = z, .c = &hit, .pmf = 1, .scale = 1});
        if (z->kind != VERTEX_SURFACE || t > sample->pass->job->max_depth + 1)
            continue;
        for (int i = 0; i < points; i++) {
            struct connection direct = {.weight = 0};
            struct light_point at;
            struct vertex y;
            struct lit l;
            if (lit_draw(sample, z, &sample->sampler, i, points, &at, &l))
                direct = ris_lit(r, &l);
            if (at.light >= 0)
                y = light_vertex(r->scene, r->counts, &at);
            sample_add(sample, (struct joined){.s = 1, .t = t, .path = at.light >= 0 ? &y : NULL, .z = z,
                                               .c = &direct, .pmf = 1, .scale = 1.0 / points});
        }
    }
}

static void render_weighed(const struct prepared *p, const struct tile_pass *pass)
{
    const struct vertex *eye = pass->work->eye;
    struct cache r = {.scene = NULL};
    for (long iteration = pass->first; iteration < pass->end; iteration++) {
        ris_begin(&r, p, pass, iteration);
        for (int i = 0; pass_goes_on(pass, i); i++) {
            struct sample sample;
            arena_reset(&pass->work->arena);
            int n = loop_begin(p, pass, i, iteration, &sample);
            sum_eye(&r, &sample, n);
            for (int t = 2; t <= n && t <= pass->job->max_depth; t++)
                if (vertex_connectible(&eye[t - 1]))
                    ris_join(&r, &sample, &eye[t - 1], t);
            loop_splat(p, &sample);
            sample_end(&sample);
        }
    }
    ris_end(&r);
}

void ris_prepare(const struct render_job *job, struct prepared *p)
{
    const struct ris *own = p->own;
    int M = own->sub_paths;
    (void)job;
    for (int hit = 0; hit < EYE_HITS; hit++)
        p->draw_worth[hit] = own->nabata ? M / ((M - 1) * p->tables->light_vertices + 1) : 1;
}

void ris_render(const struct prepared *p, const struct tile_pass *pass)
{
    if (((const struct ris *)p->own)->nabata)
        render_weighed(p, pass);
    else
        selection_render(p, pass);
}

/* --- the row ----------------------------------------------------------------------------------------- */

const struct field RIS_PARAMETERS[] = {
    PARAMETER_CREDITS(false), PARAMETER_POINTS(1), PARAMETER_GUIDE(false), PARAMETER_EMISSION(1),
    PARAMETER_TILES(RECORDS_TILE, 1), {.name = NULL}};
static const struct field OWN[] = {
    RIS_WEIGHTS_FIELD, RIS_SUBPATHS_FIELD(50), RIS_RECORDS_FIELD,
    {.name = NULL}};

const struct method method_ris = {
    .name = "ris", .check = surfaces_alone,
    .help = "resampling [Nabata 2020a]: light vertices drawn by a record nearby, with weights to suit",
    .parameters = RIS_PARAMETERS, .own = OWN, .own_size = sizeof(struct ris), .numbers = NUMBERS_OF_BDPT,
    .rr_threshold = DEFAULT_RR_THRESHOLD, .vertices = true, .prepare = ris_prepare,
    .build = ris_build, .draw = ris_draw, .render = ris_render};
