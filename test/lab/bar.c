/* bar.c: see bar.h. */
#include "lab/bar.h"

#include <math.h>

void bar_start(struct bar *b, bool quiet)
{
    b->begun = b->share = 0;
    progress_start(&b->progress, quiet);
}

void bar_part(struct bar *b, double share)
{
    b->begun += b->share;
    b->share = share;
    progress_update(&b->progress, fmin(b->begun, 1));
}

static void show(void *context, double learnt, double done)
{
    struct bar *b = context;
    (void)learnt;
    progress_update(&b->progress, fmin(b->begun + done * b->share, 1));
}

void bar_follow(struct bar *b, double share, struct render_job *o)
{
    bar_part(b, share);
    o->progress = show;
    o->context = b;
}

void bar_clear(struct bar *b) { progress_end(&b->progress); }
