/* test_warp.c: every map of warp.h draws with the density that it states. Each sample is turned into two coordinates
 * in which the density is known in closed form per cell of a grid. */
#include "base/warp.h"

#include <math.h>

#include "base/rng.h"
#include "lab/stats.h"
#include "suites.h"

enum { ROWS = 10, COLUMNS = 20, SAMPLES = 100000 };

enum warp_kind { DISK, COS_HEMISPHERE, SPHERE, CONE, TRIANGLE, N_WARPS };
static const char *const NAME[] = {"disk", "cos hemisphere", "sphere", "cone", "triangle"};
static const double CONE_COS = 0.7;

/* Where the sample lies: `a` along the rows and `b` along the columns, both in [0,1]. */
static void locate(enum warp_kind kind, double u1, double u2, double *a, double *b)
{
    double x = 0, y = 0;
    vec3 w = vec(0, 0, 0);
    switch (kind) {
    case DISK:
        warp_disk(u1, u2, &x, &y);
        *a = sqrt(x * x + y * y);
        break;
    case COS_HEMISPHERE:
        w = warp_cos_hemisphere(u1, u2);
        *a = w.z;
        break;
    case SPHERE:
        w = warp_sphere(u1, u2);
        *a = 0.5 + 0.5 * w.z;
        break;
    case CONE:
        w = warp_cone(u1, u2, CONE_COS);
        *a = (w.z - CONE_COS) / (1 - CONE_COS);
        break;
    case TRIANGLE: /* a: height above the side b1 + b2 = 0 ... 1, b: place along the parallel */
        warp_triangle(u1, u2, &x, &y);
        *a = 1 - x;
        *b = y / (1 - x);
        return;
    case N_WARPS: break;
    }
    if (kind != DISK) {
        x = w.x;
        y = w.y;
    }
    *b = 0.5 + atan2(y, x) / (2 * PI);
}

/* The probability of a in [a0,a1], by integrating the density of warp.h over the ring it stands for (b is uniform).
 */
static double ring(enum warp_kind kind, double a0, double a1)
{
    switch (kind) {
    case DISK: return a1 * a1 - a0 * a0;
    case COS_HEMISPHERE: return 2 * PI * (a1 - a0) * warp_cos_hemisphere_pdf_w(0.5 * (a0 + a1));
    case SPHERE: return 2 * PI * 2 * (a1 - a0) * warp_sphere_pdf_w();
    case CONE: return 2 * PI * (1 - CONE_COS) * (a1 - a0) * warp_cone_pdf_w(CONE_COS);
    case TRIANGLE: return a1 * a1 - a0 * a0;
    case N_WARPS: break;
    }
    return 0;
}

static double warp_p(enum warp_kind sampled, enum warp_kind claimed, int n, struct rng *r)
{
    double count[ROWS * COLUMNS] = {0}, expected[ROWS * COLUMNS];
    for (int i = 0; i < n; i++) {
        double a = 0, b = 0, u1 = rng_uniform(r), u2 = rng_uniform(r);
        locate(sampled, u1, u2, &a, &b);
        int row = (int)(clamp(a, 0, 1) * ROWS), column = (int)(clamp(b, 0, 1) * COLUMNS);
        row = row < ROWS ? row : ROWS - 1;
        column = column < COLUMNS ? column : COLUMNS - 1;
        count[row * COLUMNS + column]++;
    }
    for (int row = 0; row < ROWS; row++)
        for (int column = 0; column < COLUMNS; column++)
            expected[row * COLUMNS + column] =
                n * ring(claimed, (double)row / ROWS, (row + 1.0) / ROWS) / COLUMNS;
    return stats_chi2_test(count, expected, ROWS * COLUMNS);
}

/* Unit length, right side, and no trouble at the ends of the square. */
static void facts(struct test *t)
{
    const double last = 1 - 1.0 / 4294967296.0;
    for (int i = 0; i <= 10; i++)
        for (int j = 0; j <= 10; j++) {
            double u1 = fmin(i / 10.0, last), u2 = fmin(j / 10.0, last), x, y;
            vec3 h = warp_cos_hemisphere(u1, u2), s = warp_sphere(u1, u2), c = warp_cone(u1, u2, CONE_COS);
            CHECK(t, fabs(length(h) - 1) < 1e-12 && h.z >= 0, "hemisphere at %g %g", u1, u2);
            CHECK(t, fabs(length(s) - 1) < 1e-12, "sphere at %g %g", u1, u2);
            CHECK(t, fabs(length(c) - 1) < 1e-12 && c.z >= CONE_COS, "cone at %g %g", u1, u2);
            warp_disk(u1, u2, &x, &y);
            CHECK(t, x * x + y * y <= 1 + 1e-12, "disk at %g %g", u1, u2);
            warp_triangle(u1, u2, &x, &y);
            CHECK(t, x >= 0 && y >= 0 && x + y <= 1 + 1e-15, "triangle at %g %g", u1, u2);
        }
    CHECK(t, warp_cos_hemisphere_pdf_w(-0.5) == 0, "nothing below the horizon");
}

void test_warp(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 7, 0);
    int n = SAMPLES * test_effort(t);
    facts(t);
    for (int kind = 0; kind < N_WARPS; kind++)
        TEST_ACCEPT(t, warp_p((enum warp_kind)kind, (enum warp_kind)kind, n, &r), "warp %s", NAME[kind]);
    TEST_REJECT(t, warp_p(COS_HEMISPHERE, CONE, n, &r), "cosine-weighted directions claimed to be uniform");
    TEST_REJECT(t, warp_p(SPHERE, DISK, n, &r), "uniform directions claimed to have a radial density");
    TEST_REJECT(t, warp_p(CONE, TRIANGLE, n, &r), "cone samples with a wrong density");
}
