/* agree.h: methods that must have one expectation. */
#ifndef ASBDPT_TEST_AGREE_H
#define ASBDPT_TEST_AGREE_H

#include "lab/verify.h"
#include "scene/scene.h"
#include "test.h"

/* check_agree: have two the same expectation, by batches_p or, if they share a seed, batches_paired_p? And is the first
 * refused when it is made brighter by the share `planted`, unless this is 0? Releases the first. The format and what
 * follows say which two. */
void check_agree(struct test *t, struct batches *a, const struct batches *b, bool paired, double planted,
                 const char *format, ...);

/* What a scene shows by some ways (set_method), compared one by one with what it shows by another, which is right. */
struct agreement {
    const char *scene;        /* a path without ".pbrt", or a scene's text */
    int width, height, depth; /* of a path: the film; maxdepth */
    const char *right, *ways; /* a comma between each two */
    int right_spp, spp;       /* of a batch */
    int batches, tile;        /* of a chain they are renders of their own; tiles are square */
    bool paired;              /* by one seed: the same eye sub-paths, and most noise is in common */
    double planted;           /* see check_agree */
};

/* check_agreements: n of them, with so many times as many samples. check_agreement_in: one, in a scene that is loaded
 * already and is called by the row's name; its settings are replaced. */
void check_agreements(struct test *t, const struct agreement *a, size_t n, int more);
void check_agreement_in(struct test *t, struct scene *scene, const struct agreement *a, int more);

#endif
