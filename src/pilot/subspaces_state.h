/* subspaces_state.h: the state of `select = subspaces` (integrators/subspaces.c), which the pilot completes. */
#ifndef ASBDPT_SUBSPACES_STATE_H
#define ASBDPT_SUBSPACES_STATE_H

#include "tables/tables.h"
#include "transport/pixel_sample.h"

struct subspaces_state {
    struct frozen frozen;         /* lights and path_pixels are the pilot's to choose */
    int connections;              /* parameter: draws for each eye vertex; 0: chosen */
    double draws[EYE_ENDS];       /* C */
    double delta, emission;
    struct tables tables;
};

#endif
