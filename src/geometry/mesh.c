/* mesh.c: see mesh.h; and the mesh that a scene file spells out. */
#include <stddef.h>

#include "base/mem.h"
#include "geometry/mesh.h"

struct trianglemesh {
    struct field_list P, N, S, uv, st, indices;
};

/* A list of numbers as floats. */
static float *floats(const double *number, int n)
{
    float *out = mem_alloc((size_t)n, sizeof *out);
    for (int i = 0; i < n; i++)
        out[i] = (float)number[i]; /* within NUMBER_MAX */
    return out;
}

/* Data per vertex besides P: where there is less of it than of P, or of N or S more, pbrt-v3 goes on without it. */
static float *vertex_data(struct mesh_task *task, const char *name, struct field_list list, int width, int n_vertices)
{
    if (list.number == NULL)
        return NULL;
    bool kept = list.n == n_vertices || (list.n > n_vertices && width == 2);
    task->about = name;
    if (list.n != n_vertices)
        task->warn(task, "\"%s\" has %d entries but \"P\" has %d points; %s", name, list.n, n_vertices,
                   kept ? "the rest is passed over" : "it is passed over");
    return kept ? floats(list.number, n_vertices * width) : NULL;
}

void mesh_triangles(struct field_list P, struct field_list indices, struct mesh_task *task, struct mesh *out)
{
    int n = P.n > 0 ? indices.n : 0;
    out->n_vertices = P.n;
    out->P = mem_alloc((size_t)P.n, sizeof *out->P);
    for (int i = 0; i < P.n; i++)
        out->P[i] = vec(P.number[3 * i], P.number[3 * i + 1], P.number[3 * i + 2]);
    out->index = mem_alloc((size_t)n, 3 * sizeof *out->index);
    task->about = "indices";
    for (int i = 0; i < 3 * n; i++) {
        double index = indices.number[i];
        if (!(index > -1 && index < P.n)) {
            task->warn(task, "number %d of the indices is %g: \"P\" has %d points, 0 to %d", i + 1, index, P.n,
                       P.n - 1);
            n = 0;
            break;
        }
        out->index[i] = (uint32_t)index;
    }
    out->n_triangles = n;
    task->about = NULL;
    if (n == 0)
        task->warn(task, "a %s without usable \"point P\" and \"integer indices\" is left out, as in pbrt-v3",
                   task->shape);
}

bool mesh_fits(struct mesh_task *task, double triangles)
{
    const double bytes = 200; /* of a triangle and its corners */
    struct error why;
    if (triangles <= FIRST_QUADRIC && budget_has(task->memory, bytes * triangles, &why))
        return true;
    return error_set(&task->err, "%.4g triangles: %s", triangles,
                     triangles <= FIRST_QUADRIC ? why.text : "there can be 2^30");
}

static bool mesh(const void *fields, struct mesh_task *task, struct mesh *out)
{
    const struct trianglemesh *t = fields;
    mesh_triangles(t->P, t->indices, task, out);
    out->N = vertex_data(task, "N", t->N, 3, out->n_vertices);
    out->S = vertex_data(task, "S", t->S, 3, out->n_vertices);
    out->UV = vertex_data(task, "uv", t->uv, 2, out->n_vertices);
    if (out->UV == NULL)
        out->UV = vertex_data(task, "st", t->st, 2, out->n_vertices);
    return true;
}

#define AT(member) offsetof(struct trianglemesh, member)
static const struct field FIELDS[] = {
    {"P", .kind = FIELD_POINTS, .place = AT(P)},
    {"N", .kind = FIELD_NORMALS, .place = AT(N)},
    {"S", .kind = FIELD_VECTORS, .place = AT(S)},
    {"uv", .kind = FIELD_PAIRS, .place = AT(uv)},
    {"st", .kind = FIELD_PAIRS, .place = AT(st)},
    {"indices", .kind = FIELD_INDICES, .place = AT(indices)},
    {"faceIndices", .kind = FIELD_IGNORED}, /* for Ptex only */
    {.name = "alpha"}, {.name = "shadowalpha"},
    {.name = NULL}};

const struct shape_row shape_trianglemesh = {.name = "trianglemesh", .fields = FIELDS,
    .size = sizeof(struct trianglemesh), .may_shine = true, .mesh = mesh};

/* A new shape of triangles is a new file and a line here. */
extern const struct shape_row shape_plymesh, shape_loopsubdiv, shape_curve;

const struct shape_row *const shape_rows[] = {&shape_trianglemesh, &shape_plymesh, &shape_loopsubdiv, &shape_curve,
                                              NULL};
