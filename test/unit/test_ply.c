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
        {HEAD "element tags 1\nproperty list int int tag\n" FACE THREE "99999999 0 1 2\n", "ends"},
        {HEAD FACE THREE "5 0 1 2 0 1\n", ": face 0: more than four corners"},
        {HEAD "element tristrips 1\nproperty list int int vertex_indices\n" FACE THREE "3 0 1 2\n3 0 1 2\n",
         "strips of triangles are not read"},
        {HEAD "element face 0\nproperty list uchar int vertex_indices\nend_header\n" THREE, "no faces"},
        {HEAD "end_header\n" THREE, "no faces"},
        {HEAD "element face 1\nproperty list uchar float vertex_indices\nend_header\n" THREE "3 0 1 2\n",
         "integer list"},
        {HEAD "element face 1\nproperty list uchar int corners\nend_header\n" THREE "3 0 1 2\n", "integer list"},
        {"ply\nformat ascii 1.0\n" FACE "3 0 1 2\n", "there are only 0"},
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

/* Odd but legal: what is not finite beside the position, faces that are none, meshes without normals. */
static void check_odd(struct test *t)
{
    static const char text[] =
        "ply\nformat ascii 1.0\nelement vertex 5\n" XYZ "property float u\nproperty float v\nproperty float nx\n"
        "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0 nan 0 9\n1 0 0 0 0 9\n2 1 0 0 0 9\n1 2 0 0 0 9\n0 1 0 0 0 9\n4 0 1 2 3\n0\n2 0 1\n3 0 0 0";
    struct mesh m;
    struct error err;
    bool ok = read_bytes(t, text, strlen(text), &m, &err);
    CHECK(t, ok && m.n_triangles == 3 && m.N == NULL && m.UV != NULL && m.UV[0] == 0, "odd faces: %s", err.text);
    CHECK(t, m.n_thin == 2, "%d faces of few corners", m.n_thin);
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
}
