/* connect.h: the contribution of one strategy (s,t): a light sub-path of s vertices joined to an eye sub-path of t.
 *
 *   s = 0    the eye sub-path's last vertex is itself on a light       connect_s0
 *   s >= 1   light vertex y_{s-1} and eye vertex z_{t-1} are joined    connect_vertices
 *
 * Two kinds of ends belong to no walk. If s = 1, connect_s1 draws y_0 for the other end. If t = 1, connect_lens
 * draws z_0. Strategy (1,1) is left to (0,2).
 *
 * A connection's value is the unweighted contribution C* of [V97 10.2]: the product of throughputs, both scattering
 * factors, geometry factor and visibility, for *one* sample of its strategy [PBRT3 16.3.3]. Its weight is that of the
 * balance heuristic (mis.h).
 *
 * Tests: test_mis.c, test_steps.c.
 */
#ifndef ASBDPT_CONNECT_H
#define ASBDPT_CONNECT_H

#include "transport/path.h"

struct connection {
    rgb value;     /* W/(sr m^2), a pixel's radiance; black if the vertices cannot see each other */
    double weight; /* [0,1]; meaningless when value is black */
    int light;     /* s <= 1: number of the light, unless value is black */
};

/* connect_s0: z is the last of t >= 2 eye vertices, and prev the one before. If the last edge passes a see-through
 * light, that light takes the place of z. A light that the camera sees directly (t = 2) has weight 1, since no other
 * strategy makes paths of two vertices. */
struct connection connect_s0(const struct scene *scene, const struct counts *counts, const struct vertex *prev,
                              const struct vertex *z);

/* connect_vertices: y is a light vertex, z an eye vertex. At most one of them is a drawn end. The vertices of y's walk
 * are in front of it in memory. With the lens the value is for the whole film: its splat is divided by counts->lens. */
struct connection connect_vertices(const struct scene *scene, const struct counts *counts, const struct vertex *y,
                                   const struct vertex *z);

/* connect_s1: draw a point of a light for eye vertex z, and connect it: the vertex y_0, which may send nothing to z. It
 * is number i of n whose lights are stratified: of two points on a light of two triangles, each triangle has one. If no
 * connection can end at z, or there is no light, y->light is -1.
 * light_draw: its first half, for methods with weights of their own. The density of the point is *pdf; 0 where nothing
 * is emitted. False where connect_s1 has no y. */
bool light_draw(const struct scene *scene, const struct counts *counts, const struct vertex *z, struct sampler *sampler,
                int i, int n, struct light_point *at, double *pdf);
struct connection connect_s1(const struct scene *scene, const struct counts *counts, const struct vertex *z,
                                 struct sampler *sampler, int i, int n, struct vertex *y);

/* connect_lens: draw z_0 for light vertex y, and connect both. Black if the camera does not see there.
 *   raster  out: [2] the point at which y arrives, see camera_images
 * lens_point: its first half. False if the camera does not see there. */
bool lens_point(const struct scene *scene, const struct vertex *y, struct sampler *sampler, struct vertex *z,
                double raster[2]);
struct connection connect_lens(const struct scene *scene, const struct counts *counts, const struct vertex *y,
                               struct sampler *sampler, double raster[2]);

#endif
