/* learn.h: look at a scene before it is rendered, and keep what was found (tables.h).
 *
 * The contract. A fixed number of sub-paths is traced, LEARN_PER_PIXEL for each pixel of the picture between
 * LEARN_LEAST and LEARN_MOST eye sub-paths and at most as many light sub-paths, whatever number of samples is asked
 * for: a picture that is continued, or made in parts, is made by one and the same estimator. Memory is bounded: 1024
 * eye regions and 2048 light regions, 64 MiB while learning and a quarter of that after it. job->watch sees it go on
 * and may end it: then there is what was found so far, which is a valid, if poor, thing to have learnt. Tables are not
 * stored: every render learns them anew.
 *
 * Passes, each over sub-paths of its own, are in training.h.
 *
 * Tests: test_asbdpt.c (same result for any number of threads, unbiased renders), test_learning.c.
 */
#ifndef ASBDPT_LEARN_H
#define ASBDPT_LEARN_H

#include "tables/tables.h"
#include "transport/tile_pass.h"

/* What is to be learnt. Light vertices are counted in any case. */
struct learn_options {
    bool importance, guide, pairs;
    double emission; /* delta of emission, which needs importance; 1: it is not to be learnt */
    int eye_cells, light_cells; /* regions along the diagonal of where vertices are */
    int levels;                 /* of regions */
    double delta;               /* of the pairs, and of what guides their trials */
};

/* learn: the tables; tables_free releases them. */
struct tables learn(const struct render_job *job, const struct learn_options *options);

#endif
