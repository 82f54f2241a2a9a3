/* mis.h: multiple importance sampling weights of bidirectional path tracing in O(1) per connection.
 *
 * The definition. A path x_0 ... x_k (x_0 on a light, x_k on the lens) can be made by strategies (s,t), s + t = k + 1:
 * its first s vertices come from a light sub-path, the rest from an eye sub-path. With p_s the density of strategy s
 * times the number of samples it takes, the balance heuristic weighs it with
 *     (1)  w_s = p_s / sum_i p_i.                                                                      [V97 9.2.2]
 * test/oracle.c is that definition, slow and plain: each p_i multiplied out, one strategy after the other. Read it
 * first. This file is its fast form.
 *
 * Ratios. p_i and p_{i+1} differ in one vertex: x_i is sampled from the eye in p_i and from the light in p_{i+1}. So
 *     (2)  p_i / p_s = (n_i / n_s) prod_{j=i}^{s-1} R_j / F_j        for i < s,                   [V97 eq. 10.9]
 * where F_j is the density of x_j in its own (light) walk, R_j the density the other (eye) walk would have, both per
 * area, and n_i the number of samples of strategy i (0 if it cannot make the path, because it would have to connect
 * at a delta vertex [V97 10.3.5]). The eye side, i > s, is the same with the roles exchanged. Over one side the
 * sum obeys
 *     (3)  A_e = R_e/F_e (c_e + A_{e-1}),   A_{-1} = 0,
 * c_e being the n of the strategy whose sub-path of this side ends just *before* vertex e.
 *
 * Accumulation. When a walk arrives at vertex e, F_e is known but R_e and R_{e-1} depend on what e is connected to. All
 * older terms are known, so a vertex stores
 *     (4)  mis_e = g (c_{e-1} + A_{e-2}) / F_{e-1},   g: turns a density per steradian at e into one per area at e-1,
 * and a connection to vertex e, with pdf_rev the density per steradian of continuing from e to e-1, needs only
 *     (5)  A_e = R_e/F_e (c_e + pdf_rev mis_e).
 * With A_{e-1} = pdf_rev mis_e the walk's own recursion is
 *     (6)  mis_{e+1} = g (c_e + pdf_rev mis_e) / F_e,   c_e = 0 if the walk scattered at e by a delta lobe.
 * A_e is relative to one sample of strategy s, hence, at the ends of the connection or where the walk ended,
 *     (7)  w_s = n_s / (n_s + A_light + A_eye).
 *
 * Delta lobes have, instead of densities, coefficients of the same delta; they cancel in R/F as densities do (bsdf.h).
 *
 * Every method is described by its sample counts n; see struct mis_counts. The counts may vary from path to path as
 * long as every strategy computes the same number for the same path.
 *
 * Readers of VCM [Georgiev 2012] and SmallVCM know two of its three partial sums, which are ours divided by F_e (in
 * struct vertex: mis_c / pdf_fwd and mis / pdf_fwd):
 *     dVCM = c_e / F_e,   dVC = mis_e / F_e,   hence A_e = R_e (dVCM + pdf_rev dVC).
 * For s, t >= 2 and n = 1 dVCM is 1/F_e; at e = 1 its numerator is the number of light sub-paths (c_1 of the eye side)
 * or the ratio of the two densities of y_0 (c_1 of the light side); after a delta lobe it is 0.
 *
 * The power heuristic with exponent 2 squares every factor.                                           [V97 9.2.3]
 *
 * Tests: test_mis.c compares with all p_i computed one by one.
 */
#ifndef ASBDPT_MIS_H
#define ASBDPT_MIS_H

#include <stdbool.h>

struct tables;

/* Which eye vertex a strategy with t >= 2 ends at: what the camera sees, itself or by way of delta lobes alone, or a
 * later one. */
enum eye_end { FIRST_HIT, LATER_HIT, EYE_ENDS };

/* How many samples each kind of strategy takes per pixel and iteration; 0: the method does not use it. A method may
 * count a strategy for more than it takes: the weights still add up to 1. The balance heuristic goes by second moments,
 * so a strategy whose samples are better spread than independent ones, and whose variance is therefore smaller,
 * deserves such a credit [Grittmann 2019].
 *
 * A light walk cannot know which eye vertex it is at, and takes all for later ones. It errs at its last alone, when the
 * lens is next (connect_lens): between any other first hit and the lens it meets delta lobes, which end no strategy. */
struct mis_counts {
    double hit[EYE_ENDS];      /* s = 0, t >= 3, by z_{t-2}: the eye walk finds a light. (t = 2: weight 1) */
    double direct[EYE_ENDS];   /* s = 1: connection to fresh points on a light that s = 0 can find */
    double direct_delta[EYE_ENDS]; /* s = 1: connection to a delta light, of one point or one direction */
    double connect[EYE_ENDS];  /* s >= 2, t >= 2: connection to light vertices */
    double most;               /* of connect, whatever the tables say: sub-paths that share a pool; 0: no bound */
    double splat;              /* s >= 2, t = 1: light sub-paths joined to the lens, of the whole film's pixels */
    const struct tables *tables;     /* what is known about places: factors of connect and direct, and of the density
                                      * of the light walk's first ray (counts.h); NULL: nothing */
    bool power;                /* power heuristic instead of the balance heuristic */
};

/* mis_raise: the heuristic's power of a density or count. */
static inline double mis_raise(const struct mis_counts *m, double x) { return m->power ? x * x : x; }

/* mis_step: (6), from vertex e to e+1.
 *   c        c_e, or 0 after a delta lobe
 *   pdf_rev  1/sr, continuing from e to e-1
 *   mis, F   of vertex e
 *   g        1/m^2 times cosine: measure conversion at e as seen from e+1 */
static inline double mis_step(const struct mis_counts *m, double c, double pdf_rev, double mis, double F, double g)
{
    return mis_raise(m, g) * (mis_raise(m, c) + mis_raise(m, pdf_rev) * mis) / mis_raise(m, F);
}

/* mis_side: (5): A_e, the sum over the strategies of one side, relative to one sample of strategy s.
 *   R        density of vertex e in the other walk, same measure as F */
static inline double mis_side(const struct mis_counts *m, double R, double F, double c, double pdf_rev, double mis)
{
    return mis_raise(m, R) / mis_raise(m, F) * (mis_raise(m, c) + mis_raise(m, pdf_rev) * mis);
}

/* mis_weight: (7): w_s from the two sides' sums and the strategy's own count n. */
static inline double mis_weight(const struct mis_counts *m, double n, double light_side, double eye_side)
{
    double own = mis_raise(m, n);
    return own / (own + light_side + eye_side);
}

#endif
