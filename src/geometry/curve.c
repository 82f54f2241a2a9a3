/* curve.c: pbrt-v3's curves as triangles.
 *
 * A curve is a row of segments with a width: a strip that turns to each ray ("flat", or "cylinder" with the normals of
 * a tube), or one that follows normals ("ribbon"). What turns to each ray is no surface on which light could go both
 * ways, so both of the former become the tube that looks as wide. u runs along each segment, v around the tube or
 * across the ribbon.
 *
 * Tests: test_curve.c.
 */
#include "base/mem.h"
#include "base/number.h"
#include "base/vec.h"
#include "geometry/mesh.h"

enum { SIDES = 8, MOST_PIECES = 1024 }; /* of the tube's cross section; of a segment */
enum { BEZIER, BSPLINE };
enum { FLAT, RIBBON, CYLINDER };

struct curve {
    int degree, basis, type; /* degree 2 or 3; segments of a BEZIER share their end points, a BSPLINE is uniform */
    double width[2];         /* at both ends, >= 0 */
    struct field_list P, N;  /* control points; of a ribbon the normals at the ends of segments */
};

/* How many the control points make; 0 if they are too few or too many for whole ones. */
static int segments_of(const struct curve *c)
{
    if (c->P.n < c->degree + 1)
        return 0;
    if (c->basis == BSPLINE)
        return c->P.n - c->degree;
    return (c->P.n - 1) % c->degree == 0 ? (c->P.n - 1) / c->degree : 0;
}

static vec3 entry(struct field_list list, int i)
{
    return vec(list.number[3 * i], list.number[3 * i + 1], list.number[3 * i + 2]);
}

/* The Bezier points of a segment: of a B-spline its blossom at the knots around; a quadratic is a cubic, too. */
static void bezier(const struct curve *c, int segment, vec3 b[4])
{
    int first = c->basis == BSPLINE ? segment : segment * c->degree;
    vec3 p[4];
    for (int i = 0; i <= c->degree; i++)
        p[i] = entry(c->P, first + i);
    if (c->basis == BSPLINE && c->degree == 3) {
        b[1] = lerp3(1.0 / 3, p[1], p[2]);
        b[2] = lerp3(2.0 / 3, p[1], p[2]);
        b[0] = lerp3(0.5, lerp3(2.0 / 3, p[0], p[1]), b[1]);
        b[3] = lerp3(0.5, b[2], lerp3(1.0 / 3, p[2], p[3]));
    } else if (c->degree == 3) {
        for (int i = 0; i < 4; i++)
            b[i] = p[i];
    } else {
        b[0] = c->basis == BSPLINE ? lerp3(0.5, p[0], p[1]) : p[0];
        b[3] = c->basis == BSPLINE ? lerp3(0.5, p[1], p[2]) : p[2];
        b[1] = lerp3(2.0 / 3, b[0], p[1]);
        b[2] = lerp3(2.0 / 3, b[3], p[1]);
    }
}

/* A point of a segment, and the unit tangent there. Where that vanishes, as at coinciding points, the chord. */
static vec3 evaluate(const vec3 b[4], double u, vec3 *tangent)
{
    vec3 q[3], r[2];
    for (int i = 0; i < 3; i++)
        q[i] = lerp3(u, b[i], b[i + 1]);
    for (int i = 0; i < 2; i++)
        r[i] = lerp3(u, q[i], q[i + 1]);
    vec3 d = sub(r[1], r[0]), chord = sub(b[3], b[0]);
    d = length2(d) > 0 ? d : chord;
    *tangent = length2(d) > 0 ? normalize(d) : vec(0, 0, 1);
    return lerp3(u, r[0], r[1]);
}

/* A ribbon's normals at both ends of a segment, and the angle between them; that of a tube is 0. */
static double ribbon_turn(const struct curve *c, int segment, vec3 n[2])
{
    for (int i = 0; i < 2 && c->type == RIBBON; i++)
        n[i] = normalize(entry(c->N, segment + i));
    return c->type == RIBBON ? m_acos(fmin(fmax(dot(n[0], n[1]), 0), 1)) : 0;
}

/* So many straight pieces stay within a twentieth of the width. [PBRT3 3.7] Where a ribbon turns by a tenth, what is
 * seen of it lies within a thousandth of what is seen of a straight piece. */
static int pieces(const vec3 b[4], double width, double turn)
{
    double bend = 0;
    for (int i = 0; i < 2; i++)
        bend = fmax(bend, length(add(sub(b[i], mul(b[i + 1], 2)), b[i + 2])));
    double n = ceil(fmax(sqrt(sqrt(2) * 6 * bend / (8 * 0.05 * width)), turn / 0.1));
    return n >= 1 ? n < MOST_PIECES ? (int)n : MOST_PIECES : 1;
}

/* Make an empty mesh a net of points, both numbers >= 2, with two triangles between each four. The points, row by row,
 * and their N and UV are to be filled in. */
static void make_net(struct mesh *m, int columns, int rows)
{
    size_t n = (size_t)columns * (size_t)rows;
    m->n_vertices = columns * rows;
    m->P = mem_alloc(n, sizeof *m->P);
    m->N = mem_alloc(n, 3 * sizeof *m->N);
    m->UV = mem_alloc(n, 2 * sizeof *m->UV);
    m->index = mem_alloc(n, 6 * sizeof *m->index);
    for (int i = 0; i < m->n_vertices - columns; i++) {
        if (i % columns == columns - 1)
            continue;
        const int corner[6] = {i, i + 1, i + 1 + columns, i, i + 1 + columns, i + columns};
        for (int k = 0; k < 6; k++)
            m->index[3 * m->n_triangles + k] = (uint32_t)corner[k];
        m->n_triangles += 2;
    }
}

/* A row of the mesh around or across the curve at p, where x is a normal of it and y across both. */
static void put_row(struct mesh *m, int row, bool tube, vec3 p, vec3 x, vec3 y, double width)
{
    int n = tube ? SIDES + 1 : 2;
    /* A tube of many sides is seen as wide as a round one, on average over all directions, if as long around. */
    double radius = tube ? width * PI / (2 * SIDES * m_sin(PI / SIDES)) : width / 2;
    for (int i = 0; i < n; i++) {
        double v = (double)i / (n - 1);
        vec3 around = cylindrical(1, 2 * PI * (i % SIDES) / SIDES, 0);
        vec3 across = tube ? add(mul(x, around.x), mul(y, around.y)) : mul(y, 2 * v - 1);
        size_t k = (size_t)(row * n + i);
        m->P[k] = add(p, mul(across, radius));
        store3(m->N, k, tube ? across : x);
        m->UV[2 * k + 1] = (float)v;
    }
}

/* A ribbon's normal, turned evenly from one end of the segment to the other. */
static vec3 ribbon_normal(const vec3 n[2], double angle, double u)
{
    if (!(angle > 1e-6))
        return n[0];
    return add(mul(n[0], m_sin((1 - u) * angle)), mul(n[1], m_sin(u * angle)));
}

/* Within about a twentieth of its width, as pbrt-v3 refines it. Without width it leaves the mesh empty. */
static bool make(const struct curve *c, int segments, struct mesh_task *task, struct mesh *m)
{
    bool tube = c->type != RIBBON;
    int columns = tube ? SIDES + 1 : 2, row = 0;
    double widest = fmax(c->width[0], c->width[1]);
    vec3 b[4], ends[2], tangent, x = vec(0, 0, 0);
    int64_t rows = 0; /* of which a curve may have more than an int */
    for (int s = 0; s < segments; s++) {
        bezier(c, s, b);
        rows += pieces(b, widest, ribbon_turn(c, s, ends)) + 1;
    }
    if (widest == 0)
        return true;
    if (!mesh_fits(task, 2 * (double)rows * (columns - 1)))
        return false;
    make_net(m, columns, (int)rows);
    for (int s = 0; s < segments; s++) {
        bezier(c, s, b);
        double turn = ribbon_turn(c, s, ends);
        int n = pieces(b, widest, turn);
        for (int i = 0; i <= n; i++) {
            double u = (double)i / n, along = (s + u) / segments;
            vec3 p = evaluate(b, u, &tangent);
            /* The tube's frame is the one before, turned as little as can be. */
            x = frame_from_tangent(tangent, tube ? x : ribbon_normal(ends, turn, u)).s;
            for (int k = 0; k < columns; k++)
                m->UV[2 * (row * columns + k)] = (float)u;
            put_row(m, row++, tube, p, x, cross(x, tangent), (1 - along) * c->width[0] + along * c->width[1]);
        }
    }
    return true;
}

/* What turns to each ray in pbrt-v3 is drawn as a tube, of which "cylinder" has the normals already. */
static bool mesh(const void *fields, struct mesh_task *task, struct mesh *out)
{
    const struct curve *c = fields;
    int segments = segments_of(c);
    if (segments == 0)
        return error_set(&task->err, "%d points \"P\" are no curve of degree %d: of a bezier one there are 1 + a "
                         "multiple of it, of a bspline more than it", c->P.n, c->degree);
    if (c->type == RIBBON && (c->N.number == NULL || c->N.n != segments + 1))
        return error_set(&task->err, "this ribbon needs %d normals \"N\", one at each end of a segment", segments + 1);
    if (!make(c, segments, task, out))
        return false;
    if (c->type == FLAT)
        task->warn(task, "a flat curve turns to the viewer, which no surface does: it is drawn as the tube that "
                   "looks as wide");
    return true;
}

static const char *const TYPES[] = {"flat", "ribbon", "cylinder", NULL}, *const BASES[] = {"bezier", "bspline", NULL};
#define AT(member) offsetof(struct curve, member)
static const struct field FIELDS[] = {{"P", .kind = FIELD_POINTS, .place = AT(P)},
                                      {"N", .kind = FIELD_NORMALS, .place = AT(N)},
                                      {"width", FIELD_NUMBER, AT(width[0]), 1, 0, .high = NUMBER_MAX},
                                      {"width", FIELD_NUMBER, AT(width[1]), 1, 0, .high = NUMBER_MAX},
                                      {"width0", FIELD_NUMBER, AT(width[0]), FIELD_KEPT, 0, .high = NUMBER_MAX},
                                      {"width1", FIELD_NUMBER, AT(width[1]), FIELD_KEPT, 0, .high = NUMBER_MAX},
                                      {"degree", FIELD_INTEGER, AT(degree), 3, 2, .high = 3},
                                      {"basis", FIELD_WORD, AT(basis), .words = BASES},
                                      {"type", FIELD_WORD, AT(type), .words = TYPES},
                                      {"splitdepth", .kind = FIELD_IGNORED},
                                      {.name = NULL}};

const struct shape_row shape_curve = {
    .name = "curve", .fields = FIELDS, .size = sizeof(struct curve), .mesh = mesh};
