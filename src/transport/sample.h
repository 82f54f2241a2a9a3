/* sample.h: one sample of a pixel: one pixel, one iteration. It consists of an eye sub-path, light sub-paths, and sums
 * of connections, weight times C* [V97 10.2], over the strategies of a sub-path or of a pair of sub-paths.
 *
 * A method chooses which of these sums to take, with which light sub-paths, and the counts of counts.h. Random streams
 * are a function of (seed, purpose, pixel, iteration), so a sub-path does not depend on the tile or thread.
 */
#ifndef ASBDPT_TRANSPORT_SAMPLE_H
#define ASBDPT_TRANSPORT_SAMPLE_H

#include "transport/observer.h"
#include "transport/tile_pass.h"

struct sample {
    const struct tile_pass *pass;
    const struct counts *counts;
    int light_points;       /* of struct numbers */
    int x, y;               /* the pixel */
    int number;             /* of the pixel in its tile */
    long iteration;
    double filter_weight;   /* see path_eye_pixel */
    struct sampler sampler; /* for light and lens points */
    struct sampler choice;  /* for the choice of light vertices, of methods that choose */
    rgb value;              /* sum so far of the contributions with t >= 2 */
};

/* sample_begin: a sample of pixel (x,y) without sub-paths. sample_end: add it to its tile. Call this once. */
struct sample sample_begin(const struct tile_pass *pass, const struct counts *counts, int light_points, int x, int y,
                           long iteration);
void sample_end(const struct sample *sample);

/* --- sub-paths --------------------------------------------------------------------------------------- */

/* sample_eye_path: trace the eye sub-path into path [max_vertices]; sets sample->filter_weight. Returns the number of
 * vertices. */
int sample_eye_path(struct sample *sample, struct vertex *path, int max_vertices);

/* sample_light_path: trace the light sub-path of pixel (x,y) and `number` into path [max_depth + 1]; `arena` receives
 * its lobes. Returns the number of vertices. */
int sample_light_path(const struct tile_pass *pass, const struct counts *counts, int x, int y, uint64_t number,
                      struct arena *arena, struct vertex *path);

/* sample_stream: the random numbers of pixel (x,y) and `number` for a purpose. */
struct sampler sample_stream(const struct tile_pass *pass, enum rng_purpose purpose, int x, int y, uint64_t number);

/* --- sums of connections ----------------------------------------------------------------------------- */

/* sample_hit: s = 0, for the first t vertices of the eye sub-path.
 * sample_direct: s = 1, for its vertex z = z_{t-1}.
 * Both add nothing that the method's counts leave out, except lights that the camera sees directly (t = 2). */
void sample_hit(struct sample *sample, const struct vertex *eye, int t);
void sample_direct(struct sample *sample, const struct vertex *z, int t);

/* sample_pairs: s >= 2: join z = z_{t-1} to all of them, times `scale`, if the path is not too long. */
void sample_pairs(struct sample *sample, const struct drawn *drawn, const struct vertex *z, int t, double scale);

/* sample_lens: s >= 2, t = 1 for every vertex of a light sub-path, times `scale`, to the splats of the tile. */
void sample_lens(struct sample *sample, const struct vertex *light, int n_light, double scale);

/* sample_add: the one place where a path with t >= 2 is added to the sample and where observers are called with it.
 * sample_splat: the same for a path with t = 1. It arrives at every raster point that has the same ray (camera_images).
 *   j  all but `added` */
void sample_add(struct sample *sample, struct joined j);
void sample_splat(struct sample *sample, struct joined j);

#endif
