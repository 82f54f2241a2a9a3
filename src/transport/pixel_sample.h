/* pixel_sample.h: one sample of a pixel: one pixel, one iteration. It consists of an eye sub-path, light sub-paths, and
 * sums of connections, weight times C* [V97 10.2], over the strategies of a sub-path or of a pair of sub-paths.
 *
 * A method chooses which of these sums to take, with which light sub-paths, and the counts of mis.h. Random streams
 * are a function of (seed, purpose, pixel, iteration), so a sub-path does not depend on the tile or thread.
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
    const struct observer *observer; /* NULL: none */
    int max_depth;          /* longest path: s + t <= max_depth + 2 */
    int x, y;               /* the pixel */
    long iteration;
    double filter_weight;   /* see path_eye_pixel */
    int light_points;       /* of struct numbers */
    struct sampler sampler; /* for light and lens points */
    rgb value;              /* sum so far of the contributions with t >= 2 */
};

/* --- sub-paths --------------------------------------------------------------------------------------- */

/* pixel_sample_begin: a sample of pixel (x,y) without sub-paths, with a new random stream for light and lens points. */
struct pixel_sample pixel_sample_begin(const struct tile_pass *pass, const struct mis_counts *counts, int x, int y,
                                       long iteration);

/* pixel_eye_path: trace the eye sub-path of the sample's pixel into path [max_vertices]; sets sample->filter_weight.
 * Returns the number of vertices. */
int pixel_eye_path(const struct tile_pass *pass, struct pixel_sample *sample, struct vertex *path, int max_vertices);

/* pixel_sampler: the random stream of a pixel and iteration for another purpose of the method. */
struct sampler pixel_sampler(const struct tile_pass *pass, enum rng_purpose purpose, int x, int y, long iteration);

/* pixel_light_path: trace the light sub-path of pixel (x,y) and `number` into path [max_depth + 1]; `arena` receives
 * its lobes. Returns the number of vertices. */
int pixel_light_path(const struct tile_pass *pass, const struct mis_counts *counts, int x, int y, uint64_t number,
                     struct arena *arena, struct vertex *path);

/* pixel_light_count: number of light sub-paths of an iteration over the whole film, if there is one per pixel. */
double pixel_light_count(const struct render_job *job);

/* --- sums of connections ----------------------------------------------------------------------------- */

/* pixel_sum_hit: s = 0, pixel_sum_direct: s = 1, for the first t vertices of the eye sub-path.
 * pixel_sum_eye: both for every vertex of an eye sub-path of n vertices. If the method does not use these strategies it
 * adds only lights that the camera sees directly (t = 2). */
void pixel_sum_hit(struct pixel_sample *sample, const struct vertex *eye, int t);
void pixel_sum_direct(struct pixel_sample *sample, const struct vertex *eye, int t);
void pixel_sum_eye(struct pixel_sample *sample, const struct vertex *eye, int n);

/* How a method chose what it joins to an eye sub-path. */
struct choice {
    double pmf;   /* probability of the choice among the candidates; 1: there was no choice */
    double scale; /* factor of the contributions: makes up for the probability and the number of draws */
};
static const struct choice NO_CHOICE = {1, 1};

/* pixel_sum_pair: one strategy s >= 2, t >= 2, joining the light vertex y = y_{s-1} to the eye vertex z = z_{t-1}. */
void pixel_sum_pair(struct pixel_sample *sample, const struct vertex *y, int s, const struct vertex *z, int t,
                    struct choice choice);

/* pixel_sum_pairs: s >= 2, t >= 2 for every pair of vertices of the two sub-paths. */
void pixel_sum_pairs(struct pixel_sample *sample, const struct vertex *eye, int n_eye, const struct vertex *light,
                     int n_light, struct choice choice);

/* pixel_splat_path: s >= 2, t = 1 for every vertex of a light sub-path, times `scale`, to the splats of the tile. */
void pixel_splat_path(struct pixel_sample *sample, const struct vertex *light, int n_light, double scale);

/* pixel_add: the one place where a path with t >= 2 is added to the sample and where observers are called with it.
 * pixel_splat: the same for a path with t = 1. It arrives at every raster point that has the same ray (camera_images).
 *   y, z  as in struct joined */
void pixel_add(struct pixel_sample *sample, const struct connection *c, int s, int t, const struct vertex *y,
               const struct vertex *z, struct choice choice);
void pixel_splat(struct pixel_sample *sample, const struct connection *c, int s, const struct vertex *y, double scale);

/* pixel_sample_end: add the sample to its tile. Call this once. */
void pixel_sample_end(const struct pixel_sample *sample);

#endif
