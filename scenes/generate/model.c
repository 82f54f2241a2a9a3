/* model.c: see model.h. */
#include "model.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void die(const char *what)
{
    fprintf(stderr, "generate: %s\n", what);
    exit(1);
}

static void *grow(void *p, size_t *capacity, size_t needed, size_t element)
{
    if (needed <= *capacity) return p;
    while (*capacity < needed) *capacity = *capacity * 2 + 64;
    p = realloc(p, *capacity * element);
    if (p == NULL) die("out of memory");
    return p;
}

void model_begin(struct model *m)
{
    memset(m, 0, sizeof *m);
    m->uv_scale = 1;
    model_home(m);
}

/* ---- placement ---- */

void model_home(struct model *m)
{
    static const struct placement identity = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};
    m->at = identity;
}

void model_translate(struct model *m, double x, double y, double z)
{
    for (int i = 0; i < 3; i++) m->at.t[i] += m->at.m[i] * x + m->at.m[3 + i] * y + m->at.m[6 + i] * z;
}

void model_rotate(struct model *m, int axis, double degrees)
{
    double c = cos(degrees * TAU / 360), s = sin(degrees * TAU / 360);
    double *a = m->at.m + 3 * ((axis + 1) % 3), *b = m->at.m + 3 * ((axis + 2) % 3);
    for (int i = 0; i < 3; i++) {
        double p = a[i], q = b[i];
        a[i] = c * p + s * q;
        b[i] = c * q - s * p;
    }
}

void model_scale(struct model *m, double x, double y, double z)
{
    for (int i = 0; i < 3; i++) {
        m->at.m[i] *= x;
        m->at.m[3 + i] *= y;
        m->at.m[6 + i] *= z;
    }
}

/* ---- vectors ---- */

static void cross(const double a[3], const double b[3], double out[3])
{
    double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
    out[0] = x;
    out[1] = y;
    out[2] = z;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double normalise(double a[3])
{
    double l = sqrt(dot(a, a));
    for (int i = 0; i < 3 && l > 0; i++) a[i] /= l;
    return l;
}

/* Appends one vertex under the current placement; a normal goes through the cofactor matrix. */
static void add_vertex(struct model *m, const double p[3], const double n[3], double u, double v)
{
    const double *a = m->at.m, *b = a + 3, *c = a + 6;
    double bc[3], ca[3], ab[3], q[8];
    cross(b, c, bc);
    cross(c, a, ca);
    cross(a, b, ab);
    double sign = dot(a, bc) < 0 ? -1 : 1;
    for (int i = 0; i < 3; i++) {
        q[i] = a[i] * p[0] + b[i] * p[1] + c[i] * p[2] + m->at.t[i];
        q[3 + i] = sign * (bc[i] * n[0] + ca[i] * n[1] + ab[i] * n[2]);
    }
    normalise(q + 3);
    q[6] = u;
    q[7] = v;
    m->vertex = grow(m->vertex, &m->vertex_capacity, m->n_vertices + 1, sizeof q);
    memcpy(m->vertex + m->n_vertices * 8, q, sizeof q);
    m->n_vertices++;
}

static void add_face(struct model *m, size_t a, size_t b, size_t c)
{
    const double *p = m->vertex + 8 * a, *q = m->vertex + 8 * b, *r = m->vertex + 8 * c;
    double e[3], f[3], n[3];
    for (int i = 0; i < 3; i++) {
        e[i] = q[i] - p[i];
        f[i] = r[i] - p[i];
    }
    cross(e, f, n);
    if (dot(n, n) < 1e-18) return; /* the pole of a patch */
    m->face = grow(m->face, &m->face_capacity, m->n_faces + 1, 3 * sizeof *m->face);
    int *out = m->face + 3 * m->n_faces++;
    out[0] = (int)a;
    out[1] = (int)b;
    out[2] = (int)c;
}

/* The cells of a grid of (nu+1) x (nv+1) vertices that begins at vertex `first`, v fastest. */
static void add_grid_faces(struct model *m, size_t first, int nu, int nv)
{
    size_t row = (size_t)nv + 1;
    for (size_t i = 0; i < (size_t)nu; i++) {
        for (size_t j = 0; j < (size_t)nv; j++) {
            size_t a = first + i * row + j;
            add_face(m, a, a + row, a + row + 1);
            add_face(m, a, a + row + 1, a + 1);
        }
    }
}

/* ---- pieces ---- */

void model_quad(struct model *m, const double a[3], const double e[3], const double f[3])
{
    double n[3], p[3];
    size_t first = m->n_vertices;
    double lu = sqrt(dot(e, e)) * m->uv_scale, lv = sqrt(dot(f, f)) * m->uv_scale;
    cross(e, f, n);
    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < 2; j++) {
            for (int k = 0; k < 3; k++) p[k] = a[k] + i * e[k] + j * f[k];
            add_vertex(m, p, n, i * lu, j * lv);
        }
    }
    add_grid_faces(m, first, 1, 1);
}

/* Grid line number i along an axis of half length h: `steps` lines of the rounding, the flat, `steps` lines. */
static double box_line(int i, int steps, double h, double radius)
{
    int from_end = i <= steps ? i : 2 * steps + 1 - i;
    double t = radius > 0 ? tan((steps - from_end) * TAU / 8 / steps) : 0;
    return (i <= steps ? -1 : 1) * (h - radius + radius * t);
}

void model_box(struct model *m, const double lo[3], const double hi[3], double radius, int steps)
{
    double h[3], mid[3];
    int lines = radius > 0 ? 2 * steps + 2 : 2;
    if (!(radius > 0)) steps = 0;
    for (int i = 0; i < 3; i++) {
        h[i] = (hi[i] - lo[i]) / 2;
        mid[i] = (hi[i] + lo[i]) / 2;
    }
    for (int side = 0; side < 6; side++) {
        int a = side / 2, b = (a + 1) % 3, c = (a + 2) % 3;
        double sign = side % 2 ? 1 : -1;
        size_t first = m->n_vertices;
        for (int i = 0; i < lines; i++) {
            for (int j = 0; j < lines; j++) {
                double q[3], n[3], core[3], p[3];
                q[a] = sign * h[a];
                q[b] = sign * box_line(i, steps, h[b], radius);
                q[c] = box_line(j, steps, h[c], radius);
                for (int k = 0; k < 3; k++) {
                    double limit = h[k] - radius;
                    core[k] = q[k] < -limit ? -limit : q[k] > limit ? limit : q[k];
                    n[k] = radius > 0 ? q[k] - core[k] : k == a ? sign : 0;
                }
                normalise(n);
                for (int k = 0; k < 3; k++) p[k] = mid[k] + core[k] + radius * n[k];
                double s = q[a == 0 ? 2 : 0], t = q[a == 1 ? 2 : 1];
                add_vertex(m, p, n, (s + h[0] + h[2]) * m->uv_scale, (t + h[1]) * m->uv_scale);
            }
        }
        add_grid_faces(m, first, lines - 1, lines - 1);
    }
}

static double inside(double x)
{
    return x < 1e-3 ? 1e-3 : x > 1 - 1e-3 ? 1 - 1e-3 : x;
}

/* Differences over a small step; at a pole, where one of them vanishes, a little away from it. */
static void patch_normal(surface_function *f, const void *context, double u, double v, double n[3])
{
    const double h = 1e-4;
    double p[3], q[3], du[3], dv[3];
    u = inside(u);
    v = inside(v);
    f(context, u - h, v, p);
    f(context, u + h, v, q);
    for (int i = 0; i < 3; i++) du[i] = q[i] - p[i];
    f(context, u, v - h, p);
    f(context, u, v + h, q);
    for (int i = 0; i < 3; i++) dv[i] = q[i] - p[i];
    cross(du, dv, n);
    normalise(n);
}

void model_patch(struct model *m, surface_function *f, const void *context, int nu, int nv)
{
    size_t first = m->n_vertices;
    for (int i = 0; i <= nu; i++) {
        for (int j = 0; j <= nv; j++) {
            double u = (double)i / nu, v = (double)j / nv, p[3], n[3];
            f(context, u, v, p);
            patch_normal(f, context, u, v, n);
            add_vertex(m, p, n, u * m->uv_scale, v * m->uv_scale);
        }
    }
    add_grid_faces(m, first, nu, nv);
}

/* Catmull-Rom through n points of `dim` numbers at x in [0,1]. */
static void curve(const double *points, int n, int dim, double x, double *out)
{
    double s = x * (n - 1);
    int i = (int)floor(s);
    i = i < 0 ? 0 : i > n - 2 ? n - 2 : i;
    double t = s - i;
    for (int k = 0; k < dim; k++) {
        double p1 = points[i * dim + k], p2 = points[(i + 1) * dim + k];
        double p0 = i > 0 ? points[(i - 1) * dim + k] : 2 * p1 - p2;
        double p3 = i < n - 2 ? points[(i + 2) * dim + k] : 2 * p2 - p1;
        out[k] = p1 + 0.5 * t * (p2 - p0 + t * (2 * p0 - 5 * p1 + 4 * p2 - p3 + t * (3 * (p1 - p2) + p3 - p0)));
    }
}

struct run {
    const double (*point)[2];
    int n;
};

static void lathe_point(const void *context, double u, double v, double p[3])
{
    const struct run *r = context;
    double q[2];
    curve(&r->point[0][0], r->n, 2, u, q);
    if (q[0] < 0) q[0] = 0;
    p[0] = q[0] * cos(TAU * v);
    p[1] = q[1];
    p[2] = q[0] * sin(TAU * v);
}

void model_lathe(struct model *m, const double (*profile)[2], int n, int steps, int around)
{
    int begin = 0;
    for (int i = 1; i <= n; i++) {
        if (i < n && (profile[i][0] != profile[i - 1][0] || profile[i][1] != profile[i - 1][1])) continue;
        struct run r = {profile + begin, i - begin};
        if (r.n >= 2) model_patch(m, lathe_point, &r, r.n == 2 ? 1 : (r.n - 1) * steps, around);
        begin = i;
    }
}

static void tube_end(struct model *m, const double at[3], const double n[3], size_t ring, int around, int last)
{
    size_t centre = m->n_vertices, first = centre + 1;
    add_vertex(m, at, n, 0, 0);
    for (size_t j = 0; j <= (size_t)around; j++) {
        /* the ring is stored in world space already: copy it with the new normal of the centre */
        m->vertex = grow(m->vertex, &m->vertex_capacity, m->n_vertices + 1, 8 * sizeof *m->vertex);
        double *v = m->vertex + 8 * m->n_vertices++;
        memcpy(v, m->vertex + 8 * (ring + j), 3 * sizeof *v);
        memcpy(v + 3, m->vertex + 8 * centre + 3, 5 * sizeof *v);
    }
    for (size_t j = 0; j < (size_t)around; j++) {
        if (last) add_face(m, centre, first + j, first + j + 1);
        else add_face(m, centre, first + j + 1, first + j);
    }
}

void model_tube(struct model *m, const double (*path)[4], int n, int steps, int around)
{
    int rings = (n - 1) * steps;
    size_t first = m->n_vertices;
    double side[3] = {0, 0, 0}, start[4], start_dir[3] = {0, 0, 0}, end[4] = {0, 0, 0, 0}, dir[3] = {0, 0, 0};
    curve(&path[0][0], n, 4, 0, start);
    for (int i = 0; i <= rings; i++) {
        double x = (double)i / rings, a[4], b[4], up[3];
        curve(&path[0][0], n, 4, x, end);
        curve(&path[0][0], n, 4, x > 1e-4 ? x - 1e-4 : 0, a);
        curve(&path[0][0], n, 4, x < 1 - 1e-4 ? x + 1e-4 : 1, b);
        for (int k = 0; k < 3; k++) dir[k] = b[k] - a[k];
        double slope = (b[3] - a[3]) / normalise(dir);
        if (i == 0) {
            memcpy(start_dir, dir, sizeof dir);
            side[fabs(dir[0]) < fabs(dir[1]) ? (fabs(dir[0]) < fabs(dir[2]) ? 0 : 2)
                                             : (fabs(dir[1]) < fabs(dir[2]) ? 1 : 2)] = 1;
        }
        double along = dot(side, dir); /* carry the frame along: drop what points along the curve */
        for (int k = 0; k < 3; k++) side[k] -= along * dir[k];
        normalise(side);
        cross(dir, side, up);
        for (int j = 0; j <= around; j++) {
            double c = cos(TAU * j / around), s = sin(TAU * j / around), p[3], nrm[3];
            for (int k = 0; k < 3; k++) {
                double radial = c * side[k] + s * up[k];
                p[k] = end[k] + end[3] * radial;
                nrm[k] = radial - slope * dir[k];
            }
            add_vertex(m, p, nrm, x * m->uv_scale, (double)j / around * m->uv_scale);
        }
    }
    add_grid_faces(m, first, rings, around);
    for (int k = 0; k < 3; k++) start_dir[k] = -start_dir[k];
    if (start[3] > 0) tube_end(m, start, start_dir, first, around, 0);
    if (end[3] > 0) tube_end(m, end, dir, first + (size_t)rings * ((size_t)around + 1), around, 1);
}

struct pillow {
    const double *h;
    double power;
};

static double signed_power(double x, double power)
{
    return x < 0 ? -pow(-x, power) : pow(x, power);
}

static void pillow_point(const void *context, double u, double v, double p[3])
{
    const struct pillow *c = context;
    double theta = (u - 0.5) * TAU / 2, phi = v * TAU;
    double r = signed_power(cos(theta), c->power);
    p[0] = c->h[0] * r * signed_power(cos(phi), c->power);
    p[1] = c->h[1] * signed_power(sin(theta), c->power);
    p[2] = c->h[2] * r * signed_power(sin(phi), c->power);
}

void model_pillow(struct model *m, const double h[3], double power, int nu, int nv)
{
    struct pillow c = {h, power};
    model_patch(m, pillow_point, &c, nu, nv);
}

/* ---- files ---- */

/* `bytes` bytes of x, the lowest first. */
static void put(FILE *f, uint32_t x, int bytes)
{
    for (int i = 0; i < bytes; i++) putc((int)(x >> (8 * i) & 255), f);
}

static void put_rounded(FILE *f, double x)
{
    float v = (float)(floor(x * 1e5 + 0.5) / 1e5);
    uint32_t bits;
    memcpy(&bits, &v, 4);
    if (v == 0) bits = 0; /* no negative zeros */
    put(f, bits, 4);
}

static FILE *open_for_writing(const char *path)
{
    FILE *f = fopen(path, "wb");
    if (f == NULL) {
        perror(path);
        exit(1);
    }
    return f;
}

static void finish(FILE *f, const char *path)
{
    long size = ftell(f);
    if (ferror(f) || fclose(f) != 0) die("write error");
    printf("%8ld %s\n", size, path);
}

void model_write(struct model *m, const char *path)
{
    FILE *f = open_for_writing(path);
    fprintf(f, "ply\nformat binary_little_endian 1.0\nelement vertex %lu\n", (unsigned long)m->n_vertices);
    fputs("property float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\n"
          "property float nz\nproperty float u\nproperty float v\n", f);
    int small = m->n_vertices <= 65536; /* two bytes do for an index */
    fprintf(f, "element face %lu\nproperty list uint8 %s vertex_indices\nend_header\n", (unsigned long)m->n_faces,
            small ? "uint16" : "int");
    for (size_t i = 0; i < 8 * m->n_vertices; i++) put_rounded(f, m->vertex[i]);
    for (size_t i = 0; i < m->n_faces; i++) {
        putc(3, f);
        for (size_t k = 0; k < 3; k++) put(f, (uint32_t)m->face[3 * i + k], small ? 2 : 4);
    }
    finish(f, path);
    free(m->vertex);
    free(m->face);
    model_begin(m);
}

void picture_begin(struct picture *p, int width, int height)
{
    p->width = width;
    p->height = height;
    p->rgb = calloc((size_t)width * (size_t)height, 3);
    if (p->rgb == NULL) die("out of memory");
}

void picture_set(struct picture *p, int x, int y, const double rgb[3])
{
    unsigned char *out = p->rgb + 3 * ((size_t)y * (size_t)p->width + (size_t)x);
    for (int i = 0; i < 3; i++) {
        double v = rgb[i] < 0 ? 0 : rgb[i] > 1 ? 1 : rgb[i];
        out[i] = (unsigned char)floor(v * 255 + 0.5);
    }
}

/* TGA, type 2 (24 bits, blue first), origin at the top left. */
void picture_write(struct picture *p, const char *path)
{
    FILE *f = open_for_writing(path);
    unsigned char header[18] = {0};
    header[2] = 2;
    header[12] = (unsigned char)(p->width & 255);
    header[13] = (unsigned char)(p->width >> 8);
    header[14] = (unsigned char)(p->height & 255);
    header[15] = (unsigned char)(p->height >> 8);
    header[16] = 24;
    header[17] = 0x20;
    fwrite(header, 1, sizeof header, f);
    for (size_t i = 0; i < (size_t)p->width * (size_t)p->height; i++) {
        for (size_t k = 3; k-- > 0;) putc(p->rgb[3 * i + k], f);
    }
    finish(f, path);
    free(p->rgb);
    p->rgb = NULL;
}

void sky_write(const char *path, int width, int height, sky_function *f)
{
    FILE *out = open_for_writing(path);
    fprintf(out, "PF\n%d %d\n-1\n", width, height);
    for (int y = height - 1; y >= 0; y--) {
        for (int x = 0; x < width; x++) {
            double phi = TAU * (x + 0.5) / width, theta = TAU / 2 * (y + 0.5) / height, c[3];
            double d[3] = {cos(phi) * sin(theta), cos(theta), -sin(phi) * sin(theta)};
            f(d, c);
            for (int i = 0; i < 3; i++) {
                float v = (float)(floor(c[i] * 256 + 0.5) / 256); /* the same on every machine */
                uint32_t bits;
                memcpy(&bits, &v, 4);
                put(out, bits, 4);
            }
        }
    }
    finish(out, path);
}

/* ---- noise ---- */

double scatter(unsigned i, unsigned seed)
{
    uint32_t x = (uint32_t)i * 0x9E3779B1u ^ ((uint32_t)seed + 0x7F4A7C15u) * 0x85EBCA6Bu;
    x = (x ^ x >> 15) * 0x2C1B3C6Du;
    x = (x ^ x >> 12) * 0x297A2D39u;
    return (double)(x ^ x >> 15) / 4294967296.0;
}

double noise(double x, double y, int period, unsigned seed)
{
    double fx = floor(x), fy = floor(y), corner[2][2];
    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < 2; j++) {
            int cx = (((int)fx + i) % period + period) % period, cy = (((int)fy + j) % period + period) % period;
            corner[i][j] = scatter((unsigned)(cx * 7919 + cy), seed);
        }
    }
    double sx = smooth(0, 1, x - fx), sy = smooth(0, 1, y - fy);
    return mixed(mixed(corner[0][0], corner[1][0], sx), mixed(corner[0][1], corner[1][1], sx), sy);
}

double fractal(double x, double y, int period, unsigned seed)
{
    double sum = 0, weight = 0.5333;
    for (unsigned i = 0; i < 4; i++) {
        sum += weight * noise(x, y, period, seed + i);
        x *= 2;
        y *= 2;
        period *= 2;
        weight /= 2;
    }
    return sum;
}

double mixed(double a, double b, double t)
{
    return a + t * (b - a);
}

double smooth(double lo, double hi, double x)
{
    double t = (x - lo) / (hi - lo);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return t * t * (3 - 2 * t);
}

void mix3(const double a[3], const double b[3], double t, double out[3])
{
    for (int i = 0; i < 3; i++) out[i] = mixed(a[i], b[i], t);
}
