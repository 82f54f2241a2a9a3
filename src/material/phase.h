/* phase.h: the phase function of a medium, as a material. */
#ifndef ASBDPT_PHASE_H
#define ASBDPT_PHASE_H

#include "material/lobe_list.h"

/* phase_new: Henyey and Greenstein's, -1 < g < 1; above 0: light rather goes on as it came. */
struct material *phase_new(double g);

#endif
