/* derived.h: what follows from the vertices of a path, and the renderer does not keep: its length, where on the lens it
 * ends, where mirrors and smooth glass send what comes, and the densities of the other walk.
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
#include "transport/vertex.h"

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

/* bsdf_delta: what the delta lobes send to one side: in the direction of the mirror, or of refraction. As bsdf_sample
 * returns it, but that f is the coefficient of the delta itself, of all lobes with that direction.
 * Returns false if there are none, or nothing is sent. */
bool bsdf_delta(const struct bsdf *b, vec3 wo, bool transmit, enum transport mode, struct bsdf_sample *out);

/* vertex_pdf_rev: density, 1/sr, with which a walk that comes from the next vertex of a sub-path would leave v for the
 * vertex before it. If a delta lobe sent the walk on, that is relative to the walk's own density, as mis.h needs it.
 *   mode  of the sub-path */
double vertex_pdf_rev(const struct vertex *v, const struct vertex *next, enum transport mode);

#endif
