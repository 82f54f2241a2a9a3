/* records.c: see records.h. */
#include "rivals/records.h"

#include "base/alias.h"
#include "caustics/visible.h"

static void add_path(struct records *r, const struct vertex *eye, int n)
{
    for (int t = 2; t <= n && t <= RECORDS_DEPTH; t++)
        if (vertex_connectible(&eye[t - 1])) {
            struct record c = {.z = eye[t - 1]};
            r->item[r->n++] = c;
        }
}

struct records records_place(const struct prepared *p, const struct tile_pass *pass, struct arena *arena,
                             long iteration, double share)
{
    const struct render_job *job = pass->job;
    const struct tile_pixels pixels = pass->tile->pixels;
    int width = pixels_columns(pixels), height = pixels_rows(pixels), x, y;
    int n = share > 0 ? (int)ceil(share * width * height) : 0, longest = RECORDS_DEPTH;
    longest = longest < pass->job->max_depth ? longest : pass->job->max_depth;
    struct records r = {arena_alloc(arena, (size_t)n * (size_t)longest * sizeof *r.item), 0};
    for (int i = 0; i < n; i++) {
        double u, v, filter_weight;
        sampler_r2((int64_t)iteration * n + i, &u, &v);
        pixels_get(pixels, (int)(v * height) * width + (int)(u * width), &x, &y);
        struct sampler sampler = sample_stream(pass, RNG_RECORD, x, y, (uint64_t)iteration);
        struct walk walk = {job->scene, &p->counts, arena, &sampler, job->rr_threshold};
        struct vertex *eye = arena_alloc(arena, (size_t)longest * sizeof *eye);
        add_path(&r, eye, path_eye_pixel(&walk, x, y, eye, longest, &filter_weight));
    }
    return r;
}

/* Nearer than a thousandth of the scene's radius nothing is worth more. */
double record_worth(const struct record *c, const struct scene *scene, const struct vertex *v, vec3 wo)
{
    vec3 d = sub(c->z.p, v->p);
    double d2 = length2(d), wo_ng = abs_dot(wo, v->ng);
    if (!(d2 > 0) || !(wo_ng > 0) || !bsdf_may_scatter(&c->z.bsdf, c->z.wo, neg(d)))
        return 0;
    vec3 w = mul(d, 1 / sqrt(d2));
    double f = rgb_luminance(bsdf_eval(&v->bsdf, wo, w, IMPORTANCE).f), at_c = abs_dot(c->z.ng, w);
    double cosines = abs_dot(wo, v->bsdf.shading.n) * abs_dot(w, v->ng) / wo_ng * at_c;
    return f * cosines / fmax(d2, sqr(1e-3 * scene->lights.radius));
}

bool record_sees(const struct record *c, const struct scene *scene, const struct vertex *v)
{
    return scene_visible(scene, c->z.p, c->z.prim_id, v->p, v->prim_id);
}

void records_fill(struct records *r, struct arena *arena, const struct scene *scene, const struct vertex *const *found,
                  int n, const double *u)
{
    for (int i = 0; i < r->n; i++) {
        struct record *c = &r->item[i];
        double *h = arena_alloc(arena, (size_t)n * sizeof *h), *before = arena_alloc(arena, (size_t)n * sizeof *before);
        c->sum = 0;
        for (int v = 0; v < n; v++) {
            const struct vertex *y = found[v];
            h[v] = rgb_worth(y->beta) * (u != NULL ? u[v] : 1) * record_worth(c, scene, y, y->wo);
            if (!(h[v] > 0 && h[v] < INFINITY && record_sees(c, scene, y)))
                h[v] = 0;
            before[v] = c->sum;
            c->sum += h[v];
        }
        c->h = h;
        c->before = before;
    }
}

int records_near(const struct records *r, const struct scene *scene, const struct vertex *z, double normals, int *near)
{
    double distance[RECORDS_NEAR + 1], scale = normals * sqr(2 * scene->lights.radius);
    int n = 0;
    for (int i = 0; i < r->n; i++) {
        const struct vertex *c = &r->item[i].z;
        double d = length2(sub(c->p, z->p)) + scale * (1 - dot(c->ng, z->ng));
        int k = n < RECORDS_NEAR ? n++ : RECORDS_NEAR;
        for (; k > 0 && d < distance[k - 1]; k--) {
            distance[k] = distance[k - 1];
            if (k < RECORDS_NEAR)
                near[k] = near[k - 1];
        }
        distance[k] = d;
        if (k < RECORDS_NEAR)
            near[k] = i;
    }
    return n;
}

struct mixture records_mixture(const struct records *r, const struct scene *scene, const struct vertex *z,
                               double normals, bool blind, int V)
{
    struct mixture m = {.m = 0, .V = V};
    int near[RECORDS_NEAR], n = records_near(r, scene, z, normals, near);
    for (int i = 0; i < n; i++)
        if (blind || r->item[near[i]].sum > 0)
            m.record[m.m++] = &r->item[near[i]];
    return m;
}

int mixture_draw(const struct mixture *m, double u, int *which)
{
    int i = (int)(u * (m->m + 1)); /* at most m, u being below 1 by more than rounding */
    double rest = u * (m->m + 1) - i;
    *which = i;
    if (i < m->m)
        return cumulative_find(m->record[i]->before, m->V, rest * m->record[i]->sum);
    i = (int)(rest * m->V);
    return i < m->V ? i : m->V - 1;
}

double mixture_pmf(const struct mixture *m, int v)
{
    double sum = 1.0 / m->V;
    for (int i = 0; i < m->m; i++)
        sum += m->record[i]->sum > 0 ? m->record[i]->h[v] / m->record[i]->sum : 0;
    return sum / (m->m + 1);
}
