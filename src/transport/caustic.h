/* caustic.h: caustic connections: a point that scatters joined to a light through mirrors and glass.
 *                                                              [Speierer 2018] [Hanika 2015]
 * No other strategy with a light point of its own passes a delta vertex, so what a lamp behind a pane or a mirror casts
 * is left to chance hits of the lamp (s = 0) and to light sub-paths (t = 1); a point light's caustic seen in a mirror
 * is made by nobody. Here, a chain of k <= K delta vertices between an eye vertex z and a light's point y is sought: of
 * the directions w in which z may be left, one whose ray, traced through the chain, arrives at y.
 *
 * The search. u being the direction from the chain's last vertex p to y, and d the one in which the ray goes on, the
 * sum of squares of d(w) - u(w) is minimised by Gauss and Newton, the step halved where it brings nothing. Its
 * derivatives are those of a ray [Igehy 1999]; each step is a ray traced through the scene, so what is found is visible.
 *
 * The start decides which of several roots is found, and is a function of z, y and of what the chain is:
 *     through   refraction everywhere: towards y; k is the number of surfaces in between
 *     mirror    reflection by one shape: towards its middle; k = 1
 * Hence Psi(z, y), the chains found, are too. They partition the paths E S* D S^k L, whoever makes them:
 *
 *     Paths whose chain is in Psi are made here, with the balance heuristic between this and s = 0;
 *     light sub-paths joined to the lens (t = 1) leave them out. All others are made as without.
 *
 * Both ask for Psi again where they arrive with a chain of their own, so nothing is counted twice or lost, however
 * little Psi finds: roots it misses stay with the others. Only the first D is joined: later ones are seen by
 * strategies s >= 2. Bump maps are not differentiated; such chains are not found.
 *
 * The estimate. J is the area of light per solid angle at z, across the last edge, of light from infinity the solid
 * angle; kappa are the coefficients of the delta lobes, p_y the density of y:
 *     C* = beta_z f_z |cos| kappa_1 ... kappa_k Le |cos_y| / (J p_y)
 *
 * Tests: test_caustic.c.
 */
#ifndef ASBDPT_CAUSTIC_H
#define ASBDPT_CAUSTIC_H

#include "transport/connect.h"

enum { CAUSTIC_LONGEST = 2, CAUSTIC_STARTS = 3, CAUSTIC_MOST = CAUSTIC_STARTS + 1 };

/* What of a scene such chains may go through, found once. */
struct caustics {
    int longest; /* K, 1 <= K <= CAUSTIC_LONGEST */
    vec3 *middle;       /* [groups] of the bounds; owned */
    bool *curved;       /* [groups]; owned */
    bool *lets_through; /* [groups of the geometry] has a refracting lobe; owned */
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

/* One that was made: k delta vertices. */
struct caustic_connection {
    struct connection c;
    int k;
};

/* caustic_connect: z is eye vertex t, a first hit that can be connected to; the light point is drawn from `sampler`.
 *   room   the longest chain the path has room for
 *   arena  for what is met on the way
 * Returns how many there are in `out`. */
int caustic_connect(const struct scene *scene, const struct mis_counts *counts, struct arena *arena,
                    const struct vertex *z, int t, struct sampler *sampler, int room,
                    struct caustic_connection out[CAUSTIC_MOST]);

/* caustic_weigh_hit: the weight of s = 0 for a path of t eye vertices, or its last one's lamp, if a caustic connection
 * makes it, too; else false. */
bool caustic_weigh_hit(const struct scene *scene, const struct mis_counts *counts, struct arena *arena,
                       const struct vertex *eye, int t, double *weight);

/* caustic_weigh_lens: that of t = 1 for a path of s light vertices joined to a point of the lens. */
bool caustic_weigh_lens(const struct scene *scene, const struct mis_counts *counts, struct arena *arena,
                        const struct vertex *light, int s, vec3 lens, double *weight);

#endif
