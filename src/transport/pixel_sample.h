/* pixel_sample.h: what one pixel sample (one pixel, one iteration) consists of: an eye sub-path, light sub-paths, and
 * sums of connections, weight times C* [V97 10.2], over the strategies that a whole sub-path, or a pair of them, can
 * take part in.
 *
 * A method is a choice of which of these sums to take, with which light sub-path, and of the counts of mis.h.
 * Random streams belong to (seed, purpose, pixel, iteration), so a sub-path does not depend on which method,
 * tile or thread asks for it.
 */
#ifndef ASBDPT_TRANSPORT_PIXEL_SAMPLE_H
#define ASBDPT_TRANSPORT_PIXEL_SAMPLE_H

#include "transport/observer.h"
#include "transport/tile_pass.h"

/* One pixel of one iteration. */
struct pixel_sample {
    const struct scene *scene;
    const struct mis_counts *counts;
    struct tile *tile;
    const struct observer *observer; /* who looks on; NULL: nobody */
    int max_depth;          /* longest path: s + t <= max_depth + 2 */
    int x, y;               /* the pixel */
    long iteration;
    double filter_weight;   /* of its eye sample, see path_eye_pixel */
    int light_points;       /* of struct numbers */
    struct sampler sampler; /* for light and lens points */
    rgb value;              /* sum of the contributions of paths with t >= 2 so far */
};

/* --- sub-paths --------------------------------------------------------------------------------------- */

/* pixel_sample_begin: pixel (x,y) before anything is walked, with a fresh stream for end points. */
struct pixel_sample pixel_sample_begin(const struct tile_pass *pass, const struct mis_counts *counts, int x, int y,
                                       long iteration);

/* pixel_eye_path: the eye sub-path of the sample's pixel into path [max_vertices]; sets sample->filter_weight. Returns
 * its length. */
int pixel_eye_path(const struct tile_pass *pass, struct pixel_sample *sample, struct vertex *path, int max_vertices);

/* pixel_sampler: the stream of a pixel and iteration for a purpose of the method's own. */
struct sampler pixel_sampler(const struct tile_pass *pass, enum rng_purpose purpose, int x, int y, long iteration);

/* pixel_light_path: the light sub-path that belongs to pixel (x,y) and `number` into path [max_depth + 1]; its lobes go
 * to `arena`. Returns its length. */
int pixel_light_path(const struct tile_pass *pass, const struct mis_counts *counts, int x, int y, uint64_t number,
                     struct arena *arena, struct vertex *path);

/* pixel_light_count: light sub-paths per iteration over the whole film, one per pixel: n of t = 1. */
double pixel_light_count(const struct render_job *job);

/* --- sums of connections ----------------------------------------------------------------------------- */

/* pixel_sum_hit: s = 0, pixel_sum_direct: s = 1, of the eye sub-path's first t vertices.
 * pixel_sum_eye: both for every vertex of the eye sub-path of n vertices; without counts for s = 0 only what is seen
 * directly. */
void pixel_sum_hit(struct pixel_sample *sample, const struct vertex *eye, int t);
void pixel_sum_direct(struct pixel_sample *sample, const struct vertex *eye, int t);
void pixel_sum_eye(struct pixel_sample *sample, const struct vertex *eye, int n);

/* What a method drew to join an eye sub-path with. */
struct choice {
    double pmf;   /* probability of the draw, given what it was drawn from; 1: there was no choice */
    double scale; /* what its contributions are multiplied by for that */
};
static const struct choice NO_CHOICE = {1, 1};

/* pixel_sum_pair: one strategy s >= 2, t >= 2, joining the light vertex y = y_{s-1} to the eye vertex z = z_{t-1}. */
void pixel_sum_pair(struct pixel_sample *sample, const struct vertex *y, int s, const struct vertex *z, int t,
                    struct choice choice);

/* pixel_sum_pairs: s >= 2, t >= 2 for every pair of vertices of the two sub-paths. */
void pixel_sum_pairs(struct pixel_sample *sample, const struct vertex *eye, int n_eye, const struct vertex *light,
                     int n_light, struct choice choice);

/* pixel_splat_path: s >= 2, t = 1 for every vertex of a light sub-path, each times `scale`; the sums go to the
 * tile's splats. */
void pixel_splat_path(struct pixel_sample *sample, const struct vertex *light, int n_light, double scale);

/* pixel_add: the one place where a path with t >= 2 is added to the sample, C* weighted, and told of.
 * pixel_splat: the same of one with t = 1: it arrives at every raster point that is the same ray.
 *   y, z  as in struct joined */
void pixel_add(struct pixel_sample *sample, const struct connection *c, int s, int t, const struct vertex *y,
               const struct vertex *z, struct choice choice);
void pixel_splat(struct pixel_sample *sample, const struct connection *c, int s, const struct vertex *y, double scale);

/* pixel_sample_end: the sample goes into its tile. Call once. */
void pixel_sample_end(const struct pixel_sample *sample);

#endif
