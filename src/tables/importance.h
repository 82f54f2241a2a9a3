/* importance.h: how much light the camera can use from a place.
 *
 * E of a region (regions.h) is the sum of luminance(beta) over the eye vertices in the region. It is large if many eye
 * sub-paths, or such of high throughput, arrive there. The worth of a light vertex y is about
 * luminance(beta_y) E(region of y).
 *
 * Tests: test_asbdpt.c.
 */
#ifndef ASBDPT_IMPORTANCE_H
#define ASBDPT_IMPORTANCE_H

#include <stddef.h>

struct importance {
    /* [limit of the light regions], owned; NULL: not learnt */
    double *E;
    double *vertices; /* N of pairs.h: mean number of connectible vertices of a light sub-path, by finest region */
    /* Means over light sub-paths: */
    double light_vertices; /* number of connectible vertices */
    double mean;           /* sum of E over the connectible vertices */
};

/* importance_in: E of a region, >= 0; 0 if no eye sub-path arrived there. */
static inline double importance_in(const struct importance *importance, int region)
{
    return importance->E != NULL ? importance->E[region] : 0;
}

#endif
