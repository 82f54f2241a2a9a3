/* probe.c: see probe.h. */
#include "learning/probe.h"

#include <stdlib.h>

#include "base/parallel.h"

static void measure(void *context, int64_t k, int slot, int thread)
{
    struct probe *p = context;
    struct pixel_rect film = p->job->film_rect;
    double u, v;
    (void)slot;
    sampler_r2(k, &u, &v);
    p->measure(p, k, film.x0 + (int)(u * rect_width(film)), film.y0 + (int)(v * rect_height(film)), thread);
}

static bool count(void *context, int64_t k, int slot)
{
    (void)k;
    (void)slot;
    return patience_count(&((struct probe *)context)->patience, 1);
}

void probe_run(struct probe *p)
{
    int n_threads = p->job->n_threads;
    struct parallel_jobs jobs = {p->n, n_threads, (int)p->n, p, measure, count, NULL};
    p->work = workspaces_new(n_threads, p->job->max_depth);
    p->tile = mem_alloc((size_t)n_threads, sizeof *p->tile);
    p->patience = patience_begin(p->job);
    p->n = parallel_run(&jobs);
    patience_end(&p->patience);
    for (int i = 0; i < n_threads; i++)
        tile_free(&p->tile[i]);
    free(p->tile);
    workspaces_free(p->work, n_threads);
}

void probe_sample(const struct probe *p, const struct mis_counts *counts, uint64_t seed, int x, int y, long iteration,
                  int thread, const struct observer *joined)
{
    struct render_job job = *p->job;
    struct workspace *work = &p->work[thread];
    struct tile *tile = &p->tile[thread];
    struct tile_pass pass = {.job = &job, .first = iteration, .end = iteration + 1, .tile = tile, .work = work,
                             .observer = joined};
    job.seed = job.eye_seed = hash_combine(hash_combine(job.seed, 0x3c6ef372fe94f82bu), seed);
    tile_start(tile, pixels_all((struct pixel_rect){x, y, x + 1, y + 1}), job.film_rect, &job.scene->filter);
    arena_reset(&work->arena);
    struct pixel_sample sample = pixel_sample_begin(&pass, counts, x, y, iteration);
    int n_eye = pixel_eye_path(&pass, &sample, work->eye, job.max_depth + 2);
    pixel_sum_eye(&sample, work->eye, n_eye);
    if (counts->splat > 0) {
        int n = pixel_light_path(&pass, counts, x, y, (uint64_t)iteration, &work->arena, work->light);
        pixel_sum_pairs(&sample, work->eye, n_eye, work->light, n, NO_CHOICE);
        pixel_splat_path(&sample, work->light, n, 1);
    }
}
