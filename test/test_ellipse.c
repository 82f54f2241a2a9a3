/* test_ellipse.c: points of a triangle that give a path the wanted length are drawn with the density that is stated.
 * What pictures of narrow gates make of them is in test_gates.c. */
#include "rivals/ellipse.h"

#include <math.h>
#include <stdlib.h>

#include "base/mem.h"
#include "base/rng.h"
#include "caustics/specular.h"
#include "lab/stats.h"
#include "tests.h"

enum { TRIANGLES = 8, SIDE = 6 };

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

/* Which of SIDE^2 equal parts of the triangle x is in; -1 if it is not in it, or the way by x is not tau long. */
static int part_of(const struct placing *s, vec3 x, double tau)
{
    double b1, b2;
    vec3 a = sub(s->corner[1], s->corner[0]), b = sub(s->corner[2], s->corner[0]);
    if (!combination(a, b, sub(x, s->corner[0]), &b1, &b2) ||
        !(b1 > -1e-9 && b2 > -1e-9 && b1 + b2 < 1 + 1e-9 && fabs(way(s, x) / tau - 1) < 1e-9) ||
        length(sub(point(s, b1, b2), x)) > 1e-9)
        return -1;
    double i = SIDE * fmax(b1, 0), j = SIDE * fmax(b2, 0);
    int row = (int)fmin(i, SIDE - 1), column = (int)fmin(j, SIDE - 1);
    return 2 * (row * SIDE + column) + (i - row + j - column > 1);
}

/* Points that are kept with a probability in inverse proportion to their density are uniform; all points are not. */
static void uniform(struct test *t, struct rng *r, const struct placing *s)
{
    enum { DRAWS = 40000, CELLS = 2 * SIDE * SIDE };
    struct draw {
        int part;
        double inverse;
    } *draw = mem_alloc(DRAWS, sizeof *draw);
    double all[CELLS] = {0}, kept[CELLS] = {0}, even[2][CELLS] = {{0}}, most = 0, n_all = 0, n_kept = 0, pdf;
    int off = 0;
    for (int i = 0; i < DRAWS; i++) {
        double tau = s->least + (s->most - s->least) * rng_uniform(r);
        vec3 x;
        if (!ellipse_draw(s->y, s->z, s->corner, tau, s->most - s->least, rng_uniform(r), &x, &pdf))
            continue;
        draw[i].inverse = 1 / pdf;
        draw[i].part = part_of(s, x, tau);
        most = fmax(most, draw[i].inverse);
        off += draw[i].part < 0;
        all[draw[i].part < 0 ? 0 : draw[i].part]++;
        n_all++;
    }
    CHECK(t, off == 0, "%d points off the triangle or off the ellipsoid", off);
    for (int i = 0; i < DRAWS && off == 0; i++)
        if (rng_uniform(r) * most < draw[i].inverse) {
            kept[draw[i].part]++;
            n_kept++;
        }
    for (int i = 0; i < CELLS; i++) {
        bool is = i / 2 / SIDE + i / 2 % SIDE + i % 2 < SIDE; /* beyond the diagonal there is nothing */
        even[0][i] = is ? n_kept / (SIDE * SIDE) : 0;
        even[1][i] = is ? n_all / (SIDE * SIDE) : 0;
    }
    TEST_ACCEPT(t, stats_chi2_test(kept, even[0], CELLS), "%g of %g points are uniform", n_kept, n_all);
    TEST_REJECT(t, stats_chi2_test(all, even[1], CELLS), "%g points are uniform as they are", n_all);
    free(draw);
}

/* What arrives by way of the triangle, but for materials. */
static double arrives(const struct placing *s, vec3 x)
{
    return 1 / (length2(sub(x, s->y)) * length2(sub(x, s->z)));
}

/* In each of some gates, and in all together, what is drawn brings as much as a sum over small parts of the triangle
 * has; no numbers are random here. */
static void integrals(struct test *t, const struct placing *s)
{
    enum { GATES = 4, FINE = 300, LENGTHS = 256, ANGLES = 64 };
    double sum[GATES] = {0}, total = 0, all = 0, range = (s->most - s->least) / GATES, pdf;
    double area = length(cross(sub(s->corner[1], s->corner[0]), sub(s->corner[2], s->corner[0]))) / 2;
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
            if (ellipse_draw(s->y, s->z, s->corner, tau, range, u, &x, &pdf))
                mean += arrives(s, x) / pdf / (LENGTHS * ANGLES);
        }
        CHECK(t, fabs(mean - sum[g]) < 0.005 * total, "gate %d: %g, not %g, of %g", g, mean, sum[g], total);
        all += mean;
    }
    CHECK(t, fabs(all / total - 1) < 0.002, "all gates: %g, not %g", all, total);
}

void test_ellipse(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 73, 0);
    for (int i = 0; i < TRIANGLES; i++) {
        struct placing s = any_setting(&r);
        uniform(t, &r, &s);
        integrals(t, &s);
    }
}
