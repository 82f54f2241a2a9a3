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
 * more at a time; over iterations it is the same.
 *
 * Tests: test_rivals.c.
 */
#include <math.h>
#include <string.h>

#include "base/maths.h"
#include "caustics/derived.h"
#include "caustics/surfaces.h"
#include "rivals/together.h"

struct vcm {
    double radius; /* r_0 over the radius of the scene's bounding sphere */
    double alpha;
};

/* Light vertices by the cells of a grid, 2 r wide, in a table of buckets by hash. */
struct cache {
    const struct vertex *const *found;
    int *first, *next; /* [buckets], [found]: chains of candidates; -1: none */
    size_t buckets;
    double r, eta;
};

/* --- merging as a strategy --------------------------------------------------------------------------- */

static bool can_merge(const struct vertex *v) { return v->kind == VERTEX_SURFACE && vertex_connectible(v); }

/* Give all vertices of a walk c_e' and what follows from it. Vertices 0 and 1 have no merge before them. */
static void know_merges(const struct cache *m, struct arena *arena, struct vertex *path,
                        int n, enum transport mode)
{
    for (int e = 1; e < n; e++) {
        struct vertex *v = &path[e];
        const struct vertex *before = v - 1;
        double c = v->prev_delta ? 0 : before->mis_c, pdf_rev = e > 1 ? vertex_pdf_rev(before, v, mode) : 0;
        if (e > 1)
            v->mis = mis_step(c, pdf_rev, before->mis, before->pdf_fwd, v->g);
        if (e > 1 && v->lamp != NULL) {
            struct vertex *lamp = arena_alloc(arena, sizeof *lamp);
            *lamp = *v->lamp;
            lamp->mis = mis_step(c, pdf_rev, before->mis, before->pdf_fwd, lamp->g);
            v->lamp = lamp;
        }
        if (can_merge(v))
            v->mis_c += m->eta * v->pdf_fwd;
    }
}

/* The part of one side: (c + pdf_rev mis) / (eta F), without the merge itself. */
static double side(const struct cache *m, const struct vertex *v, double pdf_rev)
{
    double own = m->eta * v->pdf_fwd;
    return (v->mis_c - own + pdf_rev * v->mis) / own;
}

static void merge(const struct cache *m, struct sample *sample, const struct vertex *y, const struct vertex *z,
                  int t)
{
    const struct drawn drawn = drawn_vertex(y, 1);
    int s = drawn.end;
    double area = abs_dot(y->wo, z->ng);
    struct bsdf_value f = bsdf_eval(&z->bsdf, z->wo, y->wo, RADIANCE);
    if (s + t - 1 > sample->pass->job->max_depth + 2 || rgb_is_black(f.f) || !(area > 0))
        return;
    double scale = scatter_cosine(z, y->wo, RADIANCE) / (area * m->eta);
    struct connection joined = {.value = rgb_scale(rgb_mul(rgb_mul(y->beta, z->beta), f.f), scale), .light = -1};
    joined.weight = 1 / (1 + side(m, y, f.pdf) + side(m, z, f.pdf_rev));
    sample_add(sample, (struct joined){.s = s, .t = t, .path = drawn.path, .z = z, .c = &joined, .pmf = 1,
                                       .scale = 1});
}

/* t = 1: the heart, which there looks at the counts and not at c_e', does not know of the merge at y. */
static void splat(const struct cache *m, struct sample *sample, const struct vertex *light, int n)
{
    const struct scene *scene = sample->pass->job->scene;
    const struct camera *camera = &scene->camera;
    double S = sample->pass->counts->lens, px, py, raster[2];
    for (int s = 2; s <= n && s <= sample->pass->job->max_depth + 1; s++) {
        const struct vertex *y = &light[s - 1];
        vec3 lens = lens_drawn(camera, y->p, sample->sampler), d = sub(y->p, lens);
        struct connection c = connect_lens(scene, sample->pass->counts, y, &sample->sampler, raster);
        if (!rgb_is_black(c.value)) {
            vec3 w = normalize(d);
            double R = camera_project(camera, lens, w, &px, &py) * camera_falloff(camera, length2(d)) *
                       abs_dot(y->ng, w); /* density of y in the eye walk */
            c.weight = 1 / (1 / c.weight + R * m->eta / S);
        }
        sample_splat(sample, (struct joined){.s = s, .t = 1, .path = light, .c = &c, .px = raster[0], .py = raster[1],
                                             .pmf = 1, .scale = 1 / S});
    }
}

/* --- the grid ---------------------------------------------------------------------------------------- */

static vec3 cell_of(const struct cache *m, vec3 p)
{
    double side = 2 * m->r;
    vec3 cell = {floor(p.x / side), floor(p.y / side), floor(p.z / side)};
    return cell;
}

static size_t bucket_of(const struct cache *m, vec3 cell)
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

static void fill_grid(struct cache *m, struct pool *pool)
{
    m->found = pool->candidate;
    m->buckets = 2 * (size_t)pool->n_candidates + 1;
    m->first = arena_alloc(&pool->arena, m->buckets * sizeof *m->first);
    m->next = arena_alloc(&pool->arena, (size_t)pool->n_candidates * sizeof *m->next);
    for (size_t b = 0; b < m->buckets; b++)
        m->first[b] = -1;
    for (int i = 0; i < pool->n_candidates; i++) {
        size_t b = bucket_of(m, cell_of(m, m->found[i]->p));
        m->next[i] = m->first[b];
        m->first[b] = i;
    }
}

/* All light vertices within r of z: they lie in the eight cells around the corner of the grid that is next to it. */
static void merge_all(const struct cache *m, struct sample *sample, const struct vertex *z, int t)
{
    for (int corner = 0; corner < 8; corner++) {
        vec3 step = {corner & 1 ? m->r : -m->r, corner & 2 ? m->r : -m->r, corner & 4 ? m->r : -m->r};
        vec3 cell = cell_of(m, add(z->p, step));
        for (int i = m->first[bucket_of(m, cell)]; i >= 0; i = m->next[i]) {
            const struct vertex *y = m->found[i];
            vec3 p = y->p, own = cell_of(m, p);
            bool here = own.x == cell.x && own.y == cell.y && own.z == cell.z;
            if (here && length2(sub(p, z->p)) < sqr(m->r))
                merge(m, sample, y, z, t);
        }
    }
}

/* --- an iteration ------------------------------------------------------------------------------------ */

static struct cache *build(const struct prepared *p, const struct tile_pass *pass, long iteration)
{
    const struct vcm *own = p->own;
    struct pool *pool = &pass->work->pool;
    struct cache *m = arena_alloc(&pool->arena, sizeof *m);
    m->r = own->radius * pass->job->scene->lights.radius * m_pow((double)iteration + 1, (own->alpha - 1) / 2);
    m->eta = pool->n * PI * sqr(m->r);
    for (int k = 0; k < pool->n; k++)
        know_merges(m, &pool->arena, &pool->vertex[pool->start[k]], pool->length[k], IMPORTANCE);
    pool_find_candidates(pool);
    fill_grid(m, pool);
    return m;
}

static void connect_all(const struct prepared *p, const struct tile_pass *pass, const struct cache *m,
                        struct pixel *pixel, int n)
{
    const struct pool *pool = &pass->work->pool;
    (void)p;
    for (int i = 0; i < n && !pass_cancelled(pass); i++) {
        struct sample *sample = &pixel[i].sample;
        struct vertex *eye = pixel[i].sample.eye;
        const struct drawn light = {pool_path(pool, i), 1, pool->length[i], 1};
        know_merges(m, &pass->work->arena, eye, pixel[i].n, RADIANCE);
        sample_alone(sample, pixel[i].n);
        for (int t = 2; t <= pixel[i].n; t++) {
            sample_pairs(sample, &light, t, 1);
            if (can_merge(&eye[t - 1]))
                merge_all(m, sample, &eye[t - 1], t);
        }
        splat(m, sample, light.path, light.end);
    }
}

static void render(const struct prepared *p, const struct tile_pass *pass) { together_render(p, pass, connect_all); }

static const struct field OWN[] = {
    {"radius", FIELD_NUMBER, offsetof(struct vcm, radius), 0.01, 1e-9, 1,
     "of the first iteration's merges, in radii of the scene", NULL},
    {"alpha", FIELD_NUMBER, offsetof(struct vcm, alpha), 0.75, 0, 1, "how fast it shrinks; 1: not at all", NULL},
    {.name = NULL}};

static const struct field PARAMETERS[] = {PARAMETER_GUIDE(false), {.name = NULL}};

const struct method method_vcm = {
    .name = "vcm", .check = surfaces_alone, .parameters = PARAMETERS,
    .help = "vertex connection and merging [Georgiev 2012c]: bdpt, and vertices that meet; biased",
    .own = OWN, .own_size = sizeof(struct vcm), .numbers = NUMBERS_OF_BDPT, .rr_threshold = DEFAULT_RR_THRESHOLD,
    .prepare = reuse_prepare, .build = build, .render = render};
