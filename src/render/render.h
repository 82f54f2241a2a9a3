/* render.h: from a prepared scene to a film: cut the work into tile passes and run them on threads.
 *
 * The frame (or its crop) is cut into tiles, the iterations into blocks, of sizes the method may choose. Tile passes
 * depend on nothing but the pixel and the iteration (of `bins`: the block), and the film's sums are exact, so the same
 * scene, seed and range of iterations give the same bytes for any number of threads, stopped and continued anywhere or
 * in parts.
 *
 * Tests: test_render.c.
 */
#ifndef ASBDPT_RENDER_H
#define ASBDPT_RENDER_H

#include <stdint.h>

#include "base/error.h"
#include "render/methods.h"
#include "scene/film.h"
#include "scene/scene.h"
#include "transport/observer.h"

/* Who looks on: an observer for each tile pass. So many passes for each thread are under way or wait for their turn. */
enum { OBSERVED_SLOTS = 2 };
struct observers {
    void *context;
    /* The observer of a pass, whose result will wait in this slot; called by any thread.
     *   tile  empty, of the pass */
    struct observer (*begin)(void *context, int slot, const struct tile *tile);
    /* The tile has gone into the film: in the order of passes, one call at a time. */
    void (*end)(void *context, int slot);
};

/* Go on; stop when the block of iterations under way is complete; stop at once, between two tile passes. The later the
 * more urgent. */
enum render_wish { RENDER_GO_ON, RENDER_END_BLOCK, RENDER_STOP };

struct render_options {
    const char *integrator; /* as method_find knows it */
    uint64_t seed;
    long first, end; /* iterations [first, end) of every pixel */
    long planned;    /* samples per pixel of the whole picture if these are a part of it; 0: `end` */
    bool is_part;    /* these are to be added to others: they must be whole blocks, where the method says how long */
    int block;       /* iterations of a block where the method leaves that open; 0: by the picture's size */
    int n_threads;   /* 0: one per processor */
    int max_depth;   /* 0: what the scene says, else 5 */
    double noise[N_NOISE_SCALES]; /* stop when the film's are below; 0: never. The film must keep halves */
    const struct observers *observers; /* who looks on at every path; NULL: nobody */
    /* Called after each tile pass with the share of the work done, in (0,1], one call at a time and while nothing else
     * touches the film. NULL: not called. While the method learns it is called, too, with 0; if it is not to go on
     * then, that ends with what has been learnt, by which one block is rendered, or at RENDER_STOP one tile pass,
     * unless `stop` ends that, if the film is empty. */
    enum render_wish (*progress)(void *context, double done);
    /* Asked before every sample, by any thread, with the same context: is the render to stop, even without the tile
     * passes under way? Once true, always. NULL: never. */
    bool (*stop)(void *context);
    void *progress_context;
};

/* render_crop: the pixels of the scene's crop window, as pbrt rounds it. */
struct pixel_rect render_crop(const struct scene *scene);

/* render_scene: render into a film.
 *   scene  prepared
 *   film   initialised by film_init for render_crop(scene), possibly holding earlier iterations already, and
 *          film->passes tile passes of the block that begins at options->first
 * Returns false with a message when a parameter is bad. */
bool render_scene(const struct scene *scene, const struct render_options *options, struct film *film,
                  struct error *err);

/* render_prepare: what comes before the first tile pass: parameters, and whatever the method learns.
 *   rect  the pixels to be rendered
 *   job   filled, except who watches, and when it is enough
 *   out   filled; method_release(out) afterwards
 * Returns false with a message when a parameter is bad; nothing needs release then. */
bool render_prepare(const struct scene *scene, const struct render_options *options, struct pixel_rect rect,
                    struct render_job *job, struct prepared *out, struct error *err);

/* --- tiling.c, identity.c ---------------------------------------------------------------------------- */

/* tiling_of: a film in tiles as a method wants them. tiling_count: how many; tiling_pixels: number 0 <= i < count. The
 * first few lie all over the film: they show what it is of, and how long the others will take. */
struct tiling {
    struct pixel_rect film;
    struct pass_size size;
    int nx, ny;   /* tiles */
    int64_t step; /* from one to the next, row by row */
};
struct tiling tiling_of(struct pixel_rect film, const struct pass_size *size);
static inline int64_t tiling_count(const struct tiling *t) { return (int64_t)t->nx * t->ny; }
struct tile_pixels tiling_pixels(const struct tiling *t, int64_t i);

/* identity_text: what a picture by these options is of, whatever its number of samples; lines, each a word and what it
 * says, to be given to free(). Threads, names of files and what is written do not belong to it; what the scene's files
 * hold does. */
char *identity_text(const struct scene *scene, const struct render_options *options);

#endif
