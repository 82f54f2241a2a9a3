/* render.c: see render.h. */
#include "render/render.h"

#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "base/os.h"
#include "base/parallel.h"
#include "integrators/prepare.h"
#include "render/halves.h"
#include "render/parameters.h"

/* Fractions lie within [0,1]: readers of scenes and options see to it. */
struct pixel_rect render_crop(const struct scene *scene)
{
    const double *c = scene->crop;
    return (struct pixel_rect){(int)ceil(scene->width * c[0]), (int)ceil(scene->height * c[2]),
                               (int)ceil(scene->width * c[1]), (int)ceil(scene->height * c[3])};
}

/* --- tile passes ------------------------------------------------------------------------------------- */

struct run {
    const struct render_options *options;
    struct render_job job;
    struct film *film;
    struct tiling tiling;
    struct prepared prepared; /* blocks begin at multiples of their length, maybe INT_MAX: counted in 64 bits */
    int64_t begun;    /* tile passes of the first block that the film holds already */
    int64_t n_passes; /* of all blocks, with these */
    enum render_wish wish; /* the most urgent so far, of progress and of the noise */
    struct workspace *work; /* [n_threads] */
    struct tile *tile;      /* [n_slots] */
    struct under_way *pass; /* [n_slots] */
    struct parallel_jobs parallel; /* the passes that the film does not hold yet, in their order */
};

/* A pass under way: by its number among those of `parallel`. */
struct under_way {
    struct run *run;
    int64_t number;
    bool taken; /* some of its splats are in the film already: it must be rendered to its end */
};

/* Samples of a block that may have any length: few enough for a render to be stopped soon, and for the splats of a pass
 * to wait for its end. A power of two divides the runs of halves, and cuts no cycle of the filter. */
enum { BLOCK_SAMPLES = 1 << 17 };

static int choose_block(const struct render_job *job, int tile)
{
    int block = LONGEST_BLOCK, least = filter_cycle(&job->scene->filter);
    while (block > least && (rect_pixels(job->film_rect) > (size_t)(BLOCK_SAMPLES / block) ||
                             tile * tile * block > TILE_FULL / (job->max_depth + 1)))
        block /= 2;
    return block;
}

static int64_t tiles_per_block(const struct run *r) { return tiling_count(&r->tiling); }

/* The iterations of block number b of this run. */
static void block_range(const struct run *r, int64_t b, long *first, long *end)
{
    const struct render_options *o = r->options;
    int64_t block = r->prepared.size.block, begin = (o->first / block + b) * block;
    *first = begin > o->first ? (long)begin : o->first;
    *end = begin + block < o->end ? (long)(begin + block) : o->end;
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
    r->wish = wish > r->wish ? wish : r->wish;
}

/* More splats than a tile holds go into the film before their pass is complete, when it is the next to do so. */
static void take_splats(void *context, struct tile *tile)
{
    struct under_way *p = context;
    if ((p->taken = parallel_await(&p->run->parallel, p->number)))
        film_take_splats(p->run->film, tile);
    tile->n_splats = 0;
}

static bool enough(void *context)
{
    const struct under_way *p = context;
    const struct render_options *o = p->run->options;
    return !p->taken && o->stop != NULL && o->stop(o->progress_context);
}

static void run_pass(void *context, int64_t number, int slot, int thread)
{
    struct run *r = context;
    struct render_job job = r->job;
    const struct observers *others = r->options->observers;
    struct tile_pass pass = {.job = &job, .tile = &r->tile[slot], .work = &r->work[thread]};
    struct observer observer;
    r->pass[slot] = (struct under_way){r, number, false};
    job.enough = enough;
    job.enough_context = &r->pass[slot];
    block_range(r, (r->begun + number) / tiles_per_block(r), &pass.first, &pass.end);
    tile_start(pass.tile, tiling_pixels(&r->tiling, (r->begun + number) % tiles_per_block(r)), r->job.film_rect,
               &r->job.scene->filter);
    if (r->film->half != NULL)
        pass.tile->first_half = pass.first / r->film->run % 2 == 0;
    if (others != NULL) {
        observer = others->begin(others->context, slot, pass.tile);
        pass.observer = &observer;
    }
    pass.tile->full = take_splats;
    pass.tile->context = &r->pass[slot];
    r->prepared.method->render(&r->prepared, &pass);
}

static bool merge_pass(void *context, int64_t number, int slot)
{
    struct run *r = context;
    int64_t done = r->begun + number + 1;
    long first, end;
    if (enough(&r->pass[slot])) /* the pass may have ended early */
        return false;
    block_range(r, (done - 1) / tiles_per_block(r), &first, &end);
    r->film->block.iterations = end - first;
    film_merge_tile(r->film, &r->tile[slot]);
    if (r->options->observers != NULL)
        r->options->observers->end(r->options->observers->context, slot);
    r->film->passes++;
    if (r->film->passes == tiles_per_block(r)) {
        film_end_block(r->film);
        if (good_enough(r) && r->wish == RENDER_GO_ON)
            r->wish = RENDER_END_BLOCK;
    }
    ask_progress(r, (double)done / (double)r->n_passes);
    return r->wish != RENDER_STOP && !(r->wish == RENDER_END_BLOCK && r->film->passes == 0);
}

static void run_all(struct run *r)
{
    const struct render_options *o = r->options;
    int64_t block = r->prepared.size.block, first_block = o->first / block, end_block = (o->end + block - 1) / block;
    int n_slots = (o->observers != NULL ? OBSERVED_SLOTS : SLOTS_PER_THREAD) * r->job.n_threads;
    r->n_passes = tiles_per_block(r) * (end_block - first_block);
    r->parallel = (struct parallel_jobs){.n_jobs = r->n_passes - r->begun, .n_threads = r->job.n_threads,
                                         .n_slots = n_slots, .context = r, .work = run_pass, .commit = merge_pass};
    r->tile = mem_alloc((size_t)n_slots, sizeof *r->tile);
    r->pass = mem_alloc((size_t)n_slots, sizeof *r->pass);
    r->work = workspaces_new(r->job.n_threads, r->job.max_depth);
    parallel_run(&r->parallel);
    workspaces_free(r->work, r->job.n_threads);
    for (int i = 0; i < n_slots; i++)
        tile_free(&r->tile[i]);
    free(r->tile);
    free(r->pass);
}

bool render_prepare(const struct scene *scene, const struct render_options *options, struct pixel_rect rect,
                    struct render_job *job, struct prepared *out, struct error *err)
{
    const struct method *m = method_find(options->integrator, &scene->settings, err);
    job->scene = scene;
    job->film_rect = rect;
    job->seed = job->eye_seed = options->seed;
    job->n_threads = options->n_threads < 1 ? os_cores() : options->n_threads;
    return m != NULL && parameters_read(scene, m, options->max_depth, job, err) && method_prepare(m, job, out, err);
}

static bool watch(void *context, double traced)
{
    struct run *r = context;
    (void)traced;
    ask_progress(r, 0);
    return r->wish == RENDER_GO_ON;
}

static bool holds_samples(const struct film *film) { return film->iterations > 0 || film->passes > 0; }

static bool prepare(struct run *r, const struct scene *scene, struct error *err)
{
    r->job.watch = r->options->progress != NULL ? watch : NULL;
    r->job.watch_context = r;
    bool ok = render_prepare(scene, r->options, r->film->rect, &r->job, &r->prepared, err);
    r->film->learnt_short = r->wish != RENDER_GO_ON && !holds_samples(r->film);
    return ok;
}

/* Blocks of a length that the method has chosen must not be cut: what it draws depends on where one begins. Nothing is
 * cut where all is done. */
static bool check_range(const struct run *r, struct error *err)
{
    const struct render_options *o = r->options;
    int block = r->prepared.size.block;
    if (block == 0 || o->first == o->end)
        return true;
    if (r->film->iterations > 0 && o->first % block != 0)
        return error_set(err,
                         "the film ends at sample %ld: here they come in blocks of %d, so it cannot be continued",
                         o->first, block);
    if (o->is_part && (o->first % block != 0 || (o->end % block != 0 && o->end != o->planned)))
        return error_set(err, "samples %ld:%ld: here they come in blocks of %d; begin and end with one", o->first,
                         o->end, block);
    return true;
}

/* Tiles, and blocks where their length is free. */
static bool cut(struct run *r, struct error *err)
{
    struct pass_size *size = &r->prepared.size;
    if (size->block == 0)
        size->block = r->options->block > 0 ? r->options->block : choose_block(&r->job, size->tile);
    r->tiling = tiling_of(r->job.film_rect, size);
    r->film->run = halves_run(size->block);
    r->begun = r->film->passes;
    return r->begun < tiles_per_block(r) ||
           error_set(err, "the film has more tile passes in it than a block of samples has");
}

bool render_scene(const struct scene *scene, const struct render_options *options, struct film *film,
                  struct error *err)
{
    struct run r = {.options = options, .film = film};
    if (!prepare(&r, scene, err))
        return false;
    method_numbers(&r.prepared, film->number);
    bool ok = check_range(&r, err) && cut(&r, err);
    /* Learning that was cut short has learnt other things than what the film's samples go by: no more are added. */
    bool in_haste = r.wish != RENDER_GO_ON && holds_samples(film);
    if (ok && scene->lights.n == 0 && options->observers == NULL) { /* all samples are black */
        film->block.iterations = options->end - options->first;
        film_end_block(film);
    } else if (ok && options->end > options->first && !in_haste && !good_enough(&r)) /* what is resumed may be */
        run_all(&r);
    method_release(&r.prepared);
    return ok;
}
