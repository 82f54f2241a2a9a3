/* loop.c: see loop.h. */
#include "integrators/loop.h"

/* Fisher and Yates, from the inside out. [Durstenfeld 1964] */
void pool_shuffle(const struct pool *pool, const struct tile_pass *pass, long iteration, int *order)
{
    const int *corner = pass->tile->pixel[0];
    struct sampler sampler = sample_stream(pass, RNG_SHUFFLE, corner[0], corner[1], (uint64_t)iteration);
    for (int i = 0; i < pool->n; i++) {
        /* at most i, since what is drawn is below 1 by more than rounding can add */
        int j = (int)(sampler_number(&sampler, DRAW_ORDER) * (i + 1));
        order[i] = order[j];
        order[j] = i;
    }
}

/* Of every so many iterations one is drawn. Were it always the same one, its eye sub-paths would never leave a part of
 * the pixel, for those are points of nets (sampler.h). */
bool loop_turn(const struct prepared *p, const struct tile_pass *pass, long iteration)
{
    const int *corner = pass->tile->pixel[0], every = numbers_every(&p->numbers);
    struct sampler sampler = sample_stream(pass, RNG_TURN, corner[0], corner[1], (uint64_t)(iteration / every));
    return iteration % every == (long)(sampler_number(&sampler, DRAW_ORDER) * every);
}

/* Light sub-paths are numbered by their turns: every so-many-th point of a net is no net. */
static uint64_t number_of_turn(const struct prepared *p, long iteration)
{
    return (uint64_t)(iteration / numbers_every(&p->numbers));
}

void loop_fill(const struct prepared *p, const struct tile_pass *pass, long iteration)
{
    struct pool *pool = &pass->work->pool;
    pool_clear(pool);
    if (p->numbers.path_pixels == 0 || !loop_turn(p, pass, iteration))
        return;
    for (int i = 0; pass_goes_on(pass, i); i += p->numbers.path_pixels) {
        struct vertex *path = pool_room(pool, (size_t)pass->job->max_depth + 1);
        pool_add(pool, sample_light_path(pass, i, number_of_turn(p, iteration), &pool->arena, path));
    }
}

int loop_begin(const struct prepared *p, const struct tile_pass *pass, int i, long iteration, struct sample *sample)
{
    *sample = sample_begin(pass, i, iteration);
    if (pass->work->pool.n > 0) /* else nothing is chosen */
        sample->choice = sample_stream(pass, RNG_SELECT, sample->x, sample->y, number_of_turn(p, iteration));
    return sample_eye_path(sample, pass->job->max_depth + 2);
}

/* The weights count one sub-path per path_pixels pixels of the film. A tile has K, which is rounded up: `scale` makes
 * up for the difference. */
void loop_splat(const struct prepared *p, struct sample *sample)
{
    const struct pool *pool = &sample->pass->work->pool;
    const int each = p->numbers.path_pixels;
    if (pool->n == 0 || sample->i % each != 0)
        return;
    const int k = sample->i / each;
    sample_lens(sample, pool_path(pool, k), pool->length[k], sample->pass->tile->n_pixels / ((double)pool->n * each));
}
