/* learn.c: see learn.h. */
#include "learning/learn.h"

#include "base/number.h"
#include "learning/lessons.h"

/* The budget: eye sub-paths for each pixel, and between which numbers. */
enum { LEARN_LEAST = 2 * 1024, LEARN_MOST = 48 * 1024, LIGHT_MOST = 16 * 1024, COUNTED = 4 * 1024 };
static const double LEARN_PER_PIXEL = 4;

enum { MAX_EYE_REGIONS = 1024, MAX_LIGHT_REGIONS = 2048, MAX_IMPORTANCE_REGIONS = 1 << 17 };

/* The grids, where vertices are. */
static void lay_grids(struct lessons *l)
{
    vec3 low, high;
    const struct wish *w = l->wish;
    visits_extent(l, &low, &high);
    regions_init(&l->learnt->eye, low, high, w->eye_cells, w->levels, MAX_EYE_REGIONS);
    regions_init(&l->learnt->light, low, high, w->light_cells, w->levels,
                 w->pairs ? MAX_LIGHT_REGIONS : MAX_IMPORTANCE_REGIONS);
    learnt_freeze(l->learnt);
}

void learn(const struct render_job *job, const struct wish *wish, struct learnt *out)
{
    struct lessons l = {.job = job, .wish = wish, .learnt = out, .counts = {.direct = {1, 1}, .delta = {1, 1}}};
    double pixels = (double)rect_width(job->film_rect) * rect_height(job->film_rect);
    long n = int_within(LEARN_PER_PIXEL * pixels, LEARN_LEAST, LEARN_MOST), n_light = n < LIGHT_MOST ? n : LIGHT_MOST;
    bool visits = wish->importance || wish->guide || wish->pairs;
    l.work = workspaces_new(job->n_threads, job->max_depth);
    if (visits) {
        lay_grids(&l);
        visits_run(&l, wish->pairs ? n / 2 : n);
        l.counts.model = &out->model;
    }
    long aiming = wish->importance && wish->emission < 1 ? n_light / 2 : 0;
    if (aiming > 0)
        visits_emission(&l, aiming);
    if (!visits || wish->importance)
        visits_light(&l, aiming, visits ? n_light - aiming : COUNTED);
    if (wish->pairs)
        trials_run(&l, n / 2, n / 2);
    workspaces_free(l.work, job->n_threads);
}
