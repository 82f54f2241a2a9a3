/* material.c: see material.h: which lobes make which material [PBRT3 9.2]. */
#include "material/material.h"

#include <math.h>
#include <string.h>

#include "base/maths.h"

/* The lobes of a BSDF in the making, and what they are made from. */
struct lobe_list {
    const struct material *materials;
    const struct texture_set *textures;
    const struct surface *at;
    struct lobe lobe[MATERIAL_MAX_LOBES];
    int n;
};

struct material material_blank(enum material_kind kind)
{
    struct material m = {.kind = kind, .remap_roughness = true};
    m.Kd = m.Ks = m.Kr = m.Kt = m.sigma = m.eta = m.k = m.index = m.uroughness = m.vroughness = -1;
    m.opacity = m.reflect = m.transmit = m.amount = m.mix1 = m.mix2 = m.bump = -1;
    m.disney.metallic = m.disney.specular_tint = m.disney.anisotropic = m.disney.sheen = m.disney.sheen_tint = -1;
    m.disney.clearcoat = m.disney.clearcoat_gloss = m.disney.transmission = m.disney.scatter_distance = -1;
    m.disney.flatness = m.disney.diffuse_transmission = m.table = -1;
    return m;
}

/* --- parameters -------------------------------------------------------------------------------------- */

/* NaN, which textures multiplied often enough can become, counts as 0. */
static double limited(double x, double low, double high) { return x > low ? (x < high ? x : high) : low; }

static rgb clamped(rgb c)
{
    const double most = MATERIAL_MAX_COLOUR;
    return rgb_make(limited(c.r, 0, most), limited(c.g, 0, most), limited(c.b, 0, most));
}

/* A colour, a number at the point in question. */
static rgb colour(const struct lobe_list *list, int texture)
{
    return clamped(texture_rgb(list->textures, texture, list->at));
}
static double number(const struct lobe_list *list, int texture)
{
    return texture_float(list->textures, texture, list->at);
}

static double fraction(const struct lobe_list *list, int texture) { return limited(number(list, texture), 0, 1); }

static double refraction(const struct lobe_list *list, const struct material *m)
{
    return limited(number(list, m->index), MATERIAL_MIN_INDEX, MATERIAL_MAX_INDEX);
}

/* The polynomial is pbrt's fit in x = ln(roughness). [PBRT3 8.4.2] */
double roughness_to_alpha(double roughness)
{
    double x = m_log(fmax(roughness, 1e-3));
    return 1.62142 + x * (0.819955 + x * (0.1734 + x * (0.0171201 + x * 0.000640711)));
}

/* --- lobes ------------------------------------------------------------------------------------------- */

static struct lobe lobe_of(enum lobe_kind kind, rgb R, rgb T)
{
    struct lobe l = {.kind = kind, .fresnel = FRESNEL_NONE, .scale = rgb_grey(1), .R = R, .T = T};
    return l;
}

static struct lobe dielectric(struct lobe l, double eta_a, double eta_b)
{
    l.fresnel = FRESNEL_DIELECTRIC;
    l.eta_a = eta_a;
    l.eta_b = eta_b;
    return l;
}

static struct lobe rough(const struct lobe_list *list, const struct material *m, struct lobe l)
{
    const double least = 1e-3; /* below, facets are a mirror to any purpose and their density overflows squares */
    double u = limited(number(list, m->uroughness), 0, MATERIAL_MAX_ROUGHNESS);
    double v = limited(number(list, m->vroughness), 0, MATERIAL_MAX_ROUGHNESS);
    l.alpha_x = fmax(least, m->remap_roughness ? roughness_to_alpha(u) : u);
    l.alpha_y = fmax(least, m->remap_roughness ? roughness_to_alpha(v) : v);
    return l;
}

/* Append a lobe; a black one is dropped. */
static void add_lobe(struct lobe_list *list, struct lobe l)
{
    if (list->n < MATERIAL_MAX_LOBES && lobe_albedo_guess(&l) > 0)
        list->lobe[list->n++] = l;
}

/* --- materials --------------------------------------------------------------------------------------- */

static void add_matte(struct lobe_list *list, const struct material *m)
{
    double sigma = limited(number(list, m->sigma), 0, 90) * (PI / 180), sigma2 = sigma * sigma;
    struct lobe l = lobe_of(sigma == 0 ? LOBE_LAMBERT_REFLECTION : LOBE_OREN_NAYAR, colour(list, m->Kd), rgb_black());
    l.A = 1 - sigma2 / (2 * (sigma2 + 0.33));
    l.B = 0.45 * sigma2 / (sigma2 + 0.09);
    add_lobe(list, l);
}

static void add_glass(struct lobe_list *list, const struct material *m)
{
    rgb R = colour(list, m->Kr), T = colour(list, m->Kt), none = rgb_black();
    double eta = refraction(list, m);
    bool smooth = number(list, m->uroughness) == 0 && number(list, m->vroughness) == 0;
    if (smooth || eta == 1) { /* where nothing refracts, facets do not scatter either, however rough */
        add_lobe(list, dielectric(lobe_of(LOBE_FRESNEL_SPECULAR, R, T), 1, eta));
        return;
    }
    add_lobe(list, rough(list, m, dielectric(lobe_of(LOBE_MICROFACET_REFLECTION, R, none), 1, eta)));
    add_lobe(list, rough(list, m, dielectric(lobe_of(LOBE_MICROFACET_TRANSMISSION, none, T), 1, eta)));
}

static void add_metal(struct lobe_list *list, const struct material *m)
{
    struct lobe l = rough(list, m, lobe_of(LOBE_MICROFACET_REFLECTION, rgb_grey(1), rgb_black()));
    l.fresnel = FRESNEL_CONDUCTOR;
    l.eta = colour(list, m->eta);
    l.k = colour(list, m->k);
    add_lobe(list, l);
}

/* pbrt-v3 has the two indices of the coat the wrong way round: from outside its light seems to leave glass of 1.5
 * and is totally reflected from 41.8 degrees on. Its images of plastic are what its users know, so we do the same.
 */
static void add_plastic(struct lobe_list *list, const struct material *m)
{
    add_lobe(list, lobe_of(LOBE_LAMBERT_REFLECTION, colour(list, m->Kd), rgb_black()));
    struct lobe coat = lobe_of(LOBE_MICROFACET_REFLECTION, colour(list, m->Ks), rgb_black());
    add_lobe(list, rough(list, m, dielectric(coat, 1.5, 1)));
}

static void add_uber(struct lobe_list *list, const struct material *m)
{
    rgb opacity = colour(list, m->opacity), clear = clamped(rgb_sub(rgb_grey(1), opacity)), none = rgb_black();
    double eta = refraction(list, m);
    add_lobe(list, dielectric(lobe_of(LOBE_SPECULAR_TRANSMISSION, none, clear), 1, 1));
    add_lobe(list, lobe_of(LOBE_LAMBERT_REFLECTION, rgb_mul(opacity, colour(list, m->Kd)), none));
    rgb Ks = rgb_mul(opacity, colour(list, m->Ks));
    add_lobe(list, rough(list, m, dielectric(lobe_of(LOBE_MICROFACET_REFLECTION, Ks, none), 1, eta)));
    rgb Kr = rgb_mul(opacity, colour(list, m->Kr)), Kt = rgb_mul(opacity, colour(list, m->Kt));
    add_lobe(list, dielectric(lobe_of(LOBE_SPECULAR_REFLECTION, Kr, none), 1, eta));
    add_lobe(list, dielectric(lobe_of(LOBE_SPECULAR_TRANSMISSION, none, Kt), 1, eta));
}

static void add_translucent(struct lobe_list *list, const struct material *m)
{
    const double eta = 1.5;
    rgb up = colour(list, m->reflect), down = colour(list, m->transmit), none = rgb_black();
    rgb Kd = colour(list, m->Kd), Ks = colour(list, m->Ks);
    add_lobe(list, lobe_of(LOBE_LAMBERT_REFLECTION, rgb_mul(up, Kd), none));
    add_lobe(list, lobe_of(LOBE_LAMBERT_TRANSMISSION, none, rgb_mul(down, Kd)));
    add_lobe(list, rough(list, m, dielectric(lobe_of(LOBE_MICROFACET_REFLECTION, rgb_mul(up, Ks), none), 1, eta)));
    add_lobe(list, rough(list, m, dielectric(lobe_of(LOBE_MICROFACET_TRANSMISSION, none, rgb_mul(down, Ks)), 1, eta)));
}

static rgb blend(double t, rgb a, rgb b) { return rgb_add(rgb_scale(a, 1 - t), rgb_scale(b, t)); }

/* What is diffuse of it, of colour c, and has this share of the whole. */
static void add_disney_diffuse(struct lobe_list *list, const struct material *m, double whole, rgb c, rgb tint)
{
    bool beneath = !m->disney.thin && !rgb_is_black(colour(list, m->disney.scatter_distance));
    double sheen = limited(number(list, m->disney.sheen), 0, MATERIAL_MAX_COLOUR);
    struct lobe l = lobe_of(LOBE_DISNEY_DIFFUSE, beneath ? rgb_black() : c, rgb_black());
    l.scale = rgb_grey(whole);
    l.A = limited(number(list, m->uroughness), 0, MATERIAL_MAX_ROUGHNESS);
    l.eta = c;
    l.k = rgb_scale(blend(fraction(list, m->disney.sheen_tint), rgb_grey(1), tint), sheen);
    if (m->disney.thin) {
        double flat = fraction(list, m->disney.flatness);
        rgb reflected = rgb_scale(c, 1 - 0.5 * limited(number(list, m->disney.diffuse_transmission), 0, 2));
        l.R = rgb_scale(reflected, 1 - flat);
        l.T = rgb_scale(reflected, flat);
    }
    add_lobe(list, l);
    struct lobe below = lobe_of(LOBE_SPECULAR_TRANSMISSION, rgb_black(), rgb_grey(beneath));
    add_lobe(list, dielectric(below, 1, refraction(list, m)));
}

/* Roughnesses along and across, as Disney remaps them. */
static struct lobe disney_rough(const struct lobe_list *list, const struct material *m, double roughness, struct lobe l)
{
    double aspect = sqrt(1 - 0.9 * fraction(list, m->disney.anisotropic));
    l.alpha_x = fmax(1e-3, sqr(roughness) / aspect);
    l.alpha_y = fmax(1e-3, sqr(roughness) * aspect);
    return l;
}

static void add_disney(struct lobe_list *list, const struct material *m)
{
    rgb c = colour(list, m->Kd), white = rgb_grey(1), none = rgb_black();
    rgb tint = rgb_luminance(c) > 0 ? rgb_scale(c, 1 / rgb_luminance(c)) : white;
    double eta = refraction(list, m), roughness = limited(number(list, m->uroughness), 0, MATERIAL_MAX_ROUGHNESS);
    double metallic = fraction(list, m->disney.metallic), through = fraction(list, m->disney.transmission);
    double base = (1 - metallic) * (1 - through);
    if (base > 0)
        add_disney_diffuse(list, m, base, c, tint);
    struct lobe facets = lobe_of(LOBE_MICROFACET_REFLECTION, white, none);
    facets = disney_rough(list, m, roughness, dielectric(facets, 1, eta));
    facets.fresnel = FRESNEL_DISNEY;
    facets.separate = true;
    facets.A = metallic;
    rgb plain = rgb_scale(blend(fraction(list, m->disney.specular_tint), white, tint), sqr((eta - 1) / (eta + 1)));
    facets.eta = blend(metallic, plain, c);
    add_lobe(list, facets);
    struct lobe coat = lobe_of(LOBE_CLEARCOAT, rgb_grey(number(list, m->disney.clearcoat)), none);
    coat.R = clamped(coat.R);
    coat.alpha_x = 0.1 - (0.1 - 0.001) * fraction(list, m->disney.clearcoat_gloss);
    add_lobe(list, coat);
    /* Two refractions bring the colour. Thin ones scatter less, as the index does. [Burley 2015] */
    rgb T = rgb_scale(rgb_make(sqrt(c.r), sqrt(c.g), sqrt(c.b)), through);
    double refracted = m->disney.thin ? (0.65 * eta - 0.35) * roughness : roughness;
    struct lobe glass = dielectric(lobe_of(LOBE_MICROFACET_TRANSMISSION, none, T), 1, eta);
    glass.separate = !m->disney.thin;
    add_lobe(list, disney_rough(list, m, refracted, glass));
    double behind = 0.5 * limited(number(list, m->disney.diffuse_transmission), 0, 2);
    if (m->disney.thin)
        add_lobe(list, lobe_of(LOBE_LAMBERT_TRANSMISSION, none, rgb_scale(c, behind)));
}

static void add_material(struct lobe_list *list, int id);

/* The lobes of both materials, those of the first times `amount`, those of the second times the rest. */
static void add_mix(struct lobe_list *list, const struct material *m)
{
    rgb share = colour(list, m->amount);
    for (int branch = 0; branch < 2; branch++) {
        int first = list->n;
        add_material(list, branch == 0 ? m->mix1 : m->mix2);
        int end = list->n;
        list->n = first;
        for (int i = first; i < end; i++) { /* added again, scaled: what is now black is dropped */
            struct lobe l = list->lobe[i];
            l.scale = rgb_mul(l.scale, share);
            add_lobe(list, l);
        }
        share = clamped(rgb_sub(rgb_grey(1), share));
    }
}

static void add_material(struct lobe_list *list, int id)
{
    const struct material *m = &list->materials[id];
    switch (m->kind) {
    case MATERIAL_MATTE: add_matte(list, m); break;
    case MATERIAL_MIRROR: add_lobe(list, lobe_of(LOBE_SPECULAR_REFLECTION, colour(list, m->Kr), rgb_black())); break;
    case MATERIAL_GLASS: add_glass(list, m); break;
    case MATERIAL_METAL: add_metal(list, m); break;
    case MATERIAL_PLASTIC: add_plastic(list, m); break;
    case MATERIAL_SUBSTRATE:
        add_lobe(list, rough(list, m, lobe_of(LOBE_FRESNEL_BLEND, colour(list, m->Kd), colour(list, m->Ks))));
        break;
    case MATERIAL_UBER: add_uber(list, m); break;
    case MATERIAL_TRANSLUCENT: add_translucent(list, m); break;
    case MATERIAL_DISNEY: add_disney(list, m); break;
    case MATERIAL_FOURIER: {
        struct lobe l = lobe_of(LOBE_FOURIER, rgb_grey(1), rgb_black());
        l.table = &list->textures->table[m->table];
        add_lobe(list, l);
        break;
    }
    case MATERIAL_MIX: add_mix(list, m); break;
    }
}

int material_lobes(const struct material *materials, int id)
{
    const struct material *m = &materials[id];
    switch (m->kind) {
    case MATERIAL_MATTE:
    case MATERIAL_MIRROR:
    case MATERIAL_METAL:
    case MATERIAL_FOURIER:
    case MATERIAL_SUBSTRATE: return 1;
    case MATERIAL_GLASS:
    case MATERIAL_PLASTIC: return 2;
    case MATERIAL_TRANSLUCENT: return 4;
    case MATERIAL_DISNEY:
    case MATERIAL_UBER: return 5;
    case MATERIAL_MIX: return material_lobes(materials, m->mix1) + material_lobes(materials, m->mix2);
    }
    return 0;
}

/* --- bump maps --------------------------------------------------------------------------------------- */

/* Texture coordinates by which the displacement is differenced: pbrt-v3's choice for rays without differentials. */
static const double BUMP_STEP = 0.0005;

/* The displacement a step away from the point. */
static double displaced(const struct texture_set *textures, int id, const struct surface *at, double du, double dv)
{
    struct surface shifted = *at;
    shifted.p = add(at->p, add(mul(at->dpdu, du), mul(at->dpdv, dv)));
    shifted.u = at->u + du;
    shifted.v = at->v + dv;
    return texture_float(textures, id, &shifted);
}

/* Partial derivative of the displaced point p + d ns: dp + (dd) ns + d (dns). */
static vec3 partial(vec3 dp, vec3 dn, vec3 ns, double d, double d_shifted)
{
    return add(add(dp, mul(ns, (d_shifted - d) / BUMP_STEP)), mul(dn, d));
}

struct frame bump_frame(const struct texture_set *textures, int displacement, const struct surface *at)
{
    double d = texture_float(textures, displacement, at);
    vec3 dpdu = partial(at->dpdu, at->dndu, at->ns, d, displaced(textures, displacement, at, BUMP_STEP, 0));
    vec3 dpdv = partial(at->dpdv, at->dndv, at->ns, d, displaced(textures, displacement, at, 0, BUMP_STEP));
    vec3 n = normalize(cross(dpdu, dpdv));
    if (!(fabs(length2(n) - 1) < 1e-6)) /* zero, NaN, or lost in under- or overflow */
        return frame_from_tangent(at->ns, at->dpdu);
    return frame_from_tangent(faceforward(n, at->ng), dpdu);
}

/* The bump map that counts: a mix shades with the frame of its first material. */
static int bump_of(const struct material *materials, int id)
{
    while (materials[id].kind == MATERIAL_MIX)
        id = materials[id].mix1;
    return materials[id].bump;
}

bool material_reads_partials(const struct material *materials, int id, const struct texture_set *textures)
{
    const struct material *m = &materials[id];
    if (m->kind == MATERIAL_MIX || m->kind == MATERIAL_DISNEY || m->bump >= 0)
        return true;
    if (m->uroughness == m->vroughness)
        return false;
    const struct texture *u = &textures->texture[m->uroughness], *v = &textures->texture[m->vroughness];
    return u->kind != TEXTURE_CONSTANT || v->kind != TEXTURE_CONSTANT || u->constant.r != v->constant.r;
}

void material_bsdf(const struct material *materials, int id, const struct texture_set *textures,
                   const struct surface *at, struct arena *arena, struct bsdf *out)
{
    struct lobe_list list;
    list.materials = materials;
    list.textures = textures;
    list.at = at;
    list.n = 0;
    add_material(&list, id);
    size_t size = (size_t)list.n * sizeof list.lobe[0];
    struct lobe *lobe = list.n > 0 ? memcpy(arena_alloc(arena, size), list.lobe, size) : NULL;
    int bump = bump_of(materials, id);
    struct frame shading = bump >= 0 ? bump_frame(textures, bump, at) : frame_from_tangent(at->ns, at->dpdu);
    bsdf_make(out, shading, at->ng, lobe, list.n);
}
