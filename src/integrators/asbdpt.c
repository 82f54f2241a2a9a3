/* asbdpt.c: see asbdpt.h: reads the parameters and runs what the selection wants to have learnt. */
#include "integrators/asbdpt.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "integrators/pilot.h"
#include "integrators/prepass.h"
#include "integrators/select.h"
#include "transport/pixel_sample.h"

static const struct setting_help PARAMETERS[] = {
    {"select", "subspaces", "bins (the dissertation, biased), pool, vertices, subspaces, lvc or combinatorial",
     "string"},
    {"metric", "importance", "pool, vertices: constant, throughput or importance", "string"},
    {"delta", "0.1", "pool, vertices, subspaces: share of draws that ignore what was learnt, (0,1]", "float"},
    {"connections", "0",
     "vertices, subspaces: light vertices drawn per eye vertex; 0: chosen; lvc: the same, 1; combinatorial: light "
     "sub-paths per pixel, 8", "integer"},
    {"pathpixels", "0",
     "all but bins, pool: pixels per light sub-path; 0: chosen (vertices: 2; lvc, combinatorial: 1)", "integer"},
    {"grid", "64", "pool, vertices: cells of the importance along the scene's diagonal", "integer"},
    {"lightsamplestrategy", "spatial",
     "pool, vertices, subspaces: s = 1 picks lights by power, or spatial: by what is seen", "string"},
    {"binpaths", "8", "bins: light sub-paths per pixel, even", "integer"},
    {"maxage", "24", "bins: iterations after which an unused sub-path is replaced, 0: never", "integer"},
    {"restart", "32", "bins: iterations after which all bins are rebuilt, 0: never", "integer"},
    {NULL, NULL, NULL, NULL}};

static const char *const SELECTS[] = {"bins", "pool", "vertices", "subspaces", "lvc", "combinatorial", NULL};
static const struct tile_renderer *const RENDERERS[] = {&render_bins, &render_pool, &render_vertices,
                                                        &render_subspaces, &render_vertices, &render_combinatorial};

/* Numbers that are heuristics of our own; doc/selection.md says what they were chosen on. */
enum {
    MIN_GUIDED_CELLS = 4, /* with fewer there is nothing to choose among */
    GUIDE_CELLS = 8,      /* eye regions along the scene's diameter */
    PAIR_CELLS = 16,      /* subspaces: light regions */
    MIN_EYE = 8 * 1024,   /* pool, vertices: eye sub-paths of the pre-pass, two per pixel between these */
    MAX_EYE = 128 * 1024,
    MIN_TRAINING = 256,   /* subspaces: the same, but TRAINING_SHARE of the samples, at least */
    COUNTED = 4 * 1024    /* lvc: light sub-paths whose vertices are counted */
};
static const double TRAINING_SHARE = 0.06, PILOT_SHARE = 0.02;

/* vertices: what draws, and the one sample of s = 1, count for in the weights (mis.h): draws are stratified over a
 * table, and the point on the light comes from a low-discrepancy sequence. */
static const double VERTICES_CREDIT = 2;

static bool read_parameters(const struct settings *s, struct selection *sel, int *cells, long *restart,
                            struct error *err)
{
    static const char *const metrics[] = {"constant", "throughput", "importance", NULL};
    int which, metric;
    long connections, pixels, grid, paths, age;
    if (!settings_choice(s, "select", SELECT_SUBSPACES, SELECTS, &which, err) ||
        !settings_choice(s, "metric", METRIC_IMPORTANCE, metrics, &metric, err) ||
        !settings_real(s, "delta", 0.1, 1e-6, 1, &sel->delta, err) ||
        !settings_int(s, "connections", 0, 0, 1024, &connections, err) ||
        !settings_int(s, "pathpixels", 0, 0, DEFAULT_TILE_SIZE * DEFAULT_TILE_SIZE, &pixels, err) ||
        !settings_int(s, "grid", 64, 1, 100000, &grid, err) || !settings_int(s, "binpaths", 8, 2, 4096, &paths, err) ||
        !settings_int(s, "maxage", 24, 0, LONG_MAX, &age, err) ||
        !settings_int(s, "restart", 32, 0, INT_MAX, restart, err))
        return false;
    if (paths % 2 != 0)
        return error_set(err, "asbdpt: binpaths %ld is odd; bins hold two sub-paths each", paths);
    sel->select = (enum select)which;
    sel->metric = (enum metric)metric;
    sel->connections[0] = sel->connections[1] = (double)connections;
    sel->path_pixels = (int)pixels;
    sel->lights = 1;
    sel->bin_paths = (int)paths;
    sel->max_age = age;
    *cells = (int)grid;
    return true;
}

/* As many draws as are needed, on average, to meet one light vertex that the camera can make use of; between 2, below
 * which tracing the sub-paths costs more than connecting them, and 8, where shadow rays begin to dominate. A rule of
 * our own. */
static int choose_connections(const struct importance *g)
{
    return int_within(1 / g->useful + 0.5, 2, 8); /* `useful` of a scene in which nothing arrives is 0 */
}

/* vertices: h(l) = (1 - delta) E(l) / mean + delta, for every eye vertex alike. */
static void pairs_from_importance(struct selection *sel)
{
    int n = sel->learnt.light.n;
    double *row = mem_alloc((size_t)n, sizeof *row);
    for (int y = 0; y < n; y++)
        row[y] = (1 - sel->delta) * importance_in(&sel->importance, y) / sel->importance.mean + sel->delta;
    pairs_from_row(&sel->learnt.pairs, row, n);
    sel->learnt.paired = true;
    free(row);
}

static void learn_vertices(struct selection *sel, const struct render_job *job, int cells)
{
    struct prepass_wish wish = {.importance = sel->metric == METRIC_IMPORTANCE, .eye_cells = GUIDE_CELLS};
    wish.light_cells = cells;
    wish.levels = 1;
    wish.n_eye = (long)clamp(2 * pixel_light_count(job), MIN_EYE, MAX_EYE);
    wish.guide = job->spatial_lights && job->scene->lights.n_cells >= MIN_GUIDED_CELLS;
    if (wish.importance || wish.guide)
        prepass_run(job, &wish, &sel->importance, &sel->learnt);
    if (sel->select == SELECT_POOL) {
        sel->path_pixels = 1;
        return;
    }
    if (sel->connections[0] == 0)
        sel->connections[0] = wish.importance ? choose_connections(&sel->importance) : 4;
    if (sel->path_pixels == 0)
        sel->path_pixels = 2;
    for (int i = 0; i < 2; i++) {
        sel->counts.connect[i] = VERTICES_CREDIT * sel->connections[0];
        sel->counts.direct[i] = VERTICES_CREDIT;
    }
    sel->counts.splat /= sel->path_pixels;
    if (wish.importance && sel->importance.mean > 0)
        pairs_from_importance(sel);
}

/* What the user gave is kept; the pilot chooses the rest. */
static void learn_subspaces(struct selection *sel, const struct render_job *job)
{
    double samples = pixel_light_count(job) * job->spp, drawn = sel->connections[0];
    int path_pixels = sel->path_pixels;
    struct prepass_wish wish = {.importance = true, .pairs = true, .eye_cells = GUIDE_CELLS};
    wish.light_cells = PAIR_CELLS;
    wish.levels = REGION_LEVELS;
    wish.delta = sel->delta;
    wish.n_eye = (long)clamp(TRAINING_SHARE * samples, MIN_TRAINING, MAX_EYE);
    wish.guide = job->spatial_lights && job->scene->lights.n_cells >= MIN_GUIDED_CELLS;
    prepass_run(job, &wish, &sel->importance, &sel->learnt);
    pilot_run(job, sel, PILOT_SHARE * samples);
    if (drawn > 0)
        pilot_set_draws(sel, drawn);
    if (path_pixels > 0)
        sel->path_pixels = path_pixels;
    sel->counts.splat = pixel_light_count(job) / sel->path_pixels;
}

static void tell_subspaces(const struct selection *sel, struct preparation *out)
{
    const struct film_number numbers[] = {
        {"draws_first_hit", sel->connections[0]}, {"draws_after", sel->connections[1]},
        {"light_points_first_hit", sel->lights}, {"pixels_per_light_path", sel->path_pixels},
        {"eye_regions", sel->learnt.eye.n}, {"light_regions", sel->learnt.light.n}};
    memcpy(out->number, numbers, sizeof numbers); /* fewer than there is room for: a NULL name stays behind them */
    snprintf(out->note, sizeof out->note,
             "chosen per eye vertex: %.2f draws at the first hit, %.2f after; %d light point%s at the first hit; and "
             "%d pixel%s per light sub-path",
             sel->connections[0], sel->connections[1], sel->lights, sel->lights == 1 ? "" : "s", sel->path_pixels,
             sel->path_pixels == 1 ? "" : "s");
}

/* lvc, combinatorial: BDPT but for C or M, for which `usual` stands in. */
static void set_plain(struct selection *sel, double usual)
{
    if (sel->connections[0] == 0)
        sel->connections[0] = sel->connections[1] = usual;
    if (sel->path_pixels == 0)
        sel->path_pixels = 1;
    sel->counts.connect[0] = sel->counts.connect[1] = sel->connections[0];
    sel->counts.splat /= sel->path_pixels;
}

/* lvc: the count C / l. Where light sub-paths have no vertex to connect to there is nothing to be counted. */
static void count_light_vertices(struct selection *sel, const struct render_job *job)
{
    struct prepass_wish wish = {.light_vertices = true, .eye_cells = 1, .light_cells = 1, .levels = 1};
    wish.n_eye = COUNTED;
    prepass_run(job, &wish, &sel->importance, &sel->learnt);
    double l = sel->importance.light_vertices;
    for (int i = 0; i < 2 && l > 0; i++)
        sel->counts.connect[i] = sel->connections[i] / l;
}

/* Do the MIS weights ask what was learnt? */
static bool learns(enum select s) { return s == SELECT_POOL || s == SELECT_VERTICES || s == SELECT_SUBSPACES; }

static bool prepare(const struct render_job *job, struct preparation *out, struct error *err)
{
    struct selection *sel = mem_alloc(1, sizeof *sel);
    int cells = 0;
    long restart = 0;
    if (!read_parameters(&job->scene->settings, sel, &cells, &restart, err)) {
        free(sel);
        return false;
    }
    struct mis_counts counts = {.hit = 1, .direct = {1, 1}, .connect = {1, 1}, .splat = pixel_light_count(job)};
    counts.power = job->power_heuristic;
    counts.learnt = learns(sel->select) ? &sel->learnt : NULL;
    sel->counts = counts;
    sel->max_depth = job->max_depth;
    switch (sel->select) {
    case SELECT_BINS: out->size.block = restart > 0 ? (int)restart : INT_MAX; break;
    case SELECT_POOL:
    case SELECT_VERTICES: learn_vertices(sel, job, cells); break;
    case SELECT_SUBSPACES:
        out->size.tile = MAX_TILE_SIZE; /* a larger pool */
        learn_subspaces(sel, job);
        tell_subspaces(sel, out);
        break;
    case SELECT_LVC:
        set_plain(sel, 1);
        count_light_vertices(sel, job);
        break;
    case SELECT_COMBINATORIAL: set_plain(sel, 8); break;
    }
    out->state = sel;
    out->renderer = RENDERERS[sel->select];
    return true;
}

static void release(void *state)
{
    struct selection *sel = state;
    importance_free(&sel->importance);
    learnt_free(&sel->learnt);
    free(sel);
}

const struct learnt *asbdpt_learnt(const void *state)
{
    const struct selection *sel = state;
    return sel->learnt.paired ? &sel->learnt : NULL;
}

static bool check(const struct settings *s, struct error *err)
{
    struct selection sel;
    int cells;
    long restart;
    return read_parameters(s, &sel, &cells, &restart, err);
}

/* The dissertation has no roulette, and its selection reads the throughput at a sub-path's far end, which roulette
 * would level: there it is off unless asked for. */
static double rr_threshold(const struct settings *s)
{
    return strcmp(settings_text(s, "select", ""), "bins") == 0 ? 0 : DEFAULT_RR_THRESHOLD;
}

const struct integrator integrator_asbdpt = {"asbdpt", "alias sampled bidirectional path tracing [Silva 2024]",
                                             PARAMETERS, prepare, release, check, rr_threshold};
