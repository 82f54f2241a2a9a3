/* noise_estimate.h: how noisy is an image? The estimate is from the difference of two halves of its samples.
 *
 * The film sums every other run of iterations on its own. Of the halves A and B the picture is the mean, and (A - B)/2
 * would have its variance were they independent. As points of the same nets they are not: the mean errs less. Nothing
 * that is in the image is left out: it has splats, and what strategies and neighbouring pixels have in common. A single
 * pixel is a poor estimate.
 * The picture is cut into blocks; the noise is the root of the mean, over all values of the picture, of
 *     NOISE_RELATIVE  ((A - B)/2)^2 / (m^2 + 0.01), m being the mean of the block: relative to the brightness around
 *     NOISE_8_BIT     the same difference squared in levels of 8-bit pictures: what `compare` measures as rmse8.
 *
 * It is no bias, of which both halves have the same. doc/usage.md says where it is too high, and where too low.
 *
 * The noise's own standard error comes from the sums over blocks, which are as large as the largest tile, where the
 * picture is large enough, since pixels of a tile may share light sub-paths: from half the squared difference of each
 * block from the one before. Where blocks differ by more than chance it is too large.
 *
 * Tests: test_noise.c.
 */
#ifndef ASBDPT_NOISE_ESTIMATE_H
#define ASBDPT_NOISE_ESTIMATE_H

#include "scene/film.h"

/* noise_run: iterations of a run where tile passes have blocks of so many. */
int noise_run(int block);

/* noise_every: the samples from one measurement to the next; 0 before the film was rendered into. */
long noise_every(const struct film *film);

/* noise_measure: set film->noise, for the picture at this scale, if the film keeps halves and they are of one size and
 * not empty. Returns whether it has. */
bool noise_measure(struct film *film, double scale);

#endif
