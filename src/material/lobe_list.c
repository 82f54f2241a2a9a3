/* lobe_list.c: see lobe_list.h. */
#include "material/lobe_list.h"

#include <math.h>

#include "base/maths.h"

rgb limited_rgb(rgb c)
{
    const double most = MATERIAL_MAX_COLOUR;
    return rgb_make(limited(c.r, 0, most), limited(c.g, 0, most), limited(c.b, 0, most));
}

rgb colour_at(const struct lobe_list *list, int texture)
{
    return limited_rgb(texture_rgb(list->textures, texture, list->at));
}

double number_at(const struct lobe_list *list, int texture)
{
    return texture_float(list->textures, texture, list->at);
}

double fraction_at(const struct lobe_list *list, int texture) { return limited(number_at(list, texture), 0, 1); }

double index_at(const struct lobe_list *list, int texture)
{
    return limited(number_at(list, texture), MATERIAL_MIN_INDEX, MATERIAL_MAX_INDEX);
}

double roughness_at(const struct lobe_list *list, int texture)
{
    return limited(number_at(list, texture), 0, MATERIAL_MAX_ROUGHNESS);
}

/* The polynomial is pbrt's fit in x = ln(roughness). [PBRT3 8.4.2] */
double roughness_to_alpha(double roughness)
{
    double x = m_log(fmax(roughness, 1e-3));
    return 1.62142 + x * (0.819955 + x * (0.1734 + x * (0.0171201 + x * 0.000640711)));
}

struct lobe *lobe_add(struct lobe_list *list, enum lobe_kind kind, rgb R, rgb T)
{
    struct lobe *l = &list->lobe[list->n++];
    *l = (struct lobe){.kind = kind, .fresnel = FRESNEL_NONE, .scale = rgb_grey(1), .R = R, .T = T};
    return l;
}

struct lobe *lobe_dielectric(struct lobe *l, double eta_a, double eta_b)
{
    l->fresnel = FRESNEL_DIELECTRIC;
    l->eta_a = eta_a;
    l->eta_b = eta_b;
    return l;
}

struct lobe *lobe_rough(struct lobe *l, const struct lobe_list *list, const struct material *m)
{
    const double least = 1e-3; /* below, facets are a mirror to any purpose and their density overflows squares */
    double u = roughness_at(list, m->rough.u), v = roughness_at(list, m->rough.v);
    l->alpha_x = fmax(least, m->rough.remap ? roughness_to_alpha(u) : u);
    l->alpha_y = fmax(least, m->rough.remap ? roughness_to_alpha(v) : v);
    return l;
}
