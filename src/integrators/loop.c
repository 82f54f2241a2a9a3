/* loop.c: see loop.h. */
#include "integrators/loop.h"

/* --- the pool ---------------------------------------------------------------------------------------- */

/* Of every so many iterations one is drawn. Were it always the same one, its eye sub-paths would never leave a part of
 * the pixel, for those are points of nets (sampler.h). */
bool loop_turn(const struct prepared *p, const struct tile_pass *pass, enum eye_end end, long iteration)
{
    const int *first = pass->tile->pixel[0], every = numbers_every(&p->numbers, end);
    struct sampler sampler = sample_stream(pass, RNG_TURN, first[0], first[1], (uint64_t)(iteration / every));
    return every == 1 || iteration % every == (long)(sampler_number(&sampler, DRAW_ORDER) * every);
}

/* Light sub-paths are numbered by their turns: every so-many-th point of a net is no net. */
static uint64_t number_of_turn(const struct prepared *p, long iteration)
{
    return (uint64_t)(iteration / numbers_every(&p->numbers, FIRST_HIT));
}

/* Trace the light sub-path of pixel (x,y). */
static void add_light_path(const struct prepared *p, const struct tile_pass *pass, int x, int y, long iteration)
{
    struct pool *pool = &pass->work->pool;
    struct vertex *path = pool_room(pool, (size_t)pass->job->max_depth + 1);
    pool_add(pool, sample_light_path(pass, &p->counts, x, y, number_of_turn(p, iteration), &pool->arena, path));
}

void loop_fill(const struct prepared *p, const struct tile_pass *pass, long iteration)
{
    pool_clear(&pass->work->pool);
    for (int i = 0, x, y; pass_pixel(pass, i, &x, &y); i += p->numbers.path_pixels)
        add_light_path(p, pass, x, y, iteration);
}

/* Fisher and Yates, from the inside out. [Durstenfeld 1964] */
void pool_shuffle(const struct pool *pool, const struct tile_pass *pass, long iteration, int *order)
{
    const int *first = pass->tile->pixel[0];
    struct sampler sampler = sample_stream(pass, RNG_SHUFFLE, first[0], first[1], (uint64_t)iteration);
    for (int i = 0; i < pool->n; i++) {
        /* at most i, since what is drawn is below 1 by more than rounding can add */
        int j = (int)(sampler_number(&sampler, DRAW_ORDER) * (i + 1));
        order[i] = order[j];
        order[j] = i;
    }
}

bool loop_own(const struct prepared *p, const struct index *index, struct sample *sample, int number,
              const struct vertex *z, int i, int n, struct drawn *out)
{
    const struct pool *pool = &sample->pass->work->pool;
    (void)p, (void)index, (void)number, (void)z, (void)i, (void)n;
    *out = (struct drawn){pool_path(pool, 0), 1, pool->length[0], 1};
    return true;
}

/* --- the loop ---------------------------------------------------------------------------------------- */

int loop_begin(const struct prepared *p, const struct tile_pass *pass, int x, int y, long iteration,
               struct sample *sample, struct vertex *eye)
{
    bool pairs = p->numbers.path_pixels > 0 && p->method->draw != NULL;
    *sample = sample_begin(pass, &p->counts, p->numbers.light_points, x, y, iteration);
    if (p->method->build != NULL)
        sample->choice = sample_stream(pass, RNG_SELECT, x, y, number_of_turn(p, iteration));
    return sample_eye_path(sample, eye, p->numbers.light_points > 0 || pairs ? pass->job->max_depth + 2 : 2);
}

void loop_eye(struct sample *sample, const struct vertex *eye, int n)
{
    for (int t = 2; t <= n; t++) {
        sample_hit(sample, eye, t);
        sample_direct(sample, &eye[t - 1], t);
    }
}

/* Add what z = z_{t-1} draws from the pool. */
static void join(const struct prepared *p, const struct index *index, struct sample *sample, int number,
                 const struct vertex *z, int t)
{
    int C = p->numbers.draws[z->eye_end], every = numbers_every(&p->numbers, z->eye_end);
    for (int i = 0; i < C && vertex_connectible(z); i++) {
        struct drawn drawn;
        if (p->method->draw(p, index, sample, number, z, i, C, &drawn))
            sample_pairs(sample, &drawn, z, t, every * 1.0 / (C * sample->pass->work->pool.n) / drawn.pmf);
    }
}

void loop_join(const struct prepared *p, const struct index *index, struct sample *sample, int number,
               const struct vertex *eye, int n)
{
    if (p->numbers.path_pixels > 0 && p->method->build == NULL) {
        pool_clear(&sample->pass->work->pool);
        add_light_path(p, sample->pass, sample->x, sample->y, sample->iteration);
    }
    int most = sample->pass->job->max_depth;
    bool later = loop_turn(p, sample->pass, LATER_HIT, sample->iteration);
    for (int t = 2; t <= n && t <= most && p->numbers.path_pixels > 0 && p->method->draw != NULL; t++)
        if (later || eye[t - 1].eye_end == FIRST_HIT)
            join(p, index, sample, number, &eye[t - 1], t);
}

/* The weights count one sub-path per path_pixels pixels of the film. A tile has K, which is rounded up: `scale` makes
 * up for the difference. */
void loop_splat(const struct prepared *p, struct sample *sample, int number)
{
    const struct pool *pool = &sample->pass->work->pool;
    bool shared = p->method->build != NULL;
    int each = p->numbers.path_pixels;
    if (each == 0 || number % each != 0)
        return;
    int k = shared ? number / each : 0;
    double pixels = shared ? sample->pass->tile->n_pixels : 1;
    sample_lens(sample, pool_path(pool, k), pool->length[k], pixels / ((double)pool->n * each));
}

void loop_render(const struct prepared *p, const struct tile_pass *pass)
{
    for (long iteration = pass->first; iteration < pass->end; iteration++) {
        const struct index *index = NULL;
        bool turn = loop_turn(p, pass, FIRST_HIT, iteration);
        if (turn && p->numbers.path_pixels > 0 && p->method->build != NULL) {
            loop_fill(p, pass, iteration);
            index = p->method->build(p, pass, iteration);
        }
        for (int i = 0, x, y; pass_pixel(pass, i, &x, &y); i++) {
            struct sample sample;
            arena_reset(&pass->work->arena);
            int n = loop_begin(p, pass, x, y, iteration, &sample, pass->work->eye);
            loop_eye(&sample, pass->work->eye, n);
            if (turn) {
                loop_join(p, index, &sample, i, pass->work->eye, n);
                loop_splat(p, &sample, i);
            }
            sample_end(&sample);
        }
    }
}
