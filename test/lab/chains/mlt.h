/* mlt.h: what a state of mlt.c is, for mlt.c and its tests. */
#ifndef ASBDPT_MLT_H
#define ASBDPT_MLT_H

#include "chains/follow.h"
#include "chains/primary.h"

enum mlt_perturbation { LENS_PERTURBATION, CAUSTIC_PERTURBATION, MLT_PERTURBATIONS };

/* x_0 .. x_k, x_k being the lens. */
struct mlt_path {
    struct arena arena; /* holds the rest */
    struct path_stop *x; /* [k]; x_0 as vertex_light fills it in; those of an eye walk may be out of date */
    int k, m, l;         /* see mlt.c; l is used where can[CAUSTIC_PERTURBATION] */
    bool can[MLT_PERTURBATIONS];
    double L[MLT_PERTURBATIONS]; /* below 0: not known yet */
    double raster[2], lens[2];   /* the numbers of x_k, [0,1) */
};

/* How a path is made again: where it may differ. */
struct mlt_move {
    double raster[2]; /* LENS_PERTURBATION */
    vec3 wi;          /* CAUSTIC_PERTURBATION: how x_l is left, unit */
};

/* mlt_stay: the move that changes nothing. */
struct mlt_move mlt_stay(const struct mlt_path *path, enum mlt_perturbation which);

/* mlt_remake: make a path again by the strategy that belongs to a perturbation, which it allows, into the thread's
 * memory, and hear what it contributes as `next`.
 *   to  out: the strategy; to->n is given
 * Returns L, 0 if it has become no path, or one of other delta lobes. */
double mlt_remake(struct primary *p, const struct mlt_path *path, enum mlt_perturbation which,
                  const struct mlt_move *move, struct strategy *to);

/* mlt_pixels_per_angle: by how many pixels an angle at x_l moves x_m, if its chain did not bend; > 0. */
double mlt_pixels_per_angle(const struct chain *c, const struct mlt_path *path);

#endif
