/* polygon.c: see polygon.h. */
#include "geometry/polygon.h"

#include <stdlib.h>

#include "base/mem.h"
#include "base/vec.h"

/* Those corners of a polygon that are left. */
struct ring {
    vec3 *at;            /* [n] places of all corners */
    int *before, *after; /* [n] neighbours */
    bool *is_ear;        /* [n] */
    vec3 normal;         /* of the polygon, twice its area long */
};

static vec3 point(const float *P, uint32_t i)
{
    const float *p = P + 3 * (size_t)i;
    return vec((double)p[0], (double)p[1], (double)p[2]);
}

/* Twice the area of a triangle, seen along the normal, times the normal's length; above 0 where it turns left. */
static double turn(vec3 normal, vec3 a, vec3 b, vec3 c) { return dot(normal, cross(sub(b, a), sub(c, a))); }

/* The sum of the normals of the triangles of any cut is the polygon's. */
static vec3 fan_normal(const float *P, const uint32_t *index, int n)
{
    vec3 sum = vec(0, 0, 0);
    for (const uint32_t *t = index; t < index + 3 * (n - 2); t += 3)
        sum = add(sum, cross(sub(point(P, t[1]), point(P, t[0])), sub(point(P, t[2]), point(P, t[0]))));
    return sum;
}

bool polygon_fan_fits(const float *P, const uint32_t *index, int n)
{
    vec3 normal = fan_normal(P, index, n);
    double slack = 1e-6 * dot(normal, normal); /* of corners on a line, by rounding */
    for (const uint32_t *t = index; t < index + 3 * (n - 2); t += 3)
        if (turn(normal, point(P, t[0]), point(P, t[1]), point(P, t[2])) < -slack)
            return false;
    return true;
}

static bool same(vec3 a, vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/* Is corner i an ear? Corners in the places of the ear's own belong to bridges that join a hole to the outside. */
static bool is_ear(const struct ring *r, int i)
{
    vec3 a = r->at[r->before[i]], b = r->at[i], c = r->at[r->after[i]];
    if (turn(r->normal, a, b, c) <= 0)
        return false;
    for (int k = r->after[r->after[i]]; k != r->before[i]; k = r->after[k]) {
        vec3 p = r->at[k];
        if (turn(r->normal, a, b, p) >= 0 && turn(r->normal, b, c, p) >= 0 && turn(r->normal, c, a, p) >= 0 &&
            !same(p, a) && !same(p, b) && !same(p, c))
            return false;
    }
    return true;
}

/* Take corner i off; only its neighbours may become ears by that, or cease to be. */
static void unlink_corner(struct ring *r, int i)
{
    int before = r->before[i], after = r->after[i];
    r->after[before] = after;
    r->before[after] = before;
    r->is_ear[before] = is_ear(r, before);
    r->is_ear[after] = is_ear(r, after);
}

void polygon_cut_ears(const float *P, uint32_t *index, int n)
{
    uint32_t *corner = mem_alloc((size_t)n, sizeof *corner);
    struct ring r = {mem_alloc((size_t)n, sizeof *r.at), mem_alloc((size_t)n, sizeof *r.before),
                     mem_alloc((size_t)n, sizeof *r.after), mem_alloc((size_t)n, sizeof *r.is_ear),
                     fan_normal(P, index, n)};
    for (int i = 0; i < n; i++) {
        corner[i] = i < 3 ? index[i] : index[3 * (i - 2)];
        r.at[i] = point(P, corner[i]);
        r.before[i] = (i + n - 1) % n;
        r.after[i] = (i + 1) % n;
    }
    for (int i = 0; i < n; i++)
        r.is_ear[i] = is_ear(&r, i);
    for (int left = n, i = 0; left > 2; left--, i = r.after[i]) {
        for (int k = 0; k < left && !r.is_ear[i]; k++) /* if none is one, any goes */
            i = r.after[i];
        *index++ = corner[r.before[i]];
        *index++ = corner[i];
        *index++ = corner[r.after[i]];
        unlink_corner(&r, i);
    }
    free(r.is_ear);
    free(r.after);
    free(r.before);
    free(r.at);
    free(corner);
}
