/* chain.h: what the methods of Markov chains share: many samples that are each a small change of the one before.
 *
 * A state is what one sample contributes: splats f, raster points with colours, of luminance I in all. A chain goes
 * from state to state by proposals that it accepts with a probability a, such that it comes to each state as often as I
 * says [Metropolis 1953]. Instead of one of the two, each gets its share: 1 - a is where the chain was, a where it may
 * go [V97 11.3.3]. So a state counts as f / I, and a picture of M mutations for P pixels is
 *     b / M sum f / I,   b = mean of I over independent states, luminance per unit of raster area,
 * times the area of the raster that states lie on, over P: filters reach beyond the picture.
 *
 * No start-up bias [V97 11.3.1]: of N independent states, the start is drawn with probability I / sum I and the chain
 * counts by the mean I of the same N: the expectation of b f(X_m) / I(X_m) is right for any m, whatever the chain does.
 * All chains of a picture begin with one pool of N = 100,000 states, as in pbrt-v3, which is drawn before the first
 * mutation. In small pictures N is 32 for each pixel, or 2 of pssmlt, whose states are whole samples. So b has an error
 * that more mutations do not reduce: the standard deviation of I over its mean and sqrt(N). [V97]'s other use of the
 * independent states, as samples of the picture, is left out, and so is [Kelemen 2002]'s of large steps for b, which
 * is unbiased only in the limit.
 *
 * A chain is a tile pass: it has as many mutations as the pass has samples of pixels, though it wanders over the whole
 * picture. So bytes do not depend on threads, parts are whole chains, and a render ends or goes on as that of any other
 * method. Tiles are so large that a picture has about 1,000 chains, as in pbrt-v3, and a block so long (1,024 samples)
 * that more samples are longer chains. 1,000 chains also mix path lengths, which a chain of mmlt or mlt never changes.
 *
 * Tests: test_chains.c.
 */
#ifndef ASBDPT_CHAIN_H
#define ASBDPT_CHAIN_H

#include "chains/tape.h"
#include "integrators/method.h"

/* Numbers of one kind do not move up when there are more of another: those of the eye sub-path, of the light sub-path,
 * of light points, of lens points, and which strategy. */
enum chain_stream { EYE_NUMBERS, LIGHT_NUMBERS, POINT_NUMBERS, LENS_NUMBERS, STRATEGY_NUMBERS, CHAIN_STREAMS };

struct chain_state {
    struct tile heard; /* its splats as those of an independent sample, none black or outside the raster */
    double I;          /* their luminance; 0: no chain is ever here */
    int length;        /* vertices of its paths, for methods that keep them apart */
    struct tape number[CHAIN_STREAMS]; /* the random numbers it is made of (primary.h) */
    void *own;         /* the method's, of rules->own_size bytes; NULL: nothing */
};

struct chain_rules;

/* What a method has besides what all methods have (prepared->own). */
struct chains {
    int starts;             /* parameters; 0: as chain_prepare thinks best */
    double sigma, large_step;
    const struct chain_rules *rules;
    struct counts counts;   /* of bdpt; lens is the area of the raster: one light sub-path for one eye sub-path on it */
    double x, y, width, height; /* the raster: the film, and as far around it as the filter reaches */
    double scale;               /* raster area for each pixel */
    int lengths;                /* of paths, from 2 vertices on, that independent states are of in turn; 1: of all */
    int n;                      /* independent states of the picture */
    double *before;             /* [n + 1] sums of their I; owned */
    double b;                   /* the sum of the means of all lengths */
};

/* One chain after another, of one thread. */
struct chain {
    const struct chains *all;
    const struct render_job *job;
    struct workspace *work;
    struct vertex *light; /* [max_depth + 1] a light sub-path; owned */
    struct rng rng; /* of this chain */
    long candidate; /* >= 0: `next` is to be this independent state of its length; -1: the chain is under way */
    struct chain_state now, next;
};

/* What makes a method of it. */
struct chain_rules {
    bool roulette;  /* walks end by rrthreshold */
    bool by_length; /* independent states are of one length each; else of all */
    size_t own_size;
    void (*own_free)(void *own); /* what that owns; NULL: nothing */
    /* Make `next` an independent state, of next.length if by_length, or by a small step from `now`. */
    void (*sample)(struct chain *c, bool small);
    /* Make `next` from `now`; returns the probability to accept it. NULL: by a sample, such that it is as likely to
     * come from there as to go there: min(1, I'/I). */
    double (*propose)(struct chain *c);
};

/* Of a row of the table. */
#define CHAIN_ROW \
    .numbers = NUMBERS_OF_BDPT, .own_size = sizeof(struct chains), .release = chain_release, .render = chain_render

/* chain_propose: what is proposed, by the rules. chain_swap: go there. */
double chain_propose(struct chain *c);
void chain_swap(struct chain *c);

/* chain_candidate: make `next` independent state number i of all. */
void chain_candidate(struct chain *c, long i);

/* chain_start: make `now` the independent state that u in [0,1) finds in the running sum of their I, of which one must
 * not be dark. */
void chain_start(struct chain *c, double u);

/* For rows of the table: prepare with these rules; release; render. */
void chain_prepare(const struct chain_rules *rules, const struct render_job *job, struct prepared *out);
void chain_release(struct prepared *m);
void chain_render(const struct prepared *m, const struct tile_pass *pass);

/* chain_new: the memory of a chain that has not begun; chain_free releases it.
 *   work  of the thread */
struct chain *chain_new(const struct prepared *m, const struct render_job *job, struct workspace *work);
void chain_free(struct chain *c);

#endif
