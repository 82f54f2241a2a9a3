/* asbdpt.c: see asbdpt.h: reads the parameters, runs the pre-pass if the selection wants one, and calls it. */
#include "integrators/asbdpt.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "integrators/prepass.h"
#include "integrators/select.h"
#include "transport/pixel_sample.h"
#include "base/number.h"

enum { MIN_GUIDED_CELLS = 4 }; /* with fewer there is nothing to choose among */

/* vertices: what the one sample of s = 1 counts for in the weights (mis.h); its point on the light comes from a
 * low-discrepancy sequence. Measured: from 1 to 2 the squared error of the Cornell box falls by a fifth, that of the
 * other scenes stays or, where light comes through windows, rises by 1 to 3 %. */
static const double DIRECT_CREDIT = 2;

static const struct parameter PARAMETERS[] = {
    {"select", "vertices", "bins (the dissertation, biased), pool, or vertices"},
    {"metric", "importance", "pool, vertices: constant, throughput or importance"},
    {"delta", "0.1", "pool, vertices: share of draws that ignore the importance, (0,1]"},
    {"connections", "0", "vertices: light vertices drawn per eye vertex; 0: chosen from the pre-pass"},
    {"pathpixels", "2", "vertices: pixels per light sub-path"},
    {"grid", "64", "pool, vertices: cells of the importance grid along the scene's diagonal"},
    {"lightsamplestrategy", "spatial", "pool, vertices: s = 1 picks lights by power, or spatial: by what is seen"},
    {"binpaths", "8", "bins: light sub-paths per pixel, even"},
    {"maxage", "24", "bins: iterations after which an unused sub-path is replaced, 0: never"},
    {"restart", "32", "bins: iterations after which all bins are rebuilt, 0: never"},
    {NULL, NULL, NULL}};

static bool read_parameters(const struct settings *s, struct selection *sel, int *cells, long *restart,
                            struct error *err)
{
    static const char *const selects[] = {"bins", "pool", "vertices", NULL};
    static const struct selector *const selectors[] = {&select_bins, &select_pool, &select_vertices};
    static const char *const metrics[] = {"constant", "throughput", "importance", NULL};
    int which, metric;
    long connections, pixels, grid, paths, age;
    if (!settings_choice(s, "select", 2, selects, &which, err) ||
        !settings_choice(s, "metric", METRIC_IMPORTANCE, metrics, &metric, err) ||
        !settings_real(s, "delta", 0.1, 1e-6, 1, &sel->delta, err) ||
        !settings_int(s, "connections", 0, 0, 1024, &connections, err) ||
        !settings_int(s, "pathpixels", 2, 1, TILE_SIZE * TILE_SIZE, &pixels, err) ||
        !settings_int(s, "grid", 64, 1, 100000, &grid, err) || !settings_int(s, "binpaths", 8, 2, 4096, &paths, err) ||
        !settings_int(s, "maxage", 24, 0, LONG_MAX, &age, err) ||
        !settings_int(s, "restart", 32, 0, INT_MAX, restart, err))
        return false;
    if (paths % 2 != 0)
        return error_set(err, "asbdpt: binpaths %ld is odd; bins hold two sub-paths each", paths);
    sel->selector = selectors[which];
    sel->metric = (enum metric)metric;
    sel->connections = (int)connections;
    sel->path_pixels = (int)pixels;
    sel->bin_paths = (int)paths;
    sel->max_age = age;
    *cells = (int)grid;
    return true;
}

/* n(x) of vertices.c over 2 C. */
static double position_count(const void *context, vec3 p, vec3 ng)
{
    const struct selection *sel = context;
    return (1 - sel->delta) * importance_at(&sel->grid, p, ng) / sel->grid.mean + sel->delta;
}

/* As many draws as are needed, on average, to meet one light vertex that the camera can make use of (importance.h);
 * between 2, below which tracing the sub-paths costs more than connecting them, and 8, where shadow rays begin to
 * dominate. A rule of our own. */
static int choose_connections(const struct importance *grid)
{
    return int_within(1 / grid->useful + 0.5, 2, 8); /* `useful` of a scene in which nothing arrives is 0 */
}

/* Learn what the selection needs and set the sample counts accordingly. */
static void learn(struct selection *sel, const struct render_job *job, int cells)
{
    const struct light_set *lights = &job->scene->lights;
    bool importance = sel->metric == METRIC_IMPORTANCE;
    importance_init(&sel->grid, lights, cells);
    bool spatial = job->spatial_lights && lights->n_cells >= MIN_GUIDED_CELLS;
    if (importance || spatial)
        prepass_run(job, importance ? &sel->grid : NULL, spatial ? &sel->guide : NULL);
    if (spatial)
        sel->counts.guide = &sel->guide;
    if (sel->selector != &select_vertices)
        return;
    if (sel->connections == 0)
        sel->connections = importance ? choose_connections(&sel->grid) : 4;
    sel->counts.connect = 2 * sel->connections; /* see vertices.c */
    sel->counts.direct = DIRECT_CREDIT;
    sel->counts.splat /= sel->path_pixels;
    if (importance && sel->grid.mean > 0) {
        sel->counts.at = position_count;
        sel->counts.at_context = sel;
    }
}

static bool prepare(const struct render_job *job, void **state, int *block, struct error *err)
{
    struct selection *sel = mem_alloc(1, sizeof *sel);
    int cells = 0;
    long restart = 0;
    if (!read_parameters(&job->scene->settings, sel, &cells, &restart, err)) {
        free(sel);
        return false;
    }
    struct mis_counts counts = {.hit = 1, .direct = 1, .connect = 1, .splat = pixel_light_count(job)};
    counts.power = job->power_heuristic;
    sel->counts = counts;
    sel->max_depth = job->max_depth;
    if (sel->selector == &select_bins)
        *block = restart > 0 ? (int)restart : INT_MAX;
    else
        learn(sel, job, cells);
    *state = sel;
    return true;
}

static void release(void *state)
{
    struct selection *sel = state;
    importance_free(&sel->grid);
    guide_free(&sel->guide);
    free(sel);
}

static void render(const void *state, const struct tile_pass *pass)
{
    ((const struct selection *)state)->selector->render(state, pass);
}

static void *new_own(const void *state)
{
    const struct selection *sel = state;
    return sel->selector->new_own(sel);
}

static void free_own(const void *state, void *own)
{
    ((const struct selection *)state)->selector->free_own(own);
}

/* The dissertation has no roulette, and its selection reads the throughput at a sub-path's far end, which roulette
 * would level: there it is off unless asked for. */
static double rr_threshold(const struct settings *s)
{
    return strcmp(settings_text(s, "select", ""), "bins") == 0 ? 0 : DEFAULT_RR_THRESHOLD;
}

const struct method method_asbdpt = {"asbdpt", "alias sampled bidirectional path tracing [Silva 2024]", PARAMETERS, 32,
                                     prepare, render, release, new_own, free_own, rr_threshold};
