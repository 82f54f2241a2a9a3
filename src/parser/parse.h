/* parse.h: what the files of the parser share: the state between two directives, and one function per directive
 * that makes something.
 *
 * parser.c reads files and directives; parse_state.c keeps the graphics state; parse_options.c makes camera, film,
 * filter and settings; parse_texture.c, parse_material.c, parse_light.c and parse_shape.c what the world is made
 * of. Each function finds its parameter list in p->params, type included, and returns false with a message in
 * p->messages.
 *
 * Used by: parser alone; private to it.
 */
#ifndef ASBDPT_PARSE_H
#define ASBDPT_PARSE_H

#include "parser/names.h"
#include "parser/params.h"
#include "scene/scene.h"

enum { MATERIAL_NONE = -1 }; /* Material "none": the shape only separates media, so it is left out */

/* The current AreaLightSource. */
struct area_light {
    bool on, two_sided;
    rgb L;
};

/* What AttributeBegin saves. */
struct graphics_state {
    struct transform ctm; /* current transformation matrix: object to world, before WorldBegin world to camera */
    bool start_active;    /* ActiveTransform: transforms act on the start of the shutter interval */
    int material;         /* index into scene->materials, or MATERIAL_NONE */
    bool reverse;         /* ReverseOrientation */
    struct area_light area;
};

enum block_kind { BLOCK_ATTRIBUTE, BLOCK_TRANSFORM, BLOCK_OBJECT };

/* An open AttributeBegin, TransformBegin or ObjectBegin. */
struct block {
    enum block_kind kind;
    struct place place;
    struct graphics_state saved;
    int n_float_textures, n_spectrum_textures, n_materials; /* named so far */
};

/* One Shape directive; kept where it belongs to an object, to be added once per instance. */
struct shape_item {
    bool is_mesh;
    struct mesh mesh;       /* owned */
    struct quadric quadric; /* to_world not yet set */
    struct shape_group group;
    struct transform to_world;
    bool reverse;
    struct area_light area;
    struct place place;
};

struct shape_list {
    struct shape_item *item; /* [n], owned with their meshes */
    int n;
    size_t capacity;
};

enum { CONSTANTS = 256, MAX_INCLUDE_DEPTH = 32 };

/* Where a directive may stand. */
enum phase { BEFORE_WORLD = 1, IN_WORLD = 2, AFTER_WORLD = 4, ANYWHERE = BEFORE_WORLD | IN_WORLD };

/* A file in memory. */
struct loaded {
    char *text; /* owned */
    size_t size;
};

struct parser {
    struct scene *scene;
    struct messages messages;
    struct arena arena; /* texts of tokens, inputs */
    char *directory;    /* of the main file; owned */
    struct lexer lexer;
    struct params params;
    enum phase phase;
    struct token directive; /* the one being carried out */

    const struct input *input[MAX_INCLUDE_DEPTH]; /* files being read, main file first */
    int n_inputs, n_includes;
    struct names files;  /* path -> file[]: a file included twice is read once */
    struct loaded *file; /* [n_files], owned */
    int n_files;
    size_t file_capacity;

    struct graphics_state state;
    struct block *block; /* [n_blocks], the open ones, innermost last, owned */
    int n_blocks;
    size_t block_capacity;

    struct names float_textures, spectrum_textures, materials; /* scoped */
    struct names systems;                                      /* -> system[] */
    struct transform *system;                                  /* [n_systems], owned */
    int n_systems;
    size_t system_capacity;
    struct names objects;      /* -> object[] */
    struct shape_list *object; /* [n_objects], owned */
    int n_objects;
    size_t object_capacity;
    int current_object; /* between ObjectBegin and ObjectEnd, else -1 */

    int constant[CONSTANTS]; /* textures made for numbers, by hash, plus 1: equal ones are shared */
    int black_matte;         /* material of a light without material; -1 before the first */
};

/* The arguments of the current directive. parse_string: one quoted string, `what` says which. parse_numbers: n
 * numbers, with or without brackets around them. parse_list: the parameter list of an object of the given type,
 * into p->params. parse_typed: "type" and its list. All return false with a message of what was wanted. */
bool parse_string(struct parser *p, struct token *out, const char *what);
bool parse_numbers(struct parser *p, double *out, int n);
bool parse_list(struct parser *p, const char *directive, const struct token *type);
bool parse_typed(struct parser *p);

/* parse_no_such: "there is no WHAT "NAME"; ..." with the nearest known one. Returns false. */
bool parse_no_such(struct parser *p, const struct token *name, const struct names *table, const char *what);

/* parse_name: the index of params.type in a NULL-terminated list, or -1 with a message, which differs for the
 * names of pbrt-v3 that are left out here and for typos. */
int parse_name(struct parser *p, const char *const *known, const char *const *refused);

/* parse_constant: a constant texture. */
int parse_constant(struct parser *p, rgb value);

/* parse_float_texture, parse_rgb_texture: the texture number of a parameter given as a number, a colour or the name
 * of a texture; of the default where it is absent. The _or form returns `otherwise` then. */
int parse_float_texture(struct parser *p, const char *name, double fallback);
int parse_float_texture_or(struct parser *p, const char *name, int otherwise);
int parse_rgb_texture(struct parser *p, const char *name, rgb fallback);

/* parse_texture: Texture "name" "type" "class". `type` is float, spectrum or color, the class is params.type. */
bool parse_texture(struct parser *p, const char *name, const char *type, struct place type_place);

/* parse_material: make a material of kind params.type. *out is its number or MATERIAL_NONE. */
bool parse_material(struct parser *p, int *out);

/* The directives that change the graphics state; parse_state.c. */
bool parse_identity(struct parser *p);
bool parse_translate(struct parser *p);
bool parse_scale(struct parser *p);
bool parse_rotate(struct parser *p);
bool parse_look_at(struct parser *p);
bool parse_transform(struct parser *p);
bool parse_concat_transform(struct parser *p);
bool parse_coordinate_system(struct parser *p);
bool parse_coord_sys_transform(struct parser *p);
bool parse_active_transform(struct parser *p);
bool parse_transform_times(struct parser *p);
bool parse_attribute_begin(struct parser *p);
bool parse_attribute_end(struct parser *p);
bool parse_transform_begin(struct parser *p);
bool parse_transform_end(struct parser *p);
bool parse_reverse_orientation(struct parser *p);
bool parse_object_begin(struct parser *p);
bool parse_object_end(struct parser *p);
bool parse_object_instance(struct parser *p);
void parse_name_system(struct parser *p, const char *name, struct transform t);
bool parse_all_closed(struct parser *p); /* false, with a message, if a block is still open */

bool parse_light(struct parser *p);
bool parse_area_light(struct parser *p, struct area_light *out);

/* parse_shape: add a shape to the scene or to the current object. */
bool parse_shape(struct parser *p);

/* parse_shape_add: add one shape to the scene. A mesh inside the item stays the caller's. */
bool parse_shape_add(struct parser *p, const struct shape_item *item, struct transform to_world, struct place at);
void shape_list_free(struct shape_list *list);

bool parse_camera(struct parser *p);
bool parse_film(struct parser *p);
bool parse_filter(struct parser *p);
bool parse_sampler(struct parser *p);
bool parse_accelerator(struct parser *p);
bool parse_integrator(struct parser *p);

#endif
