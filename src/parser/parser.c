/* parser.c: files and directives. A directive is a row of a table with a function; those that change the graphics
 * state are in parse_state.c, what the others make is made in parse_*.c. See parser.h, and parse.h for the state.
 */
#include "parser/parser.h"

#include <stdlib.h>
#include <string.h>

#include "parser/parse.h"
#include "parser/suggest.h"

enum { MAX_INCLUDES = 65536 };

/* --- the world ---------------------------------------------------------------------------------------- */

static bool do_world_begin(struct parser *p)
{
    p->phase = IN_WORLD;
    p->state.ctm = transform_identity();
    p->state.start_active = true;
    parse_name_system(p, "world", transform_identity());
    return true;
}

static bool do_world_end(struct parser *p)
{
    p->phase = AFTER_WORLD;
    return parse_all_closed(p);
}

static bool do_camera(struct parser *p)
{
    if (!parse_typed(p) || !parse_camera(p))
        return false;
    parse_name_system(p, "camera", transform_inverse(p->state.ctm));
    return true;
}

static bool do_film(struct parser *p) { return parse_typed(p) && parse_film(p); }
static bool do_pixel_filter(struct parser *p) { return parse_typed(p) && parse_filter(p); }
static bool do_sampler(struct parser *p) { return parse_typed(p) && parse_sampler(p); }
static bool do_accelerator(struct parser *p) { return parse_typed(p) && parse_accelerator(p); }
static bool do_integrator(struct parser *p) { return parse_typed(p) && parse_integrator(p); }
static bool do_light_source(struct parser *p) { return parse_typed(p) && parse_light(p); }
static bool do_shape(struct parser *p) { return parse_typed(p) && parse_shape(p); }

static bool do_area_light_source(struct parser *p) { return parse_typed(p) && parse_area_light(p, &p->state.area); }

static bool do_material(struct parser *p) { return parse_typed(p) && parse_material(p, &p->state.material); }

static bool do_make_named_material(struct parser *p)
{
    struct token name;
    int id;
    if (!parse_string(p, &name, "a name") || !parse_list(p, "Material", &name))
        return false;
    const char *type = params_text(&p->params, "type", PARAM_STRING, &p->params.place);
    if (type == NULL)
        return params_fail(&p->params, name.place,
                           "MakeNamedMaterial needs its kind: add \"string type\" \"matte\"");
    p->params.type = type;
    if (!parse_material(p, &id))
        return false;
    if (names_find(&p->materials, name.text) >= 0)
        place_warn(&p->messages, name.place, "material again", "the material \"%.60s\" is defined again",
                   name.text);
    names_add(&p->materials, name.text, id + 1); /* 0 stands for "none" */
    return true;
}

static bool do_named_material(struct parser *p)
{
    struct token name;
    if (!parse_string(p, &name, "a name"))
        return false;
    int id = names_find(&p->materials, name.text);
    if (id < 0)
        return parse_no_such(p, &name, &p->materials, "named material");
    p->state.material = id - 1;
    return true;
}

static bool do_texture(struct parser *p)
{
    struct token name, type, class;
    return parse_string(p, &name, "a name") && parse_string(p, &type, "float or spectrum") &&
           parse_string(p, &class, "a kind of texture") && parse_list(p, "Texture", &class) &&
           parse_texture(p, name.text, type.text, type.place);
}

/* Vacuum inside and outside is all there is. */
static bool do_medium_interface(struct parser *p)
{
    struct token name[2];
    if (!parse_string(p, &name[0], "a medium"))
        return false;
    name[1] = name[0];
    if (lexer_peek(&p->lexer) == TOKEN_STRING && !lexer_next(&p->lexer, &name[1]))
        return false;
    for (int i = 0; i < 2; i++)
        if (name[i].text[0] != '\0')
            return place_error(&p->messages, name[i].place,
                               "participating media are not supported; only the medium \"\" is");
    return true;
}

static bool do_make_named_medium(struct parser *p)
{
    return place_error(&p->messages, p->directive.place,
                       "participating media are not supported; remove MakeNamedMedium");
}

static bool do_color_space(struct parser *p)
{
    struct token name;
    if (!parse_string(p, &name, "a name"))
        return false;
    if (strcmp(name.text, "srgb") == 0)
        return true;
    return place_error(&p->messages, name.place,
                       "colours here have the primaries of sRGB; convert the scene's colours");
}

static bool do_include(struct parser *p);

static const struct directive {
    const char *name;
    enum phase phase;
    bool (*run)(struct parser *p);
} DIRECTIVES[] = {
    {"Shape", IN_WORLD, do_shape},
    {"NamedMaterial", IN_WORLD, do_named_material},
    {"Transform", ANYWHERE, parse_transform},
    {"AttributeBegin", IN_WORLD, parse_attribute_begin},
    {"AttributeEnd", IN_WORLD, parse_attribute_end},
    {"TransformBegin", IN_WORLD, parse_transform_begin},
    {"TransformEnd", IN_WORLD, parse_transform_end},
    {"Material", IN_WORLD, do_material},
    {"ObjectInstance", IN_WORLD, parse_object_instance},
    {"Translate", ANYWHERE, parse_translate},
    {"Scale", ANYWHERE, parse_scale},
    {"Rotate", ANYWHERE, parse_rotate},
    {"LookAt", ANYWHERE, parse_look_at},
    {"Identity", ANYWHERE, parse_identity},
    {"ConcatTransform", ANYWHERE, parse_concat_transform},
    {"CoordinateSystem", ANYWHERE, parse_coordinate_system},
    {"CoordSysTransform", ANYWHERE, parse_coord_sys_transform},
    {"ActiveTransform", ANYWHERE, parse_active_transform},
    {"TransformTimes", BEFORE_WORLD, parse_transform_times},
    {"ReverseOrientation", IN_WORLD, parse_reverse_orientation},
    {"AreaLightSource", IN_WORLD, do_area_light_source},
    {"LightSource", IN_WORLD, do_light_source},
    {"Texture", IN_WORLD, do_texture},
    {"MakeNamedMaterial", IN_WORLD, do_make_named_material},
    {"ObjectBegin", IN_WORLD, parse_object_begin},
    {"ObjectEnd", IN_WORLD, parse_object_end},
    {"Include", ANYWHERE, do_include},
    {"Camera", BEFORE_WORLD, do_camera},
    {"Film", BEFORE_WORLD, do_film},
    {"PixelFilter", BEFORE_WORLD, do_pixel_filter},
    {"Sampler", BEFORE_WORLD, do_sampler},
    {"Accelerator", BEFORE_WORLD, do_accelerator},
    {"Integrator", BEFORE_WORLD, do_integrator},
    {"MediumInterface", ANYWHERE, do_medium_interface},
    {"MakeNamedMedium", ANYWHERE, do_make_named_medium},
    {"ColorSpace", BEFORE_WORLD, do_color_space},
    {"WorldBegin", BEFORE_WORLD, do_world_begin},
    {"WorldEnd", IN_WORLD, do_world_end},
};
enum { N_DIRECTIVES = sizeof DIRECTIVES / sizeof DIRECTIVES[0] };

static bool unknown_directive(struct parser *p)
{
    const struct token *t = &p->directive;
    char found[64];
    token_text(t, found, sizeof found);
    if (t->kind != TOKEN_WORD)
        return place_error(&p->messages, t->place, "here should be a directive like Shape, not %s", found);
    struct suggestion near = suggest_start(t->text);
    for (int i = 0; i < N_DIRECTIVES; i++)
        suggest_offer(&near, DIRECTIVES[i].name);
    if (near.name != NULL)
        return place_error(&p->messages, t->place, "unknown directive %s; did you mean %s?", found, near.name);
    return place_error(&p->messages, t->place, "unknown directive %s; doc/scene-format.md lists them", found);
}

static bool wrong_phase(struct parser *p, const struct directive *d)
{
    const struct place at = p->directive.place;
    if (p->phase == AFTER_WORLD)
        return place_error(&p->messages, at, "%s after WorldEnd; a file describes one world", d->name);
    if (d->run == do_world_begin)
        return place_error(&p->messages, at, "a second WorldBegin; a file describes one world");
    if (d->phase == IN_WORLD)
        return place_error(&p->messages, at, "%s may stand only between WorldBegin and WorldEnd; move it there",
                           d->name);
    return place_error(&p->messages, at, "%s may stand only before WorldBegin; move it there", d->name);
}

/* All directives of the current input. */
static bool run_input(struct parser *p)
{
    struct token *t = &p->directive;
    for (;;) {
        if (!lexer_next(&p->lexer, t))
            return false;
        if (t->kind == TOKEN_END)
            return true;
        int i = 0;
        while (i < N_DIRECTIVES && (t->kind != TOKEN_WORD || strcmp(DIRECTIVES[i].name, t->text) != 0))
            i++;
        if (i == N_DIRECTIVES)
            return unknown_directive(p);
        if ((DIRECTIVES[i].phase & p->phase) == 0)
            return wrong_phase(p, &DIRECTIVES[i]);
        if (!DIRECTIVES[i].run(p))
            return false;
    }
}

/* --- files -------------------------------------------------------------------------------------------- */

/* The text of a file, from memory if it was read before. Returns its number, or -1 with a message in *err. */
static int load(struct parser *p, const char *path, struct error *err)
{
    int known = names_find(&p->files, path);
    if (known >= 0)
        return known;
    struct loaded f;
    f.text = text_read(path, &f.size, err);
    if (f.text == NULL)
        return -1;
    p->file = mem_grow(p->file, &p->file_capacity, (size_t)p->n_files + 1, sizeof *p->file);
    p->file[p->n_files] = f;
    names_add(&p->files, path, p->n_files);
    return p->n_files++;
}

/* Carry out a loaded file. Its path and text live as long as the parser, for all places that point into it. */
static bool run_file(struct parser *p, int file, const char *path, struct place included_at)
{
    struct input *input = arena_alloc(&p->arena, sizeof *input);
    char *kept = arena_alloc(&p->arena, strlen(path) + 1);
    strcpy(kept, path);
    input->path = kept;
    input->text = p->file[file].text;
    input->end = input->text + p->file[file].size;
    input->included_at = included_at;
    struct lexer outer = p->lexer;
    p->lexer = lexer_start(input, &p->arena, &p->messages);
    p->input[p->n_inputs++] = input;
    bool ok = run_input(p);
    p->n_inputs--;
    p->lexer = outer;
    return ok;
}

/* Relative names start in the directory of the main file, wherever the Include stands. */
static bool do_include(struct parser *p)
{
    struct token name;
    if (!parse_string(p, &name, "a file name"))
        return false;
    if (++p->n_includes > MAX_INCLUDES)
        return place_error(&p->messages, name.place, "more than %d includes; join files", MAX_INCLUDES);
    if (p->n_inputs == MAX_INCLUDE_DEPTH)
        return place_error(&p->messages, name.place, "files are nested more than %d deep", MAX_INCLUDE_DEPTH);
    char *path = path_join(p->directory, name.text);
    bool ok = true;
    for (int i = 0; i < p->n_inputs && ok; i++)
        if (strcmp(p->input[i]->path, path) == 0)
            ok = place_error(&p->messages, name.place, "this file is being read already; it cannot include itself");
    struct error inner;
    int file = ok ? load(p, path, &inner) : -1;
    if (ok && file < 0)
        ok = place_error(&p->messages, name.place, "%s", inner.text);
    ok = ok && run_file(p, file, path, name.place);
    free(path);
    return ok;
}

/* The part of a path before its last slash. To be given to free(). */
static char *directory_of(const char *path)
{
    char *directory = mem_copy_text(path), *slash = strrchr(directory, '/');
    if (slash == NULL)
        directory[0] = '\0';
    else
        slash[slash == directory] = '\0';
    return directory;
}

static void start(struct parser *p, const char *path, struct scene *s, const struct warning_sink *sink,
                  struct error *err)
{
    p->scene = s;
    s->width = 1280; /* pbrt-v3's film where there is no Film directive */
    s->height = 720;
    p->messages.err = err;
    p->messages.sink = sink;
    p->directory = directory_of(path);
    p->params.messages = &p->messages;
    p->params.directory = p->directory;
    p->phase = BEFORE_WORLD;
    p->state.ctm = transform_identity();
    p->state.start_active = true;
    p->current_object = p->black_matte = -1;
    p->params.directive = "Material";
    p->params.type = "matte";
    parse_material(p, &p->state.material); /* the material of a shape that comes before any Material */
}

static void finish(struct parser *p)
{
    for (int i = 0; i < p->n_objects; i++)
        shape_list_free(&p->object[i]);
    for (int i = 0; i < p->n_files; i++)
        free(p->file[i].text);
    struct names *const tables[] = {&p->files,     &p->float_textures, &p->spectrum_textures,
                                    &p->materials, &p->systems,        &p->objects};
    for (size_t i = 0; i < sizeof tables / sizeof tables[0]; i++)
        names_free(tables[i]);
    free(p->object);
    free(p->file);
    free(p->system);
    free(p->block);
    free(p->directory);
    params_free(&p->params);
    messages_free(&p->messages);
    arena_free(&p->arena);
    free(p);
}

bool parse_scene(const char *path, struct scene *out, const struct warning_sink *sink, struct error *err)
{
    static const struct place NOWHERE = {NULL, NULL, 0, 0};
    struct parser *p = mem_alloc(1, sizeof *p); /* too large for a small stack: tables of names */
    scene_init(out);
    start(p, path, out, sink, err);
    int file = load(p, path, err);
    bool ok = file >= 0 && run_file(p, file, path, NOWHERE);
    if (ok && p->phase != AFTER_WORLD)
        ok = place_error(&p->messages, p->directive.place, "the file ends without %s; add it",
                         p->phase == BEFORE_WORLD ? "WorldBegin" : "WorldEnd");
    finish(p);
    if (!ok)
        scene_free(out);
    return ok;
}
