/* caustic.h: caustic connections: a point that scatters joined to a light through mirrors and glass.
 *                                                              [Speierer 2018] [Hanika 2015]
 * Strategies that draw a point of a light do not pass delta vertices, so what a light behind a pane or a mirror casts
 * is left to chance hits of the light (s = 0) and to light sub-paths (t = 1); a point light's caustic seen in a mirror
 * is made by nobody. Here chains of k <= K delta vertices are sought between an eye vertex z and a point y drawn on a
 * light (specular.h). Where the search starts decides which of several it finds, and is a function of z, y and of what
 * the chain is:
 *
 *     through   refraction everywhere: towards y, k being the number of surfaces in between, and, if the first of them
 *               is curved, towards two points half way out on it
 *     mirror    reflection by one shape: towards its middle; k = 1
 *
 * Hence Psi(z, y), the chains found, are a function, too, and they divide the paths E S* D S^k L:
 *
 *     Paths whose chain is in Psi are made by this strategy, s = 0 and t = 1, with weights of their own;
 *     all others as without.
 *
 * Where s = 0 and t = 1 arrive with a chain they ask for Psi again, so that nothing is counted twice or lost, however
 * little Psi finds. Only the first D is joined: later ones are seen by strategies s >= 2.
 *
 * The estimate. kappa being the coefficients of the delta lobes, J the area of light per solid angle at z, p_y the
 * density of y times the probability of looking for a chain of that kind,
 *     C* = beta_z f_z |cos| kappa_1 ... kappa_k Le |cos_y| / (J p_y)
 * The weights are the balance heuristic's. As densities of y they are p_y; of s = 0 p_z(w) |cos_y| / J times
 * the probability of choosing the lobes; of t = 1 p_emit(w_y) |cos_z| / J times the same: J is the same both ways,
 * except for indices of refraction. At a focus, where J is 0, these two have all the weight.
 *
 * Is it worth its cost? A search costs tens of rays. The second moment of a sample would be larger by the sum of X^2 /
 * (1 - w) over the chains of weight w that contribute X, if they were not made; a few hundred samples before the render
 * say how much that is, compared with brightness. Where it is little, s = 0 and t = 1 are left to make those paths:
 * those whose z the lens sees, those whose z it sees by delta lobes, or both; but none that they cannot make.
 *
 * Tests: test_caustic.c.
 */
#ifndef ASBDPT_CAUSTIC_H
#define ASBDPT_CAUSTIC_H

#include "caustics/one_more.h"
#include "caustics/specular.h"

/* caustics_new: chains of at most `longest` vertices; NULL if nothing in the scene is specular. */
struct one_more *caustics_new(const struct scene *scene, int longest);
void caustics_free(struct one_more *self); /* NULL: nothing */

/* caustics_pay: leave to s = 0 and t = 1 what they make well enough by the counts of the method; nothing that they
 * cannot make. False if that leaves nothing. */
bool caustics_pay(struct one_more *self, const struct render_job *job, const struct prepared *method);

#endif
