/* services.h: techniques that improve any choice of light sub-paths. Each has one implementation that all pooled
 * methods share. Each is a parameter, so that one can measure the choice alone:
 *
 *   guide         s = 1 chooses lights by their contribution to a region (guide.h)
 *   emission      light sub-paths start in directions that the camera can use (emission.h)
 *   credit        direct light at the first hit counts as more samples in the weights than are taken (below)
 *   tile, spread  number of pixels that share a pool, and how far apart they are (tile_pass.h)
 *
 * The credit of direct light. The weights compare second moments as if all samples were independent (mis.h). The first
 * numbers of an eye sub-path are not: over the iterations of a pixel they are spread evenly (sampler.h), so the mean of
 * N samples of direct light has less than 1/N of the variance of one. Such a sample should count as E[X^2] / (N V_N)
 * samples, X its contribution and V_N the variance of the mean [Grittmann 2019]. For N = 16 that ratio is between 1 and
 * 64 in most scenes. One constant, 4, costs 3 % more squared error than measuring the ratio before each render, and
 * measuring it takes time and code.
 *
 * Tests: test_asbdpt.c, test_probe.c.
 */
#ifndef ASBDPT_SERVICES_H
#define ASBDPT_SERVICES_H

#include <stddef.h>

#include "integrators/method.h"
#include "learning/learn.h"

/* SERVICES: rows of a method's table of parameters, with these defaults; and single rows, for methods that use only
 * some of the services. */
#define SERVICES(GUIDE, EMISSION, CREDIT, TILE, SPREAD) \
    SERVICE_GUIDE(GUIDE), SERVICE_EMISSION(EMISSION), SERVICE_CREDIT(CREDIT), SERVICE_TILES(TILE, SPREAD)
#define SERVICE_GUIDE(DEFAULT) \
    {"guide", FIELD_WORD, offsetof(struct frozen, services.guide), DEFAULT, 0, 0, \
     "choose lights by what a region sees, where there are several", OFF_ON}
#define SERVICE_EMISSION(DEFAULT) \
    {"emission", FIELD_NUMBER, offsetof(struct frozen, services.emission), DEFAULT, 1e-6, 1, \
     "share of light sub-paths that leave lights as if nothing were learnt", NULL}
#define SERVICE_CREDIT(DEFAULT) \
    {"credit", FIELD_NUMBER, offsetof(struct frozen, services.credit), DEFAULT, 1e-3, 1e6, \
     "number of samples in the weights that one sample of direct light at the first hit counts as", NULL}
#define SERVICE_TILES(TILE, SPREAD) \
    {"tile", FIELD_INTEGER, offsetof(struct frozen, services.tile), TILE, 1, MAX_TILE_SIZE, \
     "pixels along a side of those that share a pool", NULL}, \
    {"spread", FIELD_INTEGER, offsetof(struct frozen, services.spread), SPREAD, 1, 64, \
     "tiles that are interleaved along each axis", NULL}
extern const char *const OFF_ON[];

/* services_learn: fill the tables that the services and the method itself need. From then on counts depend on them.
 *   own  tables that the method needs; this function sets guide, emission and eye_cells */
void services_learn(const struct render_job *job, struct preparation *out, struct learn_options own);

/* services_settle: compute the counts after everything else is fixed.
 *   draw  the credit of one draw, see struct credits */
void services_settle(const struct render_job *job, struct preparation *out, double draw);

/* services_trace_paths: are light sub-paths not worth their cost in this scene (probe.h)? Then prepare *out as a path
 * tracer, without learning, and return true. If a path tracer would miss light, keep a few light sub-paths and return
 * false. */
bool services_trace_paths(const struct render_job *job, struct preparation *out);

#endif
