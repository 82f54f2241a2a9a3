/* plain.h: preparing methods whose own choice learns nothing. */
#ifndef ASBDPT_PLAIN_H
#define ASBDPT_PLAIN_H

#include "integrators/services.h"

/* plain_prepare: what services need, and credits and numbers by it. */
static inline void plain_prepare(const struct render_job *job, struct preparation *out)
{
    const struct learn_options nothing = {.light_cells = 64, .levels = 1};
    services_learn(job, out, nothing);
    services_settle(job, out, 1);
}

#endif
