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
 * Tests: test_rival_parts.c, test_rivals.c.
 */
#include "rivals/spcbpt.h"

#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "caustics/derived.h"
#include "caustics/surfaces.h"
#include "integrators/prepare.h"
#include "learning/learn.h"
#include "rivals/together.h"
#include "tables/emission.h"

struct spcbpt {
    int subspaces, training, steps;
    struct tree_node *tree[2]; /* of eye and of light vertices; owned */
    double *gamma;             /* [subspaces^2], owned */
};

/* --- training ---------------------------------------------------------------------------------------- */

enum { FIRST = 1 << 24 }; /* number of the first sub-path, none of learn.c's */

/* It runs on one thread, so lists are in order. */
struct trainer {
    const struct render_job *job;
    const struct counts *counts;
    struct workspace *work;
    struct lessons all;
};

/* What a path has at z, the second vertex from the light. p_2 / p is ratio times the density of z from the light, pdf,
 * over its own. */
struct found {
    double own, other;          /* n, and n p of the other of s = 0 and s = 1 over p */
    double ratio, pdf, pdf_rev; /* pdf_rev: 1/sr, of going on from z to the next vertex */
    bool delta;                 /* z is left by a delta lobe */
};

static void note(struct trainer *r, rgb value, struct found f, const struct vertex *z)
{
    struct lessons *to = &r->all;
    double x = rgb_luminance(value), w = f.own / (f.own + f.other);
    struct lesson lesson = {w * x * x * f.own, f.own + f.other, 0};
    if (rgb_is_black(value) || !(x < 1e100))
        return;
    for (;; z--) {
        bool joins = !f.delta && !z->prev_delta;
        f.ratio *= f.pdf / z->pdf_fwd;
        if (z[-1].kind == VERTEX_LENS) {
            lesson.fixed += joins ? f.ratio * r->counts->lens : 0;
            break;
        }
        if (joins) {
            to->link = mem_append(to->link, to->n_links, sizeof *to->link);
            to->link[to->n_links++] = (struct link){{place_of(z - 1), place_of(z)}, {0, 0}, f.ratio, w * x};
            lesson.n_links++;
        }
        f.delta = z->prev_delta;
        f.pdf = f.pdf_rev * z->g;
        f.pdf_rev = vertex_pdf_rev(z - 1, z, RADIANCE);
    }
    to->lesson = mem_append(to->lesson, to->n, sizeof *to->lesson);
    to->lesson[to->n++] = lesson;
    to->sum += w * x;
}

static void note_hit(struct trainer *r, const struct vertex *eye, int t)
{
    const struct scene *scene = r->job->scene;
    const struct vertex *z = &eye[t - 2], *x = eye[t - 1].lamp != NULL ? eye[t - 1].lamp : &eye[t - 1];
    struct connection c = connect_s0(scene, r->counts, z, x);
    if (t == 2 || rgb_is_black(c.value))
        return;
    struct light_point y0 = vertex_light_point(scene, x);
    double ratio = y0.pdf / x->pdf_fwd, direct = n_s1(r->counts, z->place, z->eye_hit, y0.cell);
    double pdf_emit = emission_pdf(&r->counts->tables->emission, &scene->lights, &y0,
                                   x->kind == VERTEX_ESCAPED ? z->p : x->p, x->wo);
    struct found f = {1, x->prev_delta ? 0 : ratio * direct, ratio, pdf_emit * x->g, vertex_pdf_rev(z, x, RADIANCE),
                      x->prev_delta};
    note(r, c.value, f, z);
}

static void note_lit(struct trainer *r, const struct vertex *z, struct sampler *sampler)
{
    const struct scene *scene = r->job->scene;
    struct light_point at;
    struct lit l;
    double pdf;
    if (!light_draw(scene, r->counts, z, sampler, 0, 1, &at, &pdf) || pdf == 0 ||
        !connect_light(scene, z, &at, pdf, &l))
        return;
    bool hit = !light_is_delta(&scene->lights.light[at.light]);
    double pdf_emit = emission_pdf(&r->counts->tables->emission, &scene->lights, &at, z->p, neg(l.w));
    struct found f = {n_s1(r->counts, z->place, z->eye_hit, at.cell), hit ? l.pdf_z * l.at_light / at.pdf : 0, 1,
                      pdf_emit * vertex_cosine(z, l.w) * l.falloff, l.pdf_rev_z, false};
    note(r, connect_lit(scene, r->counts, &l).value, f, z);
}

/* Before each sub-path: may learning go on? */
static bool goes_on(struct trainer *r)
{
    arena_reset(&r->work->arena);
    return r->job->scene->lights.n > 0 && job_cancelled(r->job) == CANCEL_NOT;
}

static struct walk begin_walk(const struct trainer *r, int i, enum transport mode, struct sampler *sampler)
{
    *sampler = sampler_start(r->job->seed, RNG_LEARN, (uint64_t)(FIRST + i), mode == IMPORTANCE);
    return (struct walk){r->job->scene, r->counts, &r->work->arena, sampler, r->job->rr_threshold};
}

static void trace_eye(struct trainer *r, int i)
{
    const struct pixel_rect film = r->job->film_rect;
    const struct vertex *eye = r->work->eye;
    struct sampler sampler;
    const struct walk w = begin_walk(r, i, RADIANCE, &sampler);
    double u, v;
    sampler_r2(FIRST + i, &u, &v);
    int n = path_eye(&w, film.x0 + u * rect_width(film), film.y0 + v * rect_height(film), r->work->eye,
                     r->job->max_depth + 1);
    for (int t = 2; t <= n; t++) {
        note_hit(r, eye, t);
        note_lit(r, &eye[t - 1], &sampler);
    }
}

/* Count the vertices of each light subspace. */
static void trace_light(struct trainer *r, int i, const struct tree_node *tree, double *vertices)
{
    struct sampler sampler;
    const struct walk w = begin_walk(r, i, IMPORTANCE, &sampler);
    struct vertex *light = arena_alloc(&r->work->arena, ((size_t)r->job->max_depth + 1) * sizeof *light);
    int n = path_light(&w, light, r->job->max_depth + 1, NULL);
    for (const struct vertex *y = light + 1; y < light + n; y++)
        if (vertex_connectible(y))
            vertices[tree_find(tree, place_of(y))]++;
}

/* Let the table of direct light know subspaces instead of regions: each has the row of the region of its first link. */
static void guide_subspaces(struct tables *tables, const struct lessons *all, int subspaces)
{
    struct table *t = &tables->guide;
    size_t n = (size_t)t->columns, rows = t->rows > 0 ? (size_t)subspaces : 0;
    int *region = mem_alloc((size_t)subspaces, sizeof *region);
    double *ratio = mem_alloc(rows * n, sizeof *ratio), *before = mem_alloc(rows * (n + 1), sizeof *before);
    for (size_t i = (size_t)all->n_links; i-- > 0;) {
        const struct link *k = &all->link[i];
        const double *x = k->end[0].x;
        region[k->label[0]] = region_at(&tables->regions, vec(x[0], x[1], x[2]), vec(x[3], x[4], x[5]));
    }
    for (size_t i = 0; i < rows; i++) {
        memcpy(&ratio[i * n], &t->ratio[(size_t)region[i] * n], n * sizeof *ratio);
        memcpy(&before[i * (n + 1)], &t->before[(size_t)region[i] * (n + 1)], (n + 1) * sizeof *before);
    }
    free(region);
    table_free(t);
    *t = (struct table){.rows = (int)rows, .columns = t->columns, .ratio = ratio, .before = before};
    regions_free(&tables->regions);
    tables->regions = NO_TABLES.regions;
}

/* Gamma, and the table of n(e,l) / C.
 *   vertices  of n_light light sub-paths, of each subspace */
static void learn_pairs(const struct lessons *all, struct spcbpt *own, double C, double K, double delta,
                        double *vertices, int n_light, struct table *pairs)
{
    int n = own->subspaces;
    for (int l = 0; l < n; l++) /* C / N_l; 1/2: a subspace without a vertex so far may have one in the render */
        vertices[l] = C * n_light / (vertices[l] + 0.5);
    own->gamma = learn_gamma(all, n, vertices, K, own->steps);
    *pairs = (struct table){.rows = n, .columns = n, .ratio = mem_alloc((size_t)n * (size_t)n, sizeof(double))};
    for (int i = 0; i < n * n; i++) {
        own->gamma[i] = (1 - delta) * own->gamma[i] + delta / n;
        double x = own->gamma[i] * vertices[i % n];
        pairs->ratio[i] = x * K / (x + K) / C;
    }
}

static void prepare(const struct render_job *job, struct prepared *p)
{
    struct spcbpt *own = p->own;
    double pixels = (double)rect_pixels(job->film_rect), K = fmin(sqr(p->size.tile), pixels) / p->numbers.path_pixels;
    int n = int_within(own->training * pixels, LEARN_LEAST, LEARN_MOST), n_light = n < LEARN_LIGHT ? n : LEARN_LIGHT;
    method_settle(job, p);
    struct trainer r = {job, &p->counts, workspaces_new(1, job->max_depth), {.n = 0}};
    double *vertices = mem_alloc((size_t)own->subspaces, sizeof *vertices);
    for (int i = 0; i < n && goes_on(&r); i++)
        trace_eye(&r, i);
    for (int end = 0; end < 2; end++)
        own->tree[end] = learn_tree(&r.all, end, own->subspaces, job->scene->lights.center, job->scene->lights.radius);
    for (int i = 0; i < n_light && goes_on(&r); i++)
        trace_light(&r, i, own->tree[1], vertices);
    workspaces_free(r.work, 1);
    guide_subspaces(p->tables, &r.all, own->subspaces);
    learn_pairs(&r.all, own, p->numbers.draws[FIRST_HIT], K, p->parameters.delta, vertices, n_light, &p->tables->pairs);
    free(vertices);
    free(r.all.lesson);
    free(r.all.link);
}

/* --- an iteration ------------------------------------------------------------------------------------ */

/* The pool's vertices in a subspace. */
struct group {
    int first, n;
    double L; /* S_l */
};

struct cache {
    const struct vertex **candidate; /* [n] by subspace */
    double *before;              /* [n] sum of L over those before in the subspace */
    struct group *group;         /* [subspaces] */
    double **row;                /* [subspaces][subspaces + 1] cumulative sums of Gamma(e,.); NULL: not made yet */
};

/* mis of vertex v again, which follows x. */
static double step_again(const struct vertex *x, const struct vertex *v, double pdf_rev)
{
    return mis_step(v->prev_delta ? 0 : x->mis_c, pdf_rev, x->mis, x->pdf_fwd, v->g);
}

/* The subspaces of a sub-path's vertices, and what weights depend on them: walks know no trees. A vertex has that of
 * its own end of an edge for its region. If it is the other end, for mis_c, it has that of the other tree. */
static void classify(const struct prepared *p, struct vertex *path, int n, struct arena *arena, enum transport mode)
{
    const struct spcbpt *own = p->own;
    const struct counts *counts = &p->counts;
    for (struct vertex *v = path + 1; v < path + n; v++) {
        const struct vertex *x = v - 1;
        double pdf_rev = vertex_pdf_rev(x, v, mode);
        v->mis = step_again(x, v, pdf_rev);
        if (v->lamp != NULL) {
            struct vertex *lamp = arena_alloc(arena, sizeof *lamp);
            *lamp = *v->lamp;
            lamp->mis = step_again(x, lamp, pdf_rev);
            v->lamp = lamp;
        }
        if (v->kind != VERTEX_SURFACE)
            continue;
        v->place = tree_find(own->tree[mode == RADIANCE], place_of(v));
        v->mis_c = n_before(counts, x, v, mode);
        v->place = tree_find(own->tree[mode == IMPORTANCE], place_of(v));
    }
}

/* Sort the pool's vertices by subspace. */
static struct cache *build(const struct prepared *p, const struct tile_pass *pass, long iteration)
{
    struct pool *pool = &pass->work->pool;
    size_t n = (size_t)((const struct spcbpt *)p->own)->subspaces;
    struct cache *v = arena_alloc(&pool->arena, sizeof *v);
    (void)iteration;
    for (int k = 0; k < pool->n; k++)
        classify(p, &pool->vertex[pool->start[k]], pool->length[k], &pool->arena, IMPORTANCE);
    pool_find_candidates(pool);
    v->candidate = arena_alloc(&pool->arena, (size_t)pool->n_candidates * sizeof *v->candidate);
    v->before = arena_alloc(&pool->arena, (size_t)pool->n_candidates * sizeof *v->before);
    v->row = memset(arena_alloc(&pool->arena, n * sizeof *v->row), 0, n * sizeof *v->row);
    v->group = memset(arena_alloc(&pool->arena, n * sizeof *v->group), 0, n * sizeof *v->group);
    for (int i = 0; i < pool->n_candidates; i++)
        v->group[pool->candidate[i]->place].n++;
    for (size_t l = 0, first = 0; l < n; first += (size_t)v->group[l].n, v->group[l++].n = 0)
        v->group[l].first = (int)first;
    for (int i = 0; i < pool->n_candidates; i++) {
        struct group *g = &v->group[pool->candidate[i]->place];
        v->candidate[g->first + g->n] = pool->candidate[i];
        v->before[g->first + g->n++] = g->L;
        g->L += rgb_worth(pool->candidate[i]->beta);
    }
    return v;
}

static const double *row_of(const struct spcbpt *own, const struct cache *v, struct arena *arena, int e)
{
    size_t n = (size_t)own->subspaces;
    if (v->row[e] != NULL)
        return v->row[e];
    double *row = v->row[e] = arena_alloc(arena, (n + 1) * sizeof *row);
    row[0] = 0;
    for (size_t l = 0; l < n; l++)
        row[l + 1] = row[l] + (v->group[l].L > 0 ? own->gamma[(size_t)e * n + l] : 0);
    return row;
}

/* Draw a subspace, then a vertex; stratified over both. */
static bool draw(const struct prepared *p, const struct cache *v, struct sample *sample, const struct vertex *z,
                 int i, int n, struct drawn *out)
{
    const struct spcbpt *own = p->own;
    const double *row = row_of(own, v, &sample->pass->work->pool.arena, z->place);
    double total = row[own->subspaces];
    if (!(total > 0))
        return false;
    double target = (i + sampler_number(&sample->choice, DRAW_LIGHT_END)) / n * total;
    int l = cumulative_find(row, own->subspaces, target);
    const struct group *g = &v->group[l];
    double share = row[l + 1] - row[l], within = (target - row[l]) / share * g->L;
    const struct vertex *y = v->candidate[g->first + cumulative_find(&v->before[g->first], g->n, within)];
    *out = drawn_vertex(y, share / total * rgb_worth(y->beta) / g->L);
    return out->pmf > 0;
}

/* As sample_lens: next to the lens a vertex is an eye vertex, and has the subspace of one. */
static void splat(const struct prepared *p, struct sample *sample, struct vertex *light, int n, double scale)
{
    const struct spcbpt *own = p->own;
    for (const struct observer *o = sample->pass->observer; o != NULL; o = o->next)
        if (o->walked != NULL)
            o->walked(o->context, sample, IMPORTANCE, light, n);
    for (int s = 2; s <= n && s <= sample->pass->job->max_depth + 1; s++) {
        struct vertex *y = &light[s - 1];
        int region = y->place;
        y->place = tree_find(own->tree[0], place_of(y));
        double raster[2];
        struct connection c = connect_lens(sample->pass->job->scene, &p->counts, y, &sample->sampler, raster);
        y->place = region;
        sample_splat(sample, (struct joined){.s = s, .t = 1, .path = light, .c = &c, .px = raster[0], .py = raster[1],
                                             .pmf = 1, .scale = scale / p->counts.lens});
    }
}

/* As selection_render, with classified eye sub-paths. */
static void render(const struct prepared *p, const struct tile_pass *pass)
{
    struct pool *pool = &pass->work->pool;
    struct vertex *eye = pass->work->eye;
    int each = p->numbers.path_pixels;
    for (long iteration = pass->first; iteration < pass->end; iteration++) {
        loop_fill(p, pass, iteration);
        const struct cache *cache = build(p, pass, iteration);
        for (int i = 0; pass_goes_on(pass, i); i++) {
            struct sample sample;
            arena_reset(&pass->work->arena);
            int n = loop_begin(p, pass, i, iteration, &sample);
            classify(p, eye, n, &pass->work->arena, RADIANCE);
            for (int t = 2; t <= n; t++) {
                const struct vertex *z = &eye[t - 1];
                int C = t <= pass->job->max_depth && vertex_connectible(z) ? p->numbers.draws[z->eye_hit] : 0;
                struct drawn light;
                sample_s0(&sample, t);
                sample_s1(&sample, t);
                for (int j = 0; j < C; j++)
                    if (draw(p, cache, &sample, z, j, C, &light))
                        sample_pairs(&sample, &light, t, 1 / ((double)C * pool->n) / light.pmf);
            }
            if (i % each == 0)
                splat(p, &sample, &pool->vertex[pool->start[i / each]], pool->length[i / each],
                      pixels_count(pass->tile->pixels) / ((double)pool->n * each));
            sample_end(&sample);
        }
    }
}

/* --- the row ----------------------------------------------------------------------------------------- */

static void release(struct prepared *p)
{
    struct spcbpt *own = p->own;
    free(own->tree[0]);
    free(own->tree[1]);
    free(own->gamma);
}

static const struct field PARAMETERS[] = {
    PARAMETER("connections", FIELD_INTEGER, numbers.draws[FIRST_HIT], 3, 1, 1024,
              "light vertices drawn for each eye vertex", NULL),
    PARAMETER_DELTA(0.2),
    PARAMETER("pathpixels", FIELD_INTEGER, numbers.path_pixels, 1, 1, DEFAULT_TILE_SIZE * DEFAULT_TILE_SIZE,
              "pixels for each light sub-path", NULL),
    PARAMETER_LATER(-1), PARAMETER_CREDITS(false), PARAMETER_BOUND(false), PARAMETER_POINTS(1),
    PARAMETER_GUIDE(false), PARAMETER_EMISSION(1), PARAMETER_TILES(MAX_TILE_SIZE, 1),
    {.name = NULL}};
#define AT(member) offsetof(struct spcbpt, member)
static const struct field OWN[] = {
    {"subspaces", FIELD_INTEGER, AT(subspaces), 64, 1, 1024, "subspaces of eye vertices, and of light vertices", NULL},
    {"training", FIELD_INTEGER, AT(training), 4, 1, 1024, "eye sub-paths for each pixel that they are learnt from",
     NULL},
    {"steps", FIELD_INTEGER, AT(steps), 2, 0, 1000, "steps that minimise the variance", NULL},
    {.name = NULL}};

const struct method method_spcbpt = {
    .name = "spcbpt", .check = surfaces_alone,
    .help = "subspaces [Su 2022]: light vertices drawn by trees and a matrix for the least variance",
    .parameters = PARAMETERS, .own = OWN, .own_size = sizeof(struct spcbpt), .numbers = NUMBERS_OF_PT,
    .rr_threshold = DEFAULT_RR_THRESHOLD, .prepare = prepare, .release = release, .build = build, .draw = draw,
    .render = render};
