/* together.h: methods that connect the pixels of a tile with one another: all its eye sub-paths are traced before the
 * first is connected; and what they need that take over what the eye sub-paths of other pixels have found.
 *
 * Tests: test_rivals.c.
 */
#ifndef ASBDPT_TOGETHER_H
#define ASBDPT_TOGETHER_H

#include "caustics/joint.h"
#include "caustics/lamp.h"
#include "integrators/loop.h"

/* A pixel of a tile in an iteration, with its eye sub-path. */
struct pixel {
    struct sample sample;
    int n; /* of its vertices */
};

/* All strategies of all n pixels. `cache` is what the method's `build` has made of the pool, if it has one. */
typedef void connect_all_fn(const struct prepared *p, const struct tile_pass *pass, const struct cache *cache,
                            struct pixel *pixel, int n);

/* together_begin: a sample of pixel i of the tile that is not connected, in the workspace's arena.
 * together_render: a tile pass by such a method. If it has a `build`, its pixels share light sub-paths. */
struct pixel together_begin(const struct prepared *p, const struct tile_pass *pass, int i, long iteration);
void together_render(const struct prepared *p, const struct tile_pass *pass, connect_all_fn *connect_all);

/* lit_draw: connect_light to a point that light_draw draws, number i of n. */
static inline bool lit_draw(const struct sample *sample, const struct vertex *z, struct sampler *sampler, int i, int n,
                            struct light_point *at, struct lit *out)
{
    const struct scene *scene = sample->pass->job->scene;
    double pdf;
    at->light = -1;
    return light_draw(scene, sample->pass->counts, z, sampler, i, n, at, &pdf) && pdf > 0 &&
           connect_light(scene, z, at, pdf, out);
}

enum { MOST_NEIGHBOURS = 32, NEAR = 4 };

/* reuse_first: is the pixel's first vertex one to connect to? */
static inline bool reuse_first(const struct pixel *p)
{
    return p->n >= 2 && vertex_connectible(&p->sample.eye[1]);
}

/* reuse_neighbours: pixel i, and of `tries` others of the tile's n, at most NEAR columns and rows away, those whose first
 * vertex is like its own in depth and normal, into near [tries + 1]; of a pixel without such a vertex none. Returns how
 * many. They are chosen by first vertices alone. */
int reuse_neighbours(struct pixel *pixel, int n, int i, int tries, int *near);

/* reuse_step: the factor by which an eye walk's throughput has changed from one vertex to the next, in channels, too,
 * in which it was 0; *roulette: the part of it that roulette is, unless a delta lobe was taken. */
rgb reuse_step(const struct vertex *z, const struct vertex *next, double *roulette);

/* reuse_hit: s = 0 for the last of some eye vertices, z, as if that throughput had come there. */
struct connection reuse_hit(const struct sample *sample, const struct vertex *prev, const struct vertex *z,
                            rgb beta);

/* reuse_hit_density: where s = 1 at the vertex before draws what s = 0 hits at z: density there over that of the walk. */
static inline double reuse_hit_density(const struct sample *sample, const struct vertex *prev, const struct vertex *z)
{
    z = z->lamp != NULL ? z->lamp : z;
    if (z->light < 0)
        return 0;
    const struct light_point at = vertex_light_point(sample->pass->job->scene, z);
    return table_ratio(&sample->pass->counts->tables->guide, prev->place, at.cell) * at.pdf / z->pdf_fwd;
}

/* reuse_sees: does z see the light's point? */
static inline bool reuse_sees(const struct scene *scene, const struct lit *l)
{
    return lamp_seen(scene, l->z->p, l->z->prim_id, &l->at);
}

/* reuse_prepare: large tiles. */
void reuse_prepare(const struct render_job *job, struct prepared *p);

#endif
