/* services.c: see services.h. */
#include "integrators/services.h"

#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "learning/learn.h"
#include "learning/plan.h"

const char *const OFF_ON[] = {"off", "on", NULL};

/* --- tables ------------------------------------------------------------------------------------------ */

enum {
    MIN_GUIDED_CELLS = 4, /* light cells; with fewer there is nothing for a guide to choose among */
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
    f->counts.tables = &f->tables;
}

/* --- numbers ----------------------------------------------------------------------------------------- */

/* Take the plan's numbers of samples, and count them as `usual` does its own: one light point, and its draws. */
static void set_numbers(const struct render_job *job, struct frozen *f, const struct frozen *usual,
                        const struct plan *p)
{
    struct mis_counts *c = &f->counts;
    f->lights = (int)(p->n[LIGHT_FIRST] + 0.5);
    c->hit[FIRST_HIT] = usual->counts.hit[FIRST_HIT];
    c->direct[FIRST_HIT] = f->lights * usual->counts.direct[FIRST_HIT];
    c->delta[FIRST_HIT] = f->lights * usual->counts.delta[FIRST_HIT];
    if (!(usual->draws[FIRST_HIT] > 0))
        return;
    double paths = p->n[LIGHT_PATH];
    f->path_pixels = f->given.path_pixels > 0 ? f->given.path_pixels : paths > 0 ? (int)(1 / paths + 0.5) : 0;
    c->splat = f->path_pixels > 0 ? pixel_light_count(job) / f->path_pixels : 0;
    for (int end = 0; end < EYE_ENDS; end++) {
        f->draws[end] = f->given.connections > 0 ? f->given.connections
                                                 : p->n[end == FIRST_HIT ? DRAW_FIRST : DRAW_LATER];
        c->connect[end] = f->path_pixels > 0 ? usual->counts.connect[end] * f->draws[end] / usual->draws[end] : 0;
    }
}

/* Can a path tracer find all light? What a delta light sends by way of a delta lobe it cannot. */
static bool paths_suffice(const struct scene *scene)
{
    bool delta_light = false, delta_lobe = false;
    for (int i = 0; i < scene->lights.n; i++)
        delta_light |= light_is_delta(&scene->lights.light[i]);
    for (int i = 0; i < scene->n_materials; i++)
        delta_lobe |= scene->material[i]->row->may_be_delta;
    return !(delta_light && delta_lobe);
}

/* What a probe renders by: the method (a preparation), with other counts. */
static void render_with(const void *method, const struct mis_counts *counts, const struct tile_pass *pass)
{
    struct preparation p = *(const struct preparation *)method;
    struct frozen *f = mem_alloc(1, p.method->state_size);
    memcpy(f, p.state, p.method->state_size);
    f->counts = *counts;
    p.state = f;
    p.method->render(&p, pass);
    free(f);
}

static void tell(struct preparation *out)
{
    const struct frozen *f = out->state;
    bool paths = f->path_pixels > 0;
    const struct film_number numbers[] = {
        {"draws_first_hit", paths ? f->draws[FIRST_HIT] : 0}, {"draws_after", paths ? f->draws[LATER_HIT] : 0},
        {"light_points_first_hit", f->lights}, {"pixels_per_light_path", f->path_pixels},
        {"eye_regions", f->tables.eye.n}, {"light_regions", f->tables.light.n}};
    memcpy(out->number, numbers, sizeof numbers); /* fewer than there is room for: a NULL name stays behind them */
}

/* Is it free to have no light sub-paths? Neither by the user's wish nor for what only they can find. */
static bool free_choice(const struct render_job *job, const struct frozen *f)
{
    return f->given.connections == 0 && f->given.path_pixels == 0 && paths_suffice(job->scene);
}

bool services_paths_matter(const struct render_job *job, struct preparation *out)
{
    const double SAMPLES = 0.2; /* of each pixel, by each of the probe's renders */
    const double LEAST = 0.2;   /* of the variance, what light sub-paths are to save before they are looked into */
    struct frozen *f = out->state;
    struct preparation bdpt;
    struct error none;
    bool goes_on = job->watch == NULL || job->watch(job->watch_context, 1);
    if (!goes_on || !f->services.pilot || !free_choice(job, f) || !method_prepare(&method_bdpt, job, &bdpt, &none))
        return true;
    struct workspace *work = workspaces_new(job->n_threads, job->max_depth);
    const struct probe probe = {job, work, &bdpt, render_with, &((struct frozen *)bdpt.state)->counts, out->size};
    struct noise noise = noise_measure(&probe, NULL, SAMPLES);
    bool matter = !(noise.tail < LEAST * noise.total);
    workspaces_free(work, job->n_threads);
    method_release(&bdpt);
    if (!matter) {
        f->path_pixels = 0;
        f->counts.connect[FIRST_HIT] = f->counts.connect[LATER_HIT] = f->counts.splat = 0;
        out->size.tile = DEFAULT_TILE_SIZE; /* pixels share nothing but what is in the cache */
        out->size.spread = 1;
        tell(out);
    }
    return matter;
}

void services_settle(const struct render_job *job, struct preparation *out)
{
    const double SAMPLES = 0.64; /* of each pixel, by the pilot's renders each */
    struct frozen *f = out->state;
    if (!f->services.pilot && !f->services.credit)
        return;
    struct probe probe = {job, workspaces_new(job->n_threads, job->max_depth), out, render_with, &f->counts, out->size};
    struct frozen usual = *f;
    struct plan plan = {{f->draws[FIRST_HIT], f->draws[LATER_HIT], f->lights, 1.0 / f->path_pixels}};
    if (f->services.credit) {
        struct credit credit = credit_measure(&probe, &f->tables);
        usual.counts.hit[FIRST_HIT] = usual.counts.direct[FIRST_HIT] = credit.broad;
        usual.counts.delta[FIRST_HIT] = credit.delta;
    }
    if (f->services.pilot) {
        struct costs costs = plan_costs(&f->tables.importance);
        for (int i = 0; i < job->n_threads; i++)
            probe.work[i].scratch = method_scratch(out);
        set_numbers(job, f, &usual, &PLAN_TRIED);
        struct noise noise = noise_measure(&probe, PLAN_TRIED.n, SAMPLES);
        for (int i = 0; i < job->n_threads; i++)
            method_scratch_free(out, probe.work[i].scratch);
        plan = plan_numbers(&costs, &noise);
        if (noise.total > 0 && free_choice(job, f) && !plan_paths_pay(&costs, &noise, &plan))
            plan.n[LIGHT_PATH] = 0;
    }
    set_numbers(job, f, &usual, &plan);
    if (f->services.pilot)
        tell(out);
    workspaces_free(probe.work, job->n_threads);
}
