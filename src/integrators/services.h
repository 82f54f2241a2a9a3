/* services.h: what makes any choice of light sub-paths better, whichever it is. Each is a parameter, so that
 * it can be measured what the choice alone brings, and has one implementation that all pooled methods share:
 *
 *   guide     s = 1 chooses lights by what a region sees (guide.h)
 *   emission  light sub-paths leave lights where the camera can use them (emission.h)
 *   credit    light that comes straight to the first hit counts for as much as it is worth (probe.h)
 *   pilot     how many samples of what is chosen by what a few tiles show (plan.h)
 *   tile, spread  how many pixels share a pool, and how far apart they lie (tile_pass.h)
 *
 * Tests: test_asbdpt.c, test_pilot.c.
 */
#ifndef ASBDPT_SERVICES_H
#define ASBDPT_SERVICES_H

#include <stddef.h>

#include "integrators/method.h"
#include "learning/learn.h"

/* SERVICES: their rows in a method's table of parameters, with these defaults; and single ones, for methods that have
 * no use for the others. */
#define SERVICES(GUIDE, EMISSION, CREDIT, PILOT, TILE, SPREAD) \
    SERVICE_GUIDE(GUIDE), SERVICE_EMISSION(EMISSION), SERVICE_CREDIT(CREDIT), SERVICE_PILOT(PILOT), \
    SERVICE_TILES(TILE, SPREAD)
#define SERVICE_GUIDE(DEFAULT) \
    {"guide", FIELD_WORD, offsetof(struct frozen, services.guide), DEFAULT, 0, 0, \
     "choose lights by what a region sees, where there are several", OFF_ON}
#define SERVICE_EMISSION(DEFAULT) \
    {"emission", FIELD_NUMBER, offsetof(struct frozen, services.emission), DEFAULT, 1e-6, 1, \
     "share of light sub-paths that leave lights as if nothing were learnt", NULL}
#define SERVICE_CREDIT(DEFAULT) \
    {"credit", FIELD_WORD, offsetof(struct frozen, services.credit), DEFAULT, 0, 0, \
     "measure what light that comes straight counts for", OFF_ON}
#define SERVICE_PILOT(DEFAULT) \
    {"pilot", FIELD_WORD, offsetof(struct frozen, services.pilot), DEFAULT, 0, 0, \
     "choose numbers of samples by what some tiles show", OFF_ON}
#define SERVICE_TILES(TILE, SPREAD) \
    {"tile", FIELD_INTEGER, offsetof(struct frozen, services.tile), TILE, 1, MAX_TILE_SIZE, \
     "pixels along a side of those that share a pool", NULL}, \
    {"spread", FIELD_INTEGER, offsetof(struct frozen, services.spread), SPREAD, 1, 64, \
     "tiles that are interleaved along each axis", NULL}
extern const char *const OFF_ON[];

/* services_paths_matter: is anything to be gained by light sub-paths, and so by learning? Asked of a few samples by
 * BDPT before anything is learnt, where the pilot is on and the user has not asked for them. If not, *out is settled: a
 * path tracer. */
bool services_paths_matter(const struct render_job *job, struct preparation *out);

/* services_learn: fill the tables with what services need and what the method itself wants, if that is anything; counts
 * go by them from then on.
 *   own  without guide and emission; eye_cells 0: the usual ones, on `levels` levels */
void services_learn(const struct render_job *job, struct preparation *out, struct learn_options own);

/* services_settle: credits and numbers, all else being settled. Of methods that draw (frozen.draws) draws and light
 * sub-paths are chosen, unless given; of all of them the light points. */
void services_settle(const struct render_job *job, struct preparation *out);

#endif
