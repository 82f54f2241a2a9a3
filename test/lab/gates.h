/* gates.h: pictures of light in flight, by neighbouring gates (scene/tile.h), all from one render.
 *
 * Tests: test_gates.c.
 */
#ifndef ASBDPT_GATES_H
#define ASBDPT_GATES_H

#include "lab/paths.h"

/* Gates of one width: number i is [begin + i width, begin + (i + 1) width). */
struct gates {
    double begin, width; /* width > 0 */
    int n;
};

/* gates_render: add to sum, [n][pixels*3], what comes by each gate; the film is rendered as ever. */
bool gates_render(const struct scene *scene, const struct render_options *options, const struct gates *gates,
                  struct film *film, double *sum, struct error *err);

#endif
