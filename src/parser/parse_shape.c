/* parse_shape.c: shapes, with pbrt-v3's parameters and defaults [PBRT3 shapes/], the area lights on them, and their
 * copies in object instances. See parse.h. */
#include "parser/parse.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/ply.h"

/* --- meshes ------------------------------------------------------------------------------------------- */

/* A list of numbers as floats. */
static float *floats(const double *number, int n)
{
    float *out = mem_alloc((size_t)n, sizeof *out);
    for (int i = 0; i < n; i++)
        out[i] = (float)number[i]; /* within NUMBER_MAX */
    return out;
}

/* Data per vertex beside P: there must be as much of it as of P. */
static float *vertex_data(struct params *q, const char *name, unsigned types, int width, int n_vertices)
{
    int n;
    const struct param *item;
    const double *number = params_list(q, name, types, width, &n, &item);
    if (number == NULL)
        return NULL;
    if (n != n_vertices) {
        params_fail(q, item->place, "\"%s\" has %d entries but \"P\" has %d points; give one for each", name, n,
                    n_vertices);
        return NULL;
    }
    return floats(number, n * width);
}

static uint32_t *indices(struct params *q, int n_vertices, int *n_triangles)
{
    int n;
    const struct param *item;
    const double *number = params_list(q, "indices", 1u << PARAM_INTEGER, 3, &n, &item);
    if (number == NULL) {
        params_fail(q, q->place, "a trianglemesh needs \"integer indices\" [...]");
        return NULL;
    }
    uint32_t *out = mem_alloc((size_t)n, 3 * sizeof *out);
    for (int i = 0; i < 3 * n; i++) {
        if (!(number[i] >= 0 && number[i] < n_vertices && number[i] == floor(number[i]))) {
            params_fail(q, param_value_place(item, i),
                        "%g is not the index of a point; \"P\" has %d points, 0 to %d", number[i], n_vertices,
                        n_vertices - 1);
            break;
        }
        out[i] = (uint32_t)number[i];
    }
    *n_triangles = n;
    return out;
}

static void trianglemesh(struct parser *p, struct mesh *m)
{
    const unsigned uv_types = 1u << PARAM_FLOAT | 1u << PARAM_POINT2;
    struct params *q = &p->params;
    int n;
    const double *P = params_list(q, "P", 1u << PARAM_POINT, 3, &n, NULL);
    if (P == NULL) {
        params_fail(q, q->place, "a trianglemesh needs \"point P\" [...]");
        return;
    }
    m->n_vertices = n;
    m->P = floats(P, 3 * n);
    m->N = vertex_data(q, "N", 1u << PARAM_NORMAL, 3, n);
    m->UV = vertex_data(q, "uv", uv_types, 2, n);
    if (m->UV == NULL)
        m->UV = vertex_data(q, "st", uv_types, 2, n);
    m->index = indices(q, n, &m->n_triangles);
    params_ignore(q, "faceIndices"); /* for Ptex only */
    const struct param *tangents = params_ignore(q, "S");
    if (tangents != NULL)
        place_warn(&p->messages, tangents->place, "tangents",
                   "tangents \"S\" are ignored: anisotropic materials follow the texture coordinates");
}

static void plymesh(struct params *q, struct mesh *m)
{
    struct place at;
    struct error inner;
    char *path = params_file(q, "filename", &at);
    if (path == NULL)
        params_fail(q, q->place, "a plymesh needs its file: add \"string filename\" \"...\"");
    else if (!ply_read(path, m, &inner))
        params_fail(q, at, "%s", inner.text);
    free(path);
}

/* The texture of "alpha" or "shadowalpha"; -1 if the surface is simply there, *absent if it is simply not. */
static int alpha(struct parser *p, const char *name, bool *absent)
{
    *absent = false;
    if (params_has(&p->params, name, PARAM_TEXTURE))
        return parse_float_texture_or(p, name, -1);
    *absent = params_float(&p->params, name, 1) == 0;
    return -1;
}

/* --- quadrics ----------------------------------------------------------------------------------------- */

static double phi_max(struct params *q) { return fmin(params_positive(q, "phimax", 360), 360) * PI / 180; }

/* The part of a sphere or cylinder between two heights. */
static void heights(struct params *q, struct quadric *s, double low, double high, double limit)
{
    double a = params_float(q, "zmin", low), b = params_float(q, "zmax", high);
    s->zmin = clamp(fmin(a, b), -limit, limit);
    s->zmax = clamp(fmax(a, b), -limit, limit);
    if (!(s->zmin < s->zmax))
        params_fail(q, q->place, "\"zmin\" %g and \"zmax\" %g leave nothing of this %s", a, b, q->type);
}

static struct quadric sphere(struct params *q)
{
    struct quadric s = {.kind = QUADRIC_SPHERE, .radius = params_positive(q, "radius", 1), .phi_max = phi_max(q)};
    heights(q, &s, -s.radius, s.radius, s.radius);
    return s;
}

static struct quadric cylinder(struct params *q)
{
    struct quadric s = {.kind = QUADRIC_CYLINDER, .radius = params_positive(q, "radius", 1), .phi_max = phi_max(q)};
    heights(q, &s, -1, 1, DBL_MAX);
    return s;
}

static struct quadric disk(struct params *q)
{
    struct quadric s = {.kind = QUADRIC_DISK, .radius = params_positive(q, "radius", 1), .phi_max = phi_max(q)};
    s.inner_radius = params_at_least(q, "innerradius", 0, 0);
    s.zmin = s.zmax = params_float(q, "height", 0);
    if (!(s.inner_radius < s.radius))
        params_fail(q, q->place, "\"innerradius\" %g must be less than \"radius\" %g", s.inner_radius, s.radius);
    return s;
}

/* --- adding ------------------------------------------------------------------------------------------- */

/* One light for each primitive of the group. */
static void add_lights(struct scene *s, int group, int n, const struct area_light *area, const struct transform *t)
{
    struct light l = {.kind = LIGHT_AREA, .L = area->L, .to_world = *t, .two_sided = area->two_sided};
    for (int i = 0; i < n; i++) {
        l.prim = s->geo.group[group].first_prim + i;
        light_add(&s->lights, l);
    }
}

bool parse_shape_add(struct parser *p, const struct shape_item *item, struct transform to_world, struct place at)
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
        return place_error(&p->messages, at, "%s", inner.text);
    if (item->area.on)
        add_lights(s, id, n, &item->area, &to_world);
    return true;
}

static void keep(struct shape_list *list, const struct shape_item *item)
{
    list->item = mem_grow(list->item, &list->capacity, (size_t)list->n + 1, sizeof *list->item);
    list->item[list->n++] = *item;
}

void shape_list_free(struct shape_list *list)
{
    for (int i = 0; i < list->n; i++)
        mesh_free(&list->item[i].mesh);
    free(list->item);
    memset(list, 0, sizeof *list);
}

/* A light needs a surface to sit on, even where the file gives it no material. */
static int black_matte(struct parser *p)
{
    if (p->black_matte < 0) {
        int black = parse_constant(p, rgb_black());
        struct material m = {.kind = MATERIAL_MATTE,
                             .Kd = black,
                             .Ks = -1,
                             .Kr = -1,
                             .Kt = -1,
                             .sigma = black,
                             .eta = -1,
                             .k = -1,
                             .index = -1,
                             .uroughness = -1,
                             .vroughness = -1,
                             .remap_roughness = true,
                             .opacity = -1,
                             .reflect = -1,
                             .transmit = -1,
                             .amount = -1,
                             .mix1 = -1,
                             .mix2 = -1,
                             .bump = -1};
        p->black_matte = scene_add_material(p->scene, m);
    }
    return p->black_matte;
}

/* Settle which light and material the shape has. Returns false if nothing of it would be seen. */
static bool settle(struct parser *p, struct shape_item *item, bool absent)
{
    if (p->current_object >= 0 && item->area.on) {
        place_warn(&p->messages, item->place, "light in object",
                   "area lights inside ObjectBegin are ignored, as in pbrt-v3");
        item->area.on = false;
    }
    if (absent && item->area.on)
        place_warn(&p->messages, item->place, "absent light", "a light of alpha 0 is left out, with its shape");
    if (absent)
        return false;
    if (item->group.material == MATERIAL_NONE && item->area.on) {
        place_warn(&p->messages, item->place, "light without material",
                   "a light without material is given a black one");
        item->group.material = black_matte(p);
    }
    return item->group.material != MATERIAL_NONE;
}

/* Fill in what the directive says. */
static bool read_shape(struct parser *p, struct shape_item *item, bool *absent)
{
    static const char *const KNOWN[] = {"trianglemesh", "plymesh", "sphere", "disk", "cylinder", NULL};
    static const char *const REFUSED[] = {"cone",       "curve", "heightfield", "hyperboloid",
                                          "loopsubdiv", "nurbs", "paraboloid",  NULL};
    struct params *q = &p->params;
    int kind = parse_name(p, KNOWN, REFUSED);
    item->is_mesh = kind == 0 || kind == 1;
    switch (kind) {
    case 0: trianglemesh(p, &item->mesh); break;
    case 1: plymesh(q, &item->mesh); break;
    case 2: item->quadric = sphere(q); break;
    case 3: item->quadric = disk(q); break;
    case 4: item->quadric = cylinder(q); break;
    default: return false;
    }
    if (item->is_mesh) {
        bool no_shadow;
        item->group.alpha = alpha(p, "alpha", absent);
        item->group.shadow_alpha = alpha(p, "shadowalpha", &no_shadow);
        if (no_shadow)
            item->group.shadow_alpha = parse_constant(p, rgb_black());
    }
    return params_done(q);
}

bool parse_shape(struct parser *p)
{
    struct shape_item item = {
        .to_world = p->state.ctm, .reverse = p->state.reverse, .area = p->state.area, .place = p->params.place};
    item.group.material = p->state.material;
    item.group.alpha = item.group.shadow_alpha = item.group.first_light = -1;
    bool absent = false, ok = read_shape(p, &item, &absent);
    bool kept = false;
    if (ok && settle(p, &item, absent)) {
        kept = p->current_object >= 0;
        if (kept)
            keep(&p->object[p->current_object], &item);
        else
            ok = parse_shape_add(p, &item, item.to_world, item.place);
    }
    if (!kept)
        mesh_free(&item.mesh);
    return ok;
}
