/* transform.c: see transform.h. Matrices multiply column vectors, as in [PBRT3 2.7]. */
#include "base/transform.h"

#include <float.h>
#include <string.h>

#include "base/maths.h"
#include "base/number.h"

struct transform transform_identity(void)
{
    return (struct transform){{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}},
                              {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
}

static void multiply(const double a[4][4], const double b[4][4], double out[4][4])
{
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            out[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j] + a[i][3] * b[3][j];
}

/* Is the inverse one in fact, in the first columns of their product? */
static bool is_inverse(const struct transform *t, int columns)
{
    double product[4][4];
    multiply((const double(*)[4])t->m, (const double(*)[4])t->inv, product);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < columns; j++)
            if (!(fabs(product[i][j] - (i == j)) <= 1e-3))
                return false;
    return true;
}

/* Fill t->inv by Gauss-Jordan elimination with partial pivoting; false for a singular matrix, also for one whose last
 * pivot is not quite 0. */
static bool invert(struct transform *t)
{
    double a[4][8]; /* the matrix, and to its right the identity, which becomes the inverse */
    for (int i = 0; i < 32; i++)
        a[i / 8][i % 8] = i % 8 < 4 ? t->m[i / 8][i % 8] : i % 8 - 4 == i / 8;
    for (int c = 0; c < 4; c++) {
        int pivot = c;
        for (int r = c + 1; r < 4; r++)
            if (fabs(a[r][c]) > fabs(a[pivot][c]))
                pivot = r;
        if (a[pivot][c] == 0)
            return false;
        double scale = 1 / a[pivot][c];
        for (int k = 0; k < 8; k++) { /* the two rows change places */
            double own = a[c][k];
            a[c][k] = a[pivot][k] * scale;
            if (pivot != c)
                a[pivot][k] = own;
        }
        for (int r = 0; r < 4; r++) {
            double factor = r == c ? 0 : a[r][c];
            for (int k = 0; k < 8; k++)
                a[r][k] -= factor * a[c][k];
        }
    }
    for (int i = 0; i < 4; i++)
        memcpy(t->inv[i], a[i] + 4, sizeof t->inv[i]);
    return is_inverse(t, 4);
}

bool transform_is_usable(const struct transform *t)
{
    for (int i = 0; i < 16; i++) {
        double limit = i % 4 < 3 ? NUMBER_MAX : DBL_MAX;
        if (!(fabs(t->m[i / 4][i % 4]) <= limit && fabs(t->inv[i / 4][i % 4]) <= limit))
            return false;
    }
    return is_inverse(t, 3);
}

bool transform_from_matrix(const double columns[16], struct transform *out)
{
    struct transform t;
    for (int i = 0; i < 16; i++) {
        if (!isfinite(columns[i]))
            return false;
        t.m[i % 4][i / 4] = columns[i];
    }
    if (!invert(&t))
        return false;
    *out = t;
    return true;
}

struct transform transform_translate(vec3 delta)
{
    return (struct transform){{{1, 0, 0, delta.x}, {0, 1, 0, delta.y}, {0, 0, 1, delta.z}, {0, 0, 0, 1}},
                              {{1, 0, 0, -delta.x}, {0, 1, 0, -delta.y}, {0, 0, 1, -delta.z}, {0, 0, 0, 1}}};
}

struct transform transform_scale(double x, double y, double z)
{
    return (struct transform){{{x, 0, 0, 0}, {0, y, 0, 0}, {0, 0, z, 0}, {0, 0, 0, 1}},
                              {{1 / x, 0, 0, 0}, {0, 1 / y, 0, 0}, {0, 0, 1 / z, 0}, {0, 0, 0, 1}}};
}

struct transform transform_rotate(double degrees, vec3 axis)
{
    /* Rodrigues [PBRT3 2.7.6]: R = cos I + (1 - cos) a a^T + sin [a]_x; the inverse of a rotation is its transpose. */
    vec3 n = normalize(axis);
    double a[3] = {n.x, n.y, n.z};
    double s, c;
    m_sincos(degrees * PI / 180, &s, &c);
    double skew[3][3] = {{0, -n.z, n.y}, {n.z, 0, -n.x}, {-n.y, n.x, 0}};
    struct transform t = transform_identity();
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            t.m[i][j] = t.inv[j][i] = (i == j ? c : 0) + (1 - c) * a[i] * a[j] + s * skew[i][j];
    return t;
}

bool transform_look_at(vec3 eye, vec3 look, vec3 up, struct transform *out)
{
    vec3 forward = normalize(sub(look, eye));
    vec3 right = cross(normalize(up), forward);
    if (!(length(right) > 0))
        return false;
    right = normalize(right);
    vec3 above = cross(forward, right);
    double camera_to_world[16] = {right.x,   right.y,   right.z,   0, above.x, above.y, above.z, 0,
                                  forward.x, forward.y, forward.z, 0, eye.x,   eye.y,   eye.z,   1};
    struct transform t;
    if (!transform_from_matrix(camera_to_world, &t))
        return false;
    *out = transform_inverse(t);
    return true;
}

struct transform transform_compose(struct transform a, struct transform b)
{
    struct transform t;
    multiply((const double(*)[4])a.m, (const double(*)[4])b.m, t.m);
    multiply((const double(*)[4])b.inv, (const double(*)[4])a.inv, t.inv);
    return t;
}

struct transform transform_inverse(struct transform t)
{
    struct transform r;
    memcpy(r.m, t.inv, sizeof r.m);
    memcpy(r.inv, t.m, sizeof r.inv);
    return r;
}

static vec3 matrix_times_vector(const double (*m)[4], vec3 v)
{
    return vec(m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z, m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
               m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z);
}

static vec3 matrix_times_point(const double (*m)[4], vec3 p)
{
    vec3 q = add(matrix_times_vector(m, p), vec(m[0][3], m[1][3], m[2][3]));
    double w = m[3][0] * p.x + m[3][1] * p.y + m[3][2] * p.z + m[3][3];
    return w == 1 ? q : mul(q, 1 / w);
}

vec3 transform_point(const struct transform *t, vec3 p) { return matrix_times_point(t->m, p); }
vec3 transform_vector(const struct transform *t, vec3 v) { return matrix_times_vector(t->m, v); }
vec3 transform_point_back(const struct transform *t, vec3 p) { return matrix_times_point(t->inv, p); }
vec3 transform_vector_back(const struct transform *t, vec3 v) { return matrix_times_vector(t->inv, v); }

static vec3 transpose_times_vector(const double (*m)[4], vec3 n)
{
    return vec(m[0][0] * n.x + m[1][0] * n.y + m[2][0] * n.z, m[0][1] * n.x + m[1][1] * n.y + m[2][1] * n.z,
               m[0][2] * n.x + m[1][2] * n.y + m[2][2] * n.z);
}

vec3 transform_normal(const struct transform *t, vec3 n) { return transpose_times_vector(t->inv, n); }
vec3 transform_normal_back(const struct transform *t, vec3 n) { return transpose_times_vector(t->m, n); }

double transform_determinant(const struct transform *t)
{
    const double(*m)[4] = t->m;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

bool transform_swaps_handedness(const struct transform *t) { return transform_determinant(t) < 0; }
