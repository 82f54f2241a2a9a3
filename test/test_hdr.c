/* test_hdr.c: pictures of linear light and more than one unit of it: OpenEXR, Radiance, and the tone curve.
 *
 * Facts: files that OpenEXR's own library and ImageMagick made of picture.pfm have its pixels, compressed and laid out
 * in every way that is read; what is written is read back. Faults: every other kind is refused by name; truncation,
 * random changes, absurd sizes. Readers are called on blocks that end where the data end, so that a memory checker
 * (`make san`) sees any byte read beyond them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/file.h"
#include "base/mem.h"
#include "base/rng.h"
#include "image/formats.h"
#include "image/half.h"
#include "image/image.h"
#include "image/tone.h"
#include "helpers.h"
#include "tests.h"

#define FIXTURES "test/fixtures/pictures/"

static void check_refused(struct test *t, reader *read, const uint8_t *data, size_t n, const char *message)
{
    struct error err = {""};
    CHECK(t, !accepts(read, data, n, &err) && strstr(err.text, message) != NULL, "\"%s\" expected, got \"%s\"", message,
          err.text);
}

/* A fixture in memory, to be given to free(). */
static uint8_t *load(struct test *t, const char *name, size_t *n)
{
    char path[128];
    uint8_t *data = NULL;
    struct error err = {""};
    snprintf(path, sizeof path, "%s%s", FIXTURES, name);
    CHECK(t, file_read(path, &data, n, &err), "%s", err.text);
    return data;
}

/* Cut the file at many places; then change random bytes of it, which must be survived, whatever comes out. */
static void check_damaged(struct test *t, const char *what, reader *read, const uint8_t *data, size_t n, bool whole)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 30, (uint32_t)n);
    struct error err;
    for (size_t cut = 0; whole && cut < n; cut += cut < 400 || n - cut < 50 ? 1 : 23)
        CHECK(t, !accepts(read, data, cut, &err), "%s: the first %lu bytes are accepted", what, (unsigned long)cut);
    uint8_t *copy = mem_alloc(n, 1);
    for (int round = 0; round < 150; round++) {
        memcpy(copy, data, n);
        uint32_t first = round % 2 == 0 ? 0 : (uint32_t)n / 2, changes = 1 + rng_below(&r, 4);
        for (uint32_t k = 0; k < changes; k++)
            copy[first + rng_below(&r, (uint32_t)n - first)] = (uint8_t)(rng_u32(&r) >> 24);
        accepts(read, copy, n, &err);
    }
    free(copy);
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

/* What a fixture holds of picture.pfm. */
enum content { ALL, ONLY_GREEN_AS_GREY, ONLY_RED, THOUSANDFOLD };

static float expected(const struct image *picture, size_t i, enum content content)
{
    switch (content) {
    case ALL: return picture->f32[i];
    case ONLY_GREEN_AS_GREY: return picture->f32[3 * i + 1];
    case ONLY_RED: return i % 3 == 0 ? picture->f32[i] : 0;
    case THOUSANDFOLD: return floorf(picture->f32[i] * 1000);
    }
    return 0;
}

static void check_fixture(struct test *t, const struct image *picture, const char *name, enum content content,
                          bool whole)
{
    size_t n = 0, samples = (size_t)picture->width * (size_t)picture->height;
    uint8_t *data = load(t, name, &n);
    struct image img;
    struct error err = {""};
    int channels = content == ONLY_GREEN_AS_GREY ? 1 : 3, wrong = 0;
    if (CHECK(t, data != NULL && read_exactly(exr_read, data, n, &img, &err), "%s: %s", name, err.text)) {
        if (CHECK(t, img.width == picture->width && img.height == picture->height && img.channels == channels &&
                         img.linear && img.f32 != NULL, "%s: shape", name))
            for (size_t i = 0; i < samples * (size_t)channels; i++)
                wrong += img.f32[i] != expected(picture, i, content);
        CHECK(t, wrong == 0, "%s: %d samples are wrong", name, wrong);
        image_free(&img);
        check_damaged(t, name, exr_read, data, n, whole);
    }
    free(data);
}

static void test_fixtures(struct test *t)
{
    static const struct {
        const char *name;
        enum content content;
        bool levels; /* then the end of the file does not matter */
    } CASES[] = {
        {"none.exr", ALL, false},       {"rle.exr", ALL, false},        {"zips.exr", ALL, false},
        {"zip.exr", ALL, false},        {"piz.exr", ALL, false},        {"piz-float.exr", ALL, false},
        {"zip-float.exr", ALL, false},  {"window.exr", ALL, false},     {"layer.exr", ALL, false},
        {"tiles.exr", ALL, false},      {"tiles-piz.exr", ALL, false},  {"plain-and-layer.exr", ALL, false},
        {"tiles-mip.exr", ALL, true},   {"red.exr", ONLY_RED, false},   {"tiles-rip.exr", ONLY_GREEN_AS_GREY, true},
        {"uint.exr", THOUSANDFOLD, false}, {"grey.exr", ONLY_GREEN_AS_GREY, false},
    };
    struct image picture;
    struct error err;
    if (!CHECK(t, image_read(FIXTURES "picture.pfm", &picture, &err), "%s", err.text))
        return;
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++)
        check_fixture(t, &picture, CASES[i].name, CASES[i].content, !CASES[i].levels);
    image_free(&picture);
}

/* Grey pictures whose samples are consecutive numbers as bits: more of them than 2^14 in a block, for the wide pairs of
 * PIZ; and floats whose lower halves matter. */
static void test_ramps(struct test *t)
{
    size_t n = 0;
    struct image img;
    struct error err = {""};
    uint8_t *data = load(t, "ramp-piz.exr", &n);
    if (CHECK(t, data != NULL && read_exactly(exr_read, data, n, &img, &err), "%s", err.text)) {
        for (int i = 0; i < 520 * 32; i++)
            CHECK(t, img.f32[i] == half_to_float((uint16_t)(600 + i)), "wide pairs: sample %d is %g", i, img.f32[i]);
        image_free(&img);
        check_damaged(t, "ramp-piz.exr", exr_read, data, n, false);
    }
    free(data);
    data = load(t, "ramp-float.exr", &n);
    if (CHECK(t, data != NULL && read_exactly(exr_read, data, n, &img, &err), "%s", err.text)) {
        for (int i = 0; i < 41 * 23; i++)
            CHECK(t, img.f32[i] == 1 + (float)(5 * i) * ldexpf(1, -23), "floats: sample %d is %g", i, img.f32[i]);
        image_free(&img);
    }
    free(data);
}

/* --- OpenEXR files that are refused -------------------------------------------------------------------- */

/* Where the value of an attribute begins. */
static size_t value_of(const uint8_t *data, size_t n, const char *name)
{
    size_t length = strlen(name) + 1;
    for (size_t i = 8; i + length < n; i++)
        if (memcmp(data + i, name, length) == 0)
            return i + length + strlen((const char *)data + i + length) + 1 + 4;
    return 0;
}

static void test_refused(struct test *t)
{
    static const struct {
        const char *name, *message;
    } FILES[] = {
        {"pxr24.exr", "compression PXR24 is not read"}, {"dwaa.exr", "compression DWAA is not read"},
        {"parts.exr", "multi-part OpenEXR files"},      {"deep.exr", "deep OpenEXR pictures"},
        {"chroma.exr", "\"BY\" is subsampled"},         {"layers.exr", "several layers (\"left\", \"right\")"},
        {"depth.exr", "no channels R, G, B or Y, but e.g. \"Z\""},
    };
    static const struct {
        const char *attribute; /* "": from the beginning of the file */
        long at; /* bytes changed: the first n of `bytes` at this offset */
        size_t n;
        const char *bytes, *message;
    } CHANGES[] = {
        {"", 0, 1, "w", "not an OpenEXR file"},
        {"", 4, 1, "\3", "version 3"},
        {"", 6, 1, "\1", "unknown kind"},
        {"compression", 0, 1, "\6", "compression B44 is not read"},
        {"compression", 0, 1, "\7", "compression B44A is not read"},
        {"compression", 0, 1, "\11", "compression DWAB is not read"},
        {"compression", 0, 1, "\12", "compression HTJ2K256 is not read"},
        {"compression", 0, 1, "\14", "unknown OpenEXR compression 12"},
        {"compression", 0, 1, "\3", "no valid zlib header"},
        {"compression", 0, 1, "\4", "compressed data are truncated"},
        {"compression", -28, 1, "x", "no attribute \"compression\""},
        {"compression", -16, 1, "x", "attribute \"compression\" is of another type"},
        {"channels", 2, 1, "\3", "unknown type 3"},
        {"channels", 10, 1, "\2", "subsampled"},
        {"channels", -4, 4, "\1\0\0\0", "list of channels has no end"},
        {"channels", -4, 4, "\xff\xff\xff\xff", "truncated in its attribute \"channels\""},
        {"channels", 0, 1, "\0", "names no channel"},
        {"dataWindow", 8, 4, "\xff\xff\xff\xff", "empty"},
        {"dataWindow", 12, 4, "\0\0\0\x80", "empty"},
        {"dataWindow", 0, 16, "\0\0\0\x80\0\0\0\x80\xff\xff\xff\x7f\xff\xff\xff\x7f", "too many"},
        {"dataWindow", 8, 8, "\xff\x3f\0\0\xff\x3f\0\0", "do not fit"},
        {"dataWindow", 8, 8, "\xff\xff\xff\x0f\0\0\0\0", "do not fit"},
        {"dataWindow", 4, 1, "\1", "block 0 is another"},
    };
    size_t n = 0;
    for (size_t i = 0; i < sizeof FILES / sizeof FILES[0]; i++) {
        uint8_t *data = load(t, FILES[i].name, &n);
        if (data != NULL)
            check_refused(t, exr_read, data, n, FILES[i].message);
        free(data);
    }
    for (size_t i = 0; i < sizeof CHANGES / sizeof CHANGES[0]; i++) {
        uint8_t *data = load(t, "none.exr", &n);
        if (data == NULL)
            return;
        size_t start = CHANGES[i].attribute[0] != '\0' ? value_of(data, n, CHANGES[i].attribute) : 0;
        memcpy(data + (long)start + CHANGES[i].at, CHANGES[i].bytes, CHANGES[i].n);
        check_refused(t, exr_read, data, n, CHANGES[i].message);
        free(data);
    }
}

/* The table of offsets, and the sizes of blocks and tiles. */
static void test_refused_blocks(struct test *t)
{
    static const struct {
        size_t at; /* from the table's beginning, or, beyond it, from the first block's */
        uint64_t value;
        const char *message;
    } CASES[] = {
        {0, 0, "incomplete: block 0 is missing"}, {8, UINT64_MAX, "block 1 lies outside"},
        {8, (uint64_t)1 << 63, "block 1 lies outside"}, {19 * 8 + 4, 0xfffffff0, "truncated in block 0"},
        {19 * 8 + 4, 29 * 6 + 1, "block 0 has 175 bytes instead of 174"},
        {19 * 8 + 4, 29 * 6 - 1, "block 0 has 173 bytes instead of 174"},
        {19 * 8, 1, "block 0 is another"},
    };
    size_t n = 0, table = 0;
    uint8_t *data = load(t, "none.exr", &n), *tiles;
    if (data == NULL)
        return;
    while (table + 8 < n && bits_of_bytes(data + table, 8, false) != table + 19 * 8)
        table++;
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        uint8_t *copy = mem_alloc(n, 1);
        memcpy(copy, data, n);
        for (size_t k = 0; k < (CASES[i].at < 19 * 8 ? 8 : 4); k++)
            copy[table + CASES[i].at + k] = (uint8_t)(CASES[i].value >> 8 * k & 255);
        check_refused(t, exr_read, copy, n, CASES[i].message);
        free(copy);
    }
    free(data);
    if ((tiles = load(t, "tiles.exr", &n)) == NULL)
        return;
    memset(tiles + value_of(tiles, n, "tiles"), 0, 4);
    check_refused(t, exr_read, tiles, n, "tiles are empty");
    free(tiles);
}

/* --- written and read back ----------------------------------------------------------------------------- */

/* Noise over many powers of two, numbers that are no light, and a part that packs well. */
static float *make_pixels(struct test *t, int width, int height)
{
    static const float ODD[] = {-1, 0, 1e30f, -1e30f, 65504, 65520, 1e-7f, INFINITY, 1e-40f, 0.1f};
    float *p = mem_alloc((size_t)width * (size_t)height * 3, sizeof *p);
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 31, 0);
    for (int i = 0; i < width * height * 3; i++)
        p[i] = i < 10 ? ODD[i] : i % 2 == 0 ? (float)ldexp(rng_uniform(&r), (int)rng_below(&r, 30) - 15) : 0.5f;
    return p;
}

static void check_round_trip(struct test *t, const char *name, int width, int height)
{
    char path[256];
    struct image img;
    struct error err = {""};
    float *p = make_pixels(t, width, height);
    int wrong = 0;
    snprintf(path, sizeof path, "%s/%s", test_tmp(t), name);
    if (CHECK(t, image_write(path, width, height, p, &err) && image_read(path, &img, &err), "%s", err.text)) {
        CHECK(t, img.width == width && img.height == height && img.channels == 3 && img.linear, "%s: shape", name);
        for (int i = 0; i < width * height * 3; i++)
            wrong += img.f32[i] != half_to_float(float_to_half(p[i]));
        CHECK(t, wrong == 0, "%s, %d x %d: %d samples differ", name, width, height, wrong);
        image_free(&img);
    }
    remove(path);
    free(p);
}

static void test_round_trips(struct test *t)
{
    static const char *const NAMES[] = {"a.exr", "a.EXR"};
    for (size_t i = 0; i < sizeof NAMES / sizeof NAMES[0]; i++) {
        check_round_trip(t, NAMES[i], 1, 1);
        check_round_trip(t, NAMES[i], 2, 16);
        check_round_trip(t, NAMES[i], 1, 33);
        check_round_trip(t, NAMES[i], 61, 47);
    }
}

/* A fixture knows its place in a whole; a copy has the same; without a display window nobody knows. */
static void test_place(struct test *t)
{
    struct image img, copy;
    struct file_output file;
    struct error err = {""};
    char path[256];
    snprintf(path, sizeof path, "%s/place.float.exr", test_tmp(t));
    if (!CHECK(t, image_read(FIXTURES "window.exr", &img, &err), "%s", err.text))
        return;
    CHECK(t, img.place.x == -7 && img.place.y == 20 && img.place.width == 100 && img.place.height == 80,
          "at %d,%d of %dx%d", img.place.x, img.place.y, img.place.width, img.place.height);
    if (CHECK(t, image_create(path, &file, &err) &&
                     image_finish(&file, img.place, img.width, img.height, img.f32, &err) &&
                     image_read(path, &copy, &err), "%s", err.text)) {
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

/* --- Radiance ------------------------------------------------------------------------------------------ */

/* ImageMagick's file, with runs; it cuts light off at 1. */
static void test_rgbe_fixture(struct test *t)
{
    size_t n = 0;
    struct image picture, img;
    struct error err = {""};
    int wrong = 0;
    uint8_t *data = load(t, "picture.hdr", &n);
    if (data == NULL || !CHECK(t, image_read(FIXTURES "picture.pfm", &picture, &err), "%s", err.text))
        return;
    if (CHECK(t, read_exactly(rgbe_read, data, n, &img, &err), "%s", err.text)) {
        CHECK(t, img.width == picture.width && img.height == picture.height && img.channels == 3, "shape");
        for (int i = 0; i < picture.width * picture.height * 3; i++)
            wrong += fabsf(img.f32[i] - fminf(picture.f32[i], 1)) > 1.0f / 128;
        CHECK(t, wrong == 0, "picture.hdr: %d samples are wrong", wrong);
        image_free(&img);
        check_damaged(t, "picture.hdr", rgbe_read, data, n, true);
    }
    image_free(&picture);
    free(data);
}

/* A header and pixels given as text, of which the first n bytes count. */
static size_t make_rgbe(uint8_t *out, const char *size, const char *pixels, size_t n)
{
    int head = sprintf((char *)out, "#?RADIANCE\n# made by hand\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n%s\n", size);
    memcpy(out + head, pixels, n);
    return (size_t)head + n;
}

static void test_rgbe_by_hand(struct test *t)
{
    static const struct {
        const char *size, *pixels;
        size_t n;
        float first, last; /* reds */
    } CASES[] = {
        {"-Y 1 +X 2", "\200\0\0\201\100\0\0\201", 8, 1, 0.5f},
        {"-Y 1 -X 2", "\200\0\0\201\100\0\0\201", 8, 0.5f, 1},
        {"+Y 2 +X 1", "\200\0\0\201\100\0\0\201", 8, 0.5f, 1},
        {"-Y 1 +X 5", "\200\0\0\201\1\1\1\3\100\0\0\201", 12, 1, 0.5f},
        {"-Y 1 +X 260", "\200\0\0\201\1\1\1\2\1\1\1\1\100\0\0\201", 16, 1, 0.5f}, /* 2 and 1 * 256 */
        {"-Y 1 +X 8", "\2\2\0\10\207\200\1\100\210\0\210\0\210\201", 14, 1, 0.5f},
        {"-Y 1 +X 1", "\200\0\0\0", 4, 0, 0},
    };
    static const struct {
        const char *size, *pixels;
        size_t n;
        const char *message;
    } REFUSED[] = {
        {"+X 2 -Y 1", "", 0, "size \"+X 2 -Y 1\""},
        {"-Y 2 +X ", "", 0, "empty"},
        {"-Y 2 +X 3x", "", 0, "size \"-Y 2 +X 3x\""},
        {"-Y 99999 +X 99999", "", 0, "too many"},
        {"-Y 16384 +X 16384", "", 0, "do not fit"},
        {"-Y 1 +X 2", "\200\0\0\201\100\0\0", 7, "truncated in its pixels"},
        {"-Y 1 +X 2", "\200\0\0\201\1\1\1\2", 8, "beyond the end of its row"},
        {"-Y 1 +X 500", "\200\0\0\201\1\1\1\0\1\1\1\0\1\1\1\0\1\1\1\0\1\1\1\1", 24, "beyond the end of its row"},
        {"-Y 1 +X 8", "\2\2\0\10\211\200", 6, "beyond the end of its row"},
        {"-Y 1 +X 8", "\2\2\0\10\0\200", 6, "empty run"},
        {"-Y 1 +X 8", "\2\2\0\10\4\200\200", 7, "truncated in its pixels"},
    };
    uint8_t data[256];
    struct image img;
    struct error err = {""};
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        size_t n = make_rgbe(data, CASES[i].size, CASES[i].pixels, CASES[i].n);
        if (!CHECK(t, read_exactly(rgbe_read, data, n, &img, &err), "%s: %s", CASES[i].size, err.text))
            continue;
        const float *last = img.f32 + 3 * ((size_t)img.width * (size_t)img.height - 1);
        CHECK(t, img.f32[0] == CASES[i].first && last[0] == CASES[i].last && last[1] == 0, "%s: %g, %g",
              CASES[i].size, img.f32[0], last[0]);
        image_free(&img);
        check_damaged(t, CASES[i].size, rgbe_read, data, n, true);
    }
    for (size_t i = 0; i < sizeof REFUSED / sizeof REFUSED[0]; i++)
        check_refused(t, rgbe_read, data, make_rgbe(data, REFUSED[i].size, REFUSED[i].pixels, REFUSED[i].n),
                      REFUSED[i].message);
    static const char XYZ[] = "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n";
    check_refused(t, rgbe_read, (const uint8_t *)XYZ, sizeof XYZ - 1, "format \"32-bit_rle_xyze\"");
}

/* --- tone ---------------------------------------------------------------------------------------------- */

static void test_tone(struct test *t)
{
    static const float IN[] = {0, 0.18f, 1, -1, NAN, INFINITY, 1e30f};
    float out[7];
    struct tone plain = {0, TONE_NONE}, brighter = {2, TONE_NONE}, filmic = {0, TONE_FILMIC}, both = {-1, TONE_FILMIC};
    CHECK(t, tone_is_plain(&plain) && !tone_is_plain(&brighter) && !tone_is_plain(&filmic), "what is plain");
    tone_map(&plain, IN, 4, out);
    CHECK(t, memcmp(IN, out, 4 * sizeof *IN) == 0, "plain light stays the same");
    tone_map(&brighter, IN, 4, out);
    CHECK(t, out[1] == 4 * IN[1] && out[2] == 4 && out[3] == -4, "two stops are a factor of 4");
    tone_map(&filmic, IN, 7, out);
    CHECK(t, fabs((double)out[2] - 2.54 / 3.16) < 1e-6 && fabs((double)out[1] - 0.0867240 / 0.3249320) < 1e-6,
          "the curve at 1 and 0.18: %g, %g", out[2], out[1]);
    CHECK(t, out[0] == 0 && out[3] == 0 && out[4] == 0, "no light, negative light and NaN are black");
    CHECK(t, fabs((double)out[5] - 2.51 / 2.43) < 1e-5 && out[5] == out[6], "white: %g", out[5]);
    float half = 0.5f, one = 1;
    tone_map(&both, &one, 1, out);
    tone_map(&filmic, &half, 1, out + 1);
    CHECK(t, out[0] == out[1], "the stops come before the curve");
}

void test_hdr(struct test *t)
{
    test_half(t);
    test_fixtures(t);
    test_ramps(t);
    test_refused(t);
    test_refused_blocks(t);
    test_round_trips(t);
    test_place(t);
    test_rgbe_fixture(t);
    test_rgbe_by_hand(t);
    test_tone(t);
}
