/* camera.h: pbrt's perspective camera, pinhole or thin lens, with its importance.
 *
 * Raster coordinates: (0,0) is the upper left corner of the film, pixel (i,j) covers [i,i+1) x [j,j+1).
 * Importance convention: a pixel's value is the integral over the raster of h(p) L(p) (filter.h), so the density of
 * eye rays is 1 per unit of raster area, that is J(w) per steradian; We = h J / (lens area cos) [PBRT3 16.1.1]. Nothing
 * here depends on crop or on the number of samples.
 *
 * Tests: test_camera.c.
 */
#ifndef ASBDPT_CAMERA_H
#define ASBDPT_CAMERA_H

#include <stdbool.h>

#include "geometry/shape.h"
#include "base/transform.h"
#include "base/vec.h"

struct camera {
    /* as the scene file has it */
    struct transform world_to_camera;
    double fov;                /* degrees, along the shorter side of the screen window */
    double frame_aspect_ratio; /* 0: width / height of the film */
    bool has_screen_window;
    double screen_window[4]; /* xmin, xmax, ymin, ymax; valid if has_screen_window */
    double lens_radius;      /* 0: pinhole */
    double focal_distance;   /* to the plane of focus, > 0 */
    /* filled by camera_prepare */
    struct transform camera_to_world;
    int width, height;              /* of the full film */
    double x_scale, y_scale;        /* screen units per raster unit at camera z = 1; y_scale < 0 */
    double x_origin, y_origin;      /* screen position at z = 1 of raster (0,0) */
    double pixel_area;              /* at z = 1: |x_scale y_scale| */
    vec3 position, forward;         /* world; forward is the unit view direction */
};

/* camera_default: fov 90, pinhole, focal distance 1e6, identity transform. */
struct camera camera_default(void);

/* camera_prepare: derive the rest for a film of width x height pixels. */
void camera_prepare(struct camera *c, int width, int height);

/* camera_is_usable: once prepared: can rays start at it and tell their pixels apart? */
bool camera_is_usable(const struct camera *c);

/* camera_ray: the ray through raster point (px,py) and lens point from (u1,u2); unit direction, tmin = 0,
 * tmax = infinity. */
struct ray camera_ray(const struct camera *c, double px, double py, double u1, double u2);

/* camera_sample_lens: a lens point in world space, uniform by area (the pinhole itself without a lens). */
vec3 camera_sample_lens(const struct camera *c, double u1, double u2);

/* camera_project: the raster point that a ray from lens point `lens` in unit direction w (away from the camera)
 * belongs to.
 *   px, py  out: raster coordinates, possibly outside the film
 * Returns J(w), raster area per steradian, > 0, or 0 when w points backwards. */
double camera_project(const struct camera *c, vec3 lens, vec3 w, double *px, double *py);

#endif
