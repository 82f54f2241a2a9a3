/* strays.h: do the media of a scene fit together? */
#ifndef ASBDPT_STRAYS_H
#define ASBDPT_STRAYS_H

#include "scene/scene.h"

enum { STRAYS_PATHS = 1024 };

/* strays_count: of so many eye sub-paths, and light sub-paths, of a prepared scene those that somewhere come to a
 * surface from another medium than is said to be before it, or to lights at infinity from any. */
int strays_count(const struct scene *scene);

#endif
