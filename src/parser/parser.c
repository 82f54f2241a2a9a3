/* parser.c: files and directives. A directive is a row of a table with a function; those that change the graphics
 * state are in parse_state.c, what the others make is made in parse_*.c. See parser.h, and parse.h for the state. */
#include "parser/parser.h"

#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "parser/parse.h"

/* Files may be included again and again, and include others that are. */
enum { MAX_INCLUDES = 65536 };

/* --- the world ---------------------------------------------------------------------------------------- */

static bool world_begin(struct parser *p)
{
    p->phase = IN_WORLD;
    p->has_camera = false;
    if (p->moved.position.file != NULL)
        source_warn(&p->messages, p->moved.position, "after Camera, %s does not move the camera; write it before "
                    "Camera", p->moved.text);
    scene_set_origin(p->scene);
    parse_state_reset(p);
    parse_begin_media(p);
    parse_name_system(p, "world", p->place.at);
    return true;
}

static bool world_end(struct parser *p)
{
    p->phase = AFTER_WORLD;
    parse_close_all(p);
    parse_settle_media(p);
    return true;
}

static bool include(struct parser *p);

static const struct directive FILE_DIRECTIVES[] = {{"Include", ANYWHERE, include, NULL},
                                                   {"WorldBegin", BEFORE_WORLD, world_begin, NULL},
                                                   {"WorldEnd", IN_WORLD, world_end, NULL}, {.name = NULL}};

/* All directives, the commonest first. */
static const struct directive *const TABLES[] = {SHAPE_DIRECTIVES,   MATERIAL_DIRECTIVES, STATE_DIRECTIVES,
                                                 LIGHT_DIRECTIVES,   TEXTURE_DIRECTIVES,  MEDIUM_DIRECTIVES,
                                                 FILE_DIRECTIVES,    OPTION_DIRECTIVES,   NULL};

/* The directive of this name, or NULL. */
static const struct directive *find_directive(const char *name)
{
    for (const struct directive *const *table = TABLES; *table != NULL; table++)
        for (const struct directive *d = *table; d->name != NULL; d++)
            if (strcmp(d->name, name) == 0)
                return d;
    return NULL;
}

/* No directive: an error. Returns the one that was meant, if there is one that is near. */
static const struct directive *unknown_directive(struct parser *p)
{
    const struct token *t = &p->directive;
    char found[64];
    token_text(t, found, sizeof found);
    if (t->kind != TOKEN_WORD) {
        source_error(&p->messages, t->position, "here should be a directive like Shape, not %s", found);
        return NULL;
    }
    struct near near = parse_near(p, t->text);
    for (const struct directive *const *table = TABLES; *table != NULL; table++)
        for (const struct directive *d = *table; d->name != NULL; d++)
            near_try(&near, d->name);
    source_error(&p->messages, t->position, "unknown directive %s%s; doc/scene-format.md lists those of pbrt-v3%s",
                 found, parse_foreign_directive(t->text).text, near.text);
    return near.name != NULL ? find_directive(near.name) : NULL;
}

static bool wrong_phase(struct parser *p, const struct directive *d)
{
    source_warn(&p->messages, p->directive.position,
                "%s is passed over, as in pbrt-v3: it may come only %s WorldBegin%s", d->name,
                d->phase == IN_WORLD ? "between" : "before", d->phase == IN_WORLD ? " and WorldEnd" : "");
    return false;
}

static bool run_directive(struct parser *p)
{
    const struct token *t = &p->directive;
    const struct directive *d = t->kind == TOKEN_WORD ? find_directive(t->text) : NULL;
    struct source_file *source = p->lexer.file;
    bool known = d != NULL;
    if (!known) /* goes on as if the one that was meant stood there, so that this is the only error */
        d = unknown_directive(p);
    if (d == NULL || !(known || source->is_scene))
        return false;
    source->is_scene = true;
    if ((d->phase & p->phase) == 0)
        return wrong_phase(p, d);
    if (d->types != NULL && !(parse_typed(p) && parse_type(p, d->types)))
        return false;
    return d->run(p);
}

/* All directives, up to the end of the world or to more errors than are told. */
static void run(struct parser *p)
{
    struct token *t = &p->directive;
    while ((p->phase & ANYWHERE) != 0 && p->messages.errors.n + p->messages.errors.more < MOST_ERRORS) {
        bool ok = lexer_next(&p->lexer, t);
        if (ok && t->kind == TOKEN_END) {
            if (p->messages.errors.n == 0)
                directive_error(p, "the file ends without %s; add it, or take a pbrt-v3 scene if it is pbrt-v4's",
                                p->phase == BEFORE_WORLD ? "WorldBegin" : "WorldEnd");
            return;
        }
        ok = ok && run_directive(p);
        if (!t->position.file->is_scene)
            lexer_leave(&p->lexer);
        else if (!ok)
            lexer_resume(&p->lexer);
    }
    if (p->phase == AFTER_WORLD && lexer_peek(&p->lexer) != TOKEN_END)
        source_warn(&p->messages, t->position, "the rest after WorldEnd is not read; a file describes one world");
}

/* --- files -------------------------------------------------------------------------------------------- */

/* The tokens of a text come next, which is given away; NULL: there is none. Its name lives as long as the parser, for
 * all places in it. Returns whether there is one. */
static bool enter(struct parser *p, const char *path, char *text, size_t size)
{
    if (text == NULL)
        return false;
    struct source_file *source = arena_alloc(&p->arena, sizeof *source);
    *source = (struct source_file){arena_text(&p->arena, path), text, text + size, p->lexer.file == NULL};
    lexer_enter(&p->lexer, source);
    return true;
}

/* The same of a file. False with a message in *err if it cannot be read. */
static bool enter_file(struct parser *p, const char *path, struct error *err)
{
    size_t size;
    char *text = scene_files_read(&p->named, path, &size, err);
    return enter(p, path, text, size);
}

/* Relative names start in the directory of the main file, wherever the Include stands. */
static bool include(struct parser *p)
{
    struct token name;
    if (!parse_string(p, &name, "a file name"))
        return false;
    if (++p->n_includes > MAX_INCLUDES)
        return source_error(&p->messages, name.position, "more than %d includes; join files", MAX_INCLUDES);
    if (p->lexer.depth + 1 == MAX_INCLUDE_DEPTH)
        return source_error(&p->messages, name.position, "files are nested more than %d deep", MAX_INCLUDE_DEPTH);
    struct error inner;
    char *path = scene_files_path(&p->named, name.text, &inner);
    bool ok = path != NULL && enter_file(p, path, &inner);
    if (!ok)
        source_error(&p->messages, name.position, "%s", inner.text);
    free(path);
    return ok;
}

static void start(struct parser *p, const char *path, struct scene *s, const struct message_sink *sink,
                  struct error *err)
{
    p->scene = s;
    p->messages.err = err;
    p->messages.sink = sink;
    p->lexer.arena = &p->arena;
    p->lexer.messages = &p->messages;
    p->params.messages = &p->messages;
    p->params.arena = &p->arena;
    p->params.files = &p->named;
    p->named.scene_path = path;
    p->named.content = &s->content;
    symbols_add(&p->named.paths, path, 0);
    p->named.memory = &s->memory;
    p->phase = BEFORE_WORLD;
    p->times[1] = 1;
    parse_state_reset(p);
    p->current_object = -1;
    p->state.medium[0].text = p->state.medium[1].text = "";
    p->params.directive = "Material";
    p->params.type = "matte";
    parse_make_material(p, &p->state.material); /* the material of a shape that comes before any Material */
}

static void finish(struct parser *p)
{
    struct scene *s = p->scene;
    while (p->lexer.file != NULL)
        lexer_leave(&p->lexer);
    s->file = mem_alloc((size_t)p->named.paths.n, sizeof *s->file);
    for (; s->n_files < p->named.paths.n; s->n_files++)
        s->file[s->n_files] = mem_copy_text(p->named.paths.entry[s->n_files].name);
    const long n_warnings = p->messages.warnings.n + p->messages.warnings.more;
    for (int i = 0; i < p->objects.n; i++)
        shape_list_free(&p->object[i]);
    struct symbols *const tables[] = {&p->float_textures, &p->spectrum_textures, &p->materials, &p->systems,
                                      &p->media.known,    &p->objects,           &p->places,
                                      &p->named.paths,    &p->images,            &p->tables,    &p->maps};
    for (size_t i = 0; i < sizeof tables / sizeof tables[0]; i++)
        symbols_free(tables[i]);
    free(p->object);
    free(p->system);
    free(p->block);
    free(p->saved);
    free(p->material);
    params_free(&p->params);
    messages_end(&p->messages);
    s->n_warnings = n_warnings; /* not those that say how many more there were */
    arena_free(&p->arena);
    free(p);
}

bool parse_scene(const char *path, const struct parse_options *options, struct scene *out,
                 const struct message_sink *sink, struct error *err)
{
    static const struct parse_options none;
    struct parser *p = mem_alloc(1, sizeof *p); /* too large for a small stack: tables of names */
    struct error first;
    scene_init(out);
    options = options != NULL ? options : &none;
    p->integrator = options->integrator;
    out->memory = budget_new(options->max_memory, "; --max-memory raises the limit");
    start(p, path, out, sink, err != NULL ? err : &first);
    size_t size = options->length;
    char *text = options->text != NULL ? scene_files_copy(&p->named, path, options->text, size, p->messages.err)
                                       : scene_files_read(&p->named, path, &size, p->messages.err);
    if (enter(p, path, text, size))
        run(p);
    else
        messages_report(&p->messages);
    bool ok = p->messages.errors.n == 0;
    finish(p);
    if (!ok)
        scene_free(out);
    return ok;
}
