/* trace.h: a witness of one pixel sample: what was walked, connected and added to the film.
 *
 * pixel_sample.c tells it what is walked, connected and added, and nobody else does; where nobody watches, which is
 * everywhere but in the one sample of `asbdpt trace`, that costs the comparison of a pointer. What comes of it is no
 * second computation that might differ: added up in their order, the contributions are the film's value to the last
 * bit.
 *
 * Which samples are worth that, a list of those that bring most tells, kept of all samples of a render.
 *
 * Tests: test_trace.c.
 */
#ifndef ASBDPT_TRACE_H
#define ASBDPT_TRACE_H

#include "scene/film.h"
#include "transport/connect.h"
#include "transport/path.h"

/* Copies of vertices, without their lobes and `lamp`, which do not outlive the sample. */
struct trace_path {
    struct vertex *vertex; /* [n], owned */
    int n;
    size_t capacity;
    const struct vertex *source; /* what was copied: how a sub-path is recognised */
};

/* One connection that was tried. */
struct trace_connection {
    int s, t;
    int light;           /* number of the light sub-path; -1: none (s <= 1) */
    double pmf;          /* probability with which it was chosen; 1: there was no choice */
    struct connection c; /* value C*, weight, end point */
    double scale;        /* what else C* is multiplied by: numbers of samples, filter, 1/probabilities of a choice */
    rgb added;           /* C* times scale times weight, as it was added; t = 1: at raster point (c.px, c.py) */
};

struct trace {
    int x, y;       /* the sample to watch */
    long iteration;
    double filter_weight;
    struct trace_path eye;
    struct trace_path *light; /* [n_lights], those that were connected or chosen; owned */
    int n_lights;
    struct trace_connection *connection; /* [n_connections] in the order of adding; owned */
    int n_connections;
    size_t light_capacity, connection_capacity;
    const char *why;   /* how the method chooses what to connect with; NULL: it does not */
    char note[FILM_NOTE_SIZE]; /* what it has chosen for itself */
};

/* A trace starts as zeros but for the sample to watch. trace_free releases what it owns. */
void trace_free(struct trace *trace);

/* trace_watches: the trace, if it watches this sample, else NULL. */
static inline struct trace *trace_watches(struct trace *trace, int x, int y, long iteration)
{
    return trace != NULL && trace->x == x && trace->y == y && trace->iteration == iteration ? trace : NULL;
}

/* trace_eye_path: the eye sub-path. trace_light_path: a light sub-path, once or more often; returns its number. */
void trace_eye_path(struct trace *trace, const struct vertex *path, int n, double filter_weight);
int trace_light_path(struct trace *trace, const struct vertex *path, int n);

/* trace_connect: a connection has been made or tried.
 *   light  the light sub-path whose first s vertices it has; NULL for s <= 1 */
void trace_connect(struct trace *trace, int s, int t, const struct vertex *light, const struct connection *c,
                   double pmf, double scale, rgb added);

/* trace_sum: what was added to the sample's own pixel: all with t >= 2, in their order. */
rgb trace_sum(const struct trace *trace);

/* What a sample brings to one pixel: its own, or, of its light sub-path, another. */
struct brought {
    double luminance;
    int x, y; /* the sample */
    long iteration;
    int to_x, to_y; /* the pixel */
};

/* The samples that bring most to a pixel, each with its most, in that order; equal ones by iteration and pixel: what is
 * in the list does not depend on the order of offers. All zeros but for `most`: empty. */
enum { WORST_MOST = 64 };
struct worst {
    int n, most; /* 1 <= most <= WORST_MOST */
    struct brought item[WORST_MOST];
};

/* worst_offer: take it in, if it is among them. What no film takes is not. */
void worst_offer(struct worst *worst, struct brought b);

/* trace_pdf_rev: the density with which a walk from the other end would have made vertex i, measured as its pdf_fwd,
 * given the two vertices after it; below 0 where the sub-path does not have them. */
double trace_pdf_rev(const struct scene *scene, const struct trace_path *path, int i);

#endif
