/* burley.h: the formulas of the Disney BSDF [Burley 2012] [Burley 2015] that other materials do not have, as pbrt-v3's.
 * Directions are unit and in the shading frame.
 *
 * Tests: test_lobe.c, test_bsdf.c.
 */
#ifndef ASBDPT_BURLEY_H
#define ASBDPT_BURLEY_H

#include "base/rgb.h"
#include "base/vec.h"

/* disney_diffuse: what is diffuse, 1/sr: the colours of its four parts, weighed. wo.z, wi.z != 0. */
rgb disney_diffuse(rgb base, rgb flat, rgb retro, rgb sheen, double roughness, vec3 wo, vec3 wi);

/* disney_fresnel: the share that facets reflect, between a dielectric's and a metal's of this colour; cos_h as of
 * fresnel_dielectric. */
rgb disney_fresnel(double cos_h, rgb colour, double metallic, double eta_a, double eta_b);

/* disney_coat_d: area of the clear coat's facets of normal wh, per area of surface, 1/sr; alpha in (0,1). The integral
 * of D(wh) |cos(wh)| over a hemisphere is 1. disney_coat_sample: a normal with that density, of z >= 0. */
double disney_coat_d(vec3 wh, double alpha);
vec3 disney_coat_sample(double alpha, double u1, double u2);

/* disney_coat: the value of the clear coat, 1/sr; wo and wi on one side, wh half way between them. */
double disney_coat(double alpha, vec3 wo, vec3 wi, vec3 wh);

#endif
