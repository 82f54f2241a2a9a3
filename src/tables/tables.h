/* tables.h: what is known about the places of a scene: tables (table.h) with rows and columns for its regions and
 * lights. They are a function of scene, film, seed, depth and parameters, not of the number of samples or threads. They
 * do not change while samples are taken, so choices that use them are unbiased. learning/learn.h fills them, and shows
 * the way of each number from a sample to a weight.
 */
#ifndef ASBDPT_TABLES_TABLES_H
#define ASBDPT_TABLES_TABLES_H

#include "tables/regions.h"
#include "tables/table.h"

struct tables {
    struct regions regions;
    double *use;           /* [regions.limit] how much light the camera can use there: the sum of luminance(beta)
                            * over the eye vertices there; NULL: not learnt; owned */
    double *vertices;      /* [regions.limit] share of the connectible light vertices there; NULL: not learnt; owned */
    double light_vertices; /* mean number of connectible vertices of a light sub-path */
    struct table guide;    /* regions x light cells: how s = 1 chooses lights */
    struct table pairs;    /* regions x regions: how s >= 2 chooses light vertices (columns) for eye vertices */
    struct table emission; /* 1 x emission.h: how light sub-paths leave lights */
};

extern const struct tables NO_TABLES; /* all are empty */

void tables_free(struct tables *t);

#endif
