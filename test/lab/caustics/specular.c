/* specular.c: see specular.h. */
#include "caustics/specular.h"
#include "caustics/derived.h"

/* --- a ray and its derivatives ------------------------------------------------------------------------- */

int specular_group(const struct scene *scene, const struct surface *at)
{
    return (int)(shape_group_of(&scene->geo, shape_prim(at->prim_id)) - scene->geo.group);
}

static vec3 along(const struct surface *at, double u, double v) { return add(mul(at->dndu, u), mul(at->dndv, v)); }

vec3 specular_normal_change(const struct geometry *geo, const struct surface *at, vec3 dp)
{
    int prim = shape_prim(at->prim_id);
    double u, v, b1, b2;
    if (prim >= FIRST_QUADRIC) { /* `at` may lack derivatives, see struct shape_group */
        const struct quadric *q = &geo->quadric[prim - FIRST_QUADRIC];
        struct surface whole;
        vec3 p = transform_point_back(&q->to_world, at->p);
        quadric_surface_at(q, shape_group_of(geo, prim)->flip, false, p, &whole);
        return combination(whole.dpdu, whole.dpdv, dp, &u, &v) ? along(&whole, u, v) : vec(0, 0, 0);
    }
    vec3 p[3], n[3];
    for (size_t i = 0; i < 3; i++) {
        size_t vertex = geo->index[3 * (size_t)prim + i];
        p[i] = load3(geo->P, vertex);
        n[i] = load3(geo->N, vertex);
    }
    vec3 e1 = sub(p[1], p[0]), e2 = sub(p[2], p[0]);
    if (!shape_group_of(geo, prim)->has_n || !combination(e1, e2, dp, &u, &v) ||
        !combination(e1, e2, sub(at->p, p[0]), &b1, &b2))
        return vec(0, 0, 0);
    vec3 d = add(mul(sub(n[1], n[0]), u), mul(sub(n[2], n[0]), v));
    double size = length(barycentric3(n, b1, b2));
    return size > 0 ? mul(sub(d, mul(at->ns, dot(at->ns, d))), 1 / size) : vec(0, 0, 0);
}

/* The ray arrives at a surface: its point moves by dp along that. */
static void transfer(struct specular_chain *c, const struct surface *at)
{
    double t = length(sub(at->p, c->p));
    for (int i = 0; i < 2; i++) {
        vec3 moved = add(c->dp[i], mul(c->dd[i], t));
        c->dp[i] = sub(moved, mul(c->d, dot(moved, at->ng) / dot(c->d, at->ng)));
    }
    c->length += t;
    c->p = at->p;
    c->prim_id = at->prim_id;
}

/* The ray goes on in direction s->wi. Reflection is d - 2 (d.n) n, refraction eta d + mu n with n on the side that the
 * ray comes from, mu = eta c - c_t. */
static void turn(struct specular_chain *c, const struct scene *scene, const struct surface *at,
                 const struct bsdf_sample *s, bool transmit)
{
    vec3 n = dot(c->d, at->ns) > 0 ? neg(at->ns) : at->ns;
    double cosine = -dot(c->d, n), eta = 1 / s->eta, cos_t = abs_dot(s->wi, n);
    for (int i = 0; i < 2; i++) {
        vec3 dn = specular_normal_change(&scene->geo, at, c->dp[i]);
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
static bool scatter(const struct quest *q, struct specular_chain *c, const struct surface *at)
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
    c->eta *= s.eta;
    return true;
}

bool specular_trace(const struct quest *q, vec3 w, struct specular_chain *c)
{
    const struct frame f = frame_from_normal(w);
    struct specular_chain start = {.w = w, .p = q->z->p, .d = w, .dd = {f.s, f.t}, .prim_id = q->z->prim_id,
                          .kappa = rgb_grey(1), .choice = 1, .eta = 1};
    *c = start;
    for (int i = 0; i < q->k; i++) {
        struct ray ray = {c->p, c->d, ray_margin(c->p), INFINITY, c->prim_id, 0};
        struct surface at;
        if (!scene_intersect(q->scene, &ray, &at) || at.material < 0 || dot(at.ng, c->d) == 0)
            return false;
        if (q->scene->geo.group[specular_group(q->scene, &at)].shared || shape_prim(at.prim_id) >= FIRST_CURVE)
            return false; /* the normals of the former are in another space */
        if (q->group >= 0 && specular_group(q->scene, &at) != q->group)
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
static double misses(const struct quest *q, const struct specular_chain *c, vec3 *miss, vec3 change[2])
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

double specular_area(const struct quest *q, const struct specular_chain *c)
{
    vec3 miss, change[2];
    double r = misses(q, c, &miss, change);
    return r * r * fabs(dot(cross(change[0], change[1]), c->d));
}

bool specular_search(const struct quest *q, vec3 w, struct specular_chain *c)
{
    enum { SHOTS = 16 };
    const double near = 1e-9, least = 1.0 / 16;
    double missed = INFINITY;
    vec3 miss, change[2], step = vec(0, 0, 0);
    struct specular_chain next;
    double size = 1;
    for (int i = 0; i < SHOTS && size >= least; i++) {
        bool better = specular_trace(q, normalize(sub(w, mul(step, size))), &next);
        if (better) {
            misses(q, &next, &miss, change);
            better = length(miss) < missed;
        }
        if (!better && i == 0)
            return false;
        size = better ? fmin(1, 2 * size) : size / 2;
        if (!better)
            continue;
        *c = next;
        w = next.w;
        missed = length(miss);
        if (missed < near)
            return true;
        double x, y;
        const struct frame f = frame_from_normal(w);
        if (!combination(change[0], change[1], miss, &x, &y))
            return false;
        step = add(mul(f.s, x), mul(f.t, y));
        step = mul(step, 1 / fmax(1, length(step)));
    }
    return false;
}
