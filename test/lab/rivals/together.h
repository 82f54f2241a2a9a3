/* together.h: methods that connect the pixels of a tile with one another: all its eye sub-paths are traced before the
 * first is connected; and what they need that take over what the eye sub-paths of other pixels have found.
 *
 * Tests: test_rivals.c.
 */
#ifndef ASBDPT_TOGETHER_H
#define ASBDPT_TOGETHER_H

#include "caustics/lamp.h"
#include "integrators/pooled.h"

/* All strategies t >= 2 of all n pixels. */
typedef void connect_all_fn(void *scratch, const void *state, const struct tile_pass *pass, struct pooled_pixel *pixel,
                            int n);

/* together_render: a tile pass by such a method. */
void together_render(const struct preparation *m, const struct tile_pass *pass, connect_all_fn *connect_all);

/* area_before: what turns a density per steradian at v into one per area at the vertex before it. */
double area_before(const struct scene *scene, const struct vertex *before, const struct vertex *v);

enum { MOST_NEIGHBOURS = 32 };

/* reuse_first: is the pixel's first vertex one to connect to? */
static inline bool reuse_first(const struct pooled_pixel *p)
{
    return p->n >= 2 && vertex_connectible(&p->eye[1]);
}

/* reuse_neighbours: pixel i, and of `tries` others of the tile's n those whose first vertex is like its own in depth
 * and normal, into near [tries + 1]; of a pixel without such a vertex none. Returns how many. They are chosen by first
 * vertices alone. */
int reuse_neighbours(struct pooled_pixel *pixel, int n, int i, int tries, int *near);

/* reuse_step: the factor by which an eye walk's throughput has changed from one vertex to the next, in channels, too,
 * in which it was 0; *roulette: the part of it that roulette is, unless a delta lobe was taken. */
rgb reuse_step(const struct vertex *z, const struct vertex *next, double *roulette);

/* reuse_hit: s = 0 for the last, z, of t eye vertices as if that throughput had come there. */
struct connection reuse_hit(const struct pixel_sample *sample, const struct vertex *prev, const struct vertex *z, int t,
                            rgb beta);

/* reuse_hit_density: where s = 1 draws what s = 0 hits at z: density there over that of the walk. */
static inline double reuse_hit_density(const struct vertex *z)
{
    z = z->lamp != NULL ? z->lamp : z;
    return z->pdf_origin / z->pdf_fwd;
}

/* reuse_sees: does z see the light's point? */
static inline bool reuse_sees(const struct scene *scene, const struct lit *l)
{
    return lamp_seen(scene, l->z->p, l->z->prim_id, &l->at);
}

/* reuse_add: a connection, s <= 1, that others' sub-paths have part in, times `scale`. */
static inline void reuse_add(struct pixel_sample *sample, const struct connection *c, int s, int t, double scale)
{
    const struct choice choice = {1, scale};
    pixel_add(sample, c, s, t, NULL, NULL, choice);
}

/* reuse_prepare: path tracing's strategies, in large tiles. */
void reuse_prepare(const struct render_job *job, struct preparation *out);

#endif
