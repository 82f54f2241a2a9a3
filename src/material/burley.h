/* burley.h: the lobes of the Disney BSDF that other materials do not have [Burley 2012] [Burley 2015], as pbrt-v3's:
 * what is diffuse, and the clear coat.
 *
 * Tests: test_lobe.c, test_bsdf.c.
 */
#ifndef ASBDPT_BURLEY_H
#define ASBDPT_BURLEY_H

#include "material/lobe.h"

extern const struct lobe_form form_disney, form_coat;

#endif
