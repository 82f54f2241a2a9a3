/* test_image.c: the readers of the image formats, on files by other programs and on damaged files.
 *
 * Facts: pictures made by another program, or byte by byte here, have the pixels they must have. Faults: truncation
 * at every length, changes of single bytes, absurd sizes. Readers are called on blocks that end where the data end,
 * so that a memory checker (`make san`) sees any byte read beyond them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/mem.h"
#include "image/image.h"
#include "image/zlib.h"
#include "helpers.h"
#include "samples.h"
#include "suites.h"

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

/* Read a file that is a picture of this shape, 8 bits or floats. False if it is not. */
static bool read_shape(struct test *t, const char *what, reader *read, const struct small_file *b, int width,
                       int height, int channels, bool floats, struct image *img)
{
    struct error err = {.text = ""};
    return CHECK(t, read_exactly(read, b->data, b->n, img, &err), "%s: %s", what, err.text) &&
           CHECK(t, img->width == width && img->height == height && img->channels == channels &&
                        (img->f32 != NULL) == floats && (img->u8 == NULL) == floats &&
                        img->linear == (read == pfm_read),
                 "%s: %d x %d x %d", what, img->width, img->height, img->channels);
}

/* A text and what is said when it is refused as a picture. */
struct refusal {
    const char *text, *message;
};

static void check_texts_refused(struct test *t, reader *read, const struct refusal *c, size_t n)
{
    for (size_t i = 0; i < n; i++)
        check_no_picture(t, read, (const uint8_t *)c[i].text, strlen(c[i].text), c[i].message);
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

/* Has the file the pixels of the sample? If it is to be spoilt, is that seen? */
static void check_png_pixels(struct test *t, const struct png_sample *s, const struct small_file *file, bool spoilt)
{
    struct image img;
    char what[64];
    int channels = s->colour == 0 || s->colour == 4 ? 1 : 3;
    snprintf(what, sizeof what, "PNG colour type %d, %d bits, %dx%d", s->colour, s->depth, s->width, s->height);
    if (!read_shape(t, what, png_read, file, s->width, s->height, channels, s->depth == 16, &img))
        return;
    for (int i = 0; i < s->width * s->height * channels; i++) {
        int x = i / channels % s->width, y = i / channels / s->width;
        unsigned expected = expected_sample(s, x, y, i % channels);
        bool same = img.u8 != NULL ? img.u8[i] == expected : img.f32[i] == (float)(expected / 65535.0);
        CHECK(t, same, "%s: pixel %d,%d channel %d is not %u", what, x, y, i % channels, expected);
    }
    image_free(&img);
    CHECK(t, !spoilt || check_spoilt(t, what, png_read, file->data, file->n) == 0, "%s: a changed byte goes unnoticed",
          what);
}

static void check_png_sample(struct test *t, const struct png_sample *s)
{
    struct small_file file = {.n = 0};
    put_hex(&file, s->hex);
    check_png_pixels(t, s, &file, true);
}

/* Which pass of an interlaced picture has a pixel. [PNG 8.2] */
static int pass_with(int x, int y)
{
    static const char *const PASSES[8] = {"16462646", "77777777", "56565656", "77777777",
                                          "36463646", "77777777", "56565656", "77777777"};
    return PASSES[y % 8][x % 8] - '0';
}

/* The rows of all passes, each less the row above it in its pass. Returns their length. */
static size_t interlaced_rows(const struct png_sample *s, int samples, uint8_t *out)
{
    size_t used = 0;
    for (int pass = 1; pass <= 7; pass++) {
        uint8_t above[128] = {0};
        for (int y = 0; y < s->height; y++) {
            uint8_t row[128] = {0};
            size_t bits = 0;
            for (int x = 0; x < s->width; x++)
                for (int c = 0; c < samples && pass_with(x, y) == pass; c++)
                    for (int b = s->depth - 1; b >= 0; b--, bits++) {
                        unsigned v = ((unsigned)(x * 3701 + y * 10103 + c * 15013 + 11) & 65535) >> (16 - s->depth);
                        row[bits / 8] = (uint8_t)(row[bits / 8] | (v >> b & 1) << (7 - bits % 8));
                    }
            if (bits == 0)
                continue;
            out[used++] = 2;
            for (size_t i = 0; i < (bits + 7) / 8; i++)
                out[used++] = (uint8_t)(row[i] - above[i]);
            memcpy(above, row, sizeof above);
        }
    }
    return used;
}

static void put_checksums(uint8_t *data, size_t size);

/* Interlaced pictures of all sizes up to 9 x 9, of every kind without a palette. */
static void test_interlaced(struct test *t)
{
    static const int KINDS[][3] = {{0, 1, 1}, {0, 2, 1}, {0, 4, 1}, {0, 8, 1}, {0, 16, 1}, {2, 8, 3}, {2, 16, 3},
                                   {4, 8, 2}, {4, 16, 2}, {6, 8, 4}, {6, 16, 4}}; /* colour type, bits, samples */
    for (int i = 0; i < 11 * 81; i++) {
        const int *kind = KINDS[i % 11];
        struct png_sample s = {1 + i / 11 % 9, 1 + i / 99, kind[0], kind[1], ""};
        struct small_file file = {.n = 0};
        uint8_t rows[2048];
        size_t packed_size;
        uint8_t *packed = deflate_zlib(rows, interlaced_rows(&s, kind[2], rows), &packed_size);
        put_hex(&file, "89504e470d0a1a0a0000000d49484452");
        for (int b = 0; b < 8; b++)
            put_byte(&file, b % 4 < 3 ? 0 : b < 4 ? (unsigned)s.width : (unsigned)s.height);
        for (int b = 0; b < 5; b++)
            put_byte(&file, b == 0 ? (unsigned)s.depth : b == 1 ? (unsigned)s.colour : b == 4);
        put_hex(&file, "000000000000");
        put_byte(&file, (unsigned)packed_size >> 8);
        put_byte(&file, (unsigned)packed_size & 255);
        put_text(&file, "IDAT");
        memcpy(file.data + file.n, packed, packed_size);
        file.n += packed_size;
        put_hex(&file, "000000000000000049454e4400000000");
        put_checksums(file.data, file.n);
        check_png_pixels(t, &s, &file, i % 37 == 0);
        free(packed);
    }
}

/* Ties of the Paeth filter: left goes before above, above before above left. */
static void test_paeth_ties(struct test *t)
{
    static const uint8_t EXPECTED[8] = {10, 11, 10, 8, 8, 13, 11, 99};
    struct small_file file = {.n = 0};
    struct image img;
    struct error err = {.text = ""};
    put_hex(&file, PNG_PAETH_TIES);
    if (!CHECK(t, read_exactly(png_read, file.data, file.n, &img, &err), "%s", err.text))
        return;
    CHECK(t, memcmp(img.u8, EXPECTED, sizeof EXPECTED) == 0, "a tie of the Paeth filter is decided wrongly");
    image_free(&img);
}

/* Give all chunks their checksums. */
static void put_checksums(uint8_t *data, size_t size)
{
    for (size_t at = 8, n; at + 12 <= size && (n = bits_of_bytes(data + at, 4, true)) <= size - at - 12; at += n + 12)
        bytes_of_bits(checksum_crc32(0, data + at + 4, n + 4), data + at + 8 + n, 4, true);
}

/* Each a PNG header for a picture of this size and kind, followed by chunks without checksums. */
static void test_png_refusals(struct test *t)
{
    static const char END[] = "0000000049454e4400000000", DAMAGED[] = "the PNG file is damaged or truncated";
    static const struct {
        const char *header, *chunks, *message;
    } CASES[] = {
        {"00000000000000050802000000", END, "empty"},
        {"ffffffffffffffff0802000000", END, "too many"},
        {"00004001000040000802000000", END, "too many"},
        {"00004000000040001006000000", "000000014944415400000000000000000049454e4400000000", "do not fit"},
        {"00000001000000010302000000", END, "colour type 2, 3 bits"},
        {"00000001000000011003000000", END, "colour type 3, 16 bits"},
        {"00000001000000010805000000", END, "colour type 5"},
        {"00000001000000010802010000", END, "unknown kind"},
        {"00000001000000010802000002", END, "unknown kind"},
        {"00000001000000010802000001", END, "truncated"},
        {"00000001000000010803000000", END, DAMAGED}, /* no palette */
        {"00000001000000010802000000", END, "truncated"},
        {"00000001000000010802000000", "000000004162434400000000", "unknown PNG chunk AbCD"},
        {"00000001000000010802000000", "7fffffff4944415400000000", DAMAGED},
        /* one grey pixel in a stored block: filter 5; one palette pixel: colour 1 of 1 */
        {"00000001000000010800000000", "0000000d49444154789c010200fdff05070013000d000000000000000049454e4400000000",
         DAMAGED},
        {"00000001000000010803000000",
         "00000003504c544501020300000000"
         "0000000d49444154789c010200fdff000100030002000000000000000049454e4400000000",
         DAMAGED},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        struct small_file b = {.n = 0};
        put_hex(&b, "89504e470d0a1a0a0000000d49484452");
        put_hex(&b, CASES[i].header);
        put_hex(&b, "00000000");
        put_hex(&b, CASES[i].chunks);
        put_checksums(b.data, b.n);
        check_no_picture(t, png_read, b.data, b.n, CASES[i].message);
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
    char what[64];
    int channels = type % 8 == 3 ? 1 : 3;
    snprintf(what, sizeof what, "TGA type %u, %u bits, origin %u", type, bits, origin);
    if (!read_shape(t, what, tga_read, &file, 3, 2, channels, false, &img))
        return;
    for (int i = 0; i < 6 * channels; i++) {
        int expected = i / channels % 3 * 10 + i / channels / 3 + (channels == 3 ? 2 - i % 3 : 0) * 100;
        CHECK(t, img.u8[i] == expected, "%s: sample %d is %d, not %d", what, i, img.u8[i], expected);
    }
    image_free(&img);
    check_spoilt(t, what, tga_read, file.data, file.n);
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
        unsigned type;
        size_t at; /* of a byte that is changed */
        unsigned value;
        const char *message;
    } CASES[] = {
        {10, 2, 0, "type 0"},           {10, 2, 32, "type 32"},   {10, 16, 16, "16 bits"},
        {10, 17, 0xc0, "this kind"},    {10, 12, 0, "empty"},     {10, 13, 0xff, "do not fit"},
        {10, 22, 0x88, "damaged"},      {10, 22, 0x7f, "damaged"}, {10, 0, 255, "truncated"},
        {1, 45, 4, "damaged"},          {1, 45, 11, "damaged"}, /* not in the map */
        {1, 1, 0, "24 in its map"},     {1, 7, 16, "16 in its map"},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        struct small_file b = make_tga(CASES[i].type, 24, 0);
        b.data[CASES[i].at] = (uint8_t)CASES[i].value;
        check_no_picture(t, tga_read, b.data, b.n, CASES[i].message);
    }
}

/* --- PFM and PPM ------------------------------------------------------------------------------------- */

/* Blanks that may end a header, of which data are not a part. */
static const char *const HEADER_ENDS[] = {"\n", "\r\n", "\r", " "};

static void check_pfm(struct test *t, int channels, const char *scale, double factor, const char *end)
{
    struct small_file file = {.n = 0};
    struct image img;
    put_text(&file, channels == 3 ? "PF\n2 3\n" : "Pf 2\t3\r\n");
    put_text(&file, scale);
    put_text(&file, end);
    for (int i = 0; i < 6 * channels; i++, file.n += 4)
        bytes_of_bits(bits_of_float((float)(i - 3)), file.data + file.n, 4, factor > 0);
    if (!read_shape(t, "PFM", pfm_read, &file, 2, 3, channels, true, &img))
        return;
    for (int i = 0; i < 6 * channels; i++) {
        int y = 2 - i / (2 * channels), place = y * 2 * channels + i % (2 * channels);
        CHECK(t, img.f32[place] == (float)((i - 3) * fabs(factor)), "PFM %s: sample %d is %g", scale, i,
              img.f32[place]);
    }
    image_free(&img);
    check_spoilt(t, "PFM", pfm_read, file.data, file.n);
}

static void test_pfm(struct test *t)
{
    for (int i = 0; i < 8; i++) {
        int channels = 1 + i % 2 * 2;
        const char *end = HEADER_ENDS[i / 2];
        check_pfm(t, channels, "-1.000000", -1, end);
        check_pfm(t, channels, "1", 1, end);
        check_pfm(t, channels, "-0.5", -0.5, end);
        check_pfm(t, channels, "2e0", 2, end);
    }
    static const struct refusal CASES[] = {
        {"PX\n2 2\n-1\n", "not a PFM"},
        {"PF\n2\n", "incomplete"},
        {"PF\n0 2\n-1\n", "empty"},
        {"PF\n2 2\n0\n", "scale"},
        {"PF\n2 2\nnan\n", "scale"},
        {"PF\n2 2\n1e999\n", "scale"},
        {"PF\n2 2\nx\n", "scale"},
        {"PF\n2 2\n-1\n", "truncated"},
        {"PF\n99999999 99999999\n-1\n", "too many"},
        {"PF\n16384 16384\n-1\n", "do not fit"},
        {"PF\n18446744073709551617 1\n-1\n", "too many"},
    };
    check_texts_refused(t, pfm_read, CASES, sizeof CASES / sizeof CASES[0]);
}

/* A 2 x 2 picture with samples 10, 1, 2, ... of maxval `most`: a byte of 10 is LF. */
static void check_ppm(struct test *t, int kind, unsigned most, const char *end)
{
    struct small_file file = {.n = 0};
    char header[64];
    int channels = kind == 3 || kind == 6 ? 3 : 1;
    snprintf(header, sizeof header, "P%d# comment\n 2 #\n2\n# 7 7\n%u%s", kind, most, end);
    put_text(&file, header);
    for (unsigned i = 0; i < 4u * (unsigned)channels; i++) {
        char number[32];
        unsigned sample = i == 0 && end[0] != '\r' ? 10 : i; /* CR and LF would be one blank */
        snprintf(number, sizeof number, "%u %s", sample, i == 1 ? "# in between\n" : "");
        if (kind <= 3)
            put_text(&file, number);
        if (kind > 3 && most > 255)
            put_byte(&file, 0);
        if (kind > 3)
            put_byte(&file, sample);
    }
    struct image img;
    if (!read_shape(t, "PPM", ppm_read, &file, 2, 2, channels, most > 255, &img))
        return;
    for (int i = 0; i < 4 * channels; i++) {
        double value = img.u8 != NULL ? img.u8[i] / 255.0 : img.f32[i], bound = img.u8 != NULL ? 0.5 / 255 : 1e-7;
        int sample = i == 0 && end[0] != '\r' ? 10 : i;
        CHECK(t, fabs(value - (double)sample / most) <= bound + 1e-9, "P%d, %u: sample %d is %g", kind, most, i, value);
    }
    image_free(&img);
    if (kind <= 3) /* a blank, and then a digit, may be missing at the end of a text: 10 is still a number */
        file.n -= most > 9 && channels == 3 ? 3 : 1;
    check_spoilt(t, "PPM", ppm_read, file.data, file.n);
}

static void test_ppm(struct test *t)
{
    for (int i = 0; i < 16; i++) {
        static const int KINDS[] = {2, 3, 5, 6};
        check_ppm(t, KINDS[i % 4], 11, HEADER_ENDS[i / 4]);
        check_ppm(t, KINDS[i % 4], 255, HEADER_ENDS[i / 4]);
        check_ppm(t, KINDS[i % 4], 256, HEADER_ENDS[i / 4]);
        check_ppm(t, KINDS[i % 4], 65535, HEADER_ENDS[i / 4]);
    }
    static const struct refusal CASES[] = {
        {"P4\n1 1\n1\n0", "not a PPM"},
        {"P6 1 1", "incomplete"},
        {"P6 -1 1 255\nxxx", "incomplete"},
        {"P6 1 1 0\nxxx", "largest value"},
        {"P6 1 1 65536\nxxx", "largest value"},
        {"P6 1 1 7\nxxx", "no number up to 7"},
        {"P3 1 1 7\n1 2 8", "no number up to 7"},
        {"P3 1 1 7\n1 2 x", "no number"},
        {"P3 2 1 7\n1 2 3", "do not fit"},
        {"P6 99999 99999 255\n", "too many"},
        {"P6 16384 16384 255\n", "do not fit"},
    };
    check_texts_refused(t, ppm_read, CASES, sizeof CASES / sizeof CASES[0]);
}

/* --- small files of large pictures ---------------------------------------------------------------------- */

/* Pictures that a codec might well have packed into 3 MB, and the limits themselves. */
static void test_memory(struct test *t)
{
    enum { N = 3000000 };
    static const char MESSAGE[] = "MB more memory, but 256.0 of 256.0 MB are left";
    uint8_t *data = mem_alloc(N, 1);
    struct small_file png = {.n = 0};
    data[2] = 11; /* runs of grey */
    data[13] = data[15] = 0x36;
    data[16] = 8;
    check_no_picture(t, tga_read, data, N, MESSAGE); /* 13824 x 13824 pixels, in packets of 2 bytes for 128 */
    put_hex(&png, "89504e470d0a1a0a0000000d494844520000400000004000100600000000000000");
    memcpy(data, png.data, png.n);
    bytes_of_bits(N - png.n - 24, data + png.n, 4, true); /* an IDAT that fills the file, but for an IEND */
    memcpy(data + png.n + 4, "IDAT", 4);
    memcpy(data + N - 8, "IEND", 4);
    put_checksums(data, N);
    check_no_picture(t, png_read, data, N, MESSAGE);
    free(data);
}

void test_image(struct test *t)
{
    test_memory(t);
    test_srgb(t);
    for (int i = 0; i < N_PNG_SAMPLES; i++)
        check_png_sample(t, &PNG_SAMPLES[i]);
    test_paeth_ties(t);
    test_interlaced(t);
    test_png_refusals(t);
    test_tga(t);
    test_pfm(t);
    test_ppm(t);
}
