/* medium_presets.h: media that have been measured, by the names that pbrt-v3 knows them by. */
#ifndef ASBDPT_MEDIUM_PRESETS_H
#define ASBDPT_MEDIUM_PRESETS_H

#include <stdbool.h>

#include "base/rgb.h"
#include "parser/symbols.h"

/* medium_preset: its coefficients, 1/mm, of scattering as if it were even. False, with neither changed, if the name is
 * of none; then all names have been offered to *near. */
bool medium_preset(const char *name, struct suggestion *near, rgb *sigma_s, rgb *sigma_a);

#endif
