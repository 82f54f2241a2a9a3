/* test_image.c: the readers of the picture formats.
 *
 * Facts: pictures made by another program, or byte by byte here, have the pixels they must have. Faults: truncation
 * at every length, changes of single bytes, absurd sizes. Readers are called on blocks that end where the data end,
 * so that a memory checker (`make san`) sees any byte read beyond them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/zlib.h"
#include "base/mem.h"
#include "image/formats.h"
#include "base/rng.h"
#include "helpers.h"
#include "samples.h"
#include "tests.h"

/* A file in memory. */
struct small_file {
    uint8_t data[4096];
    size_t n;
};

static void put_text(struct small_file *b, const char *text)
{
    memcpy(b->data + b->n, text, strlen(text));
    b->n += strlen(text);
}

static void put_byte(struct small_file *b, unsigned value) { b->data[b->n++] = (uint8_t)value; }

static void put_hex(struct small_file *b, const char *hex)
{
    for (; *hex != '\0'; hex += 2) {
        char digits[3] = {hex[0], hex[1], '\0'};
        put_byte(b, (unsigned)strtoul(digits, NULL, 16));
    }
}

/* The message of a refusal, or "" if the file is accepted. */
static struct error refusal(reader *read, const struct small_file *b)
{
    struct error err = {""};
    if (accepts(read, b->data, b->n, &err))
        err.text[0] = '\0';
    return err;
}

static void check_refused(struct test *t, reader *read, const struct small_file *b, const char *message)
{
    struct error err = refusal(read, b);
    CHECK(t, strstr(err.text, message) != NULL, "\"%s\" expected, got \"%s\"", message, err.text);
    CHECK(t, strchr(err.text, '\n') == NULL, "the message is one line: %s", err.text);
}

/* A text and what is said when it is refused as a picture. */
struct refusal {
    const char *text, *message;
};

static void check_texts_refused(struct test *t, reader *read, const struct refusal *c, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        struct small_file b = {.n = 0};
        put_text(&b, c[i].text);
        check_refused(t, read, &b, c[i].message);
    }
}

/* Every proper beginning of a file is refused. */
static void check_truncations(struct test *t, const char *what, reader *read, const struct small_file *b)
{
    for (size_t n = 0; n < b->n; n++)
        CHECK(t, !accepts(read, b->data, n, NULL), "%s: the first %lu bytes are accepted", what, (unsigned long)n);
}

/* Change each byte to a few others; returns how many of the changed files are accepted. */
static int count_accepted_mutants(reader *read, const struct small_file *b)
{
    static const uint8_t CHANGE[] = {0x01, 0x80, 0xff, 0x10};
    int accepted = 0;
    struct small_file m = *b;
    for (size_t i = 0; i < m.n; i++)
        for (size_t k = 0; k < sizeof CHANGE; k++) {
            m.data[i] ^= CHANGE[k];
            accepted += accepts(read, m.data, m.n, NULL);
            m.data[i] ^= CHANGE[k];
        }
    return accepted;
}

/* --- sRGB -------------------------------------------------------------------------------------------- */

static void test_srgb(struct test *t)
{
    CHECK(t, fabs(srgb_decode(0.5) - 0.21404114048223255) < 1e-15, "decoded 1/2: %.17g", srgb_decode(0.5));
    CHECK(t, fabs(srgb_encode(0.18) - 0.46135612950044164) < 1e-15, "encoded 0.18: %.17g", srgb_encode(0.18));
    CHECK(t, srgb_encode(0) == 0 && fabs(srgb_encode(1) - 1) < 1e-15, "0 and 1 are fixed");
    for (int i = 0; i <= 255; i++)
        CHECK(t, srgb_byte(srgb_decode(i / 255.0)) == i, "byte %d does not survive", i);
    CHECK(t, srgb_byte(-1) == 0 && srgb_byte(7) == 255 && srgb_byte(INFINITY) == 255, "clamped");
    CHECK(t, srgb_byte(NAN) == 0 && srgb_byte(-INFINITY) == 0, "not a number is black");
    CHECK(t, srgb_byte(srgb_decode(99.49 / 255)) == 99 && srgb_byte(srgb_decode(99.51 / 255)) == 100, "rounded");
}

/* --- PNG --------------------------------------------------------------------------------------------- */

/* What samples.h promises for a pixel's channel, after reading: 0..255, or 0..65535 for 16 bits. */
static unsigned expected_sample(const struct png_sample *s, int x, int y, int c)
{
    static const int FACTOR[3] = {7, 13, 5}, OFFSET[3] = {3, 5, 100};
    bool palette = s->colour == 3;
    unsigned v = ((unsigned)(x * 3701 + y * 10103 + (palette ? 0 : c) * 15013 + 11) & 65535) >> (16 - s->depth);
    if (palette)
        return (unsigned)((int)(s->depth == 8 ? v % 20 : v) * FACTOR[c] + OFFSET[c]) & 255;
    return s->depth == 16 ? v : v * 255 / ((1u << s->depth) - 1);
}

static void check_png_sample(struct test *t, const struct png_sample *s)
{
    struct small_file file = {.n = 0};
    put_hex(&file, s->hex);
    struct image img;
    struct error err = {""};
    char what[64];
    snprintf(what, sizeof what, "PNG colour type %d, %d bits%s", s->colour, s->depth,
             s->interlaced ? ", interlaced" : "");
    if (!CHECK(t, read_exactly(png_read, file.data, file.n, &img, &err), "%s: %s", what, err.text))
        return;
    int channels = s->colour == 0 || s->colour == 4 ? 1 : 3;
    CHECK(t, img.width == s->width && img.height == s->height && img.channels == channels && !img.linear,
          "%s: %d x %d x %d", what, img.width, img.height, img.channels);
    CHECK(t, (img.f32 != NULL) == (s->depth == 16) && (img.u8 != NULL) == (s->depth != 16), "%s: storage", what);
    for (int y = 0; y < s->height; y++)
        for (int x = 0; x < s->width; x++)
            for (int c = 0; c < channels; c++) {
                int i = (y * s->width + x) * channels + c;
                unsigned expected = expected_sample(s, x, y, c);
                bool same = img.u8 != NULL ? img.u8[i] == expected : img.f32[i] == (float)(expected / 65535.0);
                CHECK(t, same, "%s: pixel %d,%d channel %d is not %u", what, x, y, c, expected);
            }
    image_free(&img);
    check_truncations(t, what, png_read, &file);
    CHECK(t, count_accepted_mutants(png_read, &file) == 0, "%s: a changed byte goes unnoticed", what);
}

/* Ties of the Paeth filter: left goes before above, above before above left. */
static void test_paeth_ties(struct test *t)
{
    static const uint8_t EXPECTED[8] = {10, 11, 10, 8, 8, 13, 11, 99};
    struct small_file file = {.n = 0};
    struct image img;
    struct error err = {""};
    put_hex(&file, PNG_PAETH_TIES);
    if (!CHECK(t, read_exactly(png_read, file.data, file.n, &img, &err), "%s", err.text))
        return;
    CHECK(t, memcmp(img.u8, EXPECTED, sizeof EXPECTED) == 0, "a tie of the Paeth filter is decided wrongly");
    image_free(&img);
}

/* Correct all chunk checksums, so that a changed byte reaches the code behind them. */
static void repair_checksums(struct small_file *b)
{
    for (size_t at = 8; at + 12 <= b->n;) {
        size_t n = (size_t)b->data[at] << 24 | (size_t)b->data[at + 1] << 16 | (size_t)b->data[at + 2] << 8 |
                   b->data[at + 3];
        if (n > b->n - at - 12)
            return;
        uint32_t crc = checksum_crc32(0, b->data + at + 4, n + 4);
        for (int i = 0; i < 4; i++)
            b->data[at + 8 + n + (size_t)i] = (uint8_t)(crc >> (24 - 8 * i) & 255);
        at += n + 12;
    }
}

/* Random changes behind right checksums. What is still a picture is accepted; nothing may crash or run away. */
static void test_png_mutants(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 10, 0);
    int accepted = 0;
    for (int s = 0; s < N_PNG_SAMPLES; s++) {
        struct small_file file = {.n = 0};
        put_hex(&file, PNG_SAMPLES[s].hex);
        for (int i = 0; i < 400; i++) {
            struct small_file m = file;
            for (uint32_t k = 0; k <= rng_below(&r, 3); k++) {
                uint8_t value = (uint8_t)(rng_u32(&r) >> 24);
                m.data[8 + rng_below(&r, (uint32_t)m.n - 8)] = value;
            }
            repair_checksums(&m);
            accepted += accepts(png_read, m.data, m.n, NULL);
        }
    }
    CHECK(t, accepted < 400 * N_PNG_SAMPLES / 2, "%d mutants accepted: adler and structure checks do not work",
          accepted);
}

/* A PNG header for a picture of this size and kind, followed by chunks given in hexadecimal without checksums. */
static struct small_file make_png(const char *header, const char *chunks)
{
    struct small_file b = {.n = 0};
    put_hex(&b, "89504e470d0a1a0a0000000d49484452");
    put_hex(&b, header);
    put_hex(&b, "00000000");
    put_hex(&b, chunks);
    repair_checksums(&b);
    return b;
}

static void test_png_refusals(struct test *t)
{
    static const char END[] = "0000000049454e4400000000";
    static const struct {
        const char *header, *chunks, *message;
    } CASES[] = {
        {"00000000000000050802000000", END, "empty"},
        {"00000005000000000802000000", END, "empty"},
        {"ffffffffffffffff0802000000", END, "too many"},
        {"10000001000000010802000000", END, "too many"},
        {"00004001000040000802000000", END, "too many"},
        {"00004000000040001006000000", "000000014944415400000000000000000049454e4400000000", "do not fit"},
        {"00000001000000010302000000", END, "no colour type 2 with 3 bits"},
        {"00000001000000011003000000", END, "no colour type 3 with 16 bits"},
        {"00000001000000010805000000", END, "no colour type 5"},
        {"00000001000000010802010000", END, "unknown compression"},
        {"00000001000000010802000100", END, "unknown compression"},
        {"00000001000000010802000002", END, "unknown compression"},
        {"00000001000000010803000000", END, "no palette"},
        {"00000001000000010802000000", END, "truncated"},
        {"00000001000000010802000000", "00000004504c54450000000000000000", "palette"},
        {"00000001000000010802000000", "000000004162434400000000", "unknown or misplaced chunk AbCD"},
        {"00000001000000010802000000", "000000003162434400000000", "no valid name"},
        {"00000001000000010802000000", "7fffffff4944415400000000", "truncated"},
        {"00000001000000010802000000",
         "00000001494441540000000000" /* IDAT, tEXt, IDAT */
         "0000000074455874000000000000000149444154000000000000000049454e4400000000",
         "not in one piece"},
        /* one grey pixel in a stored block: filter 5; one palette pixel: colour 1 of 1 */
        {"00000001000000010800000000", "0000000d49444154789c010200fdff05070013000d000000000000000049454e4400000000",
         "no such filter"},
        {"00000001000000010803000000",
         "00000003504c544501020300000000"
         "0000000d49444154789c010200fdff000100030002000000000000000049454e4400000000",
         "colour 1 of 1"},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        struct small_file b = make_png(CASES[i].header, CASES[i].chunks);
        check_refused(t, png_read, &b, CASES[i].message);
    }
}

/* --- TGA --------------------------------------------------------------------------------------------- */

/* A 3 x 2 picture whose pixel (x,y), from the top left, has blue 10 x + y, green +100, red +200. */
static struct small_file make_tga(unsigned type, unsigned bits, unsigned origin)
{
    struct small_file b = {.n = 0};
    bool mapped = type % 8 == 1, run_length = type >= 8;
    put_byte(&b, 4); /* length of the name */
    put_byte(&b, mapped);
    put_byte(&b, type);
    put_hex(&b, mapped ? "0500060018" : "0000000000"); /* colours 5 to 10 of 24 bits */
    put_hex(&b, "0000000003000200");
    put_byte(&b, mapped ? 8 : bits);
    put_byte(&b, origin << 4);
    put_text(&b, "name");
    for (unsigned i = 0; mapped && i < 6; i++)
        for (unsigned c = 0; c < 3; c++)
            put_byte(&b, i % 3 * 10 + i / 3 + c * 100);
    for (unsigned i = 0; i < 6; i++) {
        unsigned x = i % 3, y = i / 3;
        x = (origin & 1) != 0 ? 2 - x : x;
        y = (origin & 2) != 0 ? y : 1 - y;
        if (run_length && i == 0)
            put_byte(&b, 3); /* four pixels of their own: beyond the end of the row */
        if (run_length && i >= 4)
            put_byte(&b, i == 4 ? 128 : 0); /* a run of one, then one */
        if (mapped)
            put_byte(&b, 5 + y * 3 + x);
        for (unsigned c = 0; !mapped && c < bits / 8; c++)
            put_byte(&b, c == 3 ? 77 : x * 10 + y + c * 100);
    }
    return b;
}

static void check_tga(struct test *t, unsigned type, unsigned bits, unsigned origin)
{
    struct small_file file = make_tga(type, bits, origin);
    struct image img;
    struct error err = {""};
    char what[64];
    snprintf(what, sizeof what, "TGA type %u, %u bits, origin %u", type, bits, origin);
    if (!CHECK(t, read_exactly(tga_read, file.data, file.n, &img, &err), "%s: %s", what, err.text))
        return;
    int channels = type % 8 == 3 ? 1 : 3;
    CHECK(t, img.width == 3 && img.height == 2 && img.channels == channels && img.u8 != NULL, "%s: shape", what);
    for (int i = 0; i < 6; i++)
        for (int c = 0; c < channels; c++) {
            int expected = i % 3 * 10 + i / 3 + (channels == 3 ? 2 - c : 0) * 100;
            CHECK(t, img.u8[i * channels + c] == expected, "%s: pixel %d channel %d is %d, not %d", what, i, c,
                  img.u8[i * channels + c], expected);
        }
    image_free(&img);
    check_truncations(t, what, tga_read, &file);
    count_accepted_mutants(tga_read, &file); /* no checksum: only that nothing breaks */
}

static void test_tga(struct test *t)
{
    for (unsigned origin = 0; origin < 4; origin++)
        for (unsigned run_length = 0; run_length <= 8; run_length += 8) {
            check_tga(t, run_length + 1, 24, origin);
            check_tga(t, run_length + 2, 24, origin);
            check_tga(t, run_length + 2, 32, origin);
            check_tga(t, run_length + 3, 8, origin);
        }
    static const struct {
        size_t at;
        unsigned value;
        const char *message;
    } CASES[] = {
        {2, 0, "image type 0"},       {2, 32, "image type 32"}, {16, 16, "16 bits are not supported"},
        {17, 0xc0, "interleaved"},    {12, 0, "empty"},         {13, 0xff, "do not fit"},
        {22, 0x84, "beyond the end"}, {22, 0x7f, "truncated"},  {0, 255, "truncated"},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        struct small_file b = make_tga(10, 24, 0);
        b.data[CASES[i].at] = (uint8_t)CASES[i].value;
        if (CASES[i].value == 0x84) { /* a long run, then one too long: 5 + 5 pixels */
            b.data[26] = 0x84;
        }
        check_refused(t, tga_read, &b, CASES[i].message);
    }
    struct small_file outside = make_tga(1, 24, 0), unmapped = outside, narrow = outside;
    outside.data[outside.n - 1] = 4;
    check_refused(t, tga_read, &outside, "not in the colour map");
    outside.data[outside.n - 1] = 11;
    check_refused(t, tga_read, &outside, "not in the colour map");
    unmapped.data[1] = 0;
    check_refused(t, tga_read, &unmapped, "colour map");
    narrow.data[7] = 16;
    check_refused(t, tga_read, &narrow, "colour maps of 16 bits");
}

/* --- PFM and PPM ------------------------------------------------------------------------------------- */

static void put_float(struct small_file *b, float value, bool big_endian)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 4; i++)
        put_byte(b, bits >> (big_endian ? 24 - 8 * i : 8 * i) & 255);
}

static void check_pfm(struct test *t, int channels, const char *scale, double factor)
{
    struct small_file file = {.n = 0};
    put_text(&file, channels == 3 ? "PF\n2 3\n" : "Pf 2\t3\r\n");
    put_text(&file, scale);
    put_text(&file, "\n");
    for (int i = 0; i < 6 * channels; i++)
        put_float(&file, (float)(i - 3), factor > 0);
    struct image img;
    struct error err = {""};
    if (!CHECK(t, read_exactly(pfm_read, file.data, file.n, &img, &err), "PFM %d %s: %s", channels, scale,
               err.text))
        return;
    CHECK(t, img.width == 2 && img.height == 3 && img.channels == channels && img.linear, "PFM: shape");
    for (int i = 0; i < 6 * channels; i++) {
        int y = 2 - i / (2 * channels), place = y * 2 * channels + i % (2 * channels);
        CHECK(t, img.f32[place] == (float)((i - 3) * fabs(factor)), "PFM %s: sample %d is %g", scale, i,
              img.f32[place]);
    }
    image_free(&img);
    check_truncations(t, "PFM", pfm_read, &file);
    count_accepted_mutants(pfm_read, &file);
}

static void test_pfm(struct test *t)
{
    for (int channels = 1; channels <= 3; channels += 2) {
        check_pfm(t, channels, "-1.000000", -1);
        check_pfm(t, channels, "1", 1);
        check_pfm(t, channels, "-0.5", -0.5);
        check_pfm(t, channels, "2e0", 2);
    }
    static const struct refusal CASES[] = {
        {"PX\n2 2\n-1\n", "not a PFM"},
        {"PF\n2\n", "incomplete"},
        {"PF\n0 2\n-1\n", "empty"},
        {"PF\n-2 2\n-1\n", "empty"},
        {"PF\n2 2\n0\n", "scale"},
        {"PF\n2 2\nnan\n", "scale"},
        {"PF\n2 2\n1e999\n", "scale"},
        {"PF\n2 2\nx\n", "scale"},
        {"PF\n2 2\n-1\n", "truncated"},
        {"PF\n99999999 99999999\n-1\n", "too many"},
        {"PF\n16384 16384\n-1\n", "do not fit"},
        {"PF\n99999999999999999999999999999999 1\n-1\n", "too many"},
        {"PF\n18446744073709551617 1\n-1\n", "too many"},
    };
    check_texts_refused(t, pfm_read, CASES, sizeof CASES / sizeof CASES[0]);
}

/* A 2 x 2 picture with samples 0, 1, 2, ... of maxval `most`. */
static void check_ppm(struct test *t, int kind, unsigned most)
{
    struct small_file file = {.n = 0};
    char header[64];
    int channels = kind == 3 || kind == 6 ? 3 : 1;
    snprintf(header, sizeof header, "P%d# comment\n 2 #\n2\n# 7 7\n%u\n", kind, most);
    put_text(&file, header);
    for (unsigned i = 0; i < 4u * (unsigned)channels; i++) {
        char number[32];
        snprintf(number, sizeof number, "%u %s", i, i == 1 ? "# in between\n" : "");
        if (kind <= 3)
            put_text(&file, number);
        if (kind > 3 && most > 255)
            put_byte(&file, 0);
        if (kind > 3)
            put_byte(&file, i);
    }
    struct image img;
    struct error err = {""};
    if (!CHECK(t, read_exactly(ppm_read, file.data, file.n, &img, &err), "P%d, %u: %s", kind, most, err.text))
        return;
    CHECK(t, img.width == 2 && img.height == 2 && img.channels == channels && !img.linear, "P%d: shape", kind);
    CHECK(t, (img.u8 != NULL) == (most <= 255) && (img.f32 != NULL) == (most > 255), "P%d: storage", kind);
    for (int i = 0; i < 4 * channels; i++) {
        double value = img.u8 != NULL ? img.u8[i] / 255.0 : img.f32[i], bound = img.u8 != NULL ? 0.5 / 255 : 1e-7;
        CHECK(t, fabs(value - (double)i / most) <= bound + 1e-9, "P%d, %u: sample %d is %g", kind, most, i, value);
    }
    image_free(&img);
    if (kind <= 3) /* a blank, and then a digit, may be missing at the end of a text: 10 is still a number */
        file.n -= most > 9 && channels == 3 ? 3 : 1;
    check_truncations(t, "PPM", ppm_read, &file);
    count_accepted_mutants(ppm_read, &file);
}

static void test_ppm(struct test *t)
{
    for (int kind = 2; kind <= 6; kind += kind == 3 ? 2 : 1) {
        check_ppm(t, kind, 11);
        check_ppm(t, kind, 255);
        check_ppm(t, kind, 256);
        check_ppm(t, kind, 65535);
    }
    static const struct refusal CASES[] = {
        {"P4\n1 1\n1\n0", "not a PPM"},
        {"P6\n", "incomplete"},
        {"P6 1 1", "incomplete"},
        {"P6 1 1 255", "incomplete"},
        {"P6 0 1 255\n", "empty"},
        {"P6 -1 1 255\nxxx", "incomplete"},
        {"P6 1 1 0\nxxx", "largest value"},
        {"P6 1 1 65536\nxxx", "largest value"},
        {"P6 1 1 7\nxxx", "promises at most 7"},
        {"P3 1 1 7\n1 2 8", "promises at most 7"},
        {"P3 1 1 7\n1 2 x", "no number"},
        {"P3 1 1 7\n1 2 -1", "no number"},
        {"P3 2 1 7\n1 2 3", "do not fit"},
        {"P6 99999 99999 255\n", "too many"},
        {"P6 16384 16384 255\n", "do not fit"},
    };
    check_texts_refused(t, ppm_read, CASES, sizeof CASES / sizeof CASES[0]);
}

/* --- small files of large pictures ---------------------------------------------------------------------- */

static void check_too_large(struct test *t, const char *what, reader *read, const uint8_t *data, size_t size)
{
    struct image img = {0};
    struct error err = {"accepted"};
    CHECK(t, !read(data, size, &img, &err) && strstr(err.text, "too much for a file of this size") != NULL, "%s: %s",
          what, err.text);
    image_free(&img);
}

/* 16384 x 16384 pixels that a codec might well have packed into 300 KB or 3 MB, and the limits themselves. */
static void test_memory(struct test *t)
{
    enum { HDR = 300000, PNG = 3000000, HEAD = 33 };
    uint8_t *data = mem_alloc(PNG, 1);
    strcpy((char *)data, "#?RADIANCE\n\n-Y 16384 +X 16384\n");
    check_too_large(t, "hdr", rgbe_read, data, HDR);
    memset(data, 0, PNG);
    data[2] = 11; /* runs of grey */
    data[13] = data[15] = 0x36;
    data[16] = 8;
    check_too_large(t, "tga", tga_read, data, PNG); /* 13824 x 13824 pixels, in packets of 2 bytes for 128 */
    struct small_file png = {.n = 0};
    put_hex(&png, "89504e470d0a1a0a0000000d494844520000400000004000100600000000000000");
    memset(data, 0, HDR);
    memcpy(data, png.data, HEAD);
    const size_t BODY = PNG - HEAD - 12 - 12; /* an IDAT that fills the file, but for an IEND */
    for (int i = 0; i < 4; i++)
        data[HEAD + i] = (uint8_t)(BODY >> (24 - 8 * i) & 255);
    memcpy(data + HEAD + 4, "IDAT", 4);
    memcpy(data + PNG - 8, "IEND", 4);
    const size_t chunk[3][2] = {{8, 13}, {HEAD, BODY}, {PNG - 12, 0}};
    for (int k = 0; k < 3; k++) {
        uint32_t crc = checksum_crc32(0, data + chunk[k][0] + 4, chunk[k][1] + 4);
        for (int i = 0; i < 4; i++)
            data[chunk[k][0] + 8 + chunk[k][1] + (size_t)i] = (uint8_t)(crc >> (24 - 8 * i) & 255);
    }
    check_too_large(t, "png", png_read, data, PNG);
    free(data);
    struct error err;
    const uint64_t each = PICTURE_BYTES_PER_BYTE;
    CHECK(t, picture_memory_ok(PICTURE_FREE_BYTES, 1, &err) && !picture_memory_ok(PICTURE_FREE_BYTES + 1ull, 1, &err) &&
                 picture_memory_ok((1 << 24) * each, 1 << 24, &err) &&
                 !picture_memory_ok((1 << 24) * each + each, 1 << 24, &err),
          "limits");
}

void test_image(struct test *t)
{
    test_memory(t);
    test_srgb(t);
    for (int i = 0; i < N_PNG_SAMPLES; i++)
        check_png_sample(t, &PNG_SAMPLES[i]);
    test_paeth_ties(t);
    test_png_mutants(t);
    test_png_refusals(t);
    test_tga(t);
    test_pfm(t);
    test_ppm(t);
}
