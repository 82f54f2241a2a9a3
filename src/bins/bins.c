/* bins.c: `select = bins`: the dissertation's estimator, kept as it was written.              [S24 Algorithms 1 and 2]
 *
 * Every pixel owns `binpaths` light sub-paths, divided into bins of two. In each iteration the method chooses one bin,
 * and takes its first element with probability
 *     p_e0 = beta_0^2 / (beta_0^2 + beta_1^2),                                                        [S24 eq. 3.1]
 * otherwise the second. beta is the mean over RGB of the throughput at the last vertex of the sub-path. The method
 * connects the element to the pixel's eye sub-path exactly as in BDPT, without another weight, and replaces it by a new
 * sub-path. It also replaces elements older than `maxage` iterations, without using them. After `restart` iterations (a
 * block) it discards all bins.
 *
 * Choices that the text leaves open: Algorithm 2 prints the comparison of the random number with p_e0 the other way
 * round. By default we follow the text (`order = text`: take e0 if u < p_e0); `order = printed` exchanges the two. An
 * empty sub-path has beta 0, and two zeros give 1/2. The method visits bins in the order of the van der Corput
 * sequence, from a random start for each pixel and block.
 *
 * This estimator is BIASED: sub-paths of low beta, which are rarely used, are often discarded (doc/dissertation.md).
 *
 * Tests: test_asbdpt.c (must be rejected by the test that accepts BDPT), test_bins.c (the predicted bias).
 */
#include <limits.h>
#include <stdlib.h>

#include "base/number.h"
#include "integrators/method.h"

/* Algorithm 2's comparison, as the text around it says or as it is printed. */
enum order { ORDER_TEXT, ORDER_PRINTED };
static const char *const ORDERS[] = {"text", "printed", NULL};

/* Parameters. */
struct bins_parameters {
    int bin_paths, max_age, restart, order;
};

struct element {
    struct arena arena;    /* of its vertices and their lobes */
    struct vertex *vertex; /* [max_depth + 1] */
    int length;            /* 0: nothing was emitted */
    double beta;           /* see [S24 eq. 3.1] */
    long born;             /* iteration in which it was traced */
};

/* The bins of one pixel in one block; bin b has the elements 2b and 2b+1. */
struct pixel {
    const struct tile_pass *pass;
    const struct bins_parameters *own;
    struct element *element; /* [bin_paths], owned */
    uint64_t traced;         /* sub-paths so far */
    int i;                   /* of the pixel in its tile */
};

/* Trace a new sub-path for element e. The number of its random stream is made of the block's first iteration and of the
 * order of tracing within the block. An iteration traces at most binpaths + 1 <= 2^13 sub-paths, so the numbers of a
 * block stay below those of the next. Consecutive numbers would be points of one net, which avoid each other, and so
 * would the elements of a bin: the hash, a bijection, makes them independent. */
static void replace(struct pixel *p, struct element *e, long iteration)
{
    uint64_t number = hash_mix(((uint64_t)p->pass->first << 32) + p->traced++);
    arena_reset(&e->arena);
    e->vertex = arena_alloc(&e->arena, ((size_t)p->pass->job->max_depth + 1) * sizeof *e->vertex);
    e->length = sample_light_path(p->pass, p->i, number, &e->arena, e->vertex);
    e->beta = path_throughput(e->vertex, e->length);
    e->born = iteration;
}

static void replace_aged(struct pixel *p, long iteration)
{
    for (int i = 0; p->own->max_age > 0 && i < p->own->bin_paths; i++)
        if (iteration - p->element[i].born > p->own->max_age)
            replace(p, &p->element[i], iteration);
}

/* Van der Corput's sequence: the bits of i, mirrored at the binary point. [Corput 1935] */
static double van_der_corput(uint64_t i)
{
    double value = 0, digit = 0.5;
    for (; i > 0; i >>= 1, digit /= 2)
        if (i & 1)
            value += digit;
    return value;
}

/* p_e0 of the bin with the elements e[0] and e[1]. [S24 eq. 3.1] */
static double first_probability(const struct element *e)
{
    double b0 = sqr(e[0].beta), b1 = sqr(e[1].beta);
    return b0 + b1 > 0 ? b0 / (b0 + b1) : 0.5;
}

/* Choose a bin, then one of its elements. [S24 Algorithm 2] */
static struct element *choose(const struct pixel *p, double shift, uint64_t step, double u, double *pmf)
{
    double position = van_der_corput(step) + shift;
    int bin = (int)((position - floor(position)) * (p->own->bin_paths / 2));
    struct element *e = &p->element[2 * bin];
    double p_e0 = first_probability(e);
    bool below = u < p_e0;
    *pmf = below ? p_e0 : 1 - p_e0;
    return below == (p->own->order == ORDER_TEXT) ? &e[0] : &e[1];
}

static void render_iteration(struct pixel *p, double shift, long iteration)
{
    arena_reset(&p->pass->work->arena);
    struct sample sample = sample_begin(p->pass, p->i, iteration);
    int n = sample_eye_path(&sample, p->pass->job->max_depth + 2);
    struct sampler choice = sample_stream(p->pass, RNG_SELECT, sample.x, sample.y, (uint64_t)iteration);
    replace_aged(p, iteration);
    double u = sampler_number(&choice, DRAW_LIGHT_END), pmf;
    struct element *e = choose(p, shift, (uint64_t)(iteration - p->pass->first), u, &pmf);
    const struct drawn drawn = {e->vertex, 1, e->length, pmf}; /* no factor makes up for pmf */

    for (int t = 2; t <= n; t++) {
        sample_s0(&sample, t);
        sample_s1(&sample, t);
        sample_pairs(&sample, &drawn, t, 1);
    }
    sample_lens(&sample, e->vertex, e->length, 1);
    sample_end(&sample);
    replace(p, e, iteration);
}

static void render(const struct prepared *m, const struct tile_pass *pass)
{
    struct pixel p = {.pass = pass, .own = m->own};
    p.element = mem_alloc((size_t)p.own->bin_paths, sizeof *p.element);
    for (; pass_goes_on(pass, p.i); p.i++) {
        const int *at = pass->tile->pixel[p.i];
        struct sampler shift = sample_stream(pass, RNG_SHUFFLE, at[0], at[1], (uint64_t)pass->first);
        double start = sampler_number(&shift, DRAW_ORDER);
        p.traced = 0;
        for (int i = 0; i < p.own->bin_paths; i++)
            replace(&p, &p.element[i], pass->first);
        for (long i = pass->first; i < pass->end && !pass_cancelled(pass); i++)
            render_iteration(&p, start, i);
    }
    for (int i = 0; i < p.own->bin_paths; i++)
        arena_free(&p.element[i].arena);
    free(p.element);
}

static bool check(const struct prepared *p, const struct scene *scene, struct error *err)
{
    const struct bins_parameters *own = p->own;
    (void)scene;
    return own->bin_paths % 2 == 0 ||
           error_set(err, "asbdpt: binpaths %d is odd; bins hold two sub-paths each", own->bin_paths);
}

static void prepare(const struct render_job *job, struct prepared *p)
{
    const struct bins_parameters *own = p->own;
    (void)job;
    p->size.block = own->restart > 0 ? own->restart : INT_MAX;
    p->size.tile = p->size.block > LONGEST_BLOCK ? 1 : DEFAULT_TILE_SIZE; /* pixels share no sub-paths */
}

#define AT(member) offsetof(struct bins_parameters, member)
static const struct field OWN[] = {
    {"binpaths", FIELD_INTEGER, AT(bin_paths), 8, 2, 4096, "light sub-paths per pixel, even", NULL},
    {"maxage", FIELD_INTEGER, AT(max_age), 24, 0, INT_MAX,
     "iterations after which an unused sub-path is replaced, 0: never", NULL},
    {"restart", FIELD_INTEGER, AT(restart), 32, 0, INT_MAX,
     "iterations after which all bins are rebuilt, 0: never", NULL},
    {"order", FIELD_WORD, AT(order), ORDER_TEXT, 0, 0,
     "take the first element if u < p_e0 (text) or otherwise (printed)", ORDERS},
    {.name = NULL}};

/* The dissertation has no Russian roulette. Its selection uses the throughput at the last vertex, and roulette would
 * make these throughputs alike. So roulette is off by default. */
const struct method method_bins = {
    .name = "asbdpt", .select = "bins", .help = "the dissertation's bins of two light sub-paths [Silva 2024]; biased",
    .own = OWN, .own_size = sizeof(struct bins_parameters), .numbers = NUMBERS_OF_BDPT, .rr_threshold = 0,
    .check = check, .prepare = prepare, .render = render};
