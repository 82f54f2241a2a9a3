/* test_zlib.c: checksums, unpacking and packing of zlib data.
 *
 * Facts: published check values; streams of another program unpack to the text they were made from; what is packed
 * unpacks again, for every shape of data that meets a limit of the format (window, longest copy, deepest Huffman
 * tree). Faults: every truncation and every change of one byte is refused and no byte is written beyond the given
 * room (run under a memory checker, `make san`, to see it). */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/zlib.h"
#include "base/mem.h"
#include "base/rng.h"
#include "samples.h"
#include "suites.h"

static void test_checksums(struct test *t)
{
    const uint8_t *digits = (const uint8_t *)"123456789", *name = (const uint8_t *)"Wikipedia";
    CHECK(t, checksum_crc32(0, digits, 9) == 0xcbf43926, "CRC-32 of 123456789");
    CHECK(t, checksum_crc32(checksum_crc32(0, digits, 4), digits + 4, 5) == 0xcbf43926, "CRC-32 in two pieces");
    CHECK(t, checksum_adler32(name, 9) == 0x11e60398, "Adler-32 of Wikipedia");
    size_t n = 1000000;
    uint8_t *ones = mem_alloc(n, 1);
    memset(ones, 255, n);
    uint64_t a = 1, b = 0;
    for (size_t i = 0; i < n; i++) {
        a = (a + 255) % 65521;
        b = (b + a) % 65521;
    }
    CHECK(t, checksum_adler32(ones, n) == (b << 16 | a), "Adler-32 of many large bytes does not overflow");
    free(ones);
}

/* Hexadecimal text as bytes, in a block of exactly that size. */
static uint8_t *from_hex(const char *hex, size_t *n)
{
    *n = strlen(hex) / 2;
    uint8_t *bytes = mem_alloc(*n, 1);
    for (size_t i = 0; i < *n; i++) {
        char digits[3] = {hex[2 * i], hex[2 * i + 1], '\0'};
        bytes[i] = (uint8_t)strtoul(digits, NULL, 16);
    }
    return bytes;
}

/* Unpack a copy of the stream that ends where its memory ends. */
static bool unpack(const uint8_t *stream, size_t n, uint8_t *out, size_t size)
{
    uint8_t *copy = mem_alloc(n, 1);
    memcpy(copy, stream, n);
    struct error err;
    bool ok = inflate_zlib(copy, n, out, size, &err);
    free(copy);
    return ok;
}

static void check_stream(struct test *t, const char *what, const char *hex, const uint8_t *expected, size_t size)
{
    size_t n;
    uint8_t *stream = from_hex(hex, &n), *out = mem_alloc(size, 1), *longer = mem_alloc(size + 1, 1);
    CHECK(t, unpack(stream, n, out, size) && memcmp(out, expected, size) == 0, "%s unpacks", what);
    CHECK(t, !unpack(stream, n, longer, size + 1), "%s: less than promised is refused", what);
    free(longer);
    uint8_t *shorter = mem_alloc(size - 1, 1);
    CHECK(t, !unpack(stream, n, shorter, size - 1), "%s: more than promised is refused", what);
    free(shorter);
    for (size_t length = 0; length < n; length++)
        CHECK(t, !unpack(stream, length, out, size), "%s: truncated to %lu bytes", what, (unsigned long)length);
    for (size_t i = 2; i < n; i++) {
        stream[i] ^= (uint8_t)(1 << i % 8);
        bool ok = unpack(stream, n, out, size);
        /* up to 7 bits after the last block are padding: any change elsewhere must be noticed */
        CHECK(t, !ok || (i == n - 5 && memcmp(out, expected, size) == 0), "%s: byte %lu changed", what,
              (unsigned long)i);
        stream[i] ^= (uint8_t)(1 << i % 8);
    }
    free(stream);
    free(out);
}

static void test_foreign_streams(struct test *t)
{
    uint8_t letters[1000];
    size_t n = 0, previous = 0, count = 1;
    for (int letter = 0; letter < 13; letter++) {
        memset(letters + n, 'A' + letter, count);
        n += count;
        size_t next = letter == 0 ? 1 : previous + count;
        previous = count;
        count = next;
    }
    check_stream(t, "codes of 1 to 13 bits", ZLIB_FIBONACCI, letters, n);
    char text[4096];
    size_t length = 0;
    for (int i = 0; i < 60; i++)
        length +=
            (size_t)snprintf(text + length, sizeof text - length, "%d bottles of %d beers on the wall\n", i, i * i);
    check_stream(t, "text", ZLIB_TEXT, (const uint8_t *)text, length);
}

/* Streams that no packer writes. Where the fault is in what nothing else checks, the rest is right. */
static void test_impossible_streams(struct test *t)
{
    static const struct {
        const char *hex;
        size_t size; /* unpacked */
    } CASES[] = {
        {"", 0},
        {"78", 0},
        {"789d030000000001", 0},               /* wrong check bits */
        {"799c030000000001", 0},               /* wrong method */
        {"78bb030000000001", 0},               /* preset dictionary */
        {"789c0700000001", 0},                   /* no such block */
        {"789c010500faff68656c6c6f062c0214", 5}, /* stored "hello"; ..15 would be right */
        {"789c010500fbff68656c6c6f062c0215", 5}, /* a length that contradicts itself */
        {"789c010500faff6865", 5},
        {"789c010600f9ff68656c6c6f062c0215", 5},
        {"789c73044200000000", 5}, /* a copy from before the beginning */
        {"789c731c0300000000", 5}, /* no such length */
        {"789c73043e00000000", 5}, /* no such distance */
        {"789c05e001040000004010000000000000000000", 5}, /* three codes of one bit */
        {"789c05e001080000008020000000000000000000", 5}, /* three codes of two bits */
        {"789c05e081000000000010f03f0d0000000000000000", 5},
        {"789c05e003040000000000040000000000000000", 5}, /* a length repeated before the first */
        {"789c05e081040000000000fcff030000000000000000", 5},
        {"789c05e081000000000010f07f0d0000000000000000", 5}, /* a block without end */
        {"789cfde001040000000010000000000000000000", 5},
    };
    uint8_t out[5];
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        size_t n;
        uint8_t *stream = from_hex(CASES[i].hex, &n);
        CHECK(t, !unpack(stream, n, out, CASES[i].size), "%s is accepted", CASES[i].hex);
        free(stream);
    }
    size_t n;
    uint8_t *hello = from_hex("789c010500faff68656c6c6f062c0215", &n);
    CHECK(t, unpack(hello, n, out, 5) && memcmp(out, "hello", 5) == 0, "a stored block unpacks");
    free(hello);
    uint8_t *empty = from_hex("789c030000000001", &n);
    CHECK(t, unpack(empty, n, out, 0), "nothing unpacks");
    free(empty);
}

static void check_round_trip(struct test *t, const char *what, const uint8_t *data, size_t n, size_t most)
{
    size_t size;
    uint8_t *packed = deflate_zlib(data, n, &size), *out = mem_alloc(n, 1);
    struct error err = {.text = ""};
    CHECK(t, inflate_zlib(packed, size, out, n, &err) && memcmp(out, data, n) == 0, "%s: %s", what, err.text);
    CHECK(t, size <= most, "%s: %lu bytes packed to %lu, expected at most %lu", what, (unsigned long)n,
          (unsigned long)size, (unsigned long)most);
    free(packed);
    free(out);
}

static void test_round_trips(struct test *t)
{
    enum { N = 300000 };
    uint8_t *data = mem_alloc(N, 1);
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 2, 0);
    for (size_t n = 0; n < 300; n += n < 10 || n > 250 ? 1 : 9)
        check_round_trip(t, "zeros", data, n, 16);
    check_round_trip(t, "many zeros", data, N, N / 150);
    for (size_t i = 0; i < N; i++)
        data[i] = (uint8_t)(rng_u32(&r) >> 24);
    for (size_t n = 0; n < 300; n += 13)
        check_round_trip(t, "noise", data, n, n + n / 8 + 16); /* of 8 and 9 bits to the byte */
    check_round_trip(t, "much noise", data, N, N + N / 16);
    memcpy(data + 32768, data, 1000); /* just beyond and just within the window */
    memcpy(data + 70000, data + 70000 - 32767, 1000);
    check_round_trip(t, "repeats at the window's edge", data, N, N + N / 19);
    for (size_t i = 0; i < N; i++)
        data[i] = (uint8_t)(rng_u32(&r) >> 24 & 3);
    check_round_trip(t, "two bits of noise", data, N, N / 2);
    for (size_t period = 1; period < 300; period += 37) {
        for (size_t i = period; i < N; i++)
            data[i] = data[i - period];
        check_round_trip(t, "periodic", data, N, N / 100);
    }
    free(data);
}

void test_zlib(struct test *t)
{
    test_checksums(t);
    test_foreign_streams(t);
    test_impossible_streams(t);
    test_round_trips(t);
}
