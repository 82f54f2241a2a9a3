/* parse_medium.c: participating media, with pbrt-v3's parameters and defaults [pbrt-v3 core/api.cpp]. See parse.h. */
#include "parser/parse.h"

#include <stdio.h>
#include <string.h>

#include "material/phase.h"

/* Media by pbrt-v3's names. The first dozen are of [Jensen 2001], the others of [Narasimhan 2006]. */
static const struct {
    const char *name;
    rgb sigma_s, sigma_a;
} PRESETS[] = {
    {"Apple", {2.29, 2.39, 1.97}, {0.003, 0.0034, 0.046}},
    {"Chicken1", {0.15, 0.21, 0.38}, {0.015, 0.077, 0.19}},
    {"Chicken2", {0.19, 0.25, 0.32}, {0.018, 0.088, 0.2}},
    {"Cream", {7.38, 5.47, 3.15}, {0.0002, 0.0028, 0.0163}},
    {"Ketchup", {0.18, 0.07, 0.03}, {0.061, 0.97, 1.45}},
    {"Marble", {2.19, 2.62, 3}, {0.0021, 0.0041, 0.0071}},
    {"Potato", {0.68, 0.7, 0.55}, {0.0024, 0.009, 0.12}},
    {"Skimmilk", {0.7, 1.22, 1.9}, {0.0014, 0.0025, 0.0142}},
    {"Skin1", {0.74, 0.88, 1.01}, {0.032, 0.17, 0.48}},
    {"Skin2", {1.09, 1.59, 1.79}, {0.013, 0.07, 0.145}},
    {"Spectralon", {11.6, 20.4, 14.9}, {0, 0, 0}},
    {"Wholemilk", {2.55, 3.21, 3.77}, {0.0011, 0.0024, 0.014}},
    {"Lowfat Milk", {0.89187, 1.5136, 2.532}, {0.002875, 0.00575, 0.0115}},
    {"Reduced Milk", {2.4858, 3.1669, 4.5214}, {0.0025556, 0.0051111, 0.012778}},
    {"Regular Milk", {4.5513, 5.8294, 7.136}, {0.0015333, 0.0046, 0.019933}},
    {"Espresso", {0.72378, 0.84557, 1.0247}, {4.7984, 6.5751, 8.8493}},
    {"Mint Mocha Coffee", {0.31602, 0.38538, 0.48131}, {3.772, 5.8228, 7.82}},
    {"Lowfat Soy Milk", {0.30576, 0.34233, 0.61664}, {0.0014375, 0.0071875, 0.035937}},
    {"Regular Soy Milk", {0.59223, 0.73866, 1.4693}, {0.0019167, 0.0095833, 0.065167}},
    {"Lowfat Chocolate Milk", {0.64925, 0.83916, 1.1057}, {0.0115, 0.0368, 0.1564}},
    {"Regular Chocolate Milk", {1.4585, 2.1289, 2.9527}, {0.010063, 0.043125, 0.14375}},
    {"Coke", {8.9053e-5, 8.372e-5, 0}, {0.10014, 0.16503, 0.2468}},
    {"Pepsi", {6.1697e-5, 4.2564e-5, 0}, {0.091641, 0.14158, 0.20729}},
    {"Sprite", {6.0306e-6, 6.4139e-6, 6.5504e-6}, {0.001886, 0.0018308, 0.0020025}},
    {"Gatorade", {0.0024574, 0.003007, 0.0037325}, {0.024794, 0.019289, 0.008878}},
    {"Chardonnay", {1.7982e-5, 1.3758e-5, 1.2023e-5}, {0.010782, 0.011855, 0.023997}},
    {"White Zinfandel", {1.7501e-5, 1.9069e-5, 1.288e-5}, {0.012072, 0.016184, 0.019843}},
    {"Merlot", {2.1129e-5, 0, 0}, {0.11632, 0.25191, 0.29434}},
    {"Budweiser Beer", {2.4356e-5, 2.4079e-5, 1.0564e-5}, {0.011492, 0.024911, 0.057786}},
    {"Coors Light Beer", {5.0922e-5, 4.301e-5, 0}, {0.006164, 0.013984, 0.034983}},
    {"Clorox", {0.0024035, 0.0031373, 0.003991}, {0.0033542, 0.014892, 0.026297}},
    {"Apple Juice", {0.00013612, 0.00015836, 0.000227}, {0.012957, 0.023741, 0.052184}},
    {"Cranberry Juice", {0.00010402, 0.00011646, 7.8139e-5}, {0.039437, 0.094223, 0.12426}},
    {"Grape Juice", {5.382e-5, 0, 0}, {0.10404, 0.23958, 0.29325}},
    {"Ruby Grapefruit Juice", {0.011002, 0.010927, 0.011036}, {0.085867, 0.18314, 0.25262}},
    {"White Grapefruit Juice", {0.22826, 0.23998, 0.32748}, {0.0138, 0.018831, 0.056781}},
    {"Shampoo", {0.0007176, 0.0008303, 0.0009016}, {0.014107, 0.045693, 0.061717}},
    {"Strawberry Shampoo", {0.00015671, 0.00015947, 1.518e-5}, {0.01449, 0.05796, 0.075823}},
    {"Head & Shoulders Shampoo", {0.023805, 0.028804, 0.034306}, {0.084621, 0.15688, 0.20365}},
    {"Lemon Tea Powder", {0.040224, 0.045264, 0.051081}, {2.4288, 4.5757, 7.2127}},
    {"Orange Powder", {0.00015617, 0.00017482, 0.0001762}, {0.001449, 0.003441, 0.007863}},
    {"Pink Lemonade Powder", {0.00012103, 0.00013073, 0.00012528}, {0.001165, 0.002366, 0.003195}},
    {"Cappuccino Powder", {1.8436, 2.5851, 2.1662}, {35.844, 49.547, 61.084}},
    {"Salt Powder", {0.027333, 0.032451, 0.031979}, {0.28415, 0.3257, 0.34148}},
    {"Sugar Powder", {0.00022272, 0.00025513, 0.000271}, {0.012638, 0.031051, 0.050124}},
    {"Suisse Mocha Powder", {2.7979, 3.5452, 4.3365}, {17.502, 27.004, 35.433}},
    {"Pacific Ocean Surface Water", {0.0001764, 0.00032095, 0.00019617}, {0.031845, 0.031324, 0.030147}},
};

/* The coefficients of a medium that has been measured, 1/mm, of scattering as if it were even. False, with neither
 * changed, if the name is of none. */
static bool medium_preset(const char *name, rgb *sigma_s, rgb *sigma_a)
{
    for (size_t i = 0; i < sizeof PRESETS / sizeof PRESETS[0]; i++)
        if (strcmp(name, PRESETS[i].name) == 0) {
            *sigma_s = PRESETS[i].sigma_s;
            *sigma_a = PRESETS[i].sigma_a;
            return true;
        }
    return false;
}

enum { MEDIUM_UNKNOWN = INT32_MAX }; /* in place of the number of one of another type than ours */

static void add_medium(struct parser *p, const char *name, const struct medium *m, double g)
{
    struct medium_set *media = &p->scene->media;
    media->medium = mem_append(media->medium, (size_t)media->n, sizeof *media->medium);
    media->medium[media->n] = *m;
    media->medium[media->n].material = scene_add_material(p->scene, phase_new(g));
    symbols_add(&p->media.known, name, ++media->n);
}

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
        symbols_add(&p->media.known, name.text, type == NULL ? 0 : MEDIUM_UNKNOWN);
        return true;
    }
    rgb sigma_a = {0.0011, 0.0024, 0.014}, sigma_s = {2.55, 3.21, 3.77};
    const char *preset = params_text(q, "preset", PARAM_STRING, &at);
    if (preset != NULL && preset[0] != '\0' && !medium_preset(preset, &sigma_s, &sigma_a))
        source_warn(&p->messages, at, "there is no preset \"%.60s\" (doc/scene-format.md lists them); the defaults are "
                    "taken", preset);
    double scale = params_number(q, "scale", 1, 0, NUMBER_MAX), g = params_number(q, "g", 0, -0.999, 0.999);
    sigma_a = rgb_scale(params_rgb(q, "sigma_a", sigma_a), scale);
    sigma_s = rgb_scale(params_rgb(q, "sigma_s", sigma_s), scale);
    const struct medium m = {sigma_s, rgb_add(sigma_a, sigma_s), -1};
    bool positive = rgb_max(rgb_scale(sigma_a, -1)) <= 0 && rgb_max(rgb_scale(sigma_s, -1)) <= 0;
    if (!(positive && rgb_max(m.sigma_t) <= NUMBER_MAX))
        type_error(q, "\"sigma_a\" and \"sigma_s\" times \"scale\" go from 0 to %g", NUMBER_MAX);
    add_medium(p, name.text, &m, g);
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
        source_error(&p->messages, name->position, "there is no medium \"%.60s\"", name->text);
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

bool parse_settle_media(struct parser *p)
{
    struct source_position used = p->media.used_at, bare = p->media.bare_light_at;
    if (used.file == NULL || !p->media.seen) { /* none is anywhere, or is to be seen */
        p->scene->media.n = 0;
        if (used.file != NULL)
            source_warn(&p->messages, used, "media are left out, as by pbrt-v3's \"path\"");
        return true;
    }
    p->scene->camera.medium = parse_medium(p, 1); /* pbrt-v3 makes the camera last */
    return bare.file == NULL || source_error(&p->messages, bare, "where media are an area light needs a material: give "
                                             "it one before this shape");
}

const struct directive MEDIUM_DIRECTIVES[] = {{"MediumInterface", ANYWHERE, medium_interface, NULL},
                                              {"MakeNamedMedium", ANYWHERE, make_named_medium, NULL},
                                              {.name = NULL}};
