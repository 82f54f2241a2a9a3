/* kd_parts.c: see kd_parts.h. */
#include "kd_parts.h"

#include <string.h>

#include "base/mem.h"
#include "lab/numbers.h"
#include "helpers.h"

/* --- geometry ----------------------------------------------------------------------------------------- */

static uint32_t add_vertex(struct mesh *m, vec3 p)
{
    m->P = mem_append(m->P, (size_t)m->n_vertices, sizeof *m->P);
    m->P[m->n_vertices] = p;
    return (uint32_t)m->n_vertices++;
}

static void add_face(struct mesh *m, uint32_t a, uint32_t b, uint32_t c)
{
    const uint32_t face[3] = {a, b, c};
    m->index = mem_append(m->index, (size_t)m->n_triangles, sizeof face);
    memcpy(m->index + 3 * m->n_triangles++, face, sizeof face);
}

/* A triangle with vertices of its own. */
void add_triangle(struct mesh *s, vec3 a, vec3 b, vec3 c)
{
    uint32_t ia = add_vertex(s, a), ib = add_vertex(s, b), ic = add_vertex(s, c);
    add_face(s, ia, ib, ic);
}

/* Move the mesh into a geometry. */
struct geometry geometry_of(struct test *t, struct mesh *s)
{
    struct geometry geo = {0};
    struct transform id = transform_identity();
    struct error err;
    if (s->n_triangles > 0)
        CHECK(t, shape_add_mesh(&geo, s, &id, group_of(0, -1), false, &err) == 0, "%s", err.text);
    mesh_free(s);
    return geo;
}

vec3 in_cube(struct rng *r)
{
    double x = rng_uniform(r), y = rng_uniform(r), z = rng_uniform(r);
    return vec(2 * x - 1, 2 * y - 1, 2 * z - 1);
}

void make_random(struct mesh *s, struct rng *r, int n, double size, vec3 offset)
{
    for (int i = 0; i < n; i++) {
        vec3 c = add(in_cube(r), offset);
        vec3 e1 = mul(in_cube(r), size), e2 = mul(in_cube(r), size);
        add_triangle(s, c, add(c, e1), add(c, e2));
    }
}

/* Long and thin in every direction, and some of no area at all. */
void make_needles(struct mesh *s, struct rng *r, int n)
{
    for (int i = 0; i < n; i++) {
        vec3 a = in_cube(r), b = in_cube(r), w = mul(in_cube(r), 1e-5);
        add_triangle(s, a, b, i % 10 == 0 ? lerp3(0.5, a, b) : add(b, w));
    }
}

/* Axis-aligned squares on integer coordinates: three grids that cross each other, one of them twice. */
void make_grids(struct mesh *s, int n)
{
    for (int layer = 0; layer < 4; layer++)
        for (int i = 0; i < n; i++)
            for (int k = 0; k < n; k++) {
                double x = i, y = k;
                vec3 p[4] = {vec(x, y, 2), vec(x + 1, y, 2), vec(x + 1, y + 1, 2), vec(x, y + 1, 2)};
                for (int c = 0; c < 4; c++)
                    p[c] = layer == 0 ? vec(p[c].z, p[c].x, p[c].y) : layer == 1 ? vec(p[c].x, p[c].z, p[c].y) : p[c];
                add_triangle(s, p[0], p[1], p[2]);
                add_triangle(s, p[0], p[2], p[3]);
            }
}

/* The same triangle many times, and a few others. */
void make_duplicates(struct mesh *s, struct rng *r, int n)
{
    vec3 a = in_cube(r), b = in_cube(r), c = in_cube(r);
    for (int i = 0; i < n; i++)
        add_triangle(s, a, b, c);
    make_random(s, r, 20, 0.5, vec(0, 0, 0));
}

/* A closed surface: a sphere of rows x columns quads, radius varied a little, vertices shared. */
void make_ball(struct mesh *s, struct rng *r, int rows, int columns, double radius, vec3 center)
{
    uint32_t south = add_vertex(s, add(center, vec(0, 0, -radius))), first = south + 1;
    for (int i = 1; i < rows; i++)
        for (int k = 0; k < columns; k++) {
            double theta = PI * i / rows, phi = 2 * PI * k / columns, l = radius * (1 + 0.01 * rng_uniform(r));
            add_vertex(s, add(center, vec(l * sin(theta) * cos(phi), l * sin(theta) * sin(phi), -l * cos(theta))));
        }
    uint32_t north = add_vertex(s, add(center, vec(0, 0, radius))), m = (uint32_t)columns;
    for (uint32_t k = 0; k < m; k++) {
        uint32_t next = (k + 1) % m, last = first + (uint32_t)(rows - 2) * m;
        add_face(s, south, first + next, first + k);
        add_face(s, north, last + k, last + next);
        for (uint32_t i = 0; i + 2 < (uint32_t)rows; i++) {
            uint32_t row = first + i * m;
            add_face(s, row + k, row + next, row + m + next);
            add_face(s, row + k, row + m + next, row + m + k);
        }
    }
}

void add_quadrics(struct geometry *geo, struct rng *r, int n)
{
    for (int i = 0; i < n; i++) {
        struct transform move = transform_translate(in_cube(r));
        struct transform turn = transform_rotate(360 * rng_uniform(r), on_sphere(r));
        struct transform scale = transform_scale(1, 0.5 + rng_uniform(r), i % 2 == 0 ? -1 : 2);
        struct quadric q = {.kind = (enum quadric_kind)(i % 6), .radius = 0.2, .inner_radius = 0.05, .zmax = 0.15};
        q.to_world = transform_compose(move, transform_compose(turn, scale));
        q.zmin = i % 6 < 3 ? -0.1 : 0;
        q.phi_max = i % 4 == 0 ? 4 : 2 * PI;
        q.p1 = vec(0.1, -0.1, -0.1);
        q.p2 = vec(0.1, 0.2, 0.15);
        if (q.kind == QUADRIC_DISK)
            q.zmin = q.zmax = 0.1;
        shape_add_quadric(geo, q, group_of(0, -1), false, NULL);
    }
}

/* --- rays --------------------------------------------------------------------------------------------- */

int prim_number(const struct geometry *geo, int i)
{
    return i < geo->n_triangles ? i : FIRST_QUADRIC + i - geo->n_triangles;
}

/* A point of the geometry: inside a primitive, a vertex, or the middle of an edge. */
static vec3 some_point(const struct geometry *geo, struct rng *r)
{
    int i = (int)rng_below(r, (uint32_t)geometry_primitives(geo)), kind = (int)rng_below(r, 3);
    if (i < geo->n_triangles && kind > 0) {
        float v[9];
        shape_vertices(geo, i, v);
        vec3 a = vec(v[0], v[1], v[2]), b = vec(v[3], v[4], v[5]);
        return kind == 1 ? a : lerp3(0.5, a, b);
    }
    struct surface at;
    double pdf, u1 = rng_uniform(r), u2 = rng_uniform(r);
    shape_sample(geo, prim_number(geo, i), u1, u2, &at, &pdf);
    return at.p;
}

vec3 axis(int i)
{
    double sign = i % 2 == 0 ? 1 : -1;
    return vec(i / 2 == 0 ? sign : 0, i / 2 == 1 ? sign : 0, i / 2 == 2 ? sign : 0);
}

struct ray awkward_ray(const struct geometry *geo, struct rng *r, double size)
{
    vec3 p = some_point(geo, r), q = some_point(geo, r), out = mul(on_sphere(r), 2 * size), d = on_sphere(r);
    vec3 along = axis((int)rng_below(r, 6));
    const struct {
        vec3 o, d;
    } way[] = {{p, along},                            /* from a point, along an axis */
               {p, sub(q, p)},                        /* from point to point */
               {add(p, out), neg(out)},               /* from outside, at a point */
               {sub(p, mul(along, 2 * size)), along}, /* along an axis at it */
               {p, vec(d.x, d.y, 0)},                 /* within a plane */
               {add(p, out), d},                      /* mostly past everything */
               {p, d}};
    uint32_t i = rng_below(r, 7);
    struct ray ray = {way[i].o, normalize(way[i].d), 0, HUGE_VAL, 0, 0};
    if (!(length(ray.d) > 0.5))
        ray.d = vec(0, 0, 1);
    ray.tmin = rng_below(r, 2) == 0 ? 0 : 1e-6 * size;
    ray.tmax = rng_below(r, 3) == 0 ? size * rng_uniform(r) : HUGE_VAL;
    return ray;
}

/* --- brute force --------------------------------------------------------------------------------------- */

/* The ray in an object's space, or the world's (instance 0). */
static struct ray ray_in(const struct geometry *geo, int instance, const struct ray *ray)
{
    struct ray r = *ray;
    if (instance > 0) {
        r.o = transform_point_back(&geo->instance[instance - 1].to_world, ray->o);
        r.d = transform_vector_back(&geo->instance[instance - 1].to_world, ray->d);
    }
    r.from = ray->from >> 32 == (uint64_t)instance ? (uint32_t)ray->from : 0;
    r.to = ray->to >> 32 == (uint64_t)instance ? (uint32_t)ray->to : 0;
    return r;
}

/* Is the group in the tree that `instance` is about, and see-through or not? */
static bool is_of(const struct geometry *geo, const struct shape_group *g, int instance, bool see_through)
{
    const struct object *o = instance > 0 ? &geo->object[geo->instance[instance - 1].object] : NULL;
    int number = (int)(g - geo->group);
    return (g->material < 0) == see_through && g->shared == (o != NULL) &&
           (o == NULL || (number >= o->first_group && number < o->end_group));
}

static bool begins_there(const struct geometry *geo, const struct ray *ray, const struct hit *h);

/* All first hits of all primitives, one by one, are handed to `note`. see_through: of the primitives without material,
 * else of those with one. */
static void each_hit(const struct geometry *geo, bool see_through, const struct ray *ray,
                     void (*note)(const struct geometry *geo, const struct ray *ray, const struct hit *h, void *best),
                     void *best)
{
    for (int instance = 0; instance <= geo->n_instances; instance++) {
        const struct ray r = ray_in(geo, instance, ray);
        for (const struct shape_group *g = geo->group; g < geo->group + geo->n_groups; g++)
            for (int i = 0; i < g->n_prims && is_of(geo, g, instance, see_through); i++) {
                struct hit h;
                if (!shape_intersect(geo, g->first_prim + i, &r, &h))
                    continue;
                h.instance = instance;
                if (begins_there(geo, ray, &h))
                    continue;
                if (geo->opaque == NULL || geo->opaque(geo->opaque_context, geo, &h))
                    note(geo, ray, &h, best);
            }
    }
}

static void nearest(const struct geometry *geo, const struct ray *ray, const struct hit *h, void *best)
{
    struct hit *n = best;
    (void)geo;
    (void)ray;
    if (n->prim < 0 || h->t < n->t)
        *n = *h;
}

static double cosine_of(const struct geometry *geo, const struct ray *ray, const struct hit *h)
{
    struct surface at;
    shape_surface(geo, h, ray, &at);
    return abs_dot(at.ng, ray->d);
}

/* Of the nearest, *best, and those in its place: a light for lights, else the lower number. Both surfaces are no farther
 * from the other than a margin, straight from one to the other. */
static void in_place(const struct geometry *geo, const struct ray *ray, const struct hit *h, void *best)
{
    struct hit *n = best;
    vec3 p = add(ray->o, mul(ray->d, n->t));
    bool shines[2] = {shape_group_of(geo, h->prim)->first_light >= 0, shape_group_of(geo, n->prim)->first_light >= 0};
    double margin = ray_margin(p) + 1e-6 * ray_margin(ray->o), apart = fabs(h->t - n->t);
    double slant = fmax(cosine_of(geo, ray, h), cosine_of(geo, ray, n));
    if (apart > margin && (apart >= GRAZING * margin || apart * slant > margin))
        return;
    if (shines[0] == shines[1] ? shape_prim_id(h->prim, h->instance) < shape_prim_id(n->prim, n->instance) : shines[0])
        *n = *h;
}

/* Where the ray begins on a primitive, does this hit lie in one place with that? */
static bool begins_there(const struct geometry *geo, const struct ray *ray, const struct hit *h)
{
    struct hit own = {.b1 = 0.25, .b2 = 0.25, .prim = shape_prim(ray->from), .instance = (int)(ray->from >> 32)};
    if (ray->from == 0 || h->t >= GRAZING * ray->tmin)
        return false;
    return h->t * fmax(cosine_of(geo, ray, h), cosine_of(geo, ray, &own)) <= ray->tmin;
}

bool brute_closest(const struct geometry *geo, bool see_through, const struct ray *ray, struct hit *hit)
{
    hit->prim = -1;
    each_hit(geo, see_through, ray, nearest, hit);
    if (hit->prim >= 0)
        each_hit(geo, see_through, ray, in_place, hit);
    return hit->prim >= 0;
}
