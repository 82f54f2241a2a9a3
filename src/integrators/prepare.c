/* prepare.c: see prepare.h. */
#include "integrators/prepare.h"

#include <stdlib.h>
#include <string.h>

#include "integrators/race.h"
#include "learning/learn.h"

static const double BOUND = 0.25; /* M of counts.h for each light sub-path of a full tile */
enum { MIN_GUIDED_CELLS = 4 }; /* light cells; a guide does not help with fewer */

void method_counts(const struct render_job *job, struct prepared *p, bool credits)
{
    const struct parameters *q = &p->parameters;
    double M = BOUND * p->size.tile * p->size.tile / most_of(p->numbers.path_pixels, 1);
    p->counts = counts_of(p->numbers, credits && q->credits ? DIRECT_CREDIT : 1, q->credits ? PAIR_CREDIT : 1,
                          (double)rect_pixels(job->film_rect), p->tables);
    for (int end = 0; end < EYE_ENDS; end++) {
        p->counts.pair[end] *= p->draw[end];
        p->counts.bound[end] = q->bound ? p->counts.pair[end] / M : 0;
    }
}

/* A path tracer needs no table but that of direct light, and a plain one not even this. */
static void become_path_tracer(struct prepared *p, bool plain)
{
    struct tables kept = NO_TABLES, *t = p->tables;
    if (!plain && t->direct.rows > 0) {
        kept.regions = t->regions;
        kept.direct = t->direct;
        t->regions = NO_TABLES.regions;
        t->direct = NO_TABLES.direct;
    }
    tables_free(t);
    *t = kept;
    p->size.tile = DEFAULT_TILE_SIZE; /* pixels share no sub-paths */
    p->size.spread = 1;
    p->numbers.draws[FIRST_HIT] = p->numbers.draws[LATER_HIT] = 0;
}

static void learn_tables(const struct render_job *job, struct prepared *p)
{
    const struct parameters *q = &p->parameters;
    const struct learn_options options = {
        .use = p->method->learns_use || q->emission < 1, .pairs = p->method->learns_pairs,
        .direct = q->guide && job->strategy == LIGHTS_SPATIAL && job->scene->lights.n_cells >= MIN_GUIDED_CELLS,
        .emission = q->emission, .delta = q->delta, .count = p->method->vertices};
    if (options.use || options.pairs || options.direct || options.count)
        learn(job, &options, p->tables);
}

void method_prepare(const struct render_job *job, struct prepared *p)
{
    const struct method *m = p->method;
    bool plain = false;
    p->numbers = p->parameters.numbers;
    p->size = (struct pass_size){0, p->parameters.tile, p->parameters.spread};
    p->tables = mem_alloc(1, sizeof *p->tables);
    learn_tables(job, p);
    if (p->numbers.draws[LATER_HIT] < 0)
        p->numbers.draws[LATER_HIT] = p->numbers.draws[FIRST_HIT];
    for (int end = 0; end < EYE_ENDS; end++) /* of single vertices, a draw is one of so many of a light sub-path */
        p->draw[end] = m->vertices && p->tables->light_vertices > 0 ? 1 / p->tables->light_vertices : 1;
    if (m->prepare != NULL)
        m->prepare(job, p);
    method_counts(job, p, true);
    if (p->parameters.race && p->numbers.path_pixels > 0) {
        race(job, p);
        p->numbers = p->runner[p->winner].numbers;
        plain = p->runner[p->winner].plain;
    }
    if (m->selector != NULL && p->numbers.path_pixels == 0)
        become_path_tracer(p, plain);
    method_counts(job, p, !plain);
}

void method_numbers(const struct prepared *p, struct method_number out[METHOD_NUMBERS])
{
    const struct runner *winner = &p->runner[p->winner];
    const struct method_number numbers[] = {
        {"draws_first_hit", p->numbers.draws[FIRST_HIT]}, {"draws_after", p->numbers.draws[LATER_HIT]},
        {"light_points_first_hit", p->numbers.light_points}, {"pixels_per_light_path", p->numbers.path_pixels},
        {"regions", p->tables->regions.n}};
    enum { N = sizeof numbers / sizeof *numbers };
    memset(out, 0, METHOD_NUMBERS * sizeof *out); /* a NULL name ends the list */
    memcpy(out, numbers, sizeof numbers);
    for (int i = 0; i < p->n_runners && winner->price > 0; i++)
        out[N + i] = (struct method_number){p->runner[i].name, p->runner[i].variance * p->runner[i].price /
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
