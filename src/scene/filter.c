/* filter.c: see filter.h. The shapes are those of [PBRT3 7.8]. */
#include "scene/filter.h"

#include <math.h>
#include <string.h>

#include "base/alias.h"
#include "base/maths.h"
#include "base/near.h"
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

const char *const FILTER_NAMES[] = {"box", "triangle", "gaussian", "mitchell", "sinc", NULL};

bool filter_default(const char *name, struct filter *out)
{
    static const double RADIUS[] = {0.5, 2, 2, 2, 4};
    int kind = names_find(FILTER_NAMES, name);
    if (kind >= 0)
        *out = (struct filter){.kind = (enum filter_kind)kind, .radius = {RADIUS[kind], RADIUS[kind]}, .alpha = 2,
                               .B = 1.0 / 3, .C = 1.0 / 3, .tau = 3};
    return kind >= 0;
}

/* Integrals by the midpoint rule on a grid that is fine enough for its error not to matter; filter_sample makes up for
 * the steps of the table. Weights of both signs would add up to noise by coarse ones. */
static void prepare_axis(struct filter *f, int axis)
{
    enum { GRID = 4096 };
    f->steps = f->kind == FILTER_GAUSSIAN ? FILTER_STEPS / 8 : FILTER_STEPS;
    double r = f->radius[axis], step = 2 * r / f->steps, fine = 2 * r / GRID, integral = 0;
    for (int i = 0; i < f->steps; i++) {
        double mass[2] = {0, 0};
        for (int k = 0; k < GRID / f->steps; k++) {
            double y = profile(f, axis, -r + i * step + (k + 0.5) * fine);
            integral += y * fine;
            mass[y < 0] += fabs(y) * fine;
        }
        for (int below = 0; below < 2; below++)
            f->cdf[axis][below][i + 1] = f->cdf[axis][below][i] + mass[below];
    }
    f->norm[axis] = 1 / integral;
    for (int below = 0; below < 2; below++) {
        double *cdf = f->cdf[axis][below], all = cdf[f->steps];
        f->mass[axis][below] = all / integral;
        for (int i = 0; i <= f->steps && all > 0; i++)
            cdf[i] /= all;
    }
}

void filter_prepare(struct filter *f)
{
    memset(f->cdf, 0, sizeof f->cdf);
    prepare_axis(f, 0);
    prepare_axis(f, 1);
}

double filter_eval(const struct filter *f, double dx, double dy)
{
    return profile(f, 0, dx) * f->norm[0] * profile(f, 1, dy) * f->norm[1];
}

/* Integrals of |h| where h is below 0, and where it is not. */
static double negative(const struct filter *f)
{
    return f->mass[0][0] * f->mass[1][1] + f->mass[0][1] * f->mass[1][0];
}
static double positive(const struct filter *f)
{
    return f->mass[0][0] * f->mass[1][0] + f->mass[0][1] * f->mass[1][1];
}

int filter_cycle(const struct filter *f) { return negative(f) > 0 ? FILTER_CYCLE : 1; }

/* Is u, uniform in [0,1), below the share? It then is uniform in [0,1) again. */
static bool take(double *u, double share)
{
    bool below = *u < share;
    *u = below_one(below ? *u / share : (*u - share) / (1 - share));
    return below;
}

/* Choose where h is below 0, as one sample in a cycle is, or where it is not, and then of the lobes that do this the
 * sign of each axis' profile. Uses up u in part; returns the probability. */
static double choose_signs(const struct filter *f, double *u, bool below[2])
{
    const double of_cycle = 1.0 / FILTER_CYCLE;
    below[0] = below[1] = false;
    if (!(negative(f) > 0))
        return 1;
    bool minus = take(u, of_cycle);
    double share = f->mass[0][1] * f->mass[1][!minus] / (minus ? negative(f) : positive(f));
    below[0] = take(u, share);
    below[1] = below[0] != minus;
    return (minus ? of_cycle : 1 - of_cycle) * (below[0] ? share : 1 - share);
}

/* Inverse of the tabulated distribution of one sign; returns h1(x)/density(x), 0 where h1 has the other sign. */
static double sample_table(const struct filter *f, int axis, bool below, double u, double *x)
{
    const double *cdf = f->cdf[axis][below];
    int i = cumulative_find(cdf, f->steps, u);
    double r = f->radius[axis], step = 2 * r / f->steps, mass = cdf[i + 1] - cdf[i];
    *x = -r + (i + (u - cdf[i]) / mass) * step;
    double y = profile(f, axis, *x);
    return (y < 0) == below ? y * f->norm[axis] * step / mass : 0;
}

static double sample_axis(const struct filter *f, int axis, bool below, double u, double *x)
{
    double r = f->radius[axis];
    switch (f->kind) {
    case FILTER_BOX: *x = r * (2 * u - 1); return 1;
    case FILTER_TRIANGLE: *x = u < 0.5 ? r * (sqrt(2 * u) - 1) : r * (1 - sqrt(2 * (1 - u))); return 1;
    case FILTER_GAUSSIAN:
    case FILTER_MITCHELL:
    case FILTER_SINC: return sample_table(f, axis, below, u, x);
    }
    return 0;
}

double filter_sample(const struct filter *f, double u1, double u2, double *dx, double *dy)
{
    bool below[2];
    double probability = choose_signs(f, &u1, below);
    double wx = sample_axis(f, 0, below[0], u1, dx), wy = sample_axis(f, 1, below[1], u2, dy);
    return wx * wy / probability;
}
