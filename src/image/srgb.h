/* srgb.h: the transfer function of sRGB [IEC 61966-2-1], between linear light and the numbers of 8-bit pictures.
 *
 * Tests: test_image.c.
 */
#ifndef ASBDPT_SRGB_H
#define ASBDPT_SRGB_H

#include <stdint.h>

/* srgb_encode: linear [0,1] -> sRGB [0,1];  srgb_decode: its inverse. Negative numbers stay linear. */
double srgb_encode(double linear);
double srgb_decode(double encoded);

/* srgb_byte: the 8-bit value written for a linear number: clamp(255 encode(x) + 0.5); NaN gives 0. */
uint8_t srgb_byte(double linear);

#endif
