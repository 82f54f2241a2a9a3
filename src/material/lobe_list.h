/* lobe_list.h: what rows of materials make their lobes from.
 *
 * Tests: test_material.c.
 */
#ifndef ASBDPT_LOBE_LIST_H
#define ASBDPT_LOBE_LIST_H

#include "material/material.h"

/* Roughness as most materials have it. */
struct roughness {
    int u, v;   /* float textures; v -1: as u, where a field says so */
    bool remap; /* they are what artists call rough, see roughness_to_alpha */
};

/* limited: x from low to high; NaN, which textures multiplied often enough can become, counts as `low`.
 * limited_rgb: the same for the three numbers of a reflectance. */
static inline double limited(double x, double low, double high) { return x > low ? (x < high ? x : high) : low; }
rgb limited_rgb(rgb c);

/* The value of a texture at the point: a reflectance, any number, one from 0 to 1, an index of refraction, a Disney
 * roughness. */
rgb colour_at(const struct lobe_list *list, int texture);
double number_at(const struct lobe_list *list, int texture);
double fraction_at(const struct lobe_list *list, int texture);
double index_at(const struct lobe_list *list, int texture);
double roughness_at(const struct lobe_list *list, int texture);

/* roughness_to_alpha: pbrt's artist-friendly remapping, used where `remap` is set. */
double roughness_to_alpha(double roughness);

/* roughness_differs: between u and v, or may do so. roughness_is_zero: at the point, in both directions. */
bool roughness_differs(const struct roughness *r, const struct texture_set *textures);
bool roughness_is_zero(const struct lobe_list *list, const struct roughness *r);

/* lobe_add: one more lobe, of scale 1 and without Fresnel's share. All else that its kind has is to be filled in:
 * lobe_dielectric: Fresnel's share at a boundary between two indices. lobe_rough: facets of this roughness. */
struct lobe *lobe_add(struct lobe_list *list, enum lobe_kind kind, rgb R, rgb T);
struct lobe *lobe_dielectric(struct lobe *l, double eta_a, double eta_b);
struct lobe *lobe_rough(struct lobe *l, const struct lobe_list *list, const struct roughness *r);

#endif
