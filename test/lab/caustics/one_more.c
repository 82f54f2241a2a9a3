/* one_more.c: see one_more.h. */
#include "caustics/one_more.h"

#include <assert.h>
#include <string.h>

#include "caustics/derived.h"
#include "caustics/joint.h"
#include "integrators/prepare.h"
#include "render/job.h"

const char *const ONE_MORE_METHODS[] = {"bdpt", "pt", "asbdpt", NULL};

/* --- a sample ---------------------------------------------------------------------------------------- */

static void weigh_again(const struct one_more *more, const struct sample *sample, struct joined *j, vec3 lens,
                        struct connection *c)
{
    j->c = c;
    if (more->weigh != NULL && !rgb_is_black(c->value))
        more->weigh(more, sample, j, lens, c);
}

/* The eye sub-path's first t vertices with those that were passed behind them. */
static const struct vertex *whole(const struct sample *sample, const struct vertex *eye, int t,
                                  const struct one_more_path *made)
{
    size_t n = (size_t)(t + made->n_passed);
    struct vertex *path = arena_alloc(&sample->pass->work->arena, n * sizeof *path);
    memcpy(path, eye, (size_t)t * sizeof *path);
    memcpy(path + t, made->passed, (size_t)made->n_passed * sizeof *path);
    return path;
}

static void sum_more(struct sample *sample, const struct one_more *more, const struct vertex *eye, int t)
{
    struct one_more_path made[ONE_MORE_MOST];
    int n = more->connect(more, sample, eye, t, made);
    for (const struct one_more_path *m = made; m < made + n; m++) {
        int length = t + m->n_passed;
        bool told = m->n_passed > 0 && sample->pass->observer != NULL;
        const struct vertex *path = told ? whole(sample, eye, t, m) : eye;
        const struct vertex y = light_vertex(sample->pass->job->scene, sample->pass->counts, &m->y0);
        sample_add(sample, (struct joined){.s = 1, .t = length, .path = &y, .c = &m->c, .pmf = 1, .scale = 1,
                                           .z = told ? &path[length - 1] : &eye[t - 1]});
    }
}

static void sum_direct(struct sample *sample, const struct one_more *more, int t)
{
    const struct vertex *z = &sample->eye[t - 1];
    int n = sample->pass->counts->light_points[z->eye_hit];
    for (int i = 0; i < n; i++) {
        struct vertex y;
        struct connection c = connect_s1(sample->pass->job->scene, sample->pass->counts, z, &sample->sampler, i, n, &y);
        struct joined j = {.s = 1, .t = t, .path = y.light < 0 ? NULL : &y, .z = z, .pmf = 1, .scale = 1.0 / n};
        weigh_again(more, sample, &j, z->p, &c);
        sample_add(sample, j);
    }
}

void one_more_sum_eye(struct sample *sample, const struct one_more *more, int n)
{
    const struct render_job *job = sample->pass->job;
    const struct vertex *eye = sample->eye;
    for (int t = 2; t <= n; t++) {
        const struct vertex *z = &eye[t - 1];
        struct connection c = connect_s0(job->scene, sample->pass->counts, z - 1, z);
        struct joined j = {.t = t, .z = z, .pmf = 1, .scale = 1};
        weigh_again(more, sample, &j, z->p, &c);
        sample_add(sample, j);
        if (z->kind == VERTEX_SURFACE && t <= job->max_depth + 1) {
            sum_direct(sample, more, t);
            sum_more(sample, more, eye, t);
        }
    }
}

/* As sample_lens. */
static void sum_lens(struct sample *sample, const struct one_more *more, const struct vertex *light, int n,
                     double scale)
{
    const struct render_job *job = sample->pass->job;
    for (int s = 2; s <= n && s <= job->max_depth + 1; s++) {
        vec3 lens = lens_drawn(&job->scene->camera, light[s - 1].p, sample->sampler);
        double raster[2];
        struct connection c = connect_lens(job->scene, sample->pass->counts, &light[s - 1], &sample->sampler, raster);
        struct joined j = {.s = s, .t = 1, .path = light, .px = raster[0], .py = raster[1], .pmf = 1,
                           .scale = scale / sample->pass->counts->lens};
        weigh_again(more, sample, &j, lens, &c);
        sample_splat(sample, j);
    }
}

/* --- a tile pass, as in loop.c, except one_more_sum_eye and sum_lens ---------------------------------- */

/* Those of every path_pixels-th of n pixels from number `first` on. */
static void fill_pool(const struct prepared *p, const struct tile_pass *pass, int first, int n, long iteration)
{
    struct pool *pool = &pass->work->pool;
    pool_clear(pool);
    for (int i = first; i < first + n; i += p->numbers.path_pixels) {
        struct vertex *path = pool_room(pool, (size_t)pass->job->max_depth + 1);
        pool_add(pool, sample_light_path(pass, i, (uint64_t)iteration, &pool->arena, path));
    }
}

static void join(const struct prepared *p, const struct cache *cache, struct sample *sample, const struct vertex *z,
                 int t)
{
    int C = p->numbers.draws[z->eye_hit];
    for (int i = 0; i < C && t <= sample->pass->job->max_depth && vertex_connectible(z); i++) {
        struct drawn drawn;
        if (p->method->draw(p, cache, sample, z, i, C, &drawn))
            sample_pairs(sample, &drawn, t, 1 / (C * sample->pass->work->pool.n * drawn.pmf));
    }
}

static void render_pixel(const struct prepared *p, const struct one_more *more, const struct tile_pass *pass,
                         const struct cache *cache, int i, long iteration)
{
    struct pool *pool = &pass->work->pool;
    bool shared = p->method->build != NULL;
    int each = p->numbers.path_pixels, at = shared ? i : 0, pixels = shared ? pass->tile->n_pixels : 1;
    arena_reset(&pass->work->arena);
    if (!shared && each > 0)
        fill_pool(p, pass, i, 1, iteration);
    struct sample sample;
    int n = loop_begin(p, pass, i, iteration, &sample);
    one_more_sum_eye(&sample, more, n);
    for (int t = 2; t <= n && each > 0; t++)
        if (shared)
            join(p, cache, &sample, &sample.eye[t - 1], t);
        else if (p->numbers.draws[FIRST_HIT] > 0 && vertex_connectible(&sample.eye[t - 1]))
            sample_pairs(&sample, &(struct drawn){pool_path(pool, 0), 1, pool->length[0], 1}, t, 1);
    if (each > 0 && at % each == 0) {
        int k = at / each;
        sum_lens(&sample, more, pool_path(pool, k), pool->length[k], pixels / ((double)pool->n * each));
    }
    sample_end(&sample);
}

void one_more_render(const struct prepared *p, const struct one_more *more, const struct tile_pass *pass)
{
    bool shared = p->method->build != NULL && p->numbers.path_pixels > 0;
    for (long iteration = pass->first; iteration < pass->end; iteration++) {
        const struct cache *cache = NULL;
        if (shared) {
            fill_pool(p, pass, 0, pass->tile->n_pixels, iteration);
            cache = p->method->build(p, pass, iteration);
        }
        for (int i = 0; pass_goes_on(pass, i); i++)
            render_pixel(p, more, pass, cache, i, iteration);
    }
}

/* --- rows -------------------------------------------------------------------------------------------- */

/* A method that is at its usual parameters is never refused. Its light sub-paths are traced in each iteration (above),
 * so the weights count them in each, whoever has won a race. */
void one_more_prepare(const struct render_job *job, struct prepared *p)
{
    struct one_more_own *own = p->own;
    const struct settings usual = {0};
    struct render_job other = *job;
    struct error err;
    own->scene = *job->scene;
    own->scene.settings = usual;
    other.scene = &own->scene;
    bool ok = method_read(method_find(ONE_MORE_METHODS[own->with], &usual, &err), &own->scene, &own->method, &err);
    assert(ok);
    (void)ok;
    method_prepare(&other, &own->method);
    own->method.numbers.every = 1;
    method_settle(&other, &own->method);
    p->size = own->method.size;
    p->numbers = own->method.numbers;
    p->tables->regions.n = own->method.tables->regions.n;
}

void one_more_release(struct prepared *p) { method_release(&((struct one_more_own *)p->own)->method); }

void one_more_pass(const struct prepared *p, const struct tile_pass *pass)
{
    const struct one_more_own *own = p->own;
    struct tile_pass inner = *pass;
    inner.counts = &own->method.counts;
    if (own->more != NULL)
        one_more_render(&own->method, own->more, &inner);
    else
        own->method.method->render(&own->method, &inner);
}
