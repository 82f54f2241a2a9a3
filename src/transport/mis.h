/* mis.h: multiple importance sampling weights of bidirectional path tracing in O(1) per connection.
 *
 * The definition. Strategies (s,t) with s + t = k + 1 can make the path x_0 ... x_k, where x_0 is on a light and x_k on
 * the lens. Its first s vertices come from a light sub-path, the rest from an eye sub-path. Let p_s be the density of
 * strategy s times the number of samples that it takes. The balance heuristic gives the path the weight
 *     (1)  w_s = p_s / sum_i p_i.                                                                      [V97 9.2.2]
 * test/unit/oracle.c is this definition, slow and plain: it multiplies out each p_i, one strategy after the other.
 * This file is its fast form.
 *
 * Ratios. p_i and p_{i+1} differ in one vertex: x_i is sampled from the eye in p_i and from the light in p_{i+1}. So
 *     (2)  p_i / p_s = (n_i / n_s) prod_{j=i}^{s-1} R_j / F_j        for i < s.                   [V97 eq. 10.9]
 * F_j is the density of x_j in its own (light) walk, and R_j the density that the other (eye) walk would have. Both are
 * per area. n_i is the number of samples of strategy i. It is 0 if the strategy cannot make the path, because it would
 * have to connect at a delta vertex [V97 10.3.5]. The eye side, i > s, is the same with the roles exchanged. The sum
 * over one side obeys
 *     (3)  A_e = R_e/F_e (c_e + A_{e-1}),   A_{-1} = 0,
 * where c_e is the n of the strategy that connects vertices e-1 and e: on this side its sub-path ends at e-1. It is 0
 * if one of the two was left by a delta lobe. c_0 is the n of s = 0; on the eye side 0, for nothing finds the lens.
 *
 * Accumulation. When a walk arrives at vertex e, it knows F_e, but R_e and R_{e-1} depend on what e is connected to. It
 * knows all older terms, so it stores at the vertex
 *     (4)  mis_e = g (c_{e-1} + A_{e-2}) / F_{e-1},   g: turns a density per steradian at e into one per area at e-1.
 * Let pdf_rev be the density per steradian of continuing from e to e-1. Then a connection to vertex e needs only
 *     (5)  A_e = R_e/F_e (c_e + pdf_rev mis_e).
 * Since A_{e-1} = pdf_rev mis_e, the walk's own recursion is
 *     (6)  mis_{e+1} = g (c_e + pdf_rev mis_e) / F_e.
 * A_e is relative to one sample of strategy s. At the ends of the connection, or where the walk ended, this gives
 *     (7)  w_s = n_s / (n_s + A_light + A_eye).
 *
 * A delta lobe has the coefficient of a delta distribution instead of a density. R and F have the same distribution, so
 * it cancels in R/F (bsdf.h).
 *
 * The sample counts n describe a method (counts.h). The counts may differ between paths, as long as every strategy
 * computes the same number for the same path.
 *
 * VCM [Georgiev 2012] and SmallVCM have three partial sums. Two of them are ours divided by F_e (in struct vertex:
 * mis_c / pdf_fwd and mis / pdf_fwd):
 *     dVCM = c_e / F_e,   dVC = mis_e / F_e,   hence A_e = R_e (dVCM + pdf_rev dVC).
 * For s, t >= 2 and n = 1 dVCM is 1/F_e, and after a delta lobe 0. At e = 1 its numerator is the number of light
 * sub-paths (c_1 of the eye side) or the ratio of the two densities of y_0 (c_1 of the light side).
 *
 * Tests: test_mis.c compares the weights with all p_i, computed one by one.
 */
#ifndef ASBDPT_MIS_H
#define ASBDPT_MIS_H

/* mis_step: (6), from vertex e to e+1.
 *   c        c_e, or 0 if the walk left e by a delta lobe
 *   pdf_rev  1/sr, of continuing from e to e-1
 *   mis, F   of vertex e
 *   g        1/m^2: turns a density per steradian at e+1 into one per area at e */
static inline double mis_step(double c, double pdf_rev, double mis, double F, double g)
{
    return g * (c + pdf_rev * mis) / F;
}

/* mis_side: (5): A_e, the sum over the strategies of one side, relative to one sample of strategy s.
 *   R        density of vertex e in the other walk, same measure as F */
static inline double mis_side(double R, double F, double c, double pdf_rev, double mis)
{
    return R / F * (c + pdf_rev * mis);
}

/* mis_weight: (7): w_s from the sums of the two sides and the strategy's own count n. */
static inline double mis_weight(double n, double light_side, double eye_side)
{
    return n / (n + light_side + eye_side);
}

#endif
