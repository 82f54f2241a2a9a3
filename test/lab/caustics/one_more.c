/* one_more.c: see one_more.h. */
#include "caustics/one_more.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "render/methods.h"

const char *const ONE_MORE_METHODS[] = {"bdpt", "pt", "asbdpt", NULL};

/* --- a sample ---------------------------------------------------------------------------------------- */

static void weigh_again(const struct one_more *more, const struct pixel_sample *sample, struct arena *arena,
                        const struct vertex *path, int s, int t, struct connection *c)
{
    if (more->weigh != NULL && !rgb_is_black(c->value))
        more->weigh(more, sample, arena, path, s, t, c);
}

static void sum_more(struct pixel_sample *sample, struct arena *arena, const struct one_more *more,
                     const struct vertex *eye, int t)
{
    struct one_more_path made[ONE_MORE_MOST];
    int n = more->connect(more, sample, arena, eye, t, made);
    for (int i = 0; i < n; i++)
        pixel_add(sample, &made[i].c, 1, t + made[i].passed, NULL, &eye[t - 1], NO_CHOICE);
}

static void sum_direct(struct pixel_sample *sample, struct arena *arena, const struct one_more *more,
                       const struct vertex *eye, int t)
{
    const struct vertex *z = &eye[t - 1];
    int n = z->eye_end == FIRST_HIT ? sample->light_points : 1;
    const struct choice each = {1, 1.0 / n};
    for (int i = 0; i < n; i++) {
        struct connection c = connect_direct(sample->scene, sample->counts, z, &sample->sampler, i, n);
        weigh_again(more, sample, arena, eye, 1, t, &c);
        pixel_add(sample, &c, 1, t, NULL, z, each);
    }
}

void one_more_sum_eye(struct pixel_sample *sample, struct arena *arena, const struct one_more *more,
                      const struct vertex *eye, int n)
{
    for (int t = 2; t <= n; t++) {
        const struct vertex *z = &eye[t - 1];
        struct connection c = connect_hit(sample->scene, sample->counts, z - 1, z, t);
        weigh_again(more, sample, arena, eye, 0, t, &c);
        pixel_add(sample, &c, 0, t, NULL, z, NO_CHOICE);
        if (z->kind == VERTEX_SURFACE && t <= sample->max_depth + 1) {
            sum_direct(sample, arena, more, eye, t);
            sum_more(sample, arena, more, eye, t);
        }
    }
}

/* As pixel_splat_path. */
static void splat(struct pixel_sample *sample, struct arena *arena, const struct one_more *more,
                  const struct vertex *light, int n_light, double scale)
{
    for (int s = 2; s <= n_light && s <= sample->max_depth + 1; s++) {
        struct connection c = connect_lens(sample->scene, sample->counts, light, s, &sample->sampler);
        weigh_again(more, sample, arena, light, s, 1, &c);
        pixel_splat(sample, &c, s, &light[s - 1], scale / sample->counts->splat);
    }
}

static void render_alone(const struct frozen *f, const struct one_more *more, const struct tile_pass *pass, int x,
                         int y, long iteration)
{
    struct workspace *work = pass->work;
    const struct mis_counts *counts = &f->counts;
    arena_reset(&work->arena);
    struct pixel_sample sample = pixel_sample_begin(pass, counts, x, y, iteration);
    int n_eye = pixel_eye_path(pass, &sample, work->eye, sample.max_depth + 2), n_light = 0;
    if (counts->splat > 0)
        n_light = pixel_light_path(pass, counts, x, y, (uint64_t)iteration, &work->arena, work->light);
    one_more_sum_eye(&sample, &work->arena, more, work->eye, n_eye);
    if (counts->connect[FIRST_HIT] > 0)
        pixel_sum_pairs(&sample, work->eye, n_eye, work->light, n_light, NO_CHOICE);
    splat(&sample, &work->arena, more, work->light, n_light, 1);
    pixel_sample_end(&sample);
}

static void render_shared(const struct preparation *m, const struct one_more *more, const struct tile_pass *pass, int x,
                          int y, int number, long iteration)
{
    arena_reset(&pass->work->arena);
    struct pooled_pixel p = pooled_begin(m, pass, x, y, number, iteration);
    one_more_sum_eye(&p.sample, &pass->work->arena, more, p.eye, p.n);
    pooled_connect(m, pass, &p);
    if (p.light != NULL)
        splat(&p.sample, &pass->work->arena, more, p.light, p.n_light, p.scale);
    pixel_sample_end(&p.sample);
}

void one_more_render(const struct preparation *m, const struct one_more *more, const struct tile_pass *pass)
{
    bool shared = m->method->draw != NULL || m->method->connect != NULL;
    for (long iteration = pass->first; iteration < pass->end; iteration++) {
        if (shared)
            pooled_fill(m, pass, iteration);
        for (int i = 0, x, y; pass_pixel(pass, i, &x, &y); i++)
            if (shared)
                render_shared(m, more, pass, x, y, i, iteration);
            else
                render_alone(m->state, more, pass, x, y, iteration);
    }
}

/* --- rows -------------------------------------------------------------------------------------------- */

/* A method that is at its usual parameters is never refused. */
void one_more_prepare(const struct render_job *job, struct preparation *out)
{
    struct one_more_state *s = out->state;
    const struct settings usual = {0};
    struct render_job other = *job;
    struct error err;
    s->scene = *job->scene;
    s->scene.settings = usual;
    other.scene = &s->scene;
    bool ok = method_prepare(method_find(ONE_MORE_METHODS[s->with], &usual, &err), &other, &s->method, &err);
    assert(ok);
    (void)ok;
    out->size = s->method.size;
    memcpy(out->number, s->method.number, sizeof out->number);
}

const struct mis_counts *one_more_counts(const struct one_more_state *s)
{
    return &((const struct frozen *)s->method.state)->counts;
}

void one_more_release(void *state)
{
    struct one_more_state *s = state;
    method_release(&s->method);
}

/* The other method finds its own scratch in the workspace. */
void one_more_pass(const struct preparation *m, const struct tile_pass *pass)
{
    const struct one_more_state *s = m->state;
    struct one_more_scratch *scratch = pass->work->scratch;
    pass->work->scratch = scratch->own;
    if (s->more != NULL)
        one_more_render(&s->method, s->more, pass);
    else
        s->method.method->render(&s->method, pass);
    pass->work->scratch = scratch;
}

void one_more_scratch(void *scratch, const void *state)
{
    const struct one_more_state *s = state;
    struct one_more_scratch *out = scratch;
    out->method = &s->method;
    out->own = method_scratch(&s->method);
}

void one_more_scratch_free(void *scratch)
{
    struct one_more_scratch *s = scratch;
    method_scratch_free(s->method, s->own);
}
