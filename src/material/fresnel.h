/* fresnel.h: what happens at a smooth boundary: how much is reflected, and where the rest goes.
 *
 * Tests: test_lobe.c (normal incidence, total internal reflection, copper, Snell's law).
 */
#ifndef ASBDPT_FRESNEL_H
#define ASBDPT_FRESNEL_H

#include <stdbool.h>

#include "base/rgb.h"
#include "base/vec.h"

/* fresnel_dielectric: unpolarised reflectance for a ray meeting the boundary at cos_i (signed: positive on the
 * eta_a side); 1 under total internal reflection. The same for both directions of the refracted path. */
double fresnel_dielectric(double cos_i, double eta_a, double eta_b);

/* fresnel_conductor: unpolarised reflectance of a metal of complex index eta + i k; the sign of cos_i is ignored. */
rgb fresnel_conductor(double cos_i, rgb eta, rgb k);

/* fresnel_refract: the direction of transmission, by Snell's law.
 *   wo   unit, pointing away from the boundary
 *   n    unit normal on wo's side
 *   eta  (index on wo's side)/(index on the other)
 *   wi   out: unit, pointing away on the other side
 * Returns false under total internal reflection. */
bool fresnel_refract(vec3 wo, vec3 n, double eta, vec3 *wi);

#endif
