/* patience.c: see patience.h. */
#include "learning/patience.h"

struct patience patience_begin(const struct render_job *job)
{
    struct patience p = {job, os_lock_new(), 0, job->scene->lights.n == 0};
    return p;
}

void patience_end(struct patience *p) { os_lock_free(p->lock); }

bool patience_count(struct patience *p, double traced)
{
    os_lock_take(p->lock);
    p->traced += traced;
    p->over = p->over || (p->job->watch != NULL && !p->job->watch(p->job->watch_context, p->traced));
    bool lasts = !p->over;
    os_lock_leave(p->lock);
    return lasts;
}

bool patience_lasts(struct patience *p, double *asked)
{
    double now = os_wall_seconds();
    if (now - *asked < 0.02)
        return true;
    bool lasts = patience_count(p, 0);
    if (lasts)
        *asked = now;
    return lasts;
}
