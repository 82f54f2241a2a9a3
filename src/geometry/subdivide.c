/* subdivide.c: Loop subdivision of triangle meshes, as pbrt-v3's "loopsubdiv" defines it.
 *
 * Each level cuts every triangle in four and moves the vertices; at the end they are moved to where infinitely many
 * levels would take them, and get the normals of that limit surface, on the side from which the corners of a triangle
 * run clockwise. Points that no triangle uses stay where they are. [Loop 1987] [PBRT3 3.8]
 *
 * A mesh is its half-edges: half-edge h = 3 f + k of triangle f runs from corner k to the next.
 *
 * Tests: test_mesh.c.
 */
#include <stdlib.h>
#include <string.h>

#include "base/maths.h"
#include "base/mem.h"
#include "geometry/mesh.h"

/* A level of the mesh. */
struct level {
    vec3 *p;           /* [n_vertices] */
    uint32_t *corner;  /* [3 n_triangles] vertex where a half-edge begins */
    int32_t *opposite; /* [3 n_triangles] the half-edge that runs back along the same edge; -1 at the boundary */
    int32_t *out;      /* [n_vertices] a half-edge that begins at the vertex; -1: there is none */
    int n_vertices, n_triangles;
};

static struct level level_make(int n_vertices, int n_triangles)
{
    size_t n = (size_t)n_vertices, halves = 3 * (size_t)n_triangles;
    struct level l = {.n_vertices = n_vertices, .n_triangles = n_triangles};
    l.p = mem_alloc(n, sizeof *l.p);
    l.corner = mem_alloc(halves, sizeof *l.corner);
    l.opposite = mem_alloc(halves, sizeof *l.opposite);
    l.out = mem_alloc(n, sizeof *l.out);
    return l;
}

static void level_free(struct level *l)
{
    free(l->p);
    free(l->corner);
    free(l->opposite);
    free(l->out);
}

static int next_half(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
static int prev_half(int h) { return h % 3 == 0 ? h + 2 : h - 1; }
static int end_of(const struct level *l, int h) { return (int)l->corner[next_half(h)]; }

/* --- the control mesh ---------------------------------------------------------------------------------- */

struct edge {
    uint64_t ends; /* the numbers of its vertices, the lower one in the upper half */
    int32_t half;
};

static int by_ends(const void *a, const void *b)
{
    const struct edge *x = a, *y = b;
    if (x->ends != y->ends)
        return x->ends < y->ends ? -1 : 1;
    return x->half < y->half ? -1 : x->half > y->half;
}

/* Find the opposites. False if an edge has more than two triangles, or two that do not run opposite ways. */
static bool join_edges(struct level *l, struct error *err)
{
    int n = 3 * l->n_triangles;
    bool ok = true;
    struct edge *edge = mem_alloc((size_t)n, sizeof *edge);
    for (int h = 0; h < n; h++) {
        uint64_t a = l->corner[h], b = l->corner[next_half(h)];
        edge[h] = (struct edge){a < b ? a << 32 | b : b << 32 | a, h};
    }
    qsort(edge, (size_t)n, sizeof *edge, by_ends);
    for (int i = 0, k; i < n && ok; i = k) {
        for (k = i + 1; k < n && edge[k].ends == edge[i].ends; k++)
            ;
        bool paired = k - i == 2 && l->corner[edge[i].half] != l->corner[edge[i + 1].half];
        uint32_t low = (uint32_t)(edge[i].ends >> 32), high = (uint32_t)edge[i].ends;
        l->opposite[edge[i].half] = paired ? edge[i + 1].half : -1;
        if (paired)
            l->opposite[edge[i + 1].half] = edge[i].half;
        if (low == high || (k - i > 1 && !paired))
            ok = error_set(err, "no surface can be made of this mesh: the edge between points %lu and %lu has %d "
                           "triangles, or two that run along it the same way", (unsigned long)low, (unsigned long)high,
                           k - i);
    }
    free(edge);
    return ok;
}

static void find_out(struct level *l)
{
    for (int v = 0; v < l->n_vertices; v++)
        l->out[v] = -1;
    for (int h = 0; h < 3 * l->n_triangles; h++)
        l->out[l->corner[h]] = h;
}

/* --- neighbours of a vertex ---------------------------------------------------------------------------- */

/* The points around a vertex: all around it, clockwise; at the boundary from side to side, counterclockwise. */
struct ring {
    vec3 *p; /* [n], owned */
    int n;
    bool boundary;
};

static void ring_add(struct ring *r, vec3 p)
{
    r->p = mem_append(r->p, (size_t)r->n, sizeof *r->p);
    r->p[r->n++] = p;
}

/* The triangles around a vertex form a fan, since every half-edge has one opposite at most: it ends at two boundaries
 * or where it began. */
static void ring_around(const struct level *l, int v, struct ring *r)
{
    int first = l->out[v], h = first;
    r->n = 0;
    r->boundary = false;
    if (first < 0)
        return;
    do {
        ring_add(r, l->p[end_of(l, h)]);
        if (l->opposite[h] < 0)
            r->boundary = true;
        else
            h = next_half(l->opposite[h]);
    } while (!r->boundary && h != first);
    if (!r->boundary)
        return;
    r->n = 0;
    ring_add(r, l->p[end_of(l, h)]);
    for (; h >= 0; h = l->opposite[prev_half(h)])
        ring_add(r, l->p[l->corner[prev_half(h)]]);
}

/* The vertex keeps what is left of 1 after giving `weight` to each neighbour, on the boundary to the two along it. */
static vec3 blend(const struct ring *r, vec3 p, double weight)
{
    vec3 sum = vec(0, 0, 0);
    if (r->n == 0)
        return p;
    if (r->boundary)
        return add(mul(p, 1 - 2 * weight), mul(add(r->p[0], r->p[r->n - 1]), weight));
    for (int i = 0; i < r->n; i++)
        sum = add(sum, r->p[i]);
    return add(mul(p, 1 - r->n * weight), mul(sum, weight));
}

/* --- one level ----------------------------------------------------------------------------------------- */

/* Weight of each of n neighbours of a vertex inside, in Warren's form of the scheme. [PBRT3 3.8.2] */
static double inner_weight(int n) { return n == 3 ? 3.0 / 16 : 3.0 / (8 * n); }

/* A new vertex on the edge of half-edge h: 3/8 of its ends and 1/8 of the points across; at the boundary the middle.
 * [PBRT3 3.8.2] */
static vec3 edge_point(const struct level *l, int h)
{
    vec3 ends = add(l->p[l->corner[h]], l->p[end_of(l, h)]);
    if (l->opposite[h] < 0)
        return mul(ends, 0.5);
    vec3 across = add(l->p[l->corner[prev_half(h)]], l->p[l->corner[prev_half(l->opposite[h])]]);
    return add(mul(ends, 0.375), mul(across, 0.125));
}

/* Triangle f becomes 4 f + k, which keeps corner k in its place, and 4 f + 3 in the middle, whose corner k lies on edge
 * k. Halves of opposite edges are opposite. */
static void split(const struct level *l, int f, const uint32_t *on_edge, struct level *out)
{
    for (int k = 0; k < 3; k++) {
        int h = 3 * f + k, prev = prev_half(h), k1 = (k + 1) % 3, k2 = (k + 2) % 3;
        int child = 3 * (4 * f + k), middle = 3 * (4 * f + 3);
        out->corner[child + k] = l->corner[h];
        out->corner[child + k1] = on_edge[h];
        out->corner[child + k2] = on_edge[prev];
        out->corner[middle + k] = on_edge[h];
        out->opposite[child + k1] = middle + k2;
        out->opposite[middle + k2] = child + k1;
        int there = l->opposite[h], back = l->opposite[prev];
        out->opposite[child + k] = there < 0 ? -1 : 3 * (4 * (there / 3) + (there + 1) % 3) + there % 3;
        out->opposite[child + k2] = back < 0 ? -1 : 3 * (4 * (back / 3) + back % 3) + back % 3;
    }
}

static struct level refine(const struct level *l, struct ring *ring)
{
    int n = 3 * l->n_triangles, n_vertices = l->n_vertices;
    uint32_t *on_edge = mem_alloc((size_t)n, sizeof *on_edge);
    for (int h = 0; h < n; h++) {
        int back = l->opposite[h];
        on_edge[h] = back >= 0 && back < h ? on_edge[back] : (uint32_t)n_vertices++;
    }
    struct level out = level_make(n_vertices, 4 * l->n_triangles);
    for (int v = 0; v < l->n_vertices; v++) {
        ring_around(l, v, ring);
        out.p[v] = blend(ring, l->p[v], ring->boundary ? 1.0 / 8 : inner_weight(ring->n));
    }
    for (int h = 0; h < n; h++)
        out.p[on_edge[h]] = edge_point(l, h);
    for (int f = 0; f < l->n_triangles; f++)
        split(l, f, on_edge, &out);
    find_out(&out);
    free(on_edge);
    return out;
}

/* --- the limit ----------------------------------------------------------------------------------------- */

static vec3 limit_point(const struct ring *r, vec3 p)
{
    return blend(r, p, r->boundary ? 1.0 / 5 : 1 / (r->n + 3 / (8 * inner_weight(r->n))));
}

/* The direction of the limit surface across its boundary at point p; ring->n >= 2. [PBRT3 3.8.2] */
static vec3 across_boundary(const struct ring *r, vec3 p)
{
    int last = r->n - 1;
    vec3 ends = add(r->p[0], r->p[last]);
    if (r->n == 2)
        return sub(ends, mul(p, 2));
    if (r->n == 3)
        return sub(r->p[1], p);
    if (r->n == 4)
        return sub(mul(add(r->p[1], r->p[2]), 2), add(ends, mul(p, 2)));
    double theta = PI / last;
    vec3 sum = mul(ends, -m_sin(theta));
    for (int k = 1; k < last; k++)
        sum = add(sum, mul(r->p[k], (2 - 2 * m_cos(theta)) * m_sin(k * theta)));
    return sum;
}

/* Normal of the limit surface: the product of two of its tangents, as long as in pbrt-v3. */
static vec3 limit_normal(const struct ring *r, vec3 p)
{
    vec3 s = vec(0, 0, 0), t = s;
    if (r->boundary) {
        s = sub(r->p[r->n - 1], r->p[0]);
        t = across_boundary(r, p);
    }
    for (int i = 0; i < r->n && !r->boundary; i++) {
        s = add(s, mul(r->p[i], m_cos(2 * PI * i / r->n)));
        t = add(t, mul(r->p[i], m_sin(2 * PI * i / r->n)));
    }
    return cross(s, t);
}

/* Move the vertices to their limits, then find the normals there, as pbrt-v3 does in this order. The mesh takes over
 * the corners. */
static struct mesh limit_mesh(struct level *l, struct ring *ring)
{
    struct mesh m = {.index = l->corner, .n_vertices = l->n_vertices, .n_triangles = l->n_triangles};
    vec3 *limit = m.P = mem_alloc((size_t)m.n_vertices, sizeof *m.P), *p = l->p;
    m.N = mem_alloc((size_t)m.n_vertices, 3 * sizeof *m.N);
    for (int v = 0; v < m.n_vertices; v++) {
        ring_around(l, v, ring);
        limit[v] = limit_point(ring, p[v]);
    }
    l->p = limit;
    for (int v = 0; v < m.n_vertices; v++) {
        ring_around(l, v, ring);
        store3(m.N, (size_t)v, limit_normal(ring, limit[v]));
    }
    l->corner = NULL;
    l->p = p;
    return m;
}

static struct level control_level(const struct mesh *m)
{
    struct level l = level_make(m->n_vertices, m->n_triangles);
    memcpy(l.p, m->P, (size_t)m->n_vertices * sizeof *l.p);
    for (int h = 0; h < 3 * m->n_triangles; h++)
        l.corner[h] = m->index[h];
    find_out(&l);
    return l;
}

struct loopsubdiv {
    int levels;
    struct field_list P, indices;
};

/* Put the surface in the place of its control mesh. */
static bool subdivide(struct mesh *m, int levels, struct mesh_task *task)
{
    if (!mesh_fits(task, m->n_triangles * m_pow(4, levels)))
        return false;
    struct level l = control_level(m);
    struct ring ring = {0};
    bool ok = join_edges(&l, &task->err);
    for (int i = 0; i < levels && ok; i++) {
        struct level finer = refine(&l, &ring);
        level_free(&l);
        l = finer;
    }
    if (ok) {
        mesh_free(m);
        *m = limit_mesh(&l, &ring);
    }
    level_free(&l);
    free(ring.p);
    return ok;
}

static bool mesh(const void *fields, struct mesh_task *task, struct mesh *out)
{
    const struct loopsubdiv *s = fields;
    mesh_triangles(s->P, s->indices, task, out);
    return out->n_triangles == 0 || subdivide(out, s->levels, task);
}

/* As in pbrt-v3 "levels" wins. */
#define AT(member) offsetof(struct loopsubdiv, member)
static const struct field FIELDS[] = {{"nlevels", FIELD_INTEGER, AT(levels), 3, 0, .high = 30},
                                      {"levels", FIELD_INTEGER, AT(levels), FIELD_KEPT, 0, .high = 30},
                                      {"P", .kind = FIELD_POINTS, .place = AT(P)},
                                      {"indices", .kind = FIELD_INDICES, .place = AT(indices)},
                                      {"scheme", .kind = FIELD_IGNORED}, /* there is only one */
                                      {.name = NULL}};

const struct shape_row shape_loopsubdiv = {
    .name = "loopsubdiv", .fields = FIELDS, .size = sizeof(struct loopsubdiv), .may_shine = true, .mesh = mesh};
