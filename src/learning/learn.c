/* learn.c: see learn.h. */
#include "learning/learn.h"

#include "base/number.h"
#include "learning/training.h"

enum { LIGHT_COUNTED = 4 * 1024 }; /* light sub-paths if only the mean number of their vertices is needed */
enum { MAX_EYE_REGIONS = 1024, MAX_LIGHT_REGIONS = 2048, MAX_IMPORTANCE_REGIONS = 1 << 17 };

struct tables learn(const struct render_job *job, const struct learn_options *options)
{
    struct training t = {.job = job, .work = workspaces_new(job->n_threads, job->max_depth),
                         .patience = patience_begin(job)};
    struct tables tables = NO_TABLES;
    double pixels = (double)rect_width(job->film_rect) * rect_height(job->film_rect);
    long n = int_within(LEARN_PER_PIXEL * pixels, LEARN_LEAST, LEARN_MOST), n_light = n < LEARN_LIGHT ? n : LEARN_LIGHT;
    bool regions = options->importance || options->guide || options->pairs;
    long n_emission = options->importance && options->emission < 1 ? n_light / 2 : 0;
    if (regions) {
        vec3 low, high;
        train_extent(&t, &low, &high);
        regions_init(&tables.eye, low, high, options->eye_cells, options->levels, MAX_EYE_REGIONS);
        regions_init(&tables.light, low, high, options->light_cells, options->levels,
                     options->pairs ? MAX_LIGHT_REGIONS : MAX_IMPORTANCE_REGIONS);
        if (options->importance)
            tables.importance.E = mem_alloc((size_t)tables.light.limit, sizeof(double));
        if (options->pairs)
            tables.importance.vertices = mem_alloc((size_t)tables.light.limit, sizeof(double));
        tables = train_importance(&t, tables, options->pairs ? n / 2 : n, options->guide);
    }
    if (n_emission > 0)
        tables = train_emission(&t, tables, n_emission, options->emission);
    if (!regions || options->importance)
        tables = train_vertices(&t, tables, n_emission, regions ? n_light - n_emission : LIGHT_COUNTED);
    if (options->pairs)
        tables = train_pairs(&t, tables, n / 2, n / 2, options->delta);
    patience_end(&t.patience);
    workspaces_free(t.work, job->n_threads);
    return tables;
}
