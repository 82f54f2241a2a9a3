/* method.c: see method.h. */
#include "integrators/method.h"

#include <stdlib.h>
#include <string.h>

static const double BOUND = 0.25; /* M of counts.h for each light sub-path of a full tile */

const char *const OFF_ON[] = {"off", "on", NULL};
const char *const RACES[] = {"off", "on", "all", "quarter", "path_tracer", "one_point", NULL};

const struct field *method_has(const struct method *m, const char *name)
{
    static const struct field select = {"select", FIELD_WORD, 0, 0, 0, 0, "", NULL};
    const struct field *f = m->parameters != NULL ? field_find(m->parameters, name) : NULL;
    if (f == NULL && m->own != NULL)
        f = field_find(m->own, name);
    return m->select != NULL && strcmp(name, select.name) == 0 ? &select : f;
}

bool method_read(const struct method *m, const struct scene *scene, struct prepared *p, struct error *err)
{
    const struct settings *s = &scene->settings;
    *p = (struct prepared){.method = m, .parameters = {.numbers = m->numbers, .emission = 1, .delta = 1, .spread = 1,
                                                       .tile = DEFAULT_TILE_SIZE}};
    p->own = m->own_size > 0 ? mem_alloc(1, m->own_size) : NULL;
    bool ok = (m->parameters == NULL || settings_fields(s, m->parameters, &p->parameters, err)) &&
              (m->own == NULL || settings_fields(s, m->own, p->own, err)) &&
              (m->check == NULL || m->check(p, scene, err));
    int *draws = p->parameters.numbers.draws;
    if (draws[LATER_HIT] < 0)
        draws[LATER_HIT] = draws[FIRST_HIT];
    if (!ok)
        free(p->own);
    return ok;
}

void method_settle(const struct render_job *job, struct prepared *p)
{
    const struct parameters *q = &p->parameters;
    int every = numbers_every(&p->numbers);
    double draw[EYE_HITS];
    if (p->method->build != NULL && (p->numbers.path_pixels == 0 || every > 1))
        p->size = (struct pass_size){p->size.block, DEFAULT_TILE_SIZE, 1};
    for (int hit = 0; hit < EYE_HITS; hit++)
        draw[hit] = (q->credits ? PAIR_CREDIT : 1) * p->draw_worth[hit];
    double M = q->bound ? BOUND * p->size.tile * p->size.tile / most_of(p->numbers.path_pixels, 1) : 0;
    p->counts = counts_of(p->numbers, q->credits ? DIRECT_CREDIT * every : 1, draw, M,
                          (double)rect_pixels(job->film_rect), p->tables);
}
