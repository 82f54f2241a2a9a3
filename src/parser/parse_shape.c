/* parse_shape.c: shapes, with pbrt-v3's parameters and defaults [pbrt-v3 shapes/], and objects and their instances
 * [pbrt-v3 core/api.cpp]. See parse.h. */
#include "parser/parse.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
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
    bool unknown;
    int texture = parse_named_texture(p, name, true, &unknown);
    bool hole = texture < 0 && !unknown && params_number(&p->params, name, 1, -NUMBER_MAX, NUMBER_MAX) == 0;
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
    return m->file_size == 0 || scene_files_count(q->files, m->content, (double)m->file_size, err);
}

static void mesh(struct parser *p, struct shape_item *item)
{
    const struct shape_row *row = shape_rows[p->type.kind - N_QUADRICS];
    struct params *q = &p->params;
    struct mesh_task task = {.shape = row->name, .memory = &p->scene->memory, .warn = warn, .context = p};
    void *fields = mem_alloc(1, row->size);
    item->is_mesh = true;
    if (!row->may_shine)
        must_not_shine(p);
    parse_fields(p, fields);
    if (!q->failed && (!row->mesh(fields, &task, &item->mesh) || !count_file(q, &item->mesh, &task.err)))
        params_fail(q, place_of(q, task.about), "%s", task.err.text);
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

/* What a shape takes. */
static double bytes_of(const struct shape_item *item)
{
    const struct mesh *m = &item->mesh;
    double vertex = sizeof(vec3) + 5 * sizeof(float), triangle = 3 * sizeof(uint32_t);
    double mesh = vertex * m->n_vertices + triangle * m->n_triangles + (double)sizeof *m->strand * m->n_strands;
    return sizeof *item + (item->is_mesh ? mesh : 0);
}

/* About what it takes in the world in addition: its part of the kd-tree, and its lights. */
static double bytes_more(const struct shape_item *item)
{
    const double primitive = 110, light = 200;
    return (item->is_mesh ? mesh_primitives(&item->mesh) : 1) * (primitive + (item->area.on ? light : 0));
}

/* Add one shape to the scene. A mesh inside the item stays the caller's. */
static bool add_shape(struct parser *p, const struct shape_item *item, struct transform to_world,
                      struct source_position at)
{
    struct scene *s = p->scene;
    struct shape_group group = item->group;
    group.first_light = item->area.on ? s->lights.n : -1;
    group.two_sided = item->area.two_sided;
    struct error inner;
    int id, n = 1;
    if (!budget_take(&s->memory, bytes_of(item) + bytes_more(item), &inner))
        return source_error(&p->messages, at, "%s", inner.text);
    if (item->is_mesh) {
        n = mesh_primitives(&item->mesh);
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
    return true;
}

static uint64_t hash_transform(const struct transform *t) { return hash_content(t->m, sizeof t->m); }

/* A hash of a shape, of where it is, and of all by which another in its place would be seen with it. */
static uint64_t hash_shape(const struct shape_item *item)
{
    const struct mesh *m = &item->mesh;
    const struct quadric *q = &item->quadric;
    const double size[] = {q->kind, q->radius, q->inner_radius, q->zmin, q->zmax, q->phi_max, q->p1.x, q->p1.y, q->p1.z,
                           q->p2.x, q->p2.y, q->p2.z};
    const struct shape_group *g = &item->group;
    const int kind[] = {item->is_mesh, item->reverse, item->area.on, item->area.two_sided, g->alpha,
                        g->material == MATERIAL_NONE, g->medium[0], g->medium[1]};
    uint64_t h = hash_combine(hash_transform(&item->place), hash_content(kind, sizeof kind));
    if (!item->is_mesh)
        return hash_combine(h, hash_content(size, sizeof size));
    h = hash_combine(h, hash_content(m->P, (size_t)m->n_vertices * sizeof *m->P));
    h = hash_combine(h, hash_content(m->strand, (size_t)m->n_strands * sizeof *m->strand));
    return hash_combine(h, hash_content(m->index, 3 * (size_t)m->n_triangles * sizeof *m->index));
}

/* Has the world got this already? Then there is a warning. */
static bool is_there(struct parser *p, uint64_t key, const char *what)
{
    char name[24];
    snprintf(name, sizeof name, "%016llx", (unsigned long long)key);
    int line = symbols_find(&p->places, name);
    if (line < 0)
        symbols_add(&p->places, name, p->directive.position.line);
    else
        source_warn(&p->messages, p->directive.position,
                    "this %s equals that of line %d, in the same place; it is left out", what, line);
    return line >= 0;
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
    struct error inner;
    if (p->current_object >= 0) {
        struct shape_list *list = &p->object[p->current_object];
        if (!budget_take(&p->scene->memory, bytes_of(item), &inner)) {
            mesh_free(&item->mesh);
            return directive_error(p, "%s", inner.text);
        }
        list->item = mem_append(list->item, (size_t)list->n, sizeof *list->item);
        list->item[list->n++] = *item;
        return true;
    }
    bool ok = is_there(p, hash_shape(item), "shape") ||
              add_shape(p, item, parse_to_world(p, item->place), p->params.position);
    mesh_free(&item->mesh);
    return ok;
}

/* Is there anything to be seen of it, or does it bound a medium? */
static bool is_seen(const struct shape_item *item)
{
    bool empty = item->is_mesh && mesh_primitives(&item->mesh) == 0;
    return !empty && (item->group.material != MATERIAL_NONE || item->area.on || shape_is_interface(&item->group));
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
    p->object[p->objects.n] = (struct shape_list){.shared = -1};
    p->current_object = p->objects.n;
    symbols_add(&p->objects, name.text, p->current_object);
    return parse_open_block(p, BLOCK_OBJECT);
}

static bool object_end(struct parser *p)
{
    p->current_object = -1;
    return parse_close_block(p, BLOCK_OBJECT);
}

/* Rays meet copies faster than what instances share, unless there are many. So instances are copies until those of a
 * scene have MOST_COPIED triangles, and of each object the first one is. */
static const int64_t MOST_COPIED = 1 << 18;

static int64_t triangles_of(const struct shape_list *object)
{
    int64_t n = 0;
    for (int i = 0; i < object->n; i++)
        n += object->item[i].is_mesh ? mesh_primitives(&object->item[i].mesh) : 1;
    return n;
}

/* Lights and bounds of media are always copies. */
static bool may_be_shared(const struct shape_item *item)
{
    return item->group.material != MATERIAL_NONE && !item->area.on;
}

/* Make what instances of the object share. The origin of its space is a point of it, for vertices are floats
 * (scene_set_origin). */
static bool make_shared(struct parser *p, struct shape_list *list, struct source_position at)
{
    struct geometry *geo = &p->scene->geo;
    int first_group = geo->n_groups;
    for (int i = 0; i < list->n; i++) {
        const struct shape_item *item = &list->item[i];
        if (!may_be_shared(item))
            continue;
        if (geo->n_groups == first_group)
            list->origin = transform_point(&item->place, item->is_mesh ? mesh_point(&item->mesh) : vec(0, 0, 0));
        if (!add_shape(p, item, transform_compose(transform_translate(neg(list->origin)), item->place), at))
            return false;
    }
    if (geo->n_groups > first_group)
        list->shared = shape_make_object(geo, first_group);
    return true;
}

/* Place it once more. */
static bool place_shared(struct parser *p, struct shape_list *list, struct source_position at)
{
    struct error inner;
    if (list->shared < 0 && !make_shared(p, list, at))
        return false;
    struct transform to_world =
        parse_to_world(p, transform_compose(p->place.ctm, transform_translate(list->origin)));
    return list->shared < 0 ||
           (budget_take(&p->scene->memory, 2 * sizeof(struct instance), &inner) &&
            shape_add_instance(&p->scene->geo, list->shared, &to_world, &inner)) ||
           source_error(&p->messages, at, "%s", inner.text);
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
    struct shape_list *list = &p->object[i];
    if (list->n > 0 && !parse_placed(p))
        return false;
    if (list->n > 0 && is_there(p, hash_combine((uint64_t)i, hash_transform(&p->place.ctm)), "instance"))
        return true;
    bool shared = list->n_instances++ > 0 && p->n_copied + triangles_of(list) > MOST_COPIED;
    p->n_copied += shared ? 0 : triangles_of(list);
    for (int k = 0; k < list->n; k++) {
        struct transform place = transform_compose(p->place.ctm, list->item[k].place);
        if (!transform_is_usable(&place))
            return source_error(&p->messages, name.position,
                               "the object's transform and this instance's together are infinite or singular");
        if (!(shared && may_be_shared(&list->item[k])) &&
            !add_shape(p, &list->item[k], parse_to_world(p, place), name.position))
            return false;
    }
    return !shared || place_shared(p, list, name.position);
}

const struct directive SHAPE_DIRECTIVES[] = {{"Shape", IN_WORLD, shape, NULL},
                                             {"ObjectInstance", IN_WORLD, object_instance, NULL},
                                             {"ObjectBegin", IN_WORLD, object_begin, NULL},
                                             {"ObjectEnd", IN_WORLD, object_end, NULL}, {.name = NULL}};
