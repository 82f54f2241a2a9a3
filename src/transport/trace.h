/* trace.h: the steps every method takes for one pixel of one iteration.
 *
 * Random streams belong to (seed, purpose, pixel, iteration), so a sub-path does not depend on which method, tile or
 * thread asks for it.
 *
 * Used by: the methods.
 */
#ifndef ASBDPT_TRACE_H
#define ASBDPT_TRACE_H

#include "transport/gather.h"
#include "integrators/method.h"

/* trace_begin: what gather.h needs for pixel (x,y): counts, tile, a fresh stream for end points. */
struct gather trace_begin(const struct tile_pass *pass, const struct mis_counts *counts, int x, int y, long iteration);

/* trace_eye: the eye sub-path of g's pixel into path [max_vertices]; sets g->filter_weight. Returns its length. */
int trace_eye(const struct tile_pass *pass, struct gather *g, long iteration, struct vertex *path, int max_vertices);

/* trace_sampler: the stream of a pixel and iteration for a purpose of the method's own. */
struct sampler trace_sampler(const struct tile_pass *pass, enum rng_purpose purpose, int x, int y, long iteration);

/* trace_light: the light sub-path that belongs to pixel (x,y) and `number` into path [max_depth + 1]; its lobes go to
 * `arena`. Returns its length. */
int trace_light(const struct tile_pass *pass, const struct mis_counts *counts, int x, int y,
                uint64_t number, struct arena *arena, struct vertex *path);

/* trace_light_count: light sub-paths per iteration over the whole film, one per pixel: n of t = 1. */
double trace_light_count(const struct render_job *job);

#endif
