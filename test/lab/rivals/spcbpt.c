/* spcbpt.c: subspace-based probabilistic connections.                                                    [Su 2022]
 *
 * Two classification trees divide the vertices of eye and of light sub-paths into n subspaces each. An eye vertex of
 * subspace e draws a light subspace l with probability Gamma(e,l), then a light vertex v of l with probability L_v/S_l.
 * L_v is the luminance of beta_v, and S_l the sum of L over the vertices in l of the pool's K sub-paths:
 *     X = (1/C) sum over C draws of w F(v) S_l / (K Gamma(e,l) L_v).
 *
 * The weights w include Gamma. From a very large pool, C draws of v count as C Gamma(e,l) L_v / Q_l samples of BDPT.
 * Q_l is the expectation of the sum of L in l over one light sub-path. The programs of the author count them so. We
 * take the mean of L_v / Q_l over the vertices of l, which is 1 / N_l: N_l is the expected number of vertices that one
 * light sub-path has in l. Since draws also share a pool of K sub-paths, they count as
 *     n(e,l) = 1 / (1/K + N_l / (C Gamma(e,l))).
 * This depends on the two subspaces alone, so the recursion of mis.h can have it. With L_v itself, the squared error of
 * six training scenes was the same within 1 %, and a sample took 6 % longer.
 *
 * Learning. A path tracer makes training paths, and trees are grown where they have vertices. Then Gamma minimises the
 * second moment of the whole estimate with these weights, an upper bound of its variance:
 *     J = sum over training paths of f^2 / (p sum_i n_i p_i),   n_i = n(e,l) for every strategy that draws.
 * Gamma begins in proportion to what paths contribute, and the render uses (1 - delta) Gamma + delta / n. In six
 * training scenes, two steps of minimising change J of other paths by -1.1 to 0.3 %, and more steps are no better. So
 * the first Gamma has nearly all of the gain.
 *
 * We could read the abstract of the paper and the two programs of its author. Differences from the programs:
 *   weights    as above
 *   lights     s = 1 takes its own light points, so these are in no subspace
 *   pools      are a tile's, and leave many subspaces empty: P is divided by the sum of Gamma over the others
 *   subspaces  are leaves of a tree, of equal contributions; there, cells around sampled centres that a tree encodes
 *   learning   f is not relative to the pixel's brightness, and another optimiser finds the minimum of J
 * As in the newer program, directions are not classified. Constants were chosen in four training scenes at 96x72, by
 * squared error times CPU time: 64 subspaces (of 16, 32, 64, 96, 128), 4 eye sub-paths per pixel to learn from (2, 4,
 * 16), 2 steps (0, 2, 4, 10, 40), C = 3 (1, 2, 3), delta = 0.2 (0.1, 0.2).
 *
 * Tests: test_spcbpt.c, test_rivals.c, test_family.c.
 */
#include "rivals/spcbpt.h"

#include <stdlib.h>
#include <string.h>

#include "base/alias.h"
#include "caustics/surfaces.h"
#include "learning/training.h"
#include "rivals/plain.h"
#include "rivals/together.h"
#include "tables/emit.h"

struct spcbpt_state {
    struct frozen frozen; /* tables.pairs is Gamma(e,l) / N_l; its regions are subspaces */
    int subspaces, training, steps;
    double delta;
    struct tree_node *tree[2]; /* of eye and of light vertices; owned */
    double *gamma;             /* [subspaces^2], owned */
};

/* --- training ---------------------------------------------------------------------------------------- */

enum { FIRST = 1 << 24 }; /* number of the first sub-path, none of learn.c's */

/* It runs on one thread, so lists are in order. */
struct trainer {
    const struct spcbpt_state *state;
    struct lessons all;
    double *vertices; /* [subspaces] of light sub-paths; owned */
};

/* What a path has at z, the second vertex from the light. p_2 / p is ratio times the density of z from the light, pdf,
 * over its own. */
struct found {
    double own, other;          /* n, and n p of the other of s = 0 and s = 1 over p */
    double ratio, pdf, pdf_rev; /* pdf_rev: 1/sr, of going on from z to the next vertex */
    bool delta;                 /* z is left by a delta lobe */
};

static void note(const struct pass *p, rgb value, struct found f, const struct vertex *z)
{
    struct lessons *to = &((struct trainer *)p->context)->all;
    double x = rgb_luminance(value), w = f.own / (f.own + f.other);
    struct lesson lesson = {w * x * x * f.own, f.own + f.other, 0};
    if (rgb_is_black(value) || !(x < 1e100))
        return;
    for (;; z--) {
        bool joins = !f.delta && !z->prev_delta;
        f.ratio *= f.pdf / z->pdf_fwd;
        if (z[-1].kind == VERTEX_LENS) {
            lesson.fixed += joins ? f.ratio * p->counts.splat : 0;
            break;
        }
        if (joins) {
            to->link = mem_append(to->link, to->n_links, sizeof *to->link);
            to->link[to->n_links++] = (struct link){{place_of(z - 1), place_of(z)}, {0, 0}, f.ratio, w * x};
            lesson.n_links++;
        }
        f.delta = z->prev_delta;
        f.pdf = f.pdf_rev * area_before(p->training->job->scene, z - 1, z);
        f.pdf_rev = z[-1].pdf_rev;
    }
    to->lesson = mem_append(to->lesson, to->n, sizeof *to->lesson);
    to->lesson[to->n++] = lesson;
    to->sum += w * x;
}

static void note_hit(const struct pass *p, const struct vertex *eye, int t)
{
    const struct scene *scene = p->training->job->scene;
    const struct vertex *z = &eye[t - 2], *x = eye[t - 1].lamp != NULL ? eye[t - 1].lamp : &eye[t - 1];
    struct connection c = connect_hit(scene, &p->counts, z, x, t);
    struct light_point y0 = vertex_light_point(x);
    if (t == 2 || rgb_is_black(c.value))
        return;
    y0.w = neg(x->wo);
    double ratio = x->pdf_origin / x->pdf_fwd;
    double direct = n_direct(&p->counts, &scene->lights, z->eye_region, z->eye_end, x->cell, y0.w);
    double pdf_emit = emit_pdf(&p->counts.tables->emission, &scene->lights, &y0, z->p, x->wo);
    struct found f = {1, x->prev_delta ? 0 : ratio * direct, ratio, pdf_emit * area_before(scene, z, x), z->pdf_rev,
                      x->prev_delta};
    note(p, c.value, f, z);
}

static void note_lit(const struct pass *p, const struct vertex *z, struct sampler *sampler)
{
    const struct scene *scene = p->training->job->scene;
    const struct light_set *lights = &scene->lights;
    struct lit l;
    if (!connect_light_point(scene, &p->counts, z, sampler, 0, 1, &l))
        return;
    bool hit = !light_is_delta(&lights->light[l.at.light]);
    double pdf_emit = emit_pdf(&p->counts.tables->emission, lights, &l.at, z->p, neg(l.w));
    struct found f = {n_direct(&p->counts, lights, z->eye_region, z->eye_end, l.at.cell, l.at.w),
                      hit ? l.pdf_z * l.at_light / vertex_light_pdf(lights, &l.at) : 0, 1,
                      pdf_emit * vertex_cosine(z, l.w) * l.spread, l.pdf_rev_z, false};
    note(p, connect_lit(scene, &p->counts, &l).value, f, z);
}

static void trace_eye(const struct pass *p, int thread, long i, struct findings *out)
{
    const struct vertex *eye = p->training->work[thread].eye;
    struct sampler sampler;
    int n = pass_eye(p, thread, i, STREAM_EYE, &sampler);
    (void)out;
    for (int k = 2; k <= n; k++) {
        note_hit(p, eye, k);
        note_lit(p, &eye[k - 1], &sampler);
    }
}

static void trace_light(const struct pass *p, int thread, long i, struct findings *out)
{
    const struct trainer *t = p->context;
    struct workspace *work = &p->training->work[thread];
    int n = pass_light(p, &work->arena, i, STREAM_LIGHT, work->light);
    (void)out;
    for (const struct vertex *y = work->light + 1; y < work->light + n; y++)
        if (vertex_connectible(y))
            t->vertices[tree_find(t->state->tree[1], place_of(y))]++;
}

/* Let the guide know subspaces instead of regions: each has the table of the region of its first link. */
static void guide_subspaces(struct tables *tables, const struct lessons *all, int subspaces)
{
    struct guide *g = &tables->guide;
    size_t row = (size_t)g->columns.n + 1;
    double *before = mem_alloc((size_t)subspaces * row, sizeof *before);
    for (size_t i = all->n_links; g->n > 0 && i-- > 0;) {
        const double *x = all->link[i].end[0].x;
        int region = region_at(&tables->eye, vec(x[0], x[1], x[2]), vec(x[3], x[4], x[5]));
        memcpy(&before[(size_t)all->link[i].label[0] * row], &g->before[(size_t)region * row], row * sizeof *before);
    }
    free(g->before);
    g->before = before;
    g->n = g->n > 0 ? subspaces : 0;
    regions_free(&tables->eye);
    regions_free(&tables->light);
    tables->eye = tables->light = NO_TABLES.eye;
}

static void train(const struct render_job *whole, struct spcbpt_state *s)
{
    struct render_job job = *whole;
    job.n_threads = 1;
    double pixels = pixel_light_count(&job), C = s->frozen.numbers.draws[FIRST_HIT];
    int n_paths = int_within(s->training * pixels, LEARN_LEAST, LEARN_MOST), n = s->subspaces;
    int n_light = n_paths < LEARN_LIGHT ? n_paths : LEARN_LIGHT;
    struct training t = {&job, workspaces_new(1, job.max_depth), patience_begin(&job)};
    struct trainer r = {s, {NULL, NULL, 0, 0, 0}, mem_alloc((size_t)n, sizeof *r.vertices)};
    struct mis_counts counts = counts_of(s->frozen.numbers, NO_CREDITS, pixels);
    counts.tables = &s->frozen.tables;
    const struct pass eye = {&t, counts, FIRST, FIRST + n_paths, &r, trace_eye, NULL};
    const struct pass light = {&t, counts, FIRST, FIRST + n_light, &r, trace_light, NULL};
    pass_run(&eye);
    for (int end = 0; end < 2; end++)
        s->tree[end] = learn_tree(&r.all, end, n, job.scene->lights.center, job.scene->lights.radius);
    pass_run(&light);
    patience_end(&t.patience);
    workspaces_free(t.work, 1);
    guide_subspaces(&s->frozen.tables, &r.all, n);
    for (int l = 0; l < n; l++) /* C / N_l; 1/2: a subspace without a vertex so far may have one in the render */
        r.vertices[l] = C * n_light / (r.vertices[l] + 0.5);
    s->gamma = learn_gamma(&r.all, n, r.vertices, s->frozen.counts.most, s->steps);
    s->frozen.tables.pairs = (struct pairs){n, n, mem_alloc((size_t)n * (size_t)n, sizeof(double))};
    for (int i = 0; i < n * n; i++) {
        s->gamma[i] = (1 - s->delta) * s->gamma[i] + s->delta / n;
        s->frozen.tables.pairs.h[i] = s->gamma[i] * r.vertices[i % n] / C;
    }
    free(r.vertices);
    free(r.all.lesson);
    free(r.all.link);
}

/* --- an iteration ------------------------------------------------------------------------------------ */

/* The pool's vertices in a subspace. */
struct group {
    int first, n;
    double L; /* S_l */
};

struct spcbpt {
    struct light_pool pool;      /* the first, see pooled.h */
    struct candidate *candidate; /* [n] by subspace; in the pool's arena, as all that follows */
    double *before;              /* [n] sum of L over those before in the subspace */
    struct group *group;         /* [subspaces] */
    double *row;                 /* [subspaces + 1] room for cumulative sums of Gamma */
};

/* The subspaces of a sub-path's vertices, and what weights depend on them: walks know no trees. */
static void classify(const struct spcbpt_state *s, const struct scene *scene, struct vertex *path, int n,
                     struct arena *arena, enum transport mode)
{
    const struct mis_counts *counts = &s->frozen.counts;
    for (struct vertex *v = path + 1; v < path + n; v++) {
        const struct vertex *x = v - 1;
        double c = v->prev_delta ? 0 : x->mis_c;
        v->mis = mis_step(counts, c, x->pdf_rev, x->mis, x->pdf_fwd, area_before(scene, x, v));
        if (v->lamp != NULL) {
            struct vertex *lamp = arena_alloc(arena, sizeof *lamp);
            *lamp = *v->lamp;
            lamp->mis = mis_step(counts, c, x->pdf_rev, x->mis, x->pdf_fwd, area_before(scene, x, lamp));
            v->lamp = lamp;
        }
        if (v->kind != VERTEX_SURFACE)
            continue;
        v->eye_region = tree_find(s->tree[0], place_of(v));
        v->light_region = tree_find(s->tree[1], place_of(v));
        v->mis_c = mode == RADIANCE ? c_eye(counts, x, v) : c_light(counts, &scene->lights, x, v, LATER_HIT);
    }
}

/* Sort the pool's vertices by subspace. */
static void begin(void *scratch, const void *state, const struct tile_pass *pass, long iteration)
{
    struct spcbpt *r = scratch;
    const struct spcbpt_state *s = state;
    struct arena *arena = &r->pool.arena;
    const struct candidates found = candidates_find(&r->pool);
    size_t n = (size_t)s->subspaces, size = (size_t)found.n;
    (void)iteration;
    for (int k = 0; k < r->pool.n; k++)
        classify(s, pass->job->scene, &r->pool.vertex[r->pool.start[k]], r->pool.length[k], arena, IMPORTANCE);
    r->candidate = arena_alloc(arena, size * sizeof *r->candidate);
    r->before = arena_alloc(arena, size * sizeof *r->before);
    r->row = arena_alloc(arena, (n + 1) * sizeof *r->row);
    r->group = memset(arena_alloc(arena, n * sizeof *r->group), 0, n * sizeof *r->group);
    for (int i = 0; i < found.n; i++)
        for (size_t l = (size_t)found.item[i].y->light_region + 1; l < n; l++)
            r->group[l].first++;
    for (int i = 0; i < found.n; i++) {
        struct group *g = &r->group[found.item[i].y->light_region];
        r->candidate[g->first + g->n] = found.item[i];
        r->before[g->first + g->n++] = g->L;
        g->L += found.item[i].L;
    }
}

/* C draws for one eye vertex, stratified. */
static void draw(void *scratch, const void *state, struct pooled_pixel *p, const struct vertex *z, int t)
{
    struct spcbpt *r = scratch;
    const struct spcbpt_state *s = state;
    int n = s->subspaces, C = s->frozen.numbers.draws[FIRST_HIT];
    const double *gamma = &s->gamma[(size_t)z->eye_region * (size_t)n];
    r->row[0] = 0;
    for (int l = 0; l < n; l++)
        r->row[l + 1] = r->row[l] + (r->group[l].L > 0 ? gamma[l] : 0);
    for (int c = 0; c < C && r->row[n] > 0; c++) {
        double target = (c + sampler_number(&p->draws, DRAW_LIGHT_END)) / C * r->row[n];
        int l = cumulative_find(r->row, n, target);
        const struct group *g = &r->group[l];
        double share = r->row[l + 1] - r->row[l], within = (target - r->row[l]) / share * g->L;
        int i = g->first + cumulative_find(&r->before[g->first], g->n, within);
        double P = share / r->row[n] * r->candidate[i].L / g->L;
        const struct choice choice = {P, 1 / (C * P * r->pool.n)};
        if (P > 0)
            pooled_join(p, &r->candidate[i], z, t, choice);
    }
}

/* As pooled_render, with classified eye sub-paths. */
static void render(const struct preparation *m, const struct tile_pass *pass)
{
    for (long iteration = pass->first; iteration < pass->end; iteration++) {
        pooled_fill(m, pass, iteration);
        for (int i = 0, x, y; pass_pixel(pass, i, &x, &y); i++) {
            arena_reset(&pass->work->arena);
            struct pooled_pixel p = pooled_begin(m, pass, x, y, i, iteration);
            classify(m->state, pass->job->scene, pass->work->eye, p.n, &pass->work->arena, RADIANCE);
            pixel_sum_eye(&p.sample, p.eye, p.n);
            pooled_connect(m, pass, &p);
            pooled_end(&p);
        }
    }
}

/* --- the row ----------------------------------------------------------------------------------------- */

static void prepare(const struct render_job *job, struct preparation *out)
{
    struct spcbpt_state *s = out->state;
    s->frozen.numbers.draws[LATER_HIT] = s->frozen.numbers.draws[FIRST_HIT];
    plain_prepare(job, out);
    s->frozen.counts.most = fmin(sqr(out->size.tile), pixel_light_count(job)) / s->frozen.numbers.path_pixels;
    train(job, s);
}

static void release(void *state)
{
    struct spcbpt_state *s = state;
    free(s->tree[0]);
    free(s->tree[1]);
    free(s->gamma);
}

#define AT(member) offsetof(struct spcbpt_state, member)
static const struct field PARAMETERS[] = {
    {"connections", FIELD_INTEGER, AT(frozen.numbers.draws[FIRST_HIT]), 3, 1, 1024,
     "light vertices drawn for each eye vertex", NULL},
    {"subspaces", FIELD_INTEGER, AT(subspaces), 64, 1, 1024, "subspaces of eye vertices, and of light vertices", NULL},
    {"training", FIELD_INTEGER, AT(training), 4, 1, 1024, "eye sub-paths for each pixel that they are learnt from",
     NULL},
    {"steps", FIELD_INTEGER, AT(steps), 2, 0, 1000, "steps that minimise the variance", NULL},
    {"delta", FIELD_NUMBER, AT(delta), 0.2, 1e-6, 1, "share of draws that ignore what was learnt", NULL},
    {"pathpixels", FIELD_INTEGER, AT(frozen.numbers.path_pixels), 1, 1, DEFAULT_TILE_SIZE * DEFAULT_TILE_SIZE,
     "pixels for each light sub-path", NULL},
    SERVICES(false, 1, 1, MAX_TILE_SIZE, 1),
    {.name = NULL}};

const struct method method_spcbpt = {
    .name = "spcbpt", .check = surfaces_alone,
    .help = "subspaces [Su 2022]: light vertices drawn by trees and a matrix for the least variance",
    .why = "C draws for each eye vertex: a light subspace by Gamma(e,l), of the eye vertex' subspace, then one of its "
           "vertices in proportion to luminance(beta); scale 1 / (C K P)",
    .parameters = PARAMETERS, .state_size = sizeof(struct spcbpt_state), .scratch_size = sizeof(struct spcbpt),
    .numbers = {.light_points = 1, .path_tracing = true}, .rr_threshold = DEFAULT_RR_THRESHOLD, .prepare = prepare,
    .release = release, .render = render, .scratch_free = light_pool_free, .begin = begin, .draw = draw};
