/* timed.h: a render that is timed: the picture, and what it took.
 *
 * Tests: test_report.c.
 */
#ifndef ASBDPT_LAB_TIMED_H
#define ASBDPT_LAB_TIMED_H

#include "render/render.h"

struct timed {
    float *pixels;        /* [height*width*3] linear; owned */
    double seconds, wall; /* of CPU, of the clock; above 0; with all that is prepared, without loading the scene */
    long nonfinite;       /* samples that were left out */
};

/* timed_film: render into a film that there is, and add to out->seconds and out->wall. timed_render: render a picture
 * by itself; *out is filled, its pixels are the caller's. False with a message. */
bool timed_film(const struct scene *scene, const struct render_job *o, struct film *film, struct timed *out,
                struct error *err);
bool timed_render(const struct scene *scene, const struct render_job *o, struct timed *out, struct error *err);

/* timed_prepare: CPU seconds that preparing the method takes, and the length of the blocks that its samples come in; 0:
 * any. False with a message. */
bool timed_prepare(const struct scene *scene, const struct render_job *o, double *seconds, int *block,
                   struct error *err);

/* timed_develop: the film's picture, to be freed. */
float *timed_develop(const struct scene *scene, const struct film *film);

#endif
