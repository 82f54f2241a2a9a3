/* options.h: what is to be learnt about a scene; see learn.h. */
#ifndef ASBDPT_LEARNING_OPTIONS_H
#define ASBDPT_LEARNING_OPTIONS_H

#include <stdbool.h>

/* Light vertices are counted in any case. */
struct learn_options {
    bool importance, guide, pairs;
    double emission; /* delta of emission, which needs importance; 1: it is not to be learnt */
    int eye_cells, light_cells; /* regions along the diagonal of where vertices are */
    int levels;                 /* of regions */
    double delta;               /* of the pairs, and of what guides their trials */
};

#endif
