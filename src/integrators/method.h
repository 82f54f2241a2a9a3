/* method.h: a method is one file and one row.
 *
 * A row says all that anybody needs to know of a method; the table of all rows is render/methods.h. A render asks a
 * method to prepare its state once, parameters being read already, and then to render tile passes (tile_pass.h) on as
 * many threads as there are, each with scratch memory of its own. Methods whose pixels share the light sub-paths of
 * their tile leave the rendering to pooled_render and say what they draw (pooled.h).
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

/* Each of the two sub-paths once, all connections between them. */
#define NUMBERS_OF_BDPT {.path_pixels = 1, .draws = {1, 1}, .light_points = 1, .path_tracing = true}

struct method;

/* What makes any choice among a tile's light sub-paths better, whichever it is: parameters (services.h). */
struct services {
    int guide, credit;        /* off or on */
    double emission;          /* share of rays from lights that go by power alone; 1: all */
    int tile, spread;         /* of struct pass_size */
};

/* What is settled before the first sample and stays as it is, for weights go by it. The state of every method begins
 * with it. */
struct frozen {
    struct numbers numbers; /* of samples: the row's, unless parameters or `prepare` change them */
    struct mis_counts counts; /* what they count as: numbers without credits, unless `prepare` changes that */
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

/* What `prepare` has settled. */
struct preparation {
    const struct method *method;
    void *state;           /* of method->state_size bytes, begins with struct frozen; owned */
    struct pass_size size; /* any block, tiles of DEFAULT_TILE_SIZE unless changed */
    struct film_number number[FILM_NUMBERS]; /* what was chosen, ended by a NULL name */
};

struct pooled_pixel;

struct method {
    const char *name;   /* --integrator NAME */
    const char *select; /* asbdpt alone, whose rows share a name: the value of its parameter `select` */
    const char *help;   /* one line */
    const char *why;    /* for trace: how what an eye sub-path is joined to is chosen; NULL: it is not */

    const struct field *parameters;  /* of the state; NULL: none */
    size_t state_size, scratch_size; /* scratch_size 0: none; else all zeros at first */
    struct numbers numbers;          /* of samples, unless parameters or `prepare` say otherwise */
    double rr_threshold;             /* of Russian roulette unless the user gives one (path.h) */

    /* Do the parameters, each right in itself, fit each other and the scene? False with a message if not. NULL: yes. */
    bool (*check)(const void *state, const struct scene *scene, struct error *err);
    /* Settle the rest; out->state is zero except for struct frozen and the parameters. NULL: nothing is left. */
    void (*prepare)(const struct render_job *job, struct preparation *out);
    void (*release)(void *state); /* what the state owns, but not the state; NULL: nothing */

    void (*render)(const struct preparation *m, const struct tile_pass *pass);
    void (*scratch_init)(void *scratch, const void *state); /* NULL: zeros will do */
    void (*scratch_free)(void *scratch);                    /* what the scratch owns; NULL: nothing */

    /* What pooled_render calls; `scratch` begins with struct light_pool. begin, or NULL: an iteration's pool has been
     * filled. Then for each pixel one of two adds the strategies s >= 2, t >= 2 to p->sample, the other being NULL:
     * connect, called once, or draw, for every eye vertex z = z_{t-1} that can be connected to. */
    void (*begin)(void *scratch, const void *state, const struct tile_pass *pass, long iteration);
    void (*connect)(void *scratch, const void *state, struct pooled_pixel *p);
    void (*draw)(void *scratch, const void *state, struct pooled_pixel *p, const struct vertex *z, int t);
};

/* method_parameters: the table of a row's parameters, never NULL. method_has: the one of that name, or NULL; `select`
 * is one, too, where rows share a name. */
const struct field *method_parameters(const struct method *m);
const struct field *method_has(const struct method *m, const char *name);

/* method_check: are the scene's settings right that are the method's own? False with a message if not. */
bool method_check(const struct method *m, const struct scene *scene, struct error *err);

/* method_prepare: read the parameters and prepare.
 *   out  method_release releases it after success
 * Returns false with a message on a bad parameter. */
bool method_prepare(const struct method *m, const struct render_job *job, struct preparation *out, struct error *err);
void method_release(struct preparation *p);

/* method_scratch: the memory of one thread; NULL: none is needed. */
void *method_scratch(const struct preparation *p);
void method_scratch_free(const struct preparation *p, void *scratch);

#endif
