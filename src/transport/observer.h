/* observer.h: functions that are called with every path that a method makes.
 *
 * A render is a sum of weighted paths. sample.c calls the observers where it adds a path to the sample or to the
 * splats, so they get the same numbers as the film. Added up in their order, the contributions with t >= 2 are the
 * value that the film receives, to the last bit. Without an observer this costs the comparison of a pointer.
 *
 * Tests: test_trace.c.
 */
#ifndef ASBDPT_OBSERVER_H
#define ASBDPT_OBSERVER_H

#include "transport/connect.h"

struct sample;

/* One strategy (s,t) that was tried: a path, or nothing if the value is black. */
struct joined {
    int s, t;
    const struct vertex *light;  /* [s] the light sub-path, or the light point that was drawn; NULL: there is none */
    const struct vertex *z;      /* z_{t-1}; the vertices before it are in front of it in memory. NULL if t = 1, or if
                                  * it is not the sample's own vertex */
    const struct connection *c;  /* value C*, weight, light */
    double px, py;               /* t = 1: the raster point where it arrives */
    double pmf;                  /* probability with which it was chosen; 1: there was no choice */
    double scale;                /* other factors of C*: 1/number of samples, 1/pmf, filter */
    rgb added;                   /* C* times scale times weight; t = 1: at that point */
};

/* Each function may be NULL. Its arguments are valid only during the call. */
struct observer {
    void *context; /* passed to all functions */
    /* A sub-path that the sample uses, possibly more than once; RADIANCE: its eye sub-path. */
    void (*walked)(void *context, const struct sample *sample, enum transport mode, const struct vertex *path, int n);
    /* A path is about to be added to the sample's sums (t >= 2), or to the tile's splats. */
    void (*joined)(void *context, const struct sample *sample, const struct joined *path);
    const struct observer *next; /* the next observer, or NULL */
};

#endif
