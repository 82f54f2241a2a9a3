/* test_trace.c: the trace of a sample adds up to what the film received, to the last bit. */
#include <stdlib.h>
#include <string.h>

#include "lab/trace.h"
#include "lab/worst.h"
#include "helpers.h"
#include "tests.h"

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
            {"restir", "restir", "", DEPTH},
            {"restirgi", "restirgi", "", 0}, /* the last two share pt's eye sub-paths */
            {"pathgraph", "pathgraph", "", 0}};
enum { N_WAYS = sizeof WAYS / sizeof WAYS[0] };

static struct render_options options_of(int way)
{
    struct render_options o = {.integrator = WAYS[way].integrator, .seed = 7, .end = SAMPLES,
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
            tile_add_splat(&tile, k->c.px, k->c.py, k->added, 0);
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
        *first = *first == 0 && weighted ? draw : *first;
        CHECK(t, !weighted || fabs(draw - *first) <= 1e-12 * *first, "%s: probability %g, scale %g, of others %g times",
              name, k->pmf, k->scale, *first / draw);
    }
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

static int differing(const struct film *a, const struct film *b)
{
    int n = 0;
    for (size_t k = 0; k < SIZE * SIZE * 3; k++)
        n += film_value(a, k) != film_value(b, k);
    return n;
}

/* The most that a sample brings to a pixel, by what its witness says. */
static struct brought most_of_trace(const struct scene *scene, const struct trace *trace)
{
    const struct pixel_rect all = {0, 0, SIZE, SIZE};
    struct brought most = {rgb_luminance(trace_sum(trace)), trace->x, trace->y, trace->iteration, trace->x, trace->y};
    for (int i = 0; i < trace->n_connections; i++) {
        const struct trace_connection *k = &trace->connection[i];
        const struct splat s = {k->c.px, k->c.py, k->added, 0};
        struct pixel_rect r = splat_pixels(&s, &scene->filter, all);
        float part[3] = {0, 0, 0};
        for (int n = 0; k->t == 1 && r.x1 > r.x0 && n < (int)rect_pixels(r); n++) {
            int x = r.x0 + n % rect_width(r), y = r.y0 + n / rect_width(r);
            splat_part(&s, &scene->filter, x, y, part);
            double brought = rgb_luminance(rgb_make((double)part[0], (double)part[1], (double)part[2]));
            if (brought > most.luminance) {
                most.luminance = brought;
                most.to_x = x;
                most.to_y = y;
            }
        }
    }
    return most;
}

/* Every pixel and sample told one by one gives the film of the render, and half of them do not. *most: the most that
 * each brings. */
static void check_film(struct test *t, const struct scene *scene, int way, struct brought *most)
{
    const char *name = WAYS[way].name;
    struct render_options options = options_of(way);
    struct film rendered, told;
    struct error err;
    int halfway = 0, added = 0, longest = 0;
    film_init(&told, render_crop(scene), SIZE, SIZE);
    render_film(t, scene, &options, &rendered);
    struct render_job job = {.scene = NULL};
    struct preparation prepared;
    if (!CHECK(t, render_prepare(scene, &options, render_crop(scene), &job, &prepared, &err), "%s", err.text))
        return;
    for (int i = 0; i < ALL; i++) {
        struct trace trace = {.x = i % SIZE, .y = i / SIZE % SIZE, .iteration = i / (SIZE * SIZE)};
        trace_sample(&job, &prepared, &trace);
        check_parts(t, name, &trace);
        check_light_points(t, name, &trace);
        added += trace.n_connections;
        longest = longest_pair(&trace) > longest ? longest_pair(&trace) : longest;
        if (2 * i == ALL)
            halfway = differing(&rendered, &told);
        add_trace(scene, &trace, &told);
        most[i] = most_of_trace(scene, &trace);
        trace_free(&trace);
    }
    method_release(&prepared);
    CHECK(t, added > ALL, "%s: only %d connections told", name, added);
    CHECK(t, WAYS[way].longest < 0 || longest == WAYS[way].longest, "%s: no pair is longer than t = %d", name, longest);
    CHECK(t, differing(&rendered, &told) == 0 && halfway > 0, "%s: %d values differ from what was told, half way %d",
          name, differing(&rendered, &told), halfway);
    film_free(&rendered);
    film_free(&told);
}

/* --- what brings most -------------------------------------------------------------------------------- */

static int by_luminance(const void *a, const void *b)
{
    const struct brought *x = a, *y = b;
    return x->luminance > y->luminance ? -1 : x->luminance < y->luminance;
}

static void sort_by_luminance(struct brought *item, int n) { qsort(item, (size_t)n, sizeof *item, by_luminance); }

/* Those that a render finds, on any number of threads, are those of all samples told one by one, which come in any
 * order. */
static void check_worst(struct test *t, const struct scene *scene, int way, struct brought *told)
{
    enum { MOST = 10 };
    struct render_options o = options_of(way);
    struct error err;
    int splats = 0;
    o.block = 1; /* a pass for each sample, where the method does not say how long one is: more than one list */
    sort_by_luminance(told, ALL);
    for (o.n_threads = 1; o.n_threads <= 3; o.n_threads++) {
        struct worst found = {.most = MOST};
        struct film film;
        film_init(&film, render_crop(scene), SIZE, SIZE);
        CHECK(t, worst_render(scene, &o, &film, &found, &err), "%s", err.text);
        film_free(&film);
        CHECK(t, found.n == MOST, "%s: %d samples", WAYS[way].name, found.n);
        for (int i = 0; i < found.n; i++) {
            const struct brought *f = &found.item[i], *b = &told[i];
            splats += f->to_x != f->x || f->to_y != f->y;
            CHECK(t, f->luminance == b->luminance && f->x == b->x && f->y == b->y && f->iteration == b->iteration &&
                         f->to_x == b->to_x && f->to_y == b->to_y,
                  "%s: the worst but %d brings %g, of all samples told it is %g", WAYS[way].name, i, f->luminance,
                  b->luminance);
        }
    }
    CHECK(t, strcmp(WAYS[way].integrator, "lt") != 0 || splats > 0, "%s: no splat is among the worst", WAYS[way].name);
}

/* Offers in any order leave the same list, equal ones among them and several of one sample. */
static void test_offers(struct test *t)
{
    enum { N = 200, MOST = 20, ROUNDS = 20 };
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 77, 0);
    struct brought offer[N];
    struct worst first = {.most = MOST}, nothing = {.most = MOST};
    const double NONE[] = {0, -1, NAN, INFINITY};
    for (int i = 0; i < N; i++) {
        struct brought b = {1 + (int)(30 * rng_uniform(&r)), (int)(5 * rng_uniform(&r)), (int)(5 * rng_uniform(&r)),
                            (int)(5 * rng_uniform(&r)), 0, 0};
        offer[i] = b;
    }
    for (int round = 0; round < ROUNDS; round++) {
        struct worst w = {.most = MOST};
        for (int i = N - 1; i >= 0; i--) {
            int k = (int)((i + 1) * rng_uniform(&r));
            struct brought b = offer[k];
            offer[k] = offer[i];
            offer[i] = b;
            worst_offer(&w, b);
        }
        first = round == 0 ? w : first;
        int wrong = 0;
        for (int i = 0; i < MOST; i++) {
            const struct brought *a = &w.item[i], *b = &first.item[i];
            wrong += a->luminance != b->luminance || a->x != b->x || a->y != b->y || a->iteration != b->iteration;
            wrong += i > 0 && a->luminance > w.item[i - 1].luminance;
            for (int k = 0; k < i; k++)
                wrong += w.item[k].x == a->x && w.item[k].y == a->y && w.item[k].iteration == a->iteration;
        }
        CHECK(t, w.n == MOST && wrong == 0, "another order, another list: %d differ of %d", wrong, w.n);
    }
    for (int i = 0; i < 4; i++) {
        struct brought b = {NONE[i], 0, 0, i, 0, 0};
        worst_offer(&nothing, b);
    }
    CHECK(t, nothing.n == 0, "%d that no film takes", nothing.n);
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
    struct render_options options = options_of(2);
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

/* --- samples that there are not ---------------------------------------------------------------------- */

static void test_refused(struct test *t, const struct scene *scene)
{
    static const struct {
        int x, y;
        long sample;
        const char *says;
    } cases[] = {{SIZE, 0, 0, "pixel 4,0"}, {0, -1, 0, "pixel 0,-1"}, {0, 0, SAMPLES, "sample 2"},
                 {0, 0, -1, "sample -1"}};
    struct render_options options = options_of(0);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct error err = {.text = ""};
        struct trace trace = {.x = cases[i].x, .y = cases[i].y, .iteration = cases[i].sample};
        CHECK(t, !trace_render(scene, &options, &trace, &err) && strstr(err.text, cases[i].says) != NULL,
              "%s: \"%s\"", cases[i].says, err.text);
        trace_free(&trace);
    }
}

void test_trace(struct test *t)
{
    struct scene scene;
    if (!scene_from_file(t, "scenes/cornell-box.pbrt", SIZE, SIZE, &scene))
        return;
    test_pdf_rev(t, &scene);
    test_refused(t, &scene);
    test_offers(t);
    for (int way = 0; way < N_WAYS; way++) {
        if (WAYS[way].select[0] != '\0')
            settings_set(&scene.settings, "select", WAYS[way].select, "test");
        struct brought told[ALL];
        check_film(t, &scene, way, told);
        check_worst(t, &scene, way, told);
    }
    scene_free(&scene);
}
