/* scene.h: everything a scene file describes; it owns all of it. Objects refer to each other by index.
 *
 * A see-through light is an area light without material. Rays pass it; light obeys one rule:
 *
 *     What lights emit does not pass see-through lights; what surfaces scatter does.
 *
 * So of a path only the segment from its light to the first surface, or to the lens, is stopped by such a light, from
 * its dark side as well. That is a property of the path, whichever strategy makes it: scene_edge asks for s = 1,
 * scene_lamp for eye walks, which collect of each segment the first see-through light, in place of any light behind,
 * and go on, and scene_lamp_stops for light walks, which end at one on their first segment.
 *
 * Tests: test_strategies.c, test_scenes.c.
 */
#ifndef ASBDPT_SCENE_H
#define ASBDPT_SCENE_H

#include <stdbool.h>

#include "base/file.h"
#include "geometry/kdtree.h"
#include "geometry/shape.h"
#include "material/material.h"
#include "material/texture.h"
#include "scene/camera.h"
#include "scene/filter.h"
#include "scene/light.h"
#include "scene/medium.h"
#include "base/settings.h"

struct scene {
    vec3 origin;            /* of world space in the file's coordinates; see scene_set_origin */
    struct geometry geo;
    struct kdtree kd;       /* of the surfaces that have a material */
    struct kdtree kd_lamps; /* of those that have none: the see-through lights */
    struct texture_set textures;
    struct material **material; /* [n_materials], owned with what they point to */
    int n_materials;
    struct fourier_table **table; /* [n_tables] of these materials, owned */
    int n_tables;
    struct arena lobes;         /* of materials that are the same everywhere */
    struct light_set lights;
    struct space *space;        /* its media; owned; NULL: empty */

    struct camera camera;
    struct filter filter;
    int width, height;      /* full film resolution */
    double crop[4];         /* x0 x1 y0 y1 as fractions of the film, pbrt's "cropwindow" */
    double film_scale;      /* every pixel is multiplied by it when written */
    char *film_filename;    /* as written in the file; owned, may be NULL */

    char *integrator;       /* name in the Integrator directive; owned, NULL if there is none */
    struct settings settings; /* its parameters, and those of -P */
    int spp;                /* pixelsamples, 0 if the file does not say */

    char **file;            /* [n_files] paths of all files the scene was read from; owned */
    int n_files;
    uint64_t content;       /* hash of these files */
    long n_warnings;        /* that were given while it was loaded */
    struct budget memory;   /* for it and its film */
};

/* scene_init: an empty scene with pbrt's defaults (1280x720 film, box filter of radius 0.5, fov 90). */
void scene_init(struct scene *s);
void scene_free(struct scene *s);

/* scene_set_origin: put the origin of world space at the camera, to its distance's 2^-20, so that round numbers of the
 * file still are some of floats. Vertices are floats, which are fine about the origin alone: far from that of the file
 * a scene would be rounded to what is another one. Call it once the camera is known, before anything is placed: what
 * has a position in the file goes to that less s->origin. [pbrt-v4 cameras.h, CameraWorld] */
void scene_set_origin(struct scene *s);

/* scene_add_material: append a material, settle and own it; returns its number. */
int scene_add_material(struct scene *s, struct material *m);

/* scene_resize: another size of the film, before it is prepared; height 0: of the same shape, 2^30 at most. */
void scene_resize(struct scene *s, int width, int height);

/* scene_prepare: build the kd-tree, light tables, camera and filter for the final resolution. Call once; from then on
 * the scene stays where it is in memory. */
void scene_prepare(struct scene *s);

/* scene_uniform: a copy of a prepared scene whose lights are chosen uniformly (light_uniform). It shares all else with
 * *s, which must outlive it; scene_uniform_free releases it. */
struct scene *scene_uniform(const struct scene *s);
void scene_uniform_free(struct scene *s);

/* scene_bounds: the box of all surfaces of a prepared scene, see-through lights among them; the origin if there are
 * none. */
void scene_bounds(const struct scene *s, vec3 *lo, vec3 *hi);

/* scene_intersect: first surface along the ray; false if it leaves the scene. */
bool scene_intersect(const struct scene *s, const struct ray *ray, struct surface *out);

/* scene_lamp: first see-through light along an eye walk's ray, before the surface at *end (NULL: however far). One that
 * touches that surface shines before it, as it does for scene_edge, whose segment ends short of the light. A ray from
 * the lens passes those that are hidden from it. */
bool scene_lamp(const struct scene *s, const struct ray *ray, bool from_lens, const struct surface *end,
                struct surface *out);

/* scene_lamp_stops: is there a see-through light along a light's ray before the surface at *end, or another light in
 * the place of this one? One that touches the surface does not count, as it does not for scene_edge, whose segment
 * begins short of the surface. */
bool scene_lamp_stops(const struct scene *s, const struct ray *ray, const struct surface *end);

/* scene_pass: what media do on an edge along a ray, which surfaces leave free.
 *   medium  that it begins in */
static inline void scene_pass(const struct scene *s, const struct ray *ray, int medium, struct edge *out)
{
    *out = EMPTY_EDGE;
    if (s->space != NULL)
        medium_pass(s->space, ray, medium, out);
}

/* scene_edge: the same; false if surfaces stop light that comes from the end of the edge to its start. Those next to
 * either do not count, except another light in the place of the one that emits it.
 *   ray      from its start, as long as it is; tmin and tmax change
 *   emitted  light is emitted at its end, and not scattered */
bool scene_edge(const struct scene *s, struct ray *ray, int medium, bool emitted, struct edge *out);

/* scene_fly: how far does a walk get: to the first surface along the ray, or to where media scatter it before? False if
 * it leaves the scene. */
static inline bool scene_fly(const struct scene *s, const struct ray *ray, int medium, struct sampler *sampler,
                             struct surface *at, struct edge *out)
{
    bool meets = scene_intersect(s, ray, at);
    *out = EMPTY_EDGE;
    return s->space == NULL ? meets : medium_fly(s->space, ray, medium, sampler, meets, at, out);
}

#endif
