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

static enum render_wish show(void *context, double done)
{
    struct bar *b = context;
    progress_update(&b->progress, fmin(b->begun + done * b->share, 1));
    return RENDER_GO_ON;
}

void bar_follow(struct bar *b, double share, struct render_options *o)
{
    bar_part(b, share);
    o->progress = show;
    o->progress_context = b;
}

void bar_clear(struct bar *b) { progress_end(&b->progress); }
