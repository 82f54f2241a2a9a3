/* integrator.h: what an integrator is.
 *
 * The table of all integrators is in integrators.c. An integrator prepares itself once per render (parameters,
 * pre-pass), then renders tile passes (tile_pass.h).
 */
#ifndef ASBDPT_INTEGRATORS_INTEGRATOR_H
#define ASBDPT_INTEGRATORS_INTEGRATOR_H

#include "base/error.h"
#include "transport/tile_pass.h"

/* A parameter as --help lists it and a scene file or -P sets it. */
struct setting_help {
    const char *name, *fallback, *help, *type; /* its type in a scene file: "integer", "float", "string" */
};

#define DEFAULT_RR_THRESHOLD 0.5 /* rr_threshold where neither the user nor the integrator says otherwise */

/* How tile passes are rendered. */
struct tile_renderer {
    void (*render)(const void *state, const struct tile_pass *pass);
    void *(*new_scratch)(const void *state); /* memory of one thread, in work->scratch; may be NULL: none */
    void (*free_scratch)(void *scratch);
};

/* What `prepare` has settled. */
struct preparation {
    void *state; /* handed to the renderer, given to `release` at the end */
    const struct tile_renderer *renderer;
    struct pass_size size; /* any block, tiles of DEFAULT_TILE_SIZE unless changed */
    char note[FILM_NOTE_SIZE]; /* what was chosen, for people; may be empty */
    struct film_number number[FILM_NUMBERS]; /* and for programs, ended by a NULL name */
};

struct integrator {
    const char *name, *help;
    const struct setting_help *parameters; /* ended by a NULL name */
    /* Read parameters from job->scene->settings and do what must be done once. False with a message on a bad one. */
    bool (*prepare)(const struct render_job *job, struct preparation *out, struct error *err);
    void (*release)(void *state);
    /* Are those of its parameters that nobody else has right? False with a message if not; may be NULL: it has none. */
    bool (*check)(const struct settings *settings, struct error *err);
    /* rr_threshold unless the user gives one; may be NULL: DEFAULT_RR_THRESHOLD. */
    double (*rr_threshold)(const struct settings *settings);
};

/* integrator_find: by name ("pt", "lt", "bdpt", "asbdpt"; pbrt's "path" is pt). NULL if there is none. */
const struct integrator *integrator_find(const char *name);

/* integrator_list: all integrators, ended by NULL. */
const struct integrator *const *integrator_list(void);

#endif
