/* restir.c: light points of the first hit are resampled, and shared with pixels nearby.
 *
 * Bitterli's reservoirs [Bitterli 2020] within one picture, without time. With f_i(y) the luminance of what light point
 * y, seen or not, would contribute at pixel i's first vertex (s = 1, t = 2):
 *  1. Each pixel draws M light points y with density p and keeps one in proportion to f_i / p [Talbot 2005]. If it is
 *     seen, it represents the light with the weight
 *         W_i = (1/f_i(y)) (1/M) sum f_i / p,    else W_i = 0:   E[h(y) W_i] = integral of h where f_i V_i > 0.
 *  2. Pixel c keeps one of its own reservoir and those of up to N pixels of the tile with a like surface, the set S,
 *     in proportion to f_c(y_j) W_j. Of the one kept, y from pixel s,
 *         X = w F_c(y) (m / f_c(y)) sum_j f_c(y_j) W_j,    m = f_s(y) V_s(y) / sum over k in S of f_k(y) V_k(y),
 *     since y could have come from any k that sees it. All N + 1 terms of m are tested for visibility, so X is exact;
 *     without that what neighbours do not see comes out too dark.
 * Given the weights w, E[X] = integral of w F_c; they are BDPT's, but that s = 1, t = 2 counts for several samples. All
 * other strategies are BDPT's, with the pixel's own light sub-path. With M = 1, N = 0 and a worth of 1 the method is
 * BDPT except for the order in which it adds.
 *
 * Densities cancel in f / p, so p is never asked for: f stands for f / p below, p being that of the pixel that drew y.
 * A guide may have another p in each. M says how many light points there are.
 *
 * Tests: test_rivals.c.
 */
#include "caustics/surfaces.h"
#include "rivals/together.h"

struct restir {
    int candidates, neighbours; /* M, N */
    double credit;
};

struct reservoir {
    struct lit y;
    double weight; /* W; 0: nothing has been kept */
};

/* f_i(y) for the reservoir's point seen from another pixel's first vertex. */
static double value_at(const struct scene *scene, const struct vertex *z, const struct reservoir *from, struct lit *out)
{
    return connect_light(scene, z, &from->y.at, from->y.pdf, out) ? rgb_luminance(out->value) : 0;
}

/* Step 1. */
static struct reservoir resample(struct pixel *p, int M)
{
    struct reservoir r = {.weight = 0};
    double sum = 0, own = 0;
    bool surface = p->n >= 2 && p->sample.eye[1].kind == VERTEX_SURFACE;
    for (int m = 0; surface && m < M; m++) {
        struct light_point at;
        struct lit y;
        bool lit = lit_draw(&p->sample, &p->sample.eye[1], &p->sample.sampler, m, M, &at, &y);
        double f = lit ? rgb_luminance(y.value) : 0;
        sum += f;
        if (f > 0 && sampler_number(&p->sample.choice, DRAW_ORDER) * sum < f) {
            r.y = y;
            own = f;
        }
    }
    if (own > 0 && reuse_sees(p->sample.pass->job->scene, &r.y))
        r.weight = sum / (M * own);
    return r;
}

/* Step 2. near: S, [n] numbers of pixels, the first this one. */
static void reuse(struct pixel *pixel, const struct reservoir *all, const int *near, int n)
{
    struct pixel *c = &pixel[near[0]];
    const struct scene *scene = c->sample.pass->job->scene;
    struct lit kept = {.z = NULL}, l;
    double sum = 0, own = 0, others = 0;
    int from = 0;
    for (int j = 0; j < n; j++) {
        const struct reservoir *r = &all[near[j]];
        double f = r->weight > 0 ? value_at(scene, &c->sample.eye[1], r, &l) : 0;
        sum += f * r->weight;
        if (f > 0 && sampler_number(&c->sample.choice, DRAW_ORDER) * sum < f * r->weight) {
            kept = l;
            own = f;
            from = j;
        }
    }
    if (!(own > 0))
        return;
    for (int k = 0; k < n; k++) {
        double f = value_at(scene, &pixel[near[k]].sample.eye[1], &all[near[from]], &l);
        others += f > 0 && reuse_sees(scene, &l) ? f : 0;
    }
    double m = value_at(scene, &pixel[near[from]].sample.eye[1], &all[near[from]], &l) / others;
    struct connection made = connect_lit(scene, c->sample.pass->counts, &kept);
    const struct vertex y = light_vertex(scene, c->sample.pass->counts, &kept.at);
    sample_add(&c->sample, (struct joined){.s = 1, .t = 2, .path = &y, .z = &c->sample.eye[1], .c = &made, .pmf = 1,
                                           .scale = m * sum / own});
}

/* All vertices of the pixel's own light sub-path. */
static void join_own(struct pixel *pixel)
{
    struct sample *sample = &pixel->sample;
    const struct tile_pass *pass = sample->pass;
    struct arena *arena = &pass->work->pool.arena;
    arena_reset(arena);
    struct vertex *light = arena_alloc(arena, ((size_t)pass->job->max_depth + 1) * sizeof *light);
    int n = sample_light_path(pass, sample->i, (uint64_t)sample->iteration, arena, light);
    for (int t = 2; t <= pixel->n; t++)
        if (vertex_connectible(&pixel->sample.eye[t - 1]))
            sample_pairs(sample, &(struct drawn){light, 1, n, 1}, t, 1);
    sample_lens(sample, light, n, 1);
}

static void connect_all(const struct prepared *p, const struct tile_pass *pass, const struct cache *cache,
                        struct pixel *pixel, int n)
{
    const struct restir *own = p->own;
    struct reservoir *all = arena_alloc(&pass->work->arena, (size_t)n * sizeof *all);
    (void)cache;
    for (int i = 0; i < n; i++) {
        all[i] = resample(&pixel[i], own->candidates);
        for (int t = 2; t <= pixel[i].n; t++) {
            sample_s0(&pixel[i].sample, t);
            if (t > 2)
                sample_s1(&pixel[i].sample, t);
        }
    }
    for (int i = 0; i < n; i++) {
        if (pass_cancelled(pass))
            return;
        int near[MOST_NEIGHBOURS + 1], found = reuse_neighbours(pixel, n, i, own->neighbours, near);
        if (found > 0)
            reuse(pixel, all, near, found);
        join_own(&pixel[i]);
    }
}

static void render(const struct prepared *p, const struct tile_pass *pass)
{
    struct counts counts = p->counts;
    struct tile_pass counted = *pass;
    counts.s1[FIRST_HIT] = ((const struct restir *)p->own)->credit;
    counted.counts = &counts;
    together_render(p, &counted, connect_all);
}

#define AT(member) offsetof(struct restir, member)
static const struct field OWN[] = {
    {"candidates", FIELD_INTEGER, AT(candidates), 8, 1, 1024, "light points of which a pixel keeps one", NULL},
    {"neighbours", FIELD_INTEGER, AT(neighbours), 5, 0, MOST_NEIGHBOURS, "pixels whose light points it shares",
     NULL},
    {"worth", FIELD_NUMBER, AT(credit), 4, 1e-3, 1e6, "samples that one kept counts for in the weights", NULL},
    {.name = NULL}};
static const struct field PARAMETERS[] = {
    PARAMETER_GUIDE(false), PARAMETER_EMISSION(1), PARAMETER_TILES(MAX_TILE_SIZE, 1),
    {.name = NULL}};

const struct method method_restir = {
    .name = "restir", .check = surfaces_alone,
    .help = "reservoirs [Bitterli 2020]: light points resampled, and shared with pixels nearby",
    .parameters = PARAMETERS, .own = OWN, .own_size = sizeof(struct restir), .numbers = NUMBERS_OF_BDPT,
    .rr_threshold = DEFAULT_RR_THRESHOLD, .render = render};
