/* cbdpt.c: combinatorial BDPT: every eye sub-path is connected with M light sub-paths in all pairs.
 *
 * Combinatorial BDPT [Pajot 2011] traces sets of eye and of light sub-paths and connects every one of the first to
 * every one of the second. Here the sets are those of a tile and iteration with its K light sub-paths, of which the eye
 * sub-path of pixel p, in row order, takes M:
 *     pi(p M + m mod K),   m = 0 .. M-1,   pi a random permutation,
 * so that all are used equally often, none twice by one pixel, and pixels that share some, and err alike, lie anywhere
 * in the tile. The mean over the M of BDPT's sum of pairs,
 *     (1/M) sum_m sum_{s,t} w F(y_{s-1} of sub-path m, z_{t-1}),
 * has BDPT's expectation, since each is. The strategies s >= 2, t >= 2 take M samples per pixel, their count, though
 * these share the eye sub-path. s = 0, s = 1 and t = 1 stay as they are, every pooled sub-path being splat once.
 *
 * With more connections than sub-paths M is K, which is all there is to connect. With M = 1 pi is the identity, and the
 * method is BDPT to the byte.
 *
 * Tests: test_asbdpt.c.
 */
#include <stddef.h>

#include "integrators/pooled.h"
#include "rivals/plain.h"

struct cbdpt_state {
    struct frozen frozen;
    int connections; /* M */
};

struct cbdpt {
    struct light_pool pool; /* the first, see pooled.h */
    int order[MAX_TILE_SIZE * MAX_TILE_SIZE]; /* pi */
};

static void begin(void *scratch, const void *state, const struct tile_pass *pass, long iteration)
{
    struct cbdpt *c = scratch;
    const struct cbdpt_state *s = state;
    light_pool_shuffle(&c->pool, pass, iteration, c->order);
    for (int k = 0; s->connections == 1 && k < c->pool.n; k++)
        c->order[k] = k;
}

static void connect(void *scratch, const void *state, struct pooled_pixel *p)
{
    struct cbdpt *c = scratch;
    const struct cbdpt_state *s = state;
    int K = c->pool.n, M = s->connections < K ? s->connections : K;
    const struct choice choice = {1.0 / K, 1.0 / M};
    for (int m = 0; m < M; m++) {
        int k = c->order[(p->number * M + m) % K];
        pixel_sum_pairs(&p->sample, p->eye, p->n, light_pool_path(&c->pool, k), c->pool.length[k], choice);
    }
}

static void prepare(const struct render_job *job, struct preparation *out)
{
    struct cbdpt_state *s = out->state;
    s->frozen.numbers.draws[FIRST_HIT] = s->frozen.numbers.draws[LATER_HIT] = s->connections;
    plain_prepare(job, out);
}

#define AT(member) offsetof(struct cbdpt_state, member)
static const struct field PARAMETERS[] = {
    {"connections", FIELD_INTEGER, AT(connections), 2, 1, 1024, "light sub-paths for each pixel", NULL},
    {"pathpixels", FIELD_INTEGER, AT(frozen.numbers.path_pixels), 1, 1, DEFAULT_TILE_SIZE * DEFAULT_TILE_SIZE,
     "pixels for each light sub-path", NULL},
    SERVICES(false, 1, 1, DEFAULT_TILE_SIZE, 1),
    {.name = NULL}};

const struct method method_cbdpt = {
    .name = "cbdpt", .help = "combinatorial BDPT [Pajot 2011]: all pairs with M of a tile's light sub-paths",
    .why = "M of the tile's K light sub-paths, in random order, all used equally often; scale 1 / M",
    .parameters = PARAMETERS,
    .state_size = sizeof(struct cbdpt_state), .scratch_size = sizeof(struct cbdpt),
    .numbers = {.light_points = 1, .path_tracing = true}, .rr_threshold = DEFAULT_RR_THRESHOLD, .prepare = prepare,
    .render = pooled_render,
    .scratch_free = light_pool_free,
    .begin = begin, .connect = connect};
