/* parse_shape.c: shapes, with pbrt-v3's parameters and defaults [pbrt-v3 shapes/], and objects, which each of their
 * instances copies [pbrt-v3 core/api.cpp]. See parse.h. */
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

static void cylinder(struct parser *p, void *object) { heights(&p->params, quadric_of(p, object), -1, 1); }

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
#define RADIUS {"radius", FIELD_NUMBER, AT(radius), 1, NUMBER_MIN, .high = NUMBER_MAX}
#define PHI_MAX {"phimax", FIELD_NUMBER, AT(phi_max), 360, NUMBER_MIN, .high = NUMBER_MAX} /* degrees */
static const struct field SPHERE[] = {RADIUS, PHI_MAX, {.name = "zmin"}, {.name = "zmax"}, {.name = NULL}};
static const struct field DISK[] = {
    RADIUS, PHI_MAX,
    {"innerradius", FIELD_NUMBER, AT(inner_radius), 0, 0, .high = NUMBER_MAX},
    {"height", .kind = FIELD_NUMBER, .place = AT(zmin)}, {.name = NULL}};
static const struct field CONE[] = {
    RADIUS, PHI_MAX,
    {"height", FIELD_NUMBER, AT(zmax), 1, NUMBER_MIN, .high = NUMBER_MAX}, {.name = NULL}};
static const struct field HYPERBOLOID[] = {
    {"p1", .kind = FIELD_POINT, .place = AT(p1)},
    {"p2", FIELD_POINT, AT(p2), .fallback = 1},
    PHI_MAX, {.name = NULL}};

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

/* pbrt-v3's holes for shadow rays alone cannot be: what light passes, the eye's paths must pass, too, or the strategies
 * disagree. Exporters give the texture of "alpha", which says nothing new. */
static void shadow_alpha(struct parser *p, struct shape_group *group, int texture)
{
    if (texture < 0 || texture == group->alpha)
        return;
    source_warn(&p->messages, place_of(&p->params, "shadowalpha"),
                "a hole is one for all rays here: \"shadowalpha\" %s",
                group->alpha < 0 ? "counts as \"alpha\"" : "is passed over, since \"alpha\" is another");
    group->alpha = group->alpha < 0 ? texture : group->alpha;
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
    if (field_find(row->fields, "alpha") != NULL) {
        item->group.alpha = alpha(p, "alpha");
        shadow_alpha(p, &item->group, alpha(p, "shadowalpha"));
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

/* --- where they go: into the scene, with a light for each primitive of an emitter, or into an object -------- */

/* One light for each primitive of the group. */
static void add_lights(struct scene *s, int group, int n, const struct area_light *area)
{
    struct light l = {.kind = LIGHT_AREA, .L = area->L, .two_sided = area->two_sided, .hidden = area->hidden,
                      .medium = s->geo.group[group].medium[1], .group = area->group};
    for (int i = 0; i < n; i++) {
        l.prim = s->geo.group[group].first_prim + i;
        light_add(&s->lights, l, NULL);
    }
}

/* Add one shape to the scene. A mesh inside the item stays the caller's. */
static bool add_shape(struct parser *p, const struct shape_item *item, struct transform place,
                      struct source_position at)
{
    struct transform to_world = parse_to_world(p, place);
    struct scene *s = p->scene;
    struct shape_group group = item->group;
    group.first_light = item->area.on ? s->lights.n : -1;
    struct error inner;
    int id, n = 1;
    if (item->is_mesh) {
        n = item->mesh.n_triangles;
        id = shape_add_mesh(&s->geo, &item->mesh, &to_world, group, item->reverse, &inner);
    } else {
        struct quadric q = item->quadric;
        q.to_world = to_world;
        id = shape_add_quadric(&s->geo, q, group, item->reverse, &inner);
    }
    if (id < 0)
        return source_error(&p->messages, at, "%s", inner.text);
    if (item->area.on)
        add_lights(s, id, n, &item->area);
    if (item->area.on && group.material == MATERIAL_NONE)
        p->media.bare_light_at = at;
    return true;
}

void shape_list_free(struct shape_list *list)
{
    for (int i = 0; i < list->n; i++)
        mesh_free(&list->item[i].mesh);
    free(list->item);
}

/* Into the object that is open, else into the scene. Takes over its mesh. */
static bool place_shape(struct parser *p, struct shape_item *item)
{
    if (p->current_object >= 0) {
        struct shape_list *list = &p->object[p->current_object];
        list->item = mem_append(list->item, (size_t)list->n, sizeof *list->item);
        list->item[list->n++] = *item;
        return true;
    }
    bool ok = add_shape(p, item, item->place, p->params.position);
    mesh_free(&item->mesh);
    return ok;
}

/* Is there anything to be seen of it, or does it bound a medium? */
static bool is_seen(const struct shape_item *item)
{
    bool empty = item->is_mesh && item->mesh.n_triangles == 0;
    bool bounds = item->group.medium[0] != item->group.medium[1];
    return !empty && (item->group.material != MATERIAL_NONE || item->area.on || bounds);
}

/* pbrt-v3 turns normals of quadrics under a mirroring transform. Here they stay, but the sides of media are its. */
static void set_media(struct parser *p, struct shape_item *item)
{
    bool turned = !item->is_mesh && transform_swaps_handedness(&item->place);
    item->group.medium[turned] = parse_medium(p, 0);
    item->group.medium[!turned] = parse_medium(p, 1);
}

static bool shape(struct parser *p)
{
    struct object_type types[MOST_TYPES];
    parse_shape_types(types);
    if (!parse_typed(p) || !parse_type(p, types))
        return false;
    struct shape_item item = {.place = p->place.ctm, .reverse = p->state.reverse, .area = p->state.area};
    item.group.alpha = item.group.first_light = -1;
    if (p->type.kind < N_QUADRICS)
        parse_fields(p, &item);
    else
        mesh(p, &item);
    item.group.material = parse_changed_material(p);
    set_media(p, &item);
    bool ok = parse_done(p) && parse_placed(p);
    if (ok && is_seen(&item)) {
        if (item.area.on && item.area.group < 0)
            item.area.group = light_group(&p->scene->lights, NULL, LIGHT_AREA);
        return place_shape(p, &item);
    }
    mesh_free(&item.mesh);
    return ok;
}

/* --- objects and their instances --------------------------------------------------------------------- */

static bool object_begin(struct parser *p)
{
    struct token name;
    if (!parse_string(p, &name, "a name"))
        return false;
    if (p->current_object >= 0)
        source_warn(&p->messages, name.position, "objects do not nest: as in pbrt-v3, \"%.60s\" ends the one before it",
                    name.text);
    p->object = mem_append(p->object, (size_t)p->objects.n, sizeof *p->object);
    memset(&p->object[p->objects.n], 0, sizeof *p->object);
    p->current_object = p->objects.n;
    symbols_add(&p->objects, name.text, p->current_object);
    return parse_open_block(p, BLOCK_OBJECT);
}

static bool object_end(struct parser *p)
{
    p->current_object = -1;
    return parse_close_block(p, BLOCK_OBJECT);
}

/* Instances are copies: a few lines could ask for more than any machine has. */
static const uint64_t MAX_COPIED_BYTES = (uint64_t)1 << 29;

/* What an instance of the object adds to the scene: some 32 bytes for a triangle, and a light for each that shines. */
static uint64_t instance_bytes(const struct shape_list *object)
{
    const uint64_t vertex = 8 * sizeof(float), triangle = 3 * sizeof(uint32_t) + sizeof(int32_t);
    uint64_t sum = (uint64_t)object->n * sizeof(struct shape_group);
    for (int i = 0; i < object->n; i++) {
        const struct mesh *m = &object->item[i].mesh;
        uint64_t n = object->item[i].is_mesh ? (uint64_t)m->n_triangles : 1;
        sum += object->item[i].is_mesh ? (uint64_t)m->n_vertices * vertex + n * triangle : sizeof(struct quadric);
        sum += object->item[i].area.on ? n * sizeof(struct light) : 0;
    }
    return sum;
}

static bool object_instance(struct parser *p)
{
    struct token name;
    if (p->current_object >= 0) {
        source_warn(&p->messages, p->directive.position,
                    "an ObjectInstance in an object is passed over, as in pbrt-v3");
        return false;
    }
    int i = parse_named(p, &name, &p->objects, "object", "this instance is left out");
    if (i < 0)
        return false;
    const struct shape_list *list = &p->object[i];
    if (list->n > 0 && !parse_placed(p))
        return false;
    p->copied_bytes += instance_bytes(list);
    if (p->copied_bytes > MAX_COPIED_BYTES)
        return source_error(&p->messages, name.position,
                            "with this instance they take more than %.0f MB, for each is a copy; use fewer",
                            (double)MAX_COPIED_BYTES / 1e6);
    for (int k = 0; k < list->n; k++) {
        struct transform place = transform_compose(p->place.ctm, list->item[k].place);
        if (!transform_is_usable(&place))
            return source_error(&p->messages, name.position,
                               "the object's transform and this instance's together are infinite or singular");
        if (!add_shape(p, &list->item[k], place, name.position))
            return false;
    }
    return true;
}

const struct directive SHAPE_DIRECTIVES[] = {{"Shape", IN_WORLD, shape, NULL},
                                             {"ObjectInstance", IN_WORLD, object_instance, NULL},
                                             {"ObjectBegin", IN_WORLD, object_begin, NULL},
                                             {"ObjectEnd", IN_WORLD, object_end, NULL}, {.name = NULL}};
