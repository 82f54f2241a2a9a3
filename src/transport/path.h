/* path.h: sub-paths, and the one random walk that makes both kinds.
 *
 * An eye sub-path z_0 z_1 ... starts on the lens, a light sub-path y_0 y_1 ... on a light. Each vertex carries what a
 * connection ending there needs: its throughput, its scattering function and its part of the MIS weight (mis.h).
 * Vertices are read-only once walked, so any number of connections may share them.
 *
 * The throughput beta of a vertex is the product of the factors of the measurement up to the *arrival* at the vertex,
 * divided by the density of having sampled it, alpha of [V97 eq. 10.6] [V97 eq. 10.7]; the vertex' own BSDF is not in
 * it.
 *
 * From their second bounce on, walks end early by Russian roulette where little throughput is left: a walk that has
 * kept the fraction r of its first throughput survives with probability sqrt(r / rr_threshold), and its throughput is
 * divided by that [Arvo & Kirk 1990]. The probability depends on all of the walk, so no other strategy could know it
 * for the same path, and MIS leaves it out: any weights that add up to 1 are unbiased, and these are close to the best
 * as long as roulette is mild. The square root is milder than the usual probability r / rr_threshold: a weak sub-path
 * still meets many others.
 *
 * Tests: test_mis.c, test_render.c.
 */
#ifndef ASBDPT_PATH_H
#define ASBDPT_PATH_H

#include "material/bsdf.h"
#include "scene/light.h"
#include "base/mem.h"
#include "transport/mis.h"
#include "base/sampler.h"
#include "scene/scene.h"

enum { PATH_MAX_DEPTH = 1000 }; /* largest maxdepth accepted */

enum vertex_kind {
    VERTEX_LENS,    /* z_0 */
    VERTEX_LIGHT,   /* y_0 */
    VERTEX_SURFACE, /* a scattering point, possibly on an area light */
    VERTEX_ESCAPED  /* end of an eye sub-path that left the scene: a direction, where infinite lights are or a `lamp` */
};

/* What the fields mean depends on the kind; a dash: not used. Densities are those of the vertex in its own walk, per
 * area unless it is a direction: where light comes from infinity, per solid angle.
 *
 *                LENS         LIGHT (y_0)                       SURFACE                      ESCAPED
 *   light, cell  -1           its light and light cell          of the area light, or -1     -1
 *   p            on the lens  on the light; at infinity -       the point                    -
 *   ng           0            area light: its normal; else 0    geometric normal             0
 *   prim_id      0            area light: see shape.h; else 0   see shape.h                  0
 *   wo           0            at infinity: towards the light    towards the previous vertex  inwards
 *   beta         1            radiance or intensity emitted;    throughput on arrival        throughput on arrival
 *                             as a connection's end 1/density
 *   pdf_fwd      1, unused    1/m^2; at infinity 1/sr           1/m^2                        1/sr
 *   pdf_origin   -            -                                 eye walk, on a light: of     1/sr, likewise
 *                                                               light_sample_point, 1/m^2
 *   pdf_rev      -            -                                 1/sr: of the other walk's    -
 *                                                               going back, if this went on
 *   regions      -            -                                 as count_model.locate says    -
 *   bsdf         -            -                                 its scattering               -
 *   lamp         -            -                                 eye walk: see below              likewise
 *
 * See-through lamps (scene.h) scatter nothing, so no walk has vertices there, but that one may start on them. The first
 * that an eye walk meets on its way from one vertex to the next is the `lamp` of the next: the last vertex of a path of
 * its own, and in no sub-path. Its kind is SURFACE, it has what connect_hit needs, and no scattering.
 */
struct vertex {
    enum vertex_kind kind;
    bool prev_delta; /* the walk left the previous vertex by a delta lobe */
    enum eye_end eye_end;
    int light, cell;
    vec3 p, ng;
    uint32_t prim_id;
    vec3 wo; /* unit */
    rgb beta;
    double pdf_fwd, pdf_origin, pdf_rev;
    int material; /* of the surface, index into scene->material */
    double mis;   /* mis_e of mis.h */
    double mis_c; /* c_e of mis.h, supposing this vertex is not left by a delta lobe */
    int eye_region, light_region;
    struct bsdf bsdf;
    const struct vertex *lamp; /* above; NULL: none */
};

/* What a walk needs besides its start. */
struct walk {
    const struct scene *scene;
    const struct mis_counts *counts;
    struct arena *arena; /* holds the lobes of the vertices */
    struct sampler *sampler;
    double rr_threshold; /* relative throughput below which Russian roulette begins; 0: never */
};

/* path_eye: walk from the lens through raster point (px,py).
 *   path  out, [max_vertices]
 * Returns the number of vertices, 1 <= n <= max_vertices. */
int path_eye(const struct walk *w, double px, double py, struct vertex *path, int max_vertices);

/* path_eye_pixel: the same through a point drawn from the filter of pixel (x,y); *filter_weight is what the pixel's
 * estimate is to be multiplied by (filter.h). */
int path_eye_pixel(const struct walk *w, int x, int y, struct vertex *path, int max_vertices,
                   double *filter_weight);

/* path_light: choose a light, emit, and walk. Returns the number of vertices; 0 when nothing is emitted. */
int path_light(const struct walk *w, struct vertex *path, int max_vertices);

/* path_throughput: beta of [S24]: mean over RGB at the furthest vertex of a light sub-path; 0 if it is empty. One of y_0
 * alone, which met no surface, has the emitted radiance there, as in pbrt-v3, where [S24] was implemented. */
static inline double path_throughput(const struct vertex *light, int n)
{
    return n < 1 ? 0 : rgb_mean(light[n - 1].beta);
}

/* vertex_light_end: fill in a y_0 for a point drawn by light_sample_point; its beta is 1/density. */
void vertex_light_end(const struct scene *scene, const struct mis_counts *counts, const struct light_point *at,
                      struct vertex *out);

/* vertex_light_point: the light_point of a y_0, or of a surface on an area light. */
struct light_point vertex_light_point(const struct vertex *v);

/* vertex_at_infinity: y_0 of an infinite or distant light. */
bool vertex_at_infinity(const struct scene *scene, const struct vertex *v);

/* vertex_connectible: can a connection end at this vertex? */
static inline bool vertex_connectible(const struct vertex *v)
{
    return v->kind == VERTEX_SURFACE ? v->bsdf.n_smooth > 0 : v->kind != VERTEX_ESCAPED;
}

/* scatter_cosine: the factor that turns a BSDF's f into throughput for leaving v in direction wi. Walking from the eye
 * it is |cos(wi, ns)|; from a light the adjoint BSDF of shading normals makes it
 * |cos(wo, ns)| |cos(wi, ng)| / |cos(wo, ng)|                                                          [V97 5.3] */
double scatter_cosine(const struct vertex *v, vec3 wi, enum transport mode);

#endif
