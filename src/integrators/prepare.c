/* prepare.c: see prepare.h. */
#include "integrators/prepare.h"

#include <stdlib.h>

#include "integrators/race.h"
#include "learning/learn.h"

enum { MIN_GUIDED_CELLS = 4 }; /* light cells; a guide does not help with fewer */

/* Whoever renders: that of all runners. */
static struct learn_options what_to_learn(const struct render_job *job, const struct prepared *p)
{
    const struct method *m = p->method;
    const struct parameters *q = &p->parameters;
    bool light_paths = p->numbers.path_pixels > 0;
    return (struct learn_options){
        .use = light_paths && (m->learns_use || q->emission < 1), .pairs = light_paths && m->learns_pairs,
        .guide = q->guide && job->strategy == LIGHTS_SPATIAL && job->scene->lights.n_cells >= MIN_GUIDED_CELLS,
        .emission = q->emission, .delta = q->delta, .count = light_paths && m->vertices};
}

/* Of single vertices, a draw is one of so many of a light sub-path. */
static void find_draw_worth(struct prepared *p)
{
    double n = p->method->vertices ? p->tables->light_vertices : 0;
    for (int hit = 0; hit < EYE_HITS; hit++)
        p->draw_worth[hit] = n > 0 ? 1 / n : 1;
}

static void learn_all(const struct render_job *job, struct prepared *p, const struct learn_options *options)
{
    *p->tables = NO_TABLES;
    learn(job, options, p->tables);
    find_draw_worth(p);
    if (p->method->prepare != NULL)
        p->method->prepare(job, p);
}

/* The runner that was asked for, the winner of a race, or the first. Is there a race? */
static bool find_runner(const struct render_job *job, struct prepared *p)
{
    const int asked = p->numbers.path_pixels > 0 ? p->parameters.race : RACE_OFF;
    const bool races = asked == RACE_ON && rect_pixels(job->film_rect) >= RACE_LEAST_PIXELS;
    p->winner = asked >= RACE_RUNNERS ? asked - RACE_RUNNERS : RUNNER_ALL;
    race_begin(job->scene, p);
    if (races)
        race(job, p);
    p->numbers = p->runner[p->winner].numbers;
    return races;
}

void method_prepare(const struct render_job *job, struct prepared *p)
{
    p->numbers = p->parameters.numbers;
    if (p->numbers.draws[LATER_HIT] < 0)
        p->numbers.draws[LATER_HIT] = p->numbers.draws[FIRST_HIT];
    p->size = (struct pass_size){0, p->parameters.tile, p->parameters.spread};
    p->tables = mem_alloc(1, sizeof *p->tables);
    const struct learn_options options = what_to_learn(job, p);
    learn_all(job, p, &options);
    const bool learns = options.use || options.pairs || options.guide || options.count || p->method->prepare != NULL;
    const bool races = find_runner(job, p);
    method_settle(job, p);
    p->hasty = (learns || races) && job_cancelled(job) != CANCEL_NOT;
}

void method_release(struct prepared *p)
{
    if (p->tables != NULL && p->method->release != NULL)
        p->method->release(p);
    if (p->tables != NULL)
        tables_free(p->tables);
    free(p->tables);
    scene_uniform_free(p->uniform);
    free(p->own);
}
