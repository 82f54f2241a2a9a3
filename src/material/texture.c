/* texture.c: see texture.h. The kinds and their parameters are those of pbrt-v3 [PBRT3 10.2-10.6]. */
#include "material/texture.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "base/maths.h"
#include "base/mem.h"
#include "material/noise.h"

/* --- the set ----------------------------------------------------------------------------------------- */

int texture_add(struct texture_set *set, struct texture t)
{
    bool two = t.kind == TEXTURE_SCALE || t.kind == TEXTURE_MIX || t.kind == TEXTURE_CHECKERBOARD ||
               t.kind == TEXTURE_CUBES || t.kind == TEXTURE_DOTS;
    t.cost = 1 + t.octaves + (two ? set->texture[t.tex1].cost + set->texture[t.tex2].cost : 0) +
             (t.kind == TEXTURE_MIX ? set->texture[t.amount].cost : 0);
    set->texture = mem_append(set->texture, (size_t)set->n_textures, sizeof *set->texture);
    set->texture[set->n_textures] = t;
    return set->n_textures++;
}

int texture_add_constant(struct texture_set *set, rgb value)
{
    struct texture t = {.kind = TEXTURE_CONSTANT, .constant = value};
    return texture_add(set, t);
}

int texture_add_space(struct texture_set *set, struct transform current)
{
    set->space = mem_append(set->space, (size_t)set->n_spaces, sizeof *set->space);
    set->space[set->n_spaces] = current;
    return set->n_spaces++;
}

static int add_image(struct texture_set *set, struct image img)
{
    set->image = mem_append(set->image, (size_t)set->n_images, sizeof *set->image);
    set->image[set->n_images] = img;
    return set->n_images++;
}

int texture_add_grey(struct texture_set *set, bool linear)
{
    struct image img;
    picture_alloc_f32(&img, 1, 1, 1);
    img.f32[0] = 0.5f;
    img.linear = linear;
    return add_image(set, img);
}

int texture_load_image(struct texture_set *set, const char *path, const struct budget *memory, struct error *err)
{
    struct image img;
    if (!image_read(path, memory, &img, err))
        return -1;
    image_mend(&img, false);
    return add_image(set, img);
}

void texture_set_free(struct texture_set *set)
{
    for (int i = 0; i < set->n_images; i++)
        image_free(&set->image[i]);
    free(set->texture);
    free(set->space);
    free(set->image);
    memset(set, 0, sizeof *set);
}

/* --- pictures ---------------------------------------------------------------------------------------- */

/* Column or row number `i`, a whole number of any size but finite, after wrapping: 0 <= result < n, or -1 for black. */
static int wrap_index(double i, int n, enum texture_wrap wrap)
{
    if (i >= 0 && i < n)
        return (int)i;
    switch (wrap) {
    case WRAP_REPEAT: i -= n * floor(i / n); break;
    case WRAP_BLACK: return -1;
    case WRAP_CLAMP: break;
    }
    return (int)clamp(i, 0, n - 1);
}

/* The texels around a point of a picture: index of each, or -1 for black, and its weight. */
struct corners {
    ptrdiff_t texel[4];
    double weight[4];
};

/* A point that is not finite has no texels around it. */
static struct corners find_corners(const struct image *img, double s, double t, enum texture_wrap wrap)
{
    struct corners c = {{-1, -1, -1, -1}, {0, 0, 0, 0}};
    double x = s * img->width - 0.5, y = t * img->height - 0.5;
    if (!isfinite(x) || !isfinite(y))
        return c;
    double x0 = floor(x), y0 = floor(y), dx = x - x0, dy = y - y0;
    const int column[2] = {wrap_index(x0, img->width, wrap), wrap_index(x0 + 1, img->width, wrap)};
    const int row[2] = {wrap_index(y0, img->height, wrap), wrap_index(y0 + 1, img->height, wrap)};
    for (int k = 0; k < 4; k++) {
        int i = column[k % 2], j = row[k / 2];
        if (i >= 0 && j >= 0)
            c.texel[k] = (ptrdiff_t)(img->height - 1 - j) * img->width + i; /* rows are stored from the top */
        c.weight[k] = (k % 2 ? dx : 1 - dx) * (k / 2 ? dy : 1 - dy);
    }
    return c;
}

/* One stored sample as a number, 0..1 for bytes. */
static double stored(const struct image *img, ptrdiff_t i)
{
    return img->u8 != NULL ? img->u8[i] / 255.0 : img->f32[i];
}

static double decoded(const struct image *img, ptrdiff_t i, bool gamma)
{
    if (!gamma)
        return stored(img, i);
    return img->u8 != NULL ? img->decode[img->u8[i]] : srgb_decode(img->f32[i]);
}

static rgb texel_rgb(const struct image *img, ptrdiff_t texel, bool gamma)
{
    if (img->channels == 1)
        return rgb_grey(decoded(img, texel, gamma));
    ptrdiff_t i = texel * 3;
    return rgb_make(decoded(img, i, gamma), decoded(img, i + 1, gamma), decoded(img, i + 2, gamma));
}

/* The number a float texture sees: luminance first, then decoding. */
static rgb texel_grey(const struct image *img, ptrdiff_t texel, bool gamma)
{
    if (img->channels == 1)
        return rgb_grey(decoded(img, texel, gamma));
    double y = rgb_luminance(texel_rgb(img, texel, false));
    return rgb_grey(gamma ? srgb_decode(y) : y);
}

typedef rgb texel_reader(const struct image *img, ptrdiff_t texel, bool gamma);

static rgb bilinear(const struct image *img, double s, double t, enum texture_wrap wrap, bool gamma, texel_reader *read)
{
    struct corners c = find_corners(img, s, t, wrap);
    rgb sum = rgb_black();
    for (int k = 0; k < 4; k++)
        if (c.texel[k] >= 0)
            sum = rgb_add(sum, rgb_scale(read(img, c.texel[k], gamma), c.weight[k]));
    return sum;
}

rgb image_bilinear(const struct image *img, double s, double t, enum texture_wrap wrap, bool gamma)
{
    return bilinear(img, s, t, wrap, gamma, texel_rgb);
}

/* --- mappings ---------------------------------------------------------------------------------------- */

/* (s, t, 0); may be NaN where coordinates are. */
static vec3 map_point(const struct texture_set *set, const struct mapping *m, const struct surface *at)
{
    vec3 p = add(at->p, set->origin);
    switch (m->kind) {
    case MAPPING_UV: return vec(m->su * at->u + m->du, m->sv * at->v + m->dv, 0);
    case MAPPING_SPHERICAL: {
        vec3 w = normalize(transform_point_back(&set->space[m->space], p));
        double turns = m_atan2(w.y, w.x) / (2 * PI);
        return vec(m_acos(clamp(w.z, -1, 1)) / PI, turns < 0 ? turns + 1 : turns, 0);
    }
    case MAPPING_CYLINDRICAL: {
        vec3 w = normalize(transform_point_back(&set->space[m->space], p));
        return vec(0.5 + m_atan2(w.y, w.x) / (2 * PI), w.z, 0);
    }
    case MAPPING_PLANAR: return vec(dot(p, m->v1) + m->du, dot(p, m->v2) + m->dv, 0);
    }
    return vec(0, 0, 0);
}

/* --- values ------------------------------------------------------------------------------------------ */

static rgb mix(rgb a, rgb b, double amount) { return rgb_add(rgb_scale(a, 1 - amount), rgb_scale(b, amount)); }

/* The point that a texture sees. Of those of space, pbrt-v3, and so its scenes, takes the world for the texture's own
 * space and applies the current transform to it, not its inverse, as the mappings do. [pbrt-v3 textures/fbm.cpp] */
static vec3 point_of(const struct texture_set *set, const struct texture *t, const struct surface *at)
{
    bool in_space = t->kind == TEXTURE_CUBES || t->kind >= TEXTURE_FBM; /* and what follows: noise */
    return in_space ? transform_point(&set->space[t->space], add(at->p, set->origin)) : map_point(set, &t->map, at);
}

static rgb noise_value(const struct texture *t, vec3 p)
{
    double omega = t->omega;
    int octaves = t->octaves;
    if (t->kind == TEXTURE_MARBLE)
        return noise_marble(mul(p, t->scale), omega, octaves, t->variation);
    return rgb_grey(t->kind == TEXTURE_FBM        ? noise_fbm(p, omega, octaves)
                    : t->kind == TEXTURE_WRINKLED ? noise_turbulence(p, omega, octaves)
                                                  : noise_waves(p));
}

/* A float texture is a grey one, except for the way in which it reads images. */
static rgb evaluate(const struct texture_set *set, int id, const struct surface *at, texel_reader *read)
{
    assert(id >= 0 && id < set->n_textures);
    const struct texture *t = &set->texture[id];
    if (t->kind == TEXTURE_CONSTANT)
        return t->constant;
    vec3 p = point_of(set, t, at);
    switch (t->kind) {
    case TEXTURE_CONSTANT: break;
    case TEXTURE_SCALE:
        return rgb_mul(evaluate(set, t->tex1, at, read), evaluate(set, t->tex2, at, read));
    case TEXTURE_MIX:
        return mix(evaluate(set, t->tex1, at, read), evaluate(set, t->tex2, at, read),
                   texture_float(set, t->amount, at));
    case TEXTURE_CHECKERBOARD:
    case TEXTURE_CUBES: {
        bool even = fmod(floor(p.x) + floor(p.y) + floor(p.z), 2) == 0;
        return evaluate(set, even ? t->tex1 : t->tex2, at, read);
    }
    case TEXTURE_DOTS: return evaluate(set, noise_in_dot(p.x, p.y) ? t->tex1 : t->tex2, at, read);
    case TEXTURE_IMAGEMAP:
        return rgb_scale(bilinear(&set->image[t->image], p.x, p.y, t->wrap, t->gamma, read), t->scale);
    case TEXTURE_BILERP: return mix(mix(t->v00, t->v10, p.x), mix(t->v01, t->v11, p.x), p.y);
    case TEXTURE_UV: return rgb_make(p.x - floor(p.x), p.y - floor(p.y), 0);
    case TEXTURE_FBM:
    case TEXTURE_WRINKLED:
    case TEXTURE_WINDY:
    case TEXTURE_MARBLE: return noise_value(t, p);
    }
    return rgb_black();
}

rgb texture_rgb(const struct texture_set *set, int id, const struct surface *at)
{
    return evaluate(set, id, at, texel_rgb);
}

double texture_float(const struct texture_set *set, int id, const struct surface *at)
{
    return evaluate(set, id, at, texel_grey).r;
}
