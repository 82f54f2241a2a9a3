/* chain_bench.h: Markov chains made ready to take single steps, for test_chains.c and test_balance.c. */
#ifndef ASBDPT_CHAIN_BENCH_H
#define ASBDPT_CHAIN_BENCH_H

#include "chains/chain.h"
#include "test.h"

/* bench_room: a scene where every mutation has something to do, of some size, through some lens and filter, without
 * roulette. */
bool bench_room(struct test *t, int width, int height, const char *lens, const char *filter, struct scene *out);

struct bench {
    const struct scene *scene;
    struct render_job job;
    struct preparation prepared;
    struct workspace *work;
    struct chain *chain; /* of a method of chains */
};

enum { BENCH_DEPTH = 4 };

/* bench_new: a method, prepared with the test's seed and so much more; a chain has its independent states, of which the
 * scene's settings may say how many. A failure is a failed check; returns false. */
bool bench_new(struct test *t, const struct scene *scene, const char *integrator, uint64_t seed, struct bench *out);
void bench_free(struct bench *b);

#endif
