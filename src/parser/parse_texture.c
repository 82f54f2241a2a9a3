/* parse_texture.c: named textures, and parameters that may be a number or a texture. Defaults are pbrt-v3's
 * [PBRT3 textures/, paramset.cpp]. See parse.h. */
#include "parser/parse.h"

#include <ctype.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/bits.h"

int parse_constant(struct parser *p, rgb value)
{
    uint32_t h = hash_bytes(&value, sizeof value);
    int *slot = &p->constant[(h ^ h >> 16) % CONSTANTS];
    const struct texture *known = *slot > 0 ? &p->scene->textures.texture[*slot - 1] : NULL;
    if (known == NULL || memcmp(&known->u.constant, &value, sizeof value) != 0)
        *slot = texture_add_constant(&p->scene->textures, value) + 1;
    return *slot - 1;
}

/* --- parameters --------------------------------------------------------------------------------------- */

/* The texture named by "texture NAME"; -1 if there is no such parameter (or, with a message, no such texture). */
static int named_texture(struct parser *p, const char *name, bool is_float)
{
    struct params *q = &p->params;
    const struct names *table = is_float ? &p->float_textures : &p->spectrum_textures;
    const struct names *other = is_float ? &p->spectrum_textures : &p->float_textures;
    struct place at;
    const char *texture = params_text(q, name, PARAM_TEXTURE, &at);
    if (texture == NULL)
        return -1;
    int id = names_find(table, texture);
    if (id >= 0)
        return id;
    const char *kind = is_float ? "float" : "spectrum", *near = names_near(table, texture);
    if (names_find(other, texture) >= 0)
        params_fail(q, at, "\"%s\" wants a texture of type %s, but \"%.60s\" is of type %s", name, kind, texture,
                    is_float ? "spectrum" : "float");
    else if (near != NULL)
        params_fail(q, at, "there is no %s texture \"%.60s\"; did you mean \"%.60s\"?", kind, texture, near);
    else
        params_fail(q, at, "there is no %s texture \"%.60s\"; define it with Texture before it is used", kind,
                    texture);
    return -1;
}

/* A texture wins over a value of the same name, as in pbrt. */
static void warn_both(struct parser *p, const char *name)
{
    const struct param *other = params_ignore(&p->params, name);
    if (other != NULL && other->type != PARAM_TEXTURE)
        place_warn(&p->messages, other->place, "texture and value",
                   "\"%s\" is given as a texture and as a value; the texture counts", name);
}

int parse_float_texture_or(struct parser *p, const char *name, int otherwise)
{
    int id = named_texture(p, name, true);
    if (id >= 0)
        warn_both(p, name);
    else if (params_has(&p->params, name, PARAM_FLOAT))
        id = parse_constant(p, rgb_grey(params_float(&p->params, name, 0)));
    return id >= 0 ? id : otherwise;
}

int parse_float_texture(struct parser *p, const char *name, double fallback)
{
    int id = parse_float_texture_or(p, name, -1);
    return id >= 0 ? id : parse_constant(p, rgb_grey(fallback));
}

int parse_rgb_texture(struct parser *p, const char *name, rgb fallback)
{
    int id = named_texture(p, name, false);
    if (id < 0)
        return parse_constant(p, params_rgb(&p->params, name, fallback));
    warn_both(p, name);
    return id;
}

/* --- the Texture directive ---------------------------------------------------------------------------- */

/* A value or a texture of the type being defined. */
static int operand(struct parser *p, const char *name, bool is_float, double fallback)
{
    return is_float ? parse_float_texture(p, name, fallback) : parse_rgb_texture(p, name, rgb_grey(fallback));
}

static rgb constant_value(struct params *q, const char *name, bool is_float, double fallback)
{
    return is_float ? rgb_grey(params_float(q, name, fallback)) : params_rgb(q, name, rgb_grey(fallback));
}

static struct uv_mapping mapping(struct params *q)
{
    struct place at;
    const char *kind = params_text(q, "mapping", PARAM_STRING, &at);
    if (kind != NULL && strcmp(kind, "uv") != 0)
        params_fail(q, at, "texture mapping \"%.40s\" is not supported; use \"uv\"", kind);
    struct uv_mapping m = {params_float(q, "uscale", 1), params_float(q, "vscale", 1), params_float(q, "udelta", 0),
                           params_float(q, "vdelta", 0)};
    return m;
}

static struct texture checkerboard(struct parser *p, bool is_float)
{
    struct params *q = &p->params;
    struct texture t = {.kind = TEXTURE_CHECKERBOARD};
    params_int(q, "dimension", 2, 2, 2); /* solid ones are not supported */
    t.u.checker.tex1 = operand(p, "tex1", is_float, 1);
    t.u.checker.tex2 = operand(p, "tex2", is_float, 0);
    t.u.checker.map = mapping(q);
    params_ignore(q, "aamode"); /* pixel samples do the filtering */
    return t;
}

static bool ends_in(const char *name, const char *extension)
{
    size_t n = strlen(name), m = strlen(extension);
    if (n < m)
        return false;
    for (size_t i = 0; i < m; i++)
        if (tolower((unsigned char)name[n - m + i]) != extension[i])
            return false;
    return true;
}

static struct texture imagemap(struct parser *p)
{
    static const char *const WRAPS[] = {"repeat", "black", "clamp", NULL};
    struct params *q = &p->params;
    struct texture t = {.kind = TEXTURE_IMAGEMAP};
    t.u.imagemap.map = mapping(q);
    t.u.imagemap.scale = params_float(q, "scale", 1);
    switch (params_choice(q, "wrap", WRAPS)) {
    case 1: t.u.imagemap.wrap = WRAP_BLACK; break;
    case 2: t.u.imagemap.wrap = WRAP_CLAMP; break;
    default: t.u.imagemap.wrap = WRAP_REPEAT;
    }
    params_ignore(q, "trilinear"); /* choices of pbrt's texture filter; here pixel samples filter */
    params_ignore(q, "maxanisotropy");
    struct place at = q->place;
    char *path = params_file(q, "filename", &at);
    if (path == NULL) {
        params_fail(q, q->place, "an imagemap needs its picture: add \"string filename\" \"...\"");
        return t;
    }
    t.u.imagemap.gamma = params_bool(q, "gamma", ends_in(path, ".tga") || ends_in(path, ".png"));
    struct error inner;
    if (ends_in(path, ".exr"))
        params_fail(q, at, "OpenEXR pictures are not read; convert it to PFM (magick picture.exr picture.pfm)");
    else if (!q->failed && (t.u.imagemap.image = texture_load_image(&p->scene->textures, path, &inner)) < 0)
        params_fail(q, at, "%s", inner.text);
    else if (!q->failed && p->scene->textures.image[t.u.imagemap.image].replaced > 0)
        place_warn(&p->messages, at, p->scene->textures.image_path[t.u.imagemap.image],
                   "%ld numbers of this picture are not finite; 0 instead",
                   p->scene->textures.image[t.u.imagemap.image].replaced);
    free(path);
    return t;
}

static struct texture bilerp(struct params *q, bool is_float)
{
    struct texture t = {.kind = TEXTURE_BILERP};
    t.u.bilerp.map = mapping(q);
    t.u.bilerp.v00 = constant_value(q, "v00", is_float, 0);
    t.u.bilerp.v01 = constant_value(q, "v01", is_float, 1);
    t.u.bilerp.v10 = constant_value(q, "v10", is_float, 0);
    t.u.bilerp.v11 = constant_value(q, "v11", is_float, 1);
    return t;
}

static const char *const KINDS[] = {"constant", "scale", "mix", "checkerboard", "imagemap", "bilerp", NULL};
static const char *const REFUSED[] = {"uv", "dots", "fbm", "wrinkled", "marble", "windy", "ptex", NULL};

static struct texture make(struct parser *p, int kind, bool is_float)
{
    struct params *q = &p->params;
    struct texture t = {.kind = (enum texture_kind)kind};
    switch (t.kind) {
    case TEXTURE_CONSTANT: t.u.constant = constant_value(q, "value", is_float, 1); break;
    case TEXTURE_SCALE:
        t.u.pair.tex1 = operand(p, "tex1", is_float, 1);
        t.u.pair.tex2 = operand(p, "tex2", is_float, 1);
        t.u.pair.amount = -1;
        break;
    case TEXTURE_MIX:
        t.u.pair.tex1 = operand(p, "tex1", is_float, 0);
        t.u.pair.tex2 = operand(p, "tex2", is_float, 1);
        t.u.pair.amount = parse_float_texture(p, "amount", 0.5);
        break;
    case TEXTURE_CHECKERBOARD: t = checkerboard(p, is_float); break;
    case TEXTURE_IMAGEMAP: t = imagemap(p); break;
    case TEXTURE_BILERP: t = bilerp(q, is_float); break;
    }
    return t;
}

bool parse_texture(struct parser *p, const char *name, const char *type, struct place type_place)
{
    bool is_float = strcmp(type, "float") == 0;
    if (!is_float && strcmp(type, "spectrum") != 0 && strcmp(type, "color") != 0)
        return params_fail(&p->params, type_place, "unknown texture type \"%.40s\"; use \"float\" or \"spectrum\"",
                           type);
    int kind = parse_name(p, KINDS, REFUSED);
    if (kind < 0)
        return false;
    struct texture t = make(p, kind, is_float);
    if (!params_done(&p->params))
        return false;
    int id = texture_add(&p->scene->textures, t);
    if (p->scene->textures.texture[id].cost > TEXTURE_MAX_COST)
        return place_error(&p->messages, p->params.place, "this texture is built from more than %d others; use fewer",
                           TEXTURE_MAX_COST);
    names_add(is_float ? &p->float_textures : &p->spectrum_textures, name, id);
    return true;
}
