/* cumulative.h: drawing by cumulative sums: slower than an alias table (alias.h), but what lies side by side stays so,
 * and so do the strata of a low-discrepancy sequence.
 * Tests: test_alias.c. */
#ifndef ASBDPT_CUMULATIVE_H
#define ASBDPT_CUMULATIVE_H

/* cumulative_find: the last i in [0, n) with before[i] <= target; 0 if there is none.
 *   before  [n] rising: before[i] is the sum of what stands before i. n >= 1 */
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
