/* test_ply.c: every variant of PLY that reads, reads the same; everything broken is refused with a clear message.
 *
 * One mesh, a square with normals and texture coordinates cut from a quad, is written in many dialects and compared
 * with itself number by number. Each broken file must be refused with the words that say why.
 */
#include "geometry/ply.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "tests.h"

/* --- writing ------------------------------------------------------------------------------------------ */

/* A file being put together. */
struct text {
    char *data;
    size_t n, capacity;
};

static void put(struct text *f, const void *data, size_t n)
{
    f->data = mem_grow(f->data, &f->capacity, f->n + n + 1, 1);
    memcpy(f->data + f->n, data, n);
    f->n += n;
}

static void put_text(struct text *f, const char *text) { put(f, text, strlen(text)); }

static bool is_big_endian_host(void)
{
    uint16_t one = 1;
    unsigned char first;
    memcpy(&first, &one, 1);
    return first == 0;
}

/* One number in the encoding 'a'scii, 'l'ittle or 'b'ig endian. */
static void put_number(struct text *f, char encoding, const char *type, double x)
{
    unsigned char bytes[8];
    size_t n = 0;
    char word[64];
    if (encoding == 'a') {
        snprintf(word, sizeof word, "%.9g ", x);
        put_text(f, word);
        return;
    }
    if (strncmp(type, "float", 5) == 0 && strcmp(type, "float64") != 0) {
        float v = (float)x;
        memcpy(bytes, &v, n = sizeof v);
    } else if (strcmp(type, "double") == 0 || strcmp(type, "float64") == 0) {
        memcpy(bytes, &x, n = sizeof x);
    } else if (strstr(type, "char") != NULL || strcmp(type, "int8") == 0 || strcmp(type, "uint8") == 0) {
        int8_t v = (int8_t)x;
        memcpy(bytes, &v, n = sizeof v);
    } else if (strstr(type, "short") != NULL || strstr(type, "16") != NULL) {
        int16_t v = (int16_t)x;
        memcpy(bytes, &v, n = sizeof v);
    } else {
        int32_t v = (int32_t)x;
        memcpy(bytes, &v, n = sizeof v);
    }
    bool reverse = (encoding == 'b') != is_big_endian_host();
    for (size_t i = 0; i < n; i++)
        put(f, &bytes[reverse ? n - 1 - i : i], 1);
}

/* Write what was put together; returns the path in path. */
static void save(struct test *t, struct text *f, char path[256])
{
    snprintf(path, 256, "%s/mesh.ply", test_tmp(t));
    FILE *out = fopen(path, "wb");
    CHECK(t, out != NULL && fwrite(f->data, 1, f->n, out) == f->n, "cannot write %s", path);
    if (out != NULL)
        fclose(out);
    free(f->data);
    struct text empty = {NULL, 0, 0};
    *f = empty;
}

/* --- variants that read ------------------------------------------------------------------------------- */

struct variant {
    char encoding;
    const char *real, *count, *index; /* types */
    const char *uv[2];
    const char *list_name;
    bool faces_first, extras, crlf;
};

static const double CORNER[4][8] = {{0, 0, 0, 0, 0, 1, 0, 0},
                                    {1.5, 0, 0.25, 0, 0, 1, 1, 0},
                                    {1.5, 2, -7, 0, 0.6, 0.8, 1, 1},
                                    {0, 2, 1e-7, 0, 0, -1, 0, 1}};

static void put_header(struct text *f, const struct variant *v)
{
    static const char *const names[] = {"x", "y", "z", "nx", "ny", "nz"};
    const char *end = v->crlf ? "\r\n" : "\n";
    char text[4000], vertex[1500], face[500];
    size_t n = 0;
    n += (size_t)snprintf(vertex + n, sizeof vertex - n, "element vertex 4%s", end);
    for (int i = 0; i < 8; i++) {
        if (v->extras && i == 3)
            n += (size_t)snprintf(vertex + n, sizeof vertex - n,
                                  "property uchar red%sproperty list uchar short tags%s", end, end);
        n += (size_t)snprintf(vertex + n, sizeof vertex - n, "property %s %s%s", v->real,
                              i < 6 ? names[i] : v->uv[i - 6], end);
    }
    snprintf(face, sizeof face, "element face 1%sproperty list %s %s %s%s%s%s", end, v->count, v->index,
             v->list_name, end, v->extras ? "property float weight" : "comment no more", end);
    snprintf(text, sizeof text, "ply%sformat %s 1.0%scomment made for a test%s%s%s%s%send_header%s", end,
             v->encoding == 'a'   ? "ascii"
             : v->encoding == 'l' ? "binary_little_endian"
                                  : "binary_big_endian",
             end, end,
             v->extras ? "element camera 1\nproperty double fov\nproperty list int char name\nobj_info x\n" : "",
             v->faces_first ? face : vertex, v->faces_first ? vertex : face,
             v->extras ? "element edge 2\nproperty int a\n" : "", end);
    put_text(f, text);
}

static void put_vertices(struct text *f, const struct variant *v)
{
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 8; k++) {
            if (v->extras && k == 3) {
                put_number(f, v->encoding, "uchar", 100);
                put_number(f, v->encoding, "uchar", i);
                for (int m = 0; m < i; m++)
                    put_number(f, v->encoding, "short", -5);
            }
            put_number(f, v->encoding, v->real, CORNER[i][k]);
        }
        if (v->encoding == 'a')
            put_text(f, v->crlf ? "\r\n" : "\n");
    }
}

static void put_face(struct text *f, const struct variant *v)
{
    put_number(f, v->encoding, v->count, 4);
    for (int i = 0; i < 4; i++)
        put_number(f, v->encoding, v->index, i);
    if (v->extras)
        put_number(f, v->encoding, "float", 0.5);
    if (v->encoding == 'a')
        put_text(f, v->crlf ? "\r\n" : "\n");
}

static void put_body(struct text *f, const struct variant *v)
{
    if (v->extras) {
        put_number(f, v->encoding, "double", 90);
        put_number(f, v->encoding, "int", 2);
        put_number(f, v->encoding, "char", 65);
        put_number(f, v->encoding, "char", -66);
    }
    if (v->faces_first)
        put_face(f, v);
    put_vertices(f, v);
    if (!v->faces_first)
        put_face(f, v);
    if (v->extras) {
        put_number(f, v->encoding, "int", 1);
        put_number(f, v->encoding, "int", 2);
    }
}

static bool same_mesh(const struct mesh *m)
{
    static const uint32_t fan[6] = {0, 1, 2, 0, 2, 3};
    if (m->n_vertices != 4 || m->n_triangles != 2 || m->N == NULL || m->UV == NULL)
        return false;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 8; k++) {
            float x = k < 3 ? m->P[3 * i + k] : k < 6 ? m->N[3 * i + k - 3] : m->UV[2 * i + k - 6];
            if (x != (float)CORNER[i][k])
                return false;
        }
    return memcmp(m->index, fan, sizeof fan) == 0;
}

static void check_variants(struct test *t)
{
    static const struct variant variants[] = {
        {'a', "float", "uchar", "int", {"u", "v"}, "vertex_indices", false, false, false},
        {'a', "double", "int", "uint", {"s", "t"}, "vertex_index", true, true, false},
        {'a', "float32", "uint8", "int32", {"texture_u", "texture_v"}, "vertex_indices", false, false, true},
        {'l', "float", "uchar", "int", {"u", "v"}, "vertex_indices", false, false, false},
        {'l', "double", "char", "ushort", {"s", "t"}, "vertex_indices", true, true, false},
        {'l', "float64", "uint16", "int8", {"texture_s", "texture_t"}, "vertex_index", false, true, true},
        {'b', "float32", "int16", "uint16", {"texture_u", "texture_v"}, "vertex_indices", false, false, true},
        {'b', "float", "uint", "uchar", {"u", "v"}, "vertex_indices", true, true, false},
        {'b', "double", "int32", "short", {"u", "v"}, "vertex_indices", false, false, false},
    };
    for (size_t i = 0; i < sizeof variants / sizeof variants[0]; i++) {
        struct text f = {NULL, 0, 0};
        struct mesh m;
        struct error err = {""};
        char path[256];
        put_header(&f, &variants[i]);
        put_body(&f, &variants[i]);
        save(t, &f, path);
        bool ok = ply_read(path, &m, &err);
        CHECK(t, ok, "variant %lu: %s", (unsigned long)i, err.text);
        CHECK(t, !ok || same_mesh(&m), "variant %lu reads differently", (unsigned long)i);
        mesh_free(&m);
    }
}

/* Every file that is too short must be refused, wherever it is cut. */
static void check_cut_files(struct test *t)
{
    static const struct variant variants[] = {
        {'l', "float", "uchar", "int", {"u", "v"}, "vertex_indices", false, true, false},
        {'a', "float", "uchar", "int", {"u", "v"}, "vertex_indices", false, false, false},
    };
    for (int i = 0; i < 2; i++) {
        struct text whole = {NULL, 0, 0};
        put_header(&whole, &variants[i]);
        put_body(&whole, &variants[i]);
        /* without its last character, " ", or "\n" and the last digit, an ascii file may still be whole */
        size_t longest = i == 0 ? whole.n - 1 : whole.n - 3;
        for (size_t n = 0; n <= longest; n++) {
            struct text part = {NULL, 0, 0};
            struct mesh m;
            struct error err = {""};
            char path[256];
            put(&part, whole.data, n);
            save(t, &part, path);
            CHECK(t, !ply_read(path, &m, &err), "a file cut after %lu of %lu bytes is read", (unsigned long)n,
                  (unsigned long)whole.n);
            CHECK(t, strstr(err.text, "mesh.ply") != NULL && m.P == NULL && m.n_triangles == 0, "poor refusal: %s",
                  err.text);
        }
        free(whole.data);
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
        {"ply\nelement vertex 3\n" XYZ FACE THREE "3 0 1 2\n", "no format"},
        {"ply\nformat ascii 2.0\n" FACE, ":2:"},
        {"ply\nformat ebcdic 1.0\n" FACE, "ebcdic"},
        {"ply\nformat ascii 1.0\nproperty float x\nend_header\n", "before any element"},
        {"ply\nformat ascii 1.0\nelement vertex -3\n" XYZ FACE, "count"},
        {"ply\nformat ascii 1.0\nelement vertex 3x\n" XYZ FACE, "count"},
        {"ply\nformat ascii 1.0\nelement vertex 99999999999999999999\n" XYZ FACE, "count"},
        {"ply\nformat ascii 1.0\nelement vertex 1000000000\n" XYZ FACE THREE, "truncated"},
        {"ply\nformat ascii 1.0\nelement vertex 3\nproperty quad x\nend_header\n", "quad"},
        {"ply\nformat ascii 1.0\nelement vertex 3\nproperty list float int x\nend_header\n", "counted"},
        {"ply\nformat ascii 1.0\nelement vertex 3\nproperty float\nend_header\n", "expected"},
        {"ply\nformat ascii 1.0\nelement vertex 3\nelement vertex 3\nend_header\n", "second"},
        {"ply\nformat ascii 1.0\nelephant vertex 3\nend_header\n", "elephant"},
        {"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n" FACE
         "0 0\n1 0\n0 1\n3 0 1 2\n",
         "no x, y, z"},
        {HEAD FACE "0 0 0\n1 0 zero\n0 1 0\n3 0 1 2\n", ":11: vertex 1"},
        {HEAD FACE "0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n", "not a finite"},
        {HEAD FACE "0 0 0\n1 0 1e39\n0 1 0\n3 0 1 2\n", "not a finite"},
        {HEAD FACE "0 0 0\n1 0 inf\n0 1 0\n3 0 1 2\n", "not a finite"},
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
        {"ply\nformat binary_little_endian 1.0\nelement vertex 3\n" XYZ
         "element face 1000000\nproperty list uchar int "
         "vertex_indices\nend_header\n" THREE,
         "truncated"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct text f = {NULL, 0, 0};
        struct mesh m;
        struct error err = {""};
        char path[256];
        put_text(&f, cases[i].text);
        save(t, &f, path);
        CHECK(t, !ply_read(path, &m, &err), "refusal %lu (%s) is read", (unsigned long)i, cases[i].words);
        CHECK(t, strstr(err.text, cases[i].words) != NULL, "refusal %lu says '%s', not '%s'", (unsigned long)i,
              err.text, cases[i].words);
        CHECK(t, m.P == NULL && m.index == NULL && m.n_vertices == 0, "refusal %lu leaves a mesh",
              (unsigned long)i);
    }
    struct mesh m;
    struct error err = {""};
    CHECK(t, !ply_read("/nowhere/at/all.ply", &m, &err) && strstr(err.text, "/nowhere/at/all.ply") != NULL, "%s",
          err.text);
    CHECK(t, !ply_read(test_tmp(t), &m, &err), "a directory is read");
}

/* Odd but legal: what is not finite beside the position, polygons, faces that are none, meshes without normals. */
static void check_odd(struct test *t)
{
    static const char text[] =
        "ply\nformat ascii 1.0\nelement vertex 5\n" XYZ "property float u\nproperty float v\nproperty float nx\n"
        "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0 nan 0 9\n1 0 0 0 0 9\n2 1 0 0 0 9\n1 2 0 0 0 9\n0 1 0 0 0 9\n5 0 1 2 3 4\n0\n2 0 1\n3 0 0 0";
    struct text f = {NULL, 0, 0};
    struct mesh m;
    struct error err = {""};
    char path[256];
    put_text(&f, text);
    save(t, &f, path);
    bool ok = ply_read(path, &m, &err);
    CHECK(t, ok && m.n_triangles == 4 && m.N == NULL && m.UV != NULL && m.UV[0] == 0, "pentagon: %s", err.text);
    CHECK(t, m.n_thin == 2 && m.n_wide == 1, "%d and %d faces of few and of many corners", m.n_thin, m.n_wide);
    CHECK(t, !ok || (m.index[6] == 0 && m.index[7] == 3 && m.index[8] == 4), "the last triangle of the fan");
    mesh_free(&m);
}

/* As many elements as a file may have, and one more. */
static void check_elements(struct test *t)
{
    for (int n = PLY_MAX_ELEMENTS; n <= PLY_MAX_ELEMENTS + 1; n++) {
        struct text f = {NULL, 0, 0};
        struct mesh m;
        struct error err = {""};
        char path[256], line[64];
        put_text(&f, "ply\nformat ascii 1.0\nelement vertex 3\n" XYZ);
        for (int i = 0; i < n - 2; i++) {
            snprintf(line, sizeof line, "element e%d 0\n", i);
            put_text(&f, line);
        }
        put_text(&f, FACE "0 0 0 1 0 0 0 1 0 3 0 1 2 ");
        save(t, &f, path);
        bool ok = ply_read(path, &m, &err);
        CHECK(t, ok == (n == PLY_MAX_ELEMENTS), "%d elements: %s", n, err.text);
        CHECK(t, ok || strstr(err.text, "too many elements") != NULL, "%d elements: %s", n, err.text);
        mesh_free(&m);
    }
}

void test_ply(struct test *t)
{
    check_variants(t);
    check_cut_files(t);
    check_refused(t);
    check_odd(t);
    check_elements(t);
}
