/* caustic.c: see caustic.h. */
#include "transport/caustic.h"

#include <stdlib.h>

/* --- what is specular -------------------------------------------------------------------------------- */

/* Some point of a primitive. */
static void some_point(const struct geometry *geo, int prim, vec3 middle, struct surface *out)
{
    struct hit hit = {0, 1.0 / 3, 1.0 / 3, prim};
    struct ray ray = {middle, vec(0, 0, 1), 0, INFINITY, 0, 0};
    shape_surface(geo, &hit, &ray, out);
}

static void widen(vec3 box[2], const float lo[3], const float hi[3])
{
    box[0] = vec(fmin(box[0].x, (double)lo[0]), fmin(box[0].y, (double)lo[1]), fmin(box[0].z, (double)lo[2]));
    box[1] = vec(fmax(box[1].x, (double)hi[0]), fmax(box[1].y, (double)hi[1]), fmax(box[1].z, (double)hi[2]));
}

/* The middles of the bounds of all groups, to be given to free(). */
static vec3 *middles(const struct geometry *geo)
{
    vec3 *box = mem_alloc((size_t)geo->n_groups, 2 * sizeof *box), *middle;
    for (int g = 0; g < geo->n_groups; g++) {
        box[2 * g] = vec(INFINITY, INFINITY, INFINITY);
        box[2 * g + 1] = neg(box[2 * g]);
    }
    for (int i = 0; i < geometry_primitives(geo); i++) {
        int prim = i < geo->n_triangles ? i : FIRST_QUADRIC + (i - geo->n_triangles);
        float lo[3], hi[3];
        shape_bounds(geo, prim, lo, hi);
        widen(&box[2 * (shape_group_of(geo, prim) - geo->group)], lo, hi);
    }
    middle = box;
    for (int g = 0; g < geo->n_groups; g++)
        middle[g] = lerp3(0.5, box[2 * g], box[2 * g + 1]);
    return middle;
}

/* A group counts as what its first primitive is at one point; where it is not, no chain is found. */
static void classify(const struct scene *scene, struct caustics *c, struct arena *arena, int g, vec3 middle)
{
    const struct shape_group *group = &scene->geo.group[g];
    struct surface at;
    struct bsdf bsdf;
    bool reflects = false;
    if (group->material < 0)
        return;
    some_point(&scene->geo, group->first_prim, middle, &at);
    material_bsdf(scene->material, group->material, &scene->textures, &at, arena, &bsdf);
    for (int i = 0; i < bsdf.n_lobes; i++) {
        enum lobe_kind kind = bsdf.lobe[i].kind;
        reflects |= lobe_is_delta(kind) && kind != LOBE_SPECULAR_TRANSMISSION;
        c->lets_through[g] |= lobe_is_delta(kind) && kind != LOBE_SPECULAR_REFLECTION;
    }
    c->any_through |= c->lets_through[g];
    if (reflects) {
        struct mirror mirror = {g, middle};
        c->mirror = mem_append(c->mirror, (size_t)c->n_mirrors, sizeof *c->mirror);
        c->mirror[c->n_mirrors++] = mirror;
    }
}

struct caustics *caustics_new(const struct scene *scene, int longest)
{
    struct caustics *c = mem_alloc(1, sizeof *c);
    struct arena arena = {NULL, NULL};
    vec3 *middle = middles(&scene->geo);
    c->longest = longest;
    c->lets_through = mem_alloc((size_t)scene->geo.n_groups, sizeof *c->lets_through);
    for (int g = 0; g < scene->geo.n_groups; g++)
        classify(scene, c, &arena, g, middle[g]);
    arena_free(&arena);
    free(middle);
    if (c->n_mirrors > 0 || c->any_through)
        return c;
    caustics_free(c);
    return NULL;
}

void caustics_free(struct caustics *c)
{
    if (c != NULL) {
        free(c->lets_through);
        free(c->mirror);
    }
    free(c);
}

/* --- a ray and its derivatives by two directions across w at z ----------------------------------------- */

/* What a chain is looked for in, and between what. */
struct quest {
    const struct scene *scene;
    const struct caustics *caustics;
    struct arena *arena;
    const struct vertex *z;
    const struct light_point *y;
    bool parallel; /* y is a direction */
    int group;     /* the mirror's; -1: through k surfaces */
    int k;
};

/* A ray through the chain. */
struct chain {
    vec3 w;                 /* unit, in which z was left */
    vec3 at[CAUSTIC_LONGEST];
    vec3 p, d, dp[2], dd[2]; /* the last edge, and its derivatives */
    uint32_t prim_id;
    rgb kappa;
    double choice; /* probability that a walk takes these lobes */
};

static int group_at(const struct scene *scene, const struct surface *at)
{
    return (int)(shape_group_of(&scene->geo, (int)(at->prim_id - 1)) - scene->geo.group);
}

/* The ray arrives at a surface: its point moves by dp along that. */
static void transfer(struct chain *c, const struct surface *at)
{
    double t = length(sub(at->p, c->p));
    for (int i = 0; i < 2; i++) {
        vec3 moved = add(c->dp[i], mul(c->dd[i], t));
        c->dp[i] = sub(moved, mul(c->d, dot(moved, at->ng) / dot(c->d, at->ng)));
    }
    c->p = at->p;
    c->prim_id = at->prim_id;
}

/* The ray goes on in direction s->wi. Reflection is d - 2 (d.n) n, refraction eta d + mu n with n on the side that the
 * ray comes from, mu = eta c - c_t. */
static void turn(struct chain *c, const struct scene *scene, const struct surface *at, const struct bsdf_sample *s,
                 bool transmit)
{
    vec3 n = dot(c->d, at->ns) > 0 ? neg(at->ns) : at->ns;
    double cosine = -dot(c->d, n), eta = 1 / s->eta, cos_t = abs_dot(s->wi, n);
    for (int i = 0; i < 2; i++) {
        vec3 dn = shape_normal_change(&scene->geo, at, c->dp[i]);
        dn = dot(c->d, at->ns) > 0 ? neg(dn) : dn;
        double dc = -(dot(c->dd[i], n) + dot(c->d, dn));
        if (transmit)
            c->dd[i] = add(mul(c->dd[i], eta), add(mul(dn, eta * cosine - cos_t),
                                                   mul(n, (eta - eta * eta * cosine / cos_t) * dc)));
        else
            c->dd[i] = add(c->dd[i], mul(add(mul(n, dc), mul(dn, cosine)), 2));
    }
    c->d = s->wi;
}

/* Scatter by the delta lobes of the surface; false where they, or the derivatives, do not do as the chain wants. */
static bool scatter(const struct quest *q, struct chain *c, const struct surface *at)
{
    struct bsdf bsdf;
    struct bsdf_sample s;
    bool transmit = q->group < 0;
    material_bsdf(q->scene->material, at->material, &q->scene->textures, at, q->arena, &bsdf);
    if (dot(bsdf.shading.n, at->ns) < 1 - 1e-9 || !bsdf_delta(&bsdf, neg(c->d), transmit, RADIANCE, &s))
        return false;
    if ((dot(s.wi, at->ng) * dot(c->d, at->ng) > 0) != transmit)
        return false;
    turn(c, q->scene, at, &s, transmit);
    c->kappa = rgb_mul(c->kappa, s.f);
    c->choice *= s.pdf;
    return true;
}

/* Trace the chain that leaves z in direction w. */
static bool shoot(const struct quest *q, vec3 w, struct chain *c)
{
    const struct frame f = frame_from_normal(w);
    struct chain start = {.w = w, .p = q->z->p, .d = w, .dd = {f.s, f.t}, .prim_id = q->z->prim_id,
                          .kappa = rgb_grey(1), .choice = 1};
    *c = start;
    for (int i = 0; i < q->k; i++) {
        struct ray ray = {c->p, c->d, ray_margin(c->p), INFINITY, c->prim_id, 0};
        struct surface at;
        if (!scene_intersect(q->scene, &ray, &at) || at.material < 0 || dot(at.ng, c->d) == 0)
            return false;
        if (q->group >= 0 && group_at(q->scene, &at) != q->group)
            return false;
        transfer(c, &at);
        c->at[i] = at.p;
        if (!scatter(q, c, &at))
            return false;
    }
    return true;
}

/* --- the search -------------------------------------------------------------------------------------- */

/* How far the last edge misses y: d - u and its derivatives; the distance to y, at infinity 1. */
static double misses(const struct quest *q, const struct chain *c, vec3 *miss, vec3 change[2])
{
    vec3 to = q->parallel ? q->y->w : sub(q->y->p, c->p);
    double r = length(to);
    vec3 u = mul(to, 1 / r);
    *miss = sub(c->d, u);
    for (int i = 0; i < 2; i++) {
        vec3 across = sub(c->dp[i], mul(u, dot(u, c->dp[i])));
        change[i] = q->parallel ? c->dd[i] : add(c->dd[i], mul(across, 1 / r));
    }
    return r;
}

/* The area of light per solid angle at z. */
static double area_of(const struct quest *q, const struct chain *c)
{
    vec3 miss, change[2];
    double r = misses(q, c, &miss, change);
    return r * r * fabs(dot(cross(change[0], change[1]), c->d));
}

/* From direction w on. */
static bool search(const struct quest *q, vec3 w, struct chain *c)
{
    enum { SHOTS = 24 };
    const double near = 1e-9;
    double size = 1, x = 0, y = 0, missed = 0;
    struct chain next;
    for (int i = 0; i < SHOTS; i++) {
        vec3 miss, change[2];
        bool better = shoot(q, i == 0 ? w : normalize(w), &next);
        if (better) {
            misses(q, &next, &miss, change);
            better = i == 0 || length(miss) < missed;
        }
        if (!better && i == 0)
            return false;
        if (better) {
            *c = next;
            missed = length(miss);
            if (missed < near)
                return true;
            if (!combination(change[0], change[1], miss, &x, &y))
                return false;
            size = fmin(1, 2 * size);
        } else {
            size /= 2;
        }
        const struct frame f = frame_from_normal(c->w);
        double limit = fmin(size, size / (1e-9 + sqrt(x * x + y * y)));
        w = sub(c->w, mul(add(mul(f.s, x), mul(f.t, y)), limit));
    }
    return false;
}

/* How many surfaces that let light through lie between z and y; 0 if there are none, too many, or others. */
static int pierced(const struct quest *q, vec3 *w)
{
    const struct vertex *z = q->z;
    vec3 to = q->parallel ? q->y->w : sub(q->y->p, z->p);
    double left = length(to);
    *w = mul(to, 1 / left);
    struct ray ray = {z->p, *w, ray_margin(z->p), INFINITY, z->prim_id, q->y->prim_id};
    for (int k = 0;; k++) {
        struct surface at;
        ray.tmax = q->parallel ? INFINITY : left - ray_margin(q->y->p);
        if (!(ray.tmin < ray.tmax) || !scene_intersect(q->scene, &ray, &at))
            return k;
        if (k == q->caustics->longest || !q->caustics->lets_through[group_at(q->scene, &at)])
            return 0;
        left -= length(sub(at.p, ray.o));
        ray.o = at.p;
        ray.tmin = ray_margin(at.p);
        ray.from = at.prim_id;
    }
}

static struct quest quest_for(const struct scene *scene, const struct caustics *caustics, struct arena *arena,
                              const struct vertex *z, const struct light_point *y)
{
    bool parallel = y->light < 0 || light_at_infinity(&scene->lights.light[y->light]);
    struct quest q = {scene, caustics, arena, z, y, parallel, -1, 0};
    return q;
}

/* Psi: the chain through, or by mirror number m. */
static bool psi_through(struct quest *q, struct chain *c)
{
    vec3 w;
    q->group = -1;
    q->k = q->caustics->any_through ? pierced(q, &w) : 0;
    return q->k > 0 && search(q, w, c);
}

static bool psi_mirror(struct quest *q, int m, struct chain *c)
{
    const struct mirror *mirror = &q->caustics->mirror[m];
    q->group = mirror->group;
    q->k = 1;
    return search(q, normalize(sub(mirror->middle, q->z->p)), c);
}

/* --- the strategy ------------------------------------------------------------------------------------ */

/* Density of the same path by s = 0, as one of y: what z and the delta lobes choose, over the light's size. */
static double hit_density(const struct quest *q, const struct chain *c, double cos_y)
{
    if (q->y->light >= 0 && light_is_delta(&q->scene->lights.light[q->y->light]))
        return 0;
    struct bsdf_value f = bsdf_eval(&q->z->bsdf, q->z->wo, c->w, RADIANCE);
    return f.pdf * c->choice * cos_y / area_of(q, c);
}

static double cosine_at(const struct quest *q, const struct chain *c)
{
    bool area = q->y->light >= 0 && q->scene->lights.light[q->y->light].kind == LIGHT_AREA;
    return area ? abs_dot(q->y->n, c->d) : 1;
}

/* Density of y by caustic connection: if an infinite light, by any of these, which an escaping ray cannot tell apart. */
static double connect_density(const struct quest *q)
{
    const struct light_set *lights = &q->scene->lights;
    bool sky = q->y->light >= 0 && lights->light[q->y->light].kind == LIGHT_INFINITE;
    double pdf = sky ? light_pdf_environment(lights, q->y->w) : q->y->pdf;
    return q->group < 0 ? pdf : pdf / q->caustics->n_mirrors;
}

static struct connection contribution(const struct quest *q, const struct chain *c)
{
    const struct scene *scene = q->scene;
    const struct vertex *z = q->z;
    struct connection out = {.light = q->y->light, .cell = q->y->cell, .end = q->parallel ? q->y->w : q->y->p};
    double cos_y = cosine_at(q, c), chosen = q->group < 0 ? 1 : 1.0 / q->caustics->n_mirrors;
    rgb Le = light_Le(&scene->lights, q->y, neg(c->d));
    struct bsdf_value f = bsdf_eval(&z->bsdf, z->wo, c->w, RADIANCE);
    out.pdf = q->y->pdf;
    out.value = rgb_mul(rgb_mul(z->beta, f.f), rgb_mul(c->kappa, Le));
    out.value = rgb_scale(out.value, scatter_cosine(z, c->w, RADIANCE) * cos_y / (area_of(q, c) * q->y->pdf * chosen));
    if (rgb_is_black(out.value) || !rgb_is_finite(out.value))
        out.value = rgb_black();
    else if (q->parallel ? !scene_lit_from(scene, c->p, c->prim_id, c->d)
                         : !scene_lit(scene, c->p, c->prim_id, q->y->p, q->y->prim_id))
        out.value = rgb_black();
    double own = connect_density(q);
    out.weight = own / (own + hit_density(q, c, cos_y));
    return out;
}

int caustic_connect(const struct scene *scene, const struct caustics *caustics, struct arena *arena,
                    const struct vertex *z, struct sampler *sampler, int room,
                    struct caustic_connection out[CAUSTIC_KINDS])
{
    double u[3];
    struct light_point y;
    struct chain c;
    int n = 0;
    u[0] = sampler_number(sampler, DRAW_LIGHT);
    sampler_pair(sampler, DRAW_LIGHT_POINT, &u[1]);
    if (room < 1 || !light_sample_point(&scene->lights, &scene->geo, u, &y) || !(y.pdf > 0))
        return 0;
    struct quest q = quest_for(scene, caustics, arena, z, &y);
    if (psi_through(&q, &c) && q.k <= room) {
        out[n].c = contribution(&q, &c);
        out[n++].k = q.k;
    }
    if (caustics->n_mirrors == 0)
        return n;
    int m = (int)(sampler_number(sampler, DRAW_LIGHT_END) * caustics->n_mirrors);
    if (psi_mirror(&q, m, &c)) {
        out[n].c = contribution(&q, &c);
        out[n++].k = q.k;
    }
    return n;
}

/* --- the partition ----------------------------------------------------------------------------------- */

/* Is the chain of a path in Psi? Its k vertices are x, x[step] ... from z on. */
static bool in_psi(struct quest *q, const struct vertex *x, int step, int k, struct chain *c)
{
    vec3 next = k > 1 ? sub(x[step].p, x->p) : q->parallel ? q->y->w : sub(q->y->p, x->p);
    bool found = false;
    if (dot(x->ng, next) * dot(x->ng, sub(q->z->p, x->p)) < 0) {
        found = psi_through(q, c);
    } else {
        int m = 0, group = (int)(shape_group_of(&q->scene->geo, (int)(x->prim_id - 1)) - q->scene->geo.group);
        while (m < q->caustics->n_mirrors && q->caustics->mirror[m].group != group)
            m++;
        found = m < q->caustics->n_mirrors && psi_mirror(q, m, c);
    }
    vec3 from = q->z->p;
    found = found && q->k == k;
    for (int i = 0; found && i < k; i++) {
        vec3 p = x[i * step].p;
        found = length(sub(p, c->at[i])) < 1e-4 * length(sub(p, from));
        from = p;
    }
    return found;
}

double caustic_hit_share(const struct scene *scene, const struct caustics *caustics, struct arena *arena,
                         const struct vertex *eye, int t)
{
    const struct vertex *end = &eye[t - 1];
    int k = 0;
    while (end[-k].prev_delta)
        k++;
    const struct vertex *z = end - k - 1;
    if (k == 0 || k > caustics->longest || z->kind != VERTEX_SURFACE || z->eye_end != FIRST_HIT)
        return 1;
    const struct vertex *lamp = end->lamp != NULL ? end->lamp : end;
    if (lamp->kind == VERTEX_SURFACE && lamp->light < 0)
        return 1;
    struct light_point y = vertex_light_point(lamp);
    y.w = neg(lamp->wo);
    y.pdf = lamp->pdf_origin;
    struct quest q = quest_for(scene, caustics, arena, z, &y);
    struct chain c;
    if (!in_psi(&q, z + 1, 1, k, &c))
        return 1;
    double own = hit_density(&q, &c, cosine_at(&q, &c));
    return own / (own + connect_density(&q));
}

bool caustic_makes(const struct scene *scene, const struct caustics *caustics, struct arena *arena,
                   const struct vertex *light, int s)
{
    int k = s - 2;
    if (k < 1 || k > caustics->longest)
        return false;
    for (int i = 2; i < s; i++)
        if (!light[i].prev_delta)
            return false;
    struct light_point y = vertex_light_point(&light[0]);
    struct quest q = quest_for(scene, caustics, arena, &light[s - 1], &y);
    struct chain c;
    return in_psi(&q, &light[s - 2], -1, k, &c);
}
