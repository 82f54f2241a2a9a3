/* random_parts.c: see random_parts.h. */
#include "random_parts.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/maths.h"
#include "base/mem.h"
#include "fuzz/hostile.h"

/* --- text and numbers ----------------------------------------------------------------------------------- */

void put(struct writer *w, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int n = vsnprintf(NULL, 0, format, args);
    va_end(args);
    size_t size = n > 0 ? (size_t)n : 0;
    w->text = mem_grow(w->text, &w->capacity, w->used + size + 1, 1);
    va_start(args, format);
    vsnprintf(w->text + w->used, size + 1, format, args);
    va_end(args);
    w->used += size;
}

void put_numbers(struct writer *w, int n, const double *x)
{
    for (int i = 0; i < n; i++)
        if (w->evil && chance(w, 0.02))
            put(w, "%s ", hostile_number(rng_u32(&w->rng)));
        else
            put(w, "%.9g ", x[i]);
}

void put_vec(struct writer *w, vec3 v)
{
    const double x[3] = {v.x, v.y, v.z};
    put_numbers(w, 3, x);
}

void put_float(struct writer *w, const char *name, double value)
{
    put(w, "\"float %s\" [ ", name);
    put_numbers(w, 1, &value);
    put(w, "] ");
}

void put_rgb(struct writer *w, const char *name, double r, double g, double b)
{
    put(w, "\"rgb %s\" [ ", name);
    put_vec(w, vec(r, g, b));
    put(w, "] ");
}

int pick(struct writer *w, int n) { return (int)rng_below(&w->rng, (uint32_t)n); }
bool chance(struct writer *w, double probability) { return rng_uniform(&w->rng) < probability; }
double between(struct writer *w, double low, double high) { return low + (high - low) * rng_uniform(&w->rng); }
double across(struct writer *w, double low, double high) { return low * pow(high / low, rng_uniform(&w->rng)); }

vec3 direction(struct writer *w)
{
    double z = between(w, -1, 1), phi = between(w, 0, 2 * PI), r = sqrt(1 - z * z);
    return vec(r * cos(phi), r * sin(phi), z);
}

/* --- linear maps ---------------------------------------------------------------------------------------- */

struct map map_identity(void)
{
    struct map m = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    return m;
}

vec3 map_apply(const struct map *m, vec3 v) { return add(add(mul(m->x, v.x), mul(m->y, v.y)), mul(m->z, v.z)); }

static double determinant(const struct map *m) { return dot(cross(m->x, m->y), m->z); }

vec3 map_back(const struct map *m, vec3 v)
{
    vec3 at = vec(dot(cross(m->y, m->z), v), dot(cross(m->z, m->x), v), dot(cross(m->x, m->y), v));
    return mul(at, 1 / determinant(m));
}

vec3 map_normal(const struct map *m, vec3 n)
{
    vec3 sum = add(add(mul(cross(m->y, m->z), n.x), mul(cross(m->z, m->x), n.y)), mul(cross(m->x, m->y), n.z));
    return mul(sum, 1 / determinant(m));
}

struct map map_then(struct map first, struct map second)
{
    struct map m = {map_apply(&second, first.x), map_apply(&second, first.y), map_apply(&second, first.z)};
    return m;
}

struct map map_scaled(struct map m, double factor)
{
    struct map scaled = {mul(m.x, factor), mul(m.y, factor), mul(m.z, factor)};
    return scaled;
}

struct map map_frame(vec3 z)
{
    vec3 x = normalize(cross(fabs(z.y) < 0.9 ? vec(0, 1, 0) : vec(1, 0, 0), z));
    struct map m = {x, cross(z, x), z};
    return m;
}

struct map map_uneven(struct writer *w)
{
    double mirror = chance(w, 0.25) ? -1 : 1;
    struct map m = {vec(mirror * across(w, 0.5, 1.7), 0, 0), vec(0, across(w, 0.5, 1.7), 0),
                    vec(0, 0, across(w, 0.5, 1.7))};
    if (chance(w, 0.5))
        m.y.x = between(w, -0.6, 0.6);
    if (chance(w, 0.5))
        m.y.z = between(w, -0.3, 0.3);
    return chance(w, 0.15) ? map_identity() : m;
}

struct map map_random(struct writer *w) { return map_then(map_uneven(w), map_frame(direction(w))); }

void put_map(struct writer *w, const struct map *m)
{
    const double all[16] = {m->x.x, m->x.y, m->x.z, 0, m->y.x, m->y.y, m->y.z, 0,
                            m->z.x, m->z.y, m->z.z, 0, 0,      0,      0,      1};
    put(w, "ConcatTransform [ ");
    put_numbers(w, 16, all);
    put(w, "]\n");
}

/* --- textures ------------------------------------------------------------------------------------------- */

static void mapping(struct writer *w)
{
    static const char *const KINDS[] = {"uv", "planar", "spherical", "cylindrical"};
    int kind = pick(w, 4);
    put(w, "\"string mapping\" \"%s\" ", KINDS[kind]);
    if (kind == 0) {
        put_float(w, "uscale", between(w, 0.5, 4));
        put_float(w, "vscale", between(w, -4, 4));
        put_float(w, "udelta", between(w, -1, 1));
    } else if (kind == 1) {
        put(w, "\"vector v1\" [ ");
        put_vec(w, mul(direction(w), 2));
        put(w, "] \"vector v2\" [ ");
        put_vec(w, direction(w));
        put(w, "] ");
    }
}

/* A value of a texture's kind: a float of up to 0.9, or a colour. */
static void value(struct writer *w, bool colour, const char *name)
{
    if (w->textures > 0 && chance(w, 0.3))
        put(w, "\"texture %s\" \"%c%d\" ", name, colour ? 's' : 'f', pick(w, w->textures));
    else if (colour)
        put_rgb(w, name, between(w, 0, 0.9), between(w, 0, 0.9), between(w, 0, 0.9));
    else
        put_float(w, name, between(w, 0, 0.9));
}

static void texture(struct writer *w, bool colour)
{
    put(w, "Texture \"%c%d\" \"%s\" ", colour ? 's' : 'f', w->textures, colour ? "spectrum" : "float");
    switch (pick(w, colour ? 9 : 7)) {
    case 0:
        put(w, "\"imagemap\" \"string filename\" \"%sscenes/test/%s.tga\" ", w->top, colour ? "colours" : "waves");
        mapping(w);
        break;
    case 1:
    case 2:
        put(w, "\"checkerboard\" ");
        value(w, colour, "tex1");
        value(w, colour, "tex2");
        if (chance(w, 0.3))
            put(w, "\"integer dimension\" 3 ");
        else
            mapping(w);
        break;
    case 3:
        put(w, "\"mix\" ");
        value(w, colour, "tex1");
        value(w, colour, "tex2");
        value(w, false, "amount");
        break;
    case 4:
        put(w, "\"dots\" ");
        value(w, colour, "inside");
        value(w, colour, "outside");
        mapping(w);
        break;
    case 5:
        put(w, "\"%s\" \"integer octaves\" %d ", chance(w, 0.5) ? "fbm" : "wrinkled", 1 + pick(w, 4));
        break;
    case 6:
        put(w, "\"scale\" ");
        value(w, colour, "tex1");
        value(w, colour, "tex2");
        break;
    case 7:
        put(w, "\"uv\" ");
        mapping(w);
        break;
    case 8: put(w, "\"marble\" \"integer octaves\" 3 "); break;
    }
    put(w, "\n");
}

void put_textures(struct writer *w)
{
    for (int n = pick(w, 4); n > 0; n--) {
        struct map m = map_random(w);
        put(w, "TransformBegin ");
        put_map(w, &m);
        texture(w, true);
        texture(w, false);
        put(w, "TransformEnd\n");
        w->textures++;
    }
}

/* --- materials ------------------------------------------------------------------------------------------ */

static void colour(struct writer *w, const char *name, double most)
{
    if (w->textures > 0 && chance(w, 0.3))
        put(w, "\"texture %s\" \"s%d\" ", name, pick(w, w->textures));
    else
        put_rgb(w, name, between(w, 0, most), between(w, 0, most), between(w, 0, most));
}

static void roughness(struct writer *w)
{
    bool remap = chance(w, 0.7);
    put(w, "\"bool remaproughness\" \"%s\" ", remap ? "true" : "false");
    put_float(w, "uroughness", remap ? between(w, 0.15, 0.6) : between(w, 0.3, 0.8));
    put_float(w, "vroughness", remap ? between(w, 0.15, 0.6) : between(w, 0.3, 0.8));
}

/* Broad lobes, which every method can make. */
static void rough(struct writer *w, int kind)
{
    switch (kind) {
    case 0:
    case 1:
        put(w, "\"matte\" ");
        colour(w, "Kd", 0.9);
        put_float(w, "sigma", chance(w, 0.3) ? between(w, 0, 60) : 0);
        break;
    case 2:
        put(w, "\"metal\" ");
        roughness(w);
        break;
    case 3:
    case 4:
        put(w, "\"%s\" ", kind == 3 ? "plastic" : "translucent");
        colour(w, "Kd", 0.6);
        colour(w, "Ks", 0.4);
        put_float(w, "roughness", between(w, 0.15, 0.6));
        break;
    case 5:
        put(w, "\"substrate\" ");
        colour(w, "Kd", 0.6);
        colour(w, "Ks", 0.4);
        roughness(w);
        break;
    case 6:
        put(w, "\"uber\" ");
        colour(w, "Kd", 0.6);
        colour(w, "Ks", 0.4);
        roughness(w);
        break;
    case 7:
        put(w, "\"glass\" ");
        put_float(w, "eta", between(w, 1.1, 2));
        roughness(w);
        break;
    }
    if (w->textures > 0 && chance(w, 0.1))
        put(w, "\"texture bumpmap\" \"f%d\" ", pick(w, w->textures));
}

static void specular(struct writer *w, int kind)
{
    w->specular = true;
    switch (kind) {
    case 0:
        put(w, "\"mirror\" ");
        colour(w, "Kr", 0.9);
        break;
    case 1:
    case 2:
        put(w, "\"glass\" ");
        colour(w, "Kr", 1);
        colour(w, "Kt", 1);
        put_float(w, "eta", between(w, 1.1, 2));
        break;
    case 3:
        put(w, "\"uber\" ");
        colour(w, "Kd", 0.6);
        colour(w, "Kr", 0.4);
        colour(w, "Kt", 0.4);
        colour(w, "opacity", 1);
        break;
    }
}

static void one_material(struct writer *w)
{
    if (chance(w, 0.2))
        specular(w, pick(w, 4));
    else
        rough(w, pick(w, 8));
}

void put_material(struct writer *w, bool lamp)
{
    if (chance(w, 0.1)) { /* of parts that have names of their own */
        for (int i = 0; i < 2; i++) {
            put(w, "MakeNamedMaterial \"m%d\" \"string type\" ", i);
            one_material(w);
            put(w, "\n");
        }
        put(w, "Material \"mix\" \"string namedmaterial1\" \"m0\" \"string namedmaterial2\" \"m1\" ");
        colour(w, "amount", 1);
    } else {
        put(w, "Material ");
        if (lamp && chance(w, 0.25))
            put(w, "\"none\" ");
        else
            one_material(w);
    }
    put(w, "\n");
}

/* --- shapes --------------------------------------------------------------------------------------------- */

static void part_of_quadric(struct writer *w)
{
    if (chance(w, 0.3))
        put_float(w, "phimax", between(w, 90, 330));
}

static void quad(struct writer *w)
{
    double h = between(w, -0.4, 0.4);
    const double corners[12] = {-1, -1, h, 1, -1, -h, 1, 1, h, -1, 1, -h};
    put(w, "\"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ ");
    put_numbers(w, 12, corners);
    put(w, "] ");
    if (chance(w, 0.5))
        put(w, "\"float uv\" [ 0 0 1 0 1 1 0 1 ] ");
    if (chance(w, 0.3)) {
        put(w, "\"normal N\" [ ");
        for (int i = 0; i < 4; i++)
            put_vec(w, mul(vec(between(w, -0.3, 0.3), between(w, -0.3, 0.3), 1), across(w, 0.5, 2)));
        put(w, "] ");
    }
}

static void holes(struct writer *w)
{
    if (w->textures > 0 && chance(w, 0.15))
        put(w, "\"texture alpha\" \"f%d\" ", pick(w, w->textures));
}

/* Those that may be lamps come first. */
void put_shape(struct writer *w, bool lamp)
{
    if (chance(w, 0.3))
        put(w, "ReverseOrientation ");
    put(w, "Shape ");
    switch (pick(w, lamp ? 5 : 10)) {
    case 0:
        put(w, "\"disk\" ");
        put_float(w, "height", between(w, -0.3, 0.3));
        put_float(w, "innerradius", chance(w, 0.3) ? 0.4 : 0);
        part_of_quadric(w);
        break;
    case 1:
        put(w, "\"sphere\" ");
        if (chance(w, 0.3))
            put_float(w, "zmin", between(w, -0.9, 0));
        if (chance(w, 0.3))
            put_float(w, "zmax", between(w, 0.1, 0.9));
        part_of_quadric(w);
        break;
    case 2:
        put(w, "\"cylinder\" ");
        part_of_quadric(w);
        break;
    case 3: put(w, "\"sphere\" "); break;
    case 4: quad(w); break;
    case 5: quad(w); break;
    case 6:
        put(w, "\"%s\" ", chance(w, 0.5) ? "cone" : "paraboloid");
        part_of_quadric(w);
        break;
    case 7:
        put(w, "\"hyperboloid\" \"point p1\" [ ");
        put_vec(w, vec(between(w, 0.3, 1), between(w, -0.3, 0.3), -0.8));
        put(w, "] \"point p2\" [ ");
        put_vec(w, vec(between(w, 0.3, 1), between(w, 0, 0.5), 0.8));
        put(w, "] ");
        part_of_quadric(w);
        break;
    case 8:
        put(w, "\"loopsubdiv\" \"integer levels\" %d ", pick(w, 3));
        put(w, "\"integer indices\" [ 0 2 1 0 3 2 0 1 3 1 2 3 ] \"point P\" [ ");
        for (int i = 0; i < 4; i++)
            put_vec(w, i == 0 ? vec(0, 0, 1.2) : cylindrical(1.2, i * 2 * PI / 3, -0.6));
        put(w, "] ");
        break;
    case 9:
        put(w, "\"heightfield\" \"integer nu\" 3 \"integer nv\" 3 \"float Pz\" [ ");
        for (int i = 0; i < 9; i++)
            put(w, "%.3f ", between(w, -0.3, 0.3));
        put(w, "] ");
        break;
    }
    holes(w);
    put(w, "\n");
}

/* --- lights --------------------------------------------------------------------------------------------- */

void put_area_light(struct writer *w)
{
    double strength = across(w, 2, 8);
    put(w, "AreaLightSource \"diffuse\" ");
    put_rgb(w, "L", strength * between(w, 0.3, 1), strength * between(w, 0.3, 1), strength);
    put(w, "\"bool twosided\" \"%s\"\n", chance(w, 0.6) ? "true" : "false");
    put_material(w, true);
    put_shape(w, true);
}

static void delta_light(struct writer *w, double unit)
{
    static const char *const KINDS[] = {"point", "spot", "goniometric", "projection"};
    int kind = pick(w, 4);
    double strength = across(w, 10, 30) * unit * unit;
    w->delta_light = true;
    put(w, "LightSource \"%s\" ", KINDS[kind]);
    put_rgb(w, "I", strength, strength * between(w, 0.3, 1), strength * between(w, 0.3, 1));
    if (kind == 1) {
        put_float(w, "coneangle", between(w, 2, 80));
        if (chance(w, 0.7))
            put_float(w, "conedeltaangle", between(w, 1, 40));
    } else if (kind >= 2) {
        put(w, "\"string mapname\" \"%sscenes/test/colours.tga\" ", w->top);
        if (kind == 3)
            put_float(w, "fov", between(w, 30, 100));
    }
    put(w, "\n");
}

static void light_at_infinity(struct writer *w)
{
    struct map m = map_random(w);
    put_map(w, &m);
    if (chance(w, 0.3)) {
        w->delta_light = true;
        put(w, "LightSource \"distant\" ");
        put_rgb(w, "L", 2, 1.5, 1);
        put(w, "\"point from\" [ ");
        put_vec(w, direction(w));
        put(w, "]\n");
    } else {
        put(w, "LightSource \"infinite\" ");
        put_rgb(w, "L", 0.5, between(w, 0.2, 0.5), 0.5);
        if (chance(w, 0.7))
            put(w, "\"string mapname\" \"%s%s\" ", w->top, "scenes/test/colours.tga");
        put(w, "\n");
    }
}

void put_light(struct writer *w, double unit)
{
    vec3 at = mul(direction(w), between(w, 2, 2.6));
    struct map inwards = map_frame(normalize(neg(at))), m = map_then(map_uneven(w), inwards);
    int kind = pick(w, 8);
    put(w, "AttributeBegin\n");
    if (kind < 2) {
        light_at_infinity(w);
    } else {
        put(w, "Translate ");
        put_vec(w, at);
        m = map_scaled(m, kind < 4 ? 1 : between(w, 0.3, 0.5));
        put_map(w, &m);
        if (kind < 4)
            delta_light(w, unit);
        else
            put_area_light(w);
    }
    put(w, "AttributeEnd\n");
}
