/* test_texture.c: values of textures against their formulas, and of images between and beyond their texels.
 *
 * Facts: every kind against its formula written out at a point; pictures at texel centres, half-way and beyond the
 * edges for each wrap mode, with and without gamma, as pbrt-v3 looks them up; sharing of pictures; patterns and
 * mappings against values that pbrt-v3's own textures return. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "base/rng.h"
#include "helpers.h"
#include "image/image.h"
#include "lab/numbers.h"
#include "material/noise.h"
#include "material/texture.h"
#include "suites.h"

static bool near(double a, double b) { return fabs(a - b) <= 1e-6 * (1 + fabs(b)); }
static bool near_rgb(rgb a, rgb b) { return near(a.r, b.r) && near(a.g, b.g) && near(a.b, b.b); }

static struct surface at_uv(double u, double v)
{
    struct surface at = {.u = u, .v = v};
    return at;
}

static const struct mapping IDENTITY = {.su = 1, .sv = 1};

/* --- the kinds that need no picture ------------------------------------------------------------------ */

static int add_grey(struct texture_set *set, double value) { return texture_add_constant(set, rgb_grey(value)); }

/* A texture of two others. */
static int add_pair(struct texture_set *set, enum texture_kind kind, int tex1, int tex2, struct mapping map)
{
    struct texture x = {.kind = kind, .tex1 = tex1, .tex2 = tex2, .amount = 0, .map = map};
    return texture_add(set, x);
}

static void test_arithmetic(struct test *t)
{
    struct texture_set set = {.n_textures = 0};
    int quarter = add_grey(&set, 0.25); /* number 0: the amount of mixes */
    int a = texture_add_constant(&set, rgb_make(0.2, 0.4, 0.8)), b = texture_add_constant(&set, rgb_make(3, 2, 1));
    int scale = add_pair(&set, TEXTURE_SCALE, a, b, IDENTITY), mix = add_pair(&set, TEXTURE_MIX, a, b, IDENTITY);
    int nested = add_pair(&set, TEXTURE_SCALE, mix, scale, IDENTITY);
    CHECK(t, set.texture[a].kind == TEXTURE_CONSTANT, "a texture of one value has kind %d", (int)set.texture[a].kind);
    const struct {
        int id;
        rgb want;
    } cases[] = {{quarter, rgb_grey(0.25)}, {a, {0.2, 0.4, 0.8}}, {scale, {0.6, 0.8, 0.8}}, {mix, {0.9, 0.8, 0.85}},
                 {nested, {0.54, 0.64, 0.68}}};
    struct surface at = at_uv(0.3, 0.7);
    for (int i = 0; i < 5; i++) {
        rgb c = texture_rgb(&set, cases[i].id, &at);
        CHECK(t, near_rgb(c, cases[i].want) && near(texture_float(&set, cases[i].id, &at), c.r), "texture %d: %g %g %g",
              i, c.r, c.g, c.b);
    }
    texture_set_free(&set);
    CHECK(t, set.n_textures == 0 && set.texture == NULL, "a freed set is empty");
}

static void test_checkerboard(struct test *t)
{
    struct texture_set set = {.n_textures = 0};
    struct mapping map = {.su = 4, .sv = 2, .du = 0.5, .dv = -1};
    int one = add_grey(&set, 1), two = add_grey(&set, 2), id = add_pair(&set, TEXTURE_CHECKERBOARD, one, two, map);
    for (int j = -9; j <= 9; j++)
        for (int i = -9; i <= 9; i++) {
            struct surface at = at_uv((i + 0.4 - map.du) / map.su, (j + 0.6 - map.dv) / map.sv);
            double expected = (i + j) % 2 == 0 ? 1 : 2;
            CHECK(t, texture_float(&set, id, &at) == expected && texture_rgb(&set, id, &at).b == expected,
                  "cell %d,%d is not %g", i, j, expected);
        }
    struct surface far = at_uv(1e300, -INFINITY); /* no number of a cell, but no fault either */
    double value = texture_float(&set, id, &far);
    CHECK(t, value == 1 || value == 2, "far away");
    texture_set_free(&set);
}

static void test_bilerp(struct test *t)
{
    static const struct {
        double u, v;
        rgb want;
    } CASES[] = {{0, 0, {1, 0, 0}}, {0, 1, {2, 1, 0}}, {1, 0, {4, 0, 3}}, {1, 1, {8, 5, 5}},
                 {0.25, 0.5, {2.625, 1, 1}}};
    struct texture_set set = {.n_textures = 0};
    struct texture x = {.kind = TEXTURE_BILERP, .map = IDENTITY, .v00 = CASES[0].want, .v01 = CASES[1].want,
                        .v10 = CASES[2].want, .v11 = CASES[3].want};
    int id = texture_add(&set, x);
    for (int i = 0; i < 5; i++) {
        struct surface at = at_uv(CASES[i].u, CASES[i].v);
        rgb c = texture_rgb(&set, id, &at);
        CHECK(t, near_rgb(c, CASES[i].want) && near(texture_float(&set, id, &at), c.r), "(%g, %g)", at.u, at.v);
    }
    texture_set_free(&set);
}

/* --- patterns and mappings ---------------------------------------------------------------------------- */

/* What pbrt-v3's textures, called one by one with rays without differentials, return at these points of the world,
 * under the transform Translate .1 .2 .3 Rotate 30 1 2 3 Scale 1.5 .5 2. noise: at the point itself. fbm, wrinkled:
 * with 8 octaves of roughness 0.5, and with 3 of 0.7. marble: of scale 2 and variation 0.4, with all the segments of
 * its spline (see noise.c). uv: planar, along (1,2,-1) + 0.25 and (0.5,0,3) - 0.5. cubes: the checkerboard in space, 1
 * on even. */
static const struct peer {
    double p[3], noise, fbm, fbm3, wrinkled, wrinkled3, windy, marble[3], spherical[2], cylindrical[2], uv[2];
    int cubes;
} PEER[] = {
    {{0.25, 0.5, 0.75}, -0.068794, -0.098394, -0.100062, 0.349274, 0.469733, -0.045731, {0.644684, 0.644684, 0.739907},
     {0.387226, 0.223716}, {0.723716, 0.346924}, {0.750000, 0.875000}, 0},
    {{-1.3, 2.6, -0.4}, 0.169994, 0.267968, 0.355261, 0.428406, 0.520611, 0.065880, {0.853925, 0.853925, 0.888578},
     {0.538920, 0.251048}, {0.751048, -0.121965}, {0.550000, 0.650000}, 0},
    {{3.7, -2.1, 5.2}, -0.122297, -0.463562, -0.498817, 0.529939, 0.567417, -0.243250, {0.869823, 0.869823, 0.899874},
     {0.332428, 0.771302}, {0.271302, 0.502461}, {0.550000, 0.949999}, 1},
    {{-8.4, -7.9, -0.6}, -0.286956, 0.458712, 0.493093, 0.534210, 0.561693, 0.071113, {0.791180, 0.791180, 0.843996},
     {0.539413, 0.639426}, {0.139426, -0.123503}, {0.650000, 0.500000}, 1},
    {{1.1, 9.3, -4.8}, -0.491504, 0.085061, 0.091205, 0.238099, 0.385794, 0.010170, {0.833213, 0.833213, 0.854016},
     {0.557824, 0.205541}, {0.705541, -0.180662}, {0.750000, 0.650000}, 1},
    {{0.01, -0.02, 0.03}, 0.040300, 0.400917, 0.485305, 0.528351, 0.596105, 0.058266, {0.890015, 0.879584, 0.878538},
     {0.594122, 0.724023}, {0.224023, -0.291402}, {0.190000, 0.595000}, 1},
    {{12.6, 3.3, 0.9}, -0.023455, 0.201008, 0.287118, 0.292378, 0.355718, 0.099650, {0.845290, 0.838633, 0.839159},
     {0.428897, 0.931447}, {0.431447, 0.221523}, {0.550001, 0.500000}, 1},
    {{-0.7, 0.1, -6.5}, -0.199600, -0.397621, -0.420193, 0.531314, 0.550721, -0.177555, {0.866419, 0.866419, 0.897456},
     {0.812070, 0.792040}, {0.292040, -0.830718}, {0.250000, 0.650000}, 0},
};
enum { N_PEER = sizeof PEER / sizeof PEER[0] };

static bool close_to(double a, double b) { return fabs(a - b) <= 2e-5; }

/* A texture of space with the parameters of the table. */
static int add_noise(struct texture_set *set, enum texture_kind kind, int octaves, double omega)
{
    struct texture x = {.kind = kind, .octaves = octaves, .omega = omega, .scale = 2, .variation = 0.4};
    return texture_add(set, x);
}

/* Red and green are s and t, of TEXTURE_UV their fractions. */
static int add_uv(struct texture_set *set, enum texture_kind kind, enum mapping_kind mapping)
{
    struct mapping map = {mapping, 0, 0, 0, 0.25, -0.5, {1, 2, -1}, {0.5, 0, 3}};
    struct texture x = {.kind = kind, .map = map, .v01 = {0, 1, 0}, .v10 = {1, 0, 0}, .v11 = {1, 1, 0}};
    return texture_add(set, x);
}

static void test_peer(struct test *t)
{
    struct texture_set set = {.n_textures = 0};
    struct transform turn = transform_compose(transform_rotate(30, vec(1, 2, 3)), transform_scale(1.5, 0.5, 2));
    texture_add_space(&set, transform_compose(transform_translate(vec(0.1, 0.2, 0.3)), turn));
    int one = add_grey(&set, 1), zero = add_grey(&set, 0), cubes = add_pair(&set, TEXTURE_CUBES, one, zero, IDENTITY);
    const int number[] = {add_noise(&set, TEXTURE_FBM, 8, 0.5), add_noise(&set, TEXTURE_FBM, 3, 0.7),
                          add_noise(&set, TEXTURE_WRINKLED, 8, 0.5), add_noise(&set, TEXTURE_WRINKLED, 3, 0.7),
                          add_noise(&set, TEXTURE_WINDY, 0, 0)};
    const int uv[] = {add_uv(&set, TEXTURE_BILERP, MAPPING_SPHERICAL),
                      add_uv(&set, TEXTURE_BILERP, MAPPING_CYLINDRICAL), add_uv(&set, TEXTURE_UV, MAPPING_PLANAR)};
    int marble = add_noise(&set, TEXTURE_MARBLE, 8, 0.5);
    for (int i = 0; i < N_PEER; i++) {
        const struct peer *w = &PEER[i];
        const double want[] = {w->fbm, w->fbm3, w->wrinkled, w->wrinkled3, w->windy};
        const double *const st[] = {w->spherical, w->cylindrical, w->uv};
        struct surface at = {.p = vec(w->p[0], w->p[1], w->p[2])};
        CHECK(t, close_to(noise(at.p), w->noise), "point %d: noise %g, not %g", i, noise(at.p), w->noise);
        for (int k = 0; k < 5; k++) {
            double x = texture_float(&set, number[k], &at);
            rgb c = texture_rgb(&set, number[k], &at);
            CHECK(t, close_to(x, want[k]), "point %d, texture %d of noise: %g, not %g", i, k, x, want[k]);
            CHECK(t, c.r == x && c.g == x && c.b == x, "point %d, texture %d of noise is not grey", i, k);
        }
        for (int k = 0; k < 3; k++) {
            rgb c = texture_rgb(&set, uv[k], &at);
            CHECK(t, close_to(c.r, st[k][0]) && close_to(c.g, st[k][1]) && c.b == 0, "point %d, mapping %d: %g %g", i,
                  k, c.r, c.g);
        }
        rgb m = texture_rgb(&set, marble, &at);
        CHECK(t, close_to(m.r, w->marble[0]) && close_to(m.g, w->marble[1]) && close_to(m.b, w->marble[2]),
              "point %d: marble %g %g %g", i, m.r, m.g, m.b);
        CHECK(t, texture_float(&set, cubes, &at) == w->cubes, "point %d: cubes", i);
    }
    texture_set_free(&set);
}

/* pbrt-v3's dots at s = -3.03 + 0.17 i, t = 2.01 - 0.33 j. */
static const char *const DOTS[] = {
    "..........####..####...####.####..####..####..##",
    ".................###....##....#....##....###....",
    "................................................",
    "##..............####............................",
    "##...............###............................",
    "...............................................#",
    ".............................................###",
    "...............................................#",
    ".............................##.................",
    "..........#####.......####..####................",
    "...........###.........##.......................",
    "................................................",
};

static void test_dots(struct test *t)
{
    struct texture_set set = {.n_textures = 0};
    int two = add_grey(&set, 2), three = add_grey(&set, 3), inside = 0;
    int id = add_pair(&set, TEXTURE_DOTS, two, three, IDENTITY);
    for (int j = 0; j < (int)(sizeof DOTS / sizeof DOTS[0]); j++)
        for (int i = 0; DOTS[j][i] != '\0'; i++) {
            struct surface at = at_uv(-3.03 + 0.17 * i, 2.01 - 0.33 * j);
            double want = DOTS[j][i] == '#' ? 2 : 3;
            CHECK(t, texture_float(&set, id, &at) == want, "dots at %g %g", at.u, at.v);
        }
    for (int i = 0; i < 40000; i++) /* two in five squares have one, of area 0.35^2 pi */
        inside += noise_in_dot(i % 200 / 3.0, i / 200 / 3.0);
    CHECK(t, fabs(inside / 40000.0 - 0.4 * PI * sqr(0.35)) < 0.01, "%g of the plane is in dots", inside / 40000.0);
    texture_set_free(&set);
}

/* Finite wherever asked. */
static void test_strange(struct test *t)
{
    static const double STRANGE[] = {NAN, INFINITY, -INFINITY, 1e308, -1e18, 4294967296.5, -2147483648.5};
    for (int i = 0; i < (int)(sizeof STRANGE / sizeof STRANGE[0]); i++) {
        vec3 p = vec(STRANGE[i], 0.5, -STRANGE[i]);
        CHECK(t, fabs(noise(p)) <= 1 && isfinite(noise_waves(p)) && rgb_is_finite(noise_marble(p, 0.5, 8, 1)),
              "noise at %g", STRANGE[i]);
        noise_in_dot(STRANGE[i], STRANGE[i]); /* inside or outside, but no fault */
    }
    CHECK(t, noise_fbm(vec(0.3, 0.2, 0.1), 0.5, 0) == 0 && noise_turbulence(vec(0.3, 0.2, 0.1), 0.5, 0) == 0.2,
          "no octaves");
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
    static const struct {
        double s, t;
        enum texture_wrap wrap;
        double want;
    } CASES[] = {
        {0.4375, 0.5, WRAP_REPEAT, 6.25}, /* between four texels */
        {0, 0.25, WRAP_REPEAT, 1.5},      /* the left edge mixes with the right, */
        {0, 0.25, WRAP_CLAMP, 0},         /* or stays; */
        {1, 0.25, WRAP_BLACK, 1.5},       /* the right one fades */
        {0.125, 0, WRAP_REPEAT, 5},       /* the lower edge mixes with the upper */
        {9, 9, WRAP_CLAMP, 13}, {-9, 9, WRAP_CLAMP, 10},
    };
    static const double STRANGE[] = {NAN, INFINITY, -INFINITY, 1e308, -1e308, 1e17, 4e9, -4e9};
    struct image img = make_ramp();
    for (int j = 0; j < 2; j++)
        for (int i = 0; i < 4; i++) {
            double s = (i + 0.5) / 4, v = (j + 0.5) / 2;
            CHECK(t, near(ramp_at(&img, s - 3, v + 7, WRAP_REPEAT), i + 10 * j), "repeated texel %d,%d", i, j);
            CHECK(t, near(ramp_at(&img, s, v, WRAP_BLACK), i + 10 * j), "centre of texel %d,%d", i, j);
            CHECK(t, ramp_at(&img, s + 2, v, WRAP_BLACK) == 0, "outside is black");
        }
    for (int i = 0; i < 7; i++)
        CHECK(t, near(ramp_at(&img, CASES[i].s, CASES[i].t, CASES[i].wrap), CASES[i].want), "look-up %d", i);
    for (int i = 0; i < 24; i++) { /* no such place: any value, no fault */
        double s = STRANGE[i % 8], value = ramp_at(&img, s, -s, (enum texture_wrap)(i / 8));
        CHECK(t, value >= 0 && value <= 13, "%g gives %g", s, value);
    }
    struct texture_set set = {.n_textures = 0, .image = &img};
    struct mapping map = {.su = 0.5, .sv = 0.25, .du = 0.1, .dv = 0.3};
    struct texture x = {.kind = TEXTURE_IMAGEMAP, .map = map, .scale = 1};
    struct surface at = at_uv(0.7, 0.6);
    int id = texture_add(&set, x);
    CHECK(t, near(texture_float(&set, id, &at), ramp_at(&img, 0.45, 0.45, WRAP_REPEAT)), "an image map has a mapping");
    set.image = NULL;
    image_free(&img);
    texture_set_free(&set);
}

/* Pictures of one texel from files. */
static void test_decoding(struct test *t)
{
    static const char *const TEXELS[] = {"P3 1 1 255 200 100 20\n", "P3 1 1 255 50 50 50\n"};
    char path[3][256]; /* there is no third file */
    struct texture_set set = {.n_textures = 0};
    struct error err = {.text = ""};
    for (int i = 0; i < 3; i++) {
        snprintf(path[i], sizeof path[i], "%s/texel%d.ppm", test_tmp(t), i);
        if (i < 2)
            write_bytes(path[i], TEXELS[i], strlen(TEXELS[i]));
        CHECK(t, texture_load_image(&set, path[i], NULL, &err) == (i < 2 ? i : -1), "picture %d: %s", i, err.text);
    }
    CHECK(t, strstr(err.text, path[2]) == err.text, "%s", err.text);
    CHECK(t, set.n_images == 2, "what is no picture leaves nothing behind");
    struct texture x = {.kind = TEXTURE_IMAGEMAP, .map = IDENTITY, .scale = 3};
    int plain = texture_add(&set, x);
    x.gamma = true;
    int gamma = texture_add(&set, x);
    x.image = 1;
    int grey = texture_add(&set, x);
    struct surface at = at_uv(0.9, 0.1);
    rgb c = rgb_make(200 / 255.0, 100 / 255.0, 20 / 255.0);
    rgb d = rgb_make(srgb_decode(c.r), srgb_decode(c.g), srgb_decode(c.b));
    CHECK(t, near_rgb(texture_rgb(&set, plain, &at), rgb_scale(c, 3)), "as stored");
    CHECK(t, near_rgb(texture_rgb(&set, gamma, &at), rgb_scale(d, 3)), "decoded, then scaled");
    CHECK(t, near(texture_float(&set, plain, &at), 3 * rgb_luminance(c)), "a number is the luminance");
    CHECK(t, near(texture_float(&set, gamma, &at), 3 * srgb_decode(rgb_luminance(c))), "luminance, then decoded");
    CHECK(t, near(texture_float(&set, grey, &at), 3 * srgb_decode(50 / 255.0)), "grey has no luminance weights");
    texture_set_free(&set);
}

/* Decoding comes before mixing: half-way between black and white is 1/2, not the decoded 1/2. */
static void test_decoding_order(struct test *t)
{
    static const float SAMPLES[3] = {0.5f, -0.5f, 4};
    struct image img;
    picture_alloc_u8(&img, 2, 1, 1);
    img.u8[1] = 255;
    CHECK(t, near(image_bilinear(&img, 0.5, 0.5, WRAP_CLAMP, true).g, 0.5), "decode, then mix");
    image_free(&img);
    picture_alloc_f32(&img, 1, 1, 3);
    memcpy(img.f32, SAMPLES, sizeof SAMPLES);
    rgb c = image_bilinear(&img, 0.5, 0.5, WRAP_REPEAT, true);
    CHECK(t, near_rgb(c, rgb_make(srgb_decode(0.5), -0.5 / 12.92, srgb_decode(4))), "floats by formula");
    image_free(&img);
}

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

void test_texture(struct test *t)
{
    test_arithmetic(t);
    test_checkerboard(t);
    test_bilerp(t);
    test_peer(t);
    test_dots(t);
    test_strange(t);
    test_lookup(t);
    test_decoding(t);
    test_decoding_order(t);
    test_mending(t);
}
