/* prepare.c: see prepare.h. */
#include "integrators/prepare.h"

#include <stdlib.h>

#include "integrators/race.h"
#include "learning/learn.h"

enum { MIN_GUIDED_CELLS = 4 };  /* light cells; a guide does not help with fewer */
static const double CALM = 0.5; /* variance of a sample, relative to the brightness squared */

/* What to learn for p->winner. A path tracer of a method that learns much needs little, and has it from few sub-paths.
 *   light_paths  for light sub-paths, too */
static struct learn_options what_to_learn(const struct render_job *job, const struct prepared *p, bool light_paths)
{
    const struct method *m = p->method;
    const struct parameters *q = &p->parameters;
    bool few = p->winner >= RUNNER_PATH_TRACER && m->learns_pairs;
    return (struct learn_options){
        .use = light_paths && (m->learns_use || q->emission < 1), .pairs = light_paths && !few && m->learns_pairs,
        .guide = q->guide && job->strategy == LIGHTS_SPATIAL && job->scene->lights.n_cells >= MIN_GUIDED_CELLS,
        .emission = q->emission, .delta = q->delta, .count = light_paths && m->vertices, .few = few};
}

/* Of single vertices, a draw is one of so many of a light sub-path. */
static void find_draw_worth(struct prepared *p)
{
    double n = p->method->vertices ? p->tables->light_vertices : 0;
    for (int hit = 0; hit < EYE_HITS; hit++)
        p->draw_worth[hit] = n > 0 ? 1 / n : 1;
}

/* Learn tables for p->winner, and make of them what samples need. Was there anything to do? */
static bool learn_for_winner(const struct render_job *job, struct prepared *p, bool light_paths)
{
    const struct learn_options o = what_to_learn(job, p, light_paths);
    tables_free(p->tables);
    *p->tables = NO_TABLES;
    learn(job, &o, p->tables);
    find_draw_worth(p);
    if (p->method->prepare != NULL)
        p->method->prepare(job, p);
    race_begin(job->scene, p); /* of the numbers, which `prepare` may have changed */
    return o.use || o.pairs || o.guide || o.count || p->method->prepare != NULL;
}

static bool has_light_paths(const struct prepared *p) { return p->runner[p->winner].numbers.path_pixels > 0; }

/* The race while little is known: may a path tracer render, with nothing more learnt? */
static bool is_calm(const struct render_job *job, struct prepared *p)
{
    p->winner = RUNNER_PATH_TRACER;
    learn_for_winner(job, p, true);
    race(job, p);
    if (p->winner < RUNNER_PATH_TRACER || p->runner[p->winner].variance >= CALM)
        return false;
    if (!has_light_paths(p)) /* those of its rivals have had their tables */
        learn_for_winner(job, p, false);
    return true;
}

/* Learn, and find the runner: the one that was asked for, or the winner of a race. Was there anything to do? */
static bool learn_and_race(const struct render_job *job, struct prepared *p)
{
    const int asked = p->numbers.path_pixels > 0 ? p->parameters.race : RACE_OFF;
    const bool races = asked == RACE_ON && rect_pixels(job->film_rect) >= RACE_LEAST_PIXELS;
    race_begin(job->scene, p);
    if (races && p->method->learns_pairs && (is_calm(job, p) || job_cancelled(job) != CANCEL_NOT))
        return true; /* if cancelled, what has been learnt so far remains */
    p->winner = asked >= RACE_RUNNERS ? asked - RACE_RUNNERS : RUNNER_ALL;
    bool learns = learn_for_winner(job, p, has_light_paths(p));
    if (races)
        race(job, p);
    return learns || races;
}

void method_prepare(const struct render_job *job, struct prepared *p)
{
    p->numbers = p->parameters.numbers;
    p->size = (struct pass_size){0, p->parameters.tile, p->parameters.spread};
    p->tables = mem_alloc(1, sizeof *p->tables);
    p->hasty = learn_and_race(job, p) && job_cancelled(job) != CANCEL_NOT;
    p->numbers = p->runner[p->winner].numbers;
    method_settle(job, p);
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
