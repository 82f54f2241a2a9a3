/* parse_shape.c: shapes, with pbrt-v3's parameters and defaults [pbrt-v3 shapes/]. See parse.h. */
#include "parser/parse.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/mesh.h"

/* --- quadrics ----------------------------------------------------------------------------------------- */

static struct quadric *quadric_of(struct parser *p, void *object)
{
    struct quadric *s = &((struct shape_item *)object)->quadric;
    s->kind = (enum quadric_kind)p->type.kind;
    s->phi_max = s->phi_max * PI / 180;
    return s;
}

/* The part between two heights. */
static void heights(struct params *q, struct quadric *s, double low, double high)
{
    double a = params_number(q, "zmin", low, -NUMBER_MAX, NUMBER_MAX);
    double b = params_number(q, "zmax", high, -NUMBER_MAX, NUMBER_MAX);
    s->zmin = a;
    s->zmax = b;
    quadric_normalise(s);
    if (!(s->zmin < s->zmax))
        type_error(q, "\"zmin\" %g and \"zmax\" %g leave nothing of this %s", a, b, q->type);
}

static void sphere(struct parser *p, void *object)
{
    struct quadric *s = quadric_of(p, object);
    heights(&p->params, s, -s->radius, s->radius);
}

static void cylinder(struct parser *p, void *object)
{
    heights(&p->params, quadric_of(p, object), -1, 1);
}

static void disk(struct parser *p, void *object)
{
    struct quadric *s = quadric_of(p, object);
    s->zmax = s->zmin;
    if (!(s->inner_radius < s->radius))
        type_error(&p->params, "\"innerradius\" %g must be less than \"radius\" %g", s->inner_radius, s->radius);
}

/* pbrt-v3 has no sampling of some shapes, so no light can sit on them. */
static void must_not_shine(struct parser *p)
{
    if (p->state.area.on)
        type_error(&p->params, "a %s cannot be an area light, here as in pbrt-v3; end the AreaLightSource before it",
                   p->params.type);
}

static struct quadric *unlit_quadric(struct parser *p, void *object)
{
    must_not_shine(p);
    return quadric_of(p, object);
}

static void cone(struct parser *p, void *object) { unlit_quadric(p, object); }

static void paraboloid(struct parser *p, void *object)
{
    struct quadric *s = unlit_quadric(p, object);
    heights(&p->params, s, 0, 1);
    if (!(s->zmax > 0))
        type_error(&p->params, "\"zmin\" and \"zmax\" are at most 0; a paraboloid opens upwards from 0");
}

static void hyperboloid(struct parser *p, void *object)
{
    struct quadric *s = unlit_quadric(p, object);
    if (s->p1.z == s->p2.z)
        type_error(&p->params, "\"p1\" and \"p2\" have the same height %g; what turns there is a \"disk\"", s->p1.z);
}

#define AT(member) offsetof(struct shape_item, quadric.member)
static const struct field SPHERE[] = {
    {"radius", FIELD_NUMBER, AT(radius), 1, NUMBER_MIN, .high = NUMBER_MAX},
    {"phimax", FIELD_NUMBER, AT(phi_max), 360, NUMBER_MIN, .high = NUMBER_MAX}, /* degrees */
    {.name = "zmin"}, {.name = "zmax"},
    {.name = NULL}};
static const struct field DISK[] = {
    {"radius", FIELD_NUMBER, AT(radius), 1, NUMBER_MIN, .high = NUMBER_MAX},
    {"phimax", FIELD_NUMBER, AT(phi_max), 360, NUMBER_MIN, .high = NUMBER_MAX}, /* degrees */
    {"innerradius", FIELD_NUMBER, AT(inner_radius), 0, 0, .high = NUMBER_MAX},
    {"height", .kind = FIELD_NUMBER, .place = AT(zmin)},
    {.name = NULL}};
static const struct field CONE[] = {
    {"radius", FIELD_NUMBER, AT(radius), 1, NUMBER_MIN, .high = NUMBER_MAX},
    {"phimax", FIELD_NUMBER, AT(phi_max), 360, NUMBER_MIN, .high = NUMBER_MAX}, /* degrees */
    {"height", FIELD_NUMBER, AT(zmax), 1, NUMBER_MIN, .high = NUMBER_MAX},
    {.name = NULL}};
static const struct field HYPERBOLOID[] = {
    {"p1", .kind = FIELD_POINT, .place = AT(p1)},
    {"p2", FIELD_POINT, AT(p2), .fallback = 1},
    {"phimax", FIELD_NUMBER, AT(phi_max), 360, NUMBER_MIN, .high = NUMBER_MAX}, /* degrees */
    {.name = NULL}};

static const struct object_type QUADRICS[] = {
    {"sphere", SPHERE, QUADRIC_SPHERE, sphere},
    {"disk", DISK, QUADRIC_DISK, disk},
    {"cylinder", SPHERE, QUADRIC_CYLINDER, cylinder},
    {"cone", CONE, QUADRIC_CONE, cone},
    {"paraboloid", SPHERE, QUADRIC_PARABOLOID, paraboloid},
    {"hyperboloid", HYPERBOLOID, QUADRIC_HYPERBOLOID, hyperboloid}};
enum { N_QUADRICS = sizeof QUADRICS / sizeof QUADRICS[0] };

/* --- meshes ------------------------------------------------------------------------------------------- */

/* Where a message about a parameter, or about all of them (NULL), points. */
static struct source_position place_of(struct params *q, const char *name)
{
    const struct param *item = name != NULL ? params_ignore(q, name) : NULL;
    return item != NULL ? item->position : q->position;
}

static void warn(const struct mesh_task *task, const char *format, ...)
{
    struct params *q = &((struct parser *)task->context)->params;
    char text[ERROR_TEXT_SIZE / 2];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    source_warn(q->messages, place_of(q, task->about), "%s", text);
}

/* The texture of where there are holes; -1 if there are none: of numbers 0 alone makes a hole. */
static int alpha(struct parser *p, const char *name)
{
    int texture = parse_named_texture(p, name, true);
    bool hole = texture < 0 && params_number(&p->params, name, 1, -NUMBER_MAX, NUMBER_MAX) == 0;
    return hole ? parse_constant(p, rgb_black()) : texture;
}

static bool count_file(struct params *q, const struct mesh *m, struct error *err)
{
    return m->file_size == 0 || scene_files_count(q->files, m->content, m->file_size, err);
}

static void mesh(struct parser *p, struct shape_item *item)
{
    const struct shape_row *row = shape_rows[p->type.kind - N_QUADRICS];
    struct params *q = &p->params;
    struct mesh_task task = {
        .shape = row->name, .room = MESH_MAX_SUBDIVIDED - p->n_subdivided, .warn = warn, .context = p};
    void *fields = mem_alloc(1, row->size);
    item->is_mesh = true;
    if (!row->may_shine)
        must_not_shine(p);
    parse_fields(p, fields);
    if (!q->failed && (!row->mesh(fields, &task, &item->mesh) || !count_file(q, &item->mesh, &task.err)))
        params_fail(q, place_of(q, task.about), "%s", task.err.text);
    p->n_subdivided = MESH_MAX_SUBDIVIDED - task.room;
    free(fields);
    if (row->may_have_holes) {
        item->group.alpha = alpha(p, "alpha");
        item->group.shadow_alpha = alpha(p, "shadowalpha");
    }
}

void parse_shape_types(struct object_type out[MOST_TYPES])
{
    memcpy(out, QUADRICS, sizeof QUADRICS);
    for (int i = 0; i < MOST_TYPES - N_QUADRICS; i++) {
        out[N_QUADRICS + i] = (struct object_type){.kind = N_QUADRICS + i};
        if (shape_rows[i] == NULL)
            break;
        out[N_QUADRICS + i].name = shape_rows[i]->name;
        out[N_QUADRICS + i].fields = shape_rows[i]->fields;
    }
}

/* --- the directive ------------------------------------------------------------------------------------ */

/* Is there anything to be seen of it? What has no material bounds media, of which there are none here. */
static bool is_seen(const struct shape_item *item)
{
    bool empty = item->is_mesh && item->mesh.n_triangles == 0;
    return !empty && (item->group.material != MATERIAL_NONE || item->area.on);
}

static bool shape(struct parser *p)
{
    struct object_type types[MOST_TYPES];
    parse_shape_types(types);
    if (!parse_typed(p) || !parse_type(p, types))
        return false;
    struct shape_item item = {.to_world = p->place.ctm, .reverse = p->state.reverse, .area = p->state.area};
    item.group.alpha = item.group.shadow_alpha = item.group.first_light = -1;
    if (p->type.kind < N_QUADRICS)
        parse_fields(p, &item);
    else
        mesh(p, &item);
    item.group.material = parse_changed_material(p);
    bool ok = parse_done(p) && parse_placed(p);
    if (ok && is_seen(&item)) {
        if (item.area.on && item.area.group < 0)
            item.area.group = light_group(&p->scene->lights, NULL, LIGHT_AREA);
        return parse_place_shape(p, &item);
    }
    mesh_free(&item.mesh);
    return ok;
}

const struct directive SHAPE_DIRECTIVES[] = {{"Shape", IN_WORLD, shape, NULL}, {.name = NULL}};
