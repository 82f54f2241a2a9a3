/* importance.h: where in space can the camera make use of light?
 *
 * E of a region (regions.h) is the sum of the luminances of the throughputs with which eye sub-paths arrive there:
 * large where many or strong ones pass. A light vertex y is worth about I = luminance(beta_y) E(region of y).
 *
 * Tests: test_asbdpt.c.
 */
#ifndef ASBDPT_IMPORTANCE_H
#define ASBDPT_IMPORTANCE_H

#include "transport/path.h"

struct importance {
    double *E; /* [n], by light region; owned */
    int n;
    size_t capacity;
    double *vertices; /* [n_vertices] connectible vertices y_1, y_2 ... of a light sub-path in each region; owned */
    int n_vertices;
    size_t vertices_capacity;
    /* Means over sub-paths: */
    double light_vertices; /* connectible vertices of a light sub-path altogether */
    double eye_vertices, first_vertices; /* of an eye sub-path, and first hits among them */
    double mean;           /* sum of E over the vertices of a light sub-path */
    double useful;         /* share of light vertices that carries I: (mean I)^2 / mean(I^2), (0,1] */
};

void importance_free(struct importance *importance);

/* importance_add: an eye vertex of that throughput luminance fell into the region. importance_add_light: a light vertex
 * did, or `count` of them. */
void importance_add(struct importance *importance, int region, double luminance);
void importance_add_light(struct importance *importance, int region, double count);

/* importance_in: E of a region, >= 0; 0 where no eye sub-path came. */
double importance_in(const struct importance *importance, int region);

/* importance_of_path: sum of I over the connectible vertices y_1 .. of a light sub-path. */
double importance_of_path(const struct importance *importance, const struct vertex *light, int n);

#endif
