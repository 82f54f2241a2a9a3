/* tape.c: see tape.h. */
#include "chains/tape.h"

#include <string.h>

#include "base/mem.h"

void tape_append(struct tape *t, const double *u, size_t n)
{
    t->number = mem_grow(t->number, &t->capacity, t->n + n, sizeof *t->number);
    memcpy(t->number + t->n, u, n * sizeof *u);
    t->n += n;
}

static void next(struct number_source *self, enum decision d, double *u, int n)
{
    struct tape *t = (struct tape *)self;
    size_t missing = (size_t)n > t->n - t->at ? (size_t)n - (t->n - t->at) : 0;
    double fresh[2];
    if (n == 2 && missing > 0)
        sampler_pair(&t->fresh, d, fresh);
    else if (missing > 0)
        fresh[0] = sampler_number(&t->fresh, d);
    tape_append(t, fresh + (size_t)n - missing, missing);
    memcpy(u, t->number + t->at, (size_t)n * sizeof *u);
    t->at += (size_t)n;
}

struct sampler tape_play(struct tape *t, struct sampler fresh)
{
    t->source.next = next;
    t->fresh = fresh;
    return (struct sampler){.source = &t->source};
}
