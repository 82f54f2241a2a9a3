/* vertex.h: a vertex of a sub-path, with all that a connection to it needs. After the walk (path.h) nobody changes it.
 */
#ifndef ASBDPT_VERTEX_H
#define ASBDPT_VERTEX_H

#include "material/bsdf.h"
#include "scene/scene.h"

/* FIRST_HIT: an eye vertex that the camera sees directly or by delta lobes alone. */
enum eye_hit { FIRST_HIT, LATER_HIT, EYE_HITS };

enum vertex_kind {
    VERTEX_LENS,    /* z_0 */
    VERTEX_LIGHT,   /* y_0 */
    VERTEX_SURFACE, /* a scattering point, possibly on an area light */
    VERTEX_MEDIUM,  /* a scattering point within a medium */
    VERTEX_ESCAPED  /* a direction: the end of an eye sub-path that left the scene, for the sky or a `lamp` */
};

/* The meaning of the fields depends on the kind. A dash: not used. Densities are those of the vertex in its own walk.
 * They are per area, or per solid angle for directions towards infinity.
 *
 *                LENS         LIGHT (y_0)                       SURFACE                      ESCAPED
 *   light        -1           its light                         of the area light, or -1     of the sky, or -1
 *   place        -            its light cell                    its region                   -
 *   p            on the lens  on the light; at infinity -       the point                    -
 *   ng           0            area light: its normal; else 0    geometric normal             0
 *   prim_id      0            area light: see shape.h; else 0   see shape.h                  0
 *   wo           0            at infinity: towards the light    towards the previous vertex  inwards
 *   beta         1 (below)    emitted towards y_1 (below)       throughput on arrival        throughput on arrival
 *   pdf_fwd      1            1/m^2; at infinity 1/sr           1/m^2                        1/sr
 *   bsdf         -            -                                 its scattering               -
 *   lamp         -            -                                 eye walk: see below          see below
 *   eye_hit      -            -                                 light walk: LATER_HIT        -
 *
 * A light cell is a light, a group of lights, or a part of the sky (light.h). A region is a cube of space and a side of
 * its surfaces (regions.h), if a method learns; else the whole scene.
 *
 * A vertex within a medium (scene/medium.h) has the fields of a SURFACE, with ng 0, prim_id WITHIN_MEDIUM and pdf_fwd
 * per volume, 1/m^3.
 *
 * beta of a LIGHT or LENS is what it sends to the next vertex. An end that belongs to no walk (connect.h) has this
 * divided by its density: Le / pdf, or J of camera_project.
 *
 * At a first reading skip this. A see-through light is an area light without a material (scene.h). Walks may start on
 * it, and pass it without a vertex. The first such light that an eye walk passes on an edge is the `lamp` of the vertex
 * at the edge's end. It is the last vertex of a path of its own, and no vertex of the sub-path. Its kind is SURFACE. It
 * has only the fields that connect_s0 needs. The path's last edge ends at the light: densities and throughput have the
 * media as far as that.
 */
struct vertex {
    enum vertex_kind kind;
    bool prev_delta; /* the walk left the previous vertex by a delta lobe */
    enum eye_hit eye_hit;
    int light, place;
    vec3 p, ng;
    uint64_t prim_id;
    vec3 wo; /* unit */
    rgb beta;
    double pdf_fwd;
    int medium;   /* of the edge that ends here; LENS, LIGHT: of the place */
    double g;     /* of mis.h: turns a density per steradian here into one per area at the previous vertex; for
                   * connect.c: light_side */
    double mis;   /* mis_e of mis.h */
    double mis_c; /* c_e of mis.h, if this vertex is not left by a delta lobe */
    struct bsdf bsdf;
    const struct vertex *lamp; /* see above; NULL: none */
};

/* vertex_light: the y_0 of a point of a light (light.h).
 *   n_s0  count of s = 0, which a delta light does not have
 * vertex_lens: the z_0 of a point of the lens. */
void vertex_light(const struct scene *scene, const struct light_point *at, rgb beta, double n_s0, struct vertex *out);
void vertex_lens(const struct camera *camera, vec3 p, rgb beta, struct vertex *out);

/* vertex_light_point: the point of a y_0, or where an eye sub-path ends on an area light or the sky. Its pdf is the
 * density of y_0 there. */
struct light_point vertex_light_point(const struct scene *scene, const struct vertex *v);

/* vertex_at_infinity: y_0 of an infinite or distant light. */
static inline bool vertex_at_infinity(const struct scene *scene, const struct vertex *v)
{
    return v->kind == VERTEX_LIGHT && light_at_infinity(&scene->lights.light[v->light]);
}

/* vertex_connectible: may a connection end at this vertex? */
static inline bool vertex_connectible(const struct vertex *v)
{
    return v->kind == VERTEX_SURFACE ? v->bsdf.n_smooth > 0 : v->kind != VERTEX_ESCAPED;
}

/* vertex_medium: the medium into which direction w leads. */
static inline int vertex_medium(const struct scene *scene, const struct vertex *v, vec3 w)
{
    return scene->space == NULL ? 0 : medium_towards(scene->space, v->prim_id, v->ng, w, v->medium);
}

/* vertex_cosine: the factor that turns a density per area perpendicular to the unit vector w into one per area of the
 * vertex' surface: |cos(w, ng)|; 1 without ng. */
static inline double vertex_cosine(const struct vertex *v, vec3 w)
{
    return length2(v->ng) > 0 ? abs_dot(v->ng, w) : 1;
}

/* vertex_side: the normal that decides the region of a surface point: ng, on the side where its walk came from; 0
 * within a medium. The other walk through the same points comes from the other neighbour. It must find the same region,
 * or the two would count differently in the weights. If no lobe transmits, both neighbours lie on the same side of ng
 * (bsdf.h). Otherwise ng stays as it is. (Delta lobes may transmit, since nothing is connected there.) */
static inline vec3 vertex_side(const struct vertex *v)
{
    return v->bsdf.transmits || dot(v->ng, v->wo) >= 0 ? v->ng : neg(v->ng);
}

/* scatter_cosine: the factor by which a BSDF's f is multiplied when a walk leaves v in direction wi. For a walk from
 * the eye it is |cos(wi, ns)|. For a walk from a light, the adjoint BSDF of shading normals makes it
 * |cos(wo, ns)| |cos(wi, ng)| / |cos(wo, ng)|.                                                         [V97 5.3] */
static inline double scatter_cosine(const struct vertex *v, vec3 wi, enum transport mode)
{
    vec3 ns = v->bsdf.shading.n;
    if (v->kind == VERTEX_MEDIUM)
        return 1;
    if (mode == RADIANCE)
        return abs_dot(wi, ns);
    double wo_ng = abs_dot(v->wo, v->ng);
    return wo_ng > 0 ? abs_dot(v->wo, ns) * abs_dot(wi, v->ng) / wo_ng : 0;
}

#endif
