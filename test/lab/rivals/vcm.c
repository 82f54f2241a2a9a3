/* vcm.c: vertex connection and merging: bdpt, and light vertices that lie so near to an eye vertex that they are taken
 * for it. Biased; right in the limit, as the radius shrinks.                          [Georgiev 2012c]
 *
 * A path x_0 ... x_k can also be made by a light sub-path to y near x_i and an eye sub-path to z near it. If y is
 * within r of z, that pair stands for a path of one vertex, x_i:
 *     X = beta_y beta_z f_z(wo_z, wo_y) / (K pi r^2),     each of K light sub-paths being such a chance,
 * beta arriving there per area, so that f needs no cosine but what shading normals change of it. Its density is that
 * of the connection next to it times the chance to come near: p_i' = p_i F_i eta, F_i the density of x_i in the light
 * walk, eta = K pi r^2. So in the sums of mis.h the merge at x_e is one more strategy that ends just before vertex e:
 *     c_e' = c_e + eta F_e,
 * in both walks, at vertices where something can be merged; all that the heart weighs then knows of it. A merge has
 *     w = 1 / (1 + (c_y + pdf_rev_y mis_y) / (eta F_y) + (c_z + pdf_rev_z mis_z) / (eta F_z)).   [Georgiev 2012c]
 *
 * Unlike in the paper the K sub-paths are those of a tile, so no map of the whole picture is needed, and nothing
 * between iterations: the radius of iteration i is r_0 (i + 1)^((alpha - 1) / 2). With fewer sub-paths a merge adds
 * more at a time; over iterations it is the same. Only the balance heuristic is right here.
 *
 * Tests: test_rivals.c.
 */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/maths.h"
#include "caustics/surfaces.h"
#include "rivals/together.h"

struct vcm_state {
    struct frozen frozen;
    double radius; /* r_0 over the radius of the scene's bounding sphere */
    double alpha;
};

/* Light vertices by the cells of a grid, 2 r wide, in a table of buckets by hash. */
struct vcm {
    struct light_pool pool; /* the first, see pooled.h */
    struct candidates found;
    int *first, *next;      /* [buckets], [found.n]: chains of candidates; -1: none */
    size_t buckets, n_first, n_next;
    double r, eta;
};

/* --- merging as a strategy --------------------------------------------------------------------------- */

static bool can_merge(const struct vertex *v) { return v->kind == VERTEX_SURFACE && vertex_connectible(v); }

/* mis_{e+1} of `v`, which follows vertex e, with the merge at e. */
static double stepped(const struct scene *scene, const struct mis_counts *counts, const struct vertex *e,
                      const struct vertex *v)
{
    return mis_step(counts, v->prev_delta ? 0 : e->mis_c, e->pdf_rev, e->mis, e->pdf_fwd, area_before(scene, e, v));
}

/* Give all vertices of a walk c_e' and what follows from it. Vertices 0 and 1 have no merge before them. */
static void know_merges(const struct vcm *m, const struct pixel_sample *sample, struct arena *arena,
                        struct vertex *path, int n)
{
    for (int e = 1; e < n; e++) {
        struct vertex *v = &path[e];
        if (e > 1)
            v->mis = stepped(sample->scene, sample->counts, &path[e - 1], v);
        if (e > 1 && v->lamp != NULL) {
            struct vertex *lamp = arena_alloc(arena, sizeof *lamp);
            *lamp = *v->lamp;
            lamp->mis = stepped(sample->scene, sample->counts, &path[e - 1], lamp);
            v->lamp = lamp;
        }
        if (can_merge(v))
            v->mis_c += m->eta * v->pdf_fwd;
    }
}

/* The part of one side: (c + pdf_rev mis) / (eta F), without the merge itself. */
static double side(const struct vcm *m, const struct vertex *v, double pdf_rev)
{
    double own = m->eta * v->pdf_fwd;
    return (v->mis_c - own + pdf_rev * v->mis) / own;
}

static void merge(const struct vcm *m, struct pixel_sample *sample, const struct candidate *c, const struct vertex *z,
                  int t)
{
    const struct vertex *y = c->y;
    double area = abs_dot(y->wo, z->ng);
    struct bsdf_value f = bsdf_eval(&z->bsdf, z->wo, y->wo, RADIANCE);
    if (c->s + t - 1 > sample->max_depth + 2 || rgb_is_black(f.f) || !(area > 0))
        return;
    double scale = scatter_cosine(z, y->wo, RADIANCE) / (area * m->eta);
    struct connection joined = {.value = rgb_scale(rgb_mul(rgb_mul(y->beta, z->beta), f.f), scale),
                                .length = y->length + z->length, .light = -1, .cell = -1};
    joined.weight = 1 / (1 + side(m, y, f.pdf) + side(m, z, f.pdf_rev));
    pixel_add(sample, &joined, c->s, t, y, z, NO_CHOICE);
}

/* t = 1: the heart, which there looks at the counts and not at c_e', does not know of the merge at y. */
static void splat(const struct vcm *m, struct pixel_sample *sample, const struct vertex *light, int n)
{
    const struct camera *camera = &sample->scene->camera;
    double S = sample->counts->splat, px, py;
    for (int s = 2; s <= n && s <= sample->max_depth + 1; s++) {
        const struct vertex *y = &light[s - 1];
        struct connection c = connect_lens(sample->scene, sample->counts, light, s, &sample->sampler);
        vec3 d = sub(y->p, c.end);
        if (!rgb_is_black(c.value)) {
            vec3 w = normalize(d);
            double R = camera_project(camera, c.end, w, &px, &py) * camera_spread(camera, length2(d)) *
                       abs_dot(y->ng, w); /* density of y in the eye walk */
            c.weight = 1 / (1 / c.weight + R * m->eta / S);
        }
        pixel_splat(sample, &c, s, y, 1 / S);
    }
}

/* --- the grid ---------------------------------------------------------------------------------------- */

static vec3 cell_of(const struct vcm *m, vec3 p)
{
    double side = 2 * m->r;
    vec3 cell = {floor(p.x / side), floor(p.y / side), floor(p.z / side)};
    return cell;
}

static size_t bucket_of(const struct vcm *m, vec3 cell)
{
    uint64_t h = 0;
    const double x[3] = {cell.x, cell.y, cell.z};
    for (int d = 0; d < 3; d++) {
        uint64_t bits;
        memcpy(&bits, &x[d], sizeof bits);
        h = hash_combine(h, bits);
    }
    return (size_t)(h % m->buckets);
}

static void fill_grid(struct vcm *m)
{
    m->buckets = 2 * (size_t)m->found.n + 1;
    m->first = mem_grow(m->first, &m->n_first, m->buckets, sizeof *m->first);
    m->next = mem_grow(m->next, &m->n_next, (size_t)m->found.n + 1, sizeof *m->next);
    for (size_t b = 0; b < m->buckets; b++)
        m->first[b] = -1;
    for (int i = 0; i < m->found.n; i++) {
        size_t b = bucket_of(m, cell_of(m, m->found.item[i].y->p));
        m->next[i] = m->first[b];
        m->first[b] = i;
    }
}

/* All light vertices within r of z: they lie in the eight cells around the corner of the grid that is next to it. */
static void merge_all(const struct vcm *m, struct pixel_sample *sample, const struct vertex *z, int t)
{
    for (int corner = 0; corner < 8; corner++) {
        vec3 step = {corner & 1 ? m->r : -m->r, corner & 2 ? m->r : -m->r, corner & 4 ? m->r : -m->r};
        vec3 cell = cell_of(m, add(z->p, step));
        for (int i = m->first[bucket_of(m, cell)]; i >= 0; i = m->next[i]) {
            const struct candidate *c = &m->found.item[i];
            vec3 own = cell_of(m, c->y->p);
            bool here = own.x == cell.x && own.y == cell.y && own.z == cell.z;
            if (here && length2(sub(c->y->p, z->p)) < sqr(m->r))
                merge(m, sample, c, z, t);
        }
    }
}

/* --- an iteration ------------------------------------------------------------------------------------ */

static void begin(void *scratch, const void *state, const struct tile_pass *pass, long iteration)
{
    struct vcm *m = scratch;
    const struct vcm_state *s = state;
    const struct scene *scene = pass->job->scene;
    struct pixel_sample sample = {.scene = scene, .counts = &s->frozen.counts};
    m->r = s->radius * scene->lights.radius * m_pow((double)iteration + 1, (s->alpha - 1) / 2);
    m->eta = m->pool.n * PI * sqr(m->r);
    for (int k = 0; k < m->pool.n; k++)
        know_merges(m, &sample, &m->pool.arena, &m->pool.vertex[m->pool.start[k]], m->pool.length[k]);
    m->found = candidates_find(&m->pool);
    fill_grid(m);
}

static void connect_all(void *scratch, const void *state, const struct tile_pass *pass, struct pooled_pixel *pixel,
                        int n)
{
    struct vcm *m = scratch;
    (void)state;
    for (int i = 0; i < n && !pass_enough(pass->job); i++) {
        struct pooled_pixel *p = &pixel[i];
        size_t size = (size_t)p->n * sizeof *p->eye;
        struct vertex *eye = memcpy(arena_alloc(&pass->work->arena, size), p->eye, size);
        know_merges(m, &p->sample, &pass->work->arena, eye, p->n);
        p->eye = eye;
        pixel_sum_eye(&p->sample, eye, p->n);
        pixel_sum_pairs(&p->sample, eye, p->n, light_pool_path(&m->pool, i), m->pool.length[i], NO_CHOICE);
        for (int t = 2; t <= p->n; t++)
            if (can_merge(&eye[t - 1]))
                merge_all(m, &p->sample, &eye[t - 1], t);
        splat(m, &p->sample, light_pool_path(&m->pool, i), m->pool.length[i]);
        p->n_light = 0; /* the frame has nothing left to splat */
    }
}

static void render(const struct preparation *m, const struct tile_pass *pass)
{
    together_render(m, pass, connect_all);
}

static void free_scratch(void *scratch)
{
    struct vcm *m = scratch;
    light_pool_free(&m->pool);
    free(m->first);
    free(m->next);
}

static void prepare(const struct render_job *job, struct preparation *out)
{
    (void)job;
    out->size.tile = MAX_TILE_SIZE;
}

#define AT(member) offsetof(struct vcm_state, member)
static const struct field PARAMETERS[] = {
    {"radius", FIELD_NUMBER, AT(radius), 0.01, 1e-9, 1, "of the first iteration's merges, in radii of the scene", NULL},
    {"alpha", FIELD_NUMBER, AT(alpha), 0.75, 0, 1, "how fast it shrinks; 1: not at all", NULL},
    {.name = NULL}};

const struct method method_vcm = {
    .name = "vcm", .check = surfaces_alone,
    .help = "vertex connection and merging [Georgiev 2012c]: bdpt, and vertices that meet; biased",
    .why = "the pixel's own light sub-path, and all of the tile's light vertices within the radius; scale 1, of merges "
           "1 / (K pi r^2)",
    .parameters = PARAMETERS, .state_size = sizeof(struct vcm_state), .scratch_size = sizeof(struct vcm),
    .numbers = NUMBERS_OF_BDPT, .rr_threshold = DEFAULT_RR_THRESHOLD, .prepare = prepare, .render = render,
    .scratch_free = free_scratch, .begin = begin};
