/* plan_scene.h: the scenes of a plan as they are rendered: whole, with a box filter, at the plan's size.
 *
 * Tests: test_report.c.
 */
#ifndef ASBDPT_PLAN_SCENE_H
#define ASBDPT_PLAN_SCENE_H

#include "lab/plan.h"
#include "scene/scene.h"

/* plan_scene_name: the file's name without .pbrt; for .../NAME/scene.pbrt the directory's. At most size - 1
 * bytes. */
void plan_scene_name(const char *path, char *out, int size);

/* plan_scene_load: read a scene and prepare it. Where the plan leaves the width open, size and depth are those of the
 * stored reference; without one it is WIDTH_WITHOUT_REFERENCE wide.
 *   name   what its reference is called
 *   depth  out, the maxdepth in force
 * Returns false with a message, then nothing needs release. */
enum { WIDTH_WITHOUT_REFERENCE = 48 };
bool plan_scene_load(const struct plan *p, const char *path, const char *name, struct scene *scene, int *depth,
                     struct error *err);

#endif
