/* paths.h: every weighted path of a render, pixel by pixel, in an order that does not depend on threads: what pictures
 * of single strategies (strategies.h) and of light in flight are summed up from.
 *
 * Tests: test_strategies.c, test_gates.c.
 */
#ifndef ASBDPT_PATHS_H
#define ASBDPT_PATHS_H

#include "render/render.h"

struct path_told {
    int s, t;
    int x, y;            /* the sample's pixel */
    double px, py;       /* t = 1: the raster point it arrives at */
    float unweighted[3]; /* C* times all but its weight */
    float weight;
    double length;
};

/* Who takes them in: the path, the pixel of the film, row by row, that it adds to, and by what factor (t = 1: of the
 * pixel filter; else 1). */
struct path_taker {
    void *context;
    void (*take)(void *context, const struct path_told *path, size_t pixel, double factor);
};

/* paths_render: render_scene, all paths being handed to `taker`. */
bool paths_render(const struct scene *scene, const struct render_job *options, struct film *film,
                  const struct path_taker *taker, struct error *err);

/* Gates of one width: number i is [begin + i width, begin + (i + 1) width). */
struct gates {
    double begin, width; /* width > 0 */
    int n;
};

/* gates_render: add to sum, [n][pixels*3], what comes by each of neighbouring gates (scene/film.h), all from one
 * render; the film is rendered as ever. False with a message. */
bool gates_render(const struct scene *scene, const struct render_job *options, const struct gates *gates,
                  struct film *film, double *sum, struct error *err);

#endif
