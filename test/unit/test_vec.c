/* test_vec.c: vectors, frames, transforms, and the exact values of random numbers. */
#include "base/vec.h"

#include "base/bits.h"
#include "base/number.h"
#include "base/rng.h"
#include "base/transform.h"
#include "base/warp.h"
#include "lab/numbers.h"
#include "helpers.h"
#include "suites.h"

/* The values are those of the generator's published demonstration. */
static void check_rng(struct test *t)
{
    static const uint32_t golden[] = {0xa15c02b7u, 0x7b47f409u, 0xba1d3330u, 0x83d2f293u};
    struct rng r;
    rng_seed(&r, 42, 54);
    for (int i = 0; i < 4; i++) {
        uint32_t x = rng_u32(&r);
        CHECK(t, x == golden[i], "number %d is %08lx", i, (unsigned long)x);
    }
    struct rng a = rng_stream(1, RNG_EYE, 7, 3);
    struct rng other[] = {a, rng_stream(1, RNG_LIGHT, 7, 3), rng_stream(2, RNG_EYE, 7, 3), rng_stream(1, RNG_EYE, 8, 3),
                          rng_stream(1, RNG_EYE, 7, 4)};
    uint32_t first = rng_u32(&a);
    for (int i = 0; i < 5; i++)
        CHECK(t, (first == rng_u32(&other[i])) == (i == 0), "purpose, seed, pixel, iteration: name %d", i);
    for (int i = 0; i < 1000; i++) {
        uint32_t below = rng_below(&a, 7);
        double u = rng_uniform(&a);
        CHECK(t, below < 7 && u >= 0 && u < 1, "out of range: %lu %g", (unsigned long)below, u);
    }
}

static void check_bits(struct test *t)
{
    static const uint8_t bytes[] = {0x12, 0x34, 0x56, 0x78};
    CHECK(t, reverse_bits(1) == 0x80000000u && reverse_bits(0x12345678u) == 0x1e6a2c48u, "reversed bits");
    CHECK(t, bits_of_bytes(bytes, 4, true) == 0x12345678u && bits_of_bytes(bytes, 4, false) == 0x78563412u, "bytes");
    CHECK(t, below_one(1) < 1 && below_one(1) == nextafter(1, 0) && below_one(0.5) == 0.5, "below_one");
    CHECK(t, float_below(0.1) < 0.1 && float_above(0.1) > 0.1 && float_below(0.5) == 0.5f, "float_below, float_above");
}

static void check_frame(struct test *t, struct frame f, vec3 n)
{
    double worst = fabs(dot(f.s, f.t)) + fabs(dot(f.s, f.n)) + fabs(dot(f.t, f.n));
    worst +=
        fabs(length(f.s) - 1) + fabs(length(f.t) - 1) + length(sub(cross(f.s, f.t), f.n)) + length(sub(f.n, n));
    CHECK(t, worst < 1e-13, "frame around (%g, %g, %g) is off by %g", n.x, n.y, n.z, worst);
    vec3 w = vec(0.36, 0.48, -0.8);
    CHECK(t, near3(to_local(&f, to_world(&f, w)), w, 1e-14), "there and back differs");
}

static void check_frames(struct test *t, struct rng *r)
{
    vec3 special[] = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {1e-9, 0, -1}, {0, 1e-160, -1}};
    for (int i = 0; i < 6; i++)
        check_frame(t, frame_from_normal(normalize(special[i])), normalize(special[i]));
    for (int i = 0; i < 200; i++) {
        vec3 n = on_sphere(r), tangent = on_sphere(r);
        check_frame(t, frame_from_normal(n), n);
        struct frame f = frame_from_tangent(n, tangent);
        check_frame(t, f, n);
        CHECK(t, fabs(dot(f.t, tangent)) < 1e-12 && dot(f.s, tangent) > 0, "s is not the nearest to the tangent");
        check_frame(t, frame_from_tangent(n, mul(n, 3)), n);
        check_frame(t, frame_from_tangent(n, vec(0, 0, 0)), n);
    }
}

static double inverse_error(const struct transform *t)
{
    double worst = 0;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            double sum = i == j ? -1 : 0;
            for (int k = 0; k < 4; k++)
                sum += t->m[i][k] * t->inv[k][j];
            worst = most_of(worst, fabs(sum));
        }
    return worst;
}

/* What each transform does, on points whose image is plain. */
static void check_transforms_known(struct test *t)
{
    struct transform move = transform_translate(vec(1, 2, 3)), turn = transform_rotate(90, vec(0, 0, 5));
    struct transform scale = transform_scale(2, -3, 4), both = transform_compose(move, turn), view;
    CHECK(t, near3(transform_point(&move, vec(1, 1, 1)), vec(2, 3, 4), 0), "translate a point");
    CHECK(t, near3(transform_point_back(&move, vec(2, 3, 4)), vec(1, 1, 1), 0), "move a point back");
    CHECK(t, near3(transform_vector_back(&turn, vec(0, 1, 0)), vec(1, 0, 0), 1e-15), "turn a vector back");
    CHECK(t, near3(transform_vector(&move, vec(1, 1, 1)), vec(1, 1, 1), 0), "translate a vector");
    CHECK(t, near3(transform_point(&turn, vec(1, 0, 0)), vec(0, 1, 0), 1e-15), "rotate x by 90 degrees around z");
    CHECK(t, near3(transform_point(&both, vec(1, 0, 0)), vec(1, 3, 3), 1e-15), "compose applies the second first");
    CHECK(t, transform_swaps_handedness(&scale) && !transform_swaps_handedness(&turn), "handedness");
    CHECK(t, fabs(transform_determinant(&scale) + 24) < 1e-12, "determinant");
    CHECK(t, transform_look_at(vec(3, 4, 5), vec(3, 4, 9), vec(0, 1, 0), &view), "look_at");
    CHECK(t, near3(transform_point(&view, vec(3, 4, 7)), vec(0, 0, 2), 1e-12), "the view looks along +z");
    CHECK(t, near3(transform_point(&view, vec(4, 4, 5)), vec(1, 0, 0), 1e-12), "right is +x: left-handed");
    CHECK(t, !transform_look_at(vec(0, 0, 0), vec(0, 1, 0), vec(0, 2, 0), &view), "up along the view is refused");
}

static void check_matrices(struct test *t)
{
    double listed[16] = {2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1},
           flat[16] = {1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0, 0, 0, 0, 1};
    double tiny[16] = {1e-10, 0, 0, 0, 0, 1e10, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    struct transform m = transform_identity();
    CHECK(t, transform_from_matrix(listed, &m), "a plain matrix");
    CHECK(t, near3(transform_point(&m, vec(1, 1, 1)), vec(7, 9, 11), 0), "columns first");
    CHECK(t, !transform_from_matrix(flat, &m), "a singular matrix is refused");
    CHECK(t, transform_from_matrix(tiny, &m), "very different scales are no reason to refuse");
    listed[3] = NAN;
    CHECK(t, !transform_from_matrix(listed, &m), "NaN is refused");
    double projective[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1};
    CHECK(t, transform_from_matrix(projective, &m), "a projective matrix");
    CHECK(t, near3(transform_point(&m, vec(2, 4, 1)), vec(1, 2, 0.5), 1e-15), "points are divided by w");
}

static void check_transforms_random(struct test *t, struct rng *r)
{
    for (int i = 0; i < 200; i++) {
        struct transform a = random_affine(r), b = random_affine(r), ab = transform_compose(a, b);
        struct transform back = transform_inverse(ab),
                         turn = transform_rotate(360 * rng_uniform(r), on_sphere(r));
        vec3 p = on_sphere(r), q = on_sphere(r);
        CHECK(t, inverse_error(&a) < 1e-11 && inverse_error(&ab) < 1e-10, "inverse off by %g", inverse_error(&ab));
        CHECK(t, inverse_error(&turn) < 1e-14, "a rotation's inverse");
        CHECK(t, near3(transform_point(&ab, p), transform_point(&a, transform_point(&b, p)), 1e-12), "product");
        CHECK(t, near3(transform_point(&back, transform_point(&ab, p)), p, 1e-10), "there and back differs");
        double angle = dot(transform_normal(&a, cross(p, q)), transform_vector(&a, p));
        CHECK(t, fabs(angle) < 1e-10, "a normal is no longer orthogonal to its plane: %g", angle);
    }
}

/* Every double becomes an index or a float, and those that are none are known. */
static void check_conversions(struct test *t)
{
    static const struct {
        double x;
        int index; /* within [2, 9] */
    } cases[] = {{NAN, 2}, {-INFINITY, 2}, {INFINITY, 9}, {-1e308, 2}, {1e308, 9},   {4294967296.0 * 65536, 9},
                 {2, 2},   {1.999, 2},     {2.999, 2},    {3, 3},      {8.9999, 8},  {9, 9},
                 {0, 2},   {5e-324, 2}};
    for (int i = 0; i < (int)(sizeof cases / sizeof cases[0]); i++)
        CHECK(t, int_within(cases[i].x, 2, 9) == cases[i].index, "%g becomes %d", cases[i].x,
              int_within(cases[i].x, 2, 9));
    CHECK(t, float_within(NAN) == 0 && float_within(0.1) == 0.1f, "NaN or 0.1 as a float");
    CHECK(t, float_within(1e39) == FLT_MAX && float_within(-INFINITY) == -FLT_MAX, "large numbers as floats");
    CHECK(t, fits_float(FLT_MAX) && fits_float(-1) && !fits_float(3.5e38) && !fits_float(NAN), "what a float holds");
}

static void check_usable(struct test *t, struct rng *r)
{
    const double sheared[16] = {1, 0, 0, 0, 1e20, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    struct transform m = transform_scale(1e29, 1e-29, 1), far = transform_translate(vec(1e17, 0, 0));
    CHECK(t, transform_is_usable(&m), "a scale of 1e29");
    m = transform_compose(m, m);
    CHECK(t, !transform_is_usable(&m), "a scale of 1e58");
    m = transform_scale(1e-309, 1, 1);
    CHECK(t, !transform_is_usable(&m), "an infinite inverse");
    m = transform_rotate(30, vec(1e200, 0, 0));
    CHECK(t, !transform_is_usable(&m), "an axis whose length is infinite");
    if (CHECK(t, transform_from_matrix(sheared, &m), "a shear has an inverse")) {
        struct transform twice = transform_compose(m, transform_compose(transform_rotate(90, vec(0, 0, 1)), m));
        CHECK(t, transform_is_usable(&m) && !transform_is_usable(&twice), "shears that cancel each other's digits");
    }
    for (int i = 0; i < 200; i++) {
        m = transform_compose(far, random_affine(r));
        CHECK(t, transform_is_usable(&m), "an ordinary transform, far away");
    }
}

void test_vec(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 100, 0);
    check_rng(t);
    check_bits(t);
    check_frames(t, &r);
    check_transforms_known(t);
    check_matrices(t);
    check_transforms_random(t, &r);
    check_conversions(t);
    check_usable(t, &r);
}
