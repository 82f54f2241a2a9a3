/* mbdpt.c: matrix BDPT: the pairs of sub-paths are the elements of a matrix, from which a lattice is taken.
 *
 * Of the N eye and K light sub-paths of a tile and iteration, every pair joined by strategy (s,t) is an element of an N
 * x K matrix, whose mean is what the pixels are to receive together [Chaitanya 2018]. With matrix=pixel they are those
 * of a pixel in a block of iterations. Its rows are sorted by the eye
 * sub-paths' first t vertices, its columns by the light sub-paths' first s, either by the length of these or by the
 * throughput at the last of them, which the contribution of a pair is proportional to, so that neighbouring elements
 * are alike, and a stratified choice is good for something. Chosen are the N elements
 *     row i,  column floor(K frac(i A / N + U)),    A prime to N, near N times the golden section,
 * a lattice [Roberts 2018] shifted at random: one in every row; with K = N one in every column, too. Given its row, a
 * column is uniform since U is, so each pixel is joined with one light sub-path, any equally likely, as in BDPT: its
 * expectation and its counts. The gain of stratification is that the errors of neighbours in path space cancel in
 * sums over pixels, while a pixel's own variance is BDPT's; with matrix=pixel in its own sum.
 *
 * s = 0, s = 1 and t = 1 are no matrices of pairs and stay as they are, as the paper advises. How it sorts and
 * chooses could not be read; this is our reading. With a matrix of one element the method is BDPT to the byte.
 *
 * Tests: test_rivals.c.
 */
#include <math.h>
#include <stdlib.h>

#include "rivals/together.h"

/* A sub-path in order of its first vertices. */
struct ranked {
    double key; /* infinite if it has fewer, so that these gather at the end */
    int number;
};

static const char *const KEYS[] = {"length", "throughput", NULL};

static const char *const MATRICES[] = {"tile", "pixel", NULL};

struct mbdpt {
    int throughput; /* number of the key */
    int by_pixel;   /* of the matrix */
};
enum { PIXEL_BLOCK = 16 }; /* iterations that a pixel's matrix has */

struct cache {
    struct ranked **column; /* [max_depth + 1][K]; from 2 on */
};

static int by_key(const void *a, const void *b)
{
    const struct ranked *x = a, *y = b;
    return x->key != y->key ? (x->key > y->key) - (x->key < y->key)
                                  : (x->number > y->number) - (x->number < y->number);
}

/* Length of the first m >= 2 of n vertices; a light at infinity, which has no place, is left out. */
static double length_of(const struct vertex *path, int n, int m, bool far)
{
    double sum = 0;
    for (int i = far ? 2 : 1; i < m && m <= n; i++)
        sum += length(sub(path[i].p, path[i - 1].p));
    return m <= n ? sum : INFINITY;
}

static void rank(struct ranked *r, int i, const struct vertex *path, int n, int m, bool far, bool throughput)
{
    r[i].key = !throughput || m > n ? length_of(path, n, m, far) : rgb_luminance(path[m - 1].beta);
    r[i].number = i;
}

static struct cache *build(const struct prepared *p, const struct tile_pass *pass, long iteration)
{
    struct pool *pool = &pass->work->pool;
    struct cache *cache = arena_alloc(&pool->arena, sizeof *cache);
    bool throughput = ((const struct mbdpt *)p->own)->throughput;
    (void)iteration;
    cache->column = arena_alloc(&pool->arena, (size_t)(pass->job->max_depth + 1) * sizeof *cache->column);
    for (int s = 2; s <= pass->job->max_depth; s++) {
        struct ranked *column = cache->column[s] = arena_alloc(&pool->arena, (size_t)pool->n * sizeof *column);
        for (int k = 0; k < pool->n; k++) {
            const struct vertex *path = pool_path(pool, k);
            int n = pool->length[k];
            rank(column, k, path, n, s, n > 0 && vertex_at_infinity(pass->job->scene, path), throughput);
        }
        qsort(column, (size_t)pool->n, sizeof *column, by_key);
    }
    return cache;
}

/* All strategies of eye sub-paths of t vertices, each with a shift of its own. */
static void connect_length(const struct prepared *p, const struct pool *pool, const struct cache *cache,
                           struct pixel *pixel, int n, struct ranked *row, int t, const double *shift)
{
    int64_t step = lattice_step(n);
    for (int i = 0; i < n; i++)
        rank(row, i, pixel[i].sample.eye, pixel[i].n, t, false, ((const struct mbdpt *)p->own)->throughput);
    qsort(row, (size_t)n, sizeof *row, by_key);
    for (int i = 0; i < n && row[i].key < INFINITY; i++)
        for (int s = 2; s <= pixel->sample.pass->job->max_depth + 2 - t; s++) {
            double u = (double)(i * step % n) / n + shift[s];
            int j = (int)((u - floor(u)) * pool->n), k = cache->column[s][j < pool->n ? j : pool->n - 1].number;
            const struct drawn drawn = {pool_path(pool, k), s - 1, s, 1.0 / pool->n};
            struct pixel *of = &pixel[row[i].number];
            if (pool->length[k] >= s)
                sample_pairs(&of->sample, &drawn, t, 1);
        }
}

/* As loop_splat, for sub-path i of n. */
static void splat(const struct prepared *p, struct sample *sample, int i, int n)
{
    const struct pool *pool = &sample->pass->work->pool;
    int each = p->numbers.path_pixels, k = i / each;
    if (i % each == 0)
        sample_lens(sample, pool_path(pool, k), pool->length[k], n / ((double)pool->n * each));
}

static void connect_all(const struct prepared *p, const struct tile_pass *pass, const struct cache *cache,
                        struct pixel *pixel, int n)
{
    const struct pool *pool = &pass->work->pool;
    struct ranked *row = arena_alloc(&pass->work->arena, (size_t)n * sizeof *row);
    double *shift = arena_alloc(&pass->work->arena, (size_t)(pass->job->max_depth + 1) * sizeof *shift);
    for (int i = 0; i < n; i++)
        sample_alone(&pixel[i].sample, pixel[i].n);
    for (int t = 2; t <= pass->job->max_depth && !pass_cancelled(pass); t++) {
        for (int s = 2; s <= pass->job->max_depth; s++)
            shift[s] = sampler_number(&pixel[0].sample.choice, DRAW_LIGHT_END);
        connect_length(p, pool, cache, pixel, n, row, t, shift);
    }
    for (int i = 0; i < n; i++)
        splat(p, &pixel[i].sample, i, n);
}

/* All samples of a pixel. */
static void render_pixel(const struct prepared *p, const struct tile_pass *pass, int pixel)
{
    struct pool *pool = &pass->work->pool;
    int n = (int)(pass->end - pass->first);
    pool_clear(pool);
    for (long i = pass->first; i < pass->end; i += p->numbers.path_pixels) {
        struct vertex *path = pool_room(pool, (size_t)pass->job->max_depth + 1);
        pool_add(pool, sample_light_path(pass, pixel, (uint64_t)i, &pool->arena, path));
    }
    const struct cache *cache = build(p, pass, pass->first);
    arena_reset(&pass->work->arena);
    struct pixel *sample = arena_alloc(&pass->work->arena, (size_t)n * sizeof *sample);
    for (int i = 0; i < n; i++)
        sample[i] = together_begin(p, pass, pixel, pass->first + i);
    connect_all(p, pass, cache, sample, n);
    for (int i = 0; i < n; i++)
        sample_end(&sample[i].sample);
}

static void render(const struct prepared *p, const struct tile_pass *pass)
{
    if (!((const struct mbdpt *)p->own)->by_pixel)
        together_render(p, pass, connect_all);
    else
        for (int i = 0; pass_goes_on(pass, i); i++)
            render_pixel(p, pass, i);
}

static void prepare(const struct render_job *job, struct prepared *p)
{
    (void)job;
    p->size.block = ((const struct mbdpt *)p->own)->by_pixel ? PIXEL_BLOCK : 0;
}

static const struct field PARAMETERS[] = {
    PARAMETER("pathpixels", FIELD_INTEGER, numbers.path_pixels, 2, 1, DEFAULT_TILE_SIZE * DEFAULT_TILE_SIZE,
              "pixels for each light sub-path", NULL),
    PARAMETER_CREDITS(false), PARAMETER_BOUND(false), PARAMETER_POINTS(1), PARAMETER_GUIDE(false),
    PARAMETER_EMISSION(1), PARAMETER_TILES(DEFAULT_TILE_SIZE, 1),
    {.name = NULL}};
static const struct field OWN[] = {
    {"key", FIELD_WORD, offsetof(struct mbdpt, throughput), 0, 0, 0, "what sub-paths are sorted by", KEYS},
    {"matrix", FIELD_WORD, offsetof(struct mbdpt, by_pixel), 0, 0, 0, "whose sub-paths are in one matrix", MATRICES},
    {.name = NULL}};

const struct method method_mbdpt = {
    .name = "mbdpt", .help = "matrix BDPT [Chaitanya 2018]: pairs of sorted sub-paths, stratified",
    .parameters = PARAMETERS, .own = OWN, .own_size = sizeof(struct mbdpt), .numbers = NUMBERS_OF_BDPT,
    .rr_threshold = DEFAULT_RR_THRESHOLD, .prepare = prepare,
    .build = build, .render = render};
