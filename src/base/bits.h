/* bits.h: words of bits mixed, hashed, reversed, and the bytes and floats that they are in files.
 * Tests: test_vec.c; test_image.c and test_ply.c read every byte order. */
#ifndef ASBDPT_BITS_H
#define ASBDPT_BITS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* hash_mix: a bijection of 64-bit words in which every input bit moves every output bit; 0 stays 0. It is the last step
 * of SplitMix64 [Steele 2014]. */
static inline uint64_t hash_mix(uint64_t x)
{
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/* hash_combine: a hash of the hash h and one more value. */
static inline uint64_t hash_combine(uint64_t h, uint64_t value)
{
    return hash_mix(h * 0x9e3779b97f4a7c15u + value + 1);
}

/* hash_content: a hash of n bytes, eight at a time: tells apart what nobody has forged. The same on all machines. */
static inline uint64_t hash_content(const void *data, size_t n)
{
    const uint8_t *byte = (const uint8_t *)data;
    uint64_t h = n;
    for (; n > 0; byte += n < 8 ? n : 8, n -= n < 8 ? n : 8) {
        uint64_t word = 0;
        for (size_t i = 0; i < 8 && i < n; i++)
            word |= (uint64_t)byte[i] << (8 * i);
        h = hash_combine(h, word);
    }
    return h;
}

/* reverse_bits: bit i becomes bit 31 - i. */
static inline uint32_t reverse_bits(uint32_t x)
{
    x = (x >> 16) | (x << 16);
    x = ((x & 0xff00ff00u) >> 8) | ((x & 0x00ff00ffu) << 8);
    x = ((x & 0xf0f0f0f0u) >> 4) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x & 0xccccccccu) >> 2) | ((x & 0x33333333u) << 2);
    return ((x & 0xaaaaaaaau) >> 1) | ((x & 0x55555555u) << 1);
}

/* bits_of_bytes: the number that n <= 8 bytes stand for. */
static inline uint64_t bits_of_bytes(const uint8_t *byte, size_t n, bool big_endian)
{
    uint64_t bits = 0;
    for (size_t i = 0; i < n; i++)
        bits = bits << 8 | byte[big_endian ? i : n - 1 - i];
    return bits;
}

/* bytes_of_bits: the last n <= 8 bytes of a number, to byte[n]. */
static inline void bytes_of_bits(uint64_t bits, uint8_t *byte, size_t n, bool big_endian)
{
    for (size_t i = 0; i < n; i++, bits >>= 8)
        byte[big_endian ? n - 1 - i : i] = (uint8_t)(bits & 255);
}

/* float_of_bits, bits_of_float: the float that 32 bits stand for, and back. */
static inline float float_of_bits(uint32_t bits)
{
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}
static inline uint32_t bits_of_float(float x)
{
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

#endif
