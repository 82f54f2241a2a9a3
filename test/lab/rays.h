/* rays.h: incoherent rays of a scene, by which traversal is timed (bench, test/measure/peers/embree.c):
 * cosine-distributed directions from points all over the scene, found by following a camera ray one bounce.
 */
#ifndef ASBDPT_LAB_RAYS_H
#define ASBDPT_LAB_RAYS_H

#include "scene/scene.h"

enum { N_RAYS = 1 << 17 };

/* bench_rays: fill out[N_RAYS], the same rays for every film of the same framing. Returns how many there are: fewer if
 * the camera sees hardly anything. */
int bench_rays(const struct scene *s, struct ray *out);

#endif
