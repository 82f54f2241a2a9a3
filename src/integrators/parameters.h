/* parameters.h: what a user may set of methods that choose light sub-paths. Each method lists those that it has, with
 * its defaults, for which these macros are the rows.
 *
 * Tests: test_options.c.
 */
#ifndef ASBDPT_PARAMETERS_H
#define ASBDPT_PARAMETERS_H

#include <stddef.h>

#include "base/field.h"
#include "transport/counts.h"
#include "transport/tile_pass.h"

/* Parameters of several methods. What makes any choice of light sub-paths better has one implementation that all
 * methods share, and a switch, so that one can measure the choice alone:
 *
 *   guide         s = 1 chooses lights by what they are worth to a region
 *   emission      light sub-paths start in directions that the camera can use (emission.h)
 *   race          fewer light sub-paths and connections if a race before the render finds them enough (race.h)
 *   lightpoints   points on lights that a first hit is joined to
 *   later         fewer draws for a later eye vertex than for a first hit
 *   credits       direct light at a first hit and draws count as more samples in the weights (counts.h)
 *   bound         draws count as less than a quarter of the pool's light sub-paths (counts.h)
 *   tile, spread  number of pixels that share light sub-paths, and how far apart they are (tile_pass.h)
 */
struct parameters {
    struct numbers numbers; /* those of the row, unless parameters change them; later draws -1: as many as others */
    int guide, credits, bound; /* off or on */
    int race;               /* RACE_OFF, RACE_ON, or a runner: RACE_RUNNERS + enum runner_number */
    double emission;        /* share of light sub-paths that start by power alone; 1: all */
    double delta;           /* share of choices that ignore what was learnt */
    int metric;             /* enum metric */
    int tile, spread;
};

/* Rows of a method's table of parameters, with these defaults. */
#define PARAMETER(NAME, KIND, MEMBER, DEFAULT, LEAST, MOST, HELP, WORDS) \
    {NAME, KIND, offsetof(struct parameters, MEMBER), DEFAULT, LEAST, MOST, HELP, WORDS}
#define PARAMETER_DELTA(DEFAULT) \
    PARAMETER("delta", FIELD_NUMBER, delta, DEFAULT, 1e-6, 1, "share of draws that ignore what was learnt", NULL)
#define PARAMETER_GUIDE(DEFAULT) \
    PARAMETER("guide", FIELD_WORD, guide, DEFAULT, 0, 0, \
              "choose lights by what a region sees, where there are several", OFF_ON)
#define PARAMETER_EMISSION(DEFAULT) \
    PARAMETER("emission", FIELD_NUMBER, emission, DEFAULT, 1e-6, 1, \
              "share of light sub-paths that leave lights as if nothing were learnt", NULL)
#define PARAMETER_RACE(DEFAULT) \
    PARAMETER("race", FIELD_WORD, race, DEFAULT, 0, 0, \
              "who renders: the winner of a race before it, or this runner; off: all", RACES)
#define PARAMETER_POINTS(DEFAULT) \
    PARAMETER("lightpoints", FIELD_INTEGER, numbers.light_points, DEFAULT, 1, 64, \
              "points on lights that an eye vertex that the camera sees is joined to", NULL)
#define PARAMETER_LATER(DEFAULT) \
    PARAMETER("later", FIELD_INTEGER, numbers.draws[LATER_HIT], DEFAULT, -1, 1024, \
              "draws of an eye vertex that the camera does not see; -1: as many as of one that it sees", NULL)
#define PARAMETER_CREDITS(DEFAULT) \
    PARAMETER("credits", FIELD_WORD, credits, DEFAULT, 0, 0, \
              "count draws, and direct light that the camera sees, as more samples, for they are stratified", OFF_ON)
#define PARAMETER_BOUND(DEFAULT) \
    PARAMETER("bound", FIELD_WORD, bound, DEFAULT, 0, 0, \
              "count draws as less than a quarter of the light sub-paths of a tile", OFF_ON)
#define PARAMETER_TILES(TILE, SPREAD) \
    PARAMETER("tile", FIELD_INTEGER, tile, TILE, 1, MAX_TILE_SIZE, \
              "pixels along a side of those that share light sub-paths", NULL), \
    PARAMETER("spread", FIELD_INTEGER, spread, SPREAD, 1, 64, "tiles that are interleaved along each axis", NULL)
extern const char *const OFF_ON[], *const RACES[];
enum { RACE_OFF, RACE_ON, RACE_RUNNERS }; /* then all runners */

#endif
