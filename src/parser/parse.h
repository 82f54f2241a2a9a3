/* parse.h: what the files of the parser share: the state between two directives, the tables of what each type of
 * object is made of, and one function per directive.
 *
 * A directive finds its parameter list in p->params, type included, and returns false where it gives up, with an error
 * or, where pbrt-v3 goes on, a warning in p->messages. What has failed is still there under its name, as something
 * plain, so that one error does not cause others. Private to this module. */
#ifndef ASBDPT_PARSE_H
#define ASBDPT_PARSE_H

#include "base/field.h"
#include "base/near.h"
#include "base/number.h"
#include "parser/params.h"
#include "parser/symbols.h"
#include "scene/scene.h"

/* Material "none": rays pass through; a shape that does not shine either is left out. The one that the parser starts
 * with. */
enum { MATERIAL_NONE = -1, MATERIAL_MATTE = 0 };

/* The current AreaLightSource. */
struct area_light {
    bool on, two_sided, hidden;
    rgb L;
    int group; /* -1: one for each shape */
};

/* A material, and what it was made from, for shapes that change parameters of it. */
struct material_source {
    int id;           /* index into scene->materials, or MATERIAL_NONE */
    const char *type; /* "matte" */
    struct param_list list;
};

/* What every block saves. */
struct transform_state {
    struct transform ctm; /* object to the file's world, before WorldBegin that to camera; of use where parse_placed
                           * says so */
    struct token made_by; /* the last directive to change a usable ctm: if it is of no use, the culprit */
    struct transform at[2]; /* at the two times of TransformTimes; ctm is that when the shutter opens */
    bool active[2];       /* ActiveTransform: transforms act on these */
    bool turns;           /* the shutter opens between them, and they differ in more than where things are */
};

/* What AttributeBegin and ObjectBegin save in addition. */
struct graphics_state {
    struct material_source material;
    bool reverse; /* ReverseOrientation */
    struct area_light area;
    struct token medium[2]; /* of MediumInterface: names of inside and outside, "" for none */
};

enum block_kind { BLOCK_ATTRIBUTE, BLOCK_TRANSFORM, BLOCK_OBJECT };

/* An open block, and what its end restores. */
struct block {
    enum block_kind kind;
    struct source_position position;
    struct transform_state place;
};

/* The same of those blocks that are not transforms' alone. Like pbrt-v3's two stacks, both know no kinds: an end closes
 * the innermost block. */
struct saved_state {
    struct graphics_state state;
    int n_float_textures, n_spectrum_textures, n_materials; /* named so far */
};

/* One Shape directive; stored where it belongs to an object, to be added where instances place it. */
struct shape_item {
    bool is_mesh;
    struct mesh mesh;       /* owned */
    struct quadric quadric; /* to_world not yet set */
    struct shape_group group;
    struct transform place; /* object to the file's world */
    bool reverse;
    struct area_light area;
};

struct shape_list {
    struct shape_item *item; /* [n], owned with their meshes */
    int n;
    int n_instances;
    int shared;  /* those of them that instances share: the number of that object; -1: there are none yet */
    vec3 origin; /* of its space in the object's */
};

enum { MAX_INCLUDE_DEPTH = 32 };

/* Where a directive may be. */
enum phase { BEFORE_WORLD = 1, IN_WORLD = 2, AFTER_WORLD = 4, ANYWHERE = BEFORE_WORLD | IN_WORLD };

struct parser;

/* One type of object of a directive. A table of them ends with one without a name. */
struct object_type {
    const char *name;
    const struct field *fields; /* ended by one without a name */
    int kind;                   /* LIGHT_POINT, or the number of a row, and so on */
    void (*build)(struct parser *p, void *object); /* what no table can express, once it is read; or NULL */
};

struct parser {
    struct scene *scene;
    const char *integrator; /* that the user has named, or NULL */
    struct messages messages;
    struct arena arena; /* texts of tokens, source files */
    struct lexer lexer; /* of the files being read */
    struct params params;
    enum phase phase;
    struct token directive;         /* the one being carried out */
    bool has_camera;                /* before the world begins; */
    struct token moved;             /* then the first to change a transform that nobody has used; no file: none */
    struct object_type type;        /* what its params.type stands for */

    int n_includes;
    struct scene_files named; /* what may be read, and how often */
    struct symbols images, tables, maps; /* paths -> textures.image[], table[], lights.map[] of scene */

    struct transform_state place;
    double times[2], shutter; /* of TransformTimes; when the shutter opens */
    struct graphics_state state;
    struct block *block;       /* [n_blocks], innermost last, owned */
    struct saved_state *saved; /* [n_saved] */
    int n_blocks, n_saved;

    struct symbols float_textures, spectrum_textures, materials; /* scoped; materials -> material[] */
    struct material_source *material;                            /* [n_materials], owned */
    int n_materials;
    struct symbols systems;                                      /* -> system[] */
    struct transform (*system)[2];                               /* [systems.n], at both times; owned */
    struct symbols objects;    /* -> object[] */
    struct shape_list *object; /* [objects.n], owned */
    struct {
        struct symbols known;           /* -> scene->space->medium[], from 1; 0: nothing */
        bool seen;                      /* by the integrator, once the world begins */
        struct source_position used_at; /* the last that a MediumInterface names; no file: none */
    } media;
    int current_object; /* between ObjectBegin and ObjectEnd, else -1 */
    struct symbols places; /* hashes of shapes and instances in the world -> their lines */
    int64_t n_copied;    /* triangles and quadrics of all instances that are copies */

    bool texture_is_float; /* of the Texture directive being carried out */
    int n_sought;          /* names that were none, for which near ones were looked for */
};

/* parse_near: a name that is none is about to be compared with those that there are, unless that has been done for
 * MOST_SOUGHT names already. parse_near_symbol: compared with the newest MOST_COMPARED of a table. Files of nothing but
 * mistakes are read as fast as others. */
enum { MOST_SOUGHT = 100, MOST_COMPARED = 1000 };
struct near parse_near(struct parser *p, const char *name);
struct near parse_near_symbol(struct parser *p, const char *name, const struct symbols *table);

/* What is to be said of a name that only pbrt-v4 has: ": it is pbrt-v4's; here that is ...", else "".
 *   fields  those of the type that the parameter was given to */
struct foreign {
    char text[160];
};
struct foreign parse_foreign_directive(const char *name);
struct foreign parse_foreign_type(const char *directive, const char *name);
struct foreign parse_foreign_parameter(const char *directive, const char *name, const struct field *fields);

/* parse_type: find params.type in a table and set p->type. False with a message.
 * parse_fields: read the parameters of p->type into *object, in the table's order, and build the rest of it.
 * parse_done: warn of the parameters that nobody has asked for. False if anything failed.
 * parse_object: both. */
bool parse_type(struct parser *p, const struct object_type *types);
void parse_fields(struct parser *p, void *object);
bool parse_done(struct parser *p);
bool parse_object(struct parser *p, void *object);

/* A message at the directive, or at the type of the list. Both return false. */
#define directive_error(p, ...) source_error(&(p)->messages, (p)->directive.position, __VA_ARGS__)
#define type_error(q, ...) params_fail(q, (q)->position, __VA_ARGS__)

/* The arguments of the current directive. parse_string: one quoted string, `what` says which. parse_list: the
 * parameter list of an object of the given type, into p->params. parse_typed: "type" and its list. parse_named: the
 * number of what the one argument names, *name; -1 if there is no WHAT of this name, and what is done instead. All say
 * what was wanted where they fail. */
bool parse_string(struct parser *p, struct token *out, const char *what);
bool parse_list(struct parser *p, const char *directive, const struct token *type);
bool parse_typed(struct parser *p);
int parse_named(struct parser *p, struct token *name, const struct symbols *table, const char *what,
                const char *instead);

/* parse_to_world: what a transform of the file does, into world space (scene_set_origin).
 * parse_placed: can anything stand where the current transform puts it? False if not, with a message, which is the last
 * about this transform. */
struct transform parse_to_world(const struct parser *p, struct transform t);
bool parse_placed(struct parser *p);

/* parse_constant: a constant texture. parse_named_texture: that of "texture NAME"; -1 without such a parameter or, with
 * a warning, such a texture, which is `unknown`: the
 * default counts then, as in pbrt-v3, even if there is a value of this name. */
int parse_constant(struct parser *p, rgb value);
int parse_named_texture(struct parser *p, const char *name, bool is_float, bool *unknown);

/* parse_file: the number of what is in the file that a parameter names, -1 if it names none or, with an error, cannot
 * be read. `read` is called for the first one who names it; its number is then found among those that are known.
 * parse_picture: what all readers of pictures do: count one, with the bytes of tables that were made for it, and warn
 * of what is no light in it. False with a message in *err if that is too much. */
typedef int file_reader(struct parser *p, const char *path, struct source_position at, struct error *err);
int parse_file(struct parser *p, const char *name, struct symbols *known, file_reader *read);
bool parse_picture(struct parser *p, struct source_position at, const struct image *image, size_t tables,
                   struct error *err);

/* parse_part: the material that a parameter names. parse_fourier_table: that of the file that a parameter names. */
int parse_part(struct parser *p, const char *field);
const struct fourier_table *parse_fourier_table(struct parser *p, const char *field);

/* parse_make_material: a material of kind params.type.
 * parse_changed_material: the number of the current material, or, if the shape in p->params has parameters that it has
 * no use for, of one like it that looks up its parameters in the shape's list and then in the material's, as pbrt-v3
 * does. */
bool parse_make_material(struct parser *p, struct material_source *out);
int parse_changed_material(struct parser *p);

/* parse_begin_media: the world begins: are media to be seen? parse_medium: the number of the medium inside (0) or
 * outside (1) of objects here, looked up by its name, as pbrt-v3 does; 0 with a message if it cannot be rendered.
 * parse_settle_media: the world is complete. */
void parse_begin_media(struct parser *p);
int parse_medium(struct parser *p, int side);
void parse_settle_media(struct parser *p);

/* parse_state_reset: the transform as a file or its world begins. parse_open_shutter: when it opens.
 * parse_name_system: name a coordinate system, which is that of the two transforms.
 * parse_open_block, parse_close_block: save the graphics state and restore what was saved last, with a warning if that
 * was another kind of block; false, with a warning, if nothing was. parse_close_all: warn of blocks that are open. */
void parse_state_reset(struct parser *p);
void parse_open_shutter(struct parser *p, double time);
void parse_name_system(struct parser *p, const char *name, const struct transform at[2]);
bool parse_open_block(struct parser *p, enum block_kind kind);
bool parse_close_block(struct parser *p, enum block_kind kind);
void parse_close_all(struct parser *p);

void shape_list_free(struct shape_list *list);

/* One directive. A table of them ends with one without a name. */
struct directive {
    const char *name;
    enum phase phase;
    bool (*run)(struct parser *p);
    const struct object_type *types; /* of a directive "type" parameters: in p->type when run is called. NULL: run reads
                                      * all of it */
};

extern const struct directive STATE_DIRECTIVES[], OPTION_DIRECTIVES[], TEXTURE_DIRECTIVES[], MATERIAL_DIRECTIVES[],
    LIGHT_DIRECTIVES[], SHAPE_DIRECTIVES[], MEDIUM_DIRECTIVES[];
extern const struct object_type TEXTURE_TYPES[]; /* whose directive reads more than type and list */

/* parse_material_types, parse_shape_types: rows, of shapes the quadrics, too, as types, ended by one without a name. */
enum { MOST_TYPES = 32 };
void parse_material_types(struct object_type out[MOST_TYPES]);
void parse_shape_types(struct object_type out[MOST_TYPES]);

#endif
