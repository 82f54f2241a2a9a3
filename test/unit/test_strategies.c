/* test_strategies.c: every strategy (s,t) alone has the expectation of all others of the same path length. Only then
 * may their weights be chosen freely.
 *
 * Unweighted, a strategy has a variance that hides small faults. What strategy i makes of f w_i w_j, the weights being
 * the oracle's, is what strategy j makes of it, and both have little variance, for a weight is small where its density
 * is: a bridge between the two. Bridges see what is wrong by a hundredth.
 *
 * Scenes without delta lobes or delta lights, so that every strategy can make every path; surfaces do not touch, so
 * that no connection is short and its geometry factor has a variance. In the second, shading normals lean: without the
 * adjoint factor [V97 5.3] strategies would differ. In the fifth, the light has holes: s = 0 never meets them.
 */
#include <math.h>
#include <string.h>

#include "caustics/derived.h"
#include "lab/stats.h"
#include "lab/strategies.h"
#include "render/render.h"
#include "agree.h"
#include "helpers.h"
#include "oracle.h"
#include "transport/sample.h"
#include "suites.h"

enum { DEPTH = 3 };

#define VIEW "LookAt 0 1.6 -4.5  0 .9 0  0 1 0 Camera "
#define PERSPECTIVE VIEW "\"perspective\" \"float fov\" 42\n"
#define ORTHOGRAPHIC VIEW "\"orthographic\" \"float screenwindow\" [-1.6 1.6 -1.4 1.8]\n"
#define ENVIRONMENT "LookAt 0 1.9 -.4  0 .9 0  0 1 1 Camera \"environment\"\n"

#define HEAD(camera) camera                                                                                            \
    "Film \"image\" \"integer xresolution\" 12 \"integer yresolution\" 12 PixelFilter \"triangle\"\n"                  \
    "WorldBegin\n"                                                                                                     \
    "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [5 5 5] Material \"matte\" \"rgb Kd\" [.5 .5 .5]\n"          \
    QUAD("-2 4 -2  2 4 -2  2 4 2  -2 4 2") "AttributeEnd\n"                                                            \
    "Material \"matte\" \"rgb Kd\" [.8 .7 .6]\n" QUAD("-1.5 0 -1.5  1.5 0 -1.5  1.5 0 1.5  -1.5 0 1.5")

#define WALL                                                                                                           \
    "Material \"plastic\" \"rgb Kd\" [.5 .6 .7] \"float roughness\" .4\n"                                            \
    QUAD("-2 1 2.5  2 1 2.5  2 3.4 2.5  -2 3.4 2.5") "WorldEnd\n"

static const char PLAIN[] = HEAD(PERSPECTIVE) WALL;

static const char LEANING[] = HEAD(PERSPECTIVE)
    QUAD("-2 1 2.5  2 1 2.5  2 3.4 2.5  -2 3.4 2.5")
    "\"normal N\" [-.2 -1 -1  .2 -1 -1  .2 -.8 -1  -.2 -.8 -1] WorldEnd\n";

/* The first scene by the other cameras: t = 1 joins a point to its projection on a plane, and to a point from where the
 * whole sphere is seen, whose picture goes on beyond its edges. */
static const char PARALLEL[] = HEAD(ORTHOGRAPHIC) WALL;
static const char AROUND[] = HEAD(ENVIRONMENT) WALL;

/* A light with holes, where it neither shines nor stops light: a chequered alpha texture. */
static const char HOLED[] = PERSPECTIVE
    "Film \"image\" \"integer xresolution\" 12 \"integer yresolution\" 12 PixelFilter \"triangle\" WorldBegin\n"
    "Texture \"holes\" \"float\" \"checkerboard\" \"float uscale\" 3 \"float vscale\" 3\n"
    "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [9 9 9] Material \"matte\" \"rgb Kd\" [.5 .5 .5]\n"
    QUAD("-2 4 -2  2 4 -2  2 4 2  -2 4 2") "\"float uv\" [0 0 1 0 1 1 0 1] \"texture alpha\" \"holes\" AttributeEnd\n"
    "Material \"matte\" \"rgb Kd\" [.8 .7 .6] " QUAD("-1.5 0 -1.5  1.5 0 -1.5  1.5 0 1.5  -1.5 0 1.5") WALL;

/* Fog about the lens and everything, and milk in it, which joins go into and through. */
static const char FOG[] =
    "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [.01 .02 .03]\n"
    "\"rgb sigma_s\" [.12 .15 .1] \"float g\" .4 MakeNamedMedium \"milk\" \"string type\" \"homogeneous\"\n"
    "\"rgb sigma_a\" [.1 .2 .4] \"rgb sigma_s\" [1 1.2 .8] MediumInterface \"fog\"\n" HEAD(PERSPECTIVE)
    "AttributeBegin MediumInterface \"milk\" \"fog\" Material \"\" Translate 0 1.2 0\n"
    "Shape \"sphere\" \"float radius\" .7 AttributeEnd\n" WALL;

static void test_strategy_numbers(struct test *t)
{
    int next = 0;
    for (int depth = 0; depth < 6; depth++)
        for (int s = 0; s <= depth + 1; s++, next++)
            CHECK(t, strategy_index(s, depth + 2 - s) == next, "strategy (%d,%d) has number %d, not %d", s,
                  depth + 2 - s, strategy_index(s, depth + 2 - s), next);
    CHECK(t, strategy_count(5) == next, "%d strategies, not %d", strategy_count(5), next);
}

/* --- bridges ----------------------------------------------------------------------------------------- */

enum { VERTICES = DEPTH + 2, BRIDGE_BATCHES = 64, BRIDGE_SPP = 32 };

struct bridges {
    const struct scene *scene;
    const struct counts *counts;
    double off; /* the largest error of a path's length, relative */
    double made[VERTICES + 1][VERTICES][VERTICES]; /* by the vertices of the path, by i, of f w_i w_j */
};

static void bridge(void *context, const struct sample *sample, const struct joined *j)
{
    struct bridges *b = context;
    const struct camera *camera = &b->scene->camera;
    struct vertex lens = {.kind = VERTEX_LENS, .medium = camera->medium};
    double w[VERTICES + 1], brought = rgb_luminance(j->c->value) * j->scale;
    (void)sample;
    bool outside = j->t == 1 && !(j->px >= 0 && j->px < b->scene->width && j->py >= 0 &&
                                  j->py < b->scene->height);
    if (j->s + j->t < 3 || !(brought > 0) || outside)
        return;
    if (j->t == 1) /* pinholes */
        lens.p = camera_sample_lens(camera, j->path[j->s - 1].p, 0.5, 0.5);
    const struct vertex *light = j->path;
    const struct vertex *eye = j->t == 1 ? &lens : j->z + 1 - j->t;
    double wanted = oracle_length(b->scene, light, j->s, eye, j->t);
    b->off = fmax(b->off, fabs(path_length(b->scene, j) / wanted - 1));
    if (oracle_weights(b->scene, b->counts, light, j->s, eye, j->t, w))
        for (int i = 0; i < j->s + j->t; i++)
            b->made[j->s + j->t][j->s][i] += brought * w[j->s] * w[i];
}

static struct observer look_on(void *context, int slot, const struct tile *tile)
{
    (void)tile;
    struct observer o = {.context = context, .joined = bridge};
    (void)slot;
    return o;
}

static void look_away(void *context, int slot)
{
    (void)context;
    (void)slot;
}

/* What strategies with i of n vertices from the light make of all bridges, and how much more than the others do; all
 * but those to s = 0, which meets a light by chance, unless `chance`. */
struct made_more {
    double made[BRIDGE_BATCHES], more[BRIDGE_BATCHES];
};

static void add_bridges(const struct bridges *made, int n, int i, bool chance, struct made_more *sum)
{
    for (int k = 0; k < BRIDGE_BATCHES; k++)
        for (int j = 0; j < n; j++)
            if (j != i && (chance || (i > 0 && j > 0))) {
                sum->made[k] += made[k].made[n][i][j];
                sum->more[k] += made[k].made[n][i][j] - made[k].made[n][j][i];
            }
}

/* Returns the mean of what is made. */
static double judge_bridges(struct test *t, const char *name, const char *what, struct made_more *sum)
{
    const struct batches made = {.n_batches = BRIDGE_BATCHES, .n = 1, .value = sum->made};
    const struct batches more = {.n_batches = BRIDGE_BATCHES, .n = 1, .value = sum->more};
    double all = batches_mean(&made, NULL), error, mean = batches_mean(&more, &error);
    CHECK(t, all > 0, "%s: %s makes no path that another could make", name, what);
    TEST_ACCEPT(t, mean_p(&more, 0), "%s: %s makes %.2f +- %.2f %% more than others do", name, what, 100 * mean / all,
                100 * error / all);
    return all;
}

/* s = 0, s = 1, t = 1, and pairs: each by a function of its own in connect.c. */
enum { KINDS = 4 };
static const char *const KIND[KINDS] = {"s = 0", "s = 1", "t = 1", "a pair"};
static int kind_of(int n, int i) { return i <= 1 ? i : i == n - 1 ? 2 : 3; }

/* Box filters: what a splat brings is the same wherever it falls. */
static void test_bridges(struct test *t, const char *name, const char *text, uint64_t number,
                         struct made_more *all)
{
    struct scene scene;
    static struct bridges made[BRIDGE_BATCHES];
    const struct counts counts = {{1, 1}, {1, 1}, {1, 1}, .lens = 144, .tables = &NO_TABLES};
    if (!scene_from_text(t, text, &scene))
        return;
    scene.filter = filter_of("box");
    memset(made, 0, sizeof made);
    for (int k = 0; k < BRIDGE_BATCHES; k++) {
        struct film film;
        const struct observers look = {&made[k], look_on, look_away};
        struct render_job o = {.integrator = method_named("bdpt"), .end = BRIDGE_SPP * test_effort(t),
                                   .max_depth = DEPTH,
                                   .n_threads = 1, .observers = &look};
        o.seed = hash_combine(test_seed(t) * 7927 + number, (uint64_t)k);
        made[k].scene = &scene;
        made[k].counts = &counts;
        render_film(t, &scene, &o, &film);
        film_free(&film);
        CHECK(t, made[k].off < 1e-9, "%s: the length of a path is off by %g", name, made[k].off);
    }
    struct made_more of_kind[KINDS] = {{{0}, {0}}};
    for (int n = 3; n <= VERTICES; n++)
        for (int i = 0; i < n; i++) {
            struct made_more one = {{0}, {0}};
            char what[32];
            snprintf(what, sizeof what, "(%d,%d)", i, n - i);
            add_bridges(made, n, i, true, &one);
            judge_bridges(t, name, what, &one);
            add_bridges(made, n, i, n == 3, &of_kind[kind_of(n, i)]);
        }
    for (int kind = 0; kind < KINDS; kind++) {
        double mean = judge_bridges(t, name, KIND[kind], &of_kind[kind]);
        for (int k = 0; k < BRIDGE_BATCHES; k++) {
            all[kind].made[k] += of_kind[kind].made[k] / mean;
            all[kind].more[k] += of_kind[kind].more[k] / mean;
        }
    }
    scene_free(&scene);
}

/* What light sub-paths send to one edge of an environment camera is seen at the other, too: by filters, which bridges
 * do not have. */
static const struct agreement EDGES = {AROUND, 0, 0, DEPTH, "pt", "lt", 64, 256, 16, 12, false, 0.05};

void test_strategies(struct test *t)
{
    check_agreements(t, &EDGES, 1, 1);
    static const struct {
        const char *name, *text;
    } scenes[] = {{"plain normals", PLAIN},     {"leaning normals", LEANING},   {"orthographic camera", PARALLEL},
                  {"environment camera", AROUND}, {"a light with holes", HOLED}, {"fog and milk", FOG}};
    struct made_more all[KINDS] = {{{0}, {0}}};
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++)
        test_bridges(t, scenes[i].name, scenes[i].text, i, all);
    for (int kind = 0; kind < KINDS; kind++) {
        judge_bridges(t, "all scenes", KIND[kind], &all[kind]);
        double plant = 0.02;
        for (int k = 0; k < BRIDGE_BATCHES; k++)
            all[kind].more[k] += plant * all[kind].made[k];
        const struct batches more = {.n_batches = BRIDGE_BATCHES, .n = 1, .value = all[kind].more};
        TEST_REJECT(t, mean_p(&more, 0), "%s makes %g %% more than others do", KIND[kind], 100 * plant);
    }
    test_strategy_numbers(t);
}
