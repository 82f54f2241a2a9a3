/* tile_pass.h: the unit of work of a render: one tile of pixels, a block of consecutive iterations.
 *
 * A tile pass depends on nothing but what stands here, so passes may run on any thread, in any order.
 */
#ifndef ASBDPT_TRANSPORT_TILE_PASS_H
#define ASBDPT_TRANSPORT_TILE_PASS_H

#include "scene/film.h"
#include "transport/path.h"

struct observer;

/* What does not change during a render. */
struct render_job {
    const struct scene *scene;
    struct pixel_rect film_rect; /* the crop in pixels */
    uint64_t seed;
    uint64_t eye_seed; /* of eye sub-paths alone; else the same */
    int max_depth;
    int n_threads;
    bool power_heuristic;
    double rr_threshold; /* of Russian roulette, see path.h */
    bool spatial_lights; /* pbrt's lightsamplestrategy asks for lights by what is seen; else they are picked by power */
    /* Called now and then, one call at a time, while a method prepares itself: how many sub-paths it has traced for
     * that. False: it is to come to an end, with what it has. NULL: nobody watches. */
    bool (*watch)(void *context, double traced);
    void *watch_context;
    bool (*enough)(void *context); /* see pass_enough; NULL: all of every pass is wanted */
    void *enough_context;
};

/* How a method wants its work cut. */
struct pass_size {
    int block;  /* iterations; 0: any number */
    int tile;   /* pixels along the side, at most MAX_TILE_SIZE */
    int spread; /* on each axis up to so many tiles are interleaved: what their pixels share forms no squares */
};
enum { LONGEST_BLOCK = 32, DEFAULT_TILE_SIZE = 16, MAX_TILE_SIZE = 32, POOL_SPREAD = 4 };

/* Memory of one thread, made once and reused by all its tile passes. */
struct workspace {
    struct arena arena;
    struct vertex *eye, *light; /* [max_depth + 2] each; owned */
    void *scratch;              /* the method's; may be NULL */
};

/* workspaces_new: arenas and sub-paths for n threads; `scratch` is left NULL. */
struct workspace *workspaces_new(int n, int max_depth);
void workspaces_free(struct workspace *work, int n);

/* One tile, iterations [first, end). */
struct tile_pass {
    const struct render_job *job;
    long first, end;
    struct tile *tile; /* started; receives the result */
    struct workspace *work;
    const struct observer *observer; /* who looks on (observer.h); NULL: nobody */
};

/* pass_enough: is the rest of a tile pass not wanted? Every method asks before each of its samples. After the first yes
 * the answer stays yes, and nobody looks at what the tile holds.
 * pass_pixel: pixels_get of the tile; false, too, if the first are enough. */
static inline bool pass_enough(const struct render_job *job)
{
    return job->enough != NULL && job->enough(job->enough_context);
}

static inline bool pass_pixel(const struct tile_pass *pass, int i, int *x, int *y)
{
    return pixels_get(pass->tile->pixels, i, x, y) && !(i > 0 && pass_enough(pass->job));
}

#endif
