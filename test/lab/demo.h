/* demo.h: methods at the same CPU time in one picture: what each made of a scene, side by side with the stored
 * reference, labelled with the root mean square of the errors of all 8-bit values.
 *
 * Where the reference is small, pictures may be rendered k times as wide and high: then the mean of k x k of their
 * pixels is compared with one of the reference. With a box filter both have the same expectation.
 *
 * Tests: test_pictures.c, test/cli.sh.
 */
#ifndef ASBDPT_DEMO_H
#define ASBDPT_DEMO_H

#include "lab/sheet.h"
#include "lab/equal_run.h"

struct demo {
    const char *scene, *reference; /* reference as in plan.h: file, directory, or NULL */
    struct methods methods;        /* the first one's time is what the others are given */
    long spp;                      /* of the first */
    int scale;                     /* k */
    int n_threads;
    uint64_t seed;
};

/* demo_run: render, compare, draw the picture. Clocks being restless and samples whole, all times are reported.
 *   out  [methods.n]
 * Returns false with a message, else `picture` is to be released with sheet_free. */
bool demo_run(const struct demo *demo, struct equal_render *out, struct sheet *picture, struct error *err);

#endif
