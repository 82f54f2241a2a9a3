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
#include "scene/film.h"
#include "transport/path.h"
#include "scene/scene.h"

/* A parameter as --help lists it and a scene file or -P sets it. */
struct parameter {
    const char *name, *fallback, *help;
};

/* The job all methods share. */
struct render_job {
    const struct scene *scene;
    struct pixel_rect film_rect; /* the crop in pixels */
    uint64_t seed;
    int max_depth;
    int n_threads;
    bool power_heuristic;
    double rr_threshold; /* of Russian roulette, see path.h */
};

enum { TILE_SIZE = 16 }; /* pixels along the side of a tile */

/* Memory of one thread, made once and reused by all its tile passes. */
struct workspace {
    struct arena arena;
    struct vertex *eye, *light; /* [max_depth + 2] each; owned */
    void *own;                  /* the method's, from new_own; may be NULL */
};

/* workspaces_new: arenas and sub-paths for n threads; `own` is left NULL. */
struct workspace *workspaces_new(int n, int max_depth);
void workspaces_free(struct workspace *work, int n);

/* One tile, iterations [first, end). */
struct tile_pass {
    const struct render_job *job;
    struct pixel_rect rect;
    long first, end;
    struct tile *tile; /* started; receives the result */
    struct workspace *work;
};

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
};

/* method_find: by name ("pt", "lt", "bdpt", "asbdpt"; pbrt's "path" is pt). NULL if there is none. */
const struct method *method_find(const char *name);

/* method_list: all methods, ended by NULL. */
const struct method *const *method_list(void);

#endif
