/* test_learning.c: the contract of learning (learn.h): a budget that does not depend on the number of samples, an end
 * at any time, and grids that cover the vertices. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/os.h"
#include "helpers.h"
#include "integrators/prepare.h"
#include "integrators/race.h"
#include "learning/learn.h"
#include "render/job.h"
#include "render/render.h"
#include "suites.h"

static const struct learn_options ALL = {.use = true, .guide = true, .pairs = true, .emission = 0.2, .delta = 0.1};

/* Who watches: how often everybody asked, once for each sub-path and chunk, and what share is learnt; from where on the
 * answer is no. */
struct watcher {
    struct os_lock *lock;
    double learnt, enough; /* shares */
    long asked, most;      /* 0: at will */
};

static void watch(void *context, double learnt, double done)
{
    struct watcher *w = context;
    (void)done;
    os_lock_take(w->lock);
    w->learnt = learnt;
    os_lock_leave(w->lock);
}

static enum cancel answer(void *context)
{
    struct watcher *w = context;
    os_lock_take(w->lock);
    w->asked++;
    bool enough = w->learnt >= w->enough || (w->most > 0 && w->asked >= w->most);
    os_lock_leave(w->lock);
    return enough ? CANCEL_BLOCK : CANCEL_NOT;
}

static struct render_job job_of(const struct scene *scene, struct watcher *w, int n_threads)
{
    struct render_job job = {.scene = scene, .film_rect = render_crop(scene), .seed = 3, .eye_seed = 3, .max_depth = 4,
                             .n_threads = n_threads, .rr_threshold = 0.5, .strategy = LIGHTS_SPATIAL,
                             .context = w};
    if (w != NULL) {
        job.progress = watch;
        job.cancel = answer;
    }
    return job;
}

static struct tables *learn_scene(const struct scene *scene, struct watcher *w, int n_threads)
{
    struct tables *l = mem_alloc(1, sizeof *l);
    struct render_job job = job_of(scene, w, n_threads);
    if (w != NULL)
        w->lock = os_lock_new();
    learn(&job, &ALL, l);
    if (w != NULL)
        os_lock_free(w->lock);
    return l;
}

/* Whatever else is learnt, the vertices of a light sub-path are counted if a method asks. */
static void test_count(struct test *t)
{
    struct scene scene;
    if (!scene_from_file(t, "scenes/many-lights.pbrt", 32, 24, &scene))
        return;
    const struct render_job job = job_of(&scene, NULL, 1);
    double counted[4];
    for (int i = 0; i < 4; i++) {
        struct tables out = {.light_vertices = 0};
        const struct learn_options options = {.use = i >= 2, .guide = i % 2 != 0, .emission = 1, .count = true};
        learn(&job, &options, &out);
        counted[i] = out.light_vertices;
        tables_free(&out);
    }
    for (int i = 1; i < 4; i++)
        CHECK(t, fabs(counted[i] / counted[0] - 1) < 0.05 && counted[0] > 0, "%s%s: %g vertices, alone %g",
              i >= 2 ? "use" : "", i % 2 != 0 ? "direct" : "", counted[i], counted[0]);
    scene_free(&scene);
}

/* Light vertices are learnt from rays that leave by power, each counted as often as the learnt rays would meet it. Here
 * sub-paths leave by the table themselves, or (the companion) by power. Returns how far the regions' shares are from
 * those learnt: the sum of their differences, halved.
 *   mean  out: of the vertices of a sub-path */
static double met(const struct scene *scene, const struct tables *learnt, const struct table *emission, double *mean)
{
    enum { PATHS = 20000, LONGEST = 5 };
    const struct render_job job = job_of(scene, NULL, 1);
    struct tables known = *learnt;
    known.emission = *emission;
    const struct counts counts = {.tables = &known};
    double *share = mem_alloc((size_t)known.regions.n, sizeof *share), n = 0, apart = 0;
    struct arena arena = {NULL, NULL};
    for (uint64_t i = 0; i < PATHS; i++) {
        struct vertex path[LONGEST];
        struct sampler sampler = sampler_start(7, RNG_TEST, i, 0);
        const struct walk w = {scene, &counts, &arena, &sampler, job.rr_threshold};
        arena_reset(&arena);
        int length = path_light(&w, path, job.max_depth + 1, NULL);
        for (int k = 1; k < length; k++)
            if (vertex_connectible(&path[k])) {
                share[path[k].place]++;
                n++;
            }
    }
    for (int r = 0; r < known.regions.n; r++)
        apart += fabs(share[r] / n - learnt->vertices[r]) / 2;
    *mean = n / PATHS;
    arena_free(&arena);
    free(share);
    return apart;
}

static void test_light_vertices(struct test *t)
{
    struct scene scene;
    double mean, mean_by_power;
    if (!scene_from_file(t, "scenes/corridor.pbrt", 32, 24, &scene))
        return;
    struct tables *l = learn_scene(&scene, NULL, 2);
    double apart = met(&scene, l, &l->emission, &mean), by_power = met(&scene, l, &NO_TABLES.emission, &mean_by_power);
    CHECK(t, fabs(l->light_vertices / mean - 1) < 0.05, "%g vertices learnt, %g met", l->light_vertices, mean);
    CHECK(t, apart < 0.15, "shares of regions are %.3f apart", apart);
    CHECK(t, by_power > 2 * apart || fabs(l->light_vertices / mean_by_power - 1) > 0.1,
          "the same would be learnt by power: %.3f apart, %g vertices", by_power, mean_by_power);
    tables_free(l);
    free(l);
    scene_free(&scene);
}

static void drop(struct tables *l)
{
    tables_free(l);
    free(l);
}

static bool same(const double *a, const double *b, int n) { return memcmp(a, b, (size_t)n * sizeof *a) == 0; }

static bool same_table(const struct table *a, const struct table *b)
{
    return a->rows == b->rows && a->columns == b->columns && same(a->ratio, b->ratio, a->rows * a->columns);
}

static bool same_learnt(const struct tables *a, const struct tables *b)
{
    return a->regions.n == b->regions.n && same(a->use, b->use, a->regions.n) &&
           same(a->vertices, b->vertices, a->regions.n) && same_table(&a->guide, &b->guide) &&
           same_table(&a->pairs, &b->pairs) && same_table(&a->emission, &b->emission);
}

/* --- budget, threads, end ----------------------------------------------------------------------------- */

static void test_budget(struct test *t)
{
    struct scene small, large;
    if (!scene_from_file(t, "scenes/many-lights.pbrt", 24, 16, &small) ||
        !scene_from_file(t, "scenes/many-lights.pbrt", 96, 64, &large))
        return;
    struct watcher w[4] = {{.enough = 2}, {.enough = 2}, {.enough = 2}, {.enough = 2, .most = 300}};
    struct tables *l[4] = {learn_scene(&small, &w[0], 1), learn_scene(&small, &w[1], 3), learn_scene(&large, &w[2], 2),
                           learn_scene(&large, &w[3], 2)};
    CHECK(t, w[0].asked > 1000 && w[0].asked < 8000, "%ld sub-paths for a small picture", w[0].asked);
    CHECK(t, w[2].asked > 4 * w[0].asked && w[2].asked < 16 * w[0].asked, "%ld sub-paths for 16 times as many pixels",
          w[2].asked);
    CHECK(t, w[0].learnt == 1 && w[2].learnt == 1, "of all, %g and %g are learnt", w[0].learnt, w[2].learnt);
    CHECK(t, w[3].asked < 400 && l[3]->regions.n >= 1, "it goes on when told to stop: %ld sub-paths", w[3].asked);
    CHECK(t, same_learnt(l[0], l[1]), "what is learnt depends on the number of threads");
    CHECK(t, !same_learnt(l[2], l[3]), "no difference would be seen");
    CHECK(t, l[0]->guide.rows > 0 && l[0]->pairs.rows > 0 && l[0]->emission.rows > 0, "nothing was learnt");
    for (int i = 0; i < 4; i++)
        drop(l[i]);
    scene_free(&small);
    scene_free(&large);
}

/* A picture of one pixel is looked at, too, and one of a million no longer than one of 32768: by 48 times 1024 eye
 * sub-paths and 16 times 1024 light sub-paths, and 64 more for each 256 of half of the eye sub-paths. All ask before
 * they begin, and once more for each 256. */
static void test_bounds(struct test *t)
{
    static const int sides[] = {1, 182, 1024};
    long asked[3];
    for (int i = 0; i < 3; i++) {
        struct scene scene;
        struct watcher w = {.enough = 2};
        if (!scene_from_text(t, "Camera \"perspective\" WorldBegin LightSource \"point\" WorldEnd", &scene))
            return;
        scene.width = scene.height = sides[i];
        camera_prepare(&scene.camera, sides[i], sides[i]);
        drop(learn_scene(&scene, &w, 2));
        asked[i] = w.asked;
        scene_free(&scene);
    }
    CHECK(t, asked[0] > 4000 && asked[2] == asked[1], "%ld sub-paths for one pixel, %ld for 182^2, %ld for 1024^2",
          asked[0], asked[1], asked[2]);
    CHECK(t, asked[2] == (64 + 6) * 1024 + 64 * 1024 / 256, "the budget is %ld sub-paths at most", asked[2]);
}

/* Where paths take long somebody is asked before each, and not only when many are traced: while tables are filled, and
 * by a race. After the first no each pass asks a few times more. */
static void test_dear_paths(struct test *t)
{
    struct scene scene;
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", 16, 16, &scene))
        return;
    struct watcher w[2] = {{.enough = 2, .most = 4}, {.enough = 2, .most = 4}};
    struct render_job job = job_of(&scene, NULL, 1);
    struct prepared p;
    struct error err = {.text = ""};
    drop(learn_scene(&scene, &w[0], 1));
    CHECK(t, w[0].asked >= 4 && w[0].asked < 16, "told to stop, it asks %ld times", w[0].asked);
    settings_set(&scene.settings, "race", "off", "test");
    if (CHECK(t, method_read(method_find("asbdpt", &scene.settings, &err), &scene, &p, &err), "%s", err.text)) {
        method_prepare(&job, &p);
        w[1].lock = os_lock_new();
        job.cancel = answer;
        job.context = &w[1];
        race(&job, &p);
        CHECK(t, w[1].asked >= 4 && w[1].asked < 16 && p.winner == 0, "told to stop, a race asks %ld times",
              w[1].asked);
        os_lock_free(w[1].lock);
        method_release(&p);
    }
    scene_free(&scene);
}

/* A render whose time is over while it learns has a picture of one block all the same. */
static enum cancel impatient(void *context)
{
    (void)context;
    return CANCEL_BLOCK;
}

static void test_early_end(struct test *t)
{
    struct scene scene;
    struct film film;
    struct error err = {.text = ""};
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", 48, 32, &scene)) /* two tiles */
        return;
    struct render_job o = {.integrator = method_named("asbdpt"), .end = 1000000, .n_threads = 2, .max_depth = 4,
                           .cancel = impatient};
    film_init(&film, render_crop(&scene), 48, 32);
    CHECK(t, render_by(&scene, &o, &film, &err), "%s", err.text);
    CHECK(t, film.iterations > 0 && film.iterations <= LONGEST_BLOCK && film_value(&film, 3 * (16 * 48 + 24)) > 0,
          "%ld samples of a render that was stopped at once", film.iterations);
    CHECK(t, film.learnt_short, "all was learnt all the same");
    film_free(&film);
    scene_free(&scene);
}

/* Of fewer light sub-paths the mean number of vertices is about the same, wherever learning ends. */
static void test_cut_short(struct test *t)
{
    struct scene scene;
    struct watcher whole = {.enough = 2};
    int in_part = 0;
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", 48, 32, &scene))
        return;
    struct tables *all = learn_scene(&scene, &whole, 1);
    for (int i = 1; i < 64; i++) {
        struct watcher w = {.enough = i / 64.0};
        struct tables *l = learn_scene(&scene, &w, 1);
        if (l->light_vertices > 0) {
            double ratio = l->light_vertices / all->light_vertices;
            CHECK(t, ratio > 0.8 && ratio < 1.2, "of %d/64 of all sub-paths: %.3f times as many vertices", i, ratio);
            in_part += l->light_vertices != all->light_vertices;
        }
        drop(l);
    }
    CHECK(t, in_part > 2, "learning has ended among light sub-paths %d times", in_part);
    drop(all);
    scene_free(&scene);
}

/* --- grids -------------------------------------------------------------------------------------------- */

/* One triangle far away moves no region, be it black or seen by few. */
static void test_far_triangle(struct test *t)
{
    static const char scene_text[] =
        "LookAt 0 1 -3.4  0 1 0  0 1 0 Camera \"perspective\" \"float fov\" 40 WorldBegin\n"
        "Material \"matte\" " QUAD("-2 0 -2  2 0 -2  2 0 2  -2 0 2")
        "Shape \"sphere\" AttributeBegin AreaLightSource \"diffuse\" Translate 0 3 0 Shape \"disk\" AttributeEnd\n"
        "%s WorldEnd";
    static const char *const far[] = {
        "", "Material \"matte\" \"rgb Kd\" [0 0 0] Shape \"trianglemesh\" \"integer indices\" [0 1 2] "
            "\"point P\" [1000 0 0  1001 0 0  1000 0 1]",
        "Material \"matte\" Shape \"trianglemesh\" \"integer indices\" [0 1 2] "
            "\"point P\" [0 200 1000  50 200 1000  0 250 1000]"};
    enum { WAYS = sizeof far / sizeof far[0] };
    int regions[WAYS];
    for (int i = 0; i < WAYS; i++) {
        char text[1024];
        struct scene scene;
        struct watcher w = {.enough = 2};
        snprintf(text, sizeof text, scene_text, far[i]);
        if (!scene_from_text(t, text, &scene))
            return;
        scene.width = scene.height = 32;
        camera_prepare(&scene.camera, 32, 32);
        struct tables *l = learn_scene(&scene, &w, 2);
        regions[i] = l->regions.n;
        drop(l);
        scene_free(&scene);
    }
    CHECK(t, regions[0] > 50, "%d regions", regions[0]);
    for (int i = 1; i < WAYS; i++)
        CHECK(t, regions[i] > 0.8 * regions[0], "a far triangle leaves %d regions of %d", regions[i], regions[0]);
}

/* --- figures ------------------------------------------------------------------------------------------ */

/* How far the worth of pairs of regions is from even, the mean square of the ratios over the square of their mean, is
 * what it was when these numbers were written down: a change that is meant to move them writes them again. */
static void test_unevenness(struct test *t)
{
    static const struct {
        const char *path;
        double unevenness;
    } cases[] = {{"scenes/veach-ajar.pbrt", 9.617}, {"scenes/corridor.pbrt", 7.188}};
    for (int i = 0; i < 2; i++) {
        struct scene scene;
        double sum = 0, square = 0;
        if (!scene_from_file(t, cases[i].path, 32, 24, &scene))
            continue;
        struct render_job job = job_of(&scene, NULL, 2);
        job.max_depth = 5;
        struct tables l = NO_TABLES;
        learn(&job, &ALL, &l);
        double n = l.pairs.rows * l.pairs.columns;
        for (int k = 0; k < l.pairs.rows * l.pairs.columns; k++) {
            sum += l.pairs.ratio[k] / n;
            square += sqr(l.pairs.ratio[k]) / n;
        }
        CHECK(t, fabs(square / sqr(sum) / cases[i].unevenness - 1) <= 0.03, "%s: %.4g, but it was %.4g", cases[i].path,
              square / sqr(sum), cases[i].unevenness);
        tables_free(&l);
        scene_free(&scene);
    }
}

void test_learning(struct test *t)
{
    test_budget(t);
    test_bounds(t);
    test_dear_paths(t);
    test_early_end(t);
    test_cut_short(t);
    test_far_triangle(t);
    test_unevenness(t);
    test_count(t);
    test_light_vertices(t);
}
