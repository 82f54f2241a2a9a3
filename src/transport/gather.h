/* gather.h: sums of connections over the strategies that a whole sub-path, or a pair of them, can take part in.
 *
 * A method is a choice of which of these sums to take, with which light sub-path, and of the counts of mis.h.
 *
 * Used by: the methods.
 */
#ifndef ASBDPT_GATHER_H
#define ASBDPT_GATHER_H

#include "transport/connect.h"
#include "scene/film.h"

/* One pixel of one iteration. */
struct gather {
    const struct scene *scene;
    const struct mis_counts *counts;
    struct tile *tile;
    int max_depth;          /* longest path: s + t <= max_depth + 2 */
    int x, y;               /* the pixel */
    double filter_weight;   /* of its eye sample, see path_eye_pixel */
    struct sampler sampler; /* for light and lens points */
};

/* gather_eye: s = 0 and s = 1 for every vertex of the eye sub-path of n vertices. Returns the weighted sum
 * times filter_weight. */
rgb gather_eye(struct gather *g, const struct vertex *eye, int n);

/* gather_pair: one strategy s >= 2, t >= 2, joining the light vertex y = y_{s-1} to the eye vertex z = z_{t-1}; times
 * `scale` and filter_weight. */
rgb gather_pair(struct gather *g, const struct vertex *y, int s, const struct vertex *z, int t, double scale);

/* gather_pairs: s >= 2, t >= 2 for every pair of vertices of the two sub-paths, each multiplied by `scale`
 * and filter_weight. */
rgb gather_pairs(struct gather *g, const struct vertex *eye, int n_eye, const struct vertex *light, int n_light,
                 double scale);

/* gather_splats: s >= 2, t = 1 for every vertex of a light sub-path, each multiplied by `scale`; the sums go to the
 * tile's splats. */
void gather_splats(struct gather *g, const struct vertex *light, int n_light, double scale);

#endif
