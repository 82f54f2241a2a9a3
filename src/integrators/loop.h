/* loop.h: the loop over the samples of a tile pass whose pixels share light sub-paths (asbdpt.c: render_iteration), and
 * its steps. Where light sub-paths happen in one of `every` iterations (struct numbers), what is drawn counts `every`
 * times.
 *
 * Tests: test_render.c, test_asbdpt.c.
 */
#ifndef ASBDPT_LOOP_H
#define ASBDPT_LOOP_H

#include "integrators/method.h"

/* selection_render: the `render` of such methods. It is in asbdpt.c, with the choice of the default. Its steps:
 *
 *   loop_turn   is it the turn of this iteration, of `every`, to have light sub-paths?
 *   loop_fill   trace the light sub-paths of an iteration, if it has any, into the workspace's pool; K may be 0
 *   loop_begin  begin a sample of pixel i of the tile, and trace its eye sub-path; returns the number of its vertices
 *   loop_splat  connect to the lens the light sub-path of the pixel, if it is one of those that have one
 */
void selection_render(const struct prepared *p, const struct tile_pass *pass);
bool loop_turn(const struct prepared *p, const struct tile_pass *pass, long iteration);
void loop_fill(const struct prepared *p, const struct tile_pass *pass, long iteration);
int loop_begin(const struct prepared *p, const struct tile_pass *pass, int i, long iteration, struct sample *sample);
void loop_splat(const struct prepared *p, struct sample *sample);

/* pool_shuffle: write a random permutation of the sub-paths' numbers for one iteration to order [pool->n]. */
void pool_shuffle(const struct pool *pool, const struct tile_pass *pass, long iteration, int *order);

#endif
