/* prepass.h: the short pre-pass that learns where the camera can use light (importance.h), which lights its paths can
 * see (guide.h) and what regions are worth to each other (pairs.h), and then freezes it all.
 *
 * Tests: test_asbdpt.c (same result for any number of threads, unbiased renders).
 */
#ifndef ASBDPT_INTEGRATORS_PREPASS_H
#define ASBDPT_INTEGRATORS_PREPASS_H

#include "guiding/learnt.h"
#include "integrators/importance.h"
#include "transport/tile_pass.h"

struct prepass_wish {
    bool importance, guide, pairs;
    bool light_vertices;        /* importance.light_vertices at least */
    int eye_cells, light_cells; /* regions along the scene's diameter */
    int levels;                 /* of regions */
    double delta;               /* of the pairs, and of what guides their trials */
    long n_eye;                 /* eye sub-paths to trace; as many light sub-paths, up to a limit */
};

/* prepass_run: learn what is wished for.
 *   importance, learnt  zero-initialised
 * The result depends on job's scene, film, seed and depth, not on its threads. */
void prepass_run(const struct render_job *job, const struct prepass_wish *wish, struct importance *importance,
                 struct learnt *learnt);

#endif
