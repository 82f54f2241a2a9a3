/* cmd_bench.c: asbdpt-lab bench: how fast is each part of the program on given scenes?
 *
 * Rates are per second of CPU time of one thread: other programs on the machine disturb them less than wall time.
 * Rays are incoherent: cosine-distributed directions from points all over the scene, found by following a camera ray
 * one bounce. Peak memory is that of the process so far: for a scene's own, measure it alone.
 */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/vec.h"
#include "base/json.h"
#include "base/mem.h"
#include "base/os.h"
#include "base/progress.h"
#include "base/sampler.h"
#include "base/warp.h"
#include "lab/commands.h"
#include "lab/tree.h"
#include "lab/methods.h"
#include "lab/timed.h"
#include "parser/parser.h"
#include "render/parameters.h"
#include "render/render.h"

enum measure {
    LOAD, BUILD, TRIANGLES, NODES, REFERENCES, COST, CLOSEST, ANY, PT, BDPT, ASBDPT, WALL_1, CPU_1, WALL_N,
    CPU_N, MEMORY, N_MEASURES
};

static const struct {
    const char *key, *text;
} MEASURES[N_MEASURES] = {
    {"load_s", "reading the scene, s of CPU"},
    {"build_s", "building the kd-tree, s of CPU"},
    {"triangles", "triangles"},
    {"nodes", "kd-tree nodes"},
    {"references", "kd-tree references"},
    {"sah_cost", "kd-tree cost, triangle tests per ray"},
    {"closest_incoherent", "closest hit, incoherent, Mray/s"},
    {"any_incoherent", "any hit, incoherent, Mray/s"},
    {"pt_paths", "pt, sample paths per s of CPU"},
    {"bdpt_paths", "bdpt, sample paths per s of CPU"},
    {"asbdpt_paths", "asbdpt, sample paths per s of CPU"},
    {"wall_1", "bdpt, 1 thread, s"},
    {"cpu_1", "bdpt, 1 thread, s of CPU"},
    {"wall_n", "bdpt, all threads, s"},
    {"cpu_n", "bdpt, all threads, s of CPU"},
    {"peak_mib", "peak memory so far, MiB"},
};

struct bench_options {
    struct texts scenes;
    const char *json, *baseline; /* or NULL */
    int spp, max_depth, n_threads;
};

#define AT(member) offsetof(struct bench_options, member)
static const struct option OPTIONS[] = {
    {"SCENE.pbrt", NULL, OPTION_TEXTS, AT(scenes), 1, .help = "at least one scene"},
    {"--json", "FILE", OPTION_TEXT, AT(json), .written = true, .help = "write the figures"},
    {"--baseline", "FILE", OPTION_TEXT, AT(baseline), .help = "such a file, to print what has changed since"},
    {"--spp", "N", OPTION_INTEGER, AT(spp), 1, 1000, .fallback = "8", .help = "samples per pixel"},
    {"--maxdepth", "N", OPTION_INTEGER, AT(max_depth), 1, 1000, .fallback = "8", .help = "longest path"},
    {"--nthreads", "N", OPTION_INTEGER, AT(n_threads), 1, 1000, .alias = "-j", .fallback = "2", .help = "all threads"},
    {.name = NULL},
};

/* --- rays --------------------------------------------------------------------------------------------- */

enum { N_RAYS = 1 << 17, FRAME = 128 /* pixels along the square root of the frame's area */ };

static vec3 cosine_direction(struct sampler *sampler, vec3 n)
{
    struct frame f = frame_from_normal(n);
    double u[2];
    sampler_pair(sampler, DRAW_SCATTERING, u);
    return to_world(&f, warp_cos_hemisphere(u[0], u[1]));
}

/* Replace the ray by one leaving the surface it meets. False if it meets none. */
static bool bounce(const struct scene *s, struct ray *ray, struct sampler *sampler)
{
    struct surface at;
    if (!scene_intersect(s, ray, &at))
        return false;
    struct ray next = {at.p, cosine_direction(sampler, faceforward(at.ng, neg(ray->d))), ray_margin(at.p), INFINITY,
                       at.prim_id, 0};
    *ray = next;
    return true;
}

/* N_RAYS rays; returns fewer if the camera sees hardly anything. */
static int make_rays(const struct scene *s, struct ray *out)
{
    int n = 0;
    for (int i = 0; n < N_RAYS && i < 8 * N_RAYS; i++) {
        struct sampler sampler = sampler_start(0, RNG_TEST, (uint64_t)i, 0);
        double u[2];
        sampler_pair(&sampler, DRAW_FILM_POINT, u);
        out[n] = camera_ray(&s->camera, u[0] * s->width, u[1] * s->height, 0.5, 0.5);
        n += bounce(s, &out[n], &sampler) && bounce(s, &out[n], &sampler);
    }
    return n;
}

/* Million rays per second of CPU time. */
static double ray_rate(const struct scene *s, const struct ray *rays, int n, bool any)
{
    const double enough = 0.4;
    double start = os_cpu_seconds(), seconds = 0, done = 0;
    long hits = 0;
    while (n > 0 && seconds < enough) {
        for (int i = 0; i < n; i++) {
            struct hit hit;
            hits += any ? kd_occluded(&s->kd, &s->geo, &rays[i]) : kd_closest(&s->kd, &s->geo, &rays[i], &hit);
        }
        done += n;
        seconds = os_cpu_seconds() - start;
    }
    return hits >= 0 && seconds > 0 ? 1e-6 * done / seconds : 0;
}

static void measure_rays(const struct scene *s, double *value)
{
    struct ray *rays = mem_alloc(N_RAYS, sizeof *rays);
    int n = make_rays(s, rays);
    value[CLOSEST] = ray_rate(s, rays, n, false);
    value[ANY] = ray_rate(s, rays, n, true);
    free(rays);
}

/* --- whole renders ------------------------------------------------------------------------------------ */

static bool render_once(const struct scene *s, const struct bench_options *o, const char *integrator, int n_threads,
                        double *wall, double *cpu, struct error *err)
{
    struct render_options options = {
        .integrator = integrator, .end = o->spp, .max_depth = o->max_depth, .n_threads = n_threads};
    struct timed took;
    if (!timed_render(s, &options, &took, err))
        return false;
    free(took.pixels);
    *wall = took.wall;
    *cpu = took.seconds;
    return true;
}

static bool measure_renders(const struct scene *s, const struct bench_options *o, double *value, struct error *err)
{
    static const char *const NAMES[] = {METHODS_BENCH};
    double paths = (double)o->spp * rect_width(render_crop(s)) * rect_height(render_crop(s));
    double wall[3], cpu[3];
    for (int i = 0; i < 3; i++) {
        if (!render_once(s, o, NAMES[i], 1, &wall[i], &cpu[i], err))
            return false;
        value[PT + i] = paths / cpu[i];
    }
    value[WALL_1] = wall[BDPT - PT];
    value[CPU_1] = cpu[BDPT - PT];
    return render_once(s, o, METHOD_REFERENCE, o->n_threads, &value[WALL_N], &value[CPU_N], err);
}

/* --- one scene ---------------------------------------------------------------------------------------- */

/* Same framing, about FRAME^2 pixels; at most 65536 FRAME a side. */
static void shrink_film(struct scene *s)
{
    double scale = FRAME / sqrt((double)s->width * s->height);
    s->width = (int)fmax(1, floor(s->width * scale + 0.5));
    s->height = (int)fmax(1, floor(s->height * scale + 0.5));
}

/* scene_prepare does little besides building the tree; its time is what a user waits for. */
static bool measure_scene(const char *path, const struct bench_options *o, double *value, struct error *err)
{
    struct scene scene;
    double start = os_cpu_seconds();
    if (!parse_scene(path, NULL, &scene, NULL, err))
        return false;
    parameters_adapt(&scene, method_rows, NULL);
    value[LOAD] = os_cpu_seconds() - start;
    shrink_film(&scene);
    start = os_cpu_seconds();
    scene_prepare(&scene);
    value[BUILD] = os_cpu_seconds() - start;
    const struct tree_figures tree = tree_figures(&scene.kd);
    value[TRIANGLES] = scene.geo.n_triangles;
    value[NODES] = scene.kd.n_nodes;
    value[REFERENCES] = (double)tree.references;
    value[COST] = tree.cost;
    measure_rays(&scene, value);
    bool ok = measure_renders(&scene, o, value, err);
    scene_free(&scene);
    value[MEMORY] = os_peak_memory() / 1048576;
    return ok;
}

/* --- output ------------------------------------------------------------------------------------------- */

/* The number after "key" in the baseline's object of a scene, or 0: the file is one that write_json wrote. */
static double baseline_value(const char *text, const char *scene, const char *key)
{
    char name[1024], field[64];
    snprintf(name, sizeof name, "\"scene\": \"%s\"", scene);
    snprintf(field, sizeof field, "\"%s\": ", key);
    const char *object = text != NULL ? strstr(text, name) : NULL;
    const char *at = object != NULL ? strstr(object, field) : NULL;
    const char *end = object != NULL ? strchr(object, '}') : NULL;
    return at != NULL && (end == NULL || at < end) ? strtod(at + strlen(field), NULL) : 0;
}

static void print_table(const struct bench_options *o, const double *values, const char *baseline)
{
    for (int i = 0; i < o->scenes.n; i++) {
        const double *value = values + (size_t)i * N_MEASURES;
        printf("%s\n", o->scenes.item[i]);
        for (int m = 0; m < N_MEASURES; m++) {
            double before = baseline_value(baseline, o->scenes.item[i], MEASURES[m].key);
            printf("    %-40s %12.4g", MEASURES[m].text, value[m]);
            printf(before > 0 ? "   %5.2f of the baseline's\n" : "\n", value[m] / (before > 0 ? before : 1));
        }
        printf("    %-40s %12.3g\n", "scaling: threads x CPU at 1 / CPU at all",
               value[CPU_N] > 0 ? o->n_threads * value[CPU_1] / value[CPU_N] : 0);
    }
}

static void write_json(FILE *f, const struct bench_options *o, const double *values)
{
    struct json j = json_start(f);
    json_open(&j, NULL, '{');
    json_count(&j, "threads", (uint64_t)o->n_threads);
    json_count(&j, "spp", (uint64_t)o->spp);
    json_count(&j, "maxdepth", (uint64_t)o->max_depth);
    json_open(&j, "scenes", '[');
    for (int i = 0; i < o->scenes.n; i++) {
        json_open(&j, NULL, '{');
        json_text(&j, "scene", o->scenes.item[i]);
        for (int m = 0; m < N_MEASURES; m++)
            json_number(&j, MEASURES[m].key, values[(size_t)i * N_MEASURES + (size_t)m]);
        json_close(&j);
    }
    json_close(&j);
    json_close(&j);
}

/* --- the command ------------------------------------------------------------------------------------- */

static bool measure(const struct bench_options *o, struct error *err)
{
    uint8_t *baseline = NULL;
    size_t size;
    double *values = mem_alloc((size_t)o->scenes.n * N_MEASURES, sizeof *values);
    struct file_output out;
    bool opened = o->json != NULL && file_create(o->json, &out, err);
    bool ok = (opened || o->json == NULL) && (o->baseline == NULL || file_read(o->baseline, &baseline, &size, err));
    for (int i = 0; ok && i < o->scenes.n; i++)
        ok = measure_scene(o->scenes.item[i], o, values + (size_t)i * N_MEASURES, err);
    if (ok)
        print_table(o, values, (const char *)baseline);
    if (ok && opened)
        write_json(out.stream, o, values);
    if (opened && ok)
        ok = file_commit(&out, err);
    else if (opened)
        file_abandon(&out);
    free(baseline);
    free(values);
    return ok;
}

static int run(void *options)
{
    struct error err;
    return measure(options, &err) ? EXIT_OK : fail(&err);
}

const struct command command_bench = {
    "bench", "measure speed and memory", {"SCENE.pbrt... [options]"}, OPTIONS, sizeof(struct bench_options), run, true,
    "bench scenes/cornell-box.pbrt"};
