/* lobe_list.h: what rows of materials make their lobes from.
 *
 * Tests: test_material.c.
 */
#ifndef ASBDPT_LOBE_LIST_H
#define ASBDPT_LOBE_LIST_H

#include <stddef.h>

#include "material/material.h"

/* Fields that many rows have: of their own struct's member of colour; of struct material, named at once or by axis, and
 * the end of the table. */
#define COLOUR_FIELD(name, place, fallback) \
    {name, FIELD_RGB_TEXTURE, place, fallback, -MATERIAL_MAX_COLOUR, .high = MATERIAL_MAX_COLOUR}
#define ROUGHNESS_FIELD(name, axis, fallback) \
    {name, FIELD_FLOAT_TEXTURE, offsetof(struct material, rough.axis), fallback, .high = MATERIAL_MAX_ROUGHNESS}
#define ROUGHNESS_FIELDS(fallback) \
    ROUGHNESS_FIELD("roughness", u, fallback), ROUGHNESS_FIELD("roughness", v, fallback)
#define AXIS_FIELDS(fallback) \
    ROUGHNESS_FIELD("uroughness", u, fallback), ROUGHNESS_FIELD("vroughness", v, fallback)
#define REMAP_FIELD {"remaproughness", FIELD_SWITCH, offsetof(struct material, rough.remap), .fallback = 1}
#define LAST_FIELDS \
    {"bumpmap", FIELD_FLOAT_TEXTURE, offsetof(struct material, bump), .fallback = FIELD_KEPT}, {.name = NULL}

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

/* lobe_add: one more lobe, of scale 1 and without Fresnel's share. All else that its kind has is to be filled in:
 * lobe_dielectric: Fresnel's share at a boundary between two indices. lobe_rough: facets as rough as m. */
struct lobe *lobe_add(struct lobe_list *list, enum lobe_kind kind, rgb R, rgb T);
struct lobe *lobe_dielectric(struct lobe *l, double eta_a, double eta_b);
struct lobe *lobe_rough(struct lobe *l, const struct lobe_list *list, const struct material *m);

#endif
