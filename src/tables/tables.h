/* tables.h: all tables about places of a scene. They are a function of scene, film, seed and depth, not of the number
 * of samples or threads. They do not change while samples are taken, so choices that use them are unbiased.
 *
 * Three of the tables define how something is drawn, and the density of a draw for the weights of mis.h: light points
 * (guide), light vertices (pairs) and rays from lights (emission). A table of zeros is empty: then draws go by power,
 * and factors are 1. learning/learn.h fills the tables.
 */
#ifndef ASBDPT_TABLES_TABLES_H
#define ASBDPT_TABLES_TABLES_H

#include "tables/emission.h"
#include "tables/guide.h"
#include "tables/importance.h"
#include "tables/pairs.h"

struct tables {
    struct regions eye, light;    /* regions of eye vertices and of light vertices */
    struct importance importance; /* by light region: how much light the camera can use */
    struct guide guide;           /* by eye region: how s = 1 chooses lights */
    struct pairs pairs;           /* by both: how s >= 2 chooses light vertices */
    struct emission emission;     /* by light cell: how light sub-paths leave lights */
};

extern const struct tables NO_TABLES; /* all are empty */

void tables_free(struct tables *t);

#endif
