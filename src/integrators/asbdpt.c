/* asbdpt.c: see asbdpt.h. */
#include "integrators/asbdpt.h"

const char *const METRICS[] = {"constant", "throughput", "importance", NULL};

bool asbdpt_guided(const struct render_job *job)
{
    return job->spatial_lights && job->scene->lights.n_cells >= MIN_GUIDED_CELLS;
}

void asbdpt_learn(const struct render_job *job, bool importance, int cells, struct tables *out, struct frozen *f)
{
    struct learn_options options = {.importance = importance, .guide = asbdpt_guided(job), .eye_cells = GUIDE_CELLS,
                                    .light_cells = cells, .levels = 1, .emission = 1};
    if (options.importance || options.guide)
        *out = learn(job, &options);
    f->counts.tables = out;
}
