/* learn.h: learn tables about a scene before it is rendered (tables.h).
 *
 * The way of each number from a sample to a weight; functions without a file are in learn.c, in this order:
 *
 *   table (tables.h)  sample, a lesson       sums        table               drawn by               in the weights
 *   use               trace_uses: VISIT      take        as it is            select_pool, vertices  -
 *   direct            trace_uses: GUIDE     take        build_guide        connect.c: light_draw  counts.h: n_s1
 *   emission          trace_light_path: RAY  take        learn_light_paths   emission_sample        emission_pdf
 *   vertices          SUBPATH_VERTEX         count_light_vertices            -                      base of pairs
 *   pairs             trace_trials: TRIAL    take        learn_pairs         asbdpt.c: draw         counts.h: n_pair
 *
 * There are three rounds. Each needs what the ones before have learnt: the worth of a ray needs `use`, and trials need
 * light sub-paths that leave by `emission`.
 *
 * Learning traces a fixed number of eye sub-paths: LEARN_PER_PIXEL for each pixel of the image, but at least
 * LEARN_LEAST and at most LEARN_MOST. If only `direct` is learnt, or if `few` are asked for, it traces one for
 * FEW_PIXELS pixels, but at least FEW_LEAST: then it takes the time of half a sample of each pixel. It traces as
 * many light sub-paths, but at most LEARN_LIGHT. For trial connections it traces more of them, and uses half of the eye
 * sub-paths. The number does not depend on the number of samples, so an image that is continued or rendered in parts
 * has one estimator. Memory is bounded by REGIONS. Learning ends early if the job is cancelled. Then the tables have
 * fewer sub-paths, which is valid but noisier. Tables are not stored: every render learns them again.
 *
 * Tests: test_asbdpt.c (same result for any number of threads, unbiased renders), test_learning.c.
 */
#ifndef ASBDPT_LEARN_H
#define ASBDPT_LEARN_H

#include "transport/tile_pass.h"

enum { LEARN_PER_PIXEL = 4, LEARN_LEAST = 2 * 1024, LEARN_MOST = 48 * 1024, LEARN_LIGHT = 16 * 1024 };
enum { FEW_PIXELS = 4, FEW_LEAST = 1024 };
enum { REGIONS = 1536, REGION_CUBES = 8 }; /* at most so many; along the diagonal of the box of eye vertices */

/* What to learn. */
struct learn_options {
    bool use, guide, pairs; /* of struct tables */
    bool count;              /* its light_vertices; with `use` they are counted, too */
    bool few;                /* by as few sub-paths as `direct` alone */
    double emission;         /* delta of the table of emission, which needs `use`; 1: do not learn it */
    double delta;            /* of the table of pairs */
};

/* learn: fill *out, which is empty; tables_free releases it. */
void learn(const struct render_job *job, const struct learn_options *options, struct tables *out);

#endif
