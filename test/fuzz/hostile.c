/* hostile.c: see hostile.h. */
#include "hostile.h"

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "parser/parse.h"

enum { MOST_TEXT = 4 << 20, MOST_REPEATED = 4096 };

struct writer {
    const uint8_t *bytes; /* [n], those before `at` are used */
    size_t n, at;
    char *text; /* owned */
    size_t used, capacity;
};

/* A number below n, which is at most 256; 0 when the bytes are used up. */
static unsigned choose(struct writer *w, unsigned n) { return w->at < w->n ? w->bytes[w->at++] % n : 0; }
static bool rarely(struct writer *w, unsigned n) { return choose(w, n) == n - 1; }

static void put(struct writer *w, const char *format, ...)
{
    char piece[256];
    va_list args;
    va_start(args, format);
    int n = vsnprintf(piece, sizeof piece, format, args);
    va_end(args);
    size_t size = n > 0 && (size_t)n < sizeof piece ? (size_t)n : 0;
    w->text = mem_grow(w->text, &w->capacity, w->used + size + 1, 1);
    memcpy(w->text + w->used, piece, size);
    w->used += size;
    w->text[w->used] = '\0';
}

/* --- numbers -------------------------------------------------------------------------------------------- */

static const char *const EDGE[] = {
    "-0", "1e-308", "4.9e-324", "1e-45", "1e-38", "1e-30", "1e-20", "1e-12", "1e-7", "0.99999999999999",
    "1.0000001", "1000", "1e5", "1e7", "1e9", "1e12", "1e15", "1e18", "1e19", "1e30", "-1e30", "1e31", "1e38",
    "3.5e38", "1e100", "1e308", "-1e308", "1e309", "nan", "inf", "-1e-308", "90", "180", "-180", "360",
    "89.9999999", "255", "2147483647", "2147483648", "-2147483649", "4294967296", "18446744073709551616",
    "0.000000000000000000000000000000000001"};
enum { N_EDGE = sizeof EDGE / sizeof EDGE[0] };

const char *hostile_number(unsigned i) { return EDGE[i % N_EDGE]; }

/* One bad number is enough for a scene to be refused at once, so most are ordinary. */
static void number(struct writer *w)
{
    static const char *const ORDINARY[] = {"1", "0.5", "2", "0.1", "3", "0.9", "10", "45", "0.01", "1", "5", "0.3"};
    static const char *const LOWER[] = {"0", "-1", "-0.5", "-2"};
    if (rarely(w, 50))
        put(w, "%s ", EDGE[choose(w, N_EDGE)]);
    else if (rarely(w, 10))
        put(w, "%s ", LOWER[choose(w, sizeof LOWER / sizeof LOWER[0])]);
    else
        put(w, "%s ", ORDINARY[choose(w, sizeof ORDINARY / sizeof ORDINARY[0])]);
}

static void numbers(struct writer *w, unsigned n)
{
    for (unsigned i = 0; i < n; i++)
        number(w);
}

/* --- objects -------------------------------------------------------------------------------------------- */

/* The parser's own tables say which types of object there are, and which parameters each has. What they leave to the
 * code is here: the type of a parameter, and what it may be, the first mostly; NULL: numbers. */
static const struct open {
    const char *name, *type, *values;
} OPEN[] = {
    {"I", "rgb", NULL}, {"L", "rgb", NULL}, {"scale", "rgb", NULL}, {"eta", "rgb", NULL}, {"k", "spectrum", NULL},
    {"v1", "vector", NULL}, {"v2", "vector", NULL}, {"xsamples", "integer", NULL}, {"ysamples", "integer", NULL},
    {"dimension", "integer", NULL}, {"group", "string", "a,b,c/d"}, {"visible", "bool", "true,false"},
    {"gamma", "bool", "true,false"}, {"wrap", "string", "repeat,black,clamp"},
    {"mapping", "string", "uv,planar,spherical,cylindrical"},
    {"mapname", "string", "parts/map.pfm,parts/grey.tga,parts/bad.pfm,missing.exr"},
    {"filename", "string", "parts/grey.tga,parts/map.pfm,missing.png,."},
    {"screenwindow", "float", "-1 1 -1 1,0 1e-30 0 1,1 0 0 1,-1e30 1e30 0 1"},
    {"cropwindow", "float", "0 1 0 1,0.4 0.6 0 1,0.9 0.1 0 1,0 1e-30 0 1"},
    {NULL, "float", NULL}};

/* What a kind of field is in a scene file, and how many numbers it takes: four points, so that lists fit together. */
static const struct open OF_KIND[] = {
    [FIELD_INTEGER] = {NULL, "integer", NULL}, [FIELD_NUMBER] = {NULL, "float", NULL},
    [FIELD_WORD] = {NULL, "string", NULL}, [FIELD_IGNORED] = {NULL, "float", NULL},
    [FIELD_SWITCH] = {NULL, "bool", "true,false"}, [FIELD_POINT] = {NULL, "point", NULL},
    [FIELD_FLOAT_TEXTURE] = {NULL, "float", NULL}, [FIELD_RGB_TEXTURE] = {NULL, "rgb", NULL},
    [FIELD_OPERAND] = {NULL, "rgb", NULL}, [FIELD_VALUE] = {NULL, "rgb", NULL},
    [FIELD_PART] = {NULL, "string", "m1,m0"},
    [FIELD_TABLE] = {NULL, "string", "../../scenes/features/layered.bsdf,parts/broken.ply"},
    [FIELD_FILE] = {NULL, "string", "parts/triangle.ply,parts/broken.ply"},
    [FIELD_INDICES] = {NULL, "integer", "0 1 2 0 2 3,0 1 2,0 1 2 3,0 -1 2 0 2 4"},
    [FIELD_POINTS] = {NULL, "point", NULL}, [FIELD_VECTORS] = {NULL, "vector", NULL},
    [FIELD_NORMALS] = {NULL, "normal", NULL}, [FIELD_PAIRS] = {NULL, "float", NULL}};

/* One of the values between commas. */
static void word(struct writer *w, const char *values, bool quoted)
{
    const char *at = values;
    for (unsigned k = rarely(w, 4) ? choose(w, 4) : 0; k > 0; k--) {
        const char *comma = strchr(at, ',');
        at = comma != NULL ? comma + 1 : values;
    }
    put(w, quoted ? "\"%.*s\" " : "%.*s ", (int)strcspn(at, ","), at);
}

/* Mostly within the field's bounds, else its fallback. */
static void number_of(struct writer *w, const struct field *f)
{
    size_t from = w->used;
    number(w);
    bool bounded = f->low < f->high && !rarely(w, 16);
    double x = strtod(w->text + from, NULL), back = fmin(fmax(f->fallback, f->low), f->high);
    if (bounded && !(x >= f->low && x <= f->high)) {
        w->used = from;
        put(w, "%.9g ", f->kind == FIELD_INTEGER ? ceil(back) : back);
    }
}

static bool is_list(enum field_kind kind) { return kind >= FIELD_INDICES && kind <= FIELD_PAIRS; }

static unsigned count(const struct field *f, const char *type)
{
    bool three = strcmp(type, "rgb") == 0 || strcmp(type, "point") == 0 || strcmp(type, "vector") == 0 ||
                 strcmp(type, "normal") == 0;
    unsigned one = three ? 3 : strcmp(type, "spectrum") == 0 || f->kind == FIELD_PAIRS ? 2 : 1;
    return is_list(f->kind) ? 4 * one : one;
}

static void parameter(struct writer *w, const struct field *f)
{
    const struct open *o = OPEN, *kind = &OF_KIND[f->kind];
    while (o->name != NULL && strcmp(o->name, f->name) != 0)
        o++;
    if (f->kind != FIELD_OTHER)
        o = kind;
    bool textured = f->kind == FIELD_FLOAT_TEXTURE || f->kind == FIELD_RGB_TEXTURE || f->kind == FIELD_OPERAND;
    unsigned wanted = count(f, o->type);
    if (rarely(w, 64))
        wanted = choose(w, 3);
    if (textured && choose(w, 3) == 1)
        put(w, "\"texture %s\" [ \"t%u\" ", f->name, choose(w, 3));
    else if (f->kind == FIELD_WORD)
        put(w, "\"string %s\" [ \"%s\" ", f->name, f->words[f->words[1] != NULL ? choose(w, 2) : 0]);
    else {
        put(w, "\"%s %s\" [ ", o->type, f->name);
        if (o->values != NULL)
            word(w, o->values, o->type[0] == 's' || o->type[0] == 'b');
        else if (f->kind == FIELD_INTEGER && !rarely(w, 16))
            put(w, "2 ");
        else
            for (; wanted > 0; wanted--)
                number_of(w, f);
    }
    put(w, "] ");
}

/* Lists, files, and counts that are 0 unless they are given, are mostly there: without them there is no object. */
static bool needed(struct writer *w, const struct field *f)
{
    bool count_of_list = f->kind == FIELD_INTEGER && f->fallback == 0;
    bool essential = is_list(f->kind) || f->kind == FIELD_FILE || f->kind == FIELD_TABLE || count_of_list ||
                     strcmp(f->name, "filename") == 0;
    return essential ? !rarely(w, 64) : choose(w, 3) == 1;
}

static void object(struct writer *w, const struct object_type *types)
{
    unsigned n = 0;
    while (types[n].name != NULL)
        n++;
    const struct object_type *type = &types[choose(w, n)];
    put(w, "\"%s\" ", type->name);
    for (const struct field *f = type->fields; f->name != NULL; f++)
        if (needed(w, f))
            parameter(w, f);
    put(w, "\n");
}

/* A directive of the table that has types of its own. */
static void directive(struct writer *w, const struct directive *table)
{
    unsigned n = 0;
    while (table[n].name != NULL)
        n++;
    const struct directive *d = &table[choose(w, n)];
    if (d->types == NULL)
        return;
    put(w, "%s ", d->name);
    object(w, d->types);
}

static void method(struct writer *w)
{
    static const char *const SELECT[] = {"bins", "pool", "vertices", "subspaces"};
    put(w, "Integrator \"%s\" \"string select\" \"%s\" \"integer maxdepth\" [ ", choose(w, 2) ? "asbdpt" : "bdpt",
        SELECT[choose(w, 4)]);
    number(w);
    put(w, "] \"float rrthreshold\" [ ");
    number(w);
    put(w, "]\n");
}

static void medium(struct writer *w)
{
    static const char *const NAMES[] = {"rgb sigma_a", "rgb sigma_s", "float g"};
    put(w, "MakeNamedMedium \"d0\" \"string type\" \"homogeneous\" ");
    for (unsigned i = 0; i < 3; i++) {
        put(w, "\"%s\" [ ", NAMES[i]);
        if (rarely(w, 8))
            numbers(w, i < 2 ? 3 : 1);
        else
            put(w, i < 2 ? "0.1 0.2 0.3 " : "0.3 ");
        put(w, "] ");
    }
    put(w, "\nMediumInterface \"%s\" \"%s\"\n", choose(w, 2) ? "d0" : "", rarely(w, 4) ? "d0" : "");
}

/* A shape, a material, a texture, or what only has a name. */
static void thing(struct writer *w, unsigned kind)
{
    static const char *const NAMED[] = {"NamedMaterial \"m0\"", "NamedMaterial \"m1\"", "Material \"none\"",
                                        "ObjectBegin \"o0\"", "ObjectInstance \"o0\"", "CoordinateSystem \"c0\"",
                                        "CoordSysTransform \"c0\"", "Include \"parts/box.pbrt\""};
    struct object_type types[MOST_TYPES];
    if (kind < 4) {
        parse_shape_types(types);
        put(w, "Shape ");
        object(w, types);
    } else if (kind < 7) {
        static const char *const BEFORE[] = {"Material", "MakeNamedMaterial \"m0\" \"string type\"",
                                             "MakeNamedMaterial \"m1\" \"string type\""};
        parse_material_types(types);
        put(w, "%s ", BEFORE[kind - 4]);
        object(w, types);
    } else if (kind < 9) {
        put(w, "Texture \"t%u\" \"%s\" ", choose(w, 2), kind == 7 ? "spectrum" : "float");
        object(w, TEXTURE_TYPES);
    } else {
        put(w, "%s\n", NAMED[choose(w, sizeof NAMED / sizeof NAMED[0])]);
    }
}

static void transform(struct writer *w)
{
    static const struct {
        const char *name;
        unsigned n;
    } KINDS[] = {{"Translate", 3}, {"Scale", 3},  {"Rotate", 4},
                 {"Translate", 3}, {"LookAt", 9}, {"ConcatTransform [", 16}};
    unsigned k = choose(w, sizeof KINDS / sizeof KINDS[0]);
    put(w, "%s ", KINDS[k].name);
    numbers(w, KINDS[k].n);
    put(w, KINDS[k].n == 16 ? "]\n" : "\n");
}

static void block(struct writer *w)
{
    static const char *const KINDS[] = {"AttributeBegin", "AttributeEnd",       "TransformBegin", "TransformEnd",
                                        "ObjectEnd",      "ReverseOrientation", "Identity"};
    put(w, "%s\n", KINDS[choose(w, sizeof KINDS / sizeof KINDS[0])]);
}

/* Once more what stands behind `from`, many times. */
static void repeat(struct writer *w, size_t from)
{
    size_t n = w->used - from, times = choose(w, 4) == 0 ? MOST_REPEATED : 1 + choose(w, 64);
    for (; times > 0 && w->used + n < MOST_TEXT; times--) {
        w->text = mem_grow(w->text, &w->capacity, w->used + n + 1, 1);
        memcpy(w->text + w->used, w->text + from, n);
        w->used += n;
    }
    w->text[w->used] = '\0';
}

char *hostile_scene(const uint8_t *bytes, size_t n, size_t *length)
{
    struct writer w = {.bytes = bytes, .n = n};
    for (unsigned i = choose(&w, 4); i > 0; i--)
        directive(&w, OPTION_DIRECTIVES);
    if (choose(&w, 2))
        method(&w);
    put(&w, "WorldBegin\nMakeNamedMaterial \"m1\" \"string type\" \"matte\"\nTranslate 0 0 3\n");
    while (w.at < w.n) {
        size_t from = w.used;
        unsigned kind = choose(&w, 16);
        if (kind < 10)
            thing(&w, kind);
        else if (kind < 12)
            directive(&w, LIGHT_DIRECTIVES);
        else if (kind < 13)
            medium(&w);
        else if (kind < 15)
            transform(&w);
        else
            block(&w);
        if (rarely(&w, 128))
            repeat(&w, from);
    }
    put(&w, "WorldEnd\n");
    *length = w.used;
    return w.text;
}
