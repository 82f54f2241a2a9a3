/* sample.h: one sample of a pixel: one pixel, one iteration. It is a sum of connections, weight times C* [V97 10.2]. A
 * method chooses of which strategies, with which light sub-paths. Random streams are a function of seed, purpose,
 * pixel and iteration, so a sub-path does not depend on the tile or thread.
 *
 * Observers are called with every path where it is added to the sample or to the splats. Added up in their order, the
 * contributions with t >= 2 are the value that the film receives, to the last bit.
 *
 * Tests: test_trace.c, test_strategies.c.
 */
#ifndef ASBDPT_TRANSPORT_SAMPLE_H
#define ASBDPT_TRANSPORT_SAMPLE_H

#include "transport/connect.h"
#include "transport/tile_pass.h"

/* Vertices of a light sub-path: those of numbers [first, end). */
struct drawn {
    const struct vertex *path; /* the light sub-path, from y_0 on */
    int first, end;
    double pmf; /* probability of their choice; 1: there was no choice */
};

/* drawn_vertex: light vertex y alone. The sub-path that ends there is in front of it in memory. */
static inline struct drawn drawn_vertex(const struct vertex *y, double pmf)
{
    int i = 0;
    while (y[-i].kind != VERTEX_LIGHT)
        i++;
    return (struct drawn){y - i, i, i + 1, pmf};
}

struct sample {
    const struct tile_pass *pass;
    int i, x, y;            /* the pixel: its number in the tile, and where it is */
    long iteration;
    struct vertex *eye;     /* the eye sub-path, in the workspace unless the method keeps it elsewhere */
    double filter_weight;   /* see path_eye_pixel */
    struct sampler sampler; /* for light and lens points */
    struct sampler choice;  /* for the choice of light vertices, of methods that choose */
    rgb value;              /* sum so far of the contributions with t >= 2 */
};

/* sample_begin: a sample of pixel i of the tile, without sub-paths. sample_end: add it to its tile. Call this once. */
struct sample sample_begin(const struct tile_pass *pass, int i, long iteration);
void sample_end(const struct sample *sample);

/* sample_eye_path: trace the eye sub-path; sets the filter weight. Returns the number of its vertices, at most
 * max_vertices.
 * sample_light_path: trace the light sub-path of pixel i and `number` into path [max_depth + 1]; `arena` receives its
 * lobes. Returns the number of vertices. */
int sample_eye_path(struct sample *sample, int max_vertices);
int sample_light_path(const struct tile_pass *pass, int i, uint64_t number, struct arena *arena, struct vertex *path);

/* sample_stream: the random numbers of pixel (x,y) and `number` for a purpose. `number` is the iteration, unless a
 * method numbers its light sub-paths otherwise. */
struct sampler sample_stream(const struct tile_pass *pass, enum rng_purpose purpose, int x, int y, uint64_t number);

/* The strategies of z_{t-1}, t >= 2:
 *   sample_s0     s = 0: it is on a light
 *   sample_s1     s = 1: it is joined to new points on lights
 *   sample_pairs  s >= 2: it is joined to all that is drawn, times `scale`, if the path is not too long
 * Nothing is added that the counts leave out, except lights that the camera sees directly (t = 2). */
void sample_s0(struct sample *sample, int t);
void sample_s1(struct sample *sample, int t);
void sample_pairs(struct sample *sample, const struct drawn *drawn, int t, double scale);

/* sample_lens: s >= 2, t = 1 for every vertex of a light sub-path, times `scale`, to the splats of the tile. */
void sample_lens(struct sample *sample, const struct vertex *path, int n, double scale);

/* --- observers --------------------------------------------------------------------------------------- */

/* One strategy (s,t) that was tried: a path, or nothing if the value is black. */
struct joined {
    int s, t;
    const struct vertex *path;   /* [s] the light sub-path, or the light point that was drawn; NULL: there is none */
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
    /* RADIANCE: the sample's eye sub-path; IMPORTANCE: a light sub-path that it joins to the lens. */
    void (*walked)(void *context, const struct sample *sample, enum transport mode, const struct vertex *path, int n);
    /* A path is about to be added to the sample's sums (t >= 2), or to the tile's splats. */
    void (*joined)(void *context, const struct sample *sample, const struct joined *path);
    const struct observer *next; /* the next observer, or NULL */
};

/* sample_add: the one place where a path with t >= 2 is added to the sample and where observers are called with it.
 * sample_splat: the same for a path with t = 1. It arrives at every raster point that has the same ray (camera_images).
 *   j  all but `added` */
void sample_add(struct sample *sample, struct joined j);
void sample_splat(struct sample *sample, struct joined j);

#endif
