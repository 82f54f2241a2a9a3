/* film.h: where estimates of pixels are summed.
 *
 * A pixel's estimate has two parts. `eye`: per iteration, what its own eye sub-path brought (all strategies with
 * t >= 2). `splat`: what light sub-paths of any pixel sent straight to the lens (t = 1), spread by the pixel filter.
 * A tile pass (one tile, a block of iterations) fills a struct tile, and the film takes tiles in. The sums are exact
 * (exact_sum.h): they depend on which values came in, not on their order, nor on how the iterations were cut into
 * blocks or parts. What else is kept on request is summed in a fixed order, whatever the number of threads.
 *
 * A gate keeps what light brings that has come so far, and no farther. What is in it is the difference of what two
 * running sums of a pixel's sample hold, and splats: so films of gates that follow each other add up to the ungated
 * film, to the bit.
 *
 * On request a film has more planes than the picture: one for what each group of lights (light.h) brings, and one for
 * alpha. They are sums of the same kind, so that whatever is done with films is done with all of them. A sample's value
 * grows from 0 by what its paths bring, one after the other; to the plane of its light every step brings two terms, the
 * value after it less the value before it. Added up, all but the last value cancel: so the planes of all lights
 * together are the picture, to the bit.
 *
 * Standard errors: eye values of different iterations are independent draws; splats are many rare events, whose
 * variance is the sum of their squares. Halves of the samples say the same of the picture as a whole, and nothing is
 * left out of them (render/halves.h).
 *
 * Tests: test_film.c.
 */
#ifndef ASBDPT_FILM_H
#define ASBDPT_FILM_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "base/exact_sum.h"
#include "base/mem.h"
#include "base/rgb.h"
#include "scene/filter.h"

/* Pixels [x0,x1) x [y0,y1), but that after each column skip_x others are left out, and skip_y after each row. */
struct pixel_rect {
    int x0, y0, x1, y1;
    int skip_x, skip_y; /* 0 unless said otherwise */
};

/* rect_width, rect_height: columns and rows that are not left out. rect_has: is a pixel one of them? */
static inline int rect_width(struct pixel_rect r) { return (r.x1 - r.x0 + r.skip_x) / (r.skip_x + 1); }
static inline int rect_height(struct pixel_rect r) { return (r.y1 - r.y0 + r.skip_y) / (r.skip_y + 1); }
static inline bool rect_has(struct pixel_rect r, int x, int y)
{
    return x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1 && (x - r.x0) % (r.skip_x + 1) == 0 &&
           (y - r.y0) % (r.skip_y + 1) == 0;
}
static inline size_t rect_pixels(struct pixel_rect r) { return (size_t)rect_width(r) * (size_t)rect_height(r); }

/* Of a path's length, in scene units (vertex.h): all from `begin` to below `end`. An infinite end takes in all that is
 * not below `begin`. */
struct gate {
    double begin, end;
};

/* gate_before: is a length below a bound of a gate? */
static inline bool gate_before(double length, double bound) { return bound == INFINITY || length < bound; }
static inline bool gate_holds(struct gate g, double length)
{
    return gate_before(length, g.end) && !gate_before(length, g.begin);
}

/* Neighbouring gates of one width: number i is [begin + i width, begin + (i + 1) width). */
struct gates {
    double begin, width; /* width > 0 */
    int n;
};

/* What a film, or a tile, has beside the picture. Planes are numbered: the picture, groups of lights, alpha. */
struct planes {
    int lights; /* groups of lights; 0: none is told apart */
    bool alpha;
};
static inline int plane_count(struct planes p) { return 1 + p.lights + p.alpha; }

/* What a light sub-path sent to a raster point, all pixels having their part of it yet to come. */
struct splat {
    double px, py;
    rgb value;
    double length; /* of its path */
    int lights;    /* the group of lights it comes from */
};

/* One contribution of one strategy, kept only for per-strategy images. */
struct strategy_record {
    int32_t at; /* t >= 2: pixel of the film's rectangle, row by row; t = 1: place in the list of splats */
    int16_t s, t;
    float unweighted[3];
    float weight; /* its MIS weight, [0,1] */
    double length;
};

/* So many splats, or records, do not wait for the end of a pass: paths may have a thousand bounces, a pass any number
 * of iterations. */
enum { TILE_FULL = 1 << 16 };

/* What a tile pass produces. Reused from pass to pass. */
struct tile {
    struct pixel_rect rect;
    struct pixel_rect film_rect; /* of the film: splats land anywhere in it */
    const struct filter *filter;
    struct planes planes;  /* set before tile_start */
    struct exact_sum *sum; /* [planes][pixels of rect * 3], sum over the iterations of the pass; owned */
    double *square;        /* [pixels of rect * 3], sum of squares of the per-iteration values; owned */
    size_t capacity, square_capacity;
    struct splat *splat; /* [n_splats], owned */
    size_t n_splats, splat_capacity;
    struct strategy_record *record; /* [n_records], owned */
    size_t n_records, record_capacity;
    bool keep_records;
    struct gate gate; /* what goes in; tile_start: all lengths */
    bool first_half;  /* its iterations belong to the first of two halves; tile_start: no */
    void (*full)(void *context, struct tile *tile); /* empties full lists; NULL: they grow */
    void *context;
    long nonfinite; /* contributions that were NaN, infinite or beyond FLT_MAX, and were left out */
};

/* tile_start: begin a pass: clear the sums. */
void tile_start(struct tile *t, struct pixel_rect rect, struct pixel_rect film_rect, const struct filter *filter,
                bool keep_records);
void tile_free(struct tile *t);

/* tile_add_between: the whole value of pixel (x,y) of the tile for one iteration, the difference of two sums, of what
 * came `until` the end of a gate and of what came `before` its beginning. Each is a term: of gates that follow each
 * other, one's first cancels the next's second. Call once per pixel and iteration. */
void tile_add_between(struct tile *t, int x, int y, rgb until, rgb before);

/* tile_add_light: a sample's value has come from `before` to `after` by what a group of lights has brought.
 * tile_add_alpha: the sample's alpha. For tiles that have such planes. */
void tile_add_light(struct tile *t, int x, int y, int lights, rgb after, rgb before);
void tile_add_alpha(struct tile *t, int x, int y, double alpha);

/* tile_add_splat: a value arriving at raster point (px,py), to be spread over pixels by the filter. False if it was
 * left out. */
bool tile_add_splat(struct tile *t, double px, double py, rgb value, double length, int lights);

/* splat_pixels: those of `within` whose filter covers the splat; none when x1 <= x0 or y1 <= y0.
 * splat_part: what it adds to one of them, as floats; false if no float holds it. */
struct pixel_rect splat_pixels(const struct splat *s, const struct filter *filter, struct pixel_rect within);
bool splat_part(const struct splat *s, const struct filter *filter, int x, int y, float out[3]);

/* tile_record_eye, tile_record_splat: note a contribution of strategy (s,t) and its MIS weight, at a pixel of the tile,
 * or of (s,1) for the splat that was added last, if records are kept. */
void tile_record_eye(struct tile *tile, int x, int y, int s, int t, rgb unweighted, double weight, double length);
void tile_record_splat(struct tile *tile, int s, rgb unweighted, double weight, double length);

/* Images of single strategies, [strategy_count(max_depth)][pixels*3], numbered by strategy_index. */
struct strategy_images {
    int max_depth;
    double *unweighted, *weighted; /* owned */
};

/* Pictures by gates. */
struct gate_images {
    struct gates gates;
    double *sum; /* [gates.n][pixels*3], owned */
};

/* What standard errors are made of, [pixels*3]. */
struct film_errors {
    double *eye, *square; /* sums of eye values, and of squares of these and of splats; owned */
};

/* The block of iterations under way, for a picture that is wanted before it is complete. */
struct film_block {
    long iterations;
    size_t n_in;  /* pixels whose samples are in the film */
    bool *in;     /* [pixels]: which these are; owned */
    float *splat; /* [1 + planes.lights][pixels*3], what its splats have brought; owned */
};

/* How far the picture is from what it converges to, as halves.h finds it. */
enum noise_scale { NOISE_RELATIVE, NOISE_8_BIT, N_NOISE_SCALES };
struct noise_estimate {
    double value, error; /* its standard error; both infinite where nothing is known */
};

enum { FILM_NOTE_SIZE = 200, FILM_NUMBERS = 8 };

struct film_number {
    const char *name; /* static */
    double value;
};

struct film {
    struct pixel_rect rect;      /* the rendered part (crop) of the full frame */
    int full_width, full_height;
    long iterations;             /* samples per pixel taken so far */
    int64_t passes;              /* tile passes of the next block of iterations that are in already */
    struct film_block block;     /* that block */
    struct planes planes;
    struct exact_sum *sum;       /* [planes][pixels*3] of eye values and splats; owned */
    struct exact_sum *half;      /* [pixels*3], the picture's of every other `run` iterations, or NULL; owned */
    int run;                     /* set when the render begins */
    struct noise_estimate noise[N_NOISE_SCALES]; /* when the halves were of one size the last time */
    struct film_errors *errors;  /* NULL unless asked for; owned */
    long nonfinite;
    char note[FILM_NOTE_SIZE]; /* what the method chose for itself, for people */
    struct film_number number[FILM_NUMBERS]; /* and for programs, ended by a NULL name */
    struct strategy_images *strategies; /* NULL unless asked for; owned */
    struct gate_images *gates;          /* likewise */
    bool learnt_short;   /* its samples are by what was learnt in haste */
};

/* film_init: black, for the pixels of `rect` out of a frame of full_width x full_height. Release with film_free. */
void film_init(struct film *f, struct pixel_rect rect, int full_width, int full_height);
void film_free(struct film *f);

/* film_keep_planes: of a film that has nothing in it yet. */
void film_keep_planes(struct film *f, struct planes planes);

/* film_keep_errors: from now on keep what film_standard_error needs. */
void film_keep_errors(struct film *f);

/* film_keep_halves: from now on sum every other run of iterations on its own, too. */
void film_keep_halves(struct film *f);

/* film_keep_strategies: from now on sum every strategy on its own, for paths up to max_depth. */
void film_keep_strategies(struct film *f, int max_depth);

/* film_keep_gates: from now on sum what goes into each of these gates on its own. */
void film_keep_gates(struct film *f, struct gates gates);

/* film_keeps_records: does it need those of tiles? */
static inline bool film_keeps_records(const struct film *f) { return f->strategies != NULL || f->gates != NULL; }

/* strategy_index: number of strategy (s,t), s >= 0, t >= 1, among those with s + t <= max_depth + 2; strategies are
 * ordered by path length. strategy_count: how many there are. */
int strategy_index(int s, int t);
int strategy_count(int max_depth);

/* film_take_splats: add a tile's splats and records, and empty its lists. */
void film_take_splats(struct film *f, struct tile *t);

/* film_merge_tile: add these and a tile's sums. film_mark: its pixels are in. film_end_block: all tiles of the block
 * are in, and count from now on. */
void film_merge_tile(struct film *f, struct tile *t);
void film_mark(struct film *f, struct pixel_rect tile);
void film_end_block(struct film *f);

/* film_splat_sums: places of block.splat. */
static inline size_t film_splat_sums(const struct film *f)
{
    return (size_t)(1 + f->planes.lights) * rect_pixels(f->rect) * 3;
}

/* film_value: the sum so far in place i of [planes][pixels*3]. */
double film_value(const struct film *f, size_t i);

/* film_samples: per pixel, in the mean. */
double film_samples(const struct film *f);

/* film_develop: the image so far: [height*width*3] linear floats, top row first, each pixel times `scale`, the mean of
 * all samples that it has; black if that is none. Values that no float holds are cut to FLT_MAX; returns how many.
 * film_develop_plane: the same of another plane than the picture. */
long film_develop(const struct film *f, double scale, float *out);
long film_develop_plane(const struct film *f, int plane, double scale, float *out);

/* film_alpha: the plane of alpha, grey, [height*width*3], to be given to free(); NULL if there is none. */
float *film_alpha(const struct film *f);

/* film_warn: say on stderr how many contributions were left out and how many values film_develop cut, if any. */
void film_warn(const struct film *f, long cut);

/* film_standard_error: of each value of film_develop; infinite with fewer than two iterations. The film must have been
 * asked to keep errors. */
void film_standard_error(const struct film *f, double scale, float *out);

#endif
