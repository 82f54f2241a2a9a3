/* matte.c: a diffuse surface: Lambert's, or a rough one by Oren and Nayar. [PBRT3 9.2.1] */
#include "material/lobe_list.h"

struct matte {
    struct material is;
    int Kd, sigma; /* sigma: the spread of its slopes, degrees */
};

static void lobes(struct lobe_list *list, const struct material *m)
{
    const struct matte *matte = (const struct matte *)m;
    double sigma = limited(number_at(list, matte->sigma), 0, 90) * (PI / 180), sigma2 = sigma * sigma;
    struct lobe *l = lobe_add(list, sigma == 0 ? LOBE_LAMBERT_REFLECTION : LOBE_OREN_NAYAR,
                              colour_at(list, matte->Kd), rgb_black());
    l->of.oren_nayar.A = 1 - sigma2 / (2 * (sigma2 + 0.33));
    l->of.oren_nayar.B = 0.45 * sigma2 / (sigma2 + 0.09);
}

#define AT(member) offsetof(struct matte, member)
static const struct field FIELDS[] = {
    COLOUR_FIELD("Kd", AT(Kd), 0.5),
    {"sigma", .kind = FIELD_FLOAT_TEXTURE, .place = AT(sigma)},
    LAST_FIELDS};

const struct material_row material_matte = {
    .name = "matte", .fields = FIELDS, .size = sizeof(struct matte), .most_lobes = 1, .lobes = lobes};
