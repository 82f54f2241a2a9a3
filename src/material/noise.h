/* noise.h: Perlin's gradient noise and the patterns that pbrt-v3 makes of it [PBRT3 10.6]. All of them are functions of
 * a point of texture space. Noise is 0 where that is not finite.
 *
 * pbrt-v3 leaves out octaves finer than the pixel where it knows its size, which is where camera rays arrive. Here all
 * octaves are always summed, as pbrt-v3 does everywhere else; pixel samples do the filtering.
 *
 * Tests: test_texture.c.
 */
#ifndef ASBDPT_NOISE_H
#define ASBDPT_NOISE_H

#include "base/rgb.h"
#include "base/vec.h"

enum { NOISE_MAX_OCTAVES = 64 };

/* noise: gradient noise [Perlin 2002]: from -1 to 1, 0 at points of whole numbers, of period 256 along each axis. */
double noise(vec3 p);

/* noise_fbm: a sum of octaves: noise at 1.99 times the frequency and omega times the weight of the one before. */
double noise_fbm(vec3 p, double omega, int octaves);

/* noise_turbulence: the same of |noise|, plus 0.2, which is about its mean, for one octave more. */
double noise_turbulence(vec3 p, double omega, int octaves);

/* noise_waves: waves on water, 6 octaves high, where gusts of wind, 10 times as wide, raise them. */
double noise_waves(vec3 p);

/* noise_in_dot: whether the point (s,t) is in a dot. About two in five unit squares, with whole numbers in their
 * centres, have one, of radius 0.35 and somewhere in the square. */
bool noise_in_dot(double s, double t);

/* noise_marble: the colour of marble: layers across y, distorted by `variation` times the noise. */
rgb noise_marble(vec3 p, double omega, int octaves, double variation);

#endif
