/* tables.h: what is known about places of a scene. A value, frozen: it depends on scene, film, seed and depth, not on
 * the samples asked for nor on threads, and does not change while samples are taken, so that no choice made by it is
 * biased.
 *
 * Three of the tables say how something is drawn, and with what density, which the weights of mis.h need: light points
 * (guide), light vertices (pairs) and rays from lights (emission). One of all zeros knows nothing: draws go by power
 * alone, and the factors are 1. learning/learn.h fills them.
 */
#ifndef ASBDPT_TABLES_TABLES_H
#define ASBDPT_TABLES_TABLES_H

#include "tables/emission.h"
#include "tables/guide.h"
#include "tables/importance.h"
#include "tables/pairs.h"

struct tables {
    struct regions eye, light;    /* where eye vertices and light vertices lie */
    struct importance importance; /* how much of the camera's throughput comes to a light region */
    struct guide guide;           /* how s = 1 chooses lights, by eye region */
    struct pairs pairs;           /* how s >= 2 chooses light vertices, by both */
    struct emission emission;     /* how light sub-paths leave the lights */
};

extern const struct tables NO_TABLES; /* nothing is known */

void tables_free(struct tables *t);

#endif
