/* path.h: sub-paths, and the one random walk that makes both kinds.
 *
 * An eye sub-path z_0 z_1 ... starts on the lens, a light sub-path y_0 y_1 ... on a light. Each vertex carries what a
 * connection ending there needs: its throughput, its scattering function and its part of the MIS weight (mis.h).
 *
 * The throughput beta of a vertex is the product of the factors of the measurement up to the *arrival* at the vertex,
 * divided by the density of having sampled it, alpha of [V97 eq. 10.6] [V97 eq. 10.7]; the vertex' own BSDF is not in
 * it.
 *
 * From their second bounce on, walks end early by Russian roulette where little throughput is left: a walk that has
 * kept the fraction r of its first throughput survives with probability sqrt(r / rr_threshold), and its throughput is
 * divided by that [Arvo & Kirk 1990]. The probability depends on all of the walk, so no other strategy could know it
 * for the same path, and MIS leaves it out: any weights that add up to 1 are unbiased, and these are close to the best
 * as long as roulette is mild. The square root is milder than the usual probability r / rr_threshold: a weak sub-path
 * still meets many others.
 *
 * Tests: test_mis.c, test_render.c.
 */
#ifndef ASBDPT_PATH_H
#define ASBDPT_PATH_H

#include "base/mem.h"
#include "base/sampler.h"
#include "tables/importance.h"
#include "transport/vertex.h"

enum { PATH_MAX_DEPTH = 1000 }; /* largest maxdepth accepted */

/* What a walk needs besides its start. */
struct walk {
    const struct scene *scene;
    const struct mis_counts *counts;
    struct arena *arena; /* holds the lobes of the vertices */
    struct sampler *sampler;
    double rr_threshold; /* relative throughput below which Russian roulette begins; 0: never */
};

/* path_eye: walk from the lens through raster point (px,py).
 *   path  out, [max_vertices]
 * Returns the number of vertices, 1 <= n <= max_vertices. */
int path_eye(const struct walk *w, double px, double py, struct vertex *path, int max_vertices);

/* path_eye_pixel: the same through a point drawn from the filter of pixel (x,y); *filter_weight is what the pixel's
 * estimate is to be multiplied by (filter.h). */
int path_eye_pixel(const struct walk *w, int x, int y, struct vertex *path, int max_vertices,
                   double *filter_weight);

/* path_light: choose a light, emit, and walk. Returns the number of vertices; 0 when nothing is emitted. */
int path_light(const struct walk *w, struct vertex *path, int max_vertices);

/* path_throughput: beta of [S24]: mean over RGB at the furthest vertex of a light sub-path; 0 if it is empty. One of
 * y_0 alone, which met no surface, has the emitted radiance there, as in pbrt-v3, where [S24] was implemented. */
static inline double path_throughput(const struct vertex *light, int n)
{
    return n < 1 ? 0 : rgb_mean(light[n - 1].beta);
}

/* path_importance: what the camera can use of a light sub-path: the sum of I (importance.h) over its connectible
 * vertices y_1 .. */
double path_importance(const struct importance *importance, const struct vertex *light, int n);

/* --- the walk itself, step by step -------------------------------------------------------------------- */

/* How a walk left its last vertex. */
struct departure {
    struct ray ray;
    rgb beta;       /* throughput on arrival */
    double pdf;     /* of the direction, 1/sr; of parallel rays from a light or the lens: of the origin, 1/m^2 */
    double pdf_rev; /* 1/sr, of going from that vertex to the one before it */
    bool delta;
    struct passage *way; /* to the next vertex, where there are media; in the walk's arena */
};

/* walk_on: go on from n vertices, the last of which has been left. Returns the number of vertices. */
int walk_on(const struct walk *w, struct departure from, struct vertex *path, int n, int max_vertices,
            enum transport mode);

/* walk_leave: leave a surface vertex by sampling its BSDF: beta takes up f cos / pdf [V97 10.2]. False if the walk is
 * absorbed. */
bool walk_leave(const struct walk *w, const struct vertex *v, enum transport mode, struct departure *out);

/* walk_measure: pdf_fwd of a vertex at distance^2 d2 from `prev`, which was left so, and its mis (mis.h). */
void walk_measure(const struct walk *w, struct vertex *v, const struct vertex *prev, const struct departure *from,
                  double d2);

#endif
