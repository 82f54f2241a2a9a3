/* simple.c: the materials whose lobes follow from a few colours and numbers, as pbrt-v3 has them [PBRT3 9.2], each a
 * function and a row; and how a medium scatters. */
#include "material/fourier.h"
#include "material/lobe_list.h"

/* Textures, of which each kind uses some. */
struct simple {
    struct material is;
    int Kd, Ks, Kr, Kt, opacity, reflect, transmit, amount, eta, k; /* colours */
    int sigma, index;                                               /* numbers */
    int part[2];                                                    /* of mix: materials made before */
    const struct fourier_table *table;                              /* of fourier: the scene's */
    double g;                                                       /* of a medium */
};

#define AT(member) offsetof(struct simple, member)

/* A diffuse surface: Lambert's, or a rough one by Oren and Nayar, whose slopes spread by sigma degrees. */
static void matte(struct lobe_list *list, const struct material *m)
{
    const struct simple *s = (const struct simple *)m;
    double sigma = limited(number_at(list, s->sigma), 0, 90) * (PI / 180), sigma2 = sigma * sigma;
    struct lobe *l = lobe_add(list, sigma == 0 ? LOBE_LAMBERT_REFLECTION : LOBE_OREN_NAYAR,
                              colour_at(list, s->Kd), rgb_black());
    l->of.oren_nayar.A = 1 - sigma2 / (2 * (sigma2 + 0.33));
    l->of.oren_nayar.B = 0.45 * sigma2 / (sigma2 + 0.09);
}

static const struct field MATTE[] = {
    COLOUR_FIELD("Kd", AT(Kd), 0.5), {"sigma", .kind = FIELD_FLOAT_TEXTURE, .place = AT(sigma)}, LAST_FIELDS};

const struct material_row material_matte = {
    .name = "matte", .fields = MATTE, .size = sizeof(struct simple), .most_lobes = 1, .diffuse = true, .lobes = matte};

/* A smooth mirror of one reflectance at all angles. */
static void mirror(struct lobe_list *list, const struct material *m)
{
    lobe_add(list, LOBE_SPECULAR_REFLECTION, colour_at(list, ((const struct simple *)m)->Kr), rgb_black());
}

static const struct field MIRROR[] = {COLOUR_FIELD("Kr", AT(Kr), 0.9), LAST_FIELDS};

const struct material_row material_mirror = {.name = "mirror", .fields = MIRROR, .size = sizeof(struct simple),
                                             .most_lobes = 1, .may_be_delta = true, .lobes = mirror};

/* Facets of a conductor. Without an index it is copper: pbrt-v3's default, its tabulated spectra reduced to RGB. */
static void metal(struct lobe_list *list, const struct material *m)
{
    static const rgb ETA = {0.199990, 0.922086, 1.099876}, K = {3.904638, 2.447633, 2.137651};
    const struct simple *s = (const struct simple *)m;
    struct lobe *l = lobe_add(list, LOBE_MICROFACET_REFLECTION, rgb_grey(1), rgb_black());
    lobe_rough(l, list, m);
    l->fresnel = FRESNEL_CONDUCTOR;
    l->of.conductor.eta = s->eta < 0 ? ETA : colour_at(list, s->eta);
    l->of.conductor.k = s->k < 0 ? K : colour_at(list, s->k);
}

static const struct field METAL[] = {
    COLOUR_FIELD("eta", AT(eta), FIELD_KEPT), COLOUR_FIELD("k", AT(k), FIELD_KEPT),
    ROUGHNESS_FIELDS(0.01), AXIS_FIELDS(FIELD_KEPT), REMAP_FIELD, LAST_FIELDS};

const struct material_row material_metal = {
    .name = "metal", .fields = METAL, .size = sizeof(struct simple), .most_lobes = 1, .lobes = metal};

/* A diffuse base under facets of a dielectric coat. pbrt-v3 has the two indices of the coat the wrong way round: from
 * outside its light seems to leave glass of 1.5 and is totally reflected from 41.8 degrees on. Its images of plastic
 * are what its users know, so we do the same. */
static void plastic(struct lobe_list *list, const struct material *m)
{
    const struct simple *s = (const struct simple *)m;
    lobe_add(list, LOBE_LAMBERT_REFLECTION, colour_at(list, s->Kd), rgb_black());
    struct lobe *coat = lobe_add(list, LOBE_MICROFACET_REFLECTION, colour_at(list, s->Ks), rgb_black());
    lobe_rough(lobe_dielectric(coat, 1.5, 1), list, m);
}

static const struct field PLASTIC[] = {
    COLOUR_FIELD("Kd", AT(Kd), 0.25), COLOUR_FIELD("Ks", AT(Ks), 0.25),
    ROUGHNESS_FIELDS(0.1), REMAP_FIELD, LAST_FIELDS};

const struct material_row material_plastic = {
    .name = "plastic", .fields = PLASTIC, .size = sizeof(struct simple), .most_lobes = 2, .lobes = plastic};

/* A diffuse base under a glossy coat, in one lobe. [Ashikhmin & Shirley 2000] */
static void substrate(struct lobe_list *list, const struct material *m)
{
    const struct simple *s = (const struct simple *)m;
    struct lobe *l = lobe_add(list, LOBE_FRESNEL_BLEND, colour_at(list, s->Kd), rgb_black());
    lobe_rough(l, list, m);
    l->of.coat = colour_at(list, s->Ks);
}

static const struct field SUBSTRATE[] = {
    COLOUR_FIELD("Kd", AT(Kd), 0.5), COLOUR_FIELD("Ks", AT(Ks), 0.5),
    AXIS_FIELDS(0.1), REMAP_FIELD, LAST_FIELDS};

const struct material_row material_substrate = {
    .name = "substrate", .fields = SUBSTRATE, .size = sizeof(struct simple), .most_lobes = 1, .lobes = substrate};

/* A bit of everything: diffuse, glossy, mirror, refraction, and holes by opacity. */
static void uber(struct lobe_list *list, const struct material *m)
{
    const struct simple *s = (const struct simple *)m;
    rgb opacity = colour_at(list, s->opacity), clear = limited_rgb(rgb_sub(rgb_grey(1), opacity)), none = rgb_black();
    rgb Kd = rgb_mul(opacity, colour_at(list, s->Kd)), Ks = rgb_mul(opacity, colour_at(list, s->Ks));
    rgb Kr = rgb_mul(opacity, colour_at(list, s->Kr)), Kt = rgb_mul(opacity, colour_at(list, s->Kt));
    double eta = index_at(list, s->index);
    lobe_dielectric(lobe_add(list, LOBE_SPECULAR_TRANSMISSION, none, clear), 1, 1);
    lobe_add(list, LOBE_LAMBERT_REFLECTION, Kd, none);
    lobe_rough(lobe_dielectric(lobe_add(list, LOBE_MICROFACET_REFLECTION, Ks, none), 1, eta), list, m);
    lobe_dielectric(lobe_add(list, LOBE_SPECULAR_REFLECTION, Kr, none), 1, eta);
    lobe_dielectric(lobe_add(list, LOBE_SPECULAR_TRANSMISSION, none, Kt), 1, eta);
}

/* Without "vroughness" v is as u, be u "uroughness": pbrt's uber differs from its metal. */
static const struct field UBER[] = {
    COLOUR_FIELD("Kd", AT(Kd), 0.25), COLOUR_FIELD("Ks", AT(Ks), 0.25),
    COLOUR_FIELD("Kr", AT(Kr), 0), COLOUR_FIELD("Kt", AT(Kt), 0),
    {"index", FIELD_FLOAT_TEXTURE, AT(index), 1.5, MATERIAL_MIN_INDEX, .high = MATERIAL_MAX_INDEX},
    {"eta", FIELD_FLOAT_TEXTURE, AT(index), FIELD_KEPT, MATERIAL_MIN_INDEX, .high = MATERIAL_MAX_INDEX},
    COLOUR_FIELD("opacity", AT(opacity), 1),
    ROUGHNESS_FIELD("roughness", u, 0.1), AXIS_FIELDS(FIELD_KEPT), REMAP_FIELD, LAST_FIELDS};

const struct material_row material_uber = {.name = "uber", .fields = UBER, .size = sizeof(struct simple),
                                           .most_lobes = 5, .may_be_delta = true, .lobes = uber};

/* Diffuse and glossy on both sides. */
static void translucent(struct lobe_list *list, const struct material *m)
{
    const double eta = 1.5;
    const struct simple *s = (const struct simple *)m;
    rgb up = colour_at(list, s->reflect), down = colour_at(list, s->transmit), none = rgb_black();
    rgb Kd = colour_at(list, s->Kd), Ks = colour_at(list, s->Ks);
    lobe_add(list, LOBE_LAMBERT_REFLECTION, rgb_mul(up, Kd), none);
    lobe_add(list, LOBE_LAMBERT_TRANSMISSION, none, rgb_mul(down, Kd));
    struct lobe *above = lobe_add(list, LOBE_MICROFACET_REFLECTION, rgb_mul(up, Ks), none);
    lobe_rough(lobe_dielectric(above, 1, eta), list, m);
    struct lobe *below = lobe_add(list, LOBE_MICROFACET_TRANSMISSION, none, rgb_mul(down, Ks));
    lobe_rough(lobe_dielectric(below, 1, eta), list, m);
}

static const struct field TRANSLUCENT[] = {
    COLOUR_FIELD("Kd", AT(Kd), 0.25), COLOUR_FIELD("Ks", AT(Ks), 0.25),
    COLOUR_FIELD("reflect", AT(reflect), 0.5), COLOUR_FIELD("transmit", AT(transmit), 0.5),
    ROUGHNESS_FIELDS(0.1), REMAP_FIELD, LAST_FIELDS};

const struct material_row material_translucent = {
    .name = "translucent", .fields = TRANSLUCENT, .size = sizeof(struct simple), .most_lobes = 4,
    .lobes = translucent};

/* The lobes of two materials, those of the first times `amount`, those of the second times the rest. */
static void mix(struct lobe_list *list, const struct material *m)
{
    const struct simple *s = (const struct simple *)m;
    rgb share = colour_at(list, s->amount);
    for (int branch = 0; branch < 2; branch++) {
        const struct material *part = list->materials[s->part[branch]];
        int first = list->n;
        part->row->lobes(list, part);
        for (struct lobe *l = list->lobe + first; l < list->lobe + list->n; l++)
            l->scale = rgb_mul(l->scale, share);
        share = limited_rgb(rgb_sub(rgb_grey(1), share));
    }
}

static const struct field MIX[] = {
    {"namedmaterial1", .kind = FIELD_PART, .place = AT(part[0])},
    {"namedmaterial2", .kind = FIELD_PART, .place = AT(part[1])},
    COLOUR_FIELD("amount", AT(amount), 0.5), {.name = NULL}};

const struct material_row material_mix = {
    .name = "mix", .fields = MIX, .size = sizeof(struct simple), .diffuse = true, .lobes = mix, .may_be_brushed = true};

/* A layered material that is a table. */
static void fourier(struct lobe_list *list, const struct material *m)
{
    struct lobe *l = lobe_add(list, LOBE_FORM, rgb_grey(1), rgb_black());
    l->form = &form_fourier;
    l->of.table = ((const struct simple *)m)->table;
}

static const struct field FOURIER[] = {{"bsdffile", .kind = FIELD_TABLE, .place = AT(table)}, LAST_FIELDS};

const struct material_row material_fourier = {
    .name = "fourier", .fields = FOURIER, .size = sizeof(struct simple), .most_lobes = 1, .lobes = fourier};

/* A medium, wherever it scatters: no material of scene files. [PBRT3 11.2] */
static void medium(struct lobe_list *list, const struct material *m)
{
    lobe_add(list, LOBE_PHASE, rgb_grey(1), rgb_black())->of.g = ((const struct simple *)m)->g;
}

struct material *material_medium(double g)
{
    static const struct field NONE[] = {{.name = NULL}};
    static const struct material_row ROWS[] = {
        {.name = "medium", .fields = NONE, .size = sizeof(struct simple), .most_lobes = 1, .lobes = medium,
         .diffuse = true},
        {.name = "sharp", .fields = NONE, .size = sizeof(struct simple), .most_lobes = 1, .lobes = medium}};
    /* at 0.8 light that goes straight on is 45 times that of g = 0 */
    struct material *m = material_new(&ROWS[!(fabs(g) <= 0.8)]);
    ((struct simple *)m)->g = g;
    return m;
}
