/* joint.h: connections in two steps, for methods that compare many and trace few shadow rays: first the value without
 * visibility, then whether both ends see each other, and the weight. Both steps are what connect.h does in one.
 *
 * Tests: test_rival_parts.c, test_rivals.c.
 */
#ifndef ASBDPT_JOINT_H
#define ASBDPT_JOINT_H

#include "transport/connect.h"
#include "transport/sample.h"

/* Of an eye vertex and a light point. `value` is C* without visibility. */
struct lit {
    const struct vertex *z;
    struct light_point at;
    double pdf; /* density of the point */
    rgb value;
    double pdf_z, pdf_rev_z; /* 1/sr, at z: of the direction to the light; of the reverse move to the vertex before z */
    double at_light; /* factor that turns the density of the direction into that of the point */
    vec3 w;          /* unit, from z to the point */
    double distance, falloff; /* distance of the point and 1/distance^2; at infinity: infinite and 1 */
};

/* Of two vertices. */
struct joint {
    const struct vertex *y, *z;
    rgb value;
    double pdf_y, pdf_z;         /* 1/sr, at y and at z, of the direction to the other */
    double pdf_rev_y, pdf_rev_z; /* 1/sr, of the reverse move from there to the vertex before */
    double length;               /* of the edge */
    vec3 w;                      /* its direction, unit, from z to y */
    double area_y, area_z;       /* factor that turns a density per steradian at the other end into one per area */
};

/* connect_light: the first step, to a point that was drawn with density `pdf`. False if no light can arrive; out->value
 * is black then.
 * connect_lit: the second step: visibility and weight. */
bool connect_light(const struct scene *scene, const struct vertex *z, const struct light_point *at, double pdf,
                   struct lit *out);
struct connection connect_lit(const struct scene *scene, const struct counts *counts, const struct lit *l);

/* connect_join: the first step. False if no light can arrive; out->value is black then.
 * connect_joint: the second step: visibility and weight. */
bool connect_join(const struct vertex *y, const struct vertex *z, struct joint *out);
struct connection connect_joint(const struct scene *scene, const struct counts *counts, const struct joint *j);

/* light_vertex: the y_0 of a point, without beta. */
static inline struct vertex light_vertex(const struct scene *scene, const struct counts *counts,
                                         const struct light_point *at)
{
    struct vertex y;
    vertex_light(scene, at, rgb_black(), counts->s0[LATER_HIT], &y);
    return y;
}

/* sample_alone: s = 0 and s = 1 for all n vertices of the eye sub-path. */
static inline void sample_alone(struct sample *sample, int n)
{
    for (int t = 2; t <= n; t++) {
        sample_s0(sample, t);
        sample_s1(sample, t);
    }
}

#endif
