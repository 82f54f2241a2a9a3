/* demo.h: two integrators, the same CPU time, one picture: what each made of a scene, side by side with the stored
 * reference, labelled with the root mean square of the errors of all 8-bit values.
 *
 * Where the reference is small, pictures may be rendered k times as wide and high: then the mean of k x k of their
 * pixels is compared with one of the reference. With a box filter both have the same expectation.
 *
 * Tests: test_pictures.c, test/cli.sh.
 */
#ifndef ASBDPT_DEMO_H
#define ASBDPT_DEMO_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "image/sheet.h"
#include "integrators/method.h"

enum { DEMO_SIDES = 2 };

struct demo {
    const char *scene, *reference; /* reference as in plan.h: file, directory, or NULL */
    const char *integrator[DEMO_SIDES]; /* with their defaults; the first one's time counts */
    long spp;                                        /* of the first */
    int scale;                                       /* k */
    int n_threads;
    uint64_t seed;
    bool quiet;
};

/* What came of each. */
struct demo_side {
    long spp;
    double seconds; /* of CPU, preparation included */
    double rmse8;   /* on the scale of the reference */
};

/* demo_run: render both, compare, draw the picture. The second is given the samples that take it as long as the first
 * took; clocks being restless and samples whole, both times are reported. Returns false with a message, else `picture`
 * is to be released with sheet_free. */
bool demo_run(const struct demo *demo, struct demo_side out[DEMO_SIDES], struct sheet *picture, struct error *err);

#endif
