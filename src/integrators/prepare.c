/* prepare.c: see prepare.h. */
#include "integrators/prepare.h"

#include <stdlib.h>
#include <string.h>

#include "integrators/race.h"
#include "learning/learn.h"

enum { MIN_GUIDED_CELLS = 4 }; /* light cells; a guide does not help with fewer */

/* What a runner needs, for light sub-paths or without them. A path tracer of a method that learns much has few: it
 * learns less, from fewer. */
static void learn_for(const struct render_job *job, struct prepared *p, int runner, bool light)
{
    const struct parameters *q = &p->parameters;
    bool few = runner >= RUNNER_PATH_TRACER && p->method->learns_pairs;
    const struct learn_options options = {
        .use = light && (p->method->learns_use || q->emission < 1), .pairs = !few && p->method->learns_pairs,
        .guide = q->guide && job->strategy == LIGHTS_SPATIAL && job->scene->lights.n_cells >= MIN_GUIDED_CELLS,
        .emission = q->emission, .delta = q->delta, .count = light && p->method->vertices, .few = few};
    tables_free(p->tables);
    *p->tables = NO_TABLES;
    bool learns = options.use || options.pairs || options.guide || options.count;
    if (learns)
        learn(job, &options, p->tables);
    for (int end = 0; end < EYE_ENDS; end++) /* of single vertices, a draw is one of so many of a light sub-path */
        p->draw_worth[end] = p->method->vertices && p->tables->light_vertices > 0 ? 1 / p->tables->light_vertices : 1;
    if (p->method->prepare != NULL)
        p->method->prepare(job, p);
    method_counts(job, p);
    p->hasty = (p->hasty || learns || p->method->prepare != NULL) && job_cancelled(job) != CANCEL_NOT;
}

static bool has_light(const struct prepared *p) { return p->runner[p->winner].numbers.path_pixels > 0; }

/* Where there is much to learn, a first race finds out whether it may pay. */
static void learn_and_race(const struct render_job *job, struct prepared *p)
{
    bool small = rect_pixels(job->film_rect) < RACE_LEAST_PIXELS;
    int asked = p->numbers.path_pixels == 0 || (small && p->parameters.race == RACE_ON) ? RACE_OFF : p->parameters.race;
    race_begin(job->scene, p);
    if (asked == RACE_ON && p->method->learns_pairs) {
        learn_for(job, p, RUNNER_PATH_TRACER, true);
        bool early = race_early(job, p);
        p->hasty = job_cancelled(job) != CANCEL_NOT;
        if (early) {
            if (!has_light(p)) /* light sub-paths of a rival have had their tables */
                learn_for(job, p, p->winner, false);
            return;
        }
    }
    p->winner = asked >= RACE_RUNNERS ? asked - RACE_RUNNERS : RUNNER_ALL;
    learn_for(job, p, p->winner, p->winner < RUNNER_PATH_TRACER || has_light(p));
    race_begin(job->scene, p); /* `prepare` may have changed the numbers */
    if (asked == RACE_ON) {
        race(job, p);
        p->hasty = job_cancelled(job) != CANCEL_NOT;
    }
}

void method_prepare(const struct render_job *job, struct prepared *p)
{
    p->numbers = p->parameters.numbers;
    if (p->numbers.draws[LATER_HIT] < 0)
        p->numbers.draws[LATER_HIT] = p->numbers.draws[FIRST_HIT];
    p->size = (struct pass_size){0, p->parameters.tile, p->parameters.spread};
    p->tables = mem_alloc(1, sizeof *p->tables);
    learn_and_race(job, p);
    p->numbers = p->runner[p->winner].numbers;
    p->size = method_size(p);
    method_counts(job, p);
}

void method_numbers(const struct prepared *p, struct method_number out[METHOD_NUMBERS])
{
    const struct numbers *n = &p->numbers;
    const struct runner *winner = &p->runner[p->winner];
    int draws = n->path_pixels > 0;
    const struct method_number numbers[] = {
        {"draws_first_hit", draws * n->draws[FIRST_HIT]}, {"draws_after", draws * n->draws[LATER_HIT]},
        {"light_points_first_hit", n->light_points}, {"pixels_per_light_path", n->path_pixels},
        {"iterations_per_light_path", numbers_every(n)}, {"regions", p->tables->regions.n}};
    int used = (int)(sizeof numbers / sizeof *numbers);
    memset(out, 0, METHOD_NUMBERS * sizeof *out); /* a NULL name ends the list */
    memcpy(out, numbers, sizeof numbers);
    for (int i = 0; i < RUNNERS; i++)
        if (p->runner[i].price > 0 && winner->price > 0) /* unless the race was cancelled */
            out[used++] = (struct method_number){RUNNER_NUMBERS[i], p->runner[i].variance * p->runner[i].price /
                                                                        (winner->variance * winner->price)};
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
