/* bdpt.c: see bdpt.h. One iteration of one pixel: an eye sub-path, a light sub-path, all their connections.
 * [V97 10] */
#include "integrators/bdpt.h"

#include <stdlib.h>

#include "transport/pixel_sample.h"

/* One iteration of one pixel. Light tracing needs of the eye sub-path only the lights seen directly (s = 0, t = 2). */
static void render_pixel(const struct tile_pass *pass, const struct mis_counts *counts, int x, int y, long iteration)
{
    struct workspace *work = pass->work;
    arena_reset(&work->arena);
    struct pixel_sample g = pixel_sample_begin(pass, counts, x, y, iteration);
    bool light_tracing = counts->hit == 0 && counts->direct[0] == 0 && counts->connect[0] == 0;
    int n_eye = pixel_eye_path(pass, &g, iteration, work->eye, light_tracing ? 2 : g.max_depth + 2);
    int n_light = 0;
    if (counts->connect[0] > 0 || counts->splat > 0)
        n_light = pixel_light_path(pass, counts, x, y, (uint64_t)iteration, &work->arena, work->light);

    pixel_sum_eye(&g, work->eye, n_eye);
    if (counts->connect[0] > 0)
        pixel_sum_pairs(&g, work->eye, n_eye, work->light, n_light, 1);
    if (counts->splat > 0)
        pixel_splat_path(&g, work->light, n_light, 1);
    tile_add_eye(pass->tile, x, y, g.sum);
}

static void render(const void *state, const struct tile_pass *pass)
{
    const struct mis_counts *counts = state;
    for (long i = pass->first; i < pass->end; i++)
        for (int y = pass->rect.y0; y < pass->rect.y1; y++)
            for (int x = pass->rect.x0; x < pass->rect.x1; x++)
                render_pixel(pass, counts, x, y, i);
}

static const struct tile_renderer RENDERER = {render, NULL, NULL};
static const struct setting_help NO_PARAMETERS[] = {{NULL, NULL, NULL, NULL}};

static bool prepare(const struct render_job *job, struct mis_counts counts, struct preparation *out)
{
    struct mis_counts *state = mem_alloc(1, sizeof *state);
    counts.power = job->power_heuristic;
    *state = counts;
    out->state = state;
    out->renderer = &RENDERER;
    return true;
}

static bool prepare_pt(const struct render_job *job, struct preparation *out, struct error *err)
{
    (void)err;
    struct mis_counts counts = {.hit = 1, .direct = {1, 1}};
    return prepare(job, counts, out);
}

static bool prepare_lt(const struct render_job *job, struct preparation *out, struct error *err)
{
    (void)err;
    struct mis_counts counts = {.splat = pixel_light_count(job)};
    return prepare(job, counts, out);
}

static bool prepare_bdpt(const struct render_job *job, struct preparation *out, struct error *err)
{
    (void)err;
    struct mis_counts counts = {.hit = 1, .direct = {1, 1}, .connect = {1, 1}, .splat = pixel_light_count(job)};
    return prepare(job, counts, out);
}

const struct integrator integrator_pt = {"pt", "path tracing: light found by chance (s = 0) or sampled (s = 1)",
                                         NO_PARAMETERS, prepare_pt, free, NULL, NULL};

const struct integrator integrator_lt = {
    "lt", "light tracing: light sub-paths connected to the lens (t = 1); cannot see mirrors",
    NO_PARAMETERS, prepare_lt, free, NULL, NULL};

const struct integrator integrator_bdpt = {"bdpt", "bidirectional path tracing [Veach 1997]: all strategies",
                                           NO_PARAMETERS, prepare_bdpt, free, NULL, NULL};
