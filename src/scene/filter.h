/* filter.h: pixel reconstruction filters, pbrt-v3's five with its default radii.
 *
 * A pixel's value is the integral of h(p) L(p), h = filter / (integral of filter) centred on the pixel. Eye
 * samples draw p from |h| (filter importance sampling), so a sample counts for its own pixel only; a light-image
 * splat (t = 1) adds h(p) times its value to each pixel it reaches. Both estimate the same integral.
 *
 * Tests: test_film.c.
 */
#ifndef ASBDPT_FILTER_H
#define ASBDPT_FILTER_H

#include <stdbool.h>

enum filter_kind { FILTER_BOX, FILTER_TRIANGLE, FILTER_GAUSSIAN, FILTER_MITCHELL, FILTER_SINC };

enum { FILTER_STEPS = 256 }; /* of the sampling table, over [-radius, radius] */

/* Separable: f(x,y) = f1(x) f1(y), each with its own radius. */
struct filter {
    enum filter_kind kind;
    double radius[2]; /* x, y in pixels; > 0 */
    double alpha;     /* gaussian */
    double B, C;      /* mitchell */
    double tau;       /* sinc */
    /* filled by filter_prepare, per axis */
    double norm[2];                  /* 1 / integral of f1 */
    double cdf[2][FILTER_STEPS + 1]; /* running integral of |f1|, normalised; box, triangle: unused */
};

/* filter_default: the filter of that name ("box", "triangle", "gaussian", "mitchell", "sinc") at pbrt's default
 * radius and shape, not yet prepared. Returns false for an unknown name. */
bool filter_default(const char *name, struct filter *out);

/* filter_prepare: fill the derived fields. Call once, after the parameters are final. */
void filter_prepare(struct filter *f);

/* filter_eval: h(dx,dy), normalised to integrate to 1 over the plane; dx, dy in pixels from the pixel's centre. */
double filter_eval(const struct filter *f, double dx, double dy);

/* filter_sample: draw an offset in pixels from the density |h| / integral |h|, or the steps of a table of it, by u1, u2
 * in [0,1). Returns the weight h / density, which makes up for the steps: of filters without negative lobes about 1. */
double filter_sample(const struct filter *f, double u1, double u2, double *dx, double *dy);

#endif
