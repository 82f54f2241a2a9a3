/* lamp.h: a point drawn on a light, as a vertex sees it: what strategies begin with that join vertices to lights in
 * ways of their own.
 *
 * Tests: test_caustic.c, test_rival_parts.c, test_rivals.c.
 */
#ifndef CAUSTICS_LAMP_H
#define CAUSTICS_LAMP_H

#include "base/sampler.h"
#include "transport/connect.h"

/* lamp_point: a light point, its cell chosen by power, by three uniform numbers. False if there is no light, or nothing
 * is emitted there. lamp_draw: the same with numbers of the sampler. */
bool lamp_point(const struct light_set *lights, const struct geometry *geo, const double u[3], struct light_point *out);
bool lamp_draw(const struct scene *scene, struct sampler *sampler, struct light_point *out);

/* lamp_connect: connect_s1 for a point that is known, found with that density. */
struct connection lamp_connect(const struct scene *scene, const struct counts *counts, const struct vertex *z,
                               const struct light_point *at, double pdf);

/* The way from a point of the scene to one on a light. */
struct lamp_way {
    vec3 w;    /* unit */
    double d2; /* distance squared, by which densities per area differ from those of directions; at infinity 1 */
};
struct lamp_way lamp_way(const struct scene *scene, vec3 p, const struct light_point *at);

/* lamp_seen: does light from there come to a point of a primitive? */
bool lamp_seen(const struct scene *scene, vec3 p, uint64_t prim_id, const struct light_point *at);

#endif
