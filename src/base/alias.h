/* alias.h: draw an index with a given probability in constant time.                      [Walker 1977] [Vose 1991]
 *
 * The mass of n weights is cut into n bins of equal mass 1/n. Each bin holds at most two elements: its own index, with
 * probability `threshold`, and one other index, `alias`, with the rest. A uniform number picks the bin, another (what
 * is left of the first) picks the element. The dissertation's bins of two light sub-paths are named after this table.
 * Tests: test_alias.c (exact mass to 1e-12, chi-square, degenerate weights). */
#ifndef ASBDPT_ALIAS_H
#define ASBDPT_ALIAS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct alias_bin {
    double threshold; /* probability, within the bin, of the bin's own index; [0,1] */
    double pmf;       /* probability of the bin's own index over the whole table; [0,1] */
    double alias_pmf; /* of the other element; here, so that a draw reads one bin only */
    uint32_t alias;   /* the other element */
};

struct alias_table {
    struct alias_bin *bin; /* [n], owned */
    uint32_t *work;        /* [n], scratch of alias_build, owned */
    size_t capacity;       /* bins there is room for */
    int n;                 /* elements; 0 for a table never built or of zero mass */
    double total;          /* sum of the weights */
};

/* alias_build: make the table of n >= 0 weights, each finite and >= 0. O(n), reuses the table's memory.
 *   t  zero-initialised or built before; afterwards owns its memory until alias_free
 * A weight below 1e-308 of the largest counts as zero; `total` may overflow to infinity, probabilities do not.
 * Returns false, leaving an empty table (n = 0), when the weights sum to zero, or one is negative or not finite. */
bool alias_build(struct alias_table *t, const double *weight, int n);
void alias_free(struct alias_table *t);

/* alias_sample: draw one index with probability proportional to its weight.
 *   u      uniform number in [0,1); if it is a multiple of 2^-32, probabilities are met up to 2^-32
 *   pmf    out, may be NULL: probability of the returned index, (0,1]
 *   u_out  out, may be NULL: what is left of u, again uniform in [0,1) and independent of the index; it has
 *          log2(n) bits fewer than u
 * Returns the index, 0 <= i < t->n, never one of weight 0. t->n >= 1. Cannot fail. O(1).
 * alias_sample_bin: its second half alone: choose one of the two elements of the given bin. Visiting every bin once
 * draws n elements, stratified. */
int alias_sample(const struct alias_table *t, double u, double *pmf, double *u_out);
int alias_sample_bin(const struct alias_table *t, int bin, double u, double *pmf, double *u_out);

/* alias_pmf: probability of index i; 0 for an empty table. */
double alias_pmf(const struct alias_table *t, int i);

/* Drawing by cumulative sums: slower than an alias table, but what lies side by side stays so, and so do the strata of
 * a low-discrepancy sequence. */

/* cumulative_find: the last i in [0, n) with before[i] <= target; 0 if there is none.
 *   before  [n] rising: before[i] is the sum of all before i. n >= 1 */
static inline int cumulative_find(const double *before, int n, double target)
{
    int low = 0, high = n;
    while (high - low > 1) {
        int middle = low + (high - low) / 2;
        if (before[middle] <= target)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static inline double sum_of(const double *x, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += x[i];
    return sum;
}

#endif
