/* strategies.h: images of single strategies (s,t), all from one render, and the pyramid of all of them on one sheet: a
 * row per number of bounces, a column per s. The upper half has each strategy's whole estimate, the lower half its
 * weighted share. The sum of the lower images is the image [V97 10.2.3].
 *
 * Longer paths carry less light, so every row is multiplied by the power of two that its label names. The first rows
 * are left out if they have no light.
 *
 * Tests: test_strategies.c, test_pictures.c.
 */
#ifndef ASBDPT_STRATEGIES_H
#define ASBDPT_STRATEGIES_H

#include "base/error.h"
#include "lab/paths.h"

/* Sums, [strategy_count(max_depth)][pixels*3], numbered by strategy_index. */
struct strategy_images {
    int max_depth;
    struct pixel_rect rect;
    long iterations;
    double *unweighted, *weighted; /* owned */
};

/* strategy_index: number of strategy (s,t), s >= 0, t >= 1, among those with s + t <= max_depth + 2; strategies are
 * ordered by path length. strategy_count: how many there are. */
int strategy_index(int s, int t);
int strategy_count(int max_depth);

/* strategies_init: black. Release with strategies_free. */
void strategies_init(struct strategy_images *images, struct pixel_rect rect, int max_depth);
void strategies_free(struct strategy_images *images);

/* strategies_render: render into black images, with options->max_depth = images->max_depth. */
bool strategies_render(const struct scene *scene, const struct render_job *options, struct strategy_images *images,
                       struct error *err);

/* strategies_picture: that of one, [height*width*3] linear, to be given to free().
 *   scale  as film_develop takes it */
float *strategies_picture(const struct strategy_images *images, double scale, int s, int t, bool weighted);

enum { PYRAMID_DEPTH = 15 }; /* longer paths are left out */

/* pyramid_write: as DIRECTORY/pyramid.png. False with a message.
 *   scale  as film_develop takes it */
bool pyramid_write(const char *directory, const struct strategy_images *images, double scale, struct error *err);

#endif
