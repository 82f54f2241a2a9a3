/* services.h: what makes any choice of light sub-paths better, whichever it is. Each is a parameter, so that
 * it can be measured what the choice alone brings, and has one implementation that all pooled methods share:
 *
 *   guide     s = 1 chooses lights by what a region sees (guide.h)
 *   emission  light sub-paths leave lights where the camera can use them (emission.h)
 *   credit    direct light at the first hit counts in the weights as many samples as it is worth (probe.h)
 *   tile, spread  how many pixels share a pool, and how far apart they lie (tile_pass.h)
 *
 * Tests: test_asbdpt.c, test_probe.c.
 */
#ifndef ASBDPT_SERVICES_H
#define ASBDPT_SERVICES_H

#include <stddef.h>

#include "integrators/method.h"
#include "learning/learn.h"

/* SERVICES: their rows in a method's table of parameters, with these defaults; and single ones, for methods that have
 * no use for the others. */
#define SERVICES(GUIDE, EMISSION, CREDIT, TILE, SPREAD) \
    SERVICE_GUIDE(GUIDE), SERVICE_EMISSION(EMISSION), SERVICE_CREDIT(CREDIT), SERVICE_TILES(TILE, SPREAD)
#define SERVICE_GUIDE(DEFAULT) \
    {"guide", FIELD_WORD, offsetof(struct frozen, services.guide), DEFAULT, 0, 0, \
     "choose lights by what a region sees, where there are several", OFF_ON}
#define SERVICE_EMISSION(DEFAULT) \
    {"emission", FIELD_NUMBER, offsetof(struct frozen, services.emission), DEFAULT, 1e-6, 1, \
     "share of light sub-paths that leave lights as if nothing were learnt", NULL}
#define SERVICE_CREDIT(DEFAULT) \
    {"credit", FIELD_WORD, offsetof(struct frozen, services.credit), DEFAULT, 0, 0, \
     "measure how many samples direct light counts as in the weights", OFF_ON}
#define SERVICE_TILES(TILE, SPREAD) \
    {"tile", FIELD_INTEGER, offsetof(struct frozen, services.tile), TILE, 1, MAX_TILE_SIZE, \
     "pixels along a side of those that share a pool", NULL}, \
    {"spread", FIELD_INTEGER, offsetof(struct frozen, services.spread), SPREAD, 1, 64, \
     "tiles that are interleaved along each axis", NULL}
extern const char *const OFF_ON[];

/* services_learn: fill the tables with what services need and what the method itself wants, if that is anything; counts
 * go by them from then on.
 *   own  without guide and emission; eye_cells 0: the usual ones, on `levels` levels */
void services_learn(const struct render_job *job, struct preparation *out, struct learn_options own);

/* services_settle: the counts, all else being known. The credit of direct light is measured if the user wants that;
 * otherwise, and for draws, `credits` hold. */
void services_settle(const struct render_job *job, struct preparation *out, struct credits credits);

/* services_trace_paths: is this a scene for a path tracer (probe.h)? If so, *out is settled as one, with nothing
 * learnt. Where a path tracer would miss light a few light sub-paths remain, and false is returned. */
bool services_trace_paths(const struct render_job *job, struct preparation *out);

#endif
