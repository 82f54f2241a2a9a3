/* sampler.h: the random numbers one sub-path consumes, each drawn for a decision with a name.
 *
 * A decision that needs a point of the unit square, a direction say, draws one; a choice, say of a light, draws a
 * single number. What a stream gives for a decision the k-th time depends on nothing that other decisions have drawn:
 * roulette or a lens cannot shift a direction's numbers.
 *
 * Over the iterations of a pixel the first SAMPLER_TIMES points of each decision, and single numbers where that is
 * worth its cost, are of low discrepancy: Sobol' points, Owen-scrambled by hashing, visited in an order of each one's
 * own [Burley 2020]. Any 2^k iterations from a multiple of 2^k on have exactly one of 2^k points in every elementary
 * interval of area 2^-k: they are a (0,k,2)-net. All else comes from the pixel's generator. Each number alone is
 * exactly uniform, and over pixels and seeds all are independent, so nothing is biased. Within one pixel a weak
 * correlation between two decisions may remain, since the order is a hash.
 *
 * Any other number of samples is made of several nets, 48 of those of 32 and 16, and is about as good as independent
 * ones: 20 samples of a smooth integrand (x y) have twice the squared error of 16, 40 of 32. Choose powers of two.
 * Tests: test_sampler.c (also of the points as sub-paths and connections have used them), test_streams.c. */
#ifndef ASBDPT_SAMPLER_H
#define ASBDPT_SAMPLER_H

#include <math.h>
#include <stddef.h>

#include "base/rng.h"

enum {
    SAMPLER_TIMES = 4, /* how often each decision is given numbers of low discrepancy */
    SAMPLER_LOG2_POINTS = 16,
    SAMPLER_POINTS = 1 << SAMPLER_LOG2_POINTS /* iterations that share one scrambled sequence */
};

/* What numbers decide. */
enum decision {
    /* points of the unit square */
    DRAW_FILM_POINT,
    DRAW_LENS_POINT,
    DRAW_LIGHT_POINT,
    DRAW_EMISSION,   /* how a light is left */
    DRAW_SCATTERING, /* how a surface is left */
    /* single numbers */
    DRAW_LIGHT,
    DRAW_LIGHT_END, /* which light sub-path, or vertex of one, to connect to */
    DRAW_HOW_MANY,  /* of these */
    /* single numbers that are plain random ones */
    DRAW_LOBE,
    DRAW_ROULETTE,
    DRAW_ORDER, /* of a permutation */
    DRAW_FLIGHT /* how far light goes in a medium */
};

/* Where else numbers may come from: `next` writes n of them, each in [0,1), that are to decide d. What embeds a source
 * as its first member has a state of its own. */
struct number_source {
    void (*next)(struct number_source *self, enum decision d, double *u, int n);
};

struct sampler {
    struct number_source *source; /* of all its numbers; NULL: they are made from what follows */
    struct rng rng;
    uint64_t scramble;        /* hash of (seed, purpose, pixel, iteration / SAMPLER_POINTS) */
    uint32_t index;           /* iteration % SAMPLER_POINTS, bits reversed: where in the sequence */
    uint8_t drawn[DRAW_LOBE]; /* how often for each decision, counted up to SAMPLER_TIMES */
};

/* sampler_start: the numbers of (seed, purpose, pixel, iteration); see rng_stream. All 64 bits of each of them count:
 * names that differ give streams that differ. What lies above the sequence's index enters its scramble, so iterations
 * i and i + SAMPLER_POINTS have nothing in common. (A longer sequence would repeat there the first digits of all its
 * first coordinates, and with them whatever depends on no others.) */
struct sampler sampler_start(uint64_t seed, enum rng_purpose purpose, uint64_t pixel, uint64_t iteration);

/* The next point u of the unit square [0,1)^2, or number in [0,1), for a decision. */
void sampler_pair(struct sampler *s, enum decision d, double u[2]);
double sampler_number(struct sampler *s, enum decision d);

/* sampler_r2: point i >= 0 of the sequence R2, which fills the unit square [0,1)^2 evenly [Roberts 2018]. */
static inline void sampler_r2(int64_t i, double *u, double *v)
{
    double x = 0.5 + 0.7548776662466927 * (double)i, y = 0.5 + 0.5698402909980532 * (double)i;
    *u = x - floor(x);
    *v = y - floor(y);
}

/* lattice_step: the number prime to n >= 1 that is next to n times the golden section from below; 0 for n = 1. Its
 * first multiples modulo n lie evenly among 0 .. n-1. */
int64_t lattice_step(int64_t n);

#endif
