/* test_ellipse.c: points of a triangle that give a path the wanted length are drawn with the density that is stated.
 * What pictures of narrow gates make of them is in test_gates.c. */
#include "rivals/ellipse.h"

#include <math.h>

#include "base/rng.h"
#include "caustics/specular.h"
#include "suites.h"

enum { TRIANGLES = 8 };

/* Two points and a triangle that does not come near them, and all lengths of the ways by it. */
struct placing {
    vec3 y, z, corner[3];
    double least, most;
};

static vec3 around(struct rng *r, vec3 centre, double size)
{
    double u[3] = {rng_uniform(r), rng_uniform(r), rng_uniform(r)};
    return add(centre, mul(vec(u[0] - 0.5, u[1] - 0.5, u[2] - 0.5), size));
}

static double way(const struct placing *s, vec3 x) { return length(sub(x, s->y)) + length(sub(x, s->z)); }

static struct placing any_setting(struct rng *r)
{
    struct placing s = {.y = around(r, vec(-1, 0, 0), 1), .z = around(r, vec(1, 0, 0), 1)};
    for (int i = 0; i < 3; i++) {
        s.corner[i] = around(r, vec(0, 0, 2.5), 2.5);
        s.most = fmax(s.most, way(&s, s.corner[i]));
    }
    s.least = length(sub(s.y, s.z));
    return s;
}

static vec3 point(const struct placing *s, double b1, double b2)
{
    return add(add(mul(s->corner[0], 1 - b1 - b2), mul(s->corner[1], b1)), mul(s->corner[2], b2));
}

/* What arrives by way of the triangle, but for materials. */
static double arrives(const struct placing *s, vec3 x)
{
    return 1 / (length2(sub(x, s->y)) * length2(sub(x, s->z)));
}

/* Points lie where light's way has the length that was asked for. In each of some gates, and in all together, what is
 * drawn brings as much as a sum over small parts of the triangle has; no numbers are random here. */
static void integrals(struct test *t, const struct placing *s)
{
    enum { GATES = 4, FINE = 300, LENGTHS = 256, ANGLES = 64 };
    double sum[GATES] = {0}, total = 0, all = 0, range = (s->most - s->least) / GATES, pdf;
    double area = length(cross(sub(s->corner[1], s->corner[0]), sub(s->corner[2], s->corner[0]))) / 2;
    int off = 0;
    vec3 x;
    for (int i = 0; i < FINE; i++)
        for (int j = 0; i + j < FINE; j++)
            for (int k = 1; k <= 2 && i + j + k <= FINE; k++) {
                x = point(s, (i + k / 3.0) / FINE, (j + k / 3.0) / FINE);
                double f = arrives(s, x) * area / (FINE * FINE);
                sum[(int)fmin((way(s, x) - s->least) / range, GATES - 1)] += f;
                total += f;
            }
    for (int g = 0; g < GATES; g++) {
        double mean = 0;
        for (int i = 0; i < LENGTHS * ANGLES; i++) {
            double tau = s->least + range * (g + (i / ANGLES + 0.5) / LENGTHS), u = (i % ANGLES + 0.5) / ANGLES;
            if (!ellipse_draw(s->y, s->z, s->corner, tau, range, u, &x, &pdf))
                continue;
            mean += arrives(s, x) / pdf / (LENGTHS * ANGLES);
            off += !(fabs(way(s, x) / tau - 1) < 1e-9);
        }
        CHECK(t, fabs(mean - sum[g]) < 0.005 * total, "gate %d: %g, not %g, of %g", g, mean, sum[g], total);
        all += mean;
    }
    CHECK(t, off == 0, "the ways by %d points have other lengths", off);
    CHECK(t, fabs(all / total - 1) < 0.002, "all gates: %g, not %g", all, total);
}

void test_ellipse(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 73, 0);
    for (int i = 0; i < TRIANGLES; i++) {
        struct placing s = any_setting(&r);
        integrals(t, &s);
    }
}
