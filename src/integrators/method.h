/* method.h: what a rendering method is.
 *
 * The table of all methods is in methods.c. A method prepares itself once per render (parameters, pre-pass), then
 * renders tile passes: one tile of pixels, a block of consecutive iterations. A tile pass depends on nothing but its
 * arguments, so passes may run on any thread, in any order.
 *
 * Used by: the methods, render.
 */
#ifndef ASBDPT_METHOD_H
#define ASBDPT_METHOD_H

#include "base/error.h"
#include "transport/tile_pass.h"

/* A parameter as --help lists it and a scene file or -P sets it. */
struct parameter {
    const char *name, *fallback, *help;
};

#define DEFAULT_RR_THRESHOLD 0.5 /* rr_threshold where neither the user nor the method says otherwise */

struct method {
    const char *name, *help;
    const struct parameter *parameters; /* ended by a NULL name */
    int block;                          /* iterations per tile pass unless prepare says otherwise */
    /* Read parameters from job->scene->settings and do what must be done once. *state is handed to the other
     * functions and given to `release`. False with a message on a bad parameter. */
    bool (*prepare)(const struct render_job *job, void **state, int *block, struct error *err);
    void (*render)(const void *state, const struct tile_pass *pass);
    void (*release)(void *state);
    void *(*new_own)(const void *state); /* may be NULL: no memory of its own */
    void (*free_own)(const void *state, void *own);
    /* rr_threshold unless the user gives one; may be NULL: DEFAULT_RR_THRESHOLD. */
    double (*rr_threshold)(const struct settings *settings);
};

/* method_find: by name ("pt", "lt", "bdpt", "asbdpt"; pbrt's "path" is pt). NULL if there is none. */
const struct method *method_find(const char *name);

/* method_list: all methods, ended by NULL. */
const struct method *const *method_list(void);

#endif
