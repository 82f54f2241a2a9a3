/* parse_material.c: materials and their names: rows (material/material.h), read by their fields. See parse.h. */
#include "parser/parse.h"

#include <stdlib.h>
#include <string.h>

#include "material/fourier.h"

int parse_part(struct parser *p, const char *field)
{
    struct source_position at = p->params.position;
    const char *name = params_text(&p->params, field, PARAM_STRING, &at);
    int k = name != NULL ? symbols_find(&p->materials, name) : -1;
    if (k < 0 && !p->params.failed)
        source_warn(&p->messages, at, "\"%s\" of a %s names no material; a matte one is taken%s", field,
                    p->params.type, parse_near_symbol(p, name != NULL ? name : "", &p->materials).text);
    else if (k >= 0 && p->material[k].id == MATERIAL_NONE)
        params_fail(&p->params, at, "\"%s\" of a %s must not be \"none\"", field, p->params.type);
    return k >= 0 ? p->material[k].id : MATERIAL_MATTE;
}

static int read_table(struct parser *p, const char *path, struct source_position at, struct error *err)
{
    struct scene *s = p->scene;
    struct fourier_table *t = mem_alloc(1, sizeof *t);
    (void)at;
    s->table = mem_append(s->table, (size_t)s->n_tables, sizeof *s->table);
    s->table[s->n_tables++] = t;
    return fourier_read(path, t, err) && scene_files_count(&p->named, t->content, (double)t->file_size, err)
               ? s->n_tables - 1 : -1;
}

const struct fourier_table *parse_fourier_table(struct parser *p, const char *field)
{
    struct params *q = &p->params;
    int i = parse_file(p, field, &p->tables, read_table);
    if (i < 0)
        type_error(q, "a %s material needs its table: add \"string %s\" \"...\"", q->type, field);
    return i >= 0 ? p->scene->table[i] : NULL;
}

void parse_material_types(struct object_type out[MOST_TYPES])
{
    for (int i = 0; i < MOST_TYPES; i++) {
        out[i] = (struct object_type){.kind = i};
        if (material_rows[i] == NULL)
            break;
        out[i].name = material_rows[i]->name;
        out[i].fields = material_rows[i]->fields;
    }
}

static bool is_none(const char *type) { return type[0] == '\0' || strcmp(type, "none") == 0; }

/* A kind that nobody knows is a matte one, as in pbrt-v3; not one that pbrt-v3 has, or pbrt-v4. */
static void settle_kind(struct parser *p, const struct object_type *types)
{
    struct params *q = &p->params;
    bool known = strcmp(q->type, "hair") == 0 || parse_foreign_type(q->directive, q->type).text[0] != '\0';
    for (const struct object_type *t = types; t->name != NULL; t++)
        known |= strcmp(t->name, q->type) == 0;
    if (known)
        return;
    struct near near = parse_near(p, q->type);
    for (; types->name != NULL; types++)
        near_try(&near, types->name);
    source_warn(&p->messages, q->position, "there is no material \"%.40s\"; as in pbrt-v3, it is \"matte\"%s", q->type,
                near.text);
    q->type = "matte";
}

/* A material of kind params.type, whose parameters that nobody has asked for are left. */
static bool make(struct parser *p, int *out)
{
    struct params *q = &p->params;
    *out = MATERIAL_MATTE;
    if (is_none(q->type)) {
        *out = MATERIAL_NONE;
        for (int i = 0; i < q->n; i++)
            q->item[i].used = true; /* nothing is left to use them */
        return true;
    }
    struct object_type types[MOST_TYPES];
    parse_material_types(types);
    settle_kind(p, types);
    if (!parse_type(p, types))
        return false;
    struct material *m = material_new(material_rows[p->type.kind]);
    parse_fields(p, m);
    if (q->failed) {
        free(m);
        return false;
    }
    if (m->row->is_deep != NULL && m->row->is_deep(m, &p->scene->textures))
        source_warn(&p->messages, q->position, "\"%s\" is its surface alone, as in pbrt-v3's \"bdpt\": no light "
                    "goes through what is beneath", q->type);
    *out = scene_add_material(p->scene, m);
    if (m->most_lobes > MATERIAL_MAX_LOBES)
        return source_error(&p->messages, q->position,
                            "this mix has more than %d lobes in all; mix fewer materials", MATERIAL_MAX_LOBES);
    return true;
}

bool parse_make_material(struct parser *p, struct material_source *out)
{
    bool ok = make(p, &out->id) && parse_done(p);
    out->type = p->params.type;
    out->list = params_keep(&p->params);
    return ok;
}

static int n_unused(const struct params *q)
{
    int n = 0;
    for (int i = 0; i < q->n; i++)
        n += !q->item[i].used;
    return n;
}

int parse_changed_material(struct parser *p)
{
    struct params *q = &p->params;
    struct object_type shape = p->type;
    const char *directive = q->directive, *type = q->type;
    int id = p->state.material.id, before = n_unused(q), n_materials = p->scene->n_materials;
    if (q->failed || before == 0 || id == MATERIAL_NONE)
        return id;
    q->directive = "Material";
    q->type = p->state.material.type;
    q->behind = p->state.material.list;
    q->failed = !make(p, &id);
    q->behind.n = 0;
    q->directive = directive;
    q->type = type;
    p->type = shape;
    if (n_unused(q) == before) { /* none was the material's */
        while (p->scene->n_materials > n_materials)
            free(p->scene->material[--p->scene->n_materials]);
        id = p->state.material.id;
    }
    return id;
}

static bool material(struct parser *p) { return parse_typed(p) && parse_make_material(p, &p->state.material); }

static bool make_named_material(struct parser *p)
{
    struct token name;
    if (!parse_string(p, &name, "a name"))
        return false;
    struct material_source made = {.type = ""};
    bool ok = parse_list(p, "Material", &name);
    const char *type = params_text(&p->params, "type", PARAM_STRING, &p->params.position);
    if (type == NULL)
        source_warn(&p->messages, name.position,
                    "MakeNamedMaterial needs its kind: add \"string type\" \"matte\"; \"none\" is taken");
    p->params.type = type != NULL ? type : "";
    ok = ok && parse_make_material(p, &made);
    if (symbols_find(&p->materials, name.text) >= 0)
        source_warn(&p->messages, name.position, "the material \"%.60s\" is defined again", name.text);
    p->material = mem_append(p->material, (size_t)p->n_materials, sizeof *p->material);
    p->material[p->n_materials] = made;
    symbols_add(&p->materials, name.text, p->n_materials++);
    return ok;
}

static bool named_material(struct parser *p)
{
    struct token name;
    int k = parse_named(p, &name, &p->materials, "named material", "the material stays as it is");
    if (k >= 0)
        p->state.material = p->material[k];
    return k >= 0;
}

const struct directive MATERIAL_DIRECTIVES[] = {{"NamedMaterial", IN_WORLD, named_material, NULL},
                                                {"Material", IN_WORLD, material, NULL},
                                                {"MakeNamedMaterial", IN_WORLD, make_named_material, NULL},
                                                {.name = NULL}};
