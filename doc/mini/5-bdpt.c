/* 5-bdpt.c: both walks, connected. The fifth of eight programs.
 *
 *     cc -O2 -o mini 5-bdpt.c -lm && ./mini bdpt 64 out.png
 *
 * New: bidirectional path tracing. Every vertex of a light sub-path is connected to every vertex of an eye sub-path.
 * Several *strategies* then find the same path: strategy (s,t) finds it with s vertices from the light and t from the
 * eye. Each strategy has a weight, and the weights of a path add up to 1 (heading "Weights"). */
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 128, DEPTH = 5, LIGHT_VERTICES = DEPTH + 1, EYE_VERTICES = DEPTH + 2 }; /* pixels; bounces */
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
static double lamp_area(void) { return sqrt(dot(lamp_normal(), lamp_normal())); }

/* The direction that is seen at a point of the image, in pixels from its upper left corner. */
static vec3 camera_direction(double px, double py)
{
    double width = 2 * SCREEN / SIZE; /* of a pixel */
    return unit(vec((px - SIZE * 0.5) * width, (SIZE * 0.5 - py) * width, 1));
}

/* Where direction w enters the image, in pixels, and J, the pixels that a steradian covers there: seen from the
 * pinhole, an area dx dy of the screen at distance 1 fills dx dy cos^3. 0: outside. (src/scene/camera.c) */
static double camera_project(vec3 w, double *x, double *y)
{
    double pixels = SIZE / (2 * SCREEN), cosine = w.z / sqrt(dot(w, w));
    *x = SIZE * 0.5 + pixels * w.x / w.z;
    *y = SIZE * 0.5 - pixels * w.y / w.z;
    bool inside = w.z > 0 && *x >= 0 && *x < SIZE && *y >= 0 && *y < SIZE;
    return inside ? pixels * pixels / pow(cosine, 3) : 0;
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
    enum { LENS, LIGHT, SURFACE } kind;
    const struct shape *shape;
    vec3 p, n, wo; /* point; unit normal, on the side the walk came from; unit direction back along the walk */
    rgb beta;      /* throughput: all factors on the way here, divided by the density of the walk */
    double F;      /* density per area with which its walk chose this point */
    double c, mis; /* c_e and mis_e of "Weights" */
};
/* The camera. No light sub-path finds a pinhole by chance, so no weight needs its density: F = 1, c = 0. */
static const struct vertex PINHOLE = {LENS, NULL, PINHOLE_AT, {0, 0, 1}, BLACK, {1, 1, 1}, 1, 0, 0};

/* A connection cannot end at a mirror: the other end would have to lie exactly in its direction. */
static bool connectible(const struct vertex *v) { return v->kind != SURFACE || !v->shape->mirror; }

/* What v does to light between its wo and w, the direction of a connection: BSDF (of a light: emission) times cosine;
 * densities per steradian of a walk that leaves towards w, and of the reverse walk, from w towards wo. */
struct scatter { rgb factor; double pdf, pdf_rev; };
static struct scatter scatter_towards(const struct vertex *v, vec3 w)
{
    struct scatter s = {BLACK, 0, 0};
    double cosine = dot(v->n, w), x, y;
    if (v->kind == LENS) { /* eye rays are uniform over pixels, and each counts 1 */
        s.pdf = camera_project(w, &x, &y);
        s.factor = vec(s.pdf, s.pdf, s.pdf);
    } else if (cosine > 0 && connectible(v)) {
        s.factor = v->kind == LIGHT ? mul(v->shape->emission, cosine) : mul(v->shape->albedo, cosine / PI);
        s.pdf = cosine / PI;
        s.pdf_rev = v->kind == LIGHT ? 0 : dot(v->n, v->wo) / PI;
    }
    return s;
}

/* A unit vector about n with density cos / pi: a point of a disk, lifted to the hemisphere. (src/base/warp.h) */
static vec3 cosine_hemisphere(vec3 n, uint64_t *rng)
{
    double r2 = next(rng), phi = 2 * PI * next(rng);
    vec3 a = unit(cross(fabs(n.x) > 0.5 ? vec(0, 1, 0) : vec(1, 0, 0), n)), b = cross(n, a);
    return add(mul(add(mul(a, cos(phi)), mul(b, sin(phi))), sqrt(r2)), mul(n, sqrt(1 - r2)));
}

/* ---- Weights (src/transport/mis.h) ---------------------------------------------------------------------------------
 * Let p_s be the density of strategy (s,t) times n_s, the samples it takes. The balance heuristic gives it the weight
 *     w_s = p_s / (p_0 + p_1 + ... + p_k):                                                          [Veach 1997, 9.2.2]
 * large where s finds the path easily. p_i and p_(i+1) differ in one vertex, x_i, which has density F in its own walk
 * and R in the reverse walk: p_i / p_(i+1) = (n_i R_i) / (n_(i+1) F_i). Multiply such ratios outwards from the
 * connection. Then the p of all strategies on one side add up, relative to one sample of strategy s, to
 *     A_e = R_e/F_e (c_e + R_(e-1)/F_(e-1) (c_(e-1) + ...)),     c_e: n of the strategy that connects x_(e-1), x_e.
 * A walk can add this up, except R_e and R_(e-1), which depend on the connection at e. So it stores the rest, mis_e,
 * and a one-line function finishes it: a weight costs O(1), however long the path. */
struct counts { /* the number n of samples per pixel; 0: the method does not use the strategy */
    double s0;           /* s = 0: the eye sub-path hits the light */
    double s1;           /* s = 1: it is connected to a fresh point on the light */
    double connect;      /* s > 1, t > 1: it is connected to a light sub-path */
    double splat;        /* t = 1: all light sub-paths of the image are connected to the lens */
};

/* n of the strategy that connects y, the end of a light sub-path, and z, the end of an eye sub-path. */
static double count(const struct counts *n, const struct vertex *y, const struct vertex *z)
{
    if (!connectible(y) || !connectible(z))
        return 0;
    return z->kind == LENS ? n->splat : y->kind == LIGHT ? n->s1 : n->connect;
}

/* A_e = R_e * this, of vertex v = x_e, and mis_(e+1) = g * this, where g converts a density per steradian at x_(e+1)
 * into one per area at x_e. pdf_rev: per steradian, of the reverse walk from v to the vertex before it. */
static double sum_over_F(const struct vertex *v, double pdf_rev) { return (v->c + pdf_rev * v->mis) / v->F; }

/* ---- The walk (src/transport/path.c) -------------------------------------------------------------------------------
 * Nature does not mind which way light goes, so one function makes both kinds of sub-path. It leaves path[0], which is
 * made, in direction d, chosen with density pdf per steradian. Returns the number of vertices, at most max. */
static int walk(const struct counts *n, struct vertex *path, int max, vec3 d, double pdf, rgb beta, uint64_t *rng)
{
    double pdf_rev = 0;
    for (int e = 1; e < max; e++) {
        struct vertex *v = &path[e], *from = &path[e - 1];
        double t = INFINITY;
        v->kind = SURFACE;
        v->shape = nearest(from->p, d, &t);
        if (v->shape == NULL)
            return e;
        v->p = add(from->p, mul(d, t));
        v->n = normal(v->shape, v->p, d);
        v->wo = mul(d, -1);
        v->beta = beta;
        v->F = pdf * dot(v->n, v->wo) / (t * t); /* per steradian at `from`, times cosine / distance^2: per area here */
        v->mis = fabs(dot(from->n, d)) / (t * t) * sum_over_F(from, pdf_rev);
        v->c = path[0].kind == LIGHT ? count(n, from, v) : count(n, v, from);

        beta = tint(beta, v->shape->albedo); /* BSDF times cosine over density: they cancel */
        d = v->shape->mirror ? sub(d, mul(v->n, 2 * dot(v->n, d))) : cosine_hemisphere(v->n, rng);
        pdf = v->shape->mirror ? 1 : dot(v->n, d) / PI; /* mirror: a delta function in F and in R, which cancels too */
        pdf_rev = v->shape->mirror ? 1 : dot(v->n, v->wo) / PI;
    }
    return max;
}

/* y_0, uniform on the light: beta is 1/density; c is the count of s = 0, which finds the point by chance. */
static struct vertex light_point(const struct counts *n, uint64_t *rng)
{
    double area = lamp_area(), u = next(rng), v = next(rng);
    vec3 p = add(LAMP->p, add(mul(LAMP->a, u), mul(LAMP->b, v)));
    return (struct vertex){LIGHT, LAMP, p, unit(lamp_normal()), BLACK, {area, area, area}, 1 / area, n->s0, 0};
}

struct light_path {
    struct vertex v[LIGHT_VERTICES]; /* y_0, y_1 ... y_(n-1) */
    int n;                           /* how many */
};

static void path_light(const struct counts *n, struct light_path *path, uint64_t *rng)
{
    struct vertex *y = path->v;
    y[0] = light_point(n, rng);
    vec3 d = cosine_hemisphere(y[0].n, rng); /* emission cos / (cos / pi) is emission pi */
    path->n = walk(n, y, LIGHT_VERTICES, d, dot(y[0].n, d) / PI, mul(tint(y[0].beta, LAMP->emission), PI), rng);
}

static int path_eye(const struct counts *n, int x, int y, struct vertex *path, uint64_t *rng)
{
    double px = x + next(rng), py = y + next(rng);
    vec3 d = camera_direction(px, py);
    path[0] = PINHOLE;
    return walk(n, path, EYE_VERTICES, d, camera_project(d, &px, &py), path[0].beta, rng);
}

/* ---- What a strategy contributes (src/transport/connect.c) ---------------------------------------------------------
 * s > 0: connect y and z. Both throughputs, both scatterings, 1/distance^2, visibility, and the weight. */
static rgb connect(const struct counts *n, const struct vertex *y, const struct vertex *z)
{
    vec3 d = sub(y->p, z->p), w = unit(d);
    double d2 = dot(d, d), t = sqrt(d2) - EPSILON, own = count(n, y, z);
    struct scatter at_y = scatter_towards(y, mul(w, -1)), at_z = scatter_towards(z, w);
    if (own == 0 || at_y.pdf == 0 || at_z.pdf == 0 || nearest(z->p, w, &t) != NULL)
        return vec(0, 0, 0);
    rgb value = mul(tint(tint(y->beta, at_y.factor), tint(z->beta, at_z.factor)), 1 / d2);
    double light_side = at_z.pdf * fabs(dot(y->n, w)) / d2 * sum_over_F(y, at_y.pdf_rev);
    double eye_side = at_y.pdf * fabs(dot(z->n, w)) / d2 * sum_over_F(z, at_z.pdf_rev);
    return mul(value, own / (own + light_side + eye_side));
}

/* s = 0: the last of t eye vertices is on the light. If it is seen directly (t = 2), no other strategy finds it. */
static rgb connect_s0(const struct counts *n, const struct vertex *eye, int t)
{
    struct vertex z = eye[t - 1];
    if (z.shape != LAMP || dot(lamp_normal(), z.wo) <= 0)
        return vec(0, 0, 0);
    z.c = connectible(&eye[t - 2]) ? n->s1 : 0; /* here z is the end of s = 1, not a surface */
    double eye_side = t == 2 ? 0 : sum_over_F(&z, dot(z.n, z.wo) / PI) / lamp_area();
    return mul(tint(z.beta, LAMP->emission), n->s0 / (n->s0 + eye_side));
}

/* ---- Sums over strategies (src/transport/pixel_sample.c) --------------------------------------------------------- */
static rgb sum_eye(const struct counts *n, const struct vertex *eye, int n_eye, uint64_t *rng) /* s = 0 and s = 1 */
{
    rgb sum = BLACK;
    for (int t = 2; t <= n_eye; t++) {
        struct vertex y = light_point(n, rng);
        sum = add(sum, connect_s0(n, eye, t));
        sum = t <= DEPTH + 1 ? add(sum, connect(n, &y, &eye[t - 1])) : sum;
    }
    return sum;
}

/* s > 1, t > 1: every pair of vertices that makes no path too long. */
static rgb sum_pairs(const struct counts *n, const struct vertex *eye, int n_eye, const struct light_path *light)
{
    rgb sum = BLACK;
    for (int t = 2; t <= n_eye; t++)
        for (int s = 2; s <= light->n && s + t <= DEPTH + 2; s++)
            sum = add(sum, connect(n, &light->v[s - 1], &eye[t - 1]));
    return sum;
}

/* t = 1: each vertex of a light sub-path, as the camera sees it, somewhere in the image. */
static void splat_path(const struct counts *n, const struct light_path *light, rgb *image)
{
    for (int s = 2; s <= light->n; s++) {
        double x, y;
        if (camera_project(sub(light->v[s - 1].p, PINHOLE.p), &x, &y) == 0)
            continue;
        rgb *pixel = &image[(int)y * SIZE + (int)x];
        *pixel = add(*pixel, mul(connect(n, &light->v[s - 1], &PINHOLE), 1 / n->splat));
    }
}

enum method { PT, BDPT, METHODS };
static const char *const NAMES[METHODS] = {"pt", "bdpt"};
#define CHOICES "pt|bdpt"

/* Path tracing is the case in which the other strategies take no samples. */
static void render(rgb *image, enum method method, int spp, uint64_t *rng)
{
    const struct counts n = {1, 1, method == PT ? 0 : 1, method == PT ? 0 : SIZE * SIZE};
    struct light_path light = {.n = 0};
    for (int i = 0; i < SIZE * SIZE; i++) {
        for (int k = 0; k < spp; k++) {
            struct vertex eye[EYE_VERTICES];
            int n_eye = path_eye(&n, i % SIZE, i / SIZE, eye, rng);
            if (method == BDPT)
                path_light(&n, &light, rng);
            rgb sum = add(sum_eye(&n, eye, n_eye, rng), sum_pairs(&n, eye, n_eye, &light));
            image[i] = add(image[i], sum);
            splat_path(&n, &light, image);
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
    int method = 0, spp = argc > 2 ? atoi(argv[2]) : 0;
    while (argc > 1 && method < METHODS && strcmp(argv[1], NAMES[method]) != 0)
        method++;
    if (argc < 4 || argc > 5 || method == METHODS || spp < 1)
        return fprintf(stderr, "usage: %s " CHOICES " SAMPLES OUT.png|OUT.pfm [SEED]\n", argv[0]), 2;
    uint64_t rng = argc > 4 ? (uint64_t)strtoul(argv[4], NULL, 10) << 40 : 0; /* no image takes 2^40 numbers */
    static rgb image[SIZE * SIZE]; /* sums over samples, top row first */
    FILE *f = fopen(argv[3], "wb");
    if (f == NULL)
        return perror(argv[3]), 1;
    render(image, (enum method)method, spp, &rng);
    (strstr(argv[3], ".pfm") != NULL ? write_pfm : write_png)(f, image, 1.0 / spp);
    bool good = !ferror(f);
    return fclose(f) == 0 && good ? 0 : (perror(argv[3]), 1);
}
