/* learn.h: learn tables about a scene before it is rendered (tables.h).
 *
 * The way of each number from a sample to a weight. What makes tables is in learn.c:
 *
 *   table      samples                     its lesson     made a table by       drawn by           in the weights
 *   use        trace_eye_path              VISIT          - (a sum)             pool, vertices     -
 *   guide      trace_eye_path              GUIDE          build_guide           light_draw         counts.h: n_s1
 *   emission   trace_light_path            RAY            learn_light_paths     emission_sample    emission_pdf
 *   vertices   trace_light_path            LIGHT_VERTEX   count_light_vertices  -                  base of pairs
 *   pairs      trace_trials                TRIAL          learn_pairs           asbdpt.c: draw     counts.h: n_pair
 *
 * There are three rounds of sub-paths, one for each function of samples. Each round needs what the ones before have
 * learnt: the worth of a ray needs `use`, and trials need light sub-paths that leave by `emission`.
 *
 * The numbers of sub-paths below do not depend on the number of samples, so an image that is continued or rendered in
 * parts has one estimator. Trials have half of the eye sub-paths, and more light sub-paths. Learning ends early if the
 * job is cancelled. Then the tables have fewer samples, which is valid but noisier. Tables are not stored: every render
 * learns them again.
 *
 * Tests: test_asbdpt.c (same result for any number of threads, unbiased renders), test_learning.c.
 */
#ifndef ASBDPT_LEARN_H
#define ASBDPT_LEARN_H

#include "transport/tile_pass.h"

/* Eye sub-paths: for each pixel of the image, at least, and at most. As many light sub-paths, but at most LEARN_LIGHT.
 * If only `guide` is learnt, or `few` are asked for, one eye sub-path for FEW_PIXELS pixels, but at least FEW_LEAST:
 * then learning takes the time of half a sample of each pixel. */
enum { LEARN_PER_PIXEL = 4, LEARN_LEAST = 2 * 1024, LEARN_MOST = 48 * 1024, LEARN_LIGHT = 16 * 1024 };
enum { FEW_PIXELS = 4, FEW_LEAST = 1024 };
enum { REGIONS = 1536, REGION_CUBES = 8 }; /* at most so many; along the diagonal of the box of eye vertices */

/* What to learn. */
struct learn_options {
    bool use, guide, pairs; /* of struct tables */
    bool count;             /* its light_vertices; with `use` they are counted, too */
    bool few;               /* by as few sub-paths as `guide` alone */
    double emission;        /* delta of the table of emission, which needs `use`; 1: do not learn it */
    double delta;           /* of the table of pairs */
};

/* learnt_use: how much the camera can use of vertices [first, end) of a light sub-path: the sum of luminance(beta)
 * times `use` of the place over those that can be connected to. */
double learnt_use(const struct tables *tables, const struct vertex *path, int first, int end);

/* learn: fill *out, which is empty; tables_free releases it. */
void learn(const struct render_job *job, const struct learn_options *options, struct tables *out);

#endif
