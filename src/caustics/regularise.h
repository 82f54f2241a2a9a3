/* regularise.h: paths that no strategy makes, made by widening their last delta lobe: biased.       [Kaplanyan 2013]
 *
 * A light without extent is never hit (s = 0), and a delta vertex z cannot be joined to it (s = 1). If light sub-paths
 * cannot make the path either, since before z no two of its vertices in sequence scatter by other lobes (the lens
 * counts as one that does), z is joined to the light all the same: its lobes' deltas are spread evenly over cones,
 *     f |cos| = kappa K(angle between w and the lobe's direction),   K = 1 / (2 pi (1 - cos eps)) within eps, else 0.
 * Such a path has no rival, so its weight is 1; all others are as they were. Light seen directly in mirrors, with no
 * vertex before z that scatters by other lobes, stays invisible.
 *
 * Bias falls as eps^2, variance grows as 1/(n eps^2): iteration n = 1, 2 ... has eps = eps_1 n^(-1/6), so that the
 * picture converges, more slowly than others do, to one without bias.
 *
 * Tests: test_caustic.c.
 */
#ifndef ASBDPT_REGULARISE_H
#define ASBDPT_REGULARISE_H

#include "transport/pixel_sample.h"

/* regularise_new: cones that begin with the angle eps_1. */
struct extra *regularise_new(double eps_1);

#endif
