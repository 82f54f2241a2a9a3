/* hostile.c: see hostile.h. */
#include "hostile.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"

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

/* Parameters are "type name" with bars between, ! before those without which the object would be refused. Behind the
 * name may stand, after *, how many numbers it wants, and after a colon what it may be, the first mostly. */
struct object {
    const char *directive, *type, *parameters;
};

#define REFLECT "rgb Kd|texture Kd|rgb Ks|rgb Kr|rgb Kt|texture Ks|float sigma|texture sigma|"
#define ROUGH "float roughness|float uroughness|float vroughness|texture roughness|bool remaproughness:true,false|"
#define BUMP "texture bumpmap|"
#define GLASS "float index|float eta|rgb opacity|"
#define LIT "rgb L|rgb scale|blackbody L|spectrum L|integer samples|"
#define MAP "string mapname:parts/map.pfm,parts/grey.tga,parts/bad.pfm,missing.exr"
#define CUT "float phimax|float zmin|float zmax|float radius|"
#define MAPPED "string mapping:uv,planar,spherical,cylindrical|vector v1|vector v2|float udelta|float vdelta|" \
               "float uscale|float vscale|"
#define PAIR "float tex1|float tex2|texture tex1|texture tex2|rgb tex1|rgb tex2|float amount|texture amount|"
#define PICTURE \
    "!string filename:parts/grey.tga,parts/map.pfm,missing.png,.|string wrap:repeat,black,clamp|float scale|"

static const struct object OPTIONS[] = {
    {"Camera", "perspective",
     "float fov|float lensradius|float focaldistance|float frameaspectratio|"
     "float screenwindow:-1 1 -1 1,0 1e-30 0 1,1 0 0 1,-1e30 1e30 0 1"},
    {"Film", "image",
     "integer xresolution|integer yresolution|float scale|"
     "float cropwindow:0 1 0 1,0.4 0.6 0 1,0.9 0.1 0 1,0 1e-30 0 1|string filename:x.png,/"},
    {"PixelFilter", "box", "float xwidth|float ywidth"},
    {"PixelFilter", "gaussian", "float xwidth|float ywidth|float alpha"},
    {"PixelFilter", "mitchell", "float xwidth|float ywidth|float B|float C"},
    {"PixelFilter", "sinc", "float xwidth|float ywidth|float tau"},
    {"PixelFilter", "triangle", "float xwidth|float ywidth"},
    {"Sampler", "halton", "integer pixelsamples"},
    {"Integrator", "asbdpt", "integer maxdepth|float delta|integer connections|float rr_threshold|float rrthreshold|"
                             "string select:bins,pool,vertices,subspaces|integer binpaths|integer restart"},
    {"Integrator", "bdpt", "integer maxdepth|float rrthreshold|string lightsamplestrategy:power,spatial,uniform"}};

static const struct object WORLD[] = {
    {"Shape", "sphere", CUT "float alpha"},
    {"Shape", "disk", "float height|float radius|float innerradius|float phimax"},
    {"Shape", "cylinder", CUT},
    {"Shape", "cone", "float radius|float height|float phimax"},
    {"Shape", "paraboloid", CUT},
    {"Shape", "hyperboloid", "point p1|point p2|float phimax"},
    {"Shape", "trianglemesh", "!integer indices*3|!point P*9|normal N*9|float uv*6|float alpha|texture shadowalpha"},
    {"Shape", "trianglemesh", "!integer indices*6|!point P*12|float uv*8|texture alpha"},
    {"Shape", "loopsubdiv", "integer levels|!integer indices*6|!point P*12"},
    {"Shape", "heightfield", "!integer nu:2,1|!integer nv:2|!float Pz*4"},
    {"Shape", "curve", "!point P*12|normal N*6|float width0|integer degree|string type:flat,ribbon,cylinder|"
                       "string basis:bspline"},
    {"Shape", "nurbs", "!integer nu:2|!integer nv:2|!integer uorder:2|!integer vorder:2,1|"
                       "!float uknots:0 0 1 1,0 1 2 3,0 1e-30 1e30 1e30|!float vknots:0 0 1 1,0 1e-30 1e30 1e30|"
                       "!float Pw*16|float u0|float v1"},
    {"Shape", "plymesh", "!string filename:parts/triangle.ply,parts/broken.ply|texture alpha"},
    {"Material", "matte", REFLECT BUMP},
    {"Material", "mirror", "rgb Kr|" BUMP},
    {"Material", "glass", "rgb Kr|rgb Kt|" ROUGH GLASS BUMP},
    {"Material", "metal", "rgb eta|rgb k|" ROUGH BUMP},
    {"Material", "plastic", REFLECT ROUGH},
    {"Material", "substrate", REFLECT ROUGH},
    {"Material", "uber", REFLECT ROUGH GLASS},
    {"Material", "translucent", REFLECT ROUGH "rgb reflect|rgb transmit"},
    {"Material", "subsurface", "rgb Kr|rgb Kt|" ROUGH "float eta|" BUMP},
    {"Material", "disney", "rgb color|float roughness|float eta|float metallic|float speculartint|float anisotropic|"
                           "float sheen|float sheentint|float clearcoat|float clearcoatgloss|float spectrans|"
                           "rgb scatterdistance|bool thin:true,false|float flatness|float difftrans|" BUMP},
    {"Material", "fourier", "!string bsdffile:../../scenes/features/layered.bsdf,parts/broken.ply|" BUMP},
    {"Material", "none", ""},
    {"Material", "", ""},
    {"AreaLightSource", "diffuse", LIT "bool twosided:true,false"},
    {"LightSource", "point", LIT "rgb I|point from"},
    {"LightSource", "spot", LIT "rgb I|point from|point to|float coneangle|float conedeltaangle"},
    {"LightSource", "distant", LIT "point from|point to"},
    {"LightSource", "infinite", LIT MAP},
    {"LightSource", "goniometric", LIT "rgb I|" MAP},
    {"LightSource", "projection", LIT "rgb I|float fov|" MAP},
    {"NamedMaterial", "m0", NULL},
    {"NamedMaterial", "m1", NULL},
    {"ObjectBegin", "o0", NULL},
    {"ObjectInstance", "o0", NULL},
    {"CoordinateSystem", "c0", NULL},
    {"CoordSysTransform", "c0", NULL},
    {"Include", "parts/box.pbrt", NULL}};

static const struct object NAMED[] = {
    {"MakeNamedMaterial \"m0\" \"string type\"", "mix",
     "!string namedmaterial1:m1,m0|!string namedmaterial2:m1,m0|float amount|rgb amount"},
    {"MakeNamedMaterial \"m1\" \"string type\"", "matte", REFLECT BUMP},
    {"MakeNamedMaterial \"m1\" \"string type\"", "mix",
     "!string namedmaterial1:m1,m0|!string namedmaterial2:m1,m0|texture amount"},
    {"Texture \"t0\" \"spectrum\"", "scale", PAIR},
    {"Texture \"t0\" \"float\"", "mix", PAIR},
    {"Texture \"t1\" \"spectrum\"", "checkerboard", PAIR MAPPED "integer dimension|string aamode:none"},
    {"Texture \"t1\" \"float\"", "imagemap", PICTURE MAPPED "bool gamma:true"},
    {"Texture \"t0\" \"spectrum\"", "imagemap", PICTURE MAPPED},
    {"Texture \"t1\" \"spectrum\"", "bilerp", "float v00|rgb v01|float v10|rgb v11|" MAPPED},
    {"Texture \"t0\" \"float\"", "fbm", "integer octaves|float roughness"},
    {"Texture \"t1\" \"float\"", "wrinkled", "integer octaves|float roughness"},
    {"Texture \"t0\" \"spectrum\"", "marble", "integer octaves|float roughness|float scale|float variation"},
    {"Texture \"t1\" \"spectrum\"", "dots", "texture inside|texture outside|rgb inside|" MAPPED},
    {"Texture \"t0\" \"float\"", "windy", ""},
    {"Texture \"t1\" \"spectrum\"", "uv", MAPPED}};

enum { N_OPTIONS = sizeof OPTIONS / sizeof OPTIONS[0], N_WORLD = sizeof WORLD / sizeof WORLD[0],
       N_NAMED = sizeof NAMED / sizeof NAMED[0] };

/* One of the values behind the colon. */
static void word(struct writer *w, const char *values, size_t n, bool quoted)
{
    const char *at = values, *end = values + n;
    for (unsigned k = rarely(w, 4) ? choose(w, 4) : 0; k > 0; k--) {
        const char *comma = memchr(at, ',', (size_t)(end - at));
        at = comma != NULL ? comma + 1 : values;
    }
    const char *comma = memchr(at, ',', (size_t)(end - at));
    put(w, quoted ? "\"%.*s\" " : "%.*s ", (int)((comma != NULL ? comma : end) - at), at);
}

/* How many numbers a parameter wants. */
static unsigned count(const char *p, const char *star)
{
    bool three = strncmp(p, "rgb", 3) == 0 || strncmp(p, "point", 5) == 0 || strncmp(p, "vector", 6) == 0;
    bool two = strncmp(p, "blackbody", 9) == 0 || strncmp(p, "spectrum", 8) == 0;
    return star != NULL ? (unsigned)strtoul(star + 1, NULL, 10) : three ? 3 : two ? 2 : 1;
}

static void parameter(struct writer *w, const char *p, size_t n)
{
    static const int QUAD[6] = {0, 1, 2, 0, 2, 3};
    const char *colon = memchr(p, ':', n), *star = memchr(p, '*', n);
    size_t name = star != NULL ? (size_t)(star - p) : colon != NULL ? (size_t)(colon - p) : n;
    put(w, "\"%.*s\" [ ", (int)name, p);
    unsigned wanted = count(p, star);
    if (rarely(w, 64))
        wanted = choose(w, 3);
    if (strncmp(p, "texture", 7) == 0)
        put(w, "\"t%u\" ", choose(w, 3));
    else if (colon != NULL)
        word(w, colon + 1, n - name - 1, strncmp(p, "string", 6) == 0 || strncmp(p, "bool", 4) == 0);
    else if (strncmp(p, "integer indices", 15) == 0)
        for (unsigned i = 0; i < wanted; i++)
            put(w, "%d ", rarely(w, 32) ? (int)choose(w, 5) - 1 : QUAD[i % 6]);
    else
        numbers(w, wanted);
    put(w, "] ");
}

static void object(struct writer *w, const struct object *o)
{
    put(w, "%s \"%s\" ", o->directive, o->type);
    for (const char *p = o->parameters; p != NULL && *p != '\0';) {
        size_t n = strcspn(p, "|");
        bool needed = *p == '!';
        if (needed || choose(w, 3) == 1)
            parameter(w, p + needed, n - needed);
        p += n + (p[n] == '|');
    }
    put(w, "\n");
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
        object(&w, &OPTIONS[choose(&w, N_OPTIONS)]);
    put(&w, "WorldBegin\nMakeNamedMaterial \"m1\" \"string type\" \"matte\"\nTranslate 0 0 3\n");
    while (w.at < w.n) {
        size_t from = w.used;
        unsigned kind = choose(&w, 16);
        if (kind < 9)
            object(&w, &WORLD[choose(&w, N_WORLD)]);
        else if (kind < 12)
            object(&w, &NAMED[choose(&w, N_NAMED)]);
        else if (kind < 14)
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
