/* material.h: from a material and a surface point to a BSDF. Parameters, defaults and formulas are pbrt-v3's.
 * Tests: test_material.c.
 */
#ifndef ASBDPT_MATERIAL_H
#define ASBDPT_MATERIAL_H

#include <stdbool.h>

#include "base/mem.h"
#include "geometry/surface.h"
#include "material/bsdf.h"
#include "material/texture.h"

enum material_kind {
    MATERIAL_MATTE,       /* Kd, sigma */
    MATERIAL_MIRROR,      /* Kr */
    MATERIAL_GLASS,       /* Kr, Kt, index, uroughness, vroughness */
    MATERIAL_METAL,       /* eta, k, roughness */
    MATERIAL_PLASTIC,     /* Kd, Ks, roughness */
    MATERIAL_SUBSTRATE,   /* Kd, Ks, roughness */
    MATERIAL_UBER,        /* Kd, Ks, Kr, Kt, roughness, index, opacity */
    MATERIAL_TRANSLUCENT, /* Kd, Ks, reflect, transmit, roughness */
    MATERIAL_DISNEY,      /* Kd, index, uroughness and those of its own */
    MATERIAL_FOURIER,     /* table */
    MATERIAL_MIX          /* mix1, mix2, amount */
};

/* All parameters but `table` are texture numbers; -1 where a kind does not use one. The parser fills in defaults. */
struct material {
    enum material_kind kind;
    int Kd, Ks, Kr, Kt;
    int sigma;                  /* degrees */
    int eta, k;                 /* metal */
    int index;                  /* dielectric index of refraction */
    int uroughness, vroughness; /* always both set where used ("roughness" sets both) */
    bool remap_roughness;
    int opacity, reflect, transmit, amount;
    struct {
        int metallic, specular_tint, anisotropic, sheen, sheen_tint, clearcoat, clearcoat_gloss, transmission;
        int scatter_distance; /* what is beneath begins where it is not black; not there if thin */
        bool thin;
        int flatness, diffuse_transmission; /* of thin ones; the transmission from 0 to 2 */
    } disney;
    int table; /* of the texture set */
    int mix1, mix2; /* numbers of materials that were made before */
    int bump;       /* float texture of displacement along the normal, in world units */
};

/* material_blank: a material without parameters. */
struct material material_blank(enum material_kind kind);

/* The most lobes a BSDF can have, counted over all branches of nested mixes. */
enum { MATERIAL_MAX_LOBES = 16 };

/* What parameters may be. The parser refuses what is the same everywhere and beyond; what textures vary is limited
 * to it. */
#define MATERIAL_MAX_COLOUR 1e6 /* reflectances, eta and k of metals */
#define MATERIAL_MIN_INDEX 0.01
#define MATERIAL_MAX_INDEX 100.0
#define MATERIAL_MAX_ROUGHNESS 1e3

/* material_lobes: the most lobes the BSDF of material `id` can have. The parser refuses mixes of more than
 * MATERIAL_MAX_LOBES, so that none is made of such. */
int material_lobes(const struct material *materials, int id);

/* material_reads_partials: whether the BSDFs of material `id` depend on dpdu, dpdv, dndu or dndv: by a bump map, or by
 * a roughness that differs between u and v. May say so of one that does not. */
bool material_reads_partials(const struct material *materials, int id, const struct texture_set *textures);

/* material_bsdf: the BSDF of material `id` at a point.
 *   materials, textures  the scene's
 *   at     the surface point; bump mapping tilts the shading frame, `at` itself is not changed
 *   arena  where the lobes live
 *   out    filled; n_lobes = 0 for a black surface
 * Negative colours count as 0. The frame of a mix is its first material's, as in pbrt-v3. Lobes beyond
 * MATERIAL_MAX_LOBES are left out. */
void material_bsdf(const struct material *materials, int id, const struct texture_set *textures,
                   const struct surface *at, struct arena *arena, struct bsdf *out);

/* bump_frame: the shading frame of the surface p + d(u,v) ns [Blinn 1978], as pbrt-v3 finds it [PBRT3 9.3].
 *   displacement  float texture number, world units
 *   at            its dpdu, dpdv are the partials that shading uses
 * The normal lies on ng's side. Falls back to the smooth frame where the displaced surface has no normal. */
struct frame bump_frame(const struct texture_set *textures, int displacement, const struct surface *at);

/* roughness_to_alpha: pbrt's artist-friendly remapping, used when remap_roughness is set. */
double roughness_to_alpha(double roughness);

#endif
