/* asbdpt.h: what the ways of selection have in common that learn where the camera can use light.
 *
 * Tests: test_asbdpt.c.
 */
#ifndef ASBDPT_ASBDPT_H
#define ASBDPT_ASBDPT_H

#include "integrators/pooled.h"
#include "learning/learn.h"

/* pool, vertices: what light sub-paths and vertices are chosen by. */
enum metric {
    METRIC_CONSTANT,   /* every sub-path alike: `pool` is BDPT then */
    METRIC_THROUGHPUT, /* the dissertation's: mean over RGB of beta at the furthest vertex; of a vertex, its own */
    METRIC_IMPORTANCE  /* what the camera can use of it, importance.h */
};
extern const char *const METRICS[];

enum {
    MIN_GUIDED_CELLS = 4, /* light cells; with fewer there is nothing for a guide to choose among */
    GUIDE_CELLS = 8       /* eye regions along the diagonal */
};

/* asbdpt_guided: does s = 1 choose lights by what is seen? */
bool asbdpt_guided(const struct render_job *job);

/* asbdpt_learn: importance, if wanted, on a grid of so many cells, and the guide; counts go by *out from then on. */
void asbdpt_learn(const struct render_job *job, bool importance, int cells, struct tables *out, struct frozen *f);

#endif
