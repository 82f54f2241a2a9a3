/* trace.c: see trace.h. */
#include "transport/trace.h"

static uint64_t pixel_number(const struct scene *scene, int x, int y)
{
    return (uint64_t)y * (uint64_t)scene->width + (uint64_t)x;
}

struct gather trace_begin(const struct tile_pass *pass, const struct mis_counts *counts, int x, int y, long iteration)
{
    const struct render_job *job = pass->job;
    struct sampler points = sampler_start(job->seed, RNG_CONNECT, pixel_number(job->scene, x, y), (uint64_t)iteration);
    struct gather g = {job->scene, counts, pass->tile, job->max_depth, x, y, 1, points};
    return g;
}

int trace_eye(const struct tile_pass *pass, struct gather *g, long iteration, struct vertex *path, int max_vertices)
{
    uint64_t pixel = pixel_number(g->scene, g->x, g->y);
    struct sampler sampler = sampler_start(pass->job->seed, RNG_EYE, pixel, (uint64_t)iteration);
    struct walk w = {g->scene, g->counts, &pass->work->arena, &sampler, pass->job->rr_threshold};
    return path_eye_pixel(&w, g->x, g->y, path, max_vertices, &g->filter_weight);
}

struct sampler trace_sampler(const struct tile_pass *pass, enum rng_purpose purpose, int x, int y, long iteration)
{
    uint64_t pixel = pixel_number(pass->job->scene, x, y);
    return sampler_start(pass->job->seed, purpose, pixel, (uint64_t)iteration);
}

int trace_light(const struct tile_pass *pass, const struct mis_counts *counts, int x, int y,
                uint64_t number, struct arena *arena, struct vertex *path)
{
    const struct render_job *job = pass->job;
    uint64_t pixel = pixel_number(job->scene, x, y);
    struct sampler sampler = sampler_start(job->seed, RNG_LIGHT, pixel, number);
    struct walk w = {job->scene, counts, arena, &sampler, job->rr_threshold};
    return path_light(&w, path, job->max_depth + 1);
}

double trace_light_count(const struct render_job *job)
{
    return (double)rect_width(job->film_rect) * rect_height(job->film_rect);
}
