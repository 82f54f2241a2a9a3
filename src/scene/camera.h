/* camera.h: pbrt's perspective (pinhole or thin lens), orthographic and environment cameras, with their importance.
 *
 * Raster coordinates: (0,0) is the upper left corner of the film, pixel (i,j) covers [i,i+1) x [j,j+1).
 * Importance convention: a pixel's value is the integral over the raster of h(p) L(p) (filter.h), so the density of
 * eye rays is 1 per unit of raster area, that is J(w) per steradian; We = h J / (lens area cos) [PBRT3 16.1.1]. Nothing
 * here depends on crop or on the number of samples.
 *
 * An orthographic camera sees along one direction from everywhere on its plane: like a distant light's, its rays do not
 * spread. Eye rays have density J per area across them, and a point is joined to the lens at its projection on the
 * plane. With a lens, pbrt-v3's starts all rays on the disk around its origin: it is then a perspective camera, and so
 * it is here.
 *
 * An environment camera sees all directions from a point; x is the azimuth, y the angle from its pole. Beyond the edges
 * of the film, where filters reach, it goes on around the sphere, so that a direction has many raster points.
 *
 * Tests: test_camera.c.
 */
#ifndef ASBDPT_CAMERA_H
#define ASBDPT_CAMERA_H

#include <stdbool.h>

#include "base/transform.h"
#include "base/vec.h"
#include "geometry/shape.h"

enum camera_kind { CAMERA_PERSPECTIVE, CAMERA_ORTHOGRAPHIC, CAMERA_ENVIRONMENT };

struct camera {
    enum camera_kind kind;
    /* as the scene file has it */
    struct transform world_to_camera;
    double fov;                /* degrees, along the shorter side of the screen window */
    double frame_aspect_ratio; /* 0: width / height of the film */
    bool has_screen_window;
    double screen_window[4]; /* xmin, xmax, ymin, ymax; valid if has_screen_window */
    double lens_radius;      /* 0: pinhole */
    double focal_distance;   /* to the plane of focus, > 0 */
    int medium;              /* that the lens is in */
    /* filled by camera_prepare */
    struct transform camera_to_world;
    int width, height;              /* of the full film */
    bool parallel;                  /* all rays run along `forward`: orthographic, without a lens */
    double x_scale, y_scale;        /* screen units per raster unit at camera z = 1 (parallel: 0); y_scale < 0.
                                     * environment: radians per raster unit */
    double x_origin, y_origin;      /* screen position of raster (0,0), in the same units */
    double pixel_volume;            /* |x_scale y_scale| times the volume that camera_to_world makes of 1 */
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

/* camera_sample_lens: the lens point, in world space, that point p is joined to: uniform by area; the pinhole itself
 * without a lens; on the plane of a parallel camera. */
vec3 camera_sample_lens(const struct camera *c, vec3 p, double u1, double u2);

/* camera_falloff: what turns J into raster area per area across w at distance^2 d2. */
static inline double camera_falloff(const struct camera *c, double d2) { return c->parallel ? 1 : 1 / d2; }

/* camera_project: the raster point that a ray from lens point `lens` in unit direction w (away from the camera)
 * belongs to.
 *   px, py  out: raster coordinates, possibly outside the film
 * Returns J(w), raster area per steradian (parallel: per m^2 across w), > 0, or 0 when w points backwards. */
double camera_project(const struct camera *c, vec3 lens, vec3 w, double *px, double *py);

/* camera_images: how many raster points camera_image can give for a filter of these radii; all that are the same ray
 * and that the filter of a pixel reaches are among them, once.
 * camera_image: number i of them for the one that camera_project gave, which is replaced. */
int camera_images(const struct camera *c, const double radius[2]);
void camera_image(const struct camera *c, const double radius[2], int i, double *px, double *py);

#endif
