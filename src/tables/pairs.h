/* pairs.h: what is a light vertex of one region worth to an eye vertex of another?
 *
 * A wall between two regions, the angle at which they face each other, their distance: whether a connection between
 * them brings anything depends on both. Trial connections measure the mean of
 *     x = luminance(connection) / (luminance(beta_z) luminance(beta_y))
 * for pairs of regions e (of the eye vertex z) and l (of the light vertex y). There are more pairs than trials, so the
 * mean of a pair leans on that of the pair of regions that hold them, twice as wide each, and so on up to the whole
 * scene:
 *     m(e,l) = (sum w x + kappa w_mean m(e', l')) / (sum w + kappa w_mean),
 * w being the weights of the trials, which say how often the render would have made them. The worth, normalised so that
 * its sum over the vertices of a light sub-path is 1 on average, is
 *     h(e,l) = (1 - delta) m(e,l) / sum_l N(l) m(e,l) + delta / sum_l N(l),
 * N(l) being the vertices that a light sub-path has in l on average.
 *
 * The table is frozen before the render: h may guide the choice of light vertices and enter the counts of the MIS
 * weights (mis.h), since it depends on nothing but the two surface points.
 *
 * Tests: test_pairs.c, test_mis.c.
 */
#ifndef ASBDPT_TABLES_PAIRS_H
#define ASBDPT_TABLES_PAIRS_H

#include "tables/regions.h"

/* Sums over trials, for pairs of regions of the same level. */
struct pair_sums {
    double *worth, *weight; /* [eye->n * light->n] of w x and of w; owned */
    double trials;          /* how many */
};

/* pair_sums_init: for these regions; none may be added afterwards. pairs_build releases the sums. */
void pair_sums_init(struct pair_sums *s, const struct regions *eye, const struct regions *light);

/* pair_sums_add: a trial between regions e and y of worth x >= 0 and weight w > 0. */
void pair_sums_add(struct pair_sums *s, const struct regions *eye, const struct regions *light, int e, int y, double x,
                   double w);

/* The frozen table. */
struct pairs {
    int n_eye, n_light;
    double *h; /* [n_eye * n_light], > 0; NULL: nothing is known; owned */
};

/* pairs_build: the table; free(p.h) releases it.
 *   vertices  [light->n] N(l), those of a region counted in the finest region they lie in
 *   delta     (0,1] */
struct pairs pairs_build(struct pair_sums *s, const struct regions *eye, const struct regions *light,
                         const double *vertices, double delta);

/* pairs_from_row: a table that does not look at the eye vertex: h(e,l) = row[l].
 *   row  [n_light], handed over */
struct pairs pairs_from_row(double *row, int n_light);

/* pairs_row: h(e,.), [n_light]. pairs_worth: h(e,l). */
static inline const double *pairs_row(const struct pairs *p, int e)
{
    return &p->h[(size_t)(p->n_eye == 1 ? 0 : e) * (size_t)p->n_light];
}
static inline double pairs_worth(const struct pairs *p, int e, int l) { return p->h != NULL ? pairs_row(p, e)[l] : 1; }

#endif
