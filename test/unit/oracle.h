/* oracle.h: the MIS weight computed the slow and plain way, from all p_i of a path; the path's value and length. */
#ifndef ASBDPT_TEST_ORACLE_H
#define ASBDPT_TEST_ORACLE_H

#include "transport/mis.h"
#include "transport/path.h"

/* oracle_weights: weights of all strategies of the path that joins light[0..s-1] to eye[0..t-1].
 *   weight  out, [s + t + 1]: weight[i] belongs to the strategy with i light vertices; 0 where it cannot make the path
 * Returns false for paths the oracle does not cover: delta vertices other than a mirror or smooth glass. */
bool oracle_weights(const struct scene *scene, const struct counts *counts, const struct vertex *light, int s,
                    const struct vertex *eye, int t, double *weight);

/* oracle_value: what the path contributes by the strategy (s,t), unweighted: the measurement contribution divided by
 * the strategy's own density. [V97 10.2] False for paths with delta vertices, which it does not cover. */
bool oracle_value(const struct scene *scene, const struct counts *counts, const struct vertex *light, int s,
                  const struct vertex *eye, int t, rgb *value);

/* oracle_length: of the same path: all its edges measured anew, what comes from infinity from the plane that touches
 * the scene's sphere; meaningless for a path that the oracle does not cover. */
double oracle_length(const struct scene *scene, const struct vertex *light, int s, const struct vertex *eye, int t);

#endif
