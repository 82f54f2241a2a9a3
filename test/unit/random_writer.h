/* random_writer.h: text with random numbers and linear maps in it, of which random scenes are made (random_scene.h).
 *
 * Maps are kept here as three columns, with arithmetic of their own, so that what a scene must show is not computed by
 * the code under test.
 */
#ifndef ASBDPT_TEST_RANDOM_WRITER_H
#define ASBDPT_TEST_RANDOM_WRITER_H

#include <stdbool.h>
#include <stddef.h>

#include "base/rng.h"
#include "base/vec.h"

struct writer {
    struct rng rng;
    const char *top; /* before names of pictures */
    bool evil;
    char *text;
    size_t used, capacity;
    int textures;              /* "s0", "f0", "s1", ... are defined */
    bool specular, delta_light, rare; /* what has been written so far */
    bool media;                 /* there are some, so that every lamp has a material and stands in what is around */
    double away;                /* how far the scene is moved, in its units */
    bool placed;                /* see random_scene.h */
    const char *around;         /* the medium that the camera is in; "": none */
    bool boxes;                 /* boxes of media lie on the ground: no lamp comes near */
};

/* put: text, as printf. put_numbers: n numbers and blanks, some of them evil if the scene is. put_vec: three. */
void put(struct writer *w, const char *format, ...);
void put_numbers(struct writer *w, int n, const double *x);
void put_vec(struct writer *w, vec3 v);

/* Parameters "KIND NAME": put_list of n numbers, put_point of three; put_float "float NAME", put_rgb "rgb NAME". */
void put_list(struct writer *w, const char *kind, const char *name, int n, const double *x);
void put_point(struct writer *w, const char *kind, const char *name, vec3 v);
void put_float(struct writer *w, const char *name, double value);
void put_rgb(struct writer *w, const char *name, double r, double g, double b);

/* pick: 0 to n - 1. chance: true with this probability. between: uniform. across: uniform in the logarithm.
 * direction: uniform on the sphere. within: uniform in a box. stretches: three numbers of `across`.
 *
 * C leaves open which argument of a call is computed first. So an expression has one of these at the most: scenes are
 * the same by every compiler. */
int pick(struct writer *w, int n);
bool chance(struct writer *w, double probability);
double between(struct writer *w, double low, double high);
double across(struct writer *w, double low, double high);
vec3 direction(struct writer *w);
vec3 within(struct writer *w, vec3 low, vec3 high);
vec3 stretches(struct writer *w, double low, double high);

/* A linear map: what becomes of the three axes. */
struct map {
    vec3 x, y, z;
};
struct map map_identity(void);
struct map map_uneven(struct writer *w); /* axes are stretched, lean towards each other, one may be turned round */
struct map map_random(struct writer *w); /* the same, then turned to anywhere */
struct map map_frame(vec3 z);            /* a rotation that takes the z axis there */
struct map map_then(struct map first, struct map second);
struct map map_scaled(struct map m, double factor);
vec3 map_apply(const struct map *m, vec3 v);
vec3 map_back(const struct map *m, vec3 v);
vec3 map_normal(const struct map *m, vec3 n); /* by the inverse transpose; not normalised */

/* put_map: as a ConcatTransform. */
void put_map(struct writer *w, const struct map *m);

/* put_quad: a parallelogram with the corner a and the edges u and v; its normal, where lamps shine to, is u x v. */
void put_quad(struct writer *w, vec3 a, vec3 u, vec3 v);

#endif
