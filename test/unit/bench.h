/* bench.h: a method made ready to be rendered by hand, a tile pass or a step of a chain at a time, on one thread;
 * and scenes of several suites. */
#ifndef ASBDPT_TEST_BENCH_H
#define ASBDPT_TEST_BENCH_H

#include "chains/chain.h"
#include "render/render.h"
#include "test.h"

struct bench {
    const struct scene *scene;
    struct render_job job;
    struct prepared prepared;
    struct workspace *work;
    struct tile tile;    /* of all pixels of the film */
    struct chain *chain; /* of a method of chains, started; else NULL */
};

/* bench_new: a method, prepared with the test's seed and so much more. A chain has its independent states, of which the
 * scene's settings may say how many. A failure is a failed check; returns false.
 * bench_pass: iterations [first, end) of all pixels as one tile, which is empty; nobody observes. */
bool bench_new(struct test *t, const struct scene *scene, const char *integrator, int max_depth, uint64_t seed,
               struct bench *out);
void bench_free(struct bench *b);
struct tile_pass bench_pass(struct bench *b, long first, long end);

/* chain_room: a scene where every mutation has something to do, of some size, through some lens and filter, without
 * roulette; for paths of CHAIN_DEPTH. */
enum { CHAIN_DEPTH = 4 };
bool chain_room(struct test *t, int width, int height, const char *lens, const char *filter, struct scene *out);

/* Fog about the lens, a point light and a lamp, in the sky, with a ball of milk in glass: three groups of lights. */
extern const char FOGGY[];

#endif
