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

/* The transform when the shutter opens, of the two times: that of the first before it, that of the second after it. In
 * between, as in pbrt-v3, what they move moves evenly; of turns that would be more than a mean of numbers. */
static void settle(struct parser *p)
{
    struct transform_state *place = &p->place;
    double span = p->times[1] - p->times[0], late = (p->shutter - p->times[0]) / span;
    place->turns = false;
    place->ctm = place->at[late >= 1];
    if (!(late > 0 && late < 1))
        return;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            place->turns |= place->at[0].m[i][k] != place->at[1].m[i][k];
        place->ctm.m[i][3] += late * (place->at[1].m[i][3] - place->at[0].m[i][3]);
    }
    double columns[16];
    for (int i = 0; i < 16; i++)
        columns[i] = place->ctm.m[i % 4][i / 4];
    transform_from_matrix(columns, &place->ctm);
}

/* The transforms have changed. Returns true. */
static bool changed(struct parser *p)
{
    if (p->has_camera && p->moved.position.file == NULL)
        p->moved = p->directive;
    if (transform_is_usable(&p->place.ctm))
        p->place.made_by = p->directive;
    settle(p);
    return true;
}

static bool set_ctm(struct parser *p, struct transform t)
{
    for (int i = 0; i < 2; i++)
        if (p->place.active[i])
            p->place.at[i] = t;
    return changed(p);
}

void parse_open_shutter(struct parser *p, double time)
{
    p->shutter = time;
    settle(p);
}

bool parse_placed(struct parser *p)
{
    const double *last = p->place.ctm.m[3];
    if (p->place.turns)
        return directive_error(p, "the shutter opens between two transforms of which one is turned or scaled: nothing "
                               "moves here, so let \"shutteropen\" be one of the times of TransformTimes");
    if (last[0] != 0 || last[1] != 0 || last[2] != 0)
        return directive_error(p, "the last row of the current transform, numbers 4, 8, 12 and 16 of a matrix, is "
                               "%g %g %g %g; only the last of them may be other than 0", last[0], last[1], last[2],
                               last[3]);
    if (transform_is_usable(&p->place.ctm))
        return true;
    const struct token *by = &p->place.made_by;
    p->place.ctm = p->place.at[0] = p->place.at[1] = transform_identity();
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
    p->place.ctm = p->place.at[0] = p->place.at[1] = transform_identity();
    p->place.active[0] = p->place.active[1] = true;
    p->place.turns = false;
}

static bool apply(struct parser *p, struct transform t)
{
    for (int i = 0; i < 2; i++)
        if (p->place.active[i])
            p->place.at[i] = transform_compose(p->place.at[i], t);
    return changed(p);
}

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

void parse_name_system(struct parser *p, const char *name, const struct transform at[2])
{
    p->system = mem_append(p->system, (size_t)p->systems.n, sizeof *p->system);
    memcpy(p->system[p->systems.n], at, sizeof *p->system);
    symbols_add(&p->systems, name, p->systems.n);
}

static bool coordinate_system(struct parser *p)
{
    struct token name;
    if (!parse_string(p, &name, "a name"))
        return false;
    parse_name_system(p, name.text, p->place.at);
    p->moved.position.file = NULL;
    return true;
}

static bool coord_sys_transform(struct parser *p)
{
    struct token name;
    int i = parse_named(p, &name, &p->systems, "coordinate system", "the transform stays as it is");
    if (i >= 0)
        memcpy(p->place.at, p->system[i], sizeof p->place.at); /* whichever is active, as in pbrt-v3 */
    return i >= 0 && changed(p);
}

static const char STILL[] = "nothing moves here: everything is where it is when the shutter opens";

static bool active_transform(struct parser *p)
{
    struct token t;
    if (!lexer_next(&p->lexer, &t))
        return false;
    bool start = strcmp(t.text, "StartTime") == 0, end = strcmp(t.text, "EndTime") == 0;
    if (!start && !end && strcmp(t.text, "All") != 0)
        return source_error(&p->messages, t.position, "ActiveTransform wants StartTime, EndTime or All");
    if (end)
        source_warn(&p->messages, t.position, STILL);
    p->place.active[0] = !end;
    p->place.active[1] = !start;
    return true;
}

static bool transform_times(struct parser *p)
{
    double x[2];
    source_warn(&p->messages, p->directive.position, STILL);
    if (!read_numbers(p, x, 2))
        return false;
    memcpy(p->times, x, sizeof p->times);
    settle(p);
    return true;
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
