/* services.c: see services.h. */
#include "integrators/services.h"

#include <string.h>

#include "learning/learn.h"
#include "learning/probe.h"

const char *const OFF_ON[] = {"off", "on", NULL};

/* --- tables ------------------------------------------------------------------------------------------ */

enum {
    MIN_GUIDED_CELLS = 4, /* light cells; a guide does not help with fewer */
    EYE_CELLS = 8         /* eye regions along the diagonal */
};

void services_learn(const struct render_job *job, struct preparation *out, struct learn_options own)
{
    struct frozen *f = out->state;
    own.guide = f->services.guide && job->spatial_lights && job->scene->lights.n_cells >= MIN_GUIDED_CELLS;
    own.emission = f->services.emission;
    own.importance |= own.emission < 1;
    own.eye_cells = EYE_CELLS;
    if (own.importance || own.guide || own.pairs)
        f->tables = learn(job, &own);
}

/* --- numbers ----------------------------------------------------------------------------------------- */

/* Does a path tracer find all light? It misses light from a delta light that reaches a surface through a delta lobe. */
static bool path_tracer_sees_all(const struct scene *scene)
{
    bool delta_light = false, delta_lobe = false;
    for (int i = 0; i < scene->lights.n; i++)
        delta_light |= light_is_delta(&scene->lights.light[i]);
    for (int i = 0; i < scene->n_materials; i++)
        delta_lobe |= scene->material[i]->row->may_be_delta;
    return !(delta_light && delta_lobe);
}

/* Numbers for --stats. */
static void tell(struct preparation *out)
{
    const struct frozen *f = out->state;
    const struct film_number numbers[] = {
        {"draws_first_hit", f->numbers.draws[FIRST_HIT]}, {"draws_after", f->numbers.draws[LATER_HIT]},
        {"light_points_first_hit", f->numbers.light_points}, {"pixels_per_light_path", f->numbers.path_pixels},
        {"eye_regions", f->tables.eye.n}, {"light_regions", f->tables.light.n}};
    memcpy(out->number, numbers, sizeof numbers); /* there is room for more: a NULL name ends the list */
}

bool services_trace_paths(const struct render_job *job, struct preparation *out)
{
    struct frozen *f = out->state;
    if (light_paths_useful(job))
        return false;
    if (!path_tracer_sees_all(job->scene)) {
        f->numbers = (struct numbers){.path_pixels = 8, .draws = {1, 1}, .light_points = 1, .path_tracing = true};
        return false;
    }
    f->numbers = (struct numbers){.light_points = 1, .path_tracing = true};
    frozen_count(job, f, NO_CREDITS);
    out->size.tile = DEFAULT_TILE_SIZE; /* pixels share no sub-paths */
    out->size.spread = 1;
    tell(out);
    return true;
}

void services_settle(const struct render_job *job, struct preparation *out, double draw)
{
    struct frozen *f = out->state;
    double direct = f->services.credit > 0 ? f->services.credit : 1; /* 0: the method has no such parameter */
    const struct credits credits = {direct, draw};
    frozen_count(job, f, credits);
    tell(out);
}
