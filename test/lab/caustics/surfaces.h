/* surfaces.h: the `check` of methods (method.h) that know of surfaces alone, not of media (scene/medium.h). */
#ifndef ASBDPT_SURFACES_H
#define ASBDPT_SURFACES_H

#include "integrators/method.h"

bool surfaces_alone(const struct prepared *p, const struct scene *scene, struct error *err);

#endif
