/* cmd_bench.c: asbdpt-lab bench: how fast is each part of the program on given scenes?
 *
 * Rates are per second of CPU time of one thread: other programs on the machine disturb them less than wall time.
 * Peak memory is that of the process so far: for a scene's own, measure it alone.
 */

#include <stdio.h>
#include <stdlib.h>

#include "base/mem.h"
#include "base/os.h"
#include "lab/bar.h"
#include "lab/commands.h"
#include "lab/methods.h"
#include "lab/tree.h"
#include "lab/timed.h"
#include "parser/parser.h"
#include "render/job.h"
#include "render/render.h"

/* What is measured one after the other, and about how much of the time a scene's take. */
enum part { RAYS, RENDER_PT, RENDER_BDPT, RENDER_ASBDPT, RENDER_BY_ALL, N_PARTS };
static const double SHARES[N_PARTS] = {0.2, 0.1, 0.2, 0.3, 0.2};

enum measure { LOAD, BUILD, TRIANGLES, CLOSEST, ANY, PT, BDPT, ASBDPT, GAIN, MEMORY, N_MEASURES };

static const struct {
    const char *key, *text;
} MEASURES[N_MEASURES] = {
    {"load_s", "reading the scene, s of CPU"},
    {"build_s", "building the kd-tree, s of CPU"},
    {"triangles", "triangles"},
    {"closest", "closest hit, incoherent, Mray/s"},
    {"any", "any hit, incoherent, Mray/s"},
    {"pt_us", "pt, a sample path, us of CPU"},
    {"bdpt_us", "bdpt, a sample path, us of CPU"},
    {"asbdpt_us", "asbdpt, a sample path, us of CPU"},
    {"gain", "bdpt, by all threads: their number times CPU time of one over that of all"},
    {"peak_mib", "peak memory so far, MiB"},
};

struct bench_options {
    struct texts scenes;
    int spp, max_depth, n_threads;
    struct bar bar;
};

#define AT(member) offsetof(struct bench_options, member)
static const struct option OPTIONS[] = {
    {"SCENE.pbrt", NULL, OPTION_TEXTS, AT(scenes), 1, .help = "at least one scene"},
    {"--spp", "N", OPTION_INTEGER, AT(spp), 1, 1000, .fallback = "8", .help = "samples per pixel"},
    {"--maxdepth", "N", OPTION_INTEGER, AT(max_depth), 1, 1000, .fallback = "8", .help = "longest path"},
    {"--nthreads", "N", OPTION_INTEGER, AT(n_threads), 1, 1000, .alias = "-j", .fallback = "2", .help = "all threads"},
    {.name = NULL},
};

/* --- rays --------------------------------------------------------------------------------------------- */

/* Million rays per second of CPU time. */
static double ray_rate(const struct scene *s, const struct ray *rays, int n, bool any)
{
    const double enough = 0.4;
    double start = os_cpu_seconds(), seconds = 0, done = 0;
    long hits = 0;
    while (n > 0 && seconds < enough) {
        for (int i = 0; i < n; i++) {
            struct hit hit;
            hits += any ? kd_occluded(&s->kd, &s->geo, &rays[i], INFINITY)
                        : kd_closest(&s->kd, &s->geo, &rays[i], &hit);
        }
        done += n;
        seconds = os_cpu_seconds() - start;
    }
    return hits >= 0 && seconds > 0 ? 1e-6 * done / seconds : 0;
}

static void measure_rays(const struct scene *s, double *value)
{
    struct ray *rays = mem_alloc(N_RAYS, sizeof *rays);
    int n = bench_rays(s, rays);
    value[CLOSEST] = ray_rate(s, rays, n, false);
    value[ANY] = ray_rate(s, rays, n, true);
    free(rays);
}

/* --- whole renders ------------------------------------------------------------------------------------ */

static bool render_once(const struct scene *s, struct bench_options *o, enum part part, const char *integrator,
                        int n_threads, double *cpu, struct error *err)
{
    struct render_job options = {
        .integrator = method_of(s, integrator), .end = o->spp, .max_depth = o->max_depth, .n_threads = n_threads};
    struct timed took;
    bar_follow(&o->bar, SHARES[part] / o->scenes.n, &options);
    if (!timed_render(s, &options, &took, err))
        return false;
    free(took.pixels);
    *cpu = took.seconds;
    return true;
}

static bool measure_renders(const struct scene *s, struct bench_options *o, double *value, struct error *err)
{
    static const char *const NAMES[] = {METHODS_BENCH};
    double paths = (double)o->spp * rect_width(render_crop(s)) * rect_height(render_crop(s)), all;
    for (int i = 0; i < 3; i++) {
        if (!render_once(s, o, (enum part)(RENDER_PT + i), NAMES[i], 1, &value[PT + i], err))
            return false;
        value[PT + i] *= 1e6 / paths;
    }
    if (!render_once(s, o, RENDER_BY_ALL, METHOD_REFERENCE, o->n_threads, &all, err))
        return false;
    value[GAIN] = o->n_threads * value[BDPT] / (1e6 / paths * all);
    return true;
}

/* --- one scene ---------------------------------------------------------------------------------------- */

enum { FRAME = 128 /* pixels along the square root of the frame's area */ };

/* Same framing, about FRAME^2 pixels; at most 65536 FRAME a side. */
static void shrink_film(struct scene *s)
{
    double scale = FRAME / sqrt((double)s->width * s->height);
    s->width = (int)fmax(1, floor(s->width * scale + 0.5));
    s->height = (int)fmax(1, floor(s->height * scale + 0.5));
}

/* scene_prepare does little besides building the tree; its time is what a user waits for. */
static bool measure_scene(const char *path, struct bench_options *o, double *value, struct error *err)
{
    struct scene scene;
    double start = os_cpu_seconds();
    if (!parse_scene(path, NULL, &scene, NULL, err))
        return false;
    job_adapt(&scene, method_rows, NULL, NULL);
    value[LOAD] = os_cpu_seconds() - start;
    shrink_film(&scene);
    start = os_cpu_seconds();
    scene_prepare(&scene);
    value[BUILD] = os_cpu_seconds() - start;
    value[TRIANGLES] = scene.geo.n_triangles;
    bar_part(&o->bar, SHARES[RAYS] / o->scenes.n);
    measure_rays(&scene, value);
    bool ok = measure_renders(&scene, o, value, err);
    scene_free(&scene);
    value[MEMORY] = os_peak_memory() / 1048576;
    return ok;
}

static int run(void *options)
{
    struct bench_options *o = options;
    struct error err;
    bar_start(&o->bar, false);
    for (int i = 0; i < o->scenes.n; i++) {
        double value[N_MEASURES];
        bool ok = measure_scene(o->scenes.item[i], o, value, &err);
        bar_clear(&o->bar);
        if (!ok)
            return fail(&err);
        printf("%s\n", o->scenes.item[i]);
        for (int m = 0; m < N_MEASURES; m++)
            printf("    %-10s %10.6g   %s\n", MEASURES[m].key, value[m], MEASURES[m].text);
    }
    return EXIT_OK;
}

const struct command command_bench = {
    "bench", "measure speed and memory", {"SCENE.pbrt... [options]"}, OPTIONS, sizeof(struct bench_options), run, true,
    "bench scenes/cornell-box.pbrt"};
