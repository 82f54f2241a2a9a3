/* filter.c: see filter.h. The shapes are those of [PBRT3 7.8]. */
#include "scene/filter.h"

#include <math.h>
#include <string.h>

#include "base/alias.h"
#include "base/maths.h"
#include "base/vec.h"

/* [Mitchell & Netravali 1988] [PBRT3 7.8.1] */
static double mitchell(double x, double B, double C)
{
    x = fabs(2 * x);
    if (x > 2)
        return 0;
    if (x > 1)
        return ((-B - 6 * C) * x * x * x + (6 * B + 30 * C) * x * x + (-12 * B - 48 * C) * x + (8 * B + 24 * C)) / 6;
    return ((12 - 9 * B - 6 * C) * x * x * x + (-18 + 12 * B + 6 * C) * x * x + (6 - 2 * B)) / 6;
}

static double sinc(double x) { return fabs(x) < 1e-5 ? 1 : m_sin(PI * x) / (PI * x); }

/* One axis of the filter, not normalised. */
static double profile(const struct filter *f, int axis, double x)
{
    double r = f->radius[axis];
    if (fabs(x) > r)
        return 0;
    switch (f->kind) {
    case FILTER_BOX: return 1;
    case FILTER_TRIANGLE: return r - fabs(x);
    case FILTER_GAUSSIAN: return fmax(0, m_exp(-f->alpha * x * x) - m_exp(-f->alpha * r * r));
    case FILTER_MITCHELL: return mitchell(x / r, f->B, f->C);
    case FILTER_SINC: return sinc(x) * sinc(x / f->tau);
    }
    return 0;
}

bool filter_default(const char *name, struct filter *out)
{
    static const struct {
        const char *name;
        enum filter_kind kind;
        double radius;
    } known[] = {{"box", FILTER_BOX, 0.5},
                 {"triangle", FILTER_TRIANGLE, 2},
                 {"gaussian", FILTER_GAUSSIAN, 2},
                 {"mitchell", FILTER_MITCHELL, 2},
                 {"sinc", FILTER_SINC, 4}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (strcmp(name, known[i].name) != 0)
            continue;
        struct filter f = {.kind = known[i].kind, .alpha = 2, .B = 1.0 / 3, .C = 1.0 / 3, .tau = 3};
        f.radius[0] = f.radius[1] = known[i].radius;
        *out = f;
        return true;
    }
    return false;
}

/* The table's steps are fine enough that the midpoint rule's error does not matter: filter_sample corrects for it,
 * and the norm is integrated on a grid 16 times as fine. */
static void prepare_axis(struct filter *f, int axis)
{
    enum { FINE = 16 };
    double r = f->radius[axis], step = 2 * r / FILTER_STEPS, fine = step / FINE;
    double integral = 0, absolute = 0;
    f->cdf[axis][0] = 0;
    for (int i = 0; i < FILTER_STEPS; i++) {
        double sum_abs = 0;
        for (int k = 0; k < FINE; k++) {
            double y = profile(f, axis, -r + i * step + (k + 0.5) * fine);
            integral += y * fine;
            sum_abs += fabs(y) * fine;
        }
        absolute += sum_abs;
        f->cdf[axis][i + 1] = absolute;
    }
    for (int i = 0; i <= FILTER_STEPS; i++)
        f->cdf[axis][i] /= absolute;
    f->norm[axis] = 1 / integral;
}

void filter_prepare(struct filter *f)
{
    prepare_axis(f, 0);
    prepare_axis(f, 1);
}

double filter_eval(const struct filter *f, double dx, double dy)
{
    return profile(f, 0, dx) * f->norm[0] * profile(f, 1, dy) * f->norm[1];
}

/* Inverse of the tabulated distribution; returns h1(x)/density(x). */
static double sample_table(const struct filter *f, int axis, double u, double *x)
{
    const double *cdf = f->cdf[axis];
    int i = cumulative_find(cdf, FILTER_STEPS, u);
    double r = f->radius[axis], step = 2 * r / FILTER_STEPS, mass = cdf[i + 1] - cdf[i];
    *x = -r + (i + (u - cdf[i]) / mass) * step;
    return profile(f, axis, *x) * f->norm[axis] * step / mass;
}

static double sample_axis(const struct filter *f, int axis, double u, double *x)
{
    double r = f->radius[axis];
    switch (f->kind) {
    case FILTER_BOX: *x = r * (2 * u - 1); return 1;
    case FILTER_TRIANGLE: *x = u < 0.5 ? r * (sqrt(2 * u) - 1) : r * (1 - sqrt(2 * (1 - u))); return 1;
    case FILTER_GAUSSIAN:
    case FILTER_MITCHELL:
    case FILTER_SINC: return sample_table(f, axis, u, x);
    }
    return 0;
}

double filter_sample(const struct filter *f, double u1, double u2, double *dx, double *dy)
{
    double wx = sample_axis(f, 0, u1, dx), wy = sample_axis(f, 1, u2, dy);
    return wx * wy;
}
