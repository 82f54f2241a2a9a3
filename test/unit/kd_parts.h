/* kd_parts.h: what tests of the kd-tree have in common: geometry that builders and traversals get wrong, awkward rays,
 * and a loop over all primitives.
 *
 * Tests: test_kdtree.c, test_objects.c. */
#ifndef ASBDPT_TEST_KD_PARTS_H
#define ASBDPT_TEST_KD_PARTS_H

#include "base/rng.h"
#include "geometry/kdtree.h"
#include "test.h"

/* in_cube: a point from -1 to 1. axis: one of six directions. */
vec3 in_cube(struct rng *r);
vec3 axis(int i);

/* Triangles in a mesh. make_random: of a size, about the offset. make_needles: long and thin, some of no area.
 * make_grids: squares on integer coordinates, some of them twice. make_duplicates: one many times, and a few others.
 * make_ball: a closed surface of rows x columns quads. add_triangle: with corners of its own. */
void add_triangle(struct mesh *s, vec3 a, vec3 b, vec3 c);
void make_random(struct mesh *s, struct rng *r, int n, double size, vec3 offset);
void make_needles(struct mesh *s, struct rng *r, int n);
void make_grids(struct mesh *s, int n);
void make_duplicates(struct mesh *s, struct rng *r, int n);
void make_ball(struct mesh *s, struct rng *r, int rows, int columns, double radius, vec3 center);

/* geometry_of: the mesh becomes a geometry. add_quadrics: n of all kinds more. prim_number: of its primitive i. */
struct geometry geometry_of(struct test *t, struct mesh *s);
void add_quadrics(struct geometry *geo, struct rng *r, int n);
int prim_number(const struct geometry *geo, int i);

/* awkward_ray: along axes, in planes, through corners and edges; of a geometry that is so wide. */
struct ray awkward_ray(const struct geometry *geo, struct rng *r, double size);

/* brute_closest: what kd_closest is to find, among the primitives without material (see_through) or those with one. */
bool brute_closest(const struct geometry *geo, bool see_through, const struct ray *ray, struct hit *hit);

#endif
