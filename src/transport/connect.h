/* connect.h: the contribution of one strategy (s,t): a light sub-path of s vertices joined to an eye sub-path of t.
 *
 *   s = 0           the eye sub-path's last vertex is itself on a light        connect_hit
 *   s = 1, t >= 2   joined to a new point on a light                           connect_direct
 *   s >= 2, t >= 2  two vertices joined                                        connect_pair
 *   s >= 2, t = 1   joined to a new point on the lens                          connect_lens
 *
 * A connection's value is the unweighted contribution C* of [V97 10.2]: the product of throughputs, both BSDFs,
 * geometry factor and visibility, for *one* sample of its strategy [PBRT3 16.3.3]. Its weight is that of the heuristic
 * (mis.h).
 *
 * Tests: test_mis.c.
 */
#ifndef ASBDPT_CONNECT_H
#define ASBDPT_CONNECT_H

#include "base/rgb.h"
#include "transport/path.h"

struct connection {
    rgb value;     /* W/(sr m^2), a pixel's radiance; black if the vertices cannot see each other */
    double weight; /* [0,1]; meaningless when value is black */
    double px, py; /* connect_lens: a raster point where it arrives, see camera_images */
    int light;     /* connect_hit, connect_direct: number of the light */
};

/* connect_hit: z is the last of t >= 2 eye vertices, and prev is z_{t-2}. If the last edge passes a see-through light,
 * that light takes the place of z. A light that the camera sees directly (t = 2) has weight 1, since no other strategy
 * makes paths of two vertices. */
struct connection connect_hit(const struct scene *scene, const struct counts *counts, const struct vertex *prev,
                              const struct vertex *z, int t);

/* connect_direct: z is an eye vertex, t >= 2. The light point is drawn with `sampler`, as number i of n points whose
 * lights are stratified: of two points on a light of two triangles, each triangle has one.
 *   y0  out: the point; its light is -1 if there is none */
struct connection connect_direct(const struct scene *scene, const struct counts *counts, const struct vertex *z,
                                 struct sampler *sampler, int i, int n, struct light_point *y0);

/* connect_pair: y is a light vertex (s >= 2), z an eye vertex (t >= 2). */
struct connection connect_pair(const struct scene *scene, const struct counts *counts, const struct vertex *y,
                               const struct vertex *z);

/* connect_lens: connects light[s-1], the last of s >= 2 vertices of a light sub-path, to a lens point that is drawn
 * with `sampler`. The value is for the whole film: tile_add_splat distributes it over pixels, and the caller divides it
 * by counts->lens. */
struct connection connect_lens(const struct scene *scene, const struct counts *counts, const struct vertex *light,
                               int s, struct sampler *sampler);

/* --- in two steps ------------------------------------------------------------------------------------ */

/* connect_direct and connect_pair consist of these steps. Methods that compare many connections and trace few shadow
 * rays take them one by one. `value` is C* without visibility. */
struct lit {
    const struct vertex *z;
    struct light_point at;
    double pdf; /* density of the point */
    rgb value;
    double pdf_z, pdf_rev_z; /* 1/sr, at z: of the direction to the light; of the reverse move to the vertex before z */
    double at_light; /* factor that turns the density of the direction into that of the point */
    vec3 w;          /* unit, from z to the point */
    double distance, spread; /* distance of the point and 1/distance^2; at infinity: infinite and 1 */
};

struct joint {
    const struct vertex *y, *z;
    rgb value;
    double pdf_y, pdf_z;         /* 1/sr, at y and at z, of the direction to the other */
    double pdf_rev_y, pdf_rev_z; /* 1/sr, of the reverse move from there to the vertex before */
    double length;               /* of the edge */
    vec3 w;                      /* its direction, unit, from z to y */
    double area_y, area_z;       /* factor that turns a density per steradian at the other end into one per area */
};

/* connect_light_draw: draw a light point for z; *pdf is its density. False if there is none.
 * connect_light: the first step, to a point that was drawn with density `pdf`. False if no light can arrive; out->value
 * is black then.
 * connect_lit: the second step: visibility and weight. */
bool connect_light_draw(const struct scene *scene, const struct counts *counts, const struct vertex *z,
                        struct sampler *sampler, int i, int n, struct light_point *at, double *pdf);
bool connect_light(const struct scene *scene, const struct vertex *z, const struct light_point *at, double pdf,
                   struct lit *out);
struct connection connect_lit(const struct scene *scene, const struct counts *counts, const struct lit *l);

/* connect_join: the first step. False if no light can arrive; out->value is black then.
 * connect_joint: the second step: visibility and weight. */
bool connect_join(const struct vertex *y, const struct vertex *z, struct joint *out);
struct connection connect_joint(const struct scene *scene, const struct counts *counts, const struct joint *j);

#endif
