/* render_job.h: a render: what methods read, the callbacks, and what was asked for. The caller fills what is asked,
 * noise, seed, depth, threads and callbacks; job.h then settles all else once, and replaces what is 0.
 *
 * A render ends early in one way: all code that takes samples asks job_cancelled. A limit of time or noise, a signal,
 * or a closed window is an answer of the function `cancel`.
 */
#ifndef ASBDPT_RENDER_JOB_H
#define ASBDPT_RENDER_JOB_H

#include <stdbool.h>
#include <stdint.h>

#include "base/settings.h"
#include "parser/messages.h" /* struct message_sink */
#include "scene/film.h"

enum { PATH_MAX_DEPTH = 1000 }; /* largest maxdepth accepted */

struct method;
struct observers; /* render/render.h */

/* pbrt-v3's lightsamplestrategy: how s = 1 chooses lights. SPATIAL: by region, if the method learns that; else, and
 * where light sub-paths start, by power. UNIFORM is of the scene (scene_uniform). */
enum light_strategy { LIGHTS_SPATIAL, LIGHTS_POWER, LIGHTS_UNIFORM };

/* Continue; stop learning, and render until the block of iterations is complete; stop at once. */
enum cancel { CANCEL_NOT, CANCEL_BLOCK, CANCEL_NOW };

struct render_job {
    /* What methods read. */
    const struct scene *scene;
    struct pixel_rect film_rect; /* the crop in pixels */
    uint64_t seed, eye_seed; /* of random numbers; of eye sub-paths, equal to `seed` except in measurements */
    int max_depth;       /* a path has at most max_depth + 2 vertices; 0: what the scene says, else 5 */
    int n_threads;       /* 0: one per processor */
    double rr_threshold; /* of Russian roulette, see path.h */
    enum light_strategy strategy;

    /* Callbacks. All may be NULL, and share the context. */
    void *context;
    /* Is the render to end early? Asked before every sub-path and sample, by any thread, at any time. The answer may
     * only become more urgent. */
    enum cancel (*cancel)(void *context);
    /* Called after each chunk of learning and after each tile pass with the shares of both that are done, in [0,1]; one
     * call at a time, while nothing else touches the film. */
    void (*progress)(void *context, double learnt, double done);
    const struct observers *observers; /* who looks on at every path */
    struct message_sink sink; /* of warnings and errors of the scene, in the place of stderr */

    /* The rest is for the rooms from render on. What is rendered: */
    const struct method *integrator;
    long first, end;     /* iterations [first, end) of every pixel */
    long planned;        /* samples per pixel of the whole picture if these are a part of it; 0: `end` */
    bool is_part;        /* they are to be added to others: whole blocks, where the method says how long these are */
    int block;           /* iterations of a block where the method leaves that open; 0: by the picture's size */
    double noise[N_NOISE_SCALES]; /* stop when the film's are below; 0: never. The film must keep halves */

    /* What is asked. 0, NULL or false: as the scene says, or else as is usual. Texts are borrowed. */
    const char *scene_path, *integrator_name, *filter;
    const char *scene_text; /* [scene_length], in the place of the file; or NULL */
    size_t scene_length;
    struct settings overrides; /* parameters of the integrator, from -P; owned by the caller */
    int spp;
    int res[2];          /* width and height of the film; height 0: the same shape */
    double crop[4];      /* x0, x1, y0, y1 in fractions of the film; x1 = 0: the scene's */
    double max_memory;   /* GB; 0: what is usual (budget_new) */
    bool quick;          /* a quarter of the width and height, one sample, unless others say otherwise */
    bool strict, quiet;  /* warnings are errors; print nothing but warnings and errors */
    int samples[2];      /* of each pixel, the second excluded: a part of the picture; 0, 0: all */
};

static inline enum cancel job_cancelled(const struct render_job *job)
{
    return job->cancel != NULL ? job->cancel(job->context) : CANCEL_NOT;
}

static inline void job_progress(const struct render_job *job, double learnt, double done)
{
    if (job->progress != NULL)
        job->progress(job->context, learnt, done);
}

#endif
