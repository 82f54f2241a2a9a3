/* specular.h: a chain of k delta vertices between a point z and a light's point y: a direction w in which z may be left
 * and whose ray, traced through the chain, arrives at y.
 *
 * The search. u being the direction from the chain's last vertex p to y, and d the one in which the ray goes on, the
 * sum of squares of d(w) - u(w) is minimised by Gauss and Newton, the step halved where it is no nearer. Its
 * derivatives are those of a ray [Igehy 1999], by two directions across w; each step is a ray traced through the scene,
 * so what is found is visible. Bump maps are not differentiated: no chain goes over them.
 *
 * Which root is found is a function of z, y and the start (caustic.h). Tests: test_caustic.c.
 */
#ifndef ASBDPT_SPECULAR_H
#define ASBDPT_SPECULAR_H

#include "transport/vertex.h"

enum { SPECULAR_LONGEST = 2 };

/* combination: x and y for which x a + y b is nearest to v. False if a and b are parallel. */
static inline bool combination(vec3 a, vec3 b, vec3 v, double *x, double *y)
{
    double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), va = dot(v, a), vb = dot(v, b);
    double det = aa * bb - ab * ab;
    if (!(det > 0))
        return false;
    *x = (va * bb - vb * ab) / det;
    *y = (vb * aa - va * ab) / det;
    return true;
}

/* What a chain is looked for in, and between what. */
struct quest {
    const struct scene *scene;
    struct arena *arena;
    const struct vertex *z;
    const struct light_point *y;
    bool parallel; /* y is a direction */
    int group;     /* the mirror's; -1: through k surfaces */
    double chosen; /* probability with which it is looked for */
    int k;
};

/* A ray through the chain. */
struct specular_chain {
    vec3 w;                 /* unit, in which z was left */
    vec3 at[SPECULAR_LONGEST];
    vec3 p, d, dp[2], dd[2]; /* the last edge, and its derivatives */
    uint64_t prim_id;
    double length; /* from z to p */
    rgb kappa;
    double choice; /* probability that a walk takes these lobes, either way */
    double eta;    /* index of refraction here, relative to z's */
};

/* specular_trace: the chain that leaves z in direction w, unit; false if there is none. */
bool specular_trace(const struct quest *q, vec3 w, struct specular_chain *out);

/* specular_search: the chain from direction w on; false if none is found. */
bool specular_search(const struct quest *q, vec3 w, struct specular_chain *out);

/* specular_area: |det J|, the area of light per solid angle at z, across the last edge, m^2; of light from infinity the
 * solid angle. */
double specular_area(const struct quest *q, const struct specular_chain *c);

/* specular_normal_change: the derivative of the shading normal ns at a surface point that moves by dp along its
 * primitive. */
vec3 specular_normal_change(const struct geometry *geo, const struct surface *at, vec3 dp);

/* specular_group: the group that a surface point is of. */
int specular_group(const struct scene *scene, const struct surface *at);

#endif
