/* spectrum.h: colours given by wavelength, as linear RGB; files of them.
 *
 * The renderer works in RGB; spectra of a scene file are reduced to it once, as pbrt-v3 does when it is built for
 * RGB: integrate against the CIE 1931 matching functions, then the matrix of sRGB's primaries. The matching
 * functions are sums of a few Gaussians with unequal flanks [Wyman 2013], within about 1 % of the tables.
 *
 * An .spd file holds pairs of wavelength and value. As in pbrt-v3 [pbrt-v3 core/floatfile.cpp] a number ends at any
 * character that it cannot have, # begins a comment, and other text is passed over, with a warning for the first of
 * each line.
 *
 * Tests: test_parser.c. */
#ifndef ASBDPT_SPECTRUM_H
#define ASBDPT_SPECTRUM_H

#include <stddef.h>

#include "base/rgb.h"
#include "parser/messages.h"

/* spectrum_from_xyz: CIE XYZ to linear RGB with the primaries and white point of sRGB (may be negative). */
rgb spectrum_from_xyz(double x, double y, double z);

/* spectrum_from_samples: the colour of a spectrum given at some wavelengths, linear in between and constant beyond.
 *   sample  [n][2]: wavelength in nm, value; sorted by this function if it is not; n >= 1
 * A constant spectrum of value v gives Y = v (not grey in RGB: sRGB's white is D65, not the equal-energy one). */
rgb spectrum_from_samples(double (*sample)[2], int n);

/* spectrum_blackbody: Planck's radiator of that temperature in kelvin, its spectrum scaled to a peak of `scale`;
 * black for a temperature <= 0. */
rgb spectrum_blackbody(double kelvin, double scale);

/* spd_numbers: the *n numbers of an .spd file, to be given to free(); *at: where the last one is. */
double *spd_numbers(struct messages *m, struct source_file *file, struct source_position *at, size_t *n);

#endif
