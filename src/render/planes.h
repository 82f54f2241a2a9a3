/* planes.h: what films have beside the picture (scene/tile.h), by an observer: groups of lights, and alpha.
 *
 * Tests: test_lights.c.
 */
#ifndef ASBDPT_PLANES_H
#define ASBDPT_PLANES_H

#include "transport/observer.h"
#include "scene/tile.h"

/* planes_observer: what adds to the tile of a sample the planes that it has; all NULL if there are none. */
struct observer planes_observer(struct planes planes);

#endif
