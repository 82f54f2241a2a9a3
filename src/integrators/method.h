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
#include "transport/pixel_sample.h"

#define DEFAULT_RR_THRESHOLD 0.5

struct method;

/* What makes any choice among a tile's light sub-paths better, whichever it is (services.h). Each is a parameter of
 * every pooled method, so that it can be said what the choice alone brings. */
struct services {
    int guide, credit, pilot; /* off or on */
    double emission;          /* share of rays from lights that go by power alone; 1: all */
    int tile, spread;         /* of struct pass_size */
};

/* What every method has settled before the first sample: its own state begins with it. All 0 but the counts, which are
 * BDPT's, when it is to be prepared. */
struct frozen {
    struct mis_counts counts;
    int max_depth;
    int lights;             /* samples of s = 1 at the first hit, 0: left to the method; 1 */
    int path_pixels;        /* pooled methods: pixels for each light sub-path, 0: there are none; 1 */
    double draws[EYE_ENDS]; /* methods that draw light vertices: for each eye vertex, on average; else 0 */
    struct {
        int connections, path_pixels; /* by the user, instead of `draws` and `path_pixels`; 0: to be chosen */
    } given;
    struct services services;
    struct tables tables; /* owned */
};

/* What `prepare` has settled. */
struct preparation {
    const struct method *method;
    void *state;           /* of method->state_size bytes, begins with struct frozen; owned */
    struct pass_size size; /* any block, tiles of DEFAULT_TILE_SIZE unless changed */
    char note[FILM_NOTE_SIZE]; /* what was chosen, for people; may be empty */
    struct film_number number[FILM_NUMBERS]; /* and for programs, ended by a NULL name */
};

struct pooled_pixel;

struct method {
    const char *name;   /* --integrator NAME */
    const char *select; /* asbdpt alone, whose rows share a name: the value of its parameter `select` */
    const char *help;   /* one line */
    bool chain;         /* its samples are mutations of others, of no pixel and not independent: see chains/chain.h */
    bool surfaces;      /* it knows of them alone, not of media (scene/medium.h) */
    bool merges;        /* what it adds to a pixel is of many paths at once, of any length */
    const char *why;    /* for trace: how what an eye sub-path is joined to is chosen; NULL: it is not */
    const struct field *parameters; /* of the state; NULL: none */
    struct services services;       /* of pooled methods: their defaults; else all 0 */
    size_t state_size, scratch_size;    /* scratch_size 0: none; else all zeros at first */
    double rr_threshold;                /* of Russian roulette unless the user gives one (path.h) */

    /* Is each parameter right beside the others? False with a message if not. NULL: all are. */
    bool (*check)(const void *state, struct error *err);
    /* Settle counts and whatever is frozen; out->state is zero but for struct frozen and the parameters. NULL: all is
     * settled. */
    void (*prepare)(const struct render_job *job, struct preparation *out);
    void (*release)(void *state); /* what the state owns, but not the state; NULL: nothing */

    void (*render)(const struct preparation *m, const struct tile_pass *pass);
    void (*scratch_init)(void *scratch, const void *state); /* NULL: zeros will do */
    void (*scratch_free)(void *scratch);                    /* what the scratch owns; NULL: nothing */

    /* For pooled_render, whose scratch begins with struct light_pool: the pool of an iteration has been filled; NULL:
     * that is all; */
    void (*begin)(void *scratch, const void *state, const struct tile_pass *pass, long iteration);
    /* add the strategies s >= 2, t >= 2 to p->sample, of all the pixel's eye sub-path or, called for every eye vertex
     * that can be connected to, those of z = z_{t-1}. One of the two is NULL. */
    void (*connect)(void *scratch, const void *state, struct pooled_pixel *p);
    void (*draw)(void *scratch, const void *state, struct pooled_pixel *p, const struct vertex *z, int t);
};

extern const struct method method_bdpt; /* what the others differ from */

/* method_fields: the table of all parameters of a row, its own and services, ended by one without name. */
enum { METHOD_FIELDS = 24 };
void method_fields(const struct method *m, struct field out[METHOD_FIELDS]);

/* method_has: the parameter of that name that a row has, or NULL; `select` is one, where rows share a name. */
const struct field *method_has(const struct method *m, const char *name);

/* method_check: are the settings right that are the method's own? False with a message if not. */
bool method_check(const struct method *m, const struct settings *s, struct error *err);

/* method_prepare: read the parameters and prepare.
 *   out  method_release releases it after success
 * Returns false with a message on a bad parameter. */
bool method_prepare(const struct method *m, const struct render_job *job, struct preparation *out, struct error *err);
void method_release(struct preparation *p);

/* method_scratch: the memory of one thread; NULL: none is needed. */
void *method_scratch(const struct preparation *p);
void method_scratch_free(const struct preparation *p, void *scratch);

#endif
