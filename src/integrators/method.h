/* method.h: a method is a row, and a file if it has code of its own. Methods differ in how many samples they take of
 * each kind, and in how they choose light vertices for an eye vertex. The table of all rows is render/rows.c.
 *
 * A method reads its parameters (parameters.h), is prepared (prepare.h), and renders tile passes (tile_pass.h) on all
 * threads.
 *
 * doc/add-a-method.md adds one. Tests: test_render.c, test_options.c, test/run/add_method.sh.
 */
#ifndef ASBDPT_METHOD_H
#define ASBDPT_METHOD_H

#include "base/error.h"
#include "base/settings.h"
#include "integrators/parameters.h"
#include "transport/sample.h"

#define DEFAULT_RR_THRESHOLD 0.5

/* A way to render that competes in a race (race.h), and what the race has found; 0: not measured. */
struct runner {
    struct numbers numbers;
    double variance; /* of a sample, relative to the brightness squared */
    double price;    /* of a sample, any unit */
};
/* As in RACES. The path tracers come last. */
enum runner_number { RUNNER_ALL, RUNNER_QUARTER, RUNNER_PATH_TRACER, RUNNER_ONE_POINT, RUNNERS };

/* runner_name: as -P race= has it. runner_cost: what a race compares. */
static inline const char *runner_name(int runner) { return RACES[RACE_RUNNERS + runner]; }
static inline double runner_cost(const struct runner *k) { return k->variance * k->price; }

/* A method that is ready to render. It does not change while it renders. */
struct prepared {
    const struct method *method;
    struct parameters parameters;
    void *own;                /* see struct method; owned */
    struct numbers numbers;   /* those of the parameters, or of the runner */
    double draw_worth[EYE_HITS]; /* samples of BDPT that a draw counts as, without a credit; `prepare` may change it */
    struct counts counts;     /* in the weights */
    struct tables *tables;    /* owned */
    struct scene *uniform;    /* the job's scene if it chooses lights uniformly, else NULL; owned */
    struct pass_size size;    /* any block, tiles of DEFAULT_TILE_SIZE, unless parameters, `prepare` or the runner change it */
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
    /* Complete what is learnt, before the counts are made; or choose p->size. Called each time after learning. May be
     * NULL. */
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

/* method_settle: make p->counts of p->numbers, p->draw_worth and p->tables; and p->size that of a path tracer if the
 * numbers are those of one: its pixels share next to no sub-paths, so those of a tile may be neighbours. */
void method_settle(const struct render_job *job, struct prepared *p);

#endif
