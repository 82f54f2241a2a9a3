/* material.h: from a material and a surface point to a BSDF. Parameters, defaults and formulas are pbrt-v3's.
 *
 * A material is one row of material_rows; lobe_list.h has what rows make their lobes with.
 *
 * Tests: test_material.c, test_format.c.
 */
#ifndef ASBDPT_MATERIAL_H
#define ASBDPT_MATERIAL_H

#include <stdbool.h>

#include "base/field.h"
#include "base/mem.h"
#include "geometry/surface.h"
#include "material/bsdf.h"
#include "material/texture.h"

/* A material of a scene: the first member of a row's own struct, from which the row's fields are counted. */
struct material {
    const struct material_row *row;
    int bump;       /* float texture of displacement along the normal, in world units; -1: none */
    int most_lobes; /* of its BSDF, counted over all branches of nested mixes */
    struct bsdf same; /* its BSDF except the frame, where no texture varies; `lobe` NULL: not known to be so */
    bool reads_uv, reads_partials; /* its BSDF depends on u and v; on dpdu, dpdv, dndu or dndv */
    struct {
        int u, v;   /* float textures, -1: it has none; v -1 where a field says so: as u */
        bool remap; /* they are what artists call rough, see roughness_to_alpha */
    } rough;
};

/* The lobes of a BSDF in the making. */
struct lobe_list {
    struct material *const *materials; /* the scene's */
    const struct texture_set *textures;
    const struct surface *at; /* the point in question */
    struct lobe *lobe;        /* [n], with room for the material's most_lobes */
    int n;
};

struct material_row {
    const char *name;           /* Material "name" */
    const struct field *fields; /* ended by one without a name */
    size_t size;                /* of the struct to be filled */
    int most_lobes;             /* that it has itself, besides those of its FIELD_PARTs */
    bool may_be_delta;          /* may one of these be a mirror, or smooth glass? */
    bool diffuse;               /* none of these can be sharp */
    bool may_be_brushed;        /* may they depend on where u and v run, be `rough` as it may? */
    /* Add the lobes; a black one may be among them. */
    void (*lobes)(struct lobe_list *list, const struct material *m);
    /* Would light go on beneath its surface, where none goes here? The parser says so. NULL: it would not. */
    bool (*is_deep)(const struct material *m, const struct texture_set *textures);
};

/* All rows, ended by NULL. */
extern const struct material_row *const material_rows[];

/* The most lobes a material may have. */
enum { MATERIAL_MAX_LOBES = 16 };

/* What parameters may be. The parser refuses what is the same everywhere and beyond; what textures vary is limited
 * to it. Negative colours count as 0: colours of a file that sRGB has not got have some. */
#define MATERIAL_MAX_COLOUR 1e6 /* reflectances, eta and k of metals */
#define MATERIAL_MIN_INDEX 0.01
#define MATERIAL_MAX_INDEX 100.0
#define MATERIAL_MAX_ROUGHNESS 1e3

/* material_new: a material whose fields are to be filled in, its textures -1; to be given to free(). */
struct material *material_new(const struct material_row *row);

/* material_medium: one that scatters as Henyey and Greenstein's medium, -1 < g < 1; above 0: light rather goes on as it
 * came. */
struct material *material_medium(double g);

/* material_settle: to be called when they are: what follows from them, and from the materials that it is made of. A mix
 * shades with the frame of its first one, as in pbrt-v3. */
void material_settle(struct material *m, struct material *const *materials);

/* material_prepare: find out what the BSDF of material `id` depends on, and make its lobes in `arena`, once for all
 * points, if no texture varies. Materials of lower numbers have been prepared. Without it, all is read everywhere. */
void material_prepare(struct material *const *materials, int id, const struct texture_set *textures,
                      struct arena *arena);

/* material_bsdf: the BSDF of material `id` at a point.
 *   materials, textures  the scene's
 *   at     the surface point; bump mapping tilts the shading frame, `at` itself is not changed
 *   arena  where the lobes live
 *   out    filled; n_lobes = 0 for a black surface */
void material_bsdf(struct material *const *materials, int id, const struct texture_set *textures,
                   const struct surface *at, struct arena *arena, struct bsdf *out);

/* bump_frame: the shading frame of the surface p + d(u,v) ns [Blinn 1978], as pbrt-v3 finds it [PBRT3 9.3].
 *   displacement  float texture number, world units
 *   at            its dpdu, dpdv are the partials that shading uses
 * The normal lies on ng's side. Falls back to the smooth frame where the displaced surface has no normal. */
struct frame bump_frame(const struct texture_set *textures, int displacement, const struct surface *at);

#endif
