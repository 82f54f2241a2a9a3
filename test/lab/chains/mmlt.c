/* mmlt.c: multiplexed Metropolis light transport: a state is one strategy of bdpt.                    [Hachisuka 2014]
 *
 * A chain keeps the length of its paths, and one of its numbers says which of the strategies (s,t) that make such paths
 * is taken, so that it stays where a strategy's weight is large, and does not spend time on the others. N strategies
 * each chosen with 1/N stand for their sum: a contribution counts N times. This is pbrt-v3's `mlt`.
 *
 * Tests: test_chains.c.
 */
#include "chains/primary.h"

static void sample(struct chain *c, bool small)
{
    struct primary p;
    struct strategy strategy;
    primary_begin(&p, c, small);
    primary_strategy(&p, &strategy);
    primary_end(&p);
}

static const struct chain_rules RULES = {.roulette = true, .by_length = true, .sample = sample};

static void prepare(const struct render_job *job, struct prepared *out) { chain_prepare(&RULES, job, out); }

const struct method method_mmlt = {
    .name = "mmlt", .help = "a Markov chain over bdpt's single strategies and their numbers [Hachisuka 2014]",
    .parameters = CHAIN_SHARED, .own = CHAIN_PARAMETERS, .rr_threshold = 0, .prepare = prepare, CHAIN_ROW};
