/* learnt.h: what a pre-pass has found out about the scene, frozen before the first light sub-path of the render is
 * traced. */
#ifndef ASBDPT_GUIDING_LEARNT_H
#define ASBDPT_GUIDING_LEARNT_H

#include <stdbool.h>

#include "guiding/guide.h"
#include "guiding/pairs.h"

struct learnt {
    struct regions eye, light; /* where eye vertices and light vertices lie */
    struct guide guide;        /* how s = 1 chooses lights, by eye region */
    struct pairs pairs;        /* how s >= 2 chooses light vertices, by both */
    bool guided, paired;       /* are there a guide and pairs? */
};

static inline void learnt_free(struct learnt *l)
{
    regions_free(&l->eye);
    regions_free(&l->light);
    guide_free(&l->guide);
    pairs_free(&l->pairs);
}

#endif
