/* test_hdr.c: images of linear light: OpenEXR and the tone curve.
 *
 * Facts: files that OpenEXR's own library and ImageMagick made of picture.pfm have its pixels, compressed and laid out
 * in every way that is read. Faults: every other kind is refused; truncation, random changes, absurd sizes. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/file.h"
#include "base/mem.h"
#include "image/exr.h"
#include "image/image.h"
#include "image/tone.h"
#include "image/zlib.h"
#include "fuzz/lists.h"
#include "helpers.h"
#include "suites.h"

enum { PATH = 512 };

/* Where test_hdr unpacks the pictures of test/data/fixtures/pictures. */
static const char *fixture(const struct test *t, char path[PATH], const char *name)
{
    snprintf(path, PATH, "%s/pictures/%s", test_tmp(t), name);
    return path;
}

/* A fixture in memory, to be given to free(). */
static uint8_t *load(struct test *t, const char *name, size_t *n)
{
    char path[PATH];
    uint8_t *data = NULL;
    struct error err = {.text = ""};
    CHECK(t, file_read(fixture(t, path, name), &data, n, &err), "%s", err.text);
    return data;
}

/* --- halfs -------------------------------------------------------------------------------------------- */

static void test_half(struct test *t)
{
    int wrong = 0;
    for (unsigned h = 0; h < 0x10000; h++) {
        float x = half_to_float((uint16_t)h);
        bool is_nan = (h & 0x7fff) > 0x7c00;
        wrong += is_nan ? !isnan(x) || (float_to_half(x) & 0x7fff) <= 0x7c00 : float_to_half(x) != h;
    }
    CHECK(t, wrong == 0, "%d halfs do not survive", wrong);
    for (unsigned h = 0; h < 0x7bff; h++) { /* half-way between two: to the even one; beside that: to the nearer */
        float middle = (half_to_float((uint16_t)h) + half_to_float((uint16_t)(h + 1))) / 2;
        wrong += float_to_half(middle) != h + h % 2 || float_to_half(nextafterf(middle, 0)) != h ||
                 float_to_half(nextafterf(-middle, -1e9f)) != 0x8000 + h + 1;
    }
    CHECK(t, wrong == 0, "%d roundings are wrong", wrong);
    CHECK(t, half_to_float(0x3c00) == 1 && half_to_float(0xc000) == -2 && half_to_float(0x7bff) == HALF_MAX &&
                 half_to_float(1) == ldexpf(1, -24) && half_to_float(0x7c00) == INFINITY, "known halfs");
    CHECK(t, float_to_half(65519) == 0x7bff && float_to_half(-1e30f) == 0xfbff, "finite numbers stay finite");
    CHECK(t, float_to_half(INFINITY) == 0x7c00 && float_to_half(-INFINITY) == 0xfc00, "infinity stays infinite");
}

/* --- OpenEXR files of another program ----------------------------------------------------------------- */

/* What a fixture holds: of picture.pfm, or grey samples that are consecutive numbers as bits, more of them than 2^14 in
 * a block, for the wide pairs of PIZ, or floats whose lower halves matter. */
enum content { ALL, ONLY_GREEN_AS_GREY, ONLY_RED, THOUSANDFOLD, HALFS, FLOATS };

static float expected(const struct image *picture, size_t i, enum content content)
{
    switch (content) {
    case ALL: return picture->f32[i];
    case ONLY_GREEN_AS_GREY: return picture->f32[3 * i + 1];
    case ONLY_RED: return i % 3 == 0 ? picture->f32[i] : 0;
    case THOUSANDFOLD: return floorf(picture->f32[i] * 1000);
    case HALFS: return half_to_float((uint16_t)(600 + i));
    case FLOATS: return 1 + (float)(5 * i) * ldexpf(1, -23);
    }
    return 0;
}

static void check_fixture(struct test *t, const struct image *picture, const char *name, enum content content)
{
    bool levels = strstr(name, "ip.exr") != NULL && name[0] == 't'; /* then the end of the file does not matter */
    size_t n = 0, wrong = 0;
    uint8_t *data = load(t, name, &n);
    struct image img;
    struct error err = {.text = ""};
    if (CHECK(t, data != NULL && read_exactly(exr_read, data, n, &img, &err), "%s: %s", name, err.text)) {
        if (content <= THOUSANDFOLD)
            CHECK(t, img.width == picture->width && img.height == picture->height, "%s: shape", name);
        bool grey = content == ONLY_GREEN_AS_GREY || content > THOUSANDFOLD;
        CHECK(t, img.channels == (grey ? 1 : 3) && img.linear, "%s: %d channels", name, img.channels);
        for (size_t i = 0; i < image_bytes(&img) / sizeof *img.f32; i++)
            wrong += img.f32[i] != expected(picture, i, content);
        CHECK(t, wrong == 0, "%s: %d samples are wrong", name, (int)wrong);
        image_free(&img);
        if (!levels)
            check_spoilt(t, name, exr_read, data, n);
    }
    free(data);
}

/* Where the value of an attribute begins. */
static size_t value_of(const uint8_t *data, size_t n, const char *name)
{
    size_t length = strlen(name) + 1;
    for (size_t i = 8; i + length < n; i++)
        if (memcmp(data + i, name, length) == 0)
            return i + length + strlen((const char *)data + i + length) + 1 + 4;
    return 0;
}

/* Channels b, g, r are colours, unless there is one of the same name in upper case; y is none. */
static void check_lower_case(struct test *t, const struct image *picture)
{
    static const struct {
        const char *names;    /* in place of B, G, R */
        int red, green, blue; /* which of these they are; -1: 0 */
    } CASES[] = {{"bgr", 2, 1, 0}, {"gGr", 2, 1, -1}, {"Ggr", 2, 0, -1}, {"xyr", 2, -1, -1}, {"xyz", -1, -1, -1}};
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        size_t n = 0, wrong = 0;
        uint8_t *data = load(t, "none.exr", &n);
        const int from[3] = {CASES[i].red, CASES[i].green, CASES[i].blue};
        for (size_t c = 0; c < 3; c++)
            data[value_of(data, n, "channels") + 18 * c] = (uint8_t)CASES[i].names[c];
        struct image img = {0};
        struct error err = {.text = ""};
        const struct budget memory = budget_new(0, "");
        bool ok = exr_read(data, n, &memory, &img, &err);
        CHECK(t, ok == (from[0] >= 0), "channels %s: %s", CASES[i].names, err.text);
        for (size_t k = 0; ok && k < image_bytes(&img) / sizeof *img.f32; k++)
            wrong += img.f32[k] != (from[k % 3] < 0 ? 0 : picture->f32[k - k % 3 + 2 - (size_t)from[k % 3]]);
        CHECK(t, wrong == 0, "channels %s: %d samples are wrong", CASES[i].names, (int)wrong);
        image_free(&img);
        free(data);
    }
}

static void test_fixtures(struct test *t)
{
    static const struct {
        const char *name;
        enum content content;
    } CASES[] = {
        {"none.exr", ALL},      {"zips.exr", ALL},       {"zip.exr", ALL},
        {"piz.exr", ALL},       {"piz-float.exr", ALL}, {"zip-float.exr", ALL},  {"window.exr", ALL},
        {"plain-and-layer.exr", ALL}, {"tiles.exr", ALL},
        {"red.exr", ONLY_RED},  {"grey.exr", ONLY_GREEN_AS_GREY},
        {"uint.exr", THOUSANDFOLD}, {"ramp-piz.exr", HALFS}, {"ramp-float.exr", FLOATS},
    };
    struct image picture;
    struct error err;
    char path[PATH];
    if (!CHECK(t, image_read(fixture(t, path, "picture.pfm"), NULL, &picture, &err), "%s", err.text))
        return;
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++)
        check_fixture(t, &picture, CASES[i].name, CASES[i].content);
    check_lower_case(t, &picture);
    image_free(&picture);
}

/* --- OpenEXR files that are refused -------------------------------------------------------------------- */

static void test_refused(struct test *t)
{
    static const char DAMAGED[] = "the OpenEXR header is damaged or truncated", BLOCK[] = "damaged in row 0";
    static const struct {
        const char *name;
        const char *attribute; /* "": from the beginning of the file; NULL: nothing is changed */
        long at; /* bytes changed: the first n of `bytes` at this offset */
        size_t n;
        const char *bytes, *message;
    } CASES[] = {
        {"rle.exr", NULL, 0, 0, "", "compression 1"},
        {"pxr24.exr", NULL, 0, 0, "", "compression 5"},
        {"dwaa.exr", NULL, 0, 0, "", "compression 8"},
        {"parts.exr", NULL, 0, 0, "", "several parts"},
        {"deep.exr", NULL, 0, 0, "", "deep ones"},
        {"chroma.exr", NULL, 0, 0, "", "\"BY\" is subsampled"},
        {"layers.exr", NULL, 0, 0, "", "no channels R, G, B or Y, but e.g. \"left.G\""},
        {"tiles.exr", "tiles", 0, 4, "\0\0\0\0", DAMAGED}, /* no tile so wide, or so high */
        {"tiles.exr", "tiles", 4, 4, "\0\0\0\0", DAMAGED},
        {"tiles.exr", "tiles", 0, 1, "\7", BLOCK},
        {"tiles.exr", "", 469, 1, "\1", BLOCK}, /* the column, row and level of the first tile */
        {"tiles.exr", "", 473, 1, "\1", BLOCK},
        {"tiles.exr", "", 477, 1, "\1", BLOCK},
        {"tiles.exr", "tiles", 0, 8, "\xff\xff\xff\xff\xff\xff\xff\xff", BLOCK},
        {"none.exr", "", 0, 1, "w", DAMAGED},
        {"none.exr", "", 4, 1, "\3", "other versions than 2"},
        {"none.exr", "", 6, 1, "\1", "kind 10002"},
        {"none.exr", "compression", 0, 1, "\14", "compression 12"},
        {"none.exr", "compression", 0, 1, "\3", BLOCK},
        {"none.exr", "compression", 0, 1, "\4", BLOCK},
        {"none.exr", "compression", -28, 1, "x", DAMAGED},
        {"none.exr", "channels", 2, 1, "\3", DAMAGED}, /* of unknown type */
        {"none.exr", "channels", -4, 4, "\1\0\0\0", DAMAGED},
        {"none.exr", "channels", -4, 4, "\xff\xff\xff\xff", DAMAGED},
        {"none.exr", "channels", 0, 1, "\0", DAMAGED},
        {"none.exr", "dataWindow", 8, 4, "\xff\xff\xff\xff", "empty"},
        {"none.exr", "dataWindow", 0, 16, "\0\0\0\x80\0\0\0\x80\xff\xff\xff\x7f\xff\xff\xff\x7f", "too many"},
        {"none.exr", "dataWindow", 8, 8, "\xff\x3f\0\0\xff\x3f\0\0", "do not fit"},
        {"none.exr", "dataWindow", 8, 8, "\xff\xff\xff\x0f\0\0\0\0", "do not fit"},
        {"none.exr", "dataWindow", 4, 1, "\1", BLOCK},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        size_t n = 0;
        const char *attribute = CASES[i].attribute;
        uint8_t *data = load(t, CASES[i].name, &n);
        if (data == NULL)
            return;
        if (attribute != NULL)
            memcpy(data + (long)(attribute[0] != '\0' ? value_of(data, n, attribute) : 0) + CASES[i].at, CASES[i].bytes,
                   CASES[i].n);
        check_no_picture(t, exr_read, data, n, CASES[i].message);
        free(data);
    }
}

/* The table of offsets, and the heads of blocks. */
static void test_refused_blocks(struct test *t)
{
    static const struct {
        size_t at; /* from the table's beginning, or, beyond it, from the first block's */
        uint64_t value;
        const char *message;
    } CASES[] = {
        {0, 0, "in row 0"},                       {8, UINT64_MAX, "in row 1"},
        {8, (uint64_t)1 << 63, "in row 1"},       {19 * 8 + 4, 0xfffffff0, "in row 0"},
        {19 * 8 + 4, 29 * 6 + 1, "in row 0"},     {19 * 8 + 4, 29 * 6 - 1, "in row 0"},
        {19 * 8, 1, "in row 0"},
    };
    size_t n = 0, table = 0;
    uint8_t *data = load(t, "none.exr", &n), *copy = mem_alloc(n, 1);
    while (table + 8 < n && bits_of_bytes(data + table, 8, false) != table + 19 * 8)
        table++;
    for (size_t i = 0; data != NULL && i < sizeof CASES / sizeof CASES[0]; i++) {
        memcpy(copy, data, n);
        bytes_of_bits(CASES[i].value, copy + table + CASES[i].at, CASES[i].at < 19 * 8 ? 8 : 4, false);
        check_no_picture(t, exr_read, copy, n, CASES[i].message);
    }
    free(copy);
    free(data);
}

/* A fixture knows its place in a whole; a copy has the same; without a display window nobody knows. */
/* The bytes of a picture that is written with these channels; to be given to free(). */
static uint8_t *written(struct test *t, const char *name, const struct raster *r, size_t *n)
{
    struct file_output file;
    struct error err = {.text = ""};
    char path[256];
    uint8_t *data = NULL;
    snprintf(path, sizeof path, "%s/%s", test_tmp(t), name);
    CHECK(t, image_create(path, &file, &err) && image_finish(&file, r, &err) && file_read(path, &data, n, &err), "%s",
          err.text);
    remove(path);
    return data;
}

/* Alpha in OpenEXR is one more channel, beside colours as they are; in PNG a fourth sample, and colours are divided by
 * it. Other formats are as without. */
static void test_alpha(struct test *t)
{
    static const float PIXELS[6] = {0.1f, 0.2f, 0.05f, 0.3f, 0, 3}, ALPHA[2] = {0.25f, 0};
    const struct channel more[2] = {{"Z", PIXELS, 3, true}, {"A", ALPHA, 1, false}};
    const struct raster plain = {{0, 0, 0, 0}, 2, 1, PIXELS, NULL, 0, false};
    const struct raster with = {{0, 0, 0, 0}, 2, 1, PIXELS, more, 2, false};
    struct image img;
    struct error err = {.text = ""};
    size_t n, n_plain;
    uint8_t *data = written(t, "alpha.float.exr", &with, &n);
    if (CHECK(t, data != NULL && read_exactly(exr_read, data, n, &img, &err), "%s", err.text)) {
        CHECK(t, memcmp(img.f32, PIXELS, sizeof PIXELS) == 0, "colours change by the side of alpha");
        image_free(&img);
        char *list = (char *)data + 8 + sizeof "channels" + sizeof "chlist" + 4;
        CHECK(t, list[0] == 'A' && list[18] == 'B' && list[36] == 'G' && list[54] == 'R' && list[72] == 'Z', "order");
        list[0] = 'Y'; /* a channel that is read, and three that are not */
        list[18] = list[36] = list[54] = 'x';
        if (CHECK(t, read_exactly(exr_read, data, n, &img, &err), "%s", err.text)) {
            CHECK(t, img.channels == 1 && img.f32[0] == ALPHA[0] && img.f32[1] == ALPHA[1], "alpha is %g, %g",
                  (double)img.f32[0], (double)img.f32[1]);
            image_free(&img);
        }
    }
    free(data);
    data = written(t, "alpha.exr", &with, &n);
    const char *half = (const char *)data + 8 + sizeof "channels" + sizeof "chlist" + 4;
    CHECK(t, data != NULL && half[2] == EXR_HALF && half[74] == EXR_FLOAT, "types of A and Z, one of which is exact");
    free(data);
    data = written(t, "alpha.png", &with, &n);
    if (CHECK(t, data != NULL && read_exactly(png_read, data, n, &img, &err), "%s", err.text)) {
        const uint8_t expected[6] = {srgb_byte(0.1f / 0.25), srgb_byte(0.2f / 0.25), srgb_byte(0.05f / 0.25), 0, 0, 0};
        CHECK(t, data[25] == 6 && memcmp(img.u8, expected, sizeof expected) == 0, "colour type %d, %d %d %d", data[25],
              img.u8[0], img.u8[1], img.u8[2]);
        image_free(&img);
    }
    uint8_t row[9] = {0}; /* a filter's number, and two pixels, of which the second is 0 */
    const uint8_t *size = data + 8 + 25 + 13; /* behind the signature, IHDR and sRGB */
    bool ok = data != NULL && inflate_zlib(size + 8, (size_t)bits_of_bytes(size, 4, true), row, sizeof row, &err);
    CHECK(t, ok && row[4] == 64, "%s: alpha is %d of 255", err.text, row[4]);
    free(data);
    data = written(t, "alpha.pfm", &with, &n);
    uint8_t *other = written(t, "alpha.pfm", &plain, &n_plain);
    CHECK(t, n == n_plain && memcmp(data, other, n) == 0, "a PFM changes by alpha");
    free(data);
    free(other);
}

static void test_place(struct test *t)
{
    struct image img, copy;
    struct file_output file;
    struct error err = {.text = ""};
    char path[PATH];
    if (!CHECK(t, image_read(fixture(t, path, "window.exr"), NULL, &img, &err), "%s", err.text))
        return;
    snprintf(path, sizeof path, "%s/place.float.exr", test_tmp(t));
    const struct raster raster = {img.place, img.width, img.height, img.f32, NULL, 0, false};
    CHECK(t, img.place.x == -7 && img.place.y == 20 && img.place.width == 100 && img.place.height == 80,
          "at %d,%d of %dx%d", img.place.x, img.place.y, img.place.width, img.place.height);
    if (CHECK(t, image_create(path, &file, &err) && image_finish(&file, &raster, &err) &&
                     image_read(path, NULL, &copy, &err), "%s", err.text)) {
        CHECK(t, memcmp(&copy.place, &img.place, sizeof img.place) == 0 && copy.height == img.height &&
                     memcmp(copy.f32, img.f32, 3 * (size_t)img.width * (size_t)img.height * sizeof *img.f32) == 0,
              "a copy is another picture, at %d,%d of %dx%d", copy.place.x, copy.place.y, copy.place.width,
              copy.place.height);
        image_free(&copy);
    }
    image_free(&img);
    remove(path);
    static const struct {
        int at;
        char byte;
        bool known;
    } CASES[] = {{-20, 'x', false}, {11, '\x80', false}, {15, '\x40', false}, {15, '\1', true}};
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        size_t n = 0;
        uint8_t *data = load(t, "window.exr", &n);
        if (data == NULL)
            return;
        data[value_of(data, n, "displayWindow") + (size_t)CASES[i].at] = (uint8_t)CASES[i].byte;
        CHECK(t, read_exactly(exr_read, data, n, &img, &err) && (img.place.width > 0) == CASES[i].known,
              "case %d: %d,%d of %dx%d", (int)i, img.place.x, img.place.y, img.place.width, img.place.height);
        image_free(&img);
        free(data);
    }
}

/* --- tone ---------------------------------------------------------------------------------------------- */

static void test_tone(struct test *t)
{
    enum { N = 7, UNTOUCHED = 12345 };
    static const float IN[N] = {0, 0.18f, 1, -1, NAN, INFINITY, 1e30f};
    float out[2 * N];
    struct tone plain = {0, TONE_NONE}, brighter = {2, TONE_NONE}, filmic = {0, TONE_FILMIC}, both = {-1, TONE_FILMIC};
    CHECK(t, tone_is_plain(&plain) && !tone_is_plain(&brighter) && !tone_is_plain(&filmic), "what is plain");
    tone_map(&plain, IN, 4, out);
    CHECK(t, memcmp(IN, out, 4 * sizeof *IN) == 0, "plain light stays the same");
    tone_map(&brighter, IN, 4, out);
    CHECK(t, out[1] == 4 * IN[1] && out[2] == 4 && out[3] == -4, "two stops are a factor of 4");
    tone_map(&filmic, IN, N, out);
    CHECK(t, fabs((double)out[2] - 2.54 / 3.16) < 1e-6 && fabs((double)out[1] - 0.0867240 / 0.3249320) < 1e-6,
          "the curve at 1 and 0.18: %g, %g", out[2], out[1]);
    CHECK(t, out[0] == 0 && out[3] == 0 && out[4] == 0, "no light, negative light and NaN are black");
    CHECK(t, fabs((double)out[5] - 2.51 / 2.43) < 1e-5 && out[5] == out[6], "white: %g", out[5]);
    float half = 0.5f, one = 1;
    tone_map(&both, &one, 1, out);
    tone_map(&filmic, &half, 1, out + 1);
    CHECK(t, out[0] == out[1], "the stops come before the curve");
    for (size_t n = 0; n <= N; n++) {
        for (int i = 0; i < 2 * N; i++)
            out[i] = UNTOUCHED;
        tone_map(&brighter, IN, n, out);
        for (size_t i = 0; i < 2 * N; i++)
            CHECK(t, (out[i] == UNTOUCHED) == (i >= n), "of %d numbers, number %d", (int)n, (int)i);
    }
}

void test_hdr(struct test *t)
{
    char path[PATH];
    struct error err;
    CHECK(t, list_unpack("test/data/fixtures/pictures", fixture(t, path, ""), &err), "%s", err.text);
    test_half(t);
    test_fixtures(t);
    test_refused(t);
    test_refused_blocks(t);
    test_alpha(t);
    test_place(t);
    test_tone(t);
}
