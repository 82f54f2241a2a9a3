/* parse_shape.c: shapes, with pbrt-v3's parameters and defaults [pbrt-v3 shapes/]. See parse.h. */
#include "parser/parse.h"

#include <float.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/curve.h"
#include "geometry/nurbs.h"
#include "geometry/ply.h"
#include "geometry/subdivide.h"

/* --- meshes ------------------------------------------------------------------------------------------- */

static struct mesh *mesh_of(void *object)
{
    struct shape_item *item = object;
    item->is_mesh = true;
    return &item->mesh;
}

/* A list of numbers as floats. */
static float *floats(const double *number, int n)
{
    float *out = mem_alloc((size_t)n, sizeof *out);
    for (int i = 0; i < n; i++)
        out[i] = (float)number[i]; /* within NUMBER_MAX */
    return out;
}

/* Data per vertex beside P: where there is less of it than of P, or of N or S more, pbrt-v3 goes on without it. */
static float *vertex_data(struct params *q, const char *name, unsigned types, int width, int n_vertices)
{
    int n;
    const struct param *item;
    const double *number = params_list(q, name, types, width, &n, &item);
    if (number == NULL)
        return NULL;
    bool kept = n == n_vertices || (n > n_vertices && width == 2);
    if (n != n_vertices)
        source_warn(q->messages, item->position, "\"%s\" has %d entries but \"P\" has %d points; %s", name, n,
                    n_vertices, kept ? "the rest is passed over" : "it is passed over");
    return kept ? floats(number, n_vertices * width) : NULL;
}

/* Sets *n_triangles to 0 where an index is wrong. */
static uint32_t *vertex_indices(struct params *q, int n_vertices, int *n_triangles)
{
    int n;
    const struct param *item;
    const double *number = params_list(q, "indices", 1u << PARAM_INTEGER, 3, &n, &item);
    uint32_t *out = mem_alloc((size_t)n, 3 * sizeof *out);
    *n_triangles = n_vertices > 0 ? n : 0;
    for (int i = 0; i < 3 * *n_triangles; i++) {
        if (!(number[i] > -1 && number[i] < n_vertices)) {
            source_warn(q->messages, item->position, "number %d of the indices is %g: \"P\" has %d points, 0 to %d",
                        i + 1, number[i], n_vertices, n_vertices - 1);
            *n_triangles = 0;
            break;
        }
        out[i] = (uint32_t)number[i];
    }
    return out;
}

/* Points and the triangles between them. */
static void points(struct params *q, struct mesh *m)
{
    int n;
    const double *P = params_list(q, "P", 1u << PARAM_POINT, 3, &n, NULL);
    m->n_vertices = n;
    m->P = floats(P, 3 * n);
    m->index = vertex_indices(q, n, &m->n_triangles);
    if (m->n_triangles == 0 && !q->failed)
        source_warn(q->messages, q->position,
                    "a %s without usable \"point P\" and \"integer indices\" is left out, as in pbrt-v3", q->type);
}

/* The texture of where there are holes; -1 if there are none: of numbers 0 alone makes a hole. */
static int alpha(struct parser *p, const char *name)
{
    int texture = parse_named_texture(p, name, true);
    bool hole = texture < 0 && params_number(&p->params, name, 1, -NUMBER_MAX, NUMBER_MAX) == 0;
    return hole ? parse_constant(p, rgb_black()) : texture;
}

static void holes(struct parser *p, struct shape_item *item)
{
    item->group.alpha = alpha(p, "alpha");
    item->group.shadow_alpha = alpha(p, "shadowalpha");
}

static void trianglemesh(struct parser *p, void *object)
{
    struct params *q = &p->params;
    struct mesh *m = mesh_of(object);
    const unsigned uv_types = 1u << PARAM_FLOAT | 1u << PARAM_POINT2;
    points(q, m);
    m->N = vertex_data(q, "N", 1u << PARAM_NORMAL, 3, m->n_vertices);
    m->S = vertex_data(q, "S", 1u << PARAM_VECTOR, 3, m->n_vertices);
    m->UV = vertex_data(q, "uv", uv_types, 2, m->n_vertices);
    if (m->UV == NULL)
        m->UV = vertex_data(q, "st", uv_types, 2, m->n_vertices);
    holes(p, object);
}

/* As in pbrt-v3, "levels" comes before "nlevels", and neither this nor a heightfield has an alpha. */
static void loopsubdiv(struct parser *p, void *object)
{
    struct params *q = &p->params;
    struct mesh *m = mesh_of(object);
    struct error inner;
    int levels = params_int(q, "levels", params_int(q, "nlevels", 3, 0, 30), 0, 30);
    points(q, m);
    if (q->failed || m->n_triangles == 0)
        return;
    if (mesh_subdivide(m, levels, SUBDIVIDE_MAX_TRIANGLES - p->n_subdivided, &inner))
        p->n_subdivided += m->n_triangles;
    else
        type_error(q, "%s", inner.text);
}

/* Heights "Pz" over nu x nv points of the unit square, the first row at y = 0. */
static void heightfield(struct parser *p, void *object)
{
    struct params *q = &p->params;
    struct mesh *m = mesh_of(object);
    enum { MOST = 1 << 14 };
    int n, nu = params_int(q, "nu", 0, 0, MOST), nv = params_int(q, "nv", 0, 0, MOST);
    const double *z = params_list(q, "Pz", 1u << PARAM_FLOAT, 1, &n, NULL);
    if (z == NULL || nu < 2 || nv < 2 || n != nu * nv) {
        type_error(q, "a heightfield needs \"nu\" and \"nv\" of 2 at least, and nu nv heights \"Pz\"");
        return;
    }
    mesh_grid(m, nu, nv, false);
    for (int i = 0; i < n; i++) {
        m->P[3 * i] = m->UV[2 * i] = (float)(i % nu) / (float)(nu - 1);
        m->P[3 * i + 1] = m->UV[2 * i + 1] = (float)(i / nu) / (float)(nv - 1);
        m->P[3 * i + 2] = (float)z[i]; /* within NUMBER_MAX */
    }
}

/* What turns to each ray in pbrt-v3 is drawn as a tube, of which "cylinder" has the normals already. */
static void curve(struct parser *p, void *object)
{
    static const char *const KINDS[] = {"flat", "ribbon", "cylinder", NULL};
    static const char *const BASES[] = {"bezier", "bspline", NULL};
    struct params *q = &p->params;
    struct mesh *m = mesh_of(object);
    struct error inner;
    struct curve c = {.degree = params_int(q, "degree", 3, 2, 3), .bspline = params_choice(q, "basis", BASES) == 1};
    double width = params_number(q, "width", 1, 0, NUMBER_MAX);
    int n_normals, type = params_choice(q, "type", KINDS);
    c.width[0] = params_number(q, "width0", width, 0, NUMBER_MAX);
    c.width[1] = params_number(q, "width1", width, 0, NUMBER_MAX);
    c.P = params_list(q, "P", 1u << PARAM_POINT, 3, &c.n, NULL);
    c.N = type == 1 ? params_list(q, "N", 1u << PARAM_NORMAL, 3, &n_normals, NULL) : NULL;
    if (p->state.area.on)
        type_error(q, "a curve cannot be an area light, here as in pbrt-v3; end the AreaLightSource before it");
    else if (curve_segments(&c) == 0)
        type_error(q, "%d points \"P\" are no curve of degree %d: of a bezier one there are 1 + a multiple of it, of a "
                   "bspline more than it", c.n, c.degree);
    else if (type == 1 && (c.N == NULL || n_normals != curve_segments(&c) + 1))
        type_error(q, "this ribbon needs %d normals \"N\", one at each end of a segment", curve_segments(&c) + 1);
    else if (!q->failed && !curve_mesh(&c, m, SUBDIVIDE_MAX_TRIANGLES - p->n_subdivided, &inner))
        type_error(q, "%s", inner.text);
    p->n_subdivided += m->n_triangles;
    if (type == 0 && !q->failed)
        source_warn(q->messages, q->position, "a flat curve turns to whoever looks, which no surface does: it is "
                    "drawn as the tube that looks as wide");
}

static struct nurbs_axis nurbs_axis(struct params *q, const char *const name[5])
{
    struct nurbs_axis a = {.n = params_int(q, name[0], 0, 0, 1 << 14),
                           .order = params_int(q, name[1], 0, 0, NURBS_MOST_ORDER)};
    int n;
    a.knot = params_list(q, name[2], 1u << PARAM_FLOAT, 1, &n, NULL);
    bool ok = a.knot != NULL && a.order >= 2 && a.n >= a.order && n == a.n + a.order;
    a.from = params_number(q, name[3], ok ? a.knot[a.order - 1] : 0, -NUMBER_MAX, NUMBER_MAX);
    a.to = params_number(q, name[4], ok ? a.knot[a.n] : 0, -NUMBER_MAX, NUMBER_MAX);
    if (!ok || !nurbs_is_usable(&a))
        type_error(q, "a nurbs needs \"%s\" from 2 to %d, \"%s\" not less than that, as many numbers as both together "
                   "in \"%s\" that never fall, and \"%s\" < \"%s\" within the inner ones", name[1], NURBS_MOST_ORDER,
                   name[0], name[2], name[3], name[4]);
    return a;
}

static void nurbs(struct parser *p, void *object)
{
    static const char *const U[] = {"nu", "uorder", "uknots", "u0", "u1"};
    static const char *const V[] = {"nv", "vorder", "vknots", "v0", "v1"};
    struct params *q = &p->params;
    struct mesh *m = mesh_of(object);
    struct error inner;
    int n;
    struct nurbs_axis u = nurbs_axis(q, U), v = nurbs_axis(q, V);
    const double *P = params_list(q, "P", 1u << PARAM_POINT, 3, &n, NULL), *Pw = NULL;
    double *made = NULL;
    if (P != NULL) {
        Pw = made = mem_alloc((size_t)n, 4 * sizeof *made);
        for (int i = 0; i < 4 * n; i++)
            made[i] = i % 4 == 3 ? 1 : P[i / 4 * 3 + i % 4];
    } else {
        Pw = params_list(q, "Pw", 1u << PARAM_FLOAT, 4, &n, NULL);
    }
    if (!q->failed && n != u.n * v.n)
        type_error(q, "a nurbs needs nu nv = %d points \"P\" or \"Pw\", not %d", u.n * v.n, n);
    if (!q->failed && !nurbs_mesh(&u, &v, Pw, m, SUBDIVIDE_MAX_TRIANGLES - p->n_subdivided, &inner))
        type_error(q, "%s", inner.text);
    p->n_subdivided += m->n_triangles;
    free(made);
}

static void plymesh(struct parser *p, void *object)
{
    struct params *q = &p->params;
    struct mesh *m = mesh_of(object);
    struct source_position at;
    struct error inner;
    char *path = params_file(q, "filename", &at);
    if (path == NULL)
        type_error(q, "a plymesh needs its file: add \"string filename\" \"...\"");
    else if (!ply_read(path, m, &inner) || !scene_files_count(q->files, m->content, m->file_size, &inner))
        params_fail(q, at, "%s", inner.text);
    else if (m->n_thin > 0)
        source_warn(q->messages, at, "%d faces of fewer than 3 corners are left out", m->n_thin);
    free(path);
    holes(p, object);
}

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

/* pbrt-v3 has no sampling of the others, so no light can sit on them. */
static struct quadric *unlit_quadric(struct parser *p, void *object)
{
    if (p->state.area.on)
        type_error(&p->params, "a %s cannot be an area light, here as in pbrt-v3; end the AreaLightSource before it",
                   p->params.type);
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

/* --- the table ---------------------------------------------------------------------------------------- */

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

static const struct field TRIANGLEMESH[] = {
    {.name = "P"}, {.name = "N"}, {.name = "S"}, {.name = "uv"}, {.name = "st"}, {.name = "indices"},
    {"faceIndices", .kind = FIELD_IGNORED}, /* for Ptex only */
    {.name = "alpha"}, {.name = "shadowalpha"},
    {.name = NULL}};
static const struct field PLYMESH[] = {
    {.name = "filename"}, {.name = "alpha"}, {.name = "shadowalpha"},
    {.name = NULL}};
static const struct field LOOPSUBDIV[] = {
    {.name = "levels"}, {.name = "nlevels"}, {.name = "indices"}, {.name = "P"},
    {"scheme", .kind = FIELD_IGNORED}, /* there is but one */
    {.name = NULL}};
static const struct field HEIGHTFIELD[] = {
    {.name = "nu"}, {.name = "nv"}, {.name = "Pz"},
    {.name = NULL}};
static const struct field CURVE[] = {
    {.name = "P"}, {.name = "N"}, {.name = "width"}, {.name = "width0"}, {.name = "width1"},
    {.name = "degree"}, {.name = "basis"}, {.name = "type"},
    {"splitdepth", .kind = FIELD_IGNORED},
    {.name = NULL}};
static const struct field NURBS[] = {
    {.name = "P"}, {.name = "Pw"}, {.name = "nu"}, {.name = "uorder"}, {.name = "uknots"}, {.name = "u0"},
    {.name = "u1"}, {.name = "nv"}, {.name = "vorder"}, {.name = "vknots"}, {.name = "v0"}, {.name = "v1"},
    {.name = NULL}};

static const struct object_type TYPES[] = {
    {"trianglemesh", TRIANGLEMESH, 0, trianglemesh},
    {"plymesh", PLYMESH, 0, plymesh},
    {"sphere", SPHERE, QUADRIC_SPHERE, sphere},
    {"disk", DISK, QUADRIC_DISK, disk},
    {"cylinder", SPHERE, QUADRIC_CYLINDER, cylinder},
    {"cone", CONE, QUADRIC_CONE, cone},
    {"paraboloid", SPHERE, QUADRIC_PARABOLOID, paraboloid},
    {"hyperboloid", HYPERBOLOID, QUADRIC_HYPERBOLOID, hyperboloid},
    {"loopsubdiv", LOOPSUBDIV, 0, loopsubdiv},
    {"heightfield", HEIGHTFIELD, 0, heightfield},
    {"curve", CURVE, 0, curve},
    {"nurbs", NURBS, 0, nurbs},
    {.name = NULL}};

/* --- the directive ------------------------------------------------------------------------------------ */

/* Is there anything to be seen of it? What has no material bounds media, of which there are none here. */
static bool is_seen(const struct shape_item *item)
{
    bool empty = item->is_mesh && item->mesh.n_triangles == 0;
    return !empty && (item->group.material != MATERIAL_NONE || item->area.on);
}

static bool shape(struct parser *p)
{
    struct shape_item item = {.to_world = p->place.ctm, .reverse = p->state.reverse, .area = p->state.area};
    item.group.alpha = item.group.shadow_alpha = item.group.first_light = -1;
    parse_fields(p, &item);
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

const struct directive SHAPE_DIRECTIVES[] = {{"Shape", IN_WORLD, shape, TYPES}, {.name = NULL}};
