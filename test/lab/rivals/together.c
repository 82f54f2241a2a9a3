/* together.c: see together.h. */
#include "rivals/together.h"

#include <string.h>

#include "caustics/derived.h"

struct pixel together_begin(const struct prepared *p, const struct tile_pass *pass, int i, long iteration)
{
    struct pixel pixel;
    struct sample *sample = &pixel.sample;
    pixel.n = loop_begin(p, pass, i, iteration, sample);
    sample->choice = sample_stream(pass, RNG_SELECT, sample->x, sample->y, (uint64_t)iteration);
    size_t size = (size_t)pixel.n * sizeof *sample->eye;
    sample->eye = memcpy(arena_alloc(&pass->work->arena, size), pass->work->eye, size);
    return pixel;
}

static void render_iteration(const struct prepared *p, const struct tile_pass *pass, connect_all_fn *connect_all,
                             long iteration)
{
    struct arena *arena = &pass->work->arena;
    const struct cache *cache = NULL;
    int n = 0;
    if (p->method->build != NULL) {
        loop_fill(p, pass, iteration);
        cache = p->method->build(p, pass, iteration);
    }
    arena_reset(arena);
    struct pixel *all = arena_alloc(arena, (size_t)pixels_count(pass->tile->pixels) * sizeof *all);
    for (; pass_goes_on(pass, n); n++)
        all[n] = together_begin(p, pass, n, iteration);
    connect_all(p, pass, cache, all, n);
    for (int i = 0; i < n; i++)
        sample_end(&all[i].sample);
}

void together_render(const struct prepared *p, const struct tile_pass *pass, connect_all_fn *connect_all)
{
    for (long iteration = pass->first; iteration < pass->end; iteration++)
        render_iteration(p, pass, connect_all, iteration);
}

/* --- what others have found -------------------------------------------------------------------------- */

/* Normals within 25 degrees, depths within a tenth. */
static bool alike(const struct vertex *a, const struct vertex *b)
{
    double da = length(sub(a[1].p, a[0].p)), db = length(sub(b[1].p, b[0].p));
    return dot(a[1].ng, b[1].ng) > 0.9063 && fabs(da - db) < 0.1 * fmax(da, db);
}

/* A number from `from - NEAR` to `from + NEAR`, of those in [0, n). */
static int near_to(struct sampler *sampler, int from, int n)
{
    int low = from > NEAR ? from - NEAR : 0, high = from + NEAR < n ? from + NEAR : n - 1;
    return low + (int)(sampler_number(sampler, DRAW_LIGHT_END) * (high - low + 1));
}

int reuse_neighbours(struct pixel *pixel, int n, int i, int tries, int *near)
{
    int found = 0, columns = pixels_columns(pixel[i].sample.pass->tile->pixels), rows = (n + columns - 1) / columns;
    if (!reuse_first(&pixel[i]))
        return 0;
    near[found++] = i;
    for (int k = 0; k < tries; k++) {
        struct sampler *choice = &pixel[i].sample.choice;
        int x = near_to(choice, i % columns, columns), j = x + columns * near_to(choice, i / columns, rows);
        if (j != i && j < n && reuse_first(&pixel[j]) && alike(pixel[i].sample.eye, pixel[j].sample.eye))
            near[found++] = j;
    }
    return found;
}

/* Of a delta step: channels to which nothing has come so far have what all delta lobes of that side make of the
 * direction; to that, too, the walk's roulette belongs. */
static rgb delta_step(const struct vertex *z, const struct vertex *next)
{
    const rgb *b = &z->beta, *a = &next->beta;
    bool passed = dot(next->wo, z->bsdf.shading.n) * dot(z->wo, z->bsdf.shading.n) > 0;
    struct bsdf_sample s;
    rgb guess = bsdf_delta(&z->bsdf, z->wo, passed, RADIANCE, &s) ? s.f : rgb_black();
    double most = rgb_max(rgb_mul(*b, guess));
    guess = rgb_scale(guess, most > 0 ? rgb_max(*a) / most : 0);
    rgb factor = {b->r > 0 ? a->r / b->r : guess.r, b->g > 0 ? a->g / b->g : guess.g, b->b > 0 ? a->b / b->b : guess.b};
    return factor;
}

rgb reuse_step(const struct vertex *z, const struct vertex *next, double *roulette)
{
    vec3 w = neg(next->wo);
    *roulette = 1;
    if (next->prev_delta)
        return delta_step(z, next);
    struct bsdf_value b = bsdf_eval(&z->bsdf, z->wo, w, RADIANCE);
    rgb factor = rgb_scale(b.f, scatter_cosine(z, w, RADIANCE) / b.pdf);
    *roulette = rgb_max(next->beta) / rgb_max(rgb_mul(z->beta, factor));
    return rgb_scale(factor, *roulette);
}

struct connection reuse_hit(const struct sample *sample, const struct vertex *prev, const struct vertex *z, rgb beta)
{
    struct vertex at = z->lamp != NULL ? *z->lamp : *z;
    at.lamp = NULL;
    at.beta = beta;
    return connect_s0(sample->pass->job->scene, sample->pass->counts, prev, &at);
}

void reuse_prepare(const struct render_job *job, struct prepared *p)
{
    (void)job;
    p->size.tile = MAX_TILE_SIZE;
}
