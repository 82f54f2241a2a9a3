/* parse_instance.c: where shapes go: into the scene, with a light for each primitive of an emitter, or into an object,
 * to be copied by each of its instances [pbrt-v3 core/api.cpp]. See parse.h. */
#include "parser/parse.h"

#include <stdlib.h>
#include <string.h>

/* One light for each primitive of the group. */
static void add_lights(struct scene *s, int group, int n, const struct area_light *area)
{
    struct light l = {.kind = LIGHT_AREA, .L = area->L, .two_sided = area->two_sided, .hidden = area->hidden,
                      .group = area->group};
    for (int i = 0; i < n; i++) {
        l.prim = s->geo.group[group].first_prim + i;
        light_add(&s->lights, l, NULL);
    }
}

/* Add one shape to the scene. A mesh inside the item stays the caller's. */
static bool add_shape(struct parser *p, const struct shape_item *item, struct transform to_world,
                      struct source_position at)
{
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
    return true;
}

void shape_list_free(struct shape_list *list)
{
    for (int i = 0; i < list->n; i++)
        mesh_free(&list->item[i].mesh);
    free(list->item);
}

bool parse_place_shape(struct parser *p, struct shape_item *item)
{
    if (p->current_object >= 0) {
        struct shape_list *list = &p->object[p->current_object];
        list->item = mem_append(list->item, (size_t)list->n, sizeof *list->item);
        list->item[list->n++] = *item;
        return true;
    }
    bool ok = add_shape(p, item, item->to_world, p->params.position);
    mesh_free(&item->mesh);
    return ok;
}

/* --- objects ------------------------------------------------------------------------------------------ */

static bool object_begin(struct parser *p)
{
    struct token name;
    if (!parse_string(p, &name, "a name"))
        return false;
    if (p->current_object >= 0)
        return directive_error(p, "objects do not nest; close the one before it with ObjectEnd");
    p->object = mem_append(p->object, (size_t)p->objects.n, sizeof *p->object);
    memset(&p->object[p->objects.n], 0, sizeof *p->object);
    p->current_object = p->objects.n;
    symbols_add(&p->objects, name.text, p->current_object);
    return parse_open_block(p, BLOCK_OBJECT);
}

static bool object_end(struct parser *p)
{
    if (!parse_close_block(p, BLOCK_OBJECT))
        return false;
    p->current_object = -1;
    return true;
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
    if (p->current_object >= 0)
        return directive_error(p, "objects do not nest; close the one before it with ObjectEnd");
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
        struct transform to_world = transform_compose(p->place.ctm, list->item[k].to_world);
        if (!transform_is_usable(&to_world))
            return source_error(&p->messages, name.position,
                               "the object's transform and this instance's together are infinite or singular");
        if (!add_shape(p, &list->item[k], to_world, name.position))
            return false;
    }
    return true;
}

const struct directive INSTANCE_DIRECTIVES[] = {{"ObjectInstance", IN_WORLD, object_instance, NULL},
                                                {"ObjectBegin", IN_WORLD, object_begin, NULL},
                                                {"ObjectEnd", IN_WORLD, object_end, NULL},
                                                {.name = NULL}};
