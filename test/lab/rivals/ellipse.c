/* ellipse.c: ellipsoidal connections: only light whose path has a length from `from` to below `to`. A vertex between
 * eye vertex and light point is drawn so that the path has such a length.                         [Pediredla 2019]
 *
 * z being an eye vertex, y a light point, tau uniform in what these bounds leave for both edges, x is drawn where the
 * ellipsoid |y - x| + |x - z| = tau cuts a triangle, which is chosen by area; squeezed, so that the ellipsoid is a
 * sphere, its plane cuts a circle, of which up to three arcs are inside; on them the angle phi is uniform. As
 * dA = |dx/dphi| dphi dtau / |g|, g being the part along the triangle of the gradient of the length, the density per
 * area is
 *     p(x) = P(triangle) |g| / ((tau_1 - tau_0) Phi |dx/dphi|),   Phi: the angle of all arcs.
 *
 * Paths are divided: those whose last two vertices before a light's point x and z are joined by this are its own, and
 * what s = 0 and s = 1 make of them counts for nothing; all others are theirs. Its own are those that end on a light in
 * space, with no delta lobe at x or z, x being on a triangle. The original finds triangles that are cut by a hierarchy;
 * here most draws miss in scenes of many triangles. With `to` 0 this is pt, and has paths of all lengths.
 *
 * Tests: test_rival_parts.c, test_gates.c.
 */
#include "rivals/ellipse.h"

#include <stdlib.h>

#include "base/alias.h"
#include "base/maths.h"
#include "caustics/derived.h"
#include "caustics/lamp.h"
#include "caustics/one_more.h"
#include "caustics/specular.h"
#include "caustics/surfaces.h"
#include "caustics/visible.h"

struct ellipse {
    struct one_more more;       /* the first */
    struct alias_table by_area; /* of triangles */
    double from, to;
};

/* --- where the ellipsoid cuts a triangle --------------------------------------------------------------- */

/* About its middle, along its axis long, across it wide. */
struct ellipsoid {
    vec3 middle, axis;
    double longer, wider; /* semi-axes */
};

/* Lengths along the axis times `a`, across it times `b`. */
static vec3 scale(const struct ellipsoid *e, vec3 v, double a, double b)
{
    double along = dot(v, e->axis);
    return add(mul(v, b), mul(e->axis, along * (a - b)));
}

/* The circle in which the unit sphere cuts a plane: middle + radius (cos phi s + sin phi t). */
struct circle {
    vec3 middle, s, t;
    double radius;
};

/* Angles of the arcs inside all three edges, [from, to) each; their number. */
static int arcs_inside(const struct circle *c, const vec3 p[3], double from[6], double to[6])
{
    double at[8], lean[3], half[3];
    int n = 0, n_arcs = 0;
    vec3 normal = cross(sub(p[1], p[0]), sub(p[2], p[0]));
    at[n++] = 0;
    for (int i = 0; i < 3; i++) { /* inside is |phi - lean| < half */
        vec3 in = normalize(cross(normal, sub(p[(i + 1) % 3], p[i])));
        double depth = dot(in, sub(c->middle, p[i])) / c->radius;
        lean[i] = m_atan2(dot(in, c->t), dot(in, c->s));
        half[i] = m_acos(clamp(-depth, -1, 1));
        for (int k = -1; k <= 1; k += 2)
            at[n++] = fmod(lean[i] + k * half[i] + 4 * PI, 2 * PI);
    }
    at[n++] = 2 * PI;
    for (int i = 1; i < n; i++)
        for (int j = i; j > 0 && at[j] < at[j - 1]; j--) {
            double swap = at[j];
            at[j] = at[j - 1];
            at[j - 1] = swap;
        }
    for (int i = 0; i + 1 < n; i++) {
        double mid = (at[i] + at[i + 1]) / 2;
        bool inside = at[i + 1] > at[i];
        for (int k = 0; k < 3; k++)
            inside &= fabs(remainder(mid - lean[k], 2 * PI)) < half[k];
        from[n_arcs] = at[i];
        to[n_arcs] = at[i + 1];
        n_arcs += inside;
    }
    return n_arcs;
}

/* A point where it cuts the triangle, with the number u, and |dx/dphi| Phi; false if it does not. */
static bool cut(const struct ellipsoid *e, const vec3 corner[3], double u, vec3 *x, double *span)
{
    vec3 p[3];
    double from[7], to[7], Phi = 0;
    for (int i = 0; i < 3; i++)
        p[i] = scale(e, sub(corner[i], e->middle), 1 / e->longer, 1 / e->wider);
    vec3 n = normalize(cross(sub(p[1], p[0]), sub(p[2], p[0])));
    double h = dot(n, p[0]);
    if (!(fabs(h) < 1))
        return false;
    const struct frame f = frame_from_normal(n);
    struct circle c = {mul(n, h), f.s, f.t, sqrt(1 - h * h)};
    int n_arcs = arcs_inside(&c, p, from, to), i = 0;
    for (int k = 0; k < n_arcs; k++)
        Phi += to[k] - from[k];
    if (!(Phi > 0))
        return false;
    double left = u * Phi;
    for (; i < n_arcs - 1 && left >= to[i] - from[i]; i++)
        left -= to[i] - from[i];
    double phi = from[i] + left, co = m_cos(phi), si = m_sin(phi);
    vec3 out = add(mul(c.s, c.radius * co), mul(c.t, c.radius * si));
    vec3 change = add(mul(c.s, -c.radius * si), mul(c.t, c.radius * co));
    *x = add(e->middle, scale(e, add(c.middle, out), e->longer, e->wider));
    *span = Phi * length(scale(e, change, e->longer, e->wider));
    return true;
}

bool ellipse_draw(vec3 y, vec3 z, const vec3 corner[3], double tau, double range, double u, vec3 *x, double *pdf)
{
    double apart = length(sub(y, z)), span;
    const struct ellipsoid e = {lerp3(0.5, y, z), mul(sub(y, z), 1 / apart), tau / 2, sqrt(sqr(tau) - sqr(apart)) / 2};
    if (!(apart > 0 && tau > apart) || !cut(&e, corner, u, x, &span))
        return false;
    vec3 n = normalize(cross(sub(corner[1], corner[0]), sub(corner[2], corner[0])));
    vec3 g = add(normalize(sub(*x, y)), normalize(sub(*x, z)));
    *pdf = length(sub(g, mul(n, dot(g, n)))) / (range * span);
    return *pdf > 0;
}

/* --- the strategy ------------------------------------------------------------------------------------- */

/* The point x of a triangle as a vertex that comes after z with this density per area; in the sample's arena. NULL if
 * nothing arrives. */
static const struct vertex *arrive(const struct sample *sample, const struct vertex *z, int triangle, vec3 x,
                                   const vec3 corner[3], double pdf)
{
    const struct scene *scene = sample->pass->job->scene;
    const struct geometry *geo = &scene->geo;
    const struct shape_group *group = shape_group_of(geo, triangle);
    struct arena *arena = &sample->pass->work->arena;
    struct hit hit = {.prim = triangle};
    struct surface at;
    if (group->material < 0 ||
        !combination(sub(corner[1], corner[0]), sub(corner[2], corner[0]), sub(x, corner[0]), &hit.b1, &hit.b2) ||
        (group->alpha >= 0 && geo->opaque != NULL && !geo->opaque(geo->opaque_context, geo, &hit)))
        return NULL;
    const struct ray none = {z->p, vec(0, 0, 1), 0, INFINITY, 0, 0};
    shape_surface(geo, &hit, &none, &at);
    vec3 d = sub(at.p, z->p);
    double d2 = length2(d);
    vec3 w = mul(d, 1 / sqrt(d2));
    if (!(d2 > 0) || !bsdf_may_scatter(&z->bsdf, z->wo, w))
        return NULL;
    rgb f = bsdf_eval(&z->bsdf, z->wo, w, RADIANCE).f;
    struct vertex *v = arena_alloc(arena, sizeof *v);
    *v = (struct vertex){.kind = VERTEX_SURFACE, .light = -1, .p = at.p, .ng = at.ng,
                         .prim_id = at.prim_id, .wo = neg(w), .pdf_fwd = 1,
                         .beta = rgb_scale(rgb_mul(z->beta, f),
                                           scatter_cosine(z, w, RADIANCE) * abs_dot(at.ng, w) / (d2 * pdf))};
    if (rgb_is_black(v->beta) || !rgb_is_finite(v->beta) || !scene_visible(scene, z->p, z->prim_id, at.p, at.prim_id))
        return NULL;
    material_bsdf(scene->material, group->material, &scene->textures, &at, arena, &v->bsdf);
    return vertex_connectible(v) ? v : NULL;
}

static int connect(const struct one_more *self, struct sample *sample, const struct vertex *eye, int t,
                   struct one_more_path out[ONE_MORE_MOST])
{
    const struct ellipse *own = (const void *)self;
    const struct scene *scene = sample->pass->job->scene;
    const struct vertex *z = &eye[t - 1], *at = NULL;
    double v[2], P, pdf;
    float P9[9];
    struct light_point y;
    vec3 corner[3], x;
    if (t > sample->pass->job->max_depth || !vertex_connectible(z) || own->by_area.n == 0)
        return 0;
    bool lit = lamp_draw(scene, &sample->sampler, &y);
    sampler_pair(&sample->sampler, DRAW_SCATTERING, v);
    int triangle = alias_sample(&own->by_area, sampler_number(&sample->sampler, DRAW_LIGHT_END), &P, NULL);
    if (!lit || light_at_infinity(&scene->lights.light[y.light]))
        return 0;
    double far = subpath_length(scene, eye, t), most = own->to - far;
    double least = fmax(own->from - far, length(sub(y.p, z->p))), tau = least + (most - least) * v[0];
    if (!(least < most))
        return 0;
    shape_vertices(&scene->geo, triangle, P9);
    for (int i = 0; i < 3; i++)
        corner[i] = vec((double)P9[3 * i], (double)P9[3 * i + 1], (double)P9[3 * i + 2]);
    if (ellipse_draw(y.p, z->p, corner, tau, most - least, v[1], &x, &pdf))
        at = arrive(sample, z, triangle, x, corner, P * pdf);
    if (at == NULL)
        return 0;
    out[0] = (struct one_more_path){lamp_connect(scene, sample->pass->counts, at, &y, y.pdf), y, at, 1};
    out[0].c.weight = 1;
    return 1;
}

/* Of others' paths those that are its own, or have another length, count for nothing. */
static void weigh(const struct one_more *self, const struct sample *sample, const struct joined *j, vec3 lens,
                  struct connection *c)
{
    const struct ellipse *own = (const void *)self;
    const struct scene *scene = sample->pass->job->scene;
    double length = path_length(scene, j);
    (void)lens;
    if (!(length >= own->from && length < own->to))
        c->weight = 0;
    if (j->s > 1 || j->t + j->s < 4)
        return;
    const struct vertex *x = j->z - 1 + j->s, *z = x - 1, *end = x + 1;
    bool in_space = j->s > 0 ? !light_at_infinity(&scene->lights.light[c->light])
                             : (end->kind == VERTEX_SURFACE || end->lamp != NULL) && !end->prev_delta;
    if (in_space && z->kind == VERTEX_SURFACE && !x->prev_delta && x->prim_id - 1 < FIRST_QUADRIC)
        c->weight = 0;
}

/* --- the row ------------------------------------------------------------------------------------------ */

static void prepare(const struct render_job *job, struct prepared *p)
{
    struct ellipse *own = p->own;
    const struct geometry *geo = &job->scene->geo;
    double *area = mem_alloc((size_t)geo->n_triangles, sizeof *area);
    for (int i = 0; i < geo->n_triangles; i++)
        area[i] = shape_area(geo, i);
    alias_build(&own->by_area, area, geo->n_triangles);
    free(area);
    own->more = (struct one_more){connect, weigh};
}

static void release(struct prepared *p) { alias_free(&((struct ellipse *)p->own)->by_area); }

extern const struct method method_pt;

static void render(const struct prepared *p, const struct tile_pass *pass)
{
    const struct ellipse *own = p->own;
    if (own->to > 0)
        one_more_render(p, &own->more, pass);
    else
        method_pt.render(p, pass);
}

static const struct field OWN[] = {
    {"from", FIELD_NUMBER, offsetof(struct ellipse, from), 0, 0, 1e30,
     "least length of a path from light to lens, in scene units", NULL},
    {"to", FIELD_NUMBER, offsetof(struct ellipse, to), 0, 0, 1e30,
     "length that all stay below; 0: paths of any length, by pt", NULL},
    {.name = NULL}};

const struct method method_ellipse = {
    .name = "ellipse", .check = surfaces_alone,
    .help = "ellipsoidal connections [Pediredla 2019]: light between two path lengths; else pt",
    .own = OWN, .own_size = sizeof(struct ellipse), .numbers = NUMBERS_OF_PT, .rr_threshold = DEFAULT_RR_THRESHOLD,
    .prepare = prepare, .release = release, .render = render};
