/* ply.c: see ply.h. The file is read whole; the header becomes a list of elements with their properties, and
 * one function, next_number, reads a number of any type in any of the three encodings.
 */
#include "geometry/ply.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/file.h"
#include "base/mem.h"

enum encoding { ENCODING_ASCII, ENCODING_LITTLE, ENCODING_BIG };
enum scalar { INT8, UINT8, INT16, UINT16, INT32, UINT32, FLOAT32, FLOAT64, N_SCALARS };

/* What a vertex property means to us; the alternatives of a texture coordinate follow each other by two. */
enum role { X, Y, Z, NX, NY, NZ, U, V, N_ROLES, NO_ROLE = N_ROLES };

struct ply_property {
    char name[64];
    enum scalar type;
    bool is_list;
    enum scalar count_type; /* lists only */
    enum role role;         /* of a scalar of element vertex */
};

struct ply_element {
    char name[64];
    int count;
    int first, n; /* its properties */
};

struct ply {
    const char *path;
    uint8_t *data; /* [size] the whole file */
    size_t size, pos;
    size_t at;                         /* where in a header or an ascii file messages point; 0: nowhere */
    const struct ply_element *reading; /* of which element they speak, NULL: of none */
    int row;                           /* and of which row of it */
    enum encoding encoding;
    struct ply_element element[PLY_MAX_ELEMENTS]; /* [n_elements] */
    struct ply_property *property;                /* [n_properties] */
    size_t n_elements, n_properties;
    struct mesh *mesh;
    size_t n_indices;
    struct error *err;
};

static const int SCALAR_SIZE[N_SCALARS] = {1, 1, 2, 2, 4, 4, 4, 8};

/* --- messages ----------------------------------------------------------------------------------------- */

static int line_at(const struct ply *r, size_t pos)
{
    int line = 1;
    for (size_t i = 0; i < pos && i < r->size; i++)
        line += r->data[i] == '\n';
    return line;
}

/* "PATH:LINE: ELEMENT ROW: what": the line and the row where there are such. */
static bool fail(struct ply *r, const char *what, const char *detail)
{
    char line[24] = "", row[96] = "";
    if (r->at > 0)
        snprintf(line, sizeof line, ":%d", line_at(r, r->at));
    if (r->reading != NULL)
        snprintf(row, sizeof row, " %s %d:", r->reading->name, r->row);
    return error_set(r->err, "%s%s:%s %s%s", r->path, line, row, what, detail);
}

/* --- header ------------------------------------------------------------------------------------------- */

enum { MAX_WORDS = 5, WORD_SIZE = 64 };

/* The next line, cut into at most five words; returns how many, -1 at the end of the file. */
static int next_line(struct ply *r, char word[MAX_WORDS][WORD_SIZE])
{
    char line[512];
    r->at = r->pos;
    if (r->pos >= r->size)
        return -1;
    const uint8_t *start = r->data + r->pos, *end = memchr(start, '\n', r->size - r->pos);
    if (end == NULL)
        return -1;
    size_t length = (size_t)(end - start), kept = length < sizeof line ? length : sizeof line - 1;
    memcpy(line, start, kept);
    line[kept] = 0;
    r->pos += length + 1;
    int n = sscanf(line, "%63s %63s %63s %63s %63s", word[0], word[1], word[2], word[3], word[4]);
    return n < 0 ? 0 : n;
}

/* The number of a name in a list of n; -1 if it is not there. */
static int index_of(const char *name, const char *const *names, int n)
{
    for (int i = 0; i < n; i++)
        if (strcmp(name, names[i]) == 0)
            return i;
    return -1;
}

static bool scalar_of(const char *name, enum scalar *out)
{
    static const char *const names[2 * N_SCALARS] = {
        "char", "uchar", "short", "ushort", "int", "uint", "float", "double",
        "int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"};
    int i = index_of(name, names, 2 * N_SCALARS);
    if (i >= 0)
        *out = (enum scalar)(i % N_SCALARS);
    return i >= 0;
}

static bool header_format(struct ply *r, const char *name, const char *version)
{
    static const char *const names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    int i = strcmp(version, "1.0") == 0 ? index_of(name, names, 3) : -1;
    if (i < 0)
        return fail(r, "not a format of PLY 1.0: ", name);
    r->encoding = (enum encoding)i;
    return true;
}

static bool header_element(struct ply *r, const char *name, const char *count)
{
    char *end;
    errno = 0;
    long n = strtol(count, &end, 10);
    if (*end != 0 || end == count || n < 0 || n > FIRST_QUADRIC || errno != 0)
        return fail(r, "not a usable element count: ", count);
    for (size_t i = 0; i < r->n_elements; i++)
        if (strcmp(r->element[i].name, name) == 0)
            return fail(r, "a second element named ", name);
    if (r->n_elements == PLY_MAX_ELEMENTS)
        return fail(r, "too many elements, of which vertex and face are of use: ", name);
    struct ply_element *e = &r->element[r->n_elements++];
    strcpy(e->name, name);
    e->count = (int)n;
    e->first = (int)r->n_properties;
    e->n = 0;
    return true;
}

static bool header_property(struct ply *r, char word[MAX_WORDS][WORD_SIZE], int n)
{
    struct ply_property p = {.is_list = n == 5 && strcmp(word[1], "list") == 0, .role = NO_ROLE};
    if (r->n_elements == 0)
        return fail(r, "a property before any element", "");
    if (n != (p.is_list ? 5 : 3))
        return fail(r, "expected 'property TYPE NAME' or 'property list TYPE TYPE NAME'", "");
    if (p.is_list && (!scalar_of(word[2], &p.count_type) || p.count_type >= FLOAT32))
        return fail(r, "a list cannot be counted by the type ", word[2]);
    if (!scalar_of(word[p.is_list ? 3 : 1], &p.type))
        return fail(r, "unknown type ", word[p.is_list ? 3 : 1]);
    strcpy(p.name, word[n - 1]);
    r->property = mem_append(r->property, r->n_properties, sizeof *r->property);
    r->property[r->n_properties++] = p;
    r->element[r->n_elements - 1].n++;
    return true;
}

static bool read_header(struct ply *r)
{
    char word[MAX_WORDS][WORD_SIZE];
    bool has_format = false;
    if (next_line(r, word) != 1 || strcmp(word[0], "ply") != 0)
        return fail(r, "not a PLY file (its first line is not 'ply')", "");
    for (;;) {
        int n = next_line(r, word);
        bool ok = true;
        if (n < 0)
            return fail(r, "the header has no end_header", "");
        if (n == 0 || strcmp(word[0], "comment") == 0 || strcmp(word[0], "obj_info") == 0)
            continue;
        if (strcmp(word[0], "end_header") == 0)
            break;
        if (strcmp(word[0], "format") == 0 && n == 3)
            ok = has_format = header_format(r, word[1], word[2]);
        else if (strcmp(word[0], "element") == 0 && n == 3)
            ok = header_element(r, word[1], word[2]);
        else if (strcmp(word[0], "property") == 0)
            ok = header_property(r, word, n);
        else
            return fail(r, "not a line of a PLY header: ", word[0]);
        if (!ok)
            return false;
    }
    return has_format || fail(r, "the header has no format line", "");
}

/* Counts are promises; hold them against the bytes that are there before allocating anything. */
static bool check_counts(struct ply *r)
{
    double need = 0;
    r->at = 0;
    for (size_t i = 0; i < r->n_elements; i++) {
        const struct ply_element *e = &r->element[i];
        double row = 0;
        for (int k = 0; k < e->n; k++) {
            const struct ply_property *p = &r->property[e->first + k];
            row += r->encoding == ENCODING_ASCII ? 2 : SCALAR_SIZE[p->is_list ? p->count_type : p->type];
        }
        need += row * e->count;
    }
    if (need > (double)(r->size - r->pos) + 1) /* the last number of an ascii file may lack its newline */
        return fail(r, "truncated: the header announces more than the file holds", "");
    return true;
}

/* --- numbers ------------------------------------------------------------------------------------------ */

static bool next_ascii(struct ply *r, double *out)
{
    char word[64], *end;
    size_t n = 0;
    while (r->pos < r->size && isspace(r->data[r->pos]))
        r->pos++;
    r->at = r->pos;
    while (r->pos + n < r->size && !isspace(r->data[r->pos + n]) && n < sizeof word - 1) {
        word[n] = (char)r->data[r->pos + n];
        n++;
    }
    word[n] = 0;
    *out = strtod(word, &end);
    if (n == 0 || end != word + n)
        return false;
    r->pos += n;
    return true;
}

static double decode(uint64_t bits, enum scalar type)
{
    double d;
    switch (type) {
    case INT8: return (double)bits - (bits >= 0x80 ? 0x100 : 0);
    case INT16: return (double)bits - (bits >= 0x8000 ? 0x10000 : 0);
    case INT32: return (double)bits - (bits >= 0x80000000u ? 4294967296.0 : 0);
    case UINT8:
    case UINT16:
    case UINT32: return (double)bits;
    case FLOAT32: return (double)float_of_bits((uint32_t)bits);
    case FLOAT64: memcpy(&d, &bits, sizeof d); return d;
    case N_SCALARS: break;
    }
    return 0;
}

/* One number of the given type; false, with a message, at the end of the file or, in ascii, on what is none. */
static bool next_number(struct ply *r, enum scalar type, double *out)
{
    size_t size = (size_t)SCALAR_SIZE[type];
    if (r->encoding == ENCODING_ASCII ? !next_ascii(r, out) : size > r->size - r->pos)
        return fail(r, "the file ends or has no number here", "");
    if (r->encoding != ENCODING_ASCII) {
        *out = decode(bits_of_bytes(r->data + r->pos, size, r->encoding == ENCODING_BIG), type);
        r->pos += size;
    }
    return true;
}

/* A list's length: a whole number, 0 or more. */
static bool next_count(struct ply *r, const struct ply_property *p, double *count)
{
    if (!next_number(r, p->count_type, count))
        return false;
    if (!(*count >= 0 && *count <= FIRST_QUADRIC) || *count != floor(*count))
        return fail(r, "not a list length", "");
    return true;
}

/* --- elements ----------------------------------------------------------------------------------------- */

static bool skip_list(struct ply *r, const struct ply_property *p)
{
    double count, ignored;
    if (!next_count(r, p, &count))
        return false;
    for (double k = 0; k < count; k++)
        if (!next_number(r, p->type, &ignored))
            return false;
    return true;
}

static struct ply_property *scalar_named(struct ply *r, const struct ply_element *e, const char *name)
{
    for (int k = 0; k < e->n; k++)
        if (!r->property[e->first + k].is_list && strcmp(r->property[e->first + k].name, name) == 0)
            return &r->property[e->first + k];
    return NULL;
}

/* Give the n properties of these names the roles from `role` on, if all of them are there. */
static bool assign_roles(struct ply *r, const struct ply_element *e, const char *const *names, int n, enum role role)
{
    for (int i = 0; i < n; i++)
        if (scalar_named(r, e, names[i]) == NULL)
            return false;
    for (int i = 0; i < n; i++)
        scalar_named(r, e, names[i])->role = (enum role)((int)role + i);
    return true;
}

static bool assign_uv(struct ply *r, const struct ply_element *e)
{
    static const char *const names[4][2] = {
        {"u", "v"}, {"s", "t"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}};
    for (int i = 0; i < 4; i++)
        if (assign_roles(r, e, names[i], 2, U))
            return true;
    return false;
}

static void add_triangle(struct ply *r, uint32_t a, uint32_t b, uint32_t c)
{
    struct mesh *m = r->mesh;
    const uint32_t corner[3] = {a, b, c};
    for (int k = 0; k < 3; k++) {
        m->index = mem_append(m->index, r->n_indices, sizeof *m->index);
        m->index[r->n_indices++] = corner[k];
    }
}

/* One polygon, cut into a fan around its first corner. */
static bool read_polygon(struct ply *r, const struct ply_property *p)
{
    double count, value;
    uint32_t first = 0, previous = 0;
    if (!next_count(r, p, &count))
        return false;
    r->mesh->n_thin += count < 3;
    r->mesh->n_wide += count > 4;
    for (double k = 0; k < count; k++) {
        if (!next_number(r, p->type, &value))
            return false;
        if (!(value >= 0 && value < FIRST_QUADRIC) || value != floor(value))
            return fail(r, "not a vertex index", "");
        uint32_t index = (uint32_t)value;
        if (k >= 2)
            add_triangle(r, first, previous, index);
        first = k == 0 ? index : first;
        previous = index;
    }
    return true;
}

static bool store_vertex(struct ply *r, size_t i, const double value[N_ROLES])
{
    struct mesh *m = r->mesh;
    for (int k = 0; k < N_ROLES; k++) {
        bool good = fits_float(value[k]);
        float f = good ? (float)value[k] : 0;
        if (k <= Z && !good)
            return fail(r, "the position is not a finite number", "");
        if (k <= Z)
            m->P[3 * i + (size_t)k] = f;
        else if (k <= NZ && m->N != NULL)
            m->N[3 * i + (size_t)(k - NX)] = f;
        else if (k > NZ && m->UV != NULL)
            m->UV[2 * i + (size_t)(k - U)] = f;
    }
    return true;
}

/* All rows of an element. Of lists only the polygons are used, of numbers those that have a role. */
static bool read_rows(struct ply *r, const struct ply_element *e, const struct ply_property *polygon)
{
    bool is_vertex = strcmp(e->name, "vertex") == 0;
    r->reading = e;
    for (r->row = 0; e->n > 0 && r->row < e->count; r->row++) {
        double value[N_ROLES + 1] = {0}; /* the last takes what we do not use */
        for (int k = 0; k < e->n; k++) {
            const struct ply_property *p = &r->property[e->first + k];
            bool ok = p == polygon ? read_polygon(r, p)
                      : p->is_list ? skip_list(r, p)
                                   : next_number(r, p->type, &value[p->role]);
            if (!ok)
                return false;
        }
        if (is_vertex && !store_vertex(r, (size_t)r->row, value))
            return false;
    }
    r->reading = NULL;
    r->at = 0;
    return true;
}

static bool read_vertices(struct ply *r, const struct ply_element *e)
{
    static const char *const xyz[] = {"x", "y", "z"}, *const normal[] = {"nx", "ny", "nz"};
    struct mesh *m = r->mesh;
    size_t count = (size_t)e->count;
    if (!assign_roles(r, e, xyz, 3, X))
        return fail(r, "vertices have no x, y, z", "");
    m->P = mem_alloc(count * 3, sizeof *m->P);
    if (assign_roles(r, e, normal, 3, NX))
        m->N = mem_alloc(count * 3, sizeof *m->N);
    if (assign_uv(r, e))
        m->UV = mem_alloc(count * 2, sizeof *m->UV);
    m->n_vertices = e->count;
    return read_rows(r, e, NULL);
}

static bool read_faces(struct ply *r, const struct ply_element *e)
{
    const struct ply_property *polygon = NULL;
    for (int k = 0; k < e->n; k++) {
        const struct ply_property *p = &r->property[e->first + k];
        bool named = strcmp(p->name, "vertex_indices") == 0 || strcmp(p->name, "vertex_index") == 0;
        if (named && p->is_list && p->type < FLOAT32)
            polygon = p;
    }
    if (polygon == NULL)
        return fail(r, "faces have no integer list vertex_indices (or vertex_index)", "");
    if (!read_rows(r, e, polygon))
        return false;
    if (r->n_indices / 3 > FIRST_QUADRIC)
        return fail(r, "more than 2^30 triangles", "");
    if (r->n_indices / 3 * PLY_BYTES_PER_TRIANGLE > r->size)
        return fail(r, "polygons of so many corners that a triangle of theirs has less than two bytes", "");
    r->mesh->n_triangles = (int)(r->n_indices / 3);
    return true;
}

static bool read_body(struct ply *r)
{
    for (size_t i = 0; i < r->n_elements; i++) {
        const struct ply_element *e = &r->element[i];
        bool ok;
        if (strcmp(e->name, "vertex") == 0)
            ok = read_vertices(r, e);
        else if (strcmp(e->name, "face") == 0)
            ok = read_faces(r, e);
        else
            ok = read_rows(r, e, NULL);
        if (!ok)
            return false;
    }
    return true;
}

/* Done at the end because faces may stand before the vertices. */
static bool check_mesh(struct ply *r)
{
    const struct mesh *m = r->mesh;
    if (m->n_triangles == 0 && m->n_thin == 0)
        return fail(r, "no faces", "");
    for (size_t i = 0; i < r->n_indices; i++)
        if (m->index[i] >= (uint32_t)m->n_vertices)
            return error_set(r->err, "%s: a face refers to vertex %lu, but there are only %d", r->path,
                             (unsigned long)m->index[i], m->n_vertices);
    return true;
}

bool ply_read(const char *path, struct mesh *out, struct error *err)
{
    struct mesh empty = {0};
    struct ply r = {0};
    *out = empty;
    r.path = path;
    r.mesh = out;
    r.err = err;
    bool ok = file_read(path, &r.data, &r.size, err) && read_header(&r) && check_counts(&r) && read_body(&r) &&
              check_mesh(&r);
    out->content = hash_content(r.data, r.size);
    out->file_size = r.size;
    free(r.data);
    free(r.property);
    if (!ok)
        mesh_free(out);
    return ok;
}
