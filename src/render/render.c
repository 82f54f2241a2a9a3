/* render.c: see render.h. */
#include "render/render.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "base/parallel.h"
#include "base/sampler.h"
#include "render/noise_estimate.h"

/* --- tiles ------------------------------------------------------------------------------------------- */

struct tiling tiling_of(struct pixel_rect film, const struct pass_size *size)
{
    struct tiling t = {film, *size, (rect_width(film) + size->tile - 1) / size->tile,
                       (rect_height(film) + size->tile - 1) / size->tile, 0};
    t.step = lattice_step(tiling_count(&t));
    return t;
}

/* On one axis, of `n` tiles: number `tile` is number `own` of a group of *together, which shares [*begin, *end). Groups
 * are of up to `spread` tiles, and as like in size as can be. */
static void interleave(const struct pass_size *size, int n, int tile, int *begin, int *end, int *together, int *own)
{
    int groups = (n + size->spread - 1) / size->spread, group = (int)((int64_t)tile * groups / n);
    int first = (int)(((int64_t)group * n + groups - 1) / groups);
    int next = (int)((((int64_t)group + 1) * n + groups - 1) / groups);
    if (next < n)
        *end = *begin + next * size->tile;
    *begin += first * size->tile;
    *together = next - first;
    *own = tile - first;
}

struct tile_pixels tiling_pixels(const struct tiling *t, int64_t i)
{
    struct tile_pixels p = {.rect = t->film};
    i = i * t->step % tiling_count(t);
    interleave(&t->size, t->nx, (int)(i % t->nx), &p.rect.x0, &p.rect.x1, &p.nx, &p.x);
    interleave(&t->size, t->ny, (int)(i / t->nx), &p.rect.y0, &p.rect.y1, &p.ny, &p.y);
    return p;
}

/* --- tile passes ------------------------------------------------------------------------------------- */

struct run {
    struct render_job *job; /* blocks begin at multiples of their length, maybe INT_MAX: counted in 64 bits */
    struct prepared *method;
    struct film *film;
    struct tiling tiling;
    int block;        /* iterations of a block */
    int64_t begun;    /* tile passes of the first block that the film holds already */
    int64_t n_passes; /* of all blocks, with these */
    bool good; /* the noise is below the limit */
    struct workspace *work; /* [n_threads] */
    struct tile *tile;      /* [n_slots] */
    struct under_way *pass; /* [n_slots] */
    struct parallel_jobs parallel; /* the passes that the film does not hold yet, in their order */
};

/* A pass under way: by its number among those of `parallel`. */
struct under_way {
    struct run *run;
    int64_t number;
    struct tile_pass pass;
    struct observer observer;
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
    const struct render_job *o = r->job;
    int64_t block = r->block, begin = (o->first / block + b) * block;
    *first = begin > o->first ? (long)begin : o->first;
    *end = begin + block < o->end ? (long)(begin + block) : o->end;
}

/* Whenever the halves are of one size. */
static bool good_enough(const struct run *r)
{
    const double *limit = r->job->noise;
    struct film *f = r->film;
    bool good = noise_measure(f, r->job->scene->film_scale);
    for (int i = 0; i < N_NOISE_SCALES; i++)
        good = good && (limit[i] == 0 || f->noise[i].value < limit[i]);
    return good && limit[NOISE_RELATIVE] + limit[NOISE_8_BIT] > 0;
}

/* More splats than a tile holds go into the film before their pass is complete, when it is the next to do so. */
static void take_splats(void *context, struct tile *tile)
{
    struct under_way *p = context;
    if ((tile->taken = !pass_cancelled(&p->pass) && parallel_await(&p->run->parallel, p->number)))
        film_take_splats(p->run->film, tile);
    tile->n_splats = 0;
}

static void run_pass(void *context, int64_t number, int slot, int thread)
{
    struct run *r = context;
    struct under_way *p = &r->pass[slot];
    struct tile *tile = &r->tile[slot];
    const struct observers *others = r->job->observers;
    *p = (struct under_way){.run = r, .number = number,
                            .pass = {.job = r->job, .counts = &r->method->counts, .tile = tile,
                                     .work = &r->work[thread], .ends_at = CANCEL_NOW}};
    block_range(r, (r->begun + number) / tiles_per_block(r), &p->pass.first, &p->pass.end);
    tile_start(tile, tiling_pixels(&r->tiling, (r->begun + number) % tiles_per_block(r)), r->job->film_rect,
               &r->job->scene->filter);
    if (r->film->half != NULL)
        tile->first_half = p->pass.first / r->film->run % 2 == 0;
    if (others != NULL) {
        p->observer = others->begin(others->context, slot, tile);
        p->pass.observer = &p->observer;
    }
    tile->full = take_splats;
    tile->context = p;
    r->method->method->render(r->method, &p->pass);
}

static bool merge_pass(void *context, int64_t number, int slot)
{
    struct run *r = context;
    int64_t done = r->begun + number + 1;
    const struct tile_pass *pass = &r->pass[slot].pass;
    if (pass_cancelled(pass)) /* it may have ended early */
        return false;
    r->film->block.iterations = pass->end - pass->first;
    film_merge_tile(r->film, pass->tile);
    const struct observers *observers = r->job->observers;
    if (observers != NULL)
        observers->end(observers->context, slot);
    r->film->passes++;
    if (r->film->passes == tiles_per_block(r)) {
        film_end_block(r->film);
        r->good = good_enough(r);
    }
    job_progress(r->job, 1, (double)done / (double)r->n_passes);
    enum cancel cancel = job_cancelled(r->job);
    return cancel != CANCEL_NOW && !((cancel == CANCEL_BLOCK || r->good) && r->film->passes == 0);
}

static void run_all(struct run *r)
{
    const struct render_job *o = r->job;
    int64_t block = r->block;
    int64_t first_block = o->first / block, end_block = (o->end + block - 1) / block;
    int n_slots = (o->observers != NULL ? OBSERVED_SLOTS : SLOTS_PER_THREAD) * o->n_threads;
    r->n_passes = tiles_per_block(r) * (end_block - first_block);
    r->parallel = (struct parallel_jobs){.n_jobs = r->n_passes - r->begun, .n_threads = o->n_threads,
                                         .n_slots = n_slots, .context = r, .work = run_pass, .commit = merge_pass};
    r->tile = mem_alloc((size_t)n_slots, sizeof *r->tile);
    r->pass = mem_alloc((size_t)n_slots, sizeof *r->pass);
    r->work = workspaces_new(o->n_threads, o->max_depth);
    parallel_run(&r->parallel);
    workspaces_free(r->work, o->n_threads);
    for (int i = 0; i < n_slots; i++)
        tile_free(&r->tile[i]);
    free(r->tile);
    free(r->pass);
}

/* Blocks of a length that the method has chosen must not be cut: what it draws depends on where one begins. Nothing is
 * cut where all is done. */
static bool check_range(const struct run *r, struct error *err)
{
    const struct render_job *o = r->job;
    int block = r->method->size.block;
    if (block == 0 || o->first == o->end)
        return true;
    if (r->film->iterations > 0 && o->first % block != 0 && block == INT_MAX)
        return error_set(err, "the film ends at sample %ld: here all samples are one block, so it cannot be continued",
                         o->first);
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
    const struct pass_size *size = &r->method->size;
    long first, end;
    r->block = size->block > 0 ? size->block : r->job->block > 0 ? r->job->block : choose_block(r->job, size->tile);
    r->tiling = tiling_of(r->job->film_rect, size);
    r->film->run = noise_run(r->block);
    r->begun = r->film->passes;
    block_range(r, 0, &first, &end);
    return r->begun == 0 || (r->begun < tiles_per_block(r) && r->film->block.iterations == end - first) ||
           error_set(err, "the film has tile passes in it of another block of samples");
}

bool render_scene(struct render_job *job, struct prepared *p, struct film *film, struct error *err)
{
    struct run r = {.job = job, .method = p, .film = film};
    bool begun = film->iterations > 0 || film->passes > 0;
    if (p->tables == NULL)
        job_prepare(job, p);
    film->learnt_short |= p->hasty && !begun;
    if (!check_range(&r, err) || !cut(&r, err))
        return false;
    /* Learning that was cut short has learnt other things than what the film's samples go by: no more are added. */
    bool more = job->end > job->first && (!p->hasty || film->learnt_short);
    if (more && job->scene->lights.n == 0 && job->observers == NULL) { /* all samples are black */
        film->block.iterations = job->end - job->first;
        film_end_block(film);
    } else if (more && !good_enough(&r)) /* what is resumed may be */
        run_all(&r);
    return true;
}
