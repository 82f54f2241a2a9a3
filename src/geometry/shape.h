/* shape.h: the geometry of a scene: triangles, quadrics and curves in flat arrays, in world space, or in that of an
 * object, which instances then place.
 *
 * Primitives are numbered: triangle i is primitive i, quadric i is primitive FIRST_QUADRIC + i, curve i is primitive
 * FIRST_CURVE + i, instance i as a whole FIRST_INSTANCE + i, so that a number given out stays valid when shapes are
 * added. Each of the first three belongs to a group (what one Shape directive made), which carries material, alpha
 * textures and area light.
 *
 * Tests: test_shape.c.
 */
#ifndef ASBDPT_SHAPE_H
#define ASBDPT_SHAPE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "base/transform.h"
#include "base/vec.h"
#include "geometry/curve.h"
#include "geometry/quadric.h"
#include "geometry/surface.h"

enum { FIRST_QUADRIC = 1 << 30, FIRST_CURVE = FIRST_QUADRIC + (1 << 28), FIRST_INSTANCE = FIRST_CURVE + (1 << 28) };

/* What the primitives of one Shape directive have in common. */
struct shape_group {
    int material;     /* index into scene->materials; -1: none, rays pass through */
    int alpha;        /* float texture, -1 if none: a hole where it is 0 */
    int first_light;  /* area light of primitive first_prim, the others follow; -1 if none */
    int first_prim;   /* first primitive of the group, the others follow */
    int n_prims;
    bool shared;      /* it belongs to an object */
    int medium[2];    /* against its normal, and along it (scene/medium.h); if they differ it bounds them */
    bool two_sided;   /* its lights are; else they shine along the normal */
    bool flip;        /* quadric: ReverseOrientation; triangle without N: whether its normal is negated, which is that
                       * xor the transform swaps handedness */
    bool has_n;       /* vertex normals given (already negated under ReverseOrientation): they orient ng as well */
    bool has_s;       /* vertex tangents given */
    bool has_uv;
    bool skip_partials; /* leave partial derivatives zero: nobody reads them (scene_prepare finds out) */
    bool skip_uv;       /* leave all of these and u and v as they are */
};

/* shape_is_interface: does it bound media? */
static inline bool shape_is_interface(const struct shape_group *g) { return g->medium[0] != g->medium[1]; }

/* Neighbouring groups that are not in the world, but wherever an instance places them. */
struct object {
    int first_group, end_group;
    vec3 lo, hi; /* their bounds */
};

struct instance {
    struct transform to_world;
    int object;
};

struct geometry {
    /* Triangle meshes, all concatenated. Vertex arrays share one numbering. */
    float *P;         /* [n_vertices*3] world positions */
    float *N;         /* [n_vertices*3] world normals, at most 1 long; zeros where a group has none */
    float *S;         /* the same of tangents; NULL if no group has any */
    float *UV;        /* [n_vertices*2] */
    uint32_t *index;  /* [n_triangles*3] */
    int32_t *group_of_triangle; /* [n_triangles] */
    struct quadric *quadric;    /* [n_quadrics] */
    struct curves curves;
    struct shape_group *group;  /* [n_groups] */
    struct object *object;      /* [n_objects] */
    struct instance *instance;  /* [n_instances] */
    int n_vertices, n_triangles, n_quadrics, n_groups, n_objects, n_instances;
    size_t vertex_capacity, tangent_capacity, triangle_capacity;

    /* Alpha textures: asked at a hit of a group with alpha >= 0. Returns true where the surface is there. Set by
     * scene.c; NULL means everything is opaque. */
    bool (*opaque)(const void *context, const struct geometry *geo, const struct hit *hit);
    const void *opaque_context;
};

/* A mesh as a Shape directive or a PLY file describes it, in object space. Owned arrays; see mesh_free. */
struct mesh {
    vec3 *P;            /* [n_vertices]; only what is in world space is rounded to floats */
    float *N, *UV;      /* [n_vertices * 3, 2]; may be NULL */
    uint32_t *index;    /* [n_triangles*3], every entry < n_vertices */
    int n_vertices, n_triangles;
    int n_thin;         /* faces of the file of fewer than 3 corners, which are left out */
    uint64_t content;   /* hash_content of the file it was read from; 0: none */
    size_t file_size;   /* bytes of it */
    float *S;           /* [n_vertices*3] tangents; or NULL */
    struct strand *strand; /* [n_strands], instead of triangles */
    int n_strands;
};

/* mesh_free: release its arrays; the mesh is empty then. geometry_free: the same of a geometry. */
void mesh_free(struct mesh *m);

/* mesh_primitives: how many it has. mesh_point: a point of it, if there are any. */
static inline int mesh_primitives(const struct mesh *m) { return m->n_triangles + m->n_strands; }
static inline vec3 mesh_point(const struct mesh *m) { return m->n_triangles > 0 ? m->P[0] : m->strand[0].P[0]; }

/* shape_add_mesh: transform a mesh to world space and append it as one group.
 *   group  material, alpha and light fields to use; first_prim, flip (from reverse_orientation), has_n, has_s
 *          and has_uv are filled in here
 * Degenerate triangles (zero area) are kept: they are never hit. Returns the group's number, or -1 with a
 * message when a world position is no place (vec.h) or there would be more than 2^30 triangles, or
 * 2^28 curves. */
int shape_add_mesh(struct geometry *geo, const struct mesh *m, const struct transform *to_world,
                   struct shape_group group, bool reverse_orientation, struct error *err);

/* shape_add_quadric: append one quadric as a group of its own (q.group is filled in, the parameters are clamped
 * as pbrt does). Returns the group's number, or -1 with a message when its bounds are no places (vec.h) or there
 * would be more than 2^28 quadrics. */
int shape_add_quadric(struct geometry *geo, struct quadric q, struct shape_group group, bool reverse_orientation,
                      struct error *err);

/* shape_make_object: take the groups from this one on out of the world. Returns the object's number.
 * shape_add_instance: place it. False with a message when some of it would be at no place (vec.h) or there would be
 * more than 2^29 instances. */
int shape_make_object(struct geometry *geo, int first_group);
bool shape_add_instance(struct geometry *geo, int object, const struct transform *to_world, struct error *err);

void geometry_free(struct geometry *geo);

/* geometry_primitives: how many primitives there are (their numbers are not contiguous, see above). */
static inline int geometry_primitives(const struct geometry *geo)
{
    return geo->n_triangles + geo->n_quadrics + geo->curves.n;
}

/* shape_group_of: the group a primitive belongs to. */
const struct shape_group *shape_group_of(const struct geometry *geo, int prim);

/* shape_is_light: has its group lights? shape_rank: of surfaces in one place that which has the least is there, for all
 * who are in direction w of it: a see-through light rather than another, a light that shines there rather than one that
 * does not, any light rather than what does not shine, and then that of the lower number.
 * shape_light_rank: that of a light that shines there. */
bool shape_is_light(const struct geometry *geo, int prim);
uint64_t shape_rank(const struct geometry *geo, const struct hit *hit, const struct ray *ray, vec3 w);
uint64_t shape_light_rank(const struct geometry *geo, int prim);

/* shape_vertices: the three corners of a triangle, x y z of each. */
void shape_vertices(const struct geometry *geo, int triangle, float v[9]);

/* shape_bounds: bounding box of one primitive, which may be an instance, never inside out, conservative in float. */
void shape_bounds(const struct geometry *geo, int prim, float lo[3], float hi[3]);

/* shape_intersect: does the ray meet this primitive within (tmin, tmax), unless it begins or ends on it? Fills
 * *hit if so. Double precision, edges shared by two triangles leave no gap. Alpha is not looked at here. */
bool shape_intersect(const struct geometry *geo, int prim, const struct ray *ray, struct hit *hit);

/* shape_prim_id: the number, not 0, by which rays and points name the primitive of an instance (0: of none) that they
 * begin, end or lie on. shape_prim: its primitive. */
static inline uint64_t shape_prim_id(int prim, int instance) { return (uint64_t)instance << 32 | ((uint32_t)prim + 1); }
static inline int shape_prim(uint64_t id) { return (int)((uint32_t)id - 1); }

/* shape_own_id: that of the same primitive for rays in the object's own space, if it is in this instance; else 0. */
static inline uint64_t shape_own_id(uint64_t id, int instance)
{
    return id >> 32 == (uint64_t)instance ? (uint32_t)id : 0;
}

/* shape_surface: the full surface point of a hit (position from the barycentric coordinates for triangles,
 * refined onto the surface for quadrics). Shading normal and partials as pbrt-v3 defines them. */
void shape_surface(const struct geometry *geo, const struct hit *hit, const struct ray *ray, struct surface *out);

/* shape_area: world area of a triangle or quadric in m^2 (quadrics: exact under similarity transforms, otherwise by
 * numerical integration). */
double shape_area(const struct geometry *geo, int prim);

/* shape_sample: a point of the primitive, uniform by area (triangles; quadrics: uniform in object space).
 *   out    p and ng are filled in, of a triangle nothing else
 *   pdf_a  out: density per m^2 of world area at that point
 * Returns false where an alpha texture leaves a hole there. */
bool shape_sample(const struct geometry *geo, int prim, double u1, double u2, struct surface *out, double *pdf_a);

/* shape_pdf_a: the density with which shape_sample returns the given point of the primitive, 1/m^2. */
double shape_pdf_a(const struct geometry *geo, int prim, const struct surface *at);

#endif
