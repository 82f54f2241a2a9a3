/* alias.c: see alias.h. Construction after [Vose 1991]: every bin is filled once, so it takes O(n).
 *
 * Scale the weights to mean 1 and sort the indices into `small` (below 1) and `large` (1 or more). Take one of
 * each: the small one gets a bin of its own, which it does not fill; the large one fills it up and keeps the
 * rest, with which it goes back to the list it now belongs to. When one list runs dry, all that is left on
 * the other would weigh exactly 1 if sums were exact; it does up to rounding, so its threshold *is* 1.
 * Dropping either list instead is the classical slip: such a bin would hand its mass to an arbitrary element. */
#include "base/alias.h"

#include <stdlib.h>

#include "base/mem.h"
#include "base/number.h"

/* The largest weight, or -1 if there is none above 0 or one of them is no weight at all. */
static double largest_weight(const double *weight, int n)
{
    double largest = -1;
    for (int i = 0; i < n; i++) {
        if (!(weight[i] >= 0) || isinf(weight[i]))
            return -1;
        if (weight[i] > largest && weight[i] > 0)
            largest = weight[i];
    }
    return largest;
}

/* The sum of weight / unit, compensated [Neumaier 1974]: a million equal weights keep all their digits. */
static double sum_in_units(const double *weight, int n, double unit)
{
    double sum = 0, lost = 0;
    for (int i = 0; i < n; i++) {
        double x = weight[i] / unit, next = sum + x;
        lost += sum >= x ? (sum - next) + x : (x - next) + sum;
        sum = next;
    }
    return sum + lost;
}

static void make_room(struct alias_table *t, size_t n)
{
    if (n <= t->capacity)
        return;
    alias_free(t);
    t->bin = mem_alloc(n, sizeof *t->bin);
    t->work = mem_alloc(n, sizeof *t->work);
    t->capacity = n;
}

/* Fill the bins; on entry every threshold is its weight in units of the mean weight. */
static void pair_up(struct alias_table *t)
{
    uint32_t *small = t->work, *large = t->work + t->n; /* two stacks growing towards each other */
    size_t n_small = 0, n_large = 0;
    for (int i = 0; i < t->n; i++) {
        if (t->bin[i].threshold < 1)
            small[n_small++] = (uint32_t)i;
        else
            *(large - ++n_large) = (uint32_t)i;
    }
    while (n_small > 0 && n_large > 0) {
        struct alias_bin *poor = &t->bin[small[--n_small]];
        uint32_t rich_index = *(large - n_large);
        struct alias_bin *rich = &t->bin[rich_index];
        poor->alias = rich_index;
        poor->alias_pmf = rich->pmf;
        rich->threshold = (rich->threshold + poor->threshold) - 1;
        if (rich->threshold < 1) {
            n_large--;
            small[n_small++] = rich_index;
        }
    }
    while (n_small > 0)
        t->bin[small[--n_small]].threshold = 1;
    for (; n_large > 0; n_large--)
        t->bin[*(large - n_large)].threshold = 1;
}

bool alias_build(struct alias_table *t, const double *weight, int n)
{
    t->n = 0;
    t->total = 0;
    double unit = largest_weight(weight, n);
    if (unit < 0)
        return false;
    make_room(t, (size_t)n);
    double sum = sum_in_units(weight, n, unit); /* in [1,n]: no overflow, no digits lost */
    t->n = n;
    t->total = sum * unit;
    for (int i = 0; i < n; i++) {
        t->bin[i].pmf = weight[i] / unit / sum;
        t->bin[i].threshold = weight[i] / unit * n / sum;
        t->bin[i].alias_pmf = t->bin[i].pmf;
        t->bin[i].alias = (uint32_t)i;
    }
    pair_up(t);
    return true;
}

void alias_free(struct alias_table *t)
{
    free(t->bin);
    free(t->work);
    *t = (struct alias_table){.n = 0};
}

int alias_sample_bin(const struct alias_table *t, int bin, double u, double *pmf, double *u_out)
{
    const struct alias_bin *b = &t->bin[bin];
    bool is_alias = u >= b->threshold;
    if (pmf != NULL)
        *pmf = is_alias ? b->alias_pmf : b->pmf;
    /* Within the part of [0,1) that chose the element u is uniform: stretch that part to [0,1). */
    if (u_out != NULL)
        *u_out = below_one(is_alias ? (u - b->threshold) / (1 - b->threshold) : u / b->threshold);
    return is_alias ? (int)b->alias : bin;
}

int alias_sample(const struct alias_table *t, double u, double *pmf, double *u_out)
{
    double x = u * t->n;
    int bin = (int)x; /* u is in [0,1) */
    if (bin >= t->n) /* u close to 1 and n no power of two: the product may round up */
        bin = t->n - 1;
    return alias_sample_bin(t, bin, below_one(x - bin), pmf, u_out);
}

double alias_pmf(const struct alias_table *t, int i) { return t->n > 0 ? t->bin[i].pmf : 0; }
