/* learn.c: see learn.h. Where each lesson goes; then the three rounds, each with its samples and the tables of them. */
#include "learning/learn.h"

#include <stdlib.h>

#include "base/alias.h"
#include "base/number.h"
#include "learning/lessons.h"
#include "tables/emission.h"
#include "transport/connect.h"

/* --- sub-paths --------------------------------------------------------------------------------------- */

enum stream { STREAM_EYE, STREAM_LIGHT, STREAM_POOL, STREAM_BOX };

static struct sampler stream_of(const struct render_job *job, long i, enum stream stream)
{
    return sampler_start(job->seed, RNG_LEARN, (uint64_t)i, (uint64_t)stream);
}

/* Trace eye sub-path number i through point i of a low-discrepancy sequence over the film. Returns the number of
 * vertices. *sampler can be used further. */
static int trace_eye(const struct learning *l, struct workspace *work, long i, enum stream stream,
                     struct sampler *sampler)
{
    const struct pixel_rect film = l->job->film_rect;
    const struct walk w = {l->job->scene, &l->counts, &work->arena, sampler, l->job->rr_threshold};
    double u, v;
    *sampler = stream_of(l->job, i, stream);
    sampler_r2(i, &u, &v);
    return path_eye(&w, film.x0 + u * rect_width(film), film.y0 + v * rect_height(film), work->eye,
                    l->job->max_depth + 1);
}

static int trace_light(const struct learning *l, struct arena *arena, long i, enum stream stream, struct vertex *path,
                       int *column)
{
    struct sampler sampler = stream_of(l->job, i, stream);
    const struct walk w = {l->job->scene, &l->counts, arena, &sampler, l->job->rr_threshold};
    return path_light(&w, path, l->job->max_depth + 1, column);
}

/* --- where lessons go -------------------------------------------------------------------------------- */

static const struct axis ONE = {1, NULL, NULL};

static void take(struct learning *l, const struct lesson *lesson)
{
    struct tables *t = l->tables;
    const struct axis cells = {t->guide.columns, NULL, NULL};
    switch ((enum lesson_kind)lesson->kind) {
    case VISIT: t->use[regions_add(&t->regions, lesson->row)] += lesson->w; break;
    case GUIDE: {
        int region = regions_add(&t->regions, lesson->row);
        table_add(&t->guide, regions_axis(&t->regions), cells, region, lesson->column, lesson->x, lesson->w);
        break;
    }
    case RAY:
        l->n_light++;
        if (l->rays.n > 0)
            table_add(&t->emission, ONE, l->rays, 0, lesson->column, lesson->x, lesson->w);
        break;
    case LIGHT_VERTEX: lessons_add(&l->light_vertices, *lesson); break; /* others look regions up: add none yet */
    case TRIAL:
        table_add(&t->pairs, regions_axis(&t->regions), regions_axis(&t->regions), (int)lesson->row, lesson->column,
                  lesson->x, lesson->w);
        break;
    }
}

/* --- eye sub-paths: regions, use, guide --------------------------------------------------------------- */

enum { LIGHTS_PER_VERTEX = 2 }; /* light points that each eye vertex tries */
static const double GUIDE_DELTA = 0.2; /* share of s = 1 samples that choose lights by power */

static int by_size(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

/* The box that contains most eye vertices, so that one far surface does not decide how wide regions are. */
static void find_box(const struct learning *l, vec3 *low, vec3 *high)
{
    enum { PATHS = 256, OUTSIDE = 100 }; /* one vertex of OUTSIDE is outside on each side of an axis */
    double *along[3] = {NULL, NULL, NULL}, *to[2][3] = {{&low->x, &low->y, &low->z}, {&high->x, &high->y, &high->z}};
    size_t n = 0;
    for (long i = 0; i < PATHS; i++) {
        struct sampler sampler;
        arena_reset(&l->work->arena);
        for (int k = trace_eye(l, l->work, i, STREAM_BOX, &sampler) - 1; k > 0; k--) {
            const struct vertex *z = &l->work->eye[k];
            const double p[3] = {z->p.x, z->p.y, z->p.z};
            for (int axis = 0; axis < 3 && vertex_connectible(z); axis++) {
                along[axis] = mem_append(along[axis], n, sizeof **along);
                along[axis][n] = p[axis];
            }
            n += vertex_connectible(z);
        }
    }
    *low = *high = l->job->scene->lights.center;
    for (int axis = 0; axis < 3; axis++) {
        if (n > 0) {
            qsort(along[axis], n, sizeof **along, by_size);
            *to[0][axis] = along[axis][n / OUTSIDE];
            *to[1][axis] = along[axis][n - 1 - n / OUTSIDE];
        }
        free(along[axis]);
    }
}

static void trace_eye_path(struct learning *l, struct workspace *work, long i, struct lessons *out)
{
    struct sampler sampler;
    int n = trace_eye(l, work, i, STREAM_EYE, &sampler);
    for (const struct vertex *z = work->eye + 1; z < work->eye + n; z++) {
        if (!vertex_connectible(z))
            continue;
        double beta = rgb_worth(z->beta);
        uint64_t key = regions_key(&l->tables->regions, z->p, vertex_side(z));
        lessons_add(out, (struct lesson){VISIT, key, 0, 0, beta});
        for (int j = 0; l->options->guide && j < LIGHTS_PER_VERTEX; j++) {
            struct vertex y;
            struct connection c = connect_s1(l->job->scene, &l->counts, z, &sampler, j, LIGHTS_PER_VERTEX, &y);
            if (y.light >= 0)
                lessons_add(out, (struct lesson){GUIDE, key, y.place, rgb_worth(c.value) / beta, beta});
        }
    }
}

static void learn_eye_paths(struct learning *l, long n)
{
    vec3 low, high;
    find_box(l, &low, &high);
    regions_init(&l->tables->regions, low, high, REGION_CUBES, REGIONS);
    l->tables->use = mem_alloc(REGIONS, sizeof *l->tables->use);
    if (l->options->guide)
        l->tables->guide = table_learn(REGIONS, l->job->scene->lights.n_cells);
    lessons_learn(l, trace_eye_path, &NO_TABLES, 0, n);
}

/* After the last round that adds regions. */
static void build_guide(struct learning *l)
{
    const struct light_set *lights = &l->job->scene->lights;
    const struct axis cells = {lights->n_cells, NULL, NULL};
    double *base = mem_alloc((size_t)lights->n_cells, sizeof *base);
    for (int cell = 0; cell < lights->n_cells; cell++)
        base[cell] = alias_pmf(&lights->choice, cell);
    table_build(&l->tables->guide, regions_axis(&l->tables->regions), cells, base, GUIDE_DELTA, false, true);
    free(base);
}

/* --- light sub-paths: emission, vertices --------------------------------------------------------------- */

static const double FIRST_VERTEX = 0.2; /* factor of y_1 in the worth of a ray: s = 1 finds the same light */

double learnt_use(const struct tables *tables, const struct vertex *path, int first, int end)
{
    double sum = 0;
    for (const struct vertex *y = path + first; y < path + end; y++)
        if (vertex_connectible(y))
            sum += rgb_worth(y->beta) * tables->use[y->place];
    return sum;
}

static void trace_light_path(struct learning *l, struct workspace *work, long i, struct lessons *out)
{
    const struct tables *t = l->tables;
    struct vertex *path = arena_alloc(&work->arena, ((size_t)l->job->max_depth + 1) * sizeof *path);
    int column, n = trace_light(l, &work->arena, i, STREAM_LIGHT, path, &column);
    double worth = n > 1 && t->use != NULL ? FIRST_VERTEX * learnt_use(t, path, 1, 2) + learnt_use(t, path, 2, n) : 0;
    lessons_add(out, (struct lesson){RAY, 0, column, sqr(worth), 1});
    for (const struct vertex *y = path + 1; y < path + n; y++)
        if (vertex_connectible(y))
            lessons_add(out,
                        (struct lesson){LIGHT_VERTEX, regions_key(&t->regions, y->p, vertex_side(y)), column, 0, 1});
}

/* The sub-paths were traced by power. When rays leave by the table of emission, one of them is met `ratio` times as
 * often. */
static void count_light_vertices(struct learning *l)
{
    struct tables *t = l->tables;
    const struct lessons *seen = &l->light_vertices;
    t->vertices = t->use != NULL ? mem_alloc(REGIONS, sizeof *t->vertices) : NULL;
    for (const struct lesson *y = seen->item; y < seen->item + seen->n; y++) {
        double times = table_ratio(&t->emission, 0, y->column);
        t->light_vertices += times;
        if (t->vertices != NULL)
            t->vertices[regions_add(&t->regions, y->row)] += times;
    }
    for (int i = 0; t->vertices != NULL && t->light_vertices > 0 && i < t->regions.n; i++)
        t->vertices[i] /= t->light_vertices;
    t->light_vertices /= most_of(l->n_light, 1);
    free(seen->item);
}

static void learn_light_paths(struct learning *l, long n)
{
    const struct light_set *lights = &l->job->scene->lights;
    bool emission = l->options->use && l->options->emission < 1 && lights->choice.n > 0;
    double *base = NULL;
    if (emission) {
        l->rays = emission_axis_new(lights, &base);
        l->tables->emission = table_learn(1, l->rays.n);
    }
    lessons_learn(l, trace_light_path, l->tables, 0, n);
    if (emission)
        table_build(&l->tables->emission, ONE, l->rays, base, l->options->emission, true, true);
    emission_axis_free(&l->rays, base);
    count_light_vertices(l);
}

/* --- trial connections: pairs ------------------------------------------------------------------------- */

enum {
    TRIAL_PATHS = 64, /* number of light sub-paths of a chunk */
    TRIALS = 4 /* number of trial connections of each eye vertex */
};

/* Trace the light sub-paths of the chunk that eye sub-path number i begins, into the workspace's pool. */
static void fill_pool(struct learning *l, struct pool *pool, long i)
{
    pool_clear(pool);
    for (long k = 0; k < TRIAL_PATHS && job_cancelled(l->job) == CANCEL_NOT; k++) {
        struct vertex *path = pool_room(pool, (size_t)l->job->max_depth + 1);
        pool_add(pool, trace_light(l, &pool->arena, i * TRIAL_PATHS + k, STREAM_POOL, path, NULL));
    }
    pool_find_candidates(pool);
    double *L = arena_alloc(&pool->arena, (size_t)pool->n_candidates * sizeof *L);
    for (int k = 0; k < pool->n_candidates; k++)
        L[k] = rgb_worth(pool->candidate[k]->beta);
    alias_build(&pool->alias, L, pool->n_candidates);
}

/* The worth of a trial: unweighted, what light of luminance 1 at y sends to the camera by an eye vertex of throughput 1
 * at z. It counts by the throughput of z. y is drawn by its luminance and this is divided out, so m is the mean over
 * light, as draws need it (asbdpt.c). The share of light vertices in a region is its base (table.h), so ratios have the
 * mean 1. */
static void trace_trials(struct learning *l, struct workspace *work, long i, struct lessons *out)
{
    const struct pool *pool = &work->pool;
    struct sampler sampler;
    if (i % CHUNK == 0)
        fill_pool(l, &work->pool, i);
    int n = trace_eye(l, work, i, STREAM_EYE, &sampler);
    for (const struct vertex *z = work->eye + 1; z < work->eye + n; z++)
        for (int k = 0; k < TRIALS && pool->alias.n > 0 && vertex_connectible(z); k++) {
            double beta = rgb_worth(z->beta), u = (k + sampler_number(&sampler, DRAW_LIGHT_END)) / TRIALS;
            const struct vertex *y = pool->candidate[alias_sample(&pool->alias, u, NULL, NULL)];
            struct connection found = connect_vertices(l->job->scene, &l->counts, y, z);
            double x = rgb_worth(found.value) / (beta * rgb_worth(y->beta));
            lessons_add(out, (struct lesson){TRIAL, (uint64_t)z->place, y->place, x, beta});
        }
}

static void learn_pairs(struct learning *l, long first, long end)
{
    struct tables *t = l->tables;
    const struct axis axis = regions_axis(&t->regions);
    t->pairs = table_learn(axis.n, axis.n);
    lessons_learn(l, trace_trials, t, first, end);
    table_build(&t->pairs, axis, axis, t->vertices, l->options->delta, false, false);
}

/* --- all rounds -------------------------------------------------------------------------------------- */

enum { LIGHT_COUNTED = 4 * 1024 }; /* light sub-paths if only the mean number of their vertices is needed */

void learn(const struct render_job *job, const struct learn_options *options, struct tables *out)
{
    struct learning l = {.job = job, .options = options, .tables = out,
                         .work = workspaces_new(job->n_threads, job->max_depth), .take = take,
                         .counts = {.tables = &NO_TABLES}};
    bool regions = options->use || options->guide || options->pairs;
    bool few = options->few || (options->guide && !options->use && !options->pairs);
    double pixels = (double)rect_pixels(job->film_rect);
    long n = few ? int_within(pixels / FEW_PIXELS, FEW_LEAST, LEARN_MOST)
                 : int_within(pixels * LEARN_PER_PIXEL, LEARN_LEAST, LEARN_MOST);
    long n_light = options->use ? (n < LEARN_LIGHT ? n : LEARN_LIGHT) : options->count ? LIGHT_COUNTED : 0;
    long half = options->pairs ? n / 2 / CHUNK * CHUNK : n;
    l.budget = (double)(regions ? n : 0) + (double)n_light;
    if (regions)
        learn_eye_paths(&l, half);
    if (n_light > 0)
        learn_light_paths(&l, n_light);
    if (options->guide)
        build_guide(&l);
    if (options->pairs)
        learn_pairs(&l, half, n);
    workspaces_free(l.work, job->n_threads);
}
