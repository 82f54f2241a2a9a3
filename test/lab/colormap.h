/* colormap.h: colours for numbers: viridis, which rises evenly in lightness and reads the same without one kind of
 * cone [Smith 2015].
 *
 * Tests: test_sheet.c.
 */
#ifndef ASBDPT_COLORMAP_H
#define ASBDPT_COLORMAP_H

#include <stdint.h>

/* Ten colours of the map at equal distances, sRGB bytes; between two of them it is linear in these. */
enum { VIRIDIS_STOPS = 10 };
extern const uint8_t VIRIDIS[VIRIDIS_STOPS][3];

/* viridis: the colour of t as linear light, ready for image_write; below 0 and NaN are as 0, above 1 as 1. */
void viridis(double t, float out[3]);

#endif
