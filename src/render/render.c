/* render.c: see render.h. */
#include "render/render.h"

#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "base/os.h"
#include "base/parallel.h"
#include "render/halves.h"
#include "render/parameters.h"

/* Fractions lie within [0,1]: readers of scenes and options see to it. */
struct pixel_rect render_crop(const struct scene *scene)
{
    const double *c = scene->crop;
    struct pixel_rect r = {(int)ceil(scene->width * c[0]), (int)ceil(scene->height * c[2]),
                           (int)ceil(scene->width * c[1]), (int)ceil(scene->height * c[3]), 0, 0};
    return r;
}

/* --- tile passes ------------------------------------------------------------------------------------- */

struct run {
    const struct render_options *options;
    struct render_job job;
    struct film *film;
    int tiles_x, tiles_y;
    struct preparation prepared; /* blocks begin at multiples of their length, maybe INT_MAX: counted in 64 bits */
    int64_t begun;  /* tile passes of the first block that the film holds already */
    int64_t n_jobs; /* all tile passes, with these */
    bool stopping;  /* progress, or the noise, said so: stop when the block is complete */
    bool at_once;   /* or before */
    double learning; /* share of all work that learning has been */
    struct workspace *work; /* [n_threads] */
    struct tile *tile;      /* [n_slots] */
    struct worst *worst;    /* [n_threads], or NULL */
    struct parallel_jobs jobs;
};

struct run_job {
    struct run *run;
    int64_t job;
};

/* Samples of a block that may have any length: few enough for a render to be stopped soon. A power of two divides the
 * runs of halves. */
enum { BLOCK_SAMPLES = 1 << 17 };

static int choose_block(struct pixel_rect film)
{
    int block = LONGEST_BLOCK;
    while (block > 1 && rect_pixels(film) > (size_t)(BLOCK_SAMPLES / block))
        block /= 2;
    return block;
}

static void count_tiles(struct run *r)
{
    int tile = r->prepared.size.tile;
    r->tiles_x = (rect_width(r->job.film_rect) + tile - 1) / tile;
    r->tiles_y = (rect_height(r->job.film_rect) + tile - 1) / tile;
}

static int64_t tiles_per_block(const struct run *r) { return (int64_t)r->tiles_x * r->tiles_y; }

/* The iterations of block number b of this run. */
static void block_range(const struct run *r, int64_t b, long *first, long *end)
{
    int64_t begin = ((int64_t)r->options->first / r->prepared.size.block + b) * r->prepared.size.block;
    *first = begin > r->options->first ? (long)begin : r->options->first;
    *end = begin + r->prepared.size.block < r->options->end ? (long)(begin + r->prepared.size.block) : r->options->end;
}

/* On one axis, of `n` tiles: number `tile` takes every so manieth pixel of [*begin, *end), together with its group.
 * Groups are of up to `spread` tiles, and as like in size as can be. */
static void interleave(const struct pass_size *size, int n, int tile, int *begin, int *end, int *skip)
{
    int groups = (n + size->spread - 1) / size->spread, group = (int)((int64_t)tile * groups / n);
    int first = (int)(((int64_t)group * n + groups - 1) / groups);
    int next = (int)((((int64_t)group + 1) * n + groups - 1) / groups);
    if (next < n)
        *end = *begin + next * size->tile;
    *begin += first * size->tile + tile - first;
    *skip = next - first - 1;
}

static struct pixel_rect tile_rect(const struct run *r, int64_t tile)
{
    struct pixel_rect rect = r->job.film_rect;
    interleave(&r->prepared.size, r->tiles_x, (int)(tile % r->tiles_x), &rect.x0, &rect.x1, &rect.skip_x);
    interleave(&r->prepared.size, r->tiles_y, (int)(tile / r->tiles_x), &rect.y0, &rect.y1, &rect.skip_y);
    return rect;
}

/* Whenever the halves are of one size. */
static bool good_enough(const struct run *r)
{
    const double *limit = r->options->noise;
    struct film *f = r->film;
    bool good = halves_noise(f, r->job.scene->film_scale);
    for (int i = 0; i < N_NOISE_SCALES; i++)
        good = good && (limit[i] == 0 || f->noise[i].value < limit[i]);
    return good && limit[NOISE_RELATIVE] + limit[NOISE_8_BIT] > 0;
}

static void ask_progress(struct run *r, double share)
{
    const struct render_options *o = r->options;
    enum render_wish wish = o->progress != NULL ? o->progress(o->progress_context, share) : RENDER_GO_ON;
    r->at_once = r->at_once || wish == RENDER_STOP;
    r->stopping = r->stopping || wish != RENDER_GO_ON;
}

/* More splats than a tile holds go into the film before their pass is complete, when it is the next to do so. */
static void take_splats(void *context, struct tile *tile)
{
    const struct run_job *j = context;
    if (parallel_await(&j->run->jobs, j->job))
        film_take_splats(j->run->film, tile);
    tile->n_splats = tile->n_records = 0;
}

static void run_pass(void *context, int64_t job, int slot, int thread)
{
    struct run *r = context;
    struct run_job this = {r, job};
    struct tile_pass pass = {.job = &r->job, .tile = &r->tile[slot], .work = &r->work[thread],
                             .worst = r->worst != NULL ? &r->worst[thread] : NULL};
    pass.rect = tile_rect(r, (r->begun + job) % tiles_per_block(r));
    block_range(r, (r->begun + job) / tiles_per_block(r), &pass.first, &pass.end);
    tile_start(pass.tile, pass.rect, r->job.film_rect, &r->job.scene->filter, film_keeps_records(r->film));
    if (r->options->gate.end > 0)
        pass.tile->gate = r->options->gate;
    if (r->film->half != NULL)
        pass.tile->first_half = pass.first / r->film->run % 2 == 0;
    pass.tile->full = take_splats;
    pass.tile->context = &this;
    r->prepared.method->render(&r->prepared, &pass);
}

static bool merge_pass(void *context, int64_t job, int slot)
{
    struct run *r = context;
    int64_t done = r->begun + job + 1;
    long first, end;
    block_range(r, (done - 1) / tiles_per_block(r), &first, &end);
    r->film->block.iterations = end - first;
    film_merge_tile(r->film, &r->tile[slot]);
    r->film->passes++;
    if (r->film->passes == tiles_per_block(r)) {
        film_end_block(r->film);
        r->stopping = r->stopping || good_enough(r);
    }
    ask_progress(r, r->learning + (1 - r->learning) * (double)done / (double)r->n_jobs);
    return !(r->stopping && (r->film->passes == 0 || r->at_once));
}

static void make_workspaces(struct run *r)
{
    r->work = workspaces_new(r->job.n_threads, r->job.max_depth);
    for (int i = 0; i < r->job.n_threads; i++)
        r->work[i].scratch = method_scratch(&r->prepared);
}

static void free_workspaces(struct run *r)
{
    for (int i = 0; i < r->job.n_threads; i++)
        method_scratch_free(&r->prepared, r->work[i].scratch);
    workspaces_free(r->work, r->job.n_threads);
}

/* Every thread has a list of its own. */
static void begin_worst(struct run *r)
{
    r->worst = r->options->worst != NULL ? mem_alloc((size_t)r->job.n_threads, sizeof *r->worst) : NULL;
    for (int i = 0; r->worst != NULL && i < r->job.n_threads; i++)
        r->worst[i].most = r->options->worst->most;
}

static void end_worst(struct run *r)
{
    for (int i = 0; r->worst != NULL && i < r->job.n_threads; i++)
        for (int k = 0; k < r->worst[i].n; k++)
            worst_offer(r->options->worst, r->worst[i].item[k]);
    free(r->worst);
}

static void run_all(struct run *r)
{
    const struct render_options *o = r->options;
    int64_t first_block = o->first / r->prepared.size.block,
            end_block = ((int64_t)o->end + r->prepared.size.block - 1) / r->prepared.size.block;
    r->n_jobs = tiles_per_block(r) * (end_block - first_block);

    int slots = film_keeps_records(r->film) ? 2 : SLOTS_PER_THREAD; /* records of strategies are large */
    int n_slots = slots * r->job.n_threads;
    struct parallel_jobs jobs = {r->n_jobs - r->begun, r->job.n_threads, n_slots, r, run_pass, merge_pass, NULL};
    r->jobs = jobs;
    r->tile = mem_alloc((size_t)n_slots, sizeof *r->tile);
    for (int i = 0; i < n_slots; i++)
        r->tile[i].planes = r->film->planes;
    make_workspaces(r);
    begin_worst(r);
    parallel_run(&r->jobs);
    end_worst(r);
    free_workspaces(r);
    for (int i = 0; i < n_slots; i++)
        tile_free(&r->tile[i]);
    free(r->tile);
}

static const struct method *begin_job(const struct scene *scene, const struct render_options *options,
                                      struct pixel_rect rect, struct render_job *job, struct error *err)
{
    const struct method *m = method_find(options->integrator, &scene->settings, err);
    memset(job, 0, sizeof *job);
    job->scene = scene;
    job->film_rect = rect;
    job->seed = job->eye_seed = options->seed;
    job->n_threads = options->n_threads < 1 ? os_cores() : options->n_threads;
    return m != NULL && parameters_read(scene, m, options->max_depth, job, err) ? m : NULL;
}

bool render_prepare(const struct scene *scene, const struct render_options *options, struct pixel_rect rect,
                    struct render_job *job, struct preparation *out, struct error *err)
{
    const struct method *m = begin_job(scene, options, rect, job, err);
    return m != NULL && method_prepare(m, job, out, err);
}

/* Can it be said of its samples which pixel they belong to? */
static bool has_samples(const struct method *m, struct error *err)
{
    return !m->chain ||
           error_set(err, "%s goes from sample to sample over the whole picture: no pixel has one to tell of", m->name);
}

/* Learning counts as work, a sub-path as a sample. */
static bool watch(void *context, double traced)
{
    struct run *r = context;
    const struct render_options *o = r->options;
    double samples = pixel_light_count(&r->job) * (double)(o->end - o->first);
    r->learning = fmax(r->learning, traced / (traced + samples)); /* each pass counts its own; a bar never goes back */
    ask_progress(r, r->learning);
    return !r->stopping;
}

static bool begun(const struct film *film) { return film->iterations > 0 || film->passes > 0; }

static bool prepare(struct run *r, struct error *err)
{
    const struct method *m = begin_job(r->job.scene, r->options, r->film->rect, &r->job, err);
    if (m == NULL || (r->options->worst != NULL && !has_samples(m, err)))
        return false;
    if (m->merges && r->film->planes.lights > 0)
        return error_set(err, "%s adds what comes of many lights at once: render one of them at a time", m->name);
    if ((m->chain || m->merges) && r->film->gates != NULL)
        return error_set(err, "%s keeps no record of its paths: render one gate at a time", m->name);
    r->job.watch = r->options->progress != NULL ? watch : NULL;
    r->job.watch_context = r;
    bool ok = method_prepare(m, &r->job, &r->prepared, err);
    r->film->learnt_short = r->stopping && !begun(r->film);
    return ok;
}

/* Blocks of a length that the method has chosen must not be cut: what it draws depends on where one begins. */
static bool check_range(const struct run *r, struct error *err)
{
    const struct render_options *o = r->options;
    int block = r->prepared.size.block;
    if (r->film->iterations > 0 && block > 0 && o->first % block != 0)
        return error_set(err,
                         "the film ends at sample %ld: here they come in blocks of %d, so it cannot be gone on with",
                         o->first, block);
    if (o->is_part && block > 0 && (o->first % block != 0 || (o->end % block != 0 && o->end != o->planned)))
        return error_set(err, "samples %ld:%ld: here they come in blocks of %d; begin and end with one", o->first,
                         o->end, block);
    return true;
}

/* Tiles, and blocks where their length is free. */
static bool cut(struct run *r, struct error *err)
{
    struct pass_size *size = &r->prepared.size;
    if (size->block == 0)
        size->block = r->options->block > 0 ? r->options->block : choose_block(r->job.film_rect);
    count_tiles(r);
    r->film->run = halves_run(size->block);
    r->begun = r->film->passes;
    for (int64_t i = 0; i < r->begun && i < tiles_per_block(r); i++)
        film_mark(r->film, tile_rect(r, i));
    return r->begun < tiles_per_block(r) ||
           error_set(err, "the film has more tile passes in it than a block of samples has");
}

bool render_scene(const struct scene *scene, const struct render_options *options, struct film *film,
                  struct error *err)
{
    struct run r = {.options = options, .film = film, .job = {.scene = scene}};
    if (!prepare(&r, err))
        return false;
    memcpy(film->note, r.prepared.note, sizeof film->note);
    memcpy(film->number, r.prepared.number, sizeof film->number);
    bool ok = check_range(&r, err) && cut(&r, err);
    bool in_haste = r.stopping && begun(film); /* samples by what was learnt so are none of the film's */
    if (ok && options->end > options->first && !in_haste && !good_enough(&r)) /* what is resumed may be */
        run_all(&r);
    method_release(&r.prepared);
    return ok;
}

/* --- one sample -------------------------------------------------------------------------------------- */

static bool check_sample(const struct render_options *o, struct pixel_rect film, const struct trace *t,
                         struct error *err)
{
    if (t->x < film.x0 || t->x >= film.x1 || t->y < film.y0 || t->y >= film.y1)
        return error_usage(err, "--pixel %d,%d is not rendered: x is %d to %d here, y is %d to %d", t->x, t->y, film.x0,
                         film.x1 - 1, film.y0, film.y1 - 1);
    return (t->iteration >= 0 && t->iteration < o->end) ||
           error_usage(err, "--sample %ld is not taken: they are numbered 0 to %ld, see --spp", t->iteration,
                     o->end - 1);
}

/* The tile pass that holds the sample, from where what it depends on begins: in blocks of a length that the integrator
 * has chosen one iteration builds on another. */
static void trace_pass(struct run *r, struct trace *trace)
{
    struct pass_size size = r->prepared.size;
    struct pixel_rect film = r->job.film_rect;
    struct tile tile = {.rect = {0, 0, 0, 0, 0, 0}};
    long block = size.block > 0 ? size.block : 1;
    count_tiles(r);
    make_workspaces(r);
    struct tile_pass pass = {.job = &r->job, .tile = &tile, .work = r->work, .trace = trace};
    int64_t number = 0;
    do
        pass.rect = tile_rect(r, number++);
    while (!rect_has(pass.rect, trace->x, trace->y));
    pass.first = trace->iteration / block * block;
    pass.end = trace->iteration + 1;
    tile_start(&tile, pass.rect, film, &r->job.scene->filter, false);
    r->prepared.method->render(&r->prepared, &pass);
    tile_free(&tile);
    free_workspaces(r);
}

bool render_trace(const struct scene *scene, const struct render_options *options, struct trace *trace,
                  struct error *err)
{
    struct run r = {.options = options};
    struct pixel_rect film = render_crop(scene);
    const struct method *m = method_find(options->integrator, &scene->settings, err);
    if (m == NULL || !has_samples(m, err) || !check_sample(options, film, trace, err) ||
        !render_prepare(scene, options, film, &r.job, &r.prepared, err))
        return false;
    trace->why = r.prepared.method->why;
    memcpy(trace->note, r.prepared.note, sizeof trace->note);
    trace_pass(&r, trace);
    method_release(&r.prepared);
    return true;
}
