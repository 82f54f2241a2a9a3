/* method.h: a method is a row, and a file if it has code of its own. Methods differ in how many samples they take of
 * each kind, and in how they choose light vertices for an eye vertex. The table of all rows is render/rows.c.
 *
 * A method reads its parameters (method_read), is prepared (prepare.h), and renders tile passes (tile_pass.h) on all
 * threads.
 *
 * doc/add-a-method.md adds one. Tests: test_render.c, test_options.c, test/run/add_method.sh.
 */
#ifndef ASBDPT_METHOD_H
#define ASBDPT_METHOD_H

#include <stddef.h>

#include "base/error.h"
#include "base/settings.h"
#include "transport/sample.h"

#define DEFAULT_RR_THRESHOLD 0.5

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
#define PARAMETERS_SHARED(RACE, POINTS, GUIDE, EMISSION, TILE, SPREAD) \
    PARAMETER_RACE(RACE), PARAMETER_POINTS(POINTS), PARAMETER_GUIDE(GUIDE), PARAMETER_EMISSION(EMISSION), \
    PARAMETER_TILES(TILE, SPREAD)
extern const char *const OFF_ON[], *const RACES[];
enum { RACE_OFF, RACE_ON, RACE_RUNNERS }; /* then all runners */

/* A way to render that competes in a race (race.h), and what the race has found. */
struct runner {
    struct numbers numbers;
    double variance, price; /* of a sample: relative to the square of the brightness; any unit. 0: not measured */
};
enum runner_number { RUNNER_ALL, RUNNER_QUARTER, RUNNER_PATH_TRACER, RUNNER_ONE_POINT, RUNNERS };

/* runner_name: as -P race= has it. runner_cost: what a race minimises. */
static inline const char *runner_name(int runner) { return RACES[RACE_RUNNERS + runner]; }
static inline double runner_cost(const struct runner *k) { return k->variance * k->price; }

/* A method that is ready to render. It does not change while it renders. */
struct prepared {
    const struct method *method;
    struct parameters parameters;
    void *own;                /* see struct method; owned */
    struct numbers numbers;   /* those of the parameters, or of the winner of a race */
    double draw_worth[EYE_ENDS]; /* samples of BDPT that a draw counts as, without a credit; `prepare` may change it */
    struct counts counts;     /* in the weights */
    struct tables *tables;    /* owned */
    struct scene *uniform;    /* the job's scene if it chooses lights uniformly, else NULL; owned */
    struct pass_size size;    /* any block, tiles of DEFAULT_TILE_SIZE, unless parameters or `prepare` change it */
    struct runner runner[RUNNERS];
    int winner;               /* of a race, or as the parameter says */
    bool hasty;               /* the job was cancelled before all was learnt and raced */
};

/* What a method has made of a pool, in the pool's arena; each has a struct of its own. */
struct cache;

struct method {
    const char *name;   /* --integrator NAME */
    const char *select; /* value of the parameter `select`, which tells the rows of asbdpt apart; else NULL */
    const char *help;   /* one line */

    struct numbers numbers;         /* unless parameters or a race change them */
    const struct field *parameters; /* of struct parameters; NULL: none */
    const struct field *own;        /* parameters that this method alone has; NULL: none */
    size_t own_size;
    double rr_threshold;            /* of Russian roulette (path.h), unless the user gives another */
    bool vertices;                  /* a draw is a light vertex, not a sub-path */
    bool learns_use, learns_pairs;  /* see tables.h */

    /* How eye vertices choose among the light sub-paths that the pixels of a tile share. First, make a cache of the
     * pool of an iteration, or NULL. `build` is NULL if the pixels share none. */
    struct cache *(*build)(const struct prepared *p, const struct tile_pass *pass, long iteration);
    /* Choice number i of n for eye vertex z. False if there is none. */
    bool (*draw)(const struct prepared *p, const struct cache *cache, struct sample *sample, const struct vertex *z,
                 int i, int n, struct drawn *out);

    /* Each parameter is valid by itself. Check that they fit each other and the scene; false with a message if not. May
     * be NULL. */
    bool (*check)(const struct prepared *p, const struct scene *scene, struct error *err);
    /* Complete what is learnt, before the counts are made; or choose p->size. May be NULL. */
    void (*prepare)(const struct render_job *job, struct prepared *p);
    void (*release)(struct prepared *p); /* release what `prepare` has added to p->own. May be NULL */

    /* A tile pass: a loop of the method's own, or selection_render (loop.h). */
    void (*render)(const struct prepared *p, const struct tile_pass *pass);
};

/* method_has: the parameter of that name, or NULL. `select` is a parameter of rows that share a name. */
const struct field *method_has(const struct method *m, const char *name);

/* method_read: read all parameters into *p, all else of which is empty. False with a message if one is not valid; else
 * method_release (prepare.h) must follow. */
bool method_read(const struct method *m, const struct scene *scene, struct prepared *p, struct error *err);

/* method_size: p->size, or that of a path tracer if p->numbers are those of one: its pixels share next to no sub-paths,
 * so those of a tile may be neighbours.
 * method_counts: p->counts, of p->numbers, p->draw_worth and p->tables. */
struct pass_size method_size(const struct prepared *p);
void method_counts(const struct render_job *job, struct prepared *p);

#endif
