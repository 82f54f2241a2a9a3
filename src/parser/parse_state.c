/* parse_state.c: the directives that change the graphics state: transforms and blocks [pbrt-v3 core/api.cpp]. See
 * parse.h. */
#include "parser/parse.h"

#include <string.h>

/* --- transforms --------------------------------------------------------------------------------------- */

/* The n numbers of a directive, with or without brackets around them. */
static bool read_numbers(struct parser *p, double *out, int n)
{
    struct lexer *l = &p->lexer;
    struct token t;
    char found[64];
    bool bracket = lexer_peek(l) == TOKEN_OPEN;
    if (bracket)
        lexer_next(l, &t);
    for (int i = 0; i < n + bracket; i++) {
        if (!lexer_next(l, &t))
            return false;
        if (t.kind != (i < n ? TOKEN_NUMBER : TOKEN_CLOSE))
            return source_error(&p->messages, t.position, "%s wants %d numbers; here should be %s, not %s",
                               p->directive.text, n, i < n ? "the next" : "]", token_text(&t, found, sizeof found));
        if (i < n)
            out[i] = t.number;
    }
    return true;
}

/* A singular transform is an error only if a shape, light or camera uses it. This one remains singular in all
 * products. */
static const struct transform SINGULAR = {{{0}}, {{0}}};

static bool set_ctm(struct parser *p, struct transform t)
{
    if (!p->place.start_active)
        return true;
    if (p->has_camera && p->moved.position.file == NULL)
        p->moved = p->directive;
    if (transform_is_usable(&p->place.ctm))
        p->place.made_by = p->directive;
    p->place.ctm = t;
    return true;
}

bool parse_placed(struct parser *p)
{
    const double *last = p->place.ctm.m[3];
    if (last[0] != 0 || last[1] != 0 || last[2] != 0)
        return directive_error(p, "the last row of the current transform, numbers 4, 8, 12 and 16 of a matrix, is "
                               "%g %g %g %g; only the last of them may be other than 0", last[0], last[1], last[2],
                               last[3]);
    if (transform_is_usable(&p->place.ctm))
        return true;
    const struct token *by = &p->place.made_by;
    p->place.ctm = transform_identity();
    return source_error(&p->messages, by->position, "after this %s the current transform is infinite or singular, or "
                        "nearly so; %s", by->text, strcmp(by->text, "LookAt") == 0
                        ? "its up vector must not be parallel to the direction from eye to look"
                        : "its numbers and its inverse's go up to 1e30");
}

struct transform parse_to_world(const struct parser *p, struct transform t)
{
    return transform_compose(transform_translate(neg(p->scene->origin)), t);
}

void parse_state_reset(struct parser *p)
{
    p->place.ctm = transform_identity();
    p->place.start_active = true;
}

static bool apply(struct parser *p, struct transform t) { return set_ctm(p, transform_compose(p->place.ctm, t)); }

static bool identity(struct parser *p) { return set_ctm(p, transform_identity()); }

static bool translate(struct parser *p)
{
    double x[3];
    return read_numbers(p, x, 3) && apply(p, transform_translate(vec(x[0], x[1], x[2])));
}

static bool scale(struct parser *p)
{
    double x[3];
    if (!read_numbers(p, x, 3))
        return false;
    bool flat = x[0] == 0 || x[1] == 0 || x[2] == 0;
    return apply(p, flat ? SINGULAR : transform_scale(x[0], x[1], x[2]));
}

static bool rotate(struct parser *p)
{
    double x[4];
    if (!read_numbers(p, x, 4))
        return false;
    vec3 axis = vec(x[1], x[2], x[3]);
    return apply(p, length2(axis) > 0 ? transform_rotate(x[0], axis) : SINGULAR);
}

static bool look_at(struct parser *p)
{
    double x[9];
    struct transform t = SINGULAR;
    if (!read_numbers(p, x, 9))
        return false;
    transform_look_at(vec(x[0], x[1], x[2]), vec(x[3], x[4], x[5]), vec(x[6], x[7], x[8]), &t);
    return apply(p, t);
}

/* Numbers as lists of columns. The last row is what points are divided by; parse_placed refuses all but a number. */
static bool parse_matrix(struct parser *p, struct transform *out)
{
    double x[16];
    if (!read_numbers(p, x, 16))
        return false;
    for (int i = 0; i < 16; i++)
        x[i] /= x[15];
    *out = SINGULAR;
    transform_from_matrix(x, out);
    return true;
}

static bool transform(struct parser *p)
{
    struct transform t;
    return parse_matrix(p, &t) && set_ctm(p, t);
}

static bool concat_transform(struct parser *p)
{
    struct transform t;
    return parse_matrix(p, &t) && apply(p, t);
}

void parse_name_system(struct parser *p, const char *name, struct transform t)
{
    p->system = mem_append(p->system, (size_t)p->systems.n, sizeof *p->system);
    p->system[p->systems.n] = t;
    symbols_add(&p->systems, name, p->systems.n);
}

static bool coordinate_system(struct parser *p)
{
    struct token name;
    if (!parse_string(p, &name, "a name"))
        return false;
    parse_name_system(p, name.text, p->place.ctm);
    p->moved.position.file = NULL;
    return true;
}

static bool coord_sys_transform(struct parser *p)
{
    struct token name;
    int i = parse_named(p, &name, &p->systems, "coordinate system", "the transform stays as it is");
    return i >= 0 && set_ctm(p, p->system[i]);
}

static bool active_transform(struct parser *p)
{
    struct token t;
    if (!lexer_next(&p->lexer, &t))
        return false;
    bool end = strcmp(t.text, "EndTime") == 0;
    if (!end && strcmp(t.text, "StartTime") != 0 && strcmp(t.text, "All") != 0)
        return source_error(&p->messages, t.position, "ActiveTransform wants StartTime, EndTime or All");
    if (end)
        source_warn(&p->messages, t.position, "nothing moves here: transforms of the end time are ignored");
    p->place.start_active = !end;
    return true;
}

static bool transform_times(struct parser *p)
{
    double x[2];
    source_warn(&p->messages, p->directive.position, "nothing moves here: transforms of the end time are ignored");
    return read_numbers(p, x, 2);
}

/* --- blocks ------------------------------------------------------------------------------------------- */

static const char *const BEGIN[] = {"AttributeBegin", "TransformBegin", "ObjectBegin"};
static const char *const END[] = {"AttributeEnd", "TransformEnd", "ObjectEnd"};

void parse_close_all(struct parser *p)
{
    while (p->n_blocks > 0) {
        const struct block *b = &p->block[--p->n_blocks];
        source_warn(&p->messages, b->position, "%s is still open at WorldEnd; close it with %s", BEGIN[b->kind],
                    END[b->kind]);
    }
}

bool parse_open_block(struct parser *p, enum block_kind kind)
{
    p->block = mem_append(p->block, (size_t)p->n_blocks, sizeof *p->block);
    p->block[p->n_blocks++] = (struct block){kind, p->directive.position, p->place};
    if (kind == BLOCK_TRANSFORM)
        return true;
    p->saved = mem_append(p->saved, (size_t)p->n_saved, sizeof *p->saved);
    p->saved[p->n_saved++] = (struct saved_state){p->state, p->float_textures.n, p->spectrum_textures.n,
                                                  p->materials.n};
    return true;
}

bool parse_close_block(struct parser *p, enum block_kind kind)
{
    if (p->n_blocks == 0 || (kind != BLOCK_TRANSFORM && p->n_saved == 0)) {
        source_warn(&p->messages, p->directive.position, "%s without %s is passed over", END[kind], BEGIN[kind]);
        return false;
    }
    const struct block *b = &p->block[--p->n_blocks];
    if (b->kind != kind)
        source_warn(&p->messages, p->directive.position, "as in pbrt-v3, this %s ends the block of the last %s",
                    END[kind], BEGIN[b->kind]);
    p->place = b->place;
    if (kind == BLOCK_TRANSFORM)
        return true;
    const struct saved_state *s = &p->saved[--p->n_saved];
    p->state = s->state;
    symbols_forget(&p->float_textures, s->n_float_textures);
    symbols_forget(&p->spectrum_textures, s->n_spectrum_textures);
    symbols_forget(&p->materials, s->n_materials);
    return true;
}

static bool attribute_begin(struct parser *p) { return parse_open_block(p, BLOCK_ATTRIBUTE); }
static bool attribute_end(struct parser *p) { return parse_close_block(p, BLOCK_ATTRIBUTE); }
static bool transform_begin(struct parser *p) { return parse_open_block(p, BLOCK_TRANSFORM); }
static bool transform_end(struct parser *p) { return parse_close_block(p, BLOCK_TRANSFORM); }

static bool reverse_orientation(struct parser *p)
{
    p->state.reverse = !p->state.reverse;
    return true;
}

const struct directive STATE_DIRECTIVES[] = {
    {"Transform", ANYWHERE, transform, NULL},
    {"AttributeBegin", IN_WORLD, attribute_begin, NULL},
    {"AttributeEnd", IN_WORLD, attribute_end, NULL},
    {"TransformBegin", IN_WORLD, transform_begin, NULL},
    {"TransformEnd", IN_WORLD, transform_end, NULL},
    {"Translate", ANYWHERE, translate, NULL},
    {"Scale", ANYWHERE, scale, NULL},
    {"Rotate", ANYWHERE, rotate, NULL},
    {"LookAt", ANYWHERE, look_at, NULL},
    {"Identity", ANYWHERE, identity, NULL},
    {"ConcatTransform", ANYWHERE, concat_transform, NULL},
    {"CoordinateSystem", ANYWHERE, coordinate_system, NULL},
    {"CoordSysTransform", ANYWHERE, coord_sys_transform, NULL},
    {"ActiveTransform", ANYWHERE, active_transform, NULL},
    {"TransformTimes", BEFORE_WORLD, transform_times, NULL},
    {"ReverseOrientation", IN_WORLD, reverse_orientation, NULL}, {.name = NULL}};
