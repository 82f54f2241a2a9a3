/* parse_medium.c: participating media, with pbrt-v3's parameters and defaults [pbrt-v3 core/api.cpp]. See parse.h. */
#include "parser/parse.h"

#include <stdio.h>
#include <string.h>

enum { MEDIUM_UNKNOWN = INT32_MAX }; /* in place of the number of one of another type than ours */

static const struct field MEDIUM[] = {{.name = "type"}, {.name = "preset"},  {.name = "scale"}, {.name = "g"},
                                      {.name = "sigma_a"}, {.name = "sigma_s"}, {.name = NULL}};

static bool make_named_medium(struct parser *p)
{
    struct params *q = &p->params;
    struct token name;
    struct source_position at;
    if (!parse_string(p, &name, "a name") || !parse_list(p, "MakeNamedMedium", &name))
        return false;
    const char *type = params_text(q, "type", PARAM_STRING, &at);
    p->type.fields = MEDIUM;
    if (type == NULL)
        source_warn(&p->messages, name.position, "MakeNamedMedium needs its kind: add \"string type\" \"homogeneous\"; "
                    "as in pbrt-v3, nothing is in it");
    if (type == NULL || strcmp(type, "homogeneous") != 0) {
        struct near near = near_start(type != NULL ? type : "");
        near_try(&near, "homogeneous");
        if (near.name != NULL)
            source_warn(&p->messages, at, "the type \"%.40s\" of a medium is not known%s", type, near.text);
        symbols_add(&p->media.known, name.text, type == NULL ? 0 : MEDIUM_UNKNOWN);
        return true;
    }
    rgb sigma_a = {0.0011, 0.0024, 0.014}, sigma_s = {2.55, 3.21, 3.77};
    const char *preset = params_text(q, "preset", PARAM_STRING, &at);
    bool whole = params_ignore(q, "sigma_a") != NULL && params_ignore(q, "sigma_s") != NULL;
    if (preset != NULL && preset[0] != '\0' && !whole)
        params_fail(q, at, "\"preset\" is not supported; write the \"sigma_a\" and \"sigma_s\" of \"%.60s\"", preset);
    double scale = params_number(q, "scale", 1, 0, NUMBER_MAX), g = params_number(q, "g", 0, -0.999, 0.999);
    sigma_a = rgb_scale(params_rgb(q, "sigma_a", sigma_a), scale);
    sigma_s = rgb_scale(params_rgb(q, "sigma_s", sigma_s), scale);
    struct medium m = {sigma_s, rgb_add(sigma_a, sigma_s), -1};
    bool positive = rgb_max(rgb_scale(sigma_a, -1)) <= 0 && rgb_max(rgb_scale(sigma_s, -1)) <= 0;
    if (!(positive && rgb_max(m.sigma_t) <= NUMBER_MAX))
        type_error(q, "\"sigma_a\" and \"sigma_s\" times \"scale\" go from 0 to %g", NUMBER_MAX);
    m.material = scene_add_material(p->scene, material_medium(g));
    symbols_add(&p->media.known, name.text, space_add(&p->scene->space, m));
    return parse_done(p);
}

/* One name stands for both sides, as in pbrt-v3; the empty one for none. */
static bool medium_interface(struct parser *p)
{
    for (int i = 0; i < 2 && (i == 0 || lexer_peek(&p->lexer) == TOKEN_STRING); i++) {
        struct token name;
        if (!parse_string(p, &name, "a medium"))
            return false;
        p->state.medium[1] = name;
        if (i == 0)
            p->state.medium[0] = name;
        if (name.text[0] != '\0')
            p->media.used_at = name.position;
    }
    return true;
}

int parse_medium(struct parser *p, int side)
{
    const struct token *name = &p->state.medium[side];
    if (name->text[0] == '\0' || !p->media.seen)
        return 0;
    int medium = symbols_find(&p->media.known, name->text);
    if (medium == MEDIUM_UNKNOWN)
        source_error(&p->messages, name->position, "medium \"%.60s\" is not \"homogeneous\": others are not known",
                     name->text);
    if (medium < 0)
        source_error(&p->messages, name->position, "there is no medium \"%.60s\"%s", name->text,
                     parse_near_symbol(p, name->text, &p->media.known).text);
    return medium < 0 || medium == MEDIUM_UNKNOWN ? 0 : medium;
}

/* Is it an integrator of pbrt-v3 that sees no media? NULL is its default, "path". */
static bool is_blind(const char *integrator)
{
    static const char *const BLIND[] = {"path", "directlighting", "whitted", "ambientocclusion", "sppm", NULL};
    for (int i = 0; integrator != NULL && BLIND[i] != NULL; i++)
        if (strcmp(integrator, BLIND[i]) == 0)
            return true;
    return integrator == NULL;
}

void parse_begin_media(struct parser *p)
{
    p->media.seen = !is_blind(p->integrator != NULL ? p->integrator : p->scene->integrator);
}

void parse_settle_media(struct parser *p)
{
    struct source_position used = p->media.used_at;
    if (used.file == NULL || !p->media.seen) { /* none is anywhere, or is to be seen */
        space_free(p->scene->space);
        p->scene->space = NULL;
        if (used.file != NULL)
            source_warn(&p->messages, used, "media are left out, as by pbrt-v3's \"path\"");
    } else {
        p->scene->camera.medium = parse_medium(p, 1); /* pbrt-v3 makes the camera last */
    }
}

const struct directive MEDIUM_DIRECTIVES[] = {{"MediumInterface", ANYWHERE, medium_interface, NULL},
                                              {"MakeNamedMedium", ANYWHERE, make_named_medium, NULL},
                                              {.name = NULL}};
