/* parse_foreign.c: names that only pbrt-v4 has [pbrt-v4 parameters.cpp, cameras, film, lights, materials, shapes], and
 * what is written here in their place. See parse.h. */
#include "parser/parse.h"

#include <stdio.h>
#include <string.h>

/* A name of pbrt-v4. */
struct row {
    const char *directive, *name; /* what it belongs to; NULL: it is a directive itself */
    const char *here;             /* the type or parameter in its place; NULL: nothing does the same */
    const char *note;             /* what else is to be done, or NULL */
};

static const struct row DIRECTIVES[] = {
    {NULL, "Attribute", NULL, "write the parameters in each directive"},
    {NULL, "ColorSpace", NULL, "leave it out, colours have the primaries of sRGB"},
    {NULL, "Option", NULL, "leave it out, options are words of the command line"}, {.name = NULL}};

static const struct row TYPES[] = {
    {"Camera", "spherical", "environment", NULL},
    {"Film", "gbuffer", "image", ", and asbdpt-lab render --aov writes the other images"},
    {"Film", "rgb", "image", NULL},
    {"Film", "spectral", "image", NULL},
    {"Material", "coatedconductor", NULL, NULL},
    {"Material", "coateddiffuse", "plastic", ", nearly, with \"Kd\" for \"reflectance\""},
    {"Material", "conductor", "metal", ", or \"mirror\" with \"Kr\" for \"reflectance\""},
    {"Material", "dielectric", "glass", ", with \"uroughness\" and \"vroughness\" for \"roughness\""},
    {"Material", "diffuse", "matte", ", with \"Kd\" for \"reflectance\""},
    {"Material", "diffusetransmission", "translucent", ", with \"reflect\" and \"transmit\" and a \"Ks\" of 0"},
    {"Material", "interface", "none", NULL},
    {"Material", "measured", NULL, NULL},
    {"Material", "thindielectric", NULL, NULL},
    {"Sampler", "independent", "random", NULL},
    {"Sampler", "paddedsobol", "sobol", NULL},
    {"Sampler", "pmj02bn", "sobol", NULL},
    {"Sampler", "zsobol", "sobol", NULL},
    {"Shape", "bilinearmesh", "trianglemesh", ", with two triangles for a patch"},
    {"Texture", "directionmix", NULL, NULL}, {.name = NULL}};

/* Of rows of the same name the first counts whose parameter the type in question has. */
static const struct row PARAMETERS[] = {
    {"AreaLightSource", "filename", NULL, NULL},
    {"AreaLightSource", "power", "L", ": the power / (pi area), and half of that with two sides"},
    {"Film", "iso", "scale", ": iso / 100 times the exposure time"},
    {"LightSource", "filename", "mapname", NULL},
    {"LightSource", "illuminance", "L", ": the illuminance, of an \"infinite\" light that / pi"},
    {"LightSource", "portal", NULL, NULL},
    {"LightSource", "power", "I", ": of a \"point\" light the power / (4 pi)"},
    {"Material", "displacement", "bumpmap", NULL},
    {"Material", "materials", "namedmaterial1", " and \"namedmaterial2\", and \"amount\" is the share of the first"},
    {"Material", "normalmap", NULL, NULL},
    {"Material", "reflectance", "Kd", NULL},
    {"Material", "reflectance", "Kr", NULL},
    {"Material", "roughness", "uroughness", " and \"vroughness\""},
    {"Material", "transmittance", "transmit", ", which multiplies \"Kd\""},
    {"PixelFilter", "sigma", "alpha", ": 1 / (2 sigma^2)"},
    {"PixelFilter", "xradius", "xwidth", NULL},
    {"PixelFilter", "yradius", "ywidth", NULL},
    {"Shape", "displacement", NULL, NULL},
    {"Texture", "encoding", "gamma", ": true for \"sRGB\", false for \"linear\""},
    {"Texture", "invert", NULL, NULL},
    {"Texture", "scale", "tex2", NULL},
    {"Texture", "tex", "tex1", NULL}, {.name = NULL}};

static bool fits(const struct row *row, const char *directive, const char *name, const struct field *fields)
{
    bool known = fields == NULL || row->here == NULL || field_find(fields, row->here) != NULL;
    return known && strcmp(row->name, name) == 0 &&
           (row->directive == NULL || strcmp(row->directive, directive) == 0);
}

/* What is said of a name that one of the rows has. */
static struct foreign say(const struct row *row, const char *directive, const char *name, const struct field *fields)
{
    struct foreign out = {""};
    while (row->name != NULL && !fits(row, directive, name, fields))
        row++;
    const char *note = row->note != NULL ? row->note : row->here != NULL ? "" : "nothing here is like it";
    if (row->name != NULL && row->here != NULL)
        snprintf(out.text, sizeof out.text, ": it is pbrt-v4's; here that is \"%s\"%s", row->here, note);
    else if (row->name != NULL)
        snprintf(out.text, sizeof out.text, ": it is pbrt-v4's; %s", note);
    return out;
}

struct foreign parse_foreign_directive(const char *name) { return say(DIRECTIVES, "", name, NULL); }

struct foreign parse_foreign_type(const char *directive, const char *name) { return say(TYPES, directive, name, NULL); }

struct foreign parse_foreign_parameter(const char *directive, const char *name, const struct field *fields)
{
    return say(PARAMETERS, directive, name, fields);
}
