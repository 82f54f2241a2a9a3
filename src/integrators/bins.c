/* bins.c: `select = bins`: the dissertation's estimator, kept as it was written.              [S24 Algorithms 1 and 2]
 *
 * Every pixel owns `binpaths` light sub-paths, split into bins of two. In each iteration one bin is chosen and one of
 * its two elements taken with probability
 *     p_e0 = beta_0^2 / (beta_0^2 + beta_1^2),                                                        [S24 eq. 3.1]
 * beta being the mean over RGB of the throughput at the sub-path's furthest vertex. It is connected with the pixel's
 * eye sub-path exactly as in BDPT, without any further weight, and replaced by a fresh one. Elements older than
 * `maxage` iterations are replaced unused; after `restart` iterations (a block, see asbdpt.c) all bins are discarded.
 *
 * Where the text leaves a choice: Algorithm 2 prints the comparison of the random number with p_e0 the other way round;
 * the text's reading (take e0 if u < p_e0) is implemented. An empty sub-path has beta 0; two zeros give 1/2. Bins are
 * visited in the order of the van der Corput sequence, started at a random point per pixel and block.
 *
 * This estimator is BIASED. A sub-path that is traced and used counts once, whatever its chance of being used was.
 * Those that age, are discarded at a restart, or are left over at the end are mostly the ones with low beta, so the
 * sub-paths used are not distributed like the sub-paths traced: where high beta means "escaped after one bounce", the
 * image darkens. doc/selection.md measures it; select = pool is the smallest repair.
 *
 * Tests: test_asbdpt.c (must be rejected by the test that accepts BDPT).
 */
#include <stdlib.h>

#include "integrators/select.h"
#include "transport/pixel_sample.h"

struct element {
    struct arena arena;    /* its lobes */
    struct vertex *vertex; /* [max_depth + 1], owned */
    int length;            /* 0: nothing was emitted */
    double beta;           /* of [S24 eq. 3.1] */
    long born;             /* iteration in which it was traced */
};

/* The set of bins of the pixel being rendered; bin b holds elements 2b and 2b+1. */
struct bins {
    int n_elements;
    uint64_t traced; /* sub-paths traced for this pixel and block */
    struct element element[];
};

static void *new_scratch(const void *selection)
{
    const struct selection *sel = selection;
    struct bins *b = mem_alloc(1, sizeof *b + (size_t)sel->bin_paths * sizeof b->element[0]);
    b->n_elements = sel->bin_paths;
    for (int i = 0; i < b->n_elements; i++)
        b->element[i].vertex = mem_alloc((size_t)sel->max_depth + 1, sizeof *b->element[i].vertex);
    return b;
}

static void free_scratch(void *scratch)
{
    struct bins *b = scratch;
    for (int i = 0; i < b->n_elements; i++) {
        arena_free(&b->element[i].arena);
        free(b->element[i].vertex);
    }
    free(b);
}

struct pixel {
    const struct tile_pass *pass;
    const struct selection *sel;
    struct bins *bins;
    int x, y;
};

/* Put a fresh sub-path into element e. Streams are numbered by block and, within it, by the order of tracing: an
 * iteration traces at most binpaths + 1 <= 2^13 sub-paths, so a block that begins at iteration i stays below the names
 * of the next. */
static void replace(struct pixel *p, struct element *e, long iteration)
{
    uint64_t number = ((uint64_t)p->pass->first << 32) + p->bins->traced++;
    arena_reset(&e->arena);
    e->length = pixel_light_path(p->pass, &p->sel->counts, p->x, p->y, number, &e->arena, e->vertex);
    e->beta = select_throughput(e->vertex, e->length);
    e->born = iteration;
}

static void replace_aged(struct pixel *p, long iteration)
{
    for (int i = 0; p->sel->max_age > 0 && i < p->bins->n_elements; i++)
        if (iteration - p->bins->element[i].born > p->sel->max_age)
            replace(p, &p->bins->element[i], iteration);
}

/* Van der Corput's sequence: the bits of i mirrored about the binary point. [Corput 1935] */
static double van_der_corput(uint64_t i)
{
    double value = 0, digit = 0.5;
    for (; i > 0; i >>= 1, digit /= 2)
        if (i & 1)
            value += digit;
    return value;
}

/* p_e0 of the bin of the elements e[0] and e[1]. [S24 eq. 3.1] */
static double first_probability(const struct element *e)
{
    double b0 = sqr(e[0].beta), b1 = sqr(e[1].beta);
    return b0 + b1 > 0 ? b0 / (b0 + b1) : 0.5;
}

/* For trace.h: all bins, and how the element `chosen` was. */
static void tell(const struct pixel *p, struct trace *trace, const struct element *chosen, double u)
{
    int bin = (int)(chosen - p->bins->element) / 2, second = (int)(chosen - p->bins->element) % 2;
    double p_e0 = first_probability(&p->bins->element[2 * bin]), q = second ? 1 - p_e0 : p_e0;
    trace_note(trace, "the pixel's own %d light sub-paths in bins of two; beta: mean over r, g, b of the throughput at "
               "the furthest vertex", p->bins->n_elements);
    for (int b = 0; b < p->bins->n_elements / 2; b++) {
        const struct element *e = &p->bins->element[2 * b];
        trace_note(trace, "bin %d: beta %.4g and %.4g, traced in iterations %ld and %ld; p_e0 = %.4f%s", b, e[0].beta,
                   e[1].beta, e[0].born, e[1].born, first_probability(e), b == bin ? "   <- visited now" : "");
    }
    trace_choose(trace, 0, chosen->vertex, chosen->length, 0, q, 1,
                 "bin %d: u = %.4f %s p_e0 = %.4f, so its %s element; no weight makes up for q: biased", bin, u,
                 second ? ">=" : "<", p_e0, second ? "second" : "first");
}

/* Choose a bin, then an element of it. [S24 Algorithm 2] */
static struct element *choose(struct pixel *p, double shift, uint64_t step, double u)
{
    double position = van_der_corput(step) + shift;
    int bin = (int)((position - floor(position)) * (p->bins->n_elements / 2));
    struct element *e = &p->bins->element[2 * bin];
    return u < first_probability(e) ? &e[0] : &e[1];
}

static void render_iteration(struct pixel *p, double shift, long iteration)
{
    struct workspace *work = p->pass->work;
    arena_reset(&work->arena);
    struct pixel_sample g = pixel_sample_begin(p->pass, &p->sel->counts, p->x, p->y, iteration);
    int n = pixel_eye_path(p->pass, &g, iteration, work->eye, g.max_depth + 2);
    struct sampler draw = pixel_sampler(p->pass, RNG_SELECT, p->x, p->y, iteration);
    replace_aged(p, iteration);
    double u = sampler_number(&draw, DRAW_LIGHT_END);
    struct element *e = choose(p, shift, (uint64_t)(iteration - p->pass->first), u);
    if (g.trace != NULL)
        tell(p, g.trace, e, u);

    pixel_sum_eye(&g, work->eye, n);
    pixel_sum_pairs(&g, work->eye, n, e->vertex, e->length, 1);
    pixel_splat_path(&g, e->vertex, e->length, 1);
    tile_add_eye(p->pass->tile, p->x, p->y, g.sum);
    replace(p, e, iteration);
}

static void render(const void *selection, const struct tile_pass *pass)
{
    struct pixel p = {pass, selection, pass->work->scratch, 0, 0};
    for (p.y = pass->rect.y0; p.y < pass->rect.y1; p.y++)
        for (p.x = pass->rect.x0; p.x < pass->rect.x1; p.x++) {
            struct sampler shift = pixel_sampler(pass, RNG_SHUFFLE, p.x, p.y, pass->first);
            double start = sampler_number(&shift, DRAW_ORDER);
            p.bins->traced = 0;
            for (int i = 0; i < p.bins->n_elements; i++)
                replace(&p, &p.bins->element[i], pass->first);
            for (long i = pass->first; i < pass->end; i++)
                render_iteration(&p, start, i);
        }
}

const struct tile_renderer render_bins = {render, new_scratch, free_scratch};
