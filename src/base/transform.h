/* transform.h: affine and projective 4x4 transforms with their inverses, in pbrt's conventions
 * (left-handed world, column vectors, angles in degrees). Tests: test_vec.c. */
#ifndef ASBDPT_TRANSFORM_H
#define ASBDPT_TRANSFORM_H

#include "base/vec.h"

/* A matrix and its inverse; row-major, m[row][column]. */
struct transform {
    double m[4][4], inv[4][4];
};

struct transform transform_identity(void);

/* transform_from_matrix: from 16 numbers as a scene file lists them, column by column.
 * Returns false, leaving *out alone, when the matrix is singular or not finite. */
bool transform_from_matrix(const double columns[16], struct transform *out);

struct transform transform_translate(vec3 delta);
struct transform transform_scale(double x, double y, double z);     /* none of them 0 */
struct transform transform_rotate(double degrees, vec3 axis);       /* which need not be unit, but not zero */

/* transform_look_at: world-to-camera as pbrt's LookAt. Returns false when up is parallel to the view. */
bool transform_look_at(vec3 eye, vec3 look, vec3 up, struct transform *out);

/* transform_compose: first b, then a (the matrix product a b). transform_inverse: the inverse. */
struct transform transform_compose(struct transform a, struct transform b);
struct transform transform_inverse(struct transform t);

/* A point: with the translation, and the division that projective matrices ask for. A vector: by the upper left 3x3
 * part alone. A normal: by the inverse transpose. The last two are not normalised. _back: the same by the inverse. */
vec3 transform_point(const struct transform *t, vec3 p);
vec3 transform_vector(const struct transform *t, vec3 v);
vec3 transform_normal(const struct transform *t, vec3 n);
vec3 transform_point_back(const struct transform *t, vec3 p);
vec3 transform_vector_back(const struct transform *t, vec3 v);
vec3 transform_normal_back(const struct transform *t, vec3 n);

/* transform_determinant: of the upper left 3x3 part. transform_swaps_handedness: is it negative? */
double transform_determinant(const struct transform *t);
bool transform_swaps_handedness(const struct transform *t);

/* transform_is_usable: are all numbers finite, those that directions meet at most NUMBER_MAX, and is `inv` the inverse
 * in fact and not only in name? Then a direction stays a direction, both ways. A caller that places points has
 * to check where they lie (is_place). */
bool transform_is_usable(const struct transform *t);

#endif
