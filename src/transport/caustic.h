/* caustic.h: caustic connections: a point that scatters joined to a light through mirrors and glass.
 *                                                              [Speierer 2018] [Hanika 2015]
 * Strategies that draw a point of a light do not pass delta vertices, so what a lamp behind a pane or a mirror casts is
 * left to chance hits of the lamp (s = 0) and to light sub-paths (t = 1); a point light's caustic seen in a mirror is
 * made by nobody. Here chains of k <= K delta vertices are sought between an eye vertex z and a point y drawn on a
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
 * The weights are the balance (or power) heuristic's. As densities of y they are p_y; of s = 0 p_z(w) |cos_y| / J times
 * the probability of choosing the lobes; of t = 1 p_emit(w_y) |cos_z| / J times the same: J, but for indices of
 * refraction, is the same both ways. At a focus, where J is 0, t = 1 has all the weight.
 *
 * Tests: test_caustic.c.
 */
#ifndef ASBDPT_CAUSTIC_H
#define ASBDPT_CAUSTIC_H

#include "transport/connect.h"
#include "transport/specular.h"

enum { CAUSTIC_LONGEST = SPECULAR_LONGEST, CAUSTIC_STARTS = 3, CAUSTIC_MOST = CAUSTIC_STARTS + 1 };

/* What of a scene such chains may go through, found once. */
struct caustics {
    int longest;        /* K, 1 <= K <= CAUSTIC_LONGEST */
    vec3 *middle;       /* [groups of the geometry] of their bounds; owned */
    bool *curved;       /* [groups] normals change along it; owned */
    bool *lets_through; /* [groups] it has a refracting lobe; owned */
    bool any_through;
    struct mirror {
        int group;
        double pmf; /* with which its chain is looked for; their sum may be less than 1 */
    } *mirror; /* [n_mirrors], owned */
    int n_mirrors;
};

/* caustics_new: NULL if nothing in the scene is specular. caustics_free may be given NULL. */
struct caustics *caustics_new(const struct scene *scene, int longest);
void caustics_free(struct caustics *c);

/* caustic_connect: z is eye vertex t, a first hit that can be connected to; the light point is drawn from `sampler`.
 *   room   the longest chain the path has room for
 *   arena  for what is met on the way
 * Returns how many there are in `out`. */
int caustic_connect(const struct scene *scene, const struct mis_counts *counts, struct arena *arena,
                    const struct vertex *z, int t, struct sampler *sampler, int room,
                    struct connection out[CAUSTIC_MOST]);

/* caustic_weigh_hit: the weight of s = 0 for a path of t eye vertices, or its last one's lamp, if a caustic connection
 * makes it, too; else false. */
bool caustic_weigh_hit(const struct scene *scene, const struct mis_counts *counts, struct arena *arena,
                       const struct vertex *eye, int t, double *weight);

/* caustic_weigh_lens: that of t = 1 for a path of s light vertices joined to a point of the lens. */
bool caustic_weigh_lens(const struct scene *scene, const struct mis_counts *counts, struct arena *arena,
                        const struct vertex *light, int s, vec3 lens, double *weight);

#endif
