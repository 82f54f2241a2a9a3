/* follow.h: light sub-paths that are walked again, on vertices that are known.
 *
 * Tests: test_chains.c.
 */
#ifndef ASBDPT_FOLLOW_H
#define ASBDPT_FOLLOW_H

#include "transport/path.h"

/* A vertex that a sub-path is to go through again. */
struct path_stop {
    struct vertex v; /* its place, and how it scatters */
    bool delta;      /* it is left by a delta lobe: the one that these numbers choose */
    double u[3];     /* as the walk draws them: lobe and direction */
};

/* follow_light: the light sub-path of n >= 1 vertices on these places, with throughput, densities and weights as
 * if a walk had come there. Visibility is not asked. stop[0] is as vertex_light fills it in; of delta lobes the
 * numbers come from the sampler. Returns how many vertices light comes to.
 * follow_on: go on from n vertices, leaving the last (y_0, no light at infinity, or a surface by a lobe that is
 * not delta) in direction wi, *pdf being that direction's density, 1/sr. Returns the number of vertices. */
int follow_light(const struct walk *w, const struct path_stop *stop, int n, struct vertex *path);
int follow_on(const struct walk *w, struct vertex *path, int n, vec3 wi, int max_vertices, double *pdf);

#endif
