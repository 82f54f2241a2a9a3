/* filter.h: pixel reconstruction filters, pbrt-v3's five with its default radii.
 *
 * A pixel's value is the integral of h(p) L(p), h = filter / (integral of filter) centred on the pixel. Eye
 * samples draw p from |h| (filter importance sampling), so a sample counts for its own pixel only; a light-image
 * splat (t = 1) adds h(p) times its value to each pixel it reaches. Both estimate the same integral.
 *
 * Where h has negative lobes, with M = integral of max(-h, 0), one sample in four is drawn from them and has the weight
 * -4 M, and three from the others, with 4/3 (1 + M). Any number of samples is unbiased. Which one it is depends on the
 * quarter of [0,1) that the first number is in, and of four samples of a pixel, beginning with a multiple of four, each
 * is in another quarter (sampler.h): so the weights of these add up to 4, and what is the same all over the filter has
 * no noise of them.
 *
 * Tests: test_film.c.
 */
#ifndef ASBDPT_FILTER_H
#define ASBDPT_FILTER_H

#include <stdbool.h>

enum filter_kind { FILTER_BOX, FILTER_TRIANGLE, FILTER_GAUSSIAN, FILTER_MITCHELL, FILTER_SINC };

enum {
    FILTER_STEPS = 2048, /* at most, of the sampling table, over [-radius, radius] */
    FILTER_CYCLE = 4     /* of so many samples one is drawn from negative lobes */
};

/* Separable: f(x,y) = f1(x) f1(y), each with its own radius. */
struct filter {
    enum filter_kind kind;
    double radius[2]; /* x, y in pixels; > 0 */
    double alpha;     /* gaussian */
    double B, C;      /* mitchell */
    double tau;       /* sinc */
    /* filled by filter_prepare, per axis */
    int steps;                          /* of the table */
    double norm[2];                     /* 1 / integral of f1 */
    double mass[2][2];                  /* integral of |f1| times norm, where f1 is not below 0 and where it is */
    double cdf[2][2][FILTER_STEPS + 1]; /* running integrals of both, normalised; box, triangle: unused */
};

/* The names of the kinds, ended by NULL. */
extern const char *const FILTER_NAMES[];

/* filter_default: the filter of that name at pbrt's default radius and shape, not yet prepared. Returns false for an
 * unknown name. */
bool filter_default(const char *name, struct filter *out);

/* filter_prepare: fill the derived fields. Call once, after the parameters are final. */
void filter_prepare(struct filter *f);

/* filter_eval: h(dx,dy), normalised to integrate to 1 over the plane; dx, dy in pixels from the pixel's centre. */
double filter_eval(const struct filter *f, double dx, double dy);

/* filter_sample: draw an offset in pixels by u1, u2 in [0,1), from the density |h|, each sign of h having its share of
 * the samples, or from the steps of a table of it. Returns the weight h / density, which makes up for the steps: about
 * 1 of filters without negative lobes. */
double filter_sample(const struct filter *f, double u1, double u2, double *dx, double *dy);

/* filter_cycle: of a prepared filter: the weights of so many samples add up to about their number. */
int filter_cycle(const struct filter *f);

#endif
