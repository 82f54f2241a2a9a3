/* plan_scene.h: the scenes of a plan as they are rendered, and their stored references.
 *
 * Tests: test_plan.c.
 */
#ifndef ASBDPT_PLAN_SCENE_H
#define ASBDPT_PLAN_SCENE_H

#include "lab/plan.h"
#include "lab/reference.h"
#include "scene/scene.h"

/* plan_scene_name: the file's name without .pbrt; for .../NAME/scene.pbrt the directory's. At most size - 1
 * bytes. */
enum { PLAN_NAME = 60 }; /* with two methods it names files, whose names have 255 bytes at most */
void plan_scene_name(const char *path, char *out, int size);

/* plan_scene_read: read a scene as experiments render it, whole and with a box filter, and prepare it.
 *   width      0: the film's own, or WIDTH_WITHOUT_REFERENCE if that is less
 *   height     0: by the scene's aspect ratio
 *   max_depth  0: the scene's; *depth is the one in force
 * Returns false with a message, then nothing needs release. */
enum { WIDTH_WITHOUT_REFERENCE = 160, WIDTH_TO_SEE = 96 };
bool plan_scene_read(const char *path, int width, int height, int max_depth, struct scene *scene, int *depth,
                     struct error *err);

/* plan_scene_load: the same at the plan's size and depth, with its stored reference. Where the plan leaves the width
 * open, size and depth are the reference's; without one the width is 0, with a warning. What is found next to the scene
 * is taken only if it says that it is of this scene, size and depth; if it is narrower than WIDTH_TO_SEE and the plan
 * leaves the width open, pictures are that wide, without a reference.
 *   name    what the reference is called
 *   stored  out, to be given to reference_free; its pixels are NULL where there is none, or none that fits
 * Returns false with a message, also when a reference was given that cannot be used; then the scene is not to be
 * released. */
bool plan_scene_load(const struct plan *p, const char *path, const char *name, struct scene *scene, int *depth,
                     struct reference *stored, struct error *err);

/* plan_names_differ: no two scenes of the plan have the same name, under which their results are kept. False with a
 * message. */
bool plan_names_differ(const struct plan *p, struct error *err);

#endif
