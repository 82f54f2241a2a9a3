/* ply.c: see ply.h. The file is read whole; the header becomes a list of elements with their properties, and
 * one function, next_number, reads a number of any type in any of the three encodings.
 */
#include "geometry/ply.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/file.h"
#include "base/mem.h"
#include "geometry/mesh.h"
#include "geometry/polygon.h"

enum encoding { NO_ENCODING, ENCODING_ASCII, ENCODING_LITTLE, ENCODING_BIG };
enum scalar { INT8, UINT8, INT16, UINT16, INT32, UINT32, FLOAT32, FLOAT64, N_SCALARS };

/* What a property means to us; NO_ROLE: nothing. */
enum role { X, Y, Z, NX, NY, NZ, U, V, NO_ROLE, POLYGON, STRIP };

struct ply_property {
    enum scalar type, count_type; /* count_type: of lists only */
    bool is_list;
    enum role role;
};

struct ply_element {
    char name[64];
    int count;
    int first, n; /* its properties */
    bool has[STRIP + 1]; /* which roles these have */
};

/* A face of more than three corners, and its first triangle's place in the indices. */
struct ply_polygon {
    size_t first;
    int n;
};

struct ply {
    const char *path;
    uint8_t *data; /* [size] the whole file */
    size_t size, pos;
    const char *part; /* for messages: "line" in the header, an element's name in its rows, NULL elsewhere */
    int number;       /* of the line or row */
    enum encoding encoding;
    struct ply_element element[PLY_MAX_ELEMENTS]; /* [n_elements] */
    struct ply_property *property;                /* [n_properties] */
    size_t n_elements, n_properties;
    struct mesh *mesh;
    struct ply_polygon *polygon; /* [n_polygons] */
    size_t n_indices, n_polygons;
    char line_end;               /* of the header: CR where no LF follows the first one, else LF */
    struct error *err;
};

static const int SCALAR_SIZE[N_SCALARS] = {1, 1, 2, 2, 4, 4, 4, 8};

/* --- messages ----------------------------------------------------------------------------------------- */

/* "PATH: PART NUMBER: what" in a part with numbers, "PATH: what" elsewhere. */
static bool fail(struct ply *r, const char *what, const char *detail)
{
    if (r->part == NULL)
        return error_set(r->err, "%s: %s%s", r->path, what, detail);
    return error_set(r->err, "%s: %s %d: %s%s", r->path, r->part, r->number, what, detail);
}

/* --- header ------------------------------------------------------------------------------------------- */

enum { LINE_SIZE = 512, MAX_WORDS = 5, WORD_SIZE = 64 };

/* The next line, or what fits of it, without spaces at its end; false at the end of the file. */
static bool next_line(struct ply *r, char line[LINE_SIZE])
{
    const uint8_t *start = r->data + r->pos, *end = memchr(start, r->line_end, r->size - r->pos);
    if (end == NULL)
        return false;
    size_t length = (size_t)(end - start), kept = length < LINE_SIZE ? length : LINE_SIZE - 1;
    while (kept > 0 && isspace(start[kept - 1]))
        kept--;
    memcpy(line, start, kept);
    line[kept] = 0;
    r->pos += length + 1;
    r->number++;
    return true;
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

static enum role role_of(const char *element, const struct ply_property *p, const char *name)
{
    static const char *const lists[] = {"vertex_indices", "vertex_index"};
    static const char *const numbers[] = {"x", "y", "z", "nx", "ny", "nz", "u", "v", "s", "t", "texture_u", "texture_v",
                                          "texture_s", "texture_t"};
    if (p->is_list && p->type < FLOAT32 && index_of(name, lists, 2) >= 0)
        return strcmp(element, "face") == 0 ? POLYGON : strcmp(element, "tristrips") == 0 ? STRIP : NO_ROLE;
    if (p->is_list)
        return NO_ROLE;
    int i = strcmp(element, "vertex") == 0 ? index_of(name, numbers, 14) : -1;
    return i < 0 ? NO_ROLE : i < U ? (enum role)i : i % 2 == 0 ? U : V;
}

static bool header_element(struct ply *r, const char *name, const char *count)
{
    char *end;
    long n = strtol(count, &end, 10);
    for (size_t i = 0; i < r->n_elements; i++)
        if (strcmp(r->element[i].name, name) == 0)
            return false;
    if (*end != 0 || n < 0 || n > FIRST_QUADRIC || r->n_elements == PLY_MAX_ELEMENTS)
        return false;
    struct ply_element *e = &r->element[r->n_elements++];
    strcpy(e->name, name);
    e->count = (int)n;
    e->first = (int)r->n_properties;
    return true;
}

static bool header_property(struct ply *r, char word[MAX_WORDS][WORD_SIZE], int n)
{
    struct ply_property p = {.is_list = n == 5 && strcmp(word[1], "list") == 0};
    if (r->n_elements == 0 || n != (p.is_list ? 5 : 3) || !scalar_of(word[n - 2], &p.type))
        return false;
    if (p.is_list && (!scalar_of(word[2], &p.count_type) || p.count_type >= FLOAT32))
        return false;
    struct ply_element *e = &r->element[r->n_elements - 1];
    p.role = role_of(e->name, &p, word[n - 1]);
    r->property = mem_append(r->property, r->n_properties, sizeof *r->property);
    r->property[r->n_properties++] = p;
    e->n++;
    e->has[p.role] = true;
    return true;
}

/* What a line of the header says; false if that is not understood. */
static bool header_line(struct ply *r, const char *line)
{
    static const char *const formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    char word[MAX_WORDS][WORD_SIZE];
    int n = sscanf(line, "%63s %63s %63s %63s %63s", word[0], word[1], word[2], word[3], word[4]);
    if (n <= 0 || strcmp(word[0], "comment") == 0 || strcmp(word[0], "obj_info") == 0)
        return true;
    if (strcmp(word[0], "format") == 0 && n == 3) {
        r->encoding = (enum encoding)(1 + index_of(word[1], formats, 3));
        return r->encoding != NO_ENCODING && strcmp(word[2], "1.0") == 0;
    }
    if (strcmp(word[0], "element") == 0 && n == 3)
        return header_element(r, word[1], word[2]);
    return strcmp(word[0], "property") == 0 && header_property(r, word, n);
}

static bool read_header(struct ply *r)
{
    char line[LINE_SIZE];
    const uint8_t *cr = memchr(r->data, '\r', r->size);
    r->line_end = cr != NULL && cr[1] != '\n' && memchr(r->data, '\n', (size_t)(cr - r->data)) == NULL ? '\r' : '\n';
    r->part = "line";
    bool read = next_line(r, line);
    if (!read || strcmp(line, "ply") != 0)
        return fail(r, "not a PLY file (its first line is not 'ply')", "");
    while ((read = next_line(r, line)) && strcmp(line, "end_header") != 0)
        if (!header_line(r, line))
            return fail(r, "not a usable line of the header of PLY 1.0: ", line);
    if (!read || r->encoding == NO_ENCODING)
        return fail(r, "the header has no ", read ? "format line" : "end_header");
    r->part = NULL;
    return true;
}

/* Counts are promises; hold them against the bytes that are there before allocating anything. */
static bool check_counts(struct ply *r)
{
    double need = 0;
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
    char word[512], *end; /* a double has up to 767 digits that count, but nobody writes so many */
    size_t n = 0;
    while (r->pos < r->size && isspace(r->data[r->pos]))
        r->pos++;
    while (r->pos + n < r->size && !isspace(r->data[r->pos + n])) {
        if (n == sizeof word - 1)
            return false;
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

/* --- elements ----------------------------------------------------------------------------------------- */

static void add_triangle(struct ply *r, uint32_t a, uint32_t b, uint32_t c)
{
    struct mesh *m = r->mesh;
    const uint32_t corner[3] = {a, b, c};
    for (int k = 0; k < 3; k++) {
        m->index = mem_append(m->index, r->n_indices, sizeof *m->index);
        m->index[r->n_indices++] = corner[k];
    }
}

/* A corner behind n others of its face or strip. A face becomes a fan around its first corner, (0,1,2), (3,0,2) ..., as
 * pbrt-v3 cuts quadrilaterals; a strip turns at every corner. */
static void add_corner(struct ply *r, const struct ply_property *p, int n, uint32_t *first, uint32_t *last,
                       uint32_t corner)
{
    bool strip = p->role == STRIP;
    if (n > 2 && !strip)
        add_triangle(r, corner, *first, *last);
    else if (n > 2 && n % 2 != 0)
        add_triangle(r, *last, *first, corner);
    else if (n >= 2)
        add_triangle(r, *first, *last, corner);
    *first = n == 0 ? corner : strip ? *last : *first;
    *last = corner;
}

/* A list. In a strip's, -1 begins another. */
static bool read_list(struct ply *r, const struct ply_property *p)
{
    double count, value;
    uint32_t first = 0, last = 0;
    int n = 0;
    if (!next_number(r, p->count_type, &count))
        return false;
    if (!(count >= 0 && count <= FIRST_QUADRIC) || count != floor(count))
        return fail(r, "not a list length", "");
    r->mesh->n_thin += p->role == POLYGON && count < 3;
    if (p->role == POLYGON && count > 3) {
        r->polygon = mem_append(r->polygon, r->n_polygons, sizeof *r->polygon);
        r->polygon[r->n_polygons++] = (struct ply_polygon){r->n_indices, (int)count};
    }
    for (double k = 0; k < count; k++, n++) {
        if (!next_number(r, p->type, &value))
            return false;
        if (p->role == STRIP && value == -1)
            n = -1;
        else if (p->role != NO_ROLE && (!(value >= 0 && value < FIRST_QUADRIC) || value != floor(value)))
            return fail(r, "not a vertex index", "");
        else if (p->role != NO_ROLE)
            add_corner(r, p, n, &first, &last, (uint32_t)value);
    }
    return true;
}

static bool store_vertex(struct ply *r, size_t i, const double value[NO_ROLE])
{
    struct mesh *m = r->mesh;
    for (int k = 0; k < NO_ROLE; k++) {
        bool good = fits_float(value[k]);
        float f = good ? (float)value[k] : 0;
        if (k <= Z && !good)
            return fail(r, "the position is not a finite number", "");
        if (k > Z && k <= NZ && m->N != NULL)
            m->N[3 * i + (size_t)(k - NX)] = f;
        else if (k > NZ && m->UV != NULL)
            m->UV[2 * i + (size_t)(k - U)] = f;
    }
    m->P[i] = vec(value[X], value[Y], value[Z]);
    return true;
}

/* All rows of an element; only what has a role is used. */
static bool read_rows(struct ply *r, const struct ply_element *e)
{
    bool is_vertex = strcmp(e->name, "vertex") == 0;
    r->part = e->name;
    for (r->number = 0; e->n > 0 && r->number < e->count; r->number++) {
        double value[NO_ROLE + 1] = {0}; /* the last takes what we do not use */
        for (int k = 0; k < e->n; k++) {
            const struct ply_property *p = &r->property[e->first + k];
            if (!(p->is_list ? read_list(r, p) : next_number(r, p->type, &value[p->role])))
                return false;
        }
        if (is_vertex && !store_vertex(r, (size_t)r->number, value))
            return false;
    }
    r->part = NULL;
    return true;
}

/* Room for the vertices. */
static bool start_vertices(struct ply *r, const struct ply_element *e)
{
    struct mesh *m = r->mesh;
    size_t count = (size_t)e->count;
    if (!(e->has[X] && e->has[Y] && e->has[Z]))
        return fail(r, "vertices have no x, y, z", "");
    m->P = mem_alloc(count, sizeof *m->P);
    if (e->has[NX] && e->has[NY] && e->has[NZ])
        m->N = mem_alloc(count * 3, sizeof *m->N);
    if (e->has[U] && e->has[V])
        m->UV = mem_alloc(count * 2, sizeof *m->UV);
    m->n_vertices = e->count;
    return true;
}

static bool read_body(struct ply *r)
{
    for (size_t i = 0; i < r->n_elements; i++) {
        const struct ply_element *e = &r->element[i];
        if (strcmp(e->name, "vertex") == 0 && !start_vertices(r, e))
            return false;
        if (strcmp(e->name, "face") == 0 && !e->has[POLYGON])
            return fail(r, "faces have no integer list vertex_indices (or vertex_index)", "");
        if (!read_rows(r, e))
            return false;
    }
    return true;
}

/* Done at the end because faces may come before the vertices. */
static bool check_mesh(struct ply *r)
{
    struct mesh *m = r->mesh;
    size_t n_triangles = r->n_indices / 3;
    if (n_triangles == 0 && m->n_thin == 0)
        return fail(r, "no faces", "");
    if (n_triangles > FIRST_QUADRIC || n_triangles * PLY_BYTES_PER_TRIANGLE > r->size)
        return fail(r, "more than 2^30 triangles, or less than two bytes for each", "");
    for (size_t i = 0; i < r->n_indices; i++)
        if (m->index[i] >= (uint32_t)m->n_vertices)
            return error_set(r->err, "%s: a face refers to vertex %lu, but there are only %d", r->path,
                             (unsigned long)m->index[i], m->n_vertices);
    m->n_triangles = (int)n_triangles;
    return true;
}

static bool cut_polygons(struct ply *r)
{
    double room = PLY_TESTS_PER_BYTE * (double)r->size;
    for (size_t i = 0; i < r->n_polygons; i++)
        if (!polygon_cut(r->mesh->P, r->mesh->index + r->polygon[i].first, r->polygon[i].n, &room))
            return fail(r, "its faces that are not convex have too many corners; cut them into triangles", "");
    return true;
}

bool ply_read(const char *path, struct mesh *out, struct error *err)
{
    struct ply r = {.path = path, .mesh = out, .err = err};
    memset(out, 0, sizeof *out);
    bool ok = file_read(path, &r.data, &r.size, err) && read_header(&r) && check_counts(&r) && read_body(&r) &&
              check_mesh(&r) && cut_polygons(&r);
    out->content = hash_content(r.data, r.size);
    out->file_size = r.size;
    free(r.data);
    free(r.property);
    free(r.polygon);
    if (!ok)
        mesh_free(out);
    return ok;
}

/* --- the row ------------------------------------------------------------------------------------------ */

struct plymesh {
    const char *path;
};

static bool mesh(const void *fields, struct mesh_task *task, struct mesh *out)
{
    const struct plymesh *p = fields;
    if (p->path == NULL)
        return error_set(&task->err, "a plymesh needs its file: add \"string filename\" \"...\"");
    task->about = "filename";
    if (!ply_read(p->path, out, &task->err))
        return false;
    if (out->n_thin > 0)
        task->warn(task, "%d faces of fewer than 3 corners are left out", out->n_thin);
    return true;
}

static const struct field FIELDS[] = {{"filename", .kind = FIELD_FILE, .place = offsetof(struct plymesh, path)},
                                      {.name = "alpha"}, {.name = "shadowalpha"}, {.name = NULL}};

const struct shape_row shape_plymesh = {.name = "plymesh", .fields = FIELDS, .size = sizeof(struct plymesh),
                                        .may_shine = true, .mesh = mesh};
