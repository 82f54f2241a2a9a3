/* polygon.c: see polygon.h. */
#include "geometry/polygon.h"

#include <stdlib.h>

#include "base/mem.h"

/* Those corners of a polygon that are left. */
struct ring {
    vec3 *at;    /* [n] places of all corners */
    int *after;  /* [n] the next corner */
    vec3 normal; /* of the polygon, twice its area long */
};

/* Twice the area of a triangle, seen along the normal, times the normal's length; above 0 where it turns left. */
static double turn(vec3 normal, vec3 a, vec3 b, vec3 c) { return dot(normal, cross(sub(b, a), sub(c, a))); }

static bool same(vec3 a, vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/* Is the corner behind k an ear? Others in the places of its own belong to bridges that join a hole to the outside. */
static bool is_ear(const struct ring *r, int k, double *room)
{
    int last = r->after[r->after[k]];
    vec3 a = r->at[k], b = r->at[r->after[k]], c = r->at[last];
    --*room;
    if (turn(r->normal, a, b, c) <= 0)
        return false;
    for (int i = r->after[last]; i != k; i = r->after[i], --*room) {
        vec3 p = r->at[i];
        if (turn(r->normal, a, b, p) >= 0 && turn(r->normal, b, c, p) >= 0 && turn(r->normal, c, a, p) >= 0 &&
            !same(p, a) && !same(p, b) && !same(p, c))
            return false;
    }
    return true;
}

static void cut_ears(const struct ring *r, const uint32_t *corner, uint32_t *index, int n, double *room)
{
    for (int k = 0; n > 2 && *room >= 0; n--) {
        for (int tried = 0; tried < n && !is_ear(r, k, room); tried++) /* if there is none, any goes */
            k = r->after[k];
        int ear = r->after[k];
        *index++ = corner[k];
        *index++ = corner[ear];
        *index++ = corner[r->after[ear]];
        r->after[k] = r->after[ear];
    }
}

bool polygon_cut(const vec3 *P, uint32_t *index, int n, double *room)
{
    const uint32_t *end = index + 3 * (n - 2);
    struct ring r = {.normal = vec(0, 0, 0)};
    double least = 0;
    for (const uint32_t *t = index; t < end; t += 3) /* whatever the cut, the polygon's normal is this sum */
        r.normal = add(r.normal, cross(sub(P[t[1]], P[t[0]]), sub(P[t[2]], P[t[0]])));
    for (const uint32_t *t = index; t < end; t += 3)
        least = fmin(least, turn(r.normal, P[t[0]], P[t[1]], P[t[2]]));
    if (least >= -1e-6 * dot(r.normal, r.normal)) /* of corners on a line, by rounding */
        return true;
    uint32_t *corner = mem_alloc((size_t)n, sizeof *corner);
    r.at = mem_alloc((size_t)n, sizeof *r.at);
    r.after = mem_alloc((size_t)n, sizeof *r.after);
    for (int i = 0; i < n; i++) {
        corner[i] = i < 3 ? index[i] : index[3 * (i - 2)];
        r.at[i] = P[corner[i]];
        r.after[i] = (i + 1) % n;
    }
    cut_ears(&r, corner, index, n, room);
    free(r.after);
    free(r.at);
    free(corner);
    return *room >= 0;
}
