/* method.h: a method is one file and one row.
 *
 * A row describes a method completely; the table of all rows is render/methods.h. A render reads the method's
 * parameters and lets it prepare its state once. Then it lets the method render tile passes (tile_pass.h) on all
 * threads, each with its own scratch memory. If the pixels of a tile share light sub-paths, `render` is pooled_render,
 * and the method only defines what it draws (pooled.h).
 *
 * doc/add-a-method.md adds one. Tests: test_render.c, test_options.c, test/add_method.sh.
 */
#ifndef ASBDPT_METHOD_H
#define ASBDPT_METHOD_H

#include "base/error.h"
#include "base/field.h"
#include "tables/tables.h"
#include "transport/counts.h"
#include "transport/pixel_sample.h"

#define DEFAULT_RR_THRESHOLD 0.5

struct method;

/* What makes any choice among a tile's light sub-paths better, whichever it is: parameters (services.h). */
struct services {
    int guide;                /* off or on */
    double emission;          /* share of light sub-paths that start by power alone; 1: all */
    double credit;            /* of direct light, see struct credits */
    int tile, spread;         /* of struct pass_size */
};

/* What is fixed before the first sample, because the weights depend on it. The state of every method begins with
 * this. */
struct frozen {
    struct numbers numbers;   /* those of the row, unless parameters or `prepare` change them */
    struct mis_counts counts; /* of these numbers without credits, unless `prepare` changes them */
    int max_depth;
    struct services services;
    struct tables tables; /* owned */
};

/* frozen_count: f->counts, from its numbers with these credits, its tables, and the job's heuristic. */
static inline void frozen_count(const struct render_job *job, struct frozen *f, struct credits credits)
{
    f->counts = counts_of(f->numbers, credits, pixel_light_count(job));
    f->counts.power = job->power_heuristic;
    f->counts.tables = &f->tables;
}

/* The result of preparing. */
struct preparation {
    const struct method *method;
    void *state;           /* of method->state_size bytes, begins with struct frozen; owned */
    struct pass_size size; /* any block, tiles of DEFAULT_TILE_SIZE, unless `prepare` changes it */
    struct film_number number[FILM_NUMBERS]; /* chosen numbers, for --stats; ended by a NULL name */
};

struct pooled_pixel;

struct method {
    const char *name;   /* --integrator NAME */
    const char *select; /* value of the parameter `select`, which tells the rows of asbdpt apart; else NULL */
    const char *help;   /* one line */
    const char *why;    /* for trace: how it chooses what it joins to an eye sub-path; NULL: it does not choose */

    const struct field *parameters;  /* of the state; NULL: none */
    size_t state_size, scratch_size; /* scratch_size 0: no scratch; else it starts as zeros */
    struct numbers numbers;          /* see struct frozen */
    double rr_threshold;             /* of Russian roulette (path.h), unless the user gives another */

    /* Each parameter is valid by itself. Check that they fit each other and the scene; false with a message if not. May
     * be NULL. */
    bool (*check)(const void *state, const struct scene *scene, struct error *err);
    /* Complete the preparation. out->state is zero except for struct frozen and the parameters. May be NULL. */
    void (*prepare)(const struct render_job *job, struct preparation *out);
    void (*release)(void *state); /* release what the state owns, but not the state. May be NULL */

    void (*render)(const struct preparation *m, const struct tile_pass *pass);
    void (*scratch_init)(void *scratch, const void *state); /* may be NULL */
    void (*scratch_free)(void *scratch);                    /* release what the scratch owns. May be NULL */

    /* pooled_render calls these functions; `scratch` begins with struct light_pool. It calls `begin`, which may be
     * NULL, after it has filled the pool of an iteration. Then the method has either `connect` or `draw`, which add the
     * strategies s >= 2, t >= 2 to p->sample. `connect` is called once per pixel, `draw` for every eye vertex z =
     * z_{t-1} that can be connected to. */
    void (*begin)(void *scratch, const void *state, const struct tile_pass *pass, long iteration);
    void (*connect)(void *scratch, const void *state, struct pooled_pixel *p);
    void (*draw)(void *scratch, const void *state, struct pooled_pixel *p, const struct vertex *z, int t);
};

/* method_parameters: the table of a row's parameters, never NULL.
 * method_has: the parameter of that name, or NULL. `select` is a parameter of rows that share a name. */
const struct field *method_parameters(const struct method *m);
const struct field *method_has(const struct method *m, const char *name);

/* method_check: are the method's parameters valid in this scene's settings? False with a message if not. */
bool method_check(const struct method *m, const struct scene *scene, struct error *err);

/* method_prepare: read the parameters and prepare.
 *   out  after success, method_release releases it
 * Returns false with a message if a parameter is not valid. */
bool method_prepare(const struct method *m, const struct render_job *job, struct preparation *out, struct error *err);
void method_release(struct preparation *p);

/* method_scratch: the scratch of one thread; NULL if the method has none. */
void *method_scratch(const struct preparation *p);
void method_scratch_free(const struct preparation *p, void *scratch);

#endif
