/* importance.h: where in space can the camera make use of light?
 *
 * E of a region (regions.h) is the sum of the luminances of the throughputs with which eye sub-paths arrive there:
 * large where many or strong ones pass. A light vertex y is worth about luminance(beta_y) E(region of y).
 *
 * Tests: test_asbdpt.c.
 */
#ifndef ASBDPT_IMPORTANCE_H
#define ASBDPT_IMPORTANCE_H

#include <stddef.h>

struct importance {
    /* [limit of the light regions], owned; NULL: not looked for */
    double *E;
    double *vertices; /* N of pairs.h: connectible vertices of a light sub-path, each in the finest region it lies in */
    /* Means over sub-paths: */
    double light_vertices; /* connectible vertices of a light sub-path altogether */
    double mean;           /* sum of E over the vertices of a light sub-path */
};

/* importance_in: E of a region, >= 0; 0 where no eye sub-path came. */
static inline double importance_in(const struct importance *importance, int region)
{
    return importance->E != NULL ? importance->E[region] : 0;
}

#endif
