/* learn.c: see learn.h. The passes in their order; each has its own sub-paths. */
#include "learning/learn.h"

#include <stdlib.h>
#include <string.h>

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
static int trace_eye(const struct render_job *job, const struct counts *counts, struct workspace *work, long i,
                     enum stream stream, struct sampler *sampler)
{
    const struct pixel_rect film = job->film_rect;
    const struct walk w = {job->scene, counts, &work->arena, sampler, job->rr_threshold};
    double u, v;
    *sampler = stream_of(job, i, stream);
    sampler_r2(i, &u, &v);
    return path_eye(&w, film.x0 + u * rect_width(film), film.y0 + v * rect_height(film), work->eye,
                    job->max_depth + 1);
}

static int trace_light(const struct render_job *job, const struct counts *counts, struct arena *arena, long i,
                       enum stream stream, struct vertex *path, int *column)
{
    struct sampler sampler = stream_of(job, i, stream);
    const struct walk w = {job->scene, counts, arena, &sampler, job->rr_threshold};
    return path_light(&w, path, job->max_depth + 1, column);
}

/* --- the box of the eye vertices --------------------------------------------------------------------- */

static int by_size(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

/* The box that contains most eye vertices, so that one far surface does not decide how wide regions are. */
static void find_box(const struct learning *l, vec3 *low, vec3 *high)
{
    enum { PATHS = 256, OUTSIDE = 100 }; /* one vertex of OUTSIDE is outside on each side of an axis */
    const struct counts counts = {.tables = &NO_TABLES};
    double *along[3] = {NULL, NULL, NULL}, *to[2][3] = {{&low->x, &low->y, &low->z}, {&high->x, &high->y, &high->z}};
    size_t n = 0;
    for (long i = 0; i < PATHS; i++) {
        struct sampler sampler;
        arena_reset(&l->work->arena);
        for (int k = trace_eye(l->job, &counts, l->work, i, STREAM_BOX, &sampler) - 1; k > 0; k--) {
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

/* --- eye vertices: regions, what the camera can use there, the lights that they see ------------------- */

enum { LIGHTS_PER_VERTEX = 2 };         /* number of light points that each eye vertex tries */
enum { VISIT = -1 };                    /* column of a lesson of an eye vertex */
static const double DIRECT_DELTA = 0.2; /* share of s = 1 samples that choose lights by power */

static void trace_uses(struct learning *l, const struct counts *counts, struct workspace *work, long i,
                       struct lessons *out)
{
    struct sampler sampler;
    int n = trace_eye(l->job, counts, work, i, STREAM_EYE, &sampler);
    for (const struct vertex *z = work->eye + 1; z < work->eye + n; z++) {
        if (!vertex_connectible(z))
            continue;
        double beta = rgb_luminance(z->beta);
        struct lesson lesson = {regions_key(&l->tables->regions, z->p, vertex_side(z)), VISIT, 0, beta};
        lessons_add(out, lesson);
        for (int j = 0; l->options->direct && j < LIGHTS_PER_VERTEX; j++) {
            struct vertex y;
            if (!light_point(l->job->scene, counts, z, &sampler, j, LIGHTS_PER_VERTEX, &y))
                continue;
            lesson.column = y.cell;
            lesson.x = rgb_luminance(connect_vertices(l->job->scene, counts, &y, z).value) / beta;
            lessons_add(out, lesson);
        }
    }
}

static void take_use(struct learning *l, const struct lesson *lesson)
{
    struct tables *t = l->tables;
    int region = regions_add(&t->regions, lesson->row);
    if (lesson->column == VISIT)
        t->use[region] += lesson->w;
    else
        table_sums_add(&l->direct, regions_axis(&t->regions), (struct axis){l->direct.columns, NULL, NULL}, region,
                       lesson->column, lesson->x, lesson->w);
}

static void learn_uses(struct learning *l, long n)
{
    const struct pass pass = {trace_uses, take_use, NO_TABLES};
    vec3 low, high;
    find_box(l, &low, &high);
    regions_init(&l->tables->regions, low, high, REGION_CELLS, REGIONS);
    l->tables->use = mem_alloc(REGIONS, sizeof *l->tables->use);
    if (l->options->direct)
        table_sums_init(&l->direct, REGIONS, l->job->scene->lights.n_cells);
    lessons_learn(l, &pass, 0, n);
}

/* After the last pass that adds regions. */
static void build_direct(struct learning *l)
{
    const struct light_set *lights = &l->job->scene->lights;
    double *base = mem_alloc((size_t)lights->n_cells, sizeof *base);
    for (int cell = 0; cell < lights->n_cells; cell++)
        base[cell] = alias_pmf(&lights->choice, cell);
    l->tables->direct = table_build(&l->direct, regions_axis(&l->tables->regions),
                                    (struct axis){lights->n_cells, NULL, NULL}, base, DIRECT_DELTA, false, true);
    free(base);
}

/* --- light sub-paths: rays that leave lights, and light vertices -------------------------------------- */

static const double FIRST_VERTEX = 0.2; /* factor of y_1 in the worth of a ray: s = 1 finds the same light */
enum { RAY = 0 };                       /* row of the lesson of a ray; light vertices have a key */

static void trace_light_path(struct learning *l, const struct counts *counts, struct workspace *work, long i,
                             struct lessons *out)
{
    const struct tables *t = counts->tables;
    struct vertex *path = arena_alloc(&work->arena, ((size_t)l->job->max_depth + 1) * sizeof *path);
    int column, n = trace_light(l->job, counts, &work->arena, i, STREAM_LIGHT, path, &column);
    double worth = n > 1 && t->use != NULL ? FIRST_VERTEX * path_use(t, path, 2) + path_use(t, path + 1, n - 1) : 0;
    lessons_add(out, (struct lesson){RAY, column, sqr(worth), 1});
    for (const struct vertex *y = path + 1; y < path + n; y++)
        if (vertex_connectible(y))
            lessons_add(out, (struct lesson){regions_key(&t->regions, y->p, vertex_side(y)), column, 0, 1});
}

static void take_light_path(struct learning *l, const struct lesson *lesson)
{
    if (lesson->row != RAY)
        lessons_add(&l->light_vertices, *lesson); /* regions must not change while others look them up */
    else if (l->columns.n > 0)
        table_sums_add(&l->sums, (struct axis){1, NULL, NULL}, l->columns, 0, lesson->column, lesson->x, lesson->w);
    l->n_light += lesson->row == RAY;
}

/* Count the light vertices. They were traced by power. When rays leave by the table of emission, one of them is met
 * `ratio` times as often. */
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
    const struct pass pass = {trace_light_path, take_light_path, *l->tables};
    struct emission_axis axis = {.above = NULL};
    bool emission = l->options->use && l->options->emission < 1 && lights->choice.n > 0;
    if (emission) {
        axis = emission_axis_new(lights);
        table_sums_init(&l->sums, 1, axis.axis.n);
    }
    l->columns = axis.axis;
    lessons_learn(l, &pass, 0, n);
    if (emission)
        l->tables->emission = table_build(&l->sums, (struct axis){1, NULL, NULL}, axis.axis, axis.base,
                                          l->options->emission, true, true);
    emission_axis_free(&axis);
    count_light_vertices(l);
}

/* --- trial connections ------------------------------------------------------------------------------- */

enum {
    POOL = 64, /* number of light sub-paths of a chunk */
    TRIALS = 4 /* number of trial connections of each eye vertex */
};

/* Trace the light sub-paths of the chunk that eye sub-path number i begins, into the workspace's pool. */
static void fill_pool(struct learning *l, const struct counts *counts, struct pool *pool, long i)
{
    pool_clear(pool);
    for (long k = 0; k < POOL && job_cancelled(l->job) == CANCEL_NOT; k++) {
        struct vertex *path = pool_room(pool, (size_t)l->job->max_depth + 1);
        pool_add(pool, trace_light(l->job, counts, &pool->arena, i * POOL + k, STREAM_POOL, path, NULL));
    }
    pool_find_candidates(pool);
    double *L = arena_alloc(&pool->arena, (size_t)pool->n_candidates * sizeof *L);
    for (int k = 0; k < pool->n_candidates; k++)
        L[k] = pool->candidate[k].L < 1e100 ? pool->candidate[k].L : 0; /* false for NaN */
    alias_build(&pool->alias, L, pool->n_candidates);
}

/* The worth of a trial: unweighted, what light of luminance 1 at y sends to the camera by an eye vertex of throughput 1
 * at z. It counts by the throughput of z. The share of light vertices in a region is its base (table.h), so ratios have
 * the mean 1. */
static void trace_trials(struct learning *l, const struct counts *counts, struct workspace *work, long i,
                         struct lessons *out)
{
    const struct pool *pool = &work->pool;
    struct sampler sampler;
    if (i % CHUNK == 0)
        fill_pool(l, counts, &work->pool, i);
    int n = trace_eye(l->job, counts, work, i, STREAM_EYE, &sampler);
    for (const struct vertex *z = work->eye + 1; z < work->eye + n; z++)
        for (int k = 0; k < TRIALS && pool->alias.n > 0 && vertex_connectible(z); k++) {
            double beta = rgb_luminance(z->beta), u = (k + sampler_number(&sampler, DRAW_LIGHT_END)) / TRIALS;
            const struct candidate *c = &pool->candidate[alias_sample(&pool->alias, u, NULL, NULL)];
            const struct vertex *y = candidate_vertex(c);
            struct connection found = connect_vertices(l->job->scene, counts, y, z);
            double x = rgb_luminance(found.value) / (beta * c->L);
            lessons_add(out, (struct lesson){(uint64_t)z->region, y->region, x, beta});
        }
}

static void take_trial(struct learning *l, const struct lesson *lesson)
{
    const struct axis axis = regions_axis(&l->tables->regions);
    table_sums_add(&l->sums, axis, axis, (int)lesson->row, lesson->column, lesson->x, lesson->w);
}

static void learn_pairs(struct learning *l, long first, long end)
{
    struct tables *t = l->tables;
    const struct pass pass = {trace_trials, take_trial, *t};
    const struct axis axis = regions_axis(&t->regions);
    table_sums_init(&l->sums, axis.n, axis.n);
    lessons_learn(l, &pass, first, end);
    t->pairs = table_build(&l->sums, axis, axis, t->vertices, l->options->delta, false, false);
}

/* --- all passes -------------------------------------------------------------------------------------- */

enum { LIGHT_COUNTED = 4 * 1024 }; /* light sub-paths if only the mean number of their vertices is needed */

void learn(const struct render_job *job, const struct learn_options *options, struct tables *out)
{
    struct learning l = {.job = job, .options = options, .tables = out,
                         .work = workspaces_new(job->n_threads, job->max_depth)};
    bool few = options->few || (options->direct && !options->use && !options->pairs);
    double pixels = (double)rect_pixels(job->film_rect);
    long n = few ? int_within(pixels / DIRECT_PIXELS, DIRECT_LEAST, LEARN_MOST)
                 : int_within(pixels * LEARN_PER_PIXEL, LEARN_LEAST, LEARN_MOST);
    long n_light = n < LEARN_LIGHT ? n : LEARN_LIGHT, half = n / 2 / CHUNK * CHUNK;
    bool regions = options->use || options->direct || options->pairs;
    l.budget = (regions ? (double)n : 0) + (double)(options->use ? n_light : options->count ? LIGHT_COUNTED : 0);
    if (regions)
        learn_uses(&l, options->pairs ? half : n);
    if (options->use || options->count)
        learn_light_paths(&l, options->use ? n_light : LIGHT_COUNTED);
    if (options->direct)
        build_direct(&l);
    if (options->pairs)
        learn_pairs(&l, half, n);
    workspaces_free(l.work, job->n_threads);
}
