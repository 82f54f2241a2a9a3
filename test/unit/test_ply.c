/* test_ply.c: every variant of PLY gives the same mesh, and every broken file is refused with a clear message.
 *
 * One mesh, a square with normals and texture coordinates cut from a quad, is written in many dialects and compared
 * with itself number by number. Each broken file must be refused with the words that say why.
 */
#include "geometry/ply.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/mem.h"
#include "base/rng.h"
#include "helpers.h"
#include "suites.h"

/* --- writing ------------------------------------------------------------------------------------------ */

/* A file being put together. */
struct text {
    char data[4096];
    size_t n;
};

static void put(struct text *f, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    f->n += (size_t)vsnprintf(f->data + f->n, sizeof f->data - f->n, format, list);
    va_end(list);
}

struct variant {
    char encoding; /* 'a'scii, 'l'ittle or 'b'ig endian */
    const char *real, *count, *index; /* types */
    const char *uv[2];
    const char *list_name;
    bool faces_first, extras;
    const char *end; /* of lines */
};

static void put_number(struct text *f, const struct variant *v, const char *type, double x)
{
    static const char *const names[] = {"char", "uchar", "int8", "uint8", "short", "ushort", "int16", "uint16", "int",
                                        "uint", "int32", "uint32", "float", "float32", "double", "float64"};
    uint64_t bits = (uint64_t)(int64_t)x;
    int i = 0;
    while (strcmp(names[i], type) != 0)
        i++;
    if (i >= 14)
        memcpy(&bits, &x, sizeof bits);
    else if (i >= 12)
        bits = bits_of_float((float)x);
    size_t size = i < 4 ? 1 : i < 8 ? 2 : i < 14 ? 4 : 8;
    if (v->encoding == 'a')
        put(f, "%.9g ", x);
    else
        bytes_of_bits(bits, (uint8_t *)f->data + f->n, size, v->encoding == 'b');
    f->n += v->encoding == 'a' ? 0 : size;
}

static void put_numbers(struct text *f, const struct variant *v, const char *type, const double *x, int n)
{
    for (int i = 0; i < n; i++)
        put_number(f, v, type, x[i]);
}

static const double CORNER[4][8] = {{0, 0, 0, 0, 0, 1, 0, 0},
                                    {1.5, 0, 0.25, 0, 0, 1, 1, 0},
                                    {1.5, 2, -7, 0, 0.6, 0.8, 1, 1},
                                    {0, 2, 1e-7, 0, 0, -1, 0, 1}};

static void put_vertices(struct text *f, const struct variant *v, bool header, const char *end)
{
    static const char *const names[] = {"x", "y", "z", "nx", "ny", "nz"};
    static const double list[] = {100, 3, -5, -5, -5};
    if (header)
        put(f, "element vertex 4%s", end);
    for (int i = 0; i < 8 && header; i++) {
        if (v->extras && i == 3)
            put(f, "property uchar red%sproperty list uchar short tags%s", end, end);
        put(f, "property %s %s%s", v->real, i < 6 ? names[i] : v->uv[i - 6], end);
    }
    for (int i = 0; i < 4 && !header; i++) {
        put_numbers(f, v, v->real, CORNER[i], 3);
        if (v->extras) {
            put_numbers(f, v, "uchar", list, 2);
            put_numbers(f, v, "short", list + 2, 3);
        }
        put_numbers(f, v, v->real, CORNER[i] + 3, 5);
        if (v->encoding == 'a')
            put(f, "%s", end);
    }
}

static void put_face(struct text *f, const struct variant *v, bool header, const char *end)
{
    static const double quad[] = {4, 0, 1, 2, 3};
    if (header) {
        put(f, "element face 1%sproperty list %s %s %s%s%s%s", end, v->count, v->index, v->list_name, end,
            v->extras ? "property float weight" : "comment no more", end);
        return;
    }
    put_number(f, v, v->count, 4);
    put_numbers(f, v, v->index, quad + 1, 4);
    if (v->extras)
        put_number(f, v, "float", 0.5);
    if (v->encoding == 'a')
        put(f, "%s", end);
}

static void put_elements(struct text *f, const struct variant *v, bool header, const char *end)
{
    if (v->faces_first)
        put_face(f, v, header, end);
    put_vertices(f, v, header, end);
    if (!v->faces_first)
        put_face(f, v, header, end);
}

static struct text file_of(const struct variant *v)
{
    static const double camera[] = {90, 2, 65, -66}, edges[] = {1, 2};
    const char *end = v->end;
    struct text f = {.n = 0};
    put(&f, "ply%sformat %s 1.0%scomment made for a test%s", end,
        v->encoding == 'a'   ? "ascii"
        : v->encoding == 'l' ? "binary_little_endian"
                             : "binary_big_endian",
        end, end);
    if (v->extras)
        put(&f, "element camera 1%sproperty double fov%sproperty list int char name%sobj_info x%s", end, end, end, end);
    put_elements(&f, v, true, end);
    if (v->extras)
        put(&f, "element edge 2%sproperty int a%s", end, end);
    put(&f, "end_header%s", end);
    if (v->extras) {
        put_number(&f, v, "double", camera[0]);
        put_number(&f, v, "int", camera[1]);
        put_numbers(&f, v, "char", camera + 2, 2);
    }
    put_elements(&f, v, false, end);
    if (v->extras)
        put_numbers(&f, v, "int", edges, 2);
    return f;
}

/* ply_read of a file of n bytes. */
static bool read_bytes(struct test *t, const char *data, size_t n, struct mesh *m, struct error *err)
{
    char path[256];
    snprintf(path, sizeof path, "%s/mesh.ply", test_tmp(t));
    write_bytes(path, data, n);
    err->text[0] = '\0';
    return ply_read(path, m, err);
}

/* --- variants that read ------------------------------------------------------------------------------- */

static bool same_mesh(const struct mesh *m)
{
    static const uint32_t fan[6] = {0, 1, 2, 3, 0, 2}; /* as pbrt-v3 cuts it */
    if (m->n_vertices != 4 || m->n_triangles != 2 || m->N == NULL || m->UV == NULL)
        return false;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 8; k++) {
            const double p[3] = {m->P[i].x, m->P[i].y, m->P[i].z};
            float x = k < 3 ? (float)p[k] : k < 6 ? m->N[3 * i + k - 3] : m->UV[2 * i + k - 6];
            if (x != (float)CORNER[i][k])
                return false;
        }
    return memcmp(m->index, fan, sizeof fan) == 0;
}

static void check_variants(struct test *t)
{
    static const char LF[] = "\n", CRLF[] = "\r\n", CR[] = "\r";
    const struct variant variants[] = {
        {'a', "float", "uchar", "int", {"u", "v"}, "vertex_indices", false, false, LF},
        {'a', "double", "int", "uint", {"s", "t"}, "vertex_index", true, true, LF},
        {'a', "float32", "uint8", "int32", {"texture_u", "texture_v"}, "vertex_indices", false, false, CRLF},
        {'l', "float", "uchar", "int", {"u", "v"}, "vertex_indices", false, false, LF},
        {'l', "double", "char", "ushort", {"s", "t"}, "vertex_indices", true, true, LF},
        {'l', "float64", "uint16", "int8", {"texture_s", "texture_t"}, "vertex_index", false, true, CRLF},
        {'b', "float32", "int16", "uint16", {"texture_u", "texture_v"}, "vertex_indices", false, false, CRLF},
        {'b', "float", "uint", "uchar", {"u", "v"}, "vertex_indices", true, true, LF},
        {'b', "double", "int32", "short", {"u", "v"}, "vertex_indices", false, false, LF},
        {'a', "float", "uchar", "int", {"s", "t"}, "vertex_indices", false, true, CR},
        {'l', "float", "uchar", "int", {"s", "t"}, "vertex_indices", true, false, CR},
    };
    for (size_t i = 0; i < sizeof variants / sizeof variants[0]; i++) {
        struct text f = file_of(&variants[i]);
        struct mesh m;
        struct error err;
        CHECK(t, read_bytes(t, f.data, f.n, &m, &err) && same_mesh(&m), "variant %d: %s", (int)i, err.text);
        mesh_free(&m);
        /* Without its last character, or "\n" and the last digit, an ascii file may still be whole. */
        for (size_t n = 0; n < f.n - 3; n += 23)
            CHECK(t, !read_bytes(t, f.data, n, &m, &err) && strstr(err.text, "mesh.ply") != NULL && m.P == NULL,
                  "variant %d, cut after %d of %d bytes: %s", (int)i, (int)n, (int)f.n, err.text);
    }
}

/* --- what is refused ---------------------------------------------------------------------------------- */

#define XYZ   "property float x\nproperty float y\nproperty float z\n"
#define BYTES_10  "~~~~~~~~~~"
#define BYTES_100 "d" BYTES_10 BYTES_10 BYTES_10 BYTES_10 BYTES_10 BYTES_10 BYTES_10 BYTES_10 BYTES_10 BYTES_10
#define HEAD  "ply\nformat ascii 1.0\nelement vertex 3\n" XYZ
#define FACE  "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
#define THREE "0 0 0\n1 0 0\n0 1 0\n"

static void check_refused(struct test *t)
{
    static const struct {
        const char *text, *words;
    } cases[] = {
        {"", "not a PLY file"},
        {"P6 1 1 255\n", "not a PLY file"},
        {"ply\nformat ascii 1.0\nelement vertex 3\n" XYZ, "no end_header"},
        {"ply\nelement vertex 3\n" XYZ FACE THREE "3 0 1 2\n", "no format line"},
        {"ply\nformat ascii 2.0\n" FACE, "line 2: not a usable line"},
        {"ply\nformat ebcdic 1.0\n" FACE, ": format ebcdic 1.0"},
        {"ply\nformat ascii 1.0\nproperty float x\nend_header\n", ": property float x"},
        {"ply\nformat ascii 1.0\nelement vertex -3\n" XYZ FACE, ": element vertex -3"},
        {"ply\nformat ascii 1.0\nelement vertex 3x\n" XYZ FACE, ": element vertex 3x"},
        {"ply\nformat ascii 1.0\nelement vertex 99999999999999999999\n" XYZ FACE, "line 3"},
        {"ply\nformat ascii 1.0\nelement vertex 1000000000\n" XYZ FACE THREE, "truncated"},
        {"ply\nformat ascii 1.0\nelement vertex 3\nproperty quad x\nend_header\n", "quad"},
        {"ply\nformat ascii 1.0\nelement vertex 3\nproperty list float int x\nend_header\n", "line 4"},
        {"ply\nformat ascii 1.0\nelement vertex 3\nproperty float\nend_header\n", "line 4"},
        {"ply\nformat ascii 1.0\nelement vertex 3\nelement vertex 3\nend_header\n", "line 4"},
        {"ply\nformat ascii 1.0\nelephant vertex 3\nend_header\n", "elephant"},
        {"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n" FACE
         "0 0\n1 0\n0 1\n3 0 1 2\n", "no x, y, z"},
        {HEAD FACE "0 0 0\n1 0 zero\n0 1 0\n3 0 1 2\n", ": vertex 1: "},
        {HEAD FACE "0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n", "not a finite"},
        {HEAD FACE "0 0 0\n1 0 1e39\n0 1 0\n3 0 1 2\n", "not a finite"},
        {HEAD FACE THREE "3 0 1 3\n", "vertex 3, but there are only 3"},
        {HEAD FACE THREE "3 0 1 -1\n", "not a vertex index"},
        {HEAD FACE THREE "3 0 1 1.5\n", "not a vertex index"},
        {HEAD FACE THREE "-3 0 1 2\n", "not a list length"},
        {HEAD FACE THREE "3.5 0 1 2\n", "not a list length"},
        {HEAD FACE THREE "99999999 0 1 2\n", "ends"},
        {HEAD "element face 0\nproperty list uchar int vertex_indices\nend_header\n" THREE, "no faces"},
        {HEAD "end_header\n" THREE, "no faces"},
        {HEAD "element face 1\nproperty list uchar float vertex_indices\nend_header\n" THREE "3 0 1 2\n",
         "integer list"},
        {HEAD "element face 1\nproperty list uchar int corners\nend_header\n" THREE "3 0 1 2\n", "integer list"},
        {"ply\nformat ascii 1.0\n" FACE "3 0 1 2\n", "there are only 0"},
        {"ply\nformat binary_little_endian 1.0\nelement vertex 0\n" XYZ "element face 3\n"
         "property list char char vertex_indices\nend_header\n" BYTES_100 BYTES_100 BYTES_100, "less than two bytes"},
        {"ply\nformat binary_little_endian 1.0\nelement vertex 3\n" XYZ "element face 1000000\n"
         "property list uchar int vertex_indices\nend_header\n" THREE, "truncated"},
    };
    struct mesh m;
    struct error err;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        CHECK(t, !read_bytes(t, cases[i].text, strlen(cases[i].text), &m, &err) &&
                     strstr(err.text, cases[i].words) != NULL, "refusal %d says '%s', not '%s'", (int)i, err.text,
              cases[i].words);
        CHECK(t, m.P == NULL && m.index == NULL && m.n_vertices == 0, "refusal %d leaves a mesh", (int)i);
    }
    CHECK(t, !ply_read(test_tmp(t), &m, &err), "a directory is read");
}

/* Odd but legal: what is not finite beside the position, polygons, faces that are none, meshes without normals. */
static void check_odd(struct test *t)
{
    static const char text[] =
        "ply\nformat ascii 1.0\nelement vertex 5\n" XYZ "property float u\nproperty float v\nproperty float nx\n"
        "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0 nan 0 9\n1 0 0 0 0 9\n2 1 0 0 0 9\n1 2 0 0 0 9\n0 1 0 0 0 9\n5 0 1 2 3 4\n0\n2 0 1\n3 0 0 0";
    struct mesh m;
    struct error err;
    bool ok = read_bytes(t, text, strlen(text), &m, &err);
    CHECK(t, ok && m.n_triangles == 4 && m.N == NULL && m.UV != NULL && m.UV[0] == 0, "pentagon: %s", err.text);
    CHECK(t, m.n_thin == 2, "%d faces of few corners", m.n_thin);
    CHECK(t, !ok || (m.index[6] == 4 && m.index[7] == 0 && m.index[8] == 3), "the last triangle of the fan");
    mesh_free(&m);
}

/* --- polygons ------------------------------------------------------------------------------------------- */

enum { MOST_CORNERS = 60, POINTS = 200 };

/* A polygon in a plane, and which of its points is which corner. */
struct polygon {
    double point[MOST_CORNERS][2];
    int corner[MOST_CORNERS], n, n_points;
};

static void put_point(struct polygon *p, double x, double y)
{
    p->point[p->n_points][0] = x;
    p->point[p->n_points][1] = y;
    p->corner[p->n++] = p->n_points++;
}

/* A star, a comb, a spiral, or a square whose hole a bridge joins to the outside. */
static struct polygon random_polygon(struct rng *r, int kind)
{
    struct polygon p = {.n = 0};
    int n = 4 + (int)(rng_uniform(r) * 24);
    for (int i = 0; i < n && kind < 3; i++) {
        double angle = 2 * PI * i / n, radius = 0.2 + 0.8 * rng_uniform(r);
        if (kind == 0)
            put_point(&p, radius * cos(angle), radius * sin(angle));
        else if (kind == 1)
            put_point(&p, i, i % 2 == 0 ? rng_uniform(r) : 5 + rng_uniform(r));
        else
            put_point(&p, (1 + i) * cos(0.7 * i), (1 + i) * sin(0.7 * i));
    }
    for (int i = n - 1; i >= 0 && kind == 2; i--)
        put_point(&p, (1.6 + i) * cos(0.7 * i), (1.6 + i) * sin(0.7 * i));
    if (kind == 1) { /* the comb's back */
        put_point(&p, n, 8);
        put_point(&p, -1, 8);
    }
    if (kind == 3) {
        static const double hole[8][2] = {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {3, 3}, {3, 6}, {6, 6}, {6, 3}};
        static const int corners[10] = {0, 1, 2, 3, 0, 4, 5, 6, 7, 4};
        for (int i = 0; i < 8; i++)
            put_point(&p, hole[i][0], hole[i][1]);
        memcpy(p.corner, corners, sizeof corners);
        p.n = 10;
    }
    int first = (int)(rng_uniform(r) * p.n), step = rng_uniform(r) < 0.5 ? 1 : p.n - 1;
    struct polygon turned = p;
    for (int i = 0; i < p.n; i++)
        turned.corner[i] = p.corner[(first + i * step) % p.n];
    return turned;
}

/* Which side of the line from a to b is c on? */
static double side(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* How often do these corners go round a point? */
static int winding(const double (*point)[2], const int *corner, int n, const double *at)
{
    int turns = 0;
    for (int i = 0; i < n; i++) {
        const double *a = point[corner[i]], *b = point[corner[(i + 1) % n]];
        bool up = a[1] <= at[1];
        if (up != (b[1] <= at[1]) && (side(a, b, at) > 0) == up)
            turns += up ? 1 : -1;
    }
    return turns;
}

/* The triangles of a polygon, which lies anywhere in space, go round all points as often as the polygon does. */
static void check_polygon(struct test *t, struct rng *r, int kind)
{
    struct polygon p = random_polygon(r, kind);
    struct transform place = random_affine(r);
    struct text f = {.n = 0};
    struct mesh m;
    struct error err;
    put(&f, "ply\nformat ascii 1.0\nelement vertex %d\n" XYZ FACE, p.n_points);
    for (int i = 0; i < p.n_points; i++) {
        vec3 at = transform_point(&place, vec(p.point[i][0], p.point[i][1], 1));
        put(&f, "%.9g %.9g %.9g\n", at.x, at.y, at.z);
    }
    put(&f, "%d", p.n);
    for (int i = 0; i < p.n; i++)
        put(&f, " %d", p.corner[i]);
    bool ok = read_bytes(t, f.data, f.n, &m, &err);
    CHECK(t, ok && m.n_triangles == p.n - 2, "polygon of kind %d: %s", kind, err.text);
    double lo[2] = {HUGE_VAL, HUGE_VAL}, hi[2] = {-HUGE_VAL, -HUGE_VAL};
    for (int i = 0; i < 2 * p.n_points; i++) {
        lo[i % 2] = fmin(lo[i % 2], p.point[i / 2][i % 2]);
        hi[i % 2] = fmax(hi[i % 2], p.point[i / 2][i % 2]);
    }
    int wrong = 0;
    for (int i = 0; ok && i < POINTS; i++) {
        double x = rng_uniform(r), at[2] = {lo[0] + x * (hi[0] - lo[0]), lo[1] + rng_uniform(r) * (hi[1] - lo[1])};
        int sum = 0;
        bool over = false; /* parts of the same sign alone */
        for (int k = 0; k < m.n_triangles; k++) {
            const int corner[3] = {(int)m.index[3 * k], (int)m.index[3 * k + 1], (int)m.index[3 * k + 2]};
            int turns = winding((const double(*)[2])p.point, corner, 3, at);
            over |= turns * sum != 0;
            sum += turns;
        }
        wrong += over || sum != winding((const double(*)[2])p.point, p.corner, p.n, at);
    }
    CHECK(t, wrong == 0, "polygon of kind %d and %d corners: %d of %d points are wrong", kind, p.n, wrong, (int)POINTS);
    mesh_free(&m);
}

/* Strips of triangles, which turn the same way. */
static void check_strips(struct test *t)
{
    static const char text[] = "ply\nformat ascii 1.0\nelement vertex 6\n" XYZ
                               "element tristrips 2\nproperty list int int vertex_indices\nend_header\n"
                               "0 0 0 1 0 0 0 1 0 1 1 0 0 2 0 1 2 0\n9 0 1 2 3 4 -1 3 5 4\n2 0 1\n";
    static const uint32_t want[12] = {0, 1, 2, 2, 1, 3, 2, 3, 4, 3, 5, 4};
    struct mesh m;
    struct error err;
    bool ok = read_bytes(t, text, strlen(text), &m, &err);
    CHECK(t, ok && m.n_triangles == 4 && memcmp(m.index, want, sizeof want) == 0, "strips: %s", err.text);
    mesh_free(&m);
}

/* A face whose corners go round five points, or are all but four in one place, costs the square of their number. */
static void check_many_corners(struct test *t, bool round)
{
    enum { CORNERS = 100000 };
    char *text = mem_alloc(1, 400 + 2 * CORNERS);
    size_t n = (size_t)sprintf(text, "ply\nformat ascii 1.0\nelement vertex 5\n" XYZ
                               "element face 1\nproperty list int uchar vertex_indices\nend_header\n"
                               "0 0 0 4 0 0 4 4 0 3 1 0 0 4 0\n%d", CORNERS);
    for (int i = 0; i < CORNERS; i++)
        n += (size_t)sprintf(text + n, " %d", round ? i % 5 : i < CORNERS - 4 ? 0 : i - CORNERS + 5);
    struct mesh m;
    struct error err;
    CHECK(t, !read_bytes(t, text, n, &m, &err) && strstr(err.text, "not convex have too many corners") != NULL,
          "a face of many corners: %s", err.text);
    free(text);
    mesh_free(&m);
}

/* A number of any length is one number, or the file is refused: never two. */
static void check_long_numbers(struct test *t)
{
    for (int digits = 1; digits < 1200; digits += 37) {
        struct text f = {.n = 0};
        struct mesh m;
        struct error err;
        put(&f, "ply\nformat ascii 1.0\nelement vertex 3\n" XYZ FACE "0 0 0 0.5");
        for (int i = 0; i < digits; i++)
            put(&f, "0");
        put(&f, "1 0 0 0 1 0 3 0 1 2 ");
        bool ok = read_bytes(t, f.data, f.n, &m, &err);
        CHECK(t, ok ? fabs(m.P[1].x - 0.5) < 0.01 && m.P[1].y == 0 : strstr(err.text, "no number here") != NULL,
              "%d digits: %g %g, %s", digits, ok ? m.P[1].x : 0, ok ? m.P[1].y : 0, err.text);
        CHECK(t, ok || digits > 500, "%d digits are refused", digits);
        mesh_free(&m);
    }
}

/* As many elements as a file may have, and one more. */
static void check_elements(struct test *t)
{
    for (int n = PLY_MAX_ELEMENTS; n <= PLY_MAX_ELEMENTS + 1; n++) {
        struct text f = {.n = 0};
        struct mesh m;
        struct error err;
        put(&f, "ply\nformat ascii 1.0\nelement vertex 3\n" XYZ);
        for (int i = 0; i < n - 2; i++)
            put(&f, "element e%d 0\n", i);
        put(&f, FACE "0 0 0 1 0 0 0 1 0 3 0 1 2 ");
        CHECK(t, read_bytes(t, f.data, f.n, &m, &err) == (n == PLY_MAX_ELEMENTS), "%d elements: %s", n, err.text);
        mesh_free(&m);
    }
}

void test_ply(struct test *t)
{
    check_variants(t);
    check_refused(t);
    check_odd(t);
    check_elements(t);
    check_long_numbers(t);
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 0, 0);
    for (int i = 0; i < 200; i++)
        check_polygon(t, &r, i % 4);
    check_strips(t);
    check_many_corners(t, true);
    check_many_corners(t, false);
}
