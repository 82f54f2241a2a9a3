/* test_texture.c: values of textures.
 *
 * Facts: every kind against its formula written out at a point; pictures at texel centres, half-way and beyond the
 * edges for each wrap mode, with and without gamma, as pbrt-v3 looks them up; sharing of pictures. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "image/picture.h"
#include "material/texture.h"
#include "tests.h"

static bool near(double a, double b) { return fabs(a - b) <= 1e-6 * (1 + fabs(b)); }
static bool near_rgb(rgb a, rgb b) { return near(a.r, b.r) && near(a.g, b.g) && near(a.b, b.b); }

static struct surface at_uv(double u, double v)
{
    struct surface at = {.u = u, .v = v};
    return at;
}

static const struct uv_mapping IDENTITY = {1, 1, 0, 0};

/* --- the kinds that need no picture ------------------------------------------------------------------ */

static int add_pair(struct texture_set *set, enum texture_kind kind, int tex1, int tex2, int amount)
{
    struct texture x = {.kind = kind, .u = {.pair = {tex1, tex2, amount}}};
    return texture_add(set, x);
}

static void test_arithmetic(struct test *t)
{
    struct texture_set set = {.n_textures = 0};
    rgb a = rgb_make(0.2, 0.4, 0.8), b = rgb_make(3, 2, 1);
    int ta = texture_add_constant(&set, a), tb = texture_add_constant(&set, b);
    int half = texture_add_constant(&set, rgb_grey(0.25));
    int scale = add_pair(&set, TEXTURE_SCALE, ta, tb, 0), mix = add_pair(&set, TEXTURE_MIX, ta, tb, half);
    int nested = add_pair(&set, TEXTURE_SCALE, mix, scale, 0);
    struct surface at = at_uv(0.3, 0.7);
    CHECK(t, near_rgb(texture_rgb(&set, ta, &at), a) && texture_float(&set, tb, &at) == 3, "constant");
    CHECK(t, near_rgb(texture_rgb(&set, scale, &at), rgb_make(0.6, 0.8, 0.8)), "scale");
    CHECK(t, near(texture_float(&set, scale, &at), 0.6), "scale of numbers");
    CHECK(t, near_rgb(texture_rgb(&set, mix, &at), rgb_make(0.9, 0.8, 0.85)), "mix: amount 0 is tex1, 1 is tex2");
    CHECK(t, near(texture_float(&set, mix, &at), 0.9), "mix of numbers");
    CHECK(t, near_rgb(texture_rgb(&set, nested, &at), rgb_make(0.54, 0.64, 0.68)), "scale of mix and scale");
    CHECK(t, near_rgb(texture_mean(&set, nested), rgb_make(0.54, 0.64, 0.68)), "mean");
    texture_set_free(&set);
    CHECK(t, set.n_textures == 0 && set.texture == NULL, "a freed set is empty");
}

static void test_checkerboard(struct test *t)
{
    struct texture_set set = {.n_textures = 0};
    struct texture x = {.kind = TEXTURE_CHECKERBOARD};
    x.u.checker.tex1 = texture_add_constant(&set, rgb_grey(1));
    x.u.checker.tex2 = texture_add_constant(&set, rgb_grey(2));
    struct uv_mapping map = {4, 2, 0.5, -1};
    x.u.checker.map = map;
    int id = texture_add(&set, x);
    for (int j = -9; j <= 9; j++)
        for (int i = -9; i <= 9; i++) {
            struct surface at = at_uv((i + 0.4 - map.du) / map.su, (j + 0.6 - map.dv) / map.sv);
            double expected = (i + j) % 2 == 0 ? 1 : 2;
            CHECK(t, texture_float(&set, id, &at) == expected, "cell %d,%d is not %g", i, j, expected);
            CHECK(t, texture_rgb(&set, id, &at).b == expected, "cell %d,%d is not %g", i, j, expected);
        }
    CHECK(t, near(texture_mean(&set, id).r, 1.5), "mean");
    struct surface far = at_uv(1e300, -INFINITY); /* no number of a cell, but no fault either */
    double value = texture_float(&set, id, &far);
    CHECK(t, value == 1 || value == 2, "far away");
    texture_set_free(&set);
}

static void test_bilerp(struct test *t)
{
    struct texture_set set = {.n_textures = 0};
    struct texture x = {.kind = TEXTURE_BILERP};
    rgb v00 = rgb_make(1, 0, 0), v01 = rgb_make(2, 1, 0), v10 = rgb_make(4, 0, 3), v11 = rgb_make(8, 5, 5);
    x.u.bilerp.v00 = v00;
    x.u.bilerp.v01 = v01;
    x.u.bilerp.v10 = v10;
    x.u.bilerp.v11 = v11;
    x.u.bilerp.map = IDENTITY;
    int id = texture_add(&set, x);
    struct surface c00 = at_uv(0, 0), c01 = at_uv(0, 1), c10 = at_uv(1, 0), c11 = at_uv(1, 1),
                   in = at_uv(0.25, 0.5);
    CHECK(t, near_rgb(texture_rgb(&set, id, &c00), v00) && near_rgb(texture_rgb(&set, id, &c01), v01), "u = 0");
    CHECK(t, near_rgb(texture_rgb(&set, id, &c10), v10) && near_rgb(texture_rgb(&set, id, &c11), v11), "u = 1");
    CHECK(t, near_rgb(texture_rgb(&set, id, &in), rgb_make(2.625, 1, 1)), "inside");
    CHECK(t, near(texture_float(&set, id, &in), 2.625), "as a number");
    CHECK(t, near_rgb(texture_mean(&set, id), rgb_make(3.75, 1.5, 2)), "mean");
    texture_set_free(&set);
}

/* --- pictures ---------------------------------------------------------------------------------------- */

/* A 4 x 2 grey picture: from the lower left corner 0 1 2 3 below, 10 11 12 13 above. */
static struct image make_ramp(void)
{
    struct image img;
    picture_alloc_f32(&img, 4, 2, 1);
    for (int i = 0; i < 8; i++)
        img.f32[i] = (float)(i % 4 + (i < 4 ? 10 : 0)); /* the top row is stored first */
    return img;
}

static double ramp_at(const struct image *img, double s, double t, enum texture_wrap wrap)
{
    rgb c = image_bilinear(img, s, t, wrap, false);
    return c.r == c.g && c.g == c.b ? c.r : NAN;
}

static void test_lookup(struct test *t)
{
    struct image img = make_ramp();
    for (int j = 0; j < 2; j++)
        for (int i = 0; i < 4; i++) {
            double s = (i + 0.5) / 4, v = (j + 0.5) / 2;
            CHECK(t, near(ramp_at(&img, s, v, WRAP_REPEAT), i + 10 * j), "centre of texel %d,%d", i, j);
            CHECK(t, near(ramp_at(&img, s - 3, v + 7, WRAP_REPEAT), i + 10 * j), "repeated texel %d,%d", i, j);
            CHECK(t, near(ramp_at(&img, s, v, WRAP_BLACK), i + 10 * j), "centre of texel %d,%d", i, j);
            CHECK(t, ramp_at(&img, s + 2, v, WRAP_BLACK) == 0, "outside is black");
        }
    CHECK(t, near(ramp_at(&img, 0.4375, 0.5, WRAP_REPEAT), 6.25), "between four texels");
    CHECK(t, near(ramp_at(&img, 0, 0.25, WRAP_REPEAT), 1.5), "the left edge mixes with the right");
    CHECK(t, near(ramp_at(&img, 0, 0.25, WRAP_CLAMP), 0), "the left edge stays");
    CHECK(t, near(ramp_at(&img, 1, 0.25, WRAP_BLACK), 1.5), "the right edge fades");
    CHECK(t, near(ramp_at(&img, 9, 9, WRAP_CLAMP), 13) && near(ramp_at(&img, -9, 9, WRAP_CLAMP), 10),
          "corners stay");
    CHECK(t, near(ramp_at(&img, 0.125, 0, WRAP_REPEAT), 5), "the lower edge mixes with the upper");
    for (int wrap = WRAP_REPEAT; wrap <= WRAP_CLAMP; wrap++) { /* no such place: any value, no fault */
        static const double STRANGE[] = {NAN, INFINITY, -INFINITY, 1e308, -1e308, 1e17, 4e9, -4e9};
        for (size_t i = 0; i < sizeof STRANGE / sizeof STRANGE[0]; i++) {
            double value = ramp_at(&img, STRANGE[i], -STRANGE[i], (enum texture_wrap)wrap);
            CHECK(t, value >= 0 && value <= 13, "%g gives %g", STRANGE[i], value);
        }
    }
    image_free(&img);
}

/* One texel of colour (red, green, blue), 8 bits. */
static void write_texel(const char *path, int red, int green, int blue)
{
    FILE *f = fopen(path, "wb");
    if (f == NULL)
        return;
    fprintf(f, "P3 1 1 255 %d %d %d\n", red, green, blue);
    fclose(f);
}

static void test_decoding(struct test *t)
{
    char path[256], other[256], missing[256];
    snprintf(path, sizeof path, "%s/texel.ppm", test_tmp(t));
    snprintf(other, sizeof other, "%s/other.ppm", test_tmp(t));
    snprintf(missing, sizeof missing, "%s/missing.ppm", test_tmp(t));
    write_texel(path, 200, 100, 20);
    write_texel(other, 50, 50, 50);
    struct texture_set set = {.n_textures = 0};
    struct error err = {""};
    int image = texture_load_image(&set, path, &err);
    CHECK(t, image == 0 && texture_load_image(&set, other, &err) == 1, "%s", err.text);
    CHECK(t, texture_load_image(&set, path, &err) == 0 && set.n_images == 2, "a picture is read once");
    CHECK(t, texture_load_image(&set, missing, &err) == -1 && strstr(err.text, missing) == err.text, "%s",
          err.text);
    struct texture x = {.kind = TEXTURE_IMAGEMAP};
    x.u.imagemap.image = image;
    x.u.imagemap.scale = 3;
    x.u.imagemap.map = IDENTITY;
    int plain = texture_add(&set, x);
    x.u.imagemap.gamma = true;
    int gamma = texture_add(&set, x);
    x.u.imagemap.image = 1;
    int grey = texture_add(&set, x);
    struct surface at = at_uv(0.9, 0.1);
    rgb c = rgb_make(200 / 255.0, 100 / 255.0, 20 / 255.0);
    rgb d = rgb_make(srgb_decode(c.r), srgb_decode(c.g), srgb_decode(c.b));
    CHECK(t, near_rgb(texture_rgb(&set, plain, &at), rgb_scale(c, 3)), "as stored");
    CHECK(t, near_rgb(texture_rgb(&set, gamma, &at), rgb_scale(d, 3)), "decoded, then scaled");
    CHECK(t, near_rgb(texture_mean(&set, gamma), rgb_scale(d, 3)), "mean");
    CHECK(t, near(texture_float(&set, plain, &at), 3 * rgb_luminance(c)), "a number is the luminance");
    CHECK(t, near(texture_float(&set, gamma, &at), 3 * srgb_decode(rgb_luminance(c))),
          "luminance first, then decoded");
    CHECK(t, near(texture_float(&set, grey, &at), 3 * srgb_decode(50 / 255.0)), "grey has no luminance weights");
    texture_set_free(&set);
    remove(path);
    remove(other);
}

/* Decoding comes before mixing: half-way between black and white is 1/2, not the decoded 1/2. */
static void test_decoding_order(struct test *t)
{
    struct image img;
    picture_alloc_u8(&img, 2, 1, 1);
    img.u8[1] = 255;
    CHECK(t, near(image_bilinear(&img, 0.5, 0.5, WRAP_CLAMP, true).g, 0.5), "decode, then mix");
    img.u8[0] = 188;
    CHECK(t, near(image_bilinear(&img, 0.25, 0.5, WRAP_CLAMP, true).g, srgb_decode(188 / 255.0)), "bytes by table");
    CHECK(t, near(image_bilinear(&img, 0.25, 0.5, WRAP_CLAMP, false).g, 188 / 255.0), "bytes as stored");
    image_free(&img);
    picture_alloc_f32(&img, 1, 1, 3);
    img.f32[0] = 0.5f;
    img.f32[1] = -0.5f;
    img.f32[2] = 4;
    rgb c = image_bilinear(&img, 0.5, 0.5, WRAP_REPEAT, true);
    CHECK(t, near_rgb(c, rgb_make(srgb_decode(0.5), -0.5 / 12.92, srgb_decode(4))), "floats by formula");
    image_free(&img);
}

/* The mean of a picture larger than its grid of samples, and the mapping of an image map. */
/* Numbers of a picture that are none become 0 and are counted; a look-up meets finite numbers only. */
static void test_mending(struct test *t)
{
    static const float samples[6] = {1, NAN, -2, INFINITY, -INFINITY, 3};
    struct image img;
    picture_alloc_f32(&img, 2, 1, 3);
    memcpy(img.f32, samples, sizeof samples);
    image_mend(&img, false);
    CHECK(t, img.replaced == 3 && img.f32[1] == 0 && img.f32[2] == -2 && img.f32[3] == 0 && img.f32[5] == 3,
          "%ld numbers mended", img.replaced);
    image_mend(&img, true);
    CHECK(t, img.replaced == 4 && img.f32[2] == 0 && img.f32[0] == 1, "%ld with the negative one", img.replaced);
    image_free(&img);
    picture_alloc_u8(&img, 2, 1, 3);
    image_mend(&img, true);
    CHECK(t, img.replaced == 0, "bytes need no mending");
    image_free(&img);
}

static void test_large_picture(struct test *t)
{
    enum { W = 320, H = 130 };
    struct texture_set set = {.n_textures = 0};
    struct texture x = {.kind = TEXTURE_IMAGEMAP};
    struct image img;
    picture_alloc_f32(&img, W, H, 1);
    for (int i = 0; i < W * H; i++)
        img.f32[i] = (float)((i % W + 0.5) / W + (H - i / W - 0.5) / H);
    struct uv_mapping map = {0.5, 0.25, 0.1, 0.3};
    x.u.imagemap.map = map;
    x.u.imagemap.scale = 1;
    int id = texture_add(&set, x);
    set.image = &img;
    CHECK(t, near(texture_mean(&set, id).r, 1), "mean %g", texture_mean(&set, id).r);
    struct surface at = at_uv(0.7, 0.6);
    double expected = 0.5 * 0.7 + 0.1 + 0.25 * 0.6 + 0.3;
    CHECK(t, near(texture_float(&set, id, &at), expected), "mapped: %g", texture_float(&set, id, &at));
    set.image = NULL;
    image_free(&img);
    texture_set_free(&set);
}

void test_texture(struct test *t)
{
    test_arithmetic(t);
    test_checkerboard(t);
    test_bilerp(t);
    test_lookup(t);
    test_decoding(t);
    test_decoding_order(t);
    test_mending(t);
    test_large_picture(t);
}
