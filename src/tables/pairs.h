/* pairs.h: the worth of a light vertex in one region to an eye vertex in another.
 *
 * The contribution of a connection depends on both of its ends: on walls between them, their distance and their
 * normals. Learning makes trial connections and measures the mean of
 *     x = luminance(connection) / (luminance(beta_z) luminance(beta_y))
 * for pairs of regions e (of the eye vertex z) and l (of the light vertex y). There are more pairs than trials. So the
 * mean of a pair is regularised towards that of the pair of regions that contain them, each twice as wide, and so on up
 * to the whole scene:
 *     m(e,l) = (sum w x + kappa w_mean m(e', l')) / (sum w + kappa w_mean).
 * The weight w of a trial is proportional to how often the render would make this connection. The worth
 *     h(e,l) = (1 - delta) m(e,l) / sum_l N(l) m(e,l) + delta / sum_l N(l)
 * is normalised: N(l) is the mean number of vertices that a light sub-path has in l, so the sum of h over the vertices
 * of a light sub-path is 1 on average.
 *
 * The table does not change during the render, and h is a function of the two surface points alone. So h may guide the
 * choice of light vertices and be a factor of the counts in the MIS weights (mis.h).
 *
 * Tests: test_pairs.c, test_mis.c.
 */
#ifndef ASBDPT_TABLES_PAIRS_H
#define ASBDPT_TABLES_PAIRS_H

#include "tables/regions.h"

/* Sums over trials, for pairs of regions of the same level. */
struct pair_sums {
    double *worth, *weight; /* [eye->n * light->n] of w x and of w; owned */
    double trials;          /* their number */
};

/* pair_sums_init: start with zeros; no region may be added afterwards. pairs_build releases the sums. */
void pair_sums_init(struct pair_sums *s, const struct regions *eye, const struct regions *light);

/* pair_sums_add: a trial between regions e and y of worth x >= 0 and weight w > 0. */
void pair_sums_add(struct pair_sums *s, const struct regions *eye, const struct regions *light, int e, int y, double x,
                   double w);

/* The frozen table. */
struct pairs {
    int n_eye, n_light;
    double *h; /* [n_eye * n_light], > 0; NULL: the table is empty; owned */
};

/* pairs_build: the table; free(p.h) releases it.
 *   vertices  [light->n] N(l); each vertex counts in the finest region that contains it
 *   delta     (0,1] */
struct pairs pairs_build(struct pair_sums *s, const struct regions *eye, const struct regions *light,
                         const double *vertices, double delta);

/* pairs_from_row: a table that does not depend on the eye vertex: h(e,l) = row[l].
 *   row  [n_light], owned by the table from now on */
struct pairs pairs_from_row(double *row, int n_light);

/* pairs_row: h(e,.), [n_light]. pairs_worth: h(e,l). */
static inline const double *pairs_row(const struct pairs *p, int e)
{
    return &p->h[(size_t)(p->n_eye == 1 ? 0 : e) * (size_t)p->n_light];
}
static inline double pairs_worth(const struct pairs *p, int e, int l) { return p->h != NULL ? pairs_row(p, e)[l] : 1; }

#endif
