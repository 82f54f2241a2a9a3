/* random_parts.c: see random_parts.h. */
#include "random_parts.h"

#include "base/maths.h"

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
        put_point(w, "vector", "v1", mul(direction(w), 2));
        put_point(w, "vector", "v2", direction(w));
    }
}

/* A colour of up to `most`, or a texture. */
static void colour(struct writer *w, const char *name, double most)
{
    if (w->textures > 0 && chance(w, 0.3))
        put(w, "\"texture %s\" \"s%d\" ", name, pick(w, w->textures));
    else
        put_point(w, "rgb", name, within(w, vec(0, 0, 0), vec(most, most, most)));
}

static void number(struct writer *w, const char *name)
{
    if (w->textures > 0 && chance(w, 0.3))
        put(w, "\"texture %s\" \"f%d\" ", name, pick(w, w->textures));
    else
        put_float(w, name, between(w, 0, 0.9));
}

/* Two values of a texture's kind. */
static void values(struct writer *w, bool colours, const char *a, const char *b)
{
    for (int i = 0; i < 2; i++)
        if (colours)
            colour(w, i == 0 ? a : b, 0.9);
        else
            number(w, i == 0 ? a : b);
}

/* A value that is no texture. */
static void corner(struct writer *w, bool colours, const char *name)
{
    if (colours)
        put_point(w, "rgb", name, within(w, vec(0, 0, 0), vec(0.9, 0.9, 0.9)));
    else
        put_float(w, name, between(w, 0, 0.9));
}

static void noise(struct writer *w)
{
    static const char *const KINDS[] = {"fbm", "wrinkled", "windy"};
    int kind = pick(w, 3);
    put(w, "\"%s\" ", KINDS[kind]);
    if (kind < 2)
        put(w, "\"integer octaves\" %d ", 1 + pick(w, 4));
}

static void texture(struct writer *w, bool colours)
{
    static const char *const CORNERS[] = {"v00", "v01", "v10", "v11"};
    put(w, "Texture \"%c%d\" \"%s\" ", colours ? 's' : 'f', w->textures, colours ? "spectrum" : "float");
    switch (pick(w, colours ? 11 : 9)) {
    case 0:
        put(w, "\"imagemap\" \"string filename\" \"%sscenes/test/%s.tga\" ", w->top, colours ? "colours" : "waves");
        mapping(w);
        break;
    case 1:
    case 2:
        put(w, "\"checkerboard\" ");
        values(w, colours, "tex1", "tex2");
        if (chance(w, 0.3))
            put(w, "\"integer dimension\" 3 ");
        else
            mapping(w);
        break;
    case 3:
        put(w, "\"mix\" ");
        values(w, colours, "tex1", "tex2");
        number(w, "amount");
        break;
    case 4:
        put(w, "\"dots\" ");
        values(w, colours, "inside", "outside");
        mapping(w);
        break;
    case 5: noise(w); break;
    case 6:
        put(w, "\"scale\" ");
        values(w, colours, "tex1", "tex2");
        break;
    case 7:
        put(w, "\"constant\" ");
        corner(w, colours, "value");
        break;
    case 8:
        put(w, "\"bilerp\" ");
        for (int i = 0; i < 4; i++)
            corner(w, colours, CORNERS[i]);
        mapping(w);
        break;
    case 9:
        put(w, "\"uv\" ");
        mapping(w);
        break;
    case 10: put(w, "\"marble\" \"integer octaves\" 3 "); break;
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

static void roughness(struct writer *w)
{
    bool remap = chance(w, 0.7);
    put(w, "\"bool remaproughness\" \"%s\" ", remap ? "true" : "false");
    put_float(w, "uroughness", remap ? between(w, 0.15, 0.6) : between(w, 0.3, 0.8));
    put_float(w, "vroughness", remap ? between(w, 0.15, 0.6) : between(w, 0.3, 0.8));
}

/* Broad lobes, which every method can make. Without roughness along both axes there is one of all, or none. */
static void rough(struct writer *w)
{
    static const struct {
        const char *name;
        double Kd, Ks, least_eta;
        bool axes;
    } KINDS[] = {{"matte", 0.9, 0, 0, false},       {"matte", 0.9, 0, 0, false},      {"metal", 0, 0, 0, true},
                 {"plastic", 0.6, 0.4, 0, false},   {"translucent", 0.6, 0.4, 0, false},
                 {"substrate", 0.6, 0.4, 0, true},  {"uber", 0.6, 0.4, 0, true},      {"glass", 0, 0, 1.1, true}};
    int kind = pick(w, sizeof KINDS / sizeof KINDS[0]);
    put(w, "\"%s\" ", KINDS[kind].name);
    if (KINDS[kind].Kd > 0)
        colour(w, "Kd", KINDS[kind].Kd);
    if (KINDS[kind].Ks > 0)
        colour(w, "Ks", KINDS[kind].Ks);
    if (KINDS[kind].least_eta > 0)
        put_float(w, "eta", between(w, KINDS[kind].least_eta, 2));
    if (KINDS[kind].axes)
        roughness(w);
    else if (KINDS[kind].Ks > 0)
        put_float(w, "roughness", between(w, 0.15, 0.6));
    else
        put_float(w, "sigma", chance(w, 0.3) ? between(w, 0, 60) : 0);
    if (w->textures > 0 && chance(w, 0.1))
        put(w, "\"texture bumpmap\" \"f%d\" ", pick(w, w->textures));
}

static void disney(struct writer *w)
{
    put(w, "\"disney\" ");
    colour(w, "color", 0.9);
    put_float(w, "roughness", between(w, 0.5, 0.9));
    number(w, "metallic");
    number(w, "sheen");
    put_float(w, "anisotropic", between(w, 0, 0.6));
    put_float(w, "clearcoat", chance(w, 0.5) ? between(w, 0, 1) : 0);
    put_float(w, "clearcoatgloss", between(w, 0, 0.4));
    put_float(w, "spectrans", chance(w, 0.5) ? between(w, 0, 0.8) : 0);
    if (chance(w, 0.4))
        put(w, "\"bool thin\" \"true\" \"float flatness\" .4 ");
}

/* Layers of a file, and surfaces of what is translucent. */
static void of_layers(struct writer *w, int kind)
{
    if (kind == 0) {
        w->rare = true;
        put(w, "\"fourier\" \"string bsdffile\" \"%sscenes/features/layered.bsdf\" ", w->top);
        return;
    }
    put(w, "\"%s\" ", kind == 1 ? "subsurface" : "kdsubsurface");
    put_float(w, "eta", between(w, 1.1, 1.6));
    roughness(w);
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
    int kind = pick(w, 10);
    if (kind < 2)
        specular(w, pick(w, 4));
    else if (kind == 2)
        disney(w);
    else if (kind == 3)
        of_layers(w, pick(w, 3));
    else
        rough(w);
}

void put_material(struct writer *w, bool lamp)
{
    if (chance(w, 0.1)) { /* of parts that have names of their own */
        for (int i = 0; i < 2; i++) {
            put(w, "MakeNamedMaterial \"m%d\" \"string type\" ", i);
            one_material(w);
            put(w, "\n");
        }
        if (chance(w, 0.3)) {
            put(w, "NamedMaterial \"m1\"\n");
            return;
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

/* --- media ---------------------------------------------------------------------------------------------- */

/* Some light gets through a unit of it, and of the thicker one through a half. */
static void medium(struct writer *w, const char *name, double least, double most, double unit)
{
    double s = across(w, least, most) / unit, a = chance(w, 0.3) ? 0 : s * between(w, 0, 1);
    put(w, "MakeNamedMedium \"%s\" \"string type\" \"homogeneous\" ", name);
    put_point(w, "rgb", "sigma_s", mul(within(w, vec(1, 0.3, 0.3), vec(1, 1, 1)), s));
    put_rgb(w, "sigma_a", a, a * between(w, 0, 1), a);
    if (chance(w, 0.7))
        put_float(w, "g", between(w, -0.5, 0.7));
    put(w, "\n");
}

void put_media(struct writer *w, double unit)
{
    medium(w, "fog", 0.02, 0.15, unit);
    medium(w, "milk", 0.3, 2, unit);
    w->around = chance(w, 0.6) ? "fog" : "";
    w->boxes = chance(w, 0.5);
    put(w, "MediumInterface \"%s\"\n", w->around);
}

void put_bound(struct writer *w)
{
    if (chance(w, 0.4))
        return;
    put(w, "AttributeBegin Material \"\" MediumInterface \"%s\" \"\" ", w->around);
    put(w, "Shape \"sphere\" \"float radius\" 9 AttributeEnd\n");
}

void put_boxes(struct writer *w)
{
    double top = between(w, -1.4, -1.15);
    for (int i = pick(w, 2); i < 2; i++) {
        put(w, "AttributeBegin Material \"none\" MediumInterface \"%s\" \"%s\" Shape \"trianglemesh\" "
               "\"integer indices\"\n  [ 0 3 1 0 2 3 4 5 7 4 7 6 0 1 5 0 5 4 2 7 3 2 6 7 0 6 2 0 4 6 1 3 7 1 7 5 ] "
               "\"point P\" [ ", i == 0 ? "fog" : "milk", w->around);
        for (int k = 0; k < 8; k++)
            put_vec(w, vec(k % 2 != i ? 0.1 : i == 0 ? -0.4 : 0.5, k / 2 % 2 == 0 ? -0.5 : 0.4, k < 4 ? -1.6 : top));
        put(w, "] AttributeEnd\n");
    }
}

/* What comes next shines. */
static void shine(struct writer *w)
{
    double strength = across(w, 2, 8);
    put(w, "AreaLightSource \"diffuse\" ");
    put_point(w, "rgb", "L", mul(within(w, vec(0.3, 0.3, 1), vec(1, 1, 1)), strength));
    put(w, "\"bool twosided\" \"%s\"\n", chance(w, 0.6) ? "true" : "false");
}

void put_milk(struct writer *w)
{
    vec3 way = direction(w);
    put(w, "AttributeBegin Translate ");
    put_vec(w, mul(way, between(w, 0, 0.2)));
    if (chance(w, 0.4)) {
        put(w, "Material \"none\" ");
        if (chance(w, 0.4))
            shine(w);
    } else if (chance(w, 0.3)) {
        put(w, "Material ");
        specular(w, 1);
    } else {
        put_material(w, false);
    }
    bool turned = chance(w, 0.3);
    put(w, "MediumInterface \"%s\" \"%s\" ", turned ? w->around : "milk", turned ? "milk" : w->around);
    put(w, "%sShape \"sphere\" ", turned ? "ReverseOrientation " : "");
    put_float(w, "radius", between(w, 0.4, 0.75));
    put(w, "AttributeEnd\n");
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
    put(w, "\"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] ");
    put_list(w, "point", "P", 12, corners);
    if (chance(w, 0.5))
        put(w, "\"float uv\" [ 0 0 1 0 1 1 0 1 ] ");
    if (chance(w, 0.3)) {
        put(w, "\"normal N\" [ ");
        for (int i = 0; i < 4; i++) {
            vec3 n = within(w, vec(-0.3, -0.3, 1), vec(0.3, 0.3, 1));
            put_vec(w, mul(n, across(w, 0.5, 2)));
        }
        put(w, "] ");
    }
}

/* A curve of four points through the origin. */
static void curve(struct writer *w)
{
    put(w, "\"curve\" \"string type\" \"%s\" \"point P\" [ ", chance(w, 0.5) ? "cylinder" : "ribbon");
    for (int i = 0; i < 4; i++)
        put_vec(w, add(vec(0, 0, (2 * i - 3) / 3.0), mul(direction(w), 0.4)));
    put(w, "] ");
    put_float(w, "width0", between(w, 0.2, 0.6));
    put_float(w, "width1", between(w, 0.2, 0.6));
    put(w, "\"normal N\" [ 1 0 0 0 1 0 ] ");
}

/* To another place and back. */
static void detour(struct writer *w)
{
    if (!chance(w, 0.3))
        return;
    put(w, "CoordinateSystem \"here\" %s CoordSysTransform \"here\" ",
        chance(w, 0.5) ? "Rotate 40 1 2 3" : "Transform [ 0 1 0 0 0 0 1 0 1 0 0 0 3 2 1 1 ]");
}

/* Those that may be lamps come first. */
void put_shape(struct writer *w, bool lamp)
{
    detour(w);
    if (chance(w, 0.3))
        put(w, "ReverseOrientation ");
    put(w, "Shape ");
    switch (pick(w, lamp ? 5 : 11)) {
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
    case 4:
    case 5: quad(w); break;
    case 6:
        put(w, "\"%s\" ", chance(w, 0.5) ? "cone" : "paraboloid");
        part_of_quadric(w);
        break;
    case 7:
        put(w, "\"hyperboloid\" ");
        put_point(w, "point", "p1", within(w, vec(0.3, -0.3, -0.8), vec(1, 0.3, -0.8)));
        put_point(w, "point", "p2", within(w, vec(0.3, 0, 0.8), vec(1, 0.5, 0.8)));
        part_of_quadric(w);
        break;
    case 8:
        put(w, "\"loopsubdiv\" \"integer levels\" %d ", pick(w, 3));
        put(w, "\"integer indices\" [ 0 2 1 0 3 2 0 1 3 1 2 3 ] \"point P\" [ ");
        for (int i = 0; i < 4; i++)
            put_vec(w, i == 0 ? vec(0, 0, 1.2) : cylindrical(1.2, i * 2 * PI / 3, -0.6));
        put(w, "] ");
        break;
    case 9: put(w, "\"plymesh\" \"string filename\" \"%stest/data/fixtures/parts/triangle.ply\" ", w->top); break;
    case 10: curve(w); break;
    }
    if (w->textures > 0 && chance(w, 0.15))
        put(w, "\"texture alpha\" \"f%d\" ", pick(w, w->textures));
    put(w, "\n");
}

/* --- lights --------------------------------------------------------------------------------------------- */

void put_area_light(struct writer *w)
{
    shine(w);
    put_material(w, true);
    put_shape(w, true);
}

static void delta_light(struct writer *w, double unit)
{
    static const char *const KINDS[] = {"point", "spot", "goniometric", "projection"};
    int kind = pick(w, sizeof KINDS / sizeof KINDS[0]);
    bool spot = kind == 1;
    double strength = across(w, 10, 30) * unit * unit;
    w->delta_light = true;
    put(w, "LightSource \"%s\" ", KINDS[kind]);
    if (kind >= 2 && chance(w, 0.8))
        put(w, "\"string mapname\" \"%s%s\" ", w->top, "scenes/test/colours.tga");
    if (kind == 3)
        put_float(w, "fov", between(w, 20, 120));
    put_point(w, "rgb", "I", mul(within(w, vec(1, 0.3, 0.3), vec(1, 1, 1)), strength));
    if (spot) {
        put_float(w, "coneangle", between(w, 2, 80));
        if (chance(w, 0.7))
            put_float(w, "conedeltaangle", between(w, 1, 40));
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
        put_point(w, "point", "from", direction(w));
        put(w, "\n");
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
    vec3 way = direction(w), at = mul(way, between(w, 2, 2.6) + (w->boxes ? 1.2 : 0));
    struct map m = map_then(map_uneven(w), map_frame(neg(way)));
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
