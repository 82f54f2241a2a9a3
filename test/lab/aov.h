/* aov.h: what the camera sees first, as pictures (arbitrary output variables): for denoisers and for readers.
 *
 *   albedo    the share of light from everywhere that the surface sends on towards the camera, by reflection and
 *             transmission, in [0,1]: pbrt-v4's "Albedo"
 *   normal    the shading normal in world space, bump mapping included, turned towards the camera
 *   depth     distance along the camera's axis (z in camera space), the same in all channels
 *   position  in the world of the scene file
 *   variance  of the rendered pixel itself; see planes.h
 *
 * The first four are means over the first AOV_SAMPLES samples of a pixel, if the render has so many, through the very
 * points of pixel and lens that it draws, so that their edges are smooth where the picture's are. Depth and position
 * are means over those that hit something. Where nothing is hit all are 0.
 *
 * Denoisers want albedo and normal to show what the picture does, in mirrors and behind glass, too. On request these
 * are those of the first surface on the eye sub-path that does not only mirror and refract, or else of the last that it
 * meets; the albedo times what the way there leaves of light. Glass lets chance choose the way: so there are
 * up to AOV_SEEN_SAMPLES then.
 *
 * Tests: test_aov.c.
 */
#ifndef ASBDPT_LAB_AOV_H
#define ASBDPT_LAB_AOV_H

#include "render/render.h"

enum aov { AOV_ALBEDO, AOV_NORMAL, AOV_DEPTH, AOV_POSITION, N_FIRST_HIT, AOV_VARIANCE = N_FIRST_HIT, N_AOVS };
enum { AOV_SAMPLES = 64, AOV_SEEN_SAMPLES = 256, AOV_SEEN_DEPTH = 12 /* surfaces looked for */ };

/* aov_name: for options and file names. */
const char *aov_name(enum aov which);

/* aov_render: the first-hit pictures.
 *   scene    prepared
 *   options  of the render: its seed, its threads, the samples [0, end), at least 1, and its progress, told after
 *            each row; CANCEL_BLOCK ends it as soon as every pixel has a sample, CANCEL_NOW at once
 *   seen     albedo and normal of what is seen in mirrors and through glass
 *   out      [N_FIRST_HIT] pictures of render_crop's size, each [height*width*3], black
 * Returns false if there are pixels without a sample, which stay black. The same numbers for any number of threads. */
bool aov_render(const struct scene *scene, const struct render_job *options, bool seen,
                float *const out[N_FIRST_HIT]);

#endif
