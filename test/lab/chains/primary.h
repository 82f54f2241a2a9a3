/* primary.h: states made of the random numbers that a sample consumes, and their small changes.       [Kelemen 2002 3]
 *
 * A mutation makes new numbers and leaves it to the sampling of bdpt to make a path of them. A large step makes all of
 * them again; a small step moves each a little, around the ends of [0,1), which keeps numbers uniform and the reverse
 * move as likely as the move, so that only the luminances decide. Where the new sample takes more numbers than the old
 * one had they are uniform, and what it does not take is forgotten: the reverse move would draw it. So both ways have
 * the density of the moves of those numbers that both samples have.
 *
 * Tests: test_chains.c.
 */
#ifndef ASBDPT_PRIMARY_H
#define ASBDPT_PRIMARY_H

#include "chains/chain.h"

/* Bound to a state: a sample's samplers, and its walks. */
struct primary {
    struct chain *chain;
    struct chain_state *state;
    struct sampler sampler[CHAIN_STREAMS];
};

/* primary_begin: numbers for c->next: those of c->now, moved (small), or fresh ones. What it contributes is heard from
 * here on. primary_end: forget the numbers that the sample has not taken, and contributions that are black or outside
 * the raster; sum up. */
void primary_begin(struct primary *p, struct chain *c, bool small);
void primary_end(struct primary *p);

/* The parameters of a row; without small steps: but the first. `mlt` has no guide: its mutations count a light as
 * chosen by power. */
extern const struct field CHAIN_PARAMETERS[], CHAIN_SHARED[];

/* primary_eye: an eye sub-path of at most n vertices through a raster point that is uniform over the raster.
 * primary_light: the same of a light sub-path. Both into the thread's memory, both return their lengths. */
int primary_eye(struct primary *p, int n, double *px, double *py);
int primary_light(struct primary *p, int n);
struct walk primary_walk(struct primary *p, enum chain_stream stream); /* theirs */

/* One strategy of those that make paths of a length, drawn by a number of its own. */
struct strategy {
    int s, t, n; /* of so many, all as likely */
    double px, py;
    rgb value;   /* n times the weighted contribution, where it arrives */
};

/* primary_strategy: draw one for paths of c->next.length vertices, with sub-paths of just the vertices that it needs
 * and with bdpt's weight, and hear what it contributes. Returns false if that is nothing. */
bool primary_strategy(struct primary *p, struct strategy *out);

/* primary_bring: hear what a connection contributes to out->px, py, or of t = 1 to where it arrives, which it sets. */
bool primary_bring(struct primary *p, const struct connection *c, struct strategy *out);

#endif
