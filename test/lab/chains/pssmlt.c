/* pssmlt.c: primary sample space Metropolis light transport: a state is a whole sample of bdpt.          [Kelemen 2002]
 *
 * An eye and a light sub-path with all connections between them, each strategy with its weight. The eye sub-path's
 * strategies go to its raster point, those with t = 1 elsewhere, so a state has up to maxdepth + 1 splats. With
 * largestepprobability 1 its states are bdpt's samples, of independent numbers.
 *
 * Tests: test_chains.c.
 */
#include "chains/primary.h"
#include "caustics/joint.h"

static void sample(struct chain *c, bool small)
{
    const struct render_job *job = c->job;
    const struct tile_pass pass = {.job = job, .counts = &c->all->counts, .tile = &c->next.heard,
                                   .work = c->work, .ends_at = CANCEL_NOW};
    struct primary p;
    double px, py;
    primary_begin(&p, c, small);
    struct sample s = {.pass = &pass, .eye = c->work->eye, .filter_weight = 1, .sampler = p.sampler[POINT_NUMBERS]};
    int n_eye = primary_eye(&p, job->max_depth + 2, &px, &py), n_light = primary_light(&p, job->max_depth + 1);
    const struct drawn all = {c->light, 1, n_light, 1};
    sample_alone(&s, n_eye);
    for (int t = 2; t <= n_eye; t++)
        sample_pairs(&s, &all, t, 1);
    tile_add_splat(pass.tile, px, py, s.value);
    s.sampler = p.sampler[LENS_NUMBERS];
    sample_lens(&s, c->light, n_light, 1);
    primary_end(&p);
}

static const struct chain_rules RULES = {.roulette = true, .sample = sample};

static void prepare(const struct render_job *job, struct prepared *out) { chain_prepare(&RULES, job, out); }

const struct method method_pssmlt = {
    .name = "pssmlt", .help = "a Markov chain over the random numbers of bdpt's samples [Kelemen 2002]",
    .parameters = CHAIN_SHARED, .own = CHAIN_PARAMETERS, .rr_threshold = DEFAULT_RR_THRESHOLD,
    .prepare = prepare, CHAIN_ROW};
