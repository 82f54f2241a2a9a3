/* 1-rays.c: a ray meets a square. The first of eight programs, of which the last, asbdpt.c, is the whole method.
 *
 *     cc -O2 -o mini 1-rays.c -lm && ./mini out.png
 *
 * For each pixel the program finds the surface that its ray meets first. The pixel gets the colour of this surface,
 * darker if the ray meets it at a slant. Where the light comes from is left to the next programs. */
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIZE = 128 }; /* pixels */

/* ---- Vectors: points, directions and colours (src/base/vec.h, rgb.h) --------------------------------------------- */
typedef struct { double x, y, z; } vec3;
typedef vec3 rgb; /* red, green, blue; linear */

static vec3 vec(double x, double y, double z) { return (vec3){x, y, z}; }
static vec3 sub(vec3 a, vec3 b) { return vec(a.x - b.x, a.y - b.y, a.z - b.z); }
static vec3 mul(vec3 a, double k) { return vec(a.x * k, a.y * k, a.z * k); }
static double dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static vec3 cross(vec3 a, vec3 b) { return vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x); }
static vec3 unit(vec3 a) { return mul(a, 1 / sqrt(dot(a, a))); }

/* ---- The scene (src/scene) -----------------------------------------------------------------------------------------
 * Two Cornell boxes, one behind the other, joined by a gap: x to the right, y up, z away. The light is in the far
 * one, so most light sub-paths never reach what the camera sees. Surfaces are matte, or perfect mirrors. */
struct shape {
    vec3 p, a, b;         /* a rectangle's corner and the two edges that meet there; p: a ball's centre */
    double radius;        /* of a ball; a rectangle has none */
    rgb albedo, emission; /* share of light reflected; radiance in W/(sr m^2), on the side of a x b */
    bool mirror;
};
#define BLACK {0, 0, 0}
#define WHITE {0.75, 0.75, 0.75}
static const struct shape SCENE[] = {
    {{0.2, 0.98, 1.3}, {0.4, 0, 0}, {0, 0, 0.4}, 0, WHITE, {120, 102, 72}, false}, /* the light, facing down */
    {{0, 0, 1}, {0.8, 0, 0}, {0, 1, 0}, 0, WHITE, BLACK, false},                 /* the wall between the rooms */
    {{0, 0, 2}, {1, 0, 0}, {0, 1, 0}, 0, WHITE, BLACK, false},                   /* the far wall */
    {{0, 0, 0}, {1, 0, 0}, {0, 0, 2}, 0, WHITE, BLACK, false},                   /* floor */
    {{0, 1, 0}, {1, 0, 0}, {0, 0, 2}, 0, WHITE, BLACK, false},                   /* ceiling */
    {{0, 0, 0}, {0, 1, 0}, {0, 0, 2}, 0, {0.65, 0.06, 0.05}, BLACK, false},      /* left wall, red */
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 2}, 0, {0.12, 0.45, 0.10}, BLACK, false},      /* right wall, green */
    {{0.30, 0.20, 0.65}, BLACK, BLACK, 0.20, {0.9, 0.9, 0.9}, BLACK, true},
    {{0.70, 0.17, 0.35}, BLACK, BLACK, 0.17, {0.3, 0.4, 0.7}, BLACK, false},
};
#define PINHOLE_AT {0.5, 0.5, -1.5} /* the lens, which looks along z */
static const double SCREEN = 0.36;  /* half of the image's height, at distance 1 */
static const double EPSILON = 1e-9; /* a hit is exact to about 1e-15; everything here is thicker than this */

/* The direction that is seen at a point of the image, in pixels from its upper left corner. */
static vec3 camera_direction(double px, double py)
{
    double width = 2 * SCREEN / SIZE; /* of a pixel */
    return unit(vec((px - SIZE * 0.5) * width, (SIZE * 0.5 - py) * width, 1));
}

/* ---- Rays (src/geometry/kdtree.c) ----------------------------------------------------------------------------------
 * Where does the ray o + t d, d of length 1, meet the shape? Nowhere is infinitely far. */
static double hit(const struct shape *s, vec3 o, vec3 d)
{
    vec3 to = sub(s->p, o);
    if (s->radius > 0) {
        double half = dot(to, d), under_root = half * half - dot(to, to) + s->radius * s->radius;
        double root = under_root < 0 ? INFINITY : sqrt(under_root);
        return half - root > EPSILON ? half - root : half + root;
    }
    vec3 n = cross(s->a, s->b);
    double t = dot(n, to) / dot(n, d);
    vec3 at = sub(mul(d, t), to); /* from the corner to the hit */
    double u = dot(at, s->a) / dot(s->a, s->a), v = dot(at, s->b) / dot(s->b, s->b);
    return u >= 0 && u <= 1 && v >= 0 && v <= 1 ? t : INFINITY;
}

/* The nearest shape closer than *t, which becomes its distance; NULL if there is none. There are only nine: try all. */
static const struct shape *nearest(vec3 o, vec3 d, double *t)
{
    const struct shape *found = NULL;
    for (int i = 0; i < (int)(sizeof SCENE / sizeof SCENE[0]); i++) {
        double here = hit(&SCENE[i], o, d);
        if (here > EPSILON && here < *t) {
            *t = here;
            found = &SCENE[i];
        }
    }
    return found;
}

/* The shape's unit normal at p, on the side that direction d comes from. */
static vec3 normal(const struct shape *s, vec3 p, vec3 d)
{
    vec3 n = unit(s->radius > 0 ? sub(p, s->p) : cross(s->a, s->b));
    return mul(n, dot(n, d) > 0 ? -1 : 1);
}

static rgb seen(vec3 o, vec3 d)
{
    double t = INFINITY;
    const struct shape *s = nearest(o, d, &t);
    if (s == NULL)
        return vec(0, 0, 0);
    vec3 p = sub(mul(d, t), mul(o, -1)); /* o + t d */
    return s->emission.x > 0 ? vec(1, 1, 1) : mul(s->albedo, -dot(normal(s, p, d), d));
}

/* ---- Images (src/image/png.c) --------------------------------------------------------------------------------------
 * PNG: chunks, each with a checksum. Its pixels are a zlib stream, here of blocks that are stored as they are. */
static void put(FILE *f, uint32_t *crc, unsigned byte)
{
    fputc((int)byte, f);
    *crc ^= byte;
    for (int k = 0; k < 8; k++)
        *crc = (*crc >> 1) ^ (*crc & 1 ? 0xedb88320u : 0);
}

static void put32(FILE *f, uint32_t *crc, uint32_t x) /* highest byte first */
{
    for (int shift = 24; shift >= 0; shift -= 8)
        put(f, crc, x >> shift & 255);
}

static void chunk_begin(FILE *f, uint32_t *crc, uint32_t size, const char *name)
{
    put32(f, crc, size);
    *crc = 0xffffffffu;
    for (int k = 0; k < 4; k++)
        put(f, crc, (unsigned)name[k]);
}

static unsigned screen_byte(double x) /* on a screen's sRGB curve */
{
    double y = x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055;
    return (unsigned)(fmin(fmax(y, 0), 1) * 255 + 0.5);
}

static void write_png(FILE *f, const rgb *image, double scale)
{
    enum { ROW = 1 + 3 * SIZE }; /* a row is a filter, none, and its pixels: one block */
    uint32_t crc = 0, a = 1, b = 0;
    fputs("\x89PNG\r\n\x1a\n", f);
    chunk_begin(f, &crc, 13, "IHDR");
    put32(f, &crc, SIZE);
    put32(f, &crc, SIZE);
    put32(f, &crc, 0x08020000u); /* 8 bits, RGB */
    put(f, &crc, 0);
    put32(f, &crc, ~crc);
    chunk_begin(f, &crc, 2 + SIZE * (5 + ROW) + 4, "IDAT");
    put(f, &crc, 0x78);
    put(f, &crc, 0x01);
    for (int y = 0; y < SIZE; y++) {
        const unsigned head[5] = {y == SIZE - 1, ROW & 255, ROW >> 8, ~ROW & 255, ~ROW >> 8 & 255};
        for (int k = 0; k < 5; k++)
            put(f, &crc, head[k]);
        for (int k = 0; k < ROW; k++) {
            rgb c = mul(image[y * SIZE + (k > 0 ? (k - 1) / 3 : 0)], scale);
            unsigned byte = k == 0 ? 0 : screen_byte(k % 3 == 1 ? c.x : k % 3 == 2 ? c.y : c.z);
            put(f, &crc, byte);
            a = (a + byte) % 65521;
            b = (b + a) % 65521;
        }
    }
    put32(f, &crc, b << 16 | a);
    put32(f, &crc, ~crc);
    chunk_begin(f, &crc, 0, "IEND");
    put32(f, &crc, ~crc);
}

int main(int argc, char **argv)
{
    if (argc != 2)
        return fprintf(stderr, "usage: %s OUT.png\n", argv[0]), 2;
    static rgb image[SIZE * SIZE]; /* top row first */
    const vec3 lens = PINHOLE_AT;
    FILE *f = fopen(argv[1], "wb");
    if (f == NULL)
        return perror(argv[1]), 1;
    for (int i = 0; i < SIZE * SIZE; i++)
        image[i] = seen(lens, camera_direction(i % SIZE + 0.5, i / SIZE + 0.5));
    write_png(f, image, 1);
    bool good = !ferror(f);
    return fclose(f) == 0 && good ? 0 : (perror(argv[1]), 1);
}
