/* texture.h: numbers and colours that vary over a surface.
 *
 * Every material parameter is a texture, most of them constant. Image maps are looked up bilinearly in the finest
 * level: pixel samples do the filtering. Textures of space and some mappings see a point through the current transform
 * at the texture's definition.
 *
 * Tests: test_texture.c.
 */
#ifndef ASBDPT_TEXTURE_H
#define ASBDPT_TEXTURE_H

#include <stddef.h>

#include "base/error.h"
#include "base/rgb.h"
#include "base/transform.h"
#include "geometry/surface.h"
#include "image/image.h"

/* Which point (s,t) of a two-dimensional texture lies at a point of a surface [PBRT3 10.2]. */
enum mapping_kind {
    MAPPING_UV,          /* s = su u + du, t = sv v + dv, of the surface's own u and v */
    MAPPING_SPHERICAL,   /* s: angle from the z axis of texture space over pi, t: azimuth over 2 pi */
    MAPPING_CYLINDRICAL, /* s: half a turn plus azimuth over 2 pi, t: cosine of that angle, as pbrt-v3 has it */
    MAPPING_PLANAR       /* s = p v1 + du, t = p v2 + dv, of the point's position in the world */
};

/* What a kind does not use is 0. */
struct mapping {
    enum mapping_kind kind;
    int space; /* spherical, cylindrical: which of the set's transforms takes the texture's space to the world */
    double su, sv, du, dv;
    vec3 v1, v2;
};

enum texture_kind {
    TEXTURE_CONSTANT,
    TEXTURE_SCALE,        /* tex1 * tex2 */
    TEXTURE_MIX,          /* (1-amount) tex1 + amount tex2 */
    TEXTURE_CHECKERBOARD, /* tex1 on even, tex2 on odd squares of floor(s), floor(t) */
    TEXTURE_CUBES,        /* the same in space: cubes of floor(x), floor(y), floor(z) */
    TEXTURE_IMAGEMAP,
    TEXTURE_BILERP,
    TEXTURE_UV,           /* red and green are the fractions of s and t; colours only */
    TEXTURE_DOTS,         /* tex1 in dots, tex2 around them */
    TEXTURE_FBM,          /* this and the next three: see noise.h */
    TEXTURE_WRINKLED,
    TEXTURE_WINDY,
    TEXTURE_MARBLE        /* colours only */
};

enum texture_wrap { WRAP_REPEAT, WRAP_BLACK, WRAP_CLAMP };

enum { TEXTURE_MAX_COST = 256 }; /* the parser refuses textures built from more, and builds nothing from them */

/* One texture; which fields matter depends on kind. */
struct texture {
    enum texture_kind kind;
    int cost; /* textures that one look-up visits, itself included, and octaves of noise; set by texture_add */
    rgb constant;
    int tex1, tex2;               /* scale, mix, checkerboard, cubes, dots: texture numbers */
    int amount;                   /* mix: a texture number */
    struct mapping map;           /* checkerboard, dots, imagemap, bilerp, uv */
    int space;                    /* cubes and textures of noise */
    int octaves;                  /* fbm, wrinkled, marble; else 0. The same have omega */
    double omega, variation;      /* variation, scale: marble */
    double scale;                 /* imagemap, too */
    int image;                    /* imagemap: index into the scene's images */
    bool gamma;                   /* imagemap: decode sRGB */
    enum texture_wrap wrap;       /* imagemap */
    rgb v00, v01, v10, v11;       /* bilerp */
};

/* Textures and the images they use. The images are shared between textures that name the same file. */
struct texture_set {
    struct texture *texture; /* [n_textures], owned */
    struct transform *space; /* [n_spaces], owned: the current transform where a texture was defined */
    struct image *image;     /* [n_images], owned */
    int n_textures, n_spaces, n_images;
    vec3 origin;             /* of world space: textures see the coordinates of the scene file */
};

/* texture_add: append a texture; returns its number. Textures it names must have been added before.
 * texture_add_constant: the same for one value. */
int texture_add(struct texture_set *set, struct texture t);
int texture_add_constant(struct texture_set *set, rgb value);

/* texture_add_space: append a texture's current transform; returns its number. */
int texture_add_space(struct texture_set *set, struct transform current);

/* texture_load_image: the number of an image that is read from this file, which may use this memory; -1 with a message.
 * texture_add_grey: that of one pixel of 0.5, light or sRGB, in place of a file.
 * texture_set_free: releases all images, textures and transforms; the set is empty and usable again. */
int texture_load_image(struct texture_set *set, const char *path, const struct budget *memory, struct error *err);
int texture_add_grey(struct texture_set *set, bool linear);
void texture_set_free(struct texture_set *set);

/* texture_rgb, texture_float: the value at a surface point; may be negative, infinite or NaN. `id`: a valid texture
 * number. A float texture of a colour picture is the luminance of the stored values, decoded afterwards if `gamma` is
 * set, as in pbrt-v3. Cannot fail, thread-safe. */
rgb texture_rgb(const struct texture_set *set, int id, const struct surface *at);
double texture_float(const struct texture_set *set, int id, const struct surface *at);

/* image_bilinear: the picture at (s,t), (0,0) being the lower left corner, texel centres at half-integers,
 * as pbrt-v3's MIPMap::Lookup at width 0; texels are decoded (`gamma`) before they are mixed. Also used by
 * environment maps. (pbrt-v3 first resamples a picture whose sides are no powers of two; this does not.) */
rgb image_bilinear(const struct image *img, double s, double t, enum texture_wrap wrap, bool gamma);

#endif
