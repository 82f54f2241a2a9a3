/* 2-paths.c: light that is found by chance. The second of eight programs.
 *
 *     cc -O2 -o mini 2-paths.c -lm && ./mini 64 out.png
 *
 * New: a ray that met a surface continues from there in a random direction, until it has met DEPTH + 1 surfaces. If
 * one of them is the light, a path of light is complete. The pixel gets what the path carries: the emission times all
 * reflectances. The mean is right. But few paths find the light, so the image is mostly noise. */
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 128, DEPTH = 5, EYE_VERTICES = DEPTH + 2 }; /* pixels; most bounces of a path */
static const double PI = 3.14159265358979323846;

/* ---- Vectors: points, directions and colours (src/base/vec.h, rgb.h) --------------------------------------------- */
typedef struct { double x, y, z; } vec3;
typedef vec3 rgb; /* red, green, blue; linear */

static vec3 vec(double x, double y, double z) { return (vec3){x, y, z}; }
static vec3 add(vec3 a, vec3 b) { return vec(a.x + b.x, a.y + b.y, a.z + b.z); }
static vec3 sub(vec3 a, vec3 b) { return vec(a.x - b.x, a.y - b.y, a.z - b.z); }
static vec3 mul(vec3 a, double k) { return vec(a.x * k, a.y * k, a.z * k); }
static rgb tint(rgb a, rgb b) { return vec(a.x * b.x, a.y * b.y, a.z * b.z); }
static double dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static vec3 cross(vec3 a, vec3 b) { return vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x); }
static vec3 unit(vec3 a) { return mul(a, 1 / sqrt(dot(a, a))); }

/* ---- Random numbers in [0,1): SplitMix64 counts in large steps and scrambles the bits (src/base/rng.h) ----------- */
static double next(uint64_t *rng)
{
    uint64_t x = *rng += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return (double)((x ^ (x >> 31)) >> 11) / 9007199254740992.0; /* 53 bits, over 2^53 */
}

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
static const struct shape *const LAMP = &SCENE[0];
#define PINHOLE_AT {0.5, 0.5, -1.5} /* the lens, which looks along z */
static const double SCREEN = 0.36;  /* half of the image's height, at distance 1 */
static const double EPSILON = 1e-9; /* a hit is exact to about 1e-15; everything here is thicker than this */

static vec3 lamp_normal(void) { return cross(LAMP->a, LAMP->b); } /* its length is the light's area */

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

/* ---- Vertices, and how they scatter (src/transport/path.h, src/material/bsdf.h) ---------------------------------- */
struct vertex {
    const struct shape *shape;
    vec3 p, n, wo; /* point; unit normal, on the side the walk came from; unit direction back along the walk */
    rgb beta;      /* throughput: all factors on the way here, divided by the density of the walk */
};
static const struct vertex PINHOLE = {NULL, PINHOLE_AT, {0, 0, 1}, BLACK, {1, 1, 1}};

/* A unit vector about n with density cos / pi: a point of a disk, lifted to the hemisphere. (src/base/warp.h) */
static vec3 cosine_hemisphere(vec3 n, uint64_t *rng)
{
    double r2 = next(rng), phi = 2 * PI * next(rng);
    vec3 a = unit(cross(fabs(n.x) > 0.5 ? vec(0, 1, 0) : vec(1, 0, 0), n)), b = cross(n, a);
    return add(mul(add(mul(a, cos(phi)), mul(b, sin(phi))), sqrt(r2)), mul(n, sqrt(1 - r2)));
}

/* ---- The walk (src/transport/path.c) -------------------------------------------------------------------------------
 * It leaves path[0], which is given, in direction d. Returns the number of vertices, at most max. */
static int walk(struct vertex *path, int max, vec3 d, rgb beta, uint64_t *rng)
{
    for (int e = 1; e < max; e++) {
        struct vertex *v = &path[e], *from = &path[e - 1];
        double t = INFINITY;
        v->shape = nearest(from->p, d, &t);
        if (v->shape == NULL)
            return e;
        v->p = add(from->p, mul(d, t));
        v->n = normal(v->shape, v->p, d);
        v->wo = mul(d, -1);
        v->beta = beta;

        beta = tint(beta, v->shape->albedo); /* BSDF times cosine over density: they cancel */
        d = v->shape->mirror ? sub(d, mul(v->n, 2 * dot(v->n, d))) : cosine_hemisphere(v->n, rng);
    }
    return max;
}

static int path_eye(int x, int y, struct vertex *path, uint64_t *rng)
{
    double px = x + next(rng), py = y + next(rng);
    path[0] = PINHOLE;
    return walk(path, EYE_VERTICES, camera_direction(px, py), path[0].beta, rng);
}

/* ---- What a strategy contributes (src/transport/connect.c) ---------------------------------------------------------
 * The last of t eye vertices is on the light. */
static rgb connect_s0(const struct vertex *eye, int t)
{
    const struct vertex *z = &eye[t - 1];
    return z->shape == LAMP && dot(lamp_normal(), z->wo) > 0 ? tint(z->beta, LAMP->emission) : vec(0, 0, 0);
}

/* ---- Sums over strategies (src/transport/pixel_sample.c) --------------------------------------------------------- */
static rgb sum_eye(const struct vertex *eye, int n_eye)
{
    rgb sum = BLACK;
    for (int t = 2; t <= n_eye; t++) {
        sum = add(sum, connect_s0(eye, t));
    }
    return sum;
}

static void render(rgb *image, int spp, uint64_t *rng)
{
    for (int i = 0; i < SIZE * SIZE; i++) {
        for (int k = 0; k < spp; k++) {
            struct vertex eye[EYE_VERTICES];
            int n_eye = path_eye(i % SIZE, i / SIZE, eye, rng);
            image[i] = add(image[i], sum_eye(eye, n_eye));
        }
        if (i % SIZE == SIZE - 1)
            fprintf(stderr, "\r%3d %%%s", 100 * (i + 1) / (SIZE * SIZE), i + 1 < SIZE * SIZE ? "" : "\n");
    }
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

/* PFM, to compute with: linear floats, bottom row first, in the machine's order of bytes. */
static void write_pfm(FILE *f, const rgb *image, double scale)
{
    const int one = 1, order = *(const char *)&one == 1 ? -1 : 1; /* -1: little-endian */
    fprintf(f, "PF\n%d %d\n%d\n", SIZE, SIZE, order);
    for (int i = 0; i < SIZE * SIZE; i++) {
        rgb c = mul(image[(SIZE - 1 - i / SIZE) * SIZE + i % SIZE], scale);
        float value[3] = {(float)c.x, (float)c.y, (float)c.z};
        fwrite(value, sizeof value, 1, f);
    }
}

int main(int argc, char **argv)
{
    int spp = argc > 1 ? atoi(argv[1]) : 0;
    if (argc < 3 || argc > 4 || spp < 1)
        return fprintf(stderr, "usage: %s SAMPLES OUT.png|OUT.pfm [SEED]\n", argv[0]), 2;
    uint64_t rng = argc > 3 ? (uint64_t)strtoul(argv[3], NULL, 10) << 40 : 0; /* no image takes 2^40 numbers */
    static rgb image[SIZE * SIZE]; /* sums over samples, top row first */
    FILE *f = fopen(argv[2], "wb");
    if (f == NULL)
        return perror(argv[2]), 1;
    render(image, spp, &rng);
    (strstr(argv[2], ".pfm") != NULL ? write_pfm : write_png)(f, image, 1.0 / spp);
    bool good = !ferror(f);
    return fclose(f) == 0 && good ? 0 : (perror(argv[2]), 1);
}
