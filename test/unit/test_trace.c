/* test_trace.c: the trace of a sample adds up to what the film received, to the last bit. */
#include <stdlib.h>
#include <string.h>

#include "integrators/prepare.h"
#include "lab/trace.h"
#include "helpers.h"
#include "suites.h"

enum { SIZE = 4, SAMPLES = 2, ALL = SIZE * SIZE * SAMPLES, DEPTH = 4 };

static const struct {
    const char *name, *integrator, *select;
    int longest; /* t of the longest pair; -1: there is less than one draw for a later vertex */
} WAYS[] = {{"pt", "pt", "", 0},
            {"lt", "lt", "", 1},
            {"bdpt", "bdpt", "", DEPTH},
            {"bins", "asbdpt", "bins", DEPTH},
            {"pool", "asbdpt", "pool", DEPTH},
            {"vertices", "asbdpt", "vertices", DEPTH},
            {"subspaces", "asbdpt", "subspaces", -1},
            {"lvc", "lvc", "", DEPTH},
            {"cbdpt", "cbdpt", "", DEPTH},
            {"mbdpt", "mbdpt", "", DEPTH},
            {"pcbdpt", "pcbdpt", "", DEPTH},
            {"ris", "ris", "", DEPTH},
            {"ris2", "ris2", "", DEPTH},
            {"spcbpt", "spcbpt", "", DEPTH},
            {"restir", "restir", "", DEPTH},
            {"restirgi", "restirgi", "", 0}, /* the last three are path tracing */
            {"pathgraph", "pathgraph", "", 0},
            {"ppg", "ppg", "", 0}};
enum { N_WAYS = sizeof WAYS / sizeof WAYS[0] };

static struct render_job options_of(const struct scene *scene, int way)
{
    struct render_job o = {.integrator = method_of(scene, WAYS[way].integrator), .seed = 7, .end = SAMPLES,
                               .n_threads = 1, .max_depth = DEPTH};
    return o;
}

/* --- the film ---------------------------------------------------------------------------------------- */

/* What the witness of one sample says, as a tile takes it. */
static void add_trace(const struct scene *scene, const struct trace *trace, struct film *film)
{
    struct tile tile = {.sum = NULL};
    struct pixel_rect one = {trace->x, trace->y, trace->x + 1, trace->y + 1};
    tile_start(&tile, pixels_all(one), film->rect, &scene->filter);
    tile_add(&tile, trace->x, trace->y, trace_sum(trace));
    for (int i = 0; i < trace->n_connections; i++) {
        const struct trace_connection *k = &trace->connection[i];
        if (k->t == 1)
            tile_add_splat(&tile, k->px, k->py, k->added);
    }
    film_merge_tile(film, &tile);
    tile_free(&tile);
}

/* What is told of each contribution: its factors make what was added, its choice is one of those told. Where weights
 * make up for the choice, what is told of it is what they divide by: for all draws of first hits, and all of later
 * ones, probability times scale is the same. (ris2 draws from what was drawn before, with a factor for it.) */
static void check_parts(struct test *t, const char *name, const struct trace *trace)
{
    double same[2] = {0, 0};
    for (int i = 0; i < trace->n_connections; i++) {
        const struct trace_connection *k = &trace->connection[i];
        double product = rgb_luminance(k->c.value) * k->scale * k->c.weight, added = rgb_luminance(k->added);
        double *first = &same[k->t > 2], draw = k->pmf * k->scale;
        bool pair = k->s >= 2 && k->t >= 2, weighted = pair && strcmp(name, "bins") != 0 && strcmp(name, "ris2") != 0;
        CHECK(t, fabs(product - added) <= 1e-12 * fabs(added), "%s: %g in parts, %g added", name, product, added);
        CHECK(t, (k->light >= 0) == (k->s >= 2) && k->light < trace->n_lights &&
                     (k->s < 2 || trace->light[k->light].n >= k->s), "%s: light sub-path %d", name, k->light);
        CHECK(t, k->pmf > 0 && ((pair && trace->why != NULL) || k->pmf == 1) && k->pmf <= 1,
              "%s: chosen with probability %g", name, k->pmf);
        CHECK(t, k->s + k->t <= DEPTH + 2, "%s: a path of %d vertices is too long", name, k->s + k->t);
        *first = *first == 0 && weighted ? draw : *first;
        CHECK(t, !weighted || fabs(draw - *first) <= 1e-12 * *first, "%s: probability %g, scale %g, of others %g times",
              name, k->pmf, k->scale, *first / draw);
    }
}

static double product(rgb a, rgb b, rgb c, rgb d) { return rgb_luminance(rgb_mul(rgb_mul(a, b), rgb_mul(c, d))); }

/* What values and weights of a sample's connections are made of makes them; how many there are. */
static int check_weights(struct test *t, const char *name, const struct trace *trace)
{
    int n = 0;
    for (int i = 0; i < trace->n_connections; i++) {
        const struct trace_connection *k = &trace->connection[i];
        const struct trace_weight *of = &k->of;
        CHECK(t, (of->n > 0) == (k->s > 0 && k->t > 1 && !rgb_is_black(k->c.value)), "%s: (%d,%d)", name, k->s, k->t);
        if (!(of->n > 0))
            continue;
        double weight = mis_weight(of->n, of->light_side, of->eye_side);
        CHECK(t, fabs(weight - k->c.weight) <= 1e-12, "%s: weight %g told, %g", name, weight, k->c.weight);
        if (k->s < 2)
            continue;
        double G = of->cos_y * of->cos_z / (of->distance * of->distance), value = rgb_luminance(k->c.value);
        double made = G * product(trace->light[k->light].vertex[k->s - 1].beta, of->f_y, of->f_z,
                                  trace->eye.vertex[k->t - 1].beta);
        CHECK(t, fabs(made - value) <= 1e-12 * value, "%s: C* of %g told, %g", name, made, value);
        n++;
    }
    return n;
}

/* The eye end of the longest pair: t. */
static int longest_pair(const struct trace *trace)
{
    int t = 0;
    for (int i = 0; i < trace->n_connections; i++)
        if (trace->connection[i].s >= 2 && trace->connection[i].t > t)
            t = trace->connection[i].t;
    return t;
}

/* At the first hit `subspaces` tries two light points, the others one. */
static void check_light_points(struct test *t, const char *name, const struct trace *trace)
{
    int wanted = strcmp(name, "subspaces") == 0 ? 2 : 1, n = 0;
    for (int i = 0; i < trace->n_connections; i++)
        n += trace->connection[i].s == 1 && trace->connection[i].t == 2;
    CHECK(t, n == 0 || n == wanted, "%s: %d light points at the first hit, not %d", name, n, wanted);
}

/* Every pixel and sample told one by one gives the film of the render, and half of them do not. The brightest
 * sample of a pixel is found. */
static void check_film(struct test *t, const struct scene *scene, int way)
{
    const char *name = WAYS[way].name;
    struct render_job options = options_of(scene, way);
    struct film rendered, told;
    struct error err;
    int added = 0, longest = 0, weighed = 0;
    const bool own = strcmp(WAYS[way].integrator, "asbdpt") == 0 || strcmp(name, "bdpt") == 0;
    bool too_early = false;
    double most[SIZE * SIZE] = {0};
    long brightest[SIZE * SIZE] = {0};
    film_init(&told, render_crop(scene), SIZE, SIZE);
    render_film(t, scene, &options, &rendered);
    struct render_job job = {.scene = NULL};
    struct prepared prepared;
    if (!CHECK(t, render_prepare(scene, &options, render_crop(scene), &job, &prepared, &err), "%s", err.text))
        return;
    for (int i = 0; i < ALL; i++) {
        struct trace trace = {.x = i % SIZE, .y = i / SIZE % SIZE, .iteration = i / (SIZE * SIZE)};
        trace_sample(&job, &prepared, &trace);
        check_parts(t, name, &trace);
        check_light_points(t, name, &trace);
        weighed += own ? check_weights(t, name, &trace) : 1;
        added += trace.n_connections;
        longest = longest_pair(&trace) > longest ? longest_pair(&trace) : longest;
        if (2 * i == ALL)
            too_early = films_equal(&rendered, &told);
        add_trace(scene, &trace, &told);
        double luminance = rgb_luminance(trace_sum(&trace));
        if (luminance > most[i % (SIZE * SIZE)]) {
            most[i % (SIZE * SIZE)] = luminance;
            brightest[i % (SIZE * SIZE)] = trace.iteration;
        }
        trace_free(&trace);
    }
    method_release(&prepared);
    CHECK(t, weighed > ALL / 2, "%s: only %d weights", name, weighed);
    CHECK(t, added > ALL, "%s: only %d connections told", name, added);
    CHECK(t, WAYS[way].longest < 0 || longest == WAYS[way].longest, "%s: no pair is longer than t = %d", name, longest);
    CHECK(t, films_equal(&rendered, &told) && !too_early, "%s: the film is not what was told, or half of it", name);
    film_free(&rendered);
    film_free(&told);
    for (int i = 0; i < SIZE * SIZE; i++) {
        struct trace trace = {.x = i % SIZE, .y = i / SIZE, .iteration = TRACE_BRIGHTEST};
        CHECK(t, trace_render(scene, &options, &trace, &err) && trace.iteration == brightest[i],
              "%s: the brightest sample of pixel %d is %ld, not %ld", name, i, brightest[i], trace.iteration);
        trace_free(&trace);
    }
}

/* --- densities --------------------------------------------------------------------------------------- */

/* Among matte surfaces the walk from the other end goes back by the cosine: 1/m^2 at vertex i. */
static int check_path(struct test *t, const struct scene *scene, const struct trace_path *path)
{
    int n = 0;
    for (int i = 0; i < path->n; i++) {
        double told = trace_pdf_rev(scene, path, i);
        CHECK(t, (told >= 0) == (i + 2 < path->n && path->vertex[i].kind != VERTEX_LENS), "vertex %d of %d: %g", i,
              path->n, told);
        if (told < 0)
            continue;
        const struct vertex *v = &path->vertex[i], *next = &path->vertex[i + 1];
        double expected = abs_dot(next->bsdf.shading.n, next->wo) / PI * abs_dot(v->ng, next->wo) /
                          length2(sub(v->p, next->p));
        CHECK(t, fabs(told - expected) <= 1e-12 * expected, "vertex %d: %g, expected %g", i, told, expected);
        n++;
    }
    return n;
}

static void test_pdf_rev(struct test *t, const struct scene *scene)
{
    struct render_job options = options_of(scene, 2);
    int n = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        struct error err;
        struct trace trace = {.x = i % SIZE, .y = i / SIZE, .iteration = 1};
        CHECK(t, trace_render(scene, &options, &trace, &err), "%s", err.text);
        n += check_path(t, scene, &trace.eye);
        for (int k = 0; k < trace.n_lights; k++)
            n += check_path(t, scene, &trace.light[k]);
        trace_free(&trace);
    }
    CHECK(t, n > SIZE * SIZE, "only %d densities", n);
}

void test_trace(struct test *t)
{
    struct scene scene;
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", SIZE, SIZE, &scene))
        return;
    test_pdf_rev(t, &scene);
    for (int way = 0; way < N_WAYS; way++) {
        if (WAYS[way].select[0] != '\0')
            settings_set(&scene.settings, "select", WAYS[way].select, "test");
        check_film(t, &scene, way);
    }
    scene_free(&scene);
}
