/* path.h: sub-paths, and the one random walk that makes both kinds.
 *
 * An eye sub-path z_0 z_1 ... starts on the lens, a light sub-path y_0 y_1 ... on a light. The throughput beta of a
 * vertex is the product of all factors of the measurement up to the *arrival* at the vertex, divided by the density of
 * the sub-path: alpha of [V97 eq. 10.6] [V97 eq. 10.7]. The BSDF of the vertex itself is not a factor.
 *
 * From the second bounce on, Russian roulette ends walks whose throughput is low. A walk that has kept the fraction r
 * of its first throughput continues with probability q = sqrt(r / rr_threshold), and its throughput is divided by q
 * [Arvo & Kirk 1990]. The root makes q larger than r / rr_threshold, which is more common, since a weak sub-path is
 * still connected to many others. q depends on the whole walk, so no other strategy could compute it for the same path,
 * and the weights leave it out. They still add up to 1, so the estimate is unbiased.
 *
 * Tests: test_mis.c, test_render.c.
 */
#ifndef ASBDPT_PATH_H
#define ASBDPT_PATH_H

#include "base/mem.h"
#include "base/sampler.h"
#include "transport/counts.h"
#include "transport/mis.h"

/* The parameters of a walk. */
struct walk {
    const struct scene *scene;
    const struct counts *counts;
    struct arena *arena; /* holds the lobes of the vertices */
    struct sampler *sampler;
    double rr_threshold; /* fraction of the first throughput below which Russian roulette begins; 0: never */
};

/* path_eye: walk from the lens through raster point (px,py).
 *   path  out, [max_vertices]
 * Returns the number of vertices, 1 <= n <= max_vertices. */
int path_eye(const struct walk *w, double px, double py, struct vertex *path, int max_vertices);

/* path_eye_pixel: the same through a point that is drawn from the filter of pixel (x,y). The caller multiplies the
 * pixel's estimate by *filter_weight (filter.h). */
int path_eye_pixel(const struct walk *w, int x, int y, struct vertex *path, int max_vertices,
                   double *filter_weight);

/* path_light: choose a light, a point on it and a direction, and walk. Returns the number of vertices; 0 if nothing is
 * emitted.
 *   column  out: of the table by which it left its light (emission.h); may be NULL */
int path_light(const struct walk *w, struct vertex *path, int max_vertices, int *column);

/* path_throughput: beta of [S24]: mean over RGB of beta at the last vertex of a light sub-path; 0 if it is empty. If
 * y_0 is its only vertex, that is the emitted radiance, as in pbrt-v3, where [S24] was implemented. */
static inline double path_throughput(const struct vertex *path, int n)
{
    return n < 1 ? 0 : rgb_mean(path[n - 1].beta);
}

/* n_before: c_e of mis.h (3) for vertex v of a walk, and prev, the vertex before: n of the strategy that connects
 * these two; 0 if prev was left by a delta lobe. */
static inline double n_before(const struct counts *c, const struct vertex *prev, const struct vertex *v,
                              enum transport mode)
{
    return v->prev_delta ? 0 : mode == RADIANCE ? n_of(c, v, prev) : n_of(c, prev, v);
}

/* --- the walk itself, step by step, for methods that make some of the steps themselves ----------------- */

/* How a walk left its last vertex. */
struct departure {
    struct ray ray;
    rgb beta;       /* throughput on arrival, without the transmittance of the edge */
    double pdf;     /* of the direction, 1/sr; of parallel rays from a light or the lens: of the origin, 1/m^2 */
    double pdf_rev; /* 1/sr, of the reverse move: from that vertex to the vertex before it */
    bool delta;
};

/* walk_on: continue a walk of n vertices, whose last vertex has been left. Returns the number of vertices. */
int walk_on(const struct walk *w, struct departure from, struct vertex *path, int n, int max_vertices,
            enum transport mode);

/* walk_leave: leave a vertex by sampling its BSDF or phase function: beta is multiplied by f cos / pdf [V97 10.2].
 * False if the walk is absorbed. */
bool walk_leave(const struct walk *w, const struct vertex *v, enum transport mode, struct departure *out);

/* walk_measure: pdf_fwd, g and mis (mis.h) of a vertex at distance^2 d2 from `prev`. */
void walk_measure(const struct walk *w, struct vertex *v, const struct vertex *prev, const struct departure *from,
                  double d2);

#endif
