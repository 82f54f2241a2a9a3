/* derived.h: what follows from the vertices of a path, and the renderer does not keep: its length, and where on the
 * lens it ends.
 *
 * The length of a path is that from its light to the middle of the lens, in scene units, whichever point of the lens
 * it goes through: light that comes to a focus has come equally far by all of them. Of light from infinity it counts
 * from a plane (light_distance).
 *
 * Tests: test_gates.c, test_trace.c, test_chains.c.
 */
#ifndef CAUSTICS_DERIVED_H
#define CAUSTICS_DERIVED_H

#include "transport/sample.h"

/* light_distance: how far light from infinity has come at p, in scene units; w is the unit direction towards it. It
 * comes from the plane across w that touches the scene's sphere, where light sub-paths of such a light begin, too. 0 if
 * p is beyond the plane, as a lens may be. */
double light_distance(const struct light_set *set, vec3 p, vec3 w);

/* subpath_length: of the n >= 1 vertices of a sub-path, the first being on the lens or on a light.
 * path_length: of a path that was tried; NaN if its eye vertices are not told, or if it has no light point. */
double subpath_length(const struct scene *scene, const struct vertex *path, int n);
double path_length(const struct scene *scene, const struct joined *j);

/* vertex_material: the name of the material of a surface vertex. */
const char *vertex_material(const struct scene *scene, const struct vertex *v);

/* lens_drawn: the point of the lens that connect_lens draws with this sampler for a vertex at p. */
vec3 lens_drawn(const struct camera *camera, vec3 p, struct sampler sampler);

#endif
