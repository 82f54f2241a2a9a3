/* learnt.h: what has been learnt about a scene before its first sample, frozen from then on, so that no choice made by
 * it is biased.
 *
 * A value: it depends on scene, film, seed and depth, not on the samples asked for, nor on threads: all who
 * render a part of a picture learn the same.
 */
#ifndef ASBDPT_LEARNT_H
#define ASBDPT_LEARNT_H

#include "learning/emission.h"
#include "learning/guide.h"
#include "learning/importance.h"
#include "learning/pairs.h"
#include "transport/mis.h"

/* What is wished to be learnt. Light vertices are counted in any case. */
struct wish {
    bool importance, guide, pairs;
    double emission; /* delta of emission, which needs importance; 1: it is not to be learnt */
    int eye_cells, light_cells; /* regions along the diagonal of where vertices are */
    int levels;                 /* of regions */
    double delta;               /* of the pairs, and of what guides their trials */
};

struct learnt {
    struct regions eye, light;    /* where eye vertices and light vertices lie */
    struct importance importance; /* how much of the camera's throughput comes to a light region */
    struct guide guide;           /* how s = 1 chooses lights, by eye region */
    struct pairs pairs;           /* how s >= 2 chooses light vertices, by both */
    struct emission emission;     /* how light sub-paths leave the lights */
    bool guided, paired, aimed;   /* are there a guide, pairs, emission? */
    struct count_model model;     /* all of it, as the weights see it; of no use once the struct has moved */
};

/* learnt_freeze: fill in the model, which counts then may point to. */
void learnt_freeze(struct learnt *l);
void learnt_free(struct learnt *l);

#endif
