/* microfacet.h: what happens at a boundary. A smooth one reflects a share and refracts the rest; a rough one consists
 * of smooth microfacets, whose normals have the distribution of Trowbridge and Reitz ("GGX") [Trowbridge & Reitz 1975].
 *
 * All directions are unit and, of rough boundaries, in the shading frame. The distribution is even in w -> -w, so both
 * sides of the surface are served. alpha_x and alpha_y are the roughnesses along x and y, > 0.
 *
 * Tests: test_lobe.c (normal incidence, total internal reflection, copper, Snell's law; the distribution).
 */
#ifndef ASBDPT_MICROFACET_H
#define ASBDPT_MICROFACET_H

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

/* microfacet_d: area of the facets whose normal is wh, per area of surface and per steradian, 1/sr.
 * The integral of D(wh) |cos(wh)| over a hemisphere is 1. */
double microfacet_d(vec3 wh, double alpha_x, double alpha_y);

/* microfacet_lambda: area of the facets hidden from w per area of visible ones [Smith 1967] [Heitz 2014].
 * Seen from w a share 1/(1 + lambda(w)) is visible; from wo and wi together 1/(1 + lambda(wo) + lambda(wi)). */
double microfacet_lambda(vec3 w, double alpha_x, double alpha_y);

/* microfacet_sample: the normal, on wo's side, of a facet drawn from those that wo sees, by the area it sees of
 * them [Heitz 2018], in the form of [Dupuy & Benyoub 2023]. wo.z != 0, (u1,u2) uniform in [0,1)^2.
 * Its density is D(wh) dot(wo,wh) / ((1 + lambda(wo)) |cos(wo)|), 1/sr, where dot(wo,wh) > 0, else 0. */
vec3 microfacet_sample(vec3 wo, double alpha_x, double alpha_y, double u1, double u2);

/* fresnel_schlick: what Schlick adds to the reflectance at normal incidence, of what is left to 1. fresnel_disney: the
 * share between a dielectric's and a metal's of this colour. [Burley 2012] */
double fresnel_schlick(double cosine);
rgb fresnel_disney(double cos_h, double eta_a, double eta_b, rgb colour, double metallic);

#endif
