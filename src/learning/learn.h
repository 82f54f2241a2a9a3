/* learn.h: learn tables about a scene before it is rendered (tables.h).
 *
 * Learning traces a fixed number of eye sub-paths: LEARN_PER_PIXEL for each pixel of the image, but at least
 * LEARN_LEAST and at most LEARN_MOST. It traces as many light sub-paths, but at most LEARN_LIGHT. The number does not
 * depend on the number of samples, so an image that is continued or rendered in parts has one estimator. Memory is
 * bounded: 1024 eye regions and 2048 light regions, 64 MiB while learning and a quarter of that afterwards. job->watch
 * may end learning early. Then the tables have fewer sub-paths, which is valid but noisier. Tables are not stored:
 * every render learns them again.
 *
 * The passes are in training.h. Each has its own sub-paths.
 *
 * Tests: test_asbdpt.c (same result for any number of threads, unbiased renders), test_learning.c.
 */
#ifndef ASBDPT_LEARN_H
#define ASBDPT_LEARN_H

#include "tables/tables.h"
#include "transport/tile_pass.h"

enum { LEARN_PER_PIXEL = 4, LEARN_LEAST = 2 * 1024, LEARN_MOST = 48 * 1024, LEARN_LIGHT = 16 * 1024 };

/* What to learn. Light vertices are always counted. */
struct learn_options {
    bool importance, guide, pairs;
    double emission; /* delta of emission, which needs importance; 1: do not learn it */
    int eye_cells, light_cells; /* number of regions along the diagonal of the box of vertices */
    int levels;                 /* of regions */
    double delta;               /* of the pairs, and of the choice of their trials */
};

/* learn: the tables; tables_free releases them. */
struct tables learn(const struct render_job *job, const struct learn_options *options);

#endif
