/* importance.h: where in space can the camera make use of light?
 *
 * The pre-pass (prepass.h) adds to each region (learnt.h) the luminance of the throughput of the eye vertices that fall
 * into it: E, large where many or strong eye sub-paths pass. A light vertex y is worth about luminance(beta_y) E(region
 * of y).
 *
 * Tests: test_asbdpt.c.
 */
#ifndef ASBDPT_INTEGRATORS_IMPORTANCE_H
#define ASBDPT_INTEGRATORS_IMPORTANCE_H

#include "transport/path.h"

struct importance {
    double *E; /* [n], by light region; owned */
    int n;
    size_t capacity;
    /* About the connectible vertices y_1, y_2 ... of light sub-paths: */
    double *vertices; /* [light regions], how many a sub-path has there on average; owned */
    double light_vertices; /* how many it has altogether on average */
    /* connectible vertices of an eye sub-path on average, and first hits among them */
    double eye_vertices, first_vertices;
    double mean;      /* expectation over sub-paths of the sum of E over their vertices */
    double useful;    /* share of vertices that carries I = luminance(beta) E: (mean I)^2 / mean(I^2), (0,1] */
};

void importance_free(struct importance *g);

/* importance_add: an eye vertex of that throughput luminance fell into the region. */
void importance_add(struct importance *g, int region, double luminance);

/* importance_in: E of a region, >= 0; 0 where no eye sub-path of the pre-pass came. */
double importance_in(const struct importance *g, int region);

/* importance_of_path: sum of luminance(beta) E over the connectible vertices y_1 .. of a light sub-path. */
double importance_of_path(const struct importance *g, const struct vertex *light, int n);

#endif
