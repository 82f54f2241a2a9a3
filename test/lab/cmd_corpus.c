/* cmd_corpus.c: asbdpt-lab corpus: one scene of many (test/measure/corpus.md): what each method costs there, and what
 * the scene has, as lines for a table.
 *
 * Errors come from pairs: of S renders with unlike seeds, half the squared differences (results.h), relative to the
 * mean of all pictures. No reference is needed; but what all renders of a method lack is not seen. So a method is
 * tested against the first one (mark.h), and the line says so. CPU seconds are those of the render with all that it
 * prepares.
 *
 *     scene,WIDTH,HEIGHT,DEPTH,LOADING,delta=0,sky=0,lamps=1,mirror=0,medium=0,inside=0.98,runner=all
 *     run,METHOD,SEED,SPP,SECONDS,MSE8,RELMSE,8X8,MEAN,MARK
 *     failed,METHOD,WHY
 *
 * Tests: test/run/corpus.sh.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/os.h"
#include "cli/command.h"
#include "lab/commands.h"
#include "lab/mark.h"
#include "lab/methods.h"
#include "lab/plan.h"
#include "lab/race_table.h"
#include "lab/tree.h"
#include "lab/results.h"
#include "lab/timed.h"

struct corpus_options {
    const char *scene_path, *methods, *half;
    int width, spp, seeds;
    double limit;
};

#define AT(member) offsetof(struct corpus_options, member)
static const struct option OPTIONS[] = {
    {"SCENE.pbrt", NULL, OPTION_TEXT, AT(scene_path), 1, .help = "a scene file"},
    {"--methods", "LIST", OPTION_TEXT, AT(methods), .fallback = METHODS_CORPUS, .help = METHODS_HELP},
    {"--half", "HALF", OPTION_TEXT, AT(half),
     .help = "choice: all services off; services: each method with all it can have; without it: as given"},
    {"--width", "N", OPTION_INTEGER, AT(width), 8, 10000, .fallback = "112", .help = "pixels from left to right"},
    {"--spp", "N", OPTION_INTEGER, AT(spp), 1, 1 << 20, .fallback = "32", .help = "samples per pixel"},
    {"--seeds", "N", OPTION_INTEGER, AT(seeds), 2, PLAN_MAX_SEEDS, .fallback = "3",
     .help = "renders of each method, any two of which are a pair"},
    {"--limit", "SECONDS", OPTION_NUMBER, AT(limit), 1e-3, 1e6, .fallback = "120",
     .help = "CPU seconds after which a method is given up"},
    {.name = NULL}};

/* Of a method in the scene. */
struct entry {
    float *picture[PLAN_MAX_SEEDS]; /* owned; the first NULL: it has failed */
    double seconds[PLAN_MAX_SEEDS];
    enum mark mark;
};

struct corpus {
    const struct corpus_options *o;
    struct methods methods;
    struct scene scene;
    int depth;
    double started; /* CPU time when the method under way began */
    bool late;
    struct entry entry[METHODS_MAX];
    float *mean; /* of all pictures */
};

/* --- what the scene has ------------------------------------------------------------------------------- */

/* Share of the ways from what the camera sees that meet something within the scene: 1 in a closed room. */
static double inside(const struct scene *s)
{
    struct ray *rays = mem_alloc(N_RAYS, sizeof *rays);
    enum { ENOUGH = 1 << 12 };
    int n = bench_rays(s, rays), hits = 0, step = n > ENOUGH ? n / ENOUGH : 1, tried = 0;
    for (int i = 0; i < n; i += step) {
        struct hit hit;
        hits += kd_closest(&s->kd, &s->geo, &rays[i], &hit);
        tried++;
    }
    free(rays);
    return tried > 0 ? (double)hits / tried : 0;
}

/* Is it a mirror, or smooth glass, or may textures make it one? */
static bool specular(const struct material *m)
{
    return m->same.lobe != NULL ? m->same.n_smooth < m->same.n_lobes : m->row->may_be_delta;
}

static struct render_job options_of(struct corpus *c, const struct measured *m, int seed)
{
    settings_clear(&c->scene.settings);
    c->scene.settings = measured_settings(m, NULL);
    struct render_job o = {.integrator = method_of(&c->scene, m->integrator), .seed = (uint64_t)seed,
                               .end = c->o->spp, .n_threads = 1, .max_depth = c->depth};
    return o;
}

/* Who wins the race of the first method that has one, with the first seed; "-" where there is none. */
static const char *winner(struct corpus *c)
{
    for (int i = 0; i < c->methods.n; i++) {
        struct render_job o = options_of(c, &c->methods.item[i], 1);
        struct render_job job = {.scene = NULL};
        struct prepared p;
        if (!render_prepare(&c->scene, &o, render_crop(&c->scene), &job, &p, NULL))
            continue;
        bool raced = p.parameters.race == RACE_ON;
        int won = p.winner;
        method_release(&p);
        if (raced)
            return runner_name(won);
    }
    return "-";
}

static void print_scene(struct corpus *c, double loading)
{
    const struct scene *s = &c->scene;
    bool delta = false, sky = false, lamps = false, mirror = false;
    for (int i = 0; i < s->lights.n; i++) {
        delta |= light_is_delta(&s->lights.light[i]);
        sky |= s->lights.light[i].kind == LIGHT_INFINITE;
        lamps |= s->lights.light[i].kind == LIGHT_AREA;
    }
    for (int i = 0; i < s->n_materials; i++)
        mirror |= specular(s->material[i]);
    printf("scene,%d,%d,%d,%.3f,delta=%d,sky=%d,lamps=%d,mirror=%d,medium=%d,inside=%.3f,runner=%s\n", s->width,
           s->height, c->depth, loading, delta, sky, lamps, mirror, s->space != NULL, inside(s), winner(c));
}

/* A method as it was given. */
static const char *name(const struct corpus *c, int v)
{
    const struct measured *m = &c->methods.item[v];
    return c->o->half != NULL ? m->label : m->text;
}

/* --- renders ------------------------------------------------------------------------------------------ */

/* The clock is looked at between chunks of work: often it would take time itself. */
static void look_at_clock(void *context, double learnt, double done)
{
    struct corpus *c = context;
    (void)learnt, (void)done;
    c->late = os_cpu_seconds() - c->started > c->o->limit;
}

static enum cancel in_time(void *context)
{
    const struct corpus *c = context;
    return c->late ? CANCEL_NOW : CANCEL_NOT;
}

static void forget(struct corpus *c, struct entry *e)
{
    for (int i = 0; i < c->o->seeds; i++) {
        free(e->picture[i]);
        e->picture[i] = NULL;
    }
}

/* All renders of a method. Who reads the error stream knows which method was under way if the program ends here. */
static void render_method(struct corpus *c, int v)
{
    const struct measured *m = &c->methods.item[v];
    struct entry *e = &c->entry[v];
    struct error err = {.text = ""};
    say_line("begin %s", name(c, v));
    c->started = os_cpu_seconds();
    c->late = false;
    for (int i = 0; i < c->o->seeds; i++) {
        struct render_job o = options_of(c, m, i + 1);
        struct timed took;
        o.progress = look_at_clock;
        o.cancel = in_time;
        o.context = c;
        bool ok = timed_render(&c->scene, &o, &took, &err), late = os_cpu_seconds() - c->started > c->o->limit;
        e->picture[i] = took.pixels;
        e->seconds[i] = took.seconds;
        if (ok && !late)
            continue;
        printf("failed,%s,%s\n", name(c, v), ok ? "more CPU time than the limit" : "refused");
        if (!ok)
            say_line("%s", err.text);
        forget(c, e);
        return;
    }
}

/* --- what they show ----------------------------------------------------------------------------------- */

/* The mean of all pictures of methods [from, to), and if wanted the variance of that mean. NULL: there is none. */
static float *mean_of(const struct corpus *c, int from, int to, float *variance)
{
    size_t size = 3 * (size_t)c->scene.width * (size_t)c->scene.height;
    float *mean = mem_alloc(size, sizeof *mean);
    int n = 0;
    for (int v = from; v < to; v++)
        n += c->entry[v].picture[0] != NULL ? c->o->seeds : 0;
    for (size_t k = 0; n > 0 && k < size; k++) {
        double sum = 0, square = 0;
        for (int j = from * c->o->seeds; j < to * c->o->seeds; j++) {
            const float *picture = c->entry[j / c->o->seeds].picture[j % c->o->seeds];
            sum += picture != NULL ? (double)picture[k] / n : 0;
        }
        for (int j = from * c->o->seeds; variance != NULL && j < to * c->o->seeds; j++) {
            const float *picture = c->entry[j / c->o->seeds].picture[j % c->o->seeds];
            square += picture != NULL ? sqr((double)picture[k] - sum) : 0;
        }
        mean[k] = (float)sum;
        if (variance != NULL)
            variance[k] = (float)(square / n / (n - 1));
    }
    return mean;
}

/* All methods against the first that has not failed. */
static void mark_methods(struct corpus *c)
{
    enum { SCENES = 300 }; /* of a corpus, about: false marks of a whole measurement are to be rare */
    int first = 0, n = c->methods.n;
    while (first < n && c->entry[first].picture[0] == NULL)
        first++;
    if (first == n)
        return;
    struct reference r = {.width = c->scene.width, .height = c->scene.height};
    r.variance = mem_alloc(3 * (size_t)r.width * (size_t)r.height, sizeof *r.variance);
    r.pixels = mean_of(c, first, first + 1, r.variance);
    for (int v = first + 1; v < n; v++)
        if (c->entry[v].picture[0] != NULL)
            c->entry[v].mark = mark_of(mark_tests(c->entry[v].picture, c->o->seeds, &r), n * SCENES);
    free(r.pixels);
    free(r.variance);
}

static double brightness(const struct corpus *c, const float *picture)
{
    long n = 3L * c->scene.width * c->scene.height;
    double sum = 0;
    for (long k = 0; k < n; k++)
        sum += (double)picture[k] / (double)n;
    return sum;
}

static void print_runs(const struct corpus *c, int v)
{
    const struct entry *e = &c->entry[v];
    int n = c->o->seeds;
    double half[N_SQUARES][PLAN_MAX_SEEDS * PLAN_MAX_SEEDS], square[N_SQUARES], out[N_SQUARES][PLAN_MAX_SEEDS];
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++) {
            compare_squares(e->picture[i], e->picture[j], c->mean, c->scene.width, c->scene.height, square);
            for (int k = 0; k < N_SQUARES; k++)
                half[k][i * n + j] = half[k][j * n + i] = square[k] / 2;
        }
    for (int k = 0; k < N_SQUARES; k++)
        if (n > 2)
            results_pairs(half[k], n, out[k]);
        else
            out[k][0] = out[k][1] = half[k][1];
    for (int i = 0; i < n; i++)
        printf("run,%s,%d,%d,%.4f,%.6g,%.6g,%.6g,%.6g,%s\n", name(c, v), i + 1, c->o->spp, e->seconds[i],
               out[SQUARE_MSE8][i], out[SQUARE_RELMSE][i], out[SQUARE_BLOCKS][i], brightness(c, e->picture[i]),
               MARKS[e->mark]);
}

static int run(void *options)
{
    struct corpus *c = mem_alloc(1, sizeof *c);
    struct error err;
    double start = os_cpu_seconds();
    c->o = options;
    bool ok = c->o->half == NULL ? methods_read(c->o->methods, &c->methods, &err)
                                 : methods_add_halves(c->o->methods, c->o->half[0] == 'c' ? 1 : 2, &c->methods, &err);
    if (!ok) {
        free(c);
        return usage_error(&command_corpus, "--methods: %s", err.text);
    }
    ok = plan_scene_read(c->o->scene_path, c->o->width, 0, 0, &c->scene, &c->depth, &err);
    if (ok) {
        print_scene(c, os_cpu_seconds() - start);
        for (int v = 0; v < c->methods.n; v++)
            render_method(c, v);
        mark_methods(c);
        c->mean = mean_of(c, 0, c->methods.n, NULL);
        for (int v = 0; v < c->methods.n; v++) {
            if (c->entry[v].picture[0] != NULL)
                print_runs(c, v);
            forget(c, &c->entry[v]);
        }
        free(c->mean);
        scene_free(&c->scene);
    }
    free(c);
    return ok ? EXIT_OK : fail(&err);
}

const struct command command_corpus = {
    "corpus", "errors and times of methods in one of many scenes, as lines for a table", {"SCENE.pbrt [options]"},
    OPTIONS, sizeof(struct corpus_options), run, true, "corpus scenes/cornell-box.pbrt --width 24 --spp 2"};
