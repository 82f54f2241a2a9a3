/* together.h: methods that connect the pixels of a tile with one another: all its eye sub-paths are traced before the
 * first is connected.
 *
 * Tests: test_rivals.c.
 */
#ifndef ASBDPT_TOGETHER_H
#define ASBDPT_TOGETHER_H

#include "integrators/pooled.h"

/* All strategies t >= 2 of all n pixels. */
typedef void connect_all_fn(void *scratch, const void *state, const struct tile_pass *pass, struct pooled_pixel *pixel,
                            int n);

/* together_render: a tile pass by such a method. */
void together_render(const struct preparation *m, const struct tile_pass *pass, connect_all_fn *connect_all);

#endif
