/* Images of each light alone, and lights that the lens does not see. The planes of all lights are the picture, to the
 * bit, by every method; each is what a render by that light alone expects. Alpha: 0 of an empty scene, 1 of a closed
 * one, else what is covered; a light that is hidden is missing where the lens meets it first, and nowhere else. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/os.h"
#include "bench.h"
#include "lab/methods.h"
#include "lab/planes.h"
#include "helpers.h"
#include "suites.h"

enum { SIDE = 16, PIXELS = SIDE * SIDE, SUMS = 3 * PIXELS };

/* A picture and its planes. */
struct rendered {
    struct film film;
    struct planes planes;
};

static void render_planes(struct test *t, const struct scene *scene, const struct render_job *options, bool lights,
                          bool alpha, struct rendered *out)
{
    struct render_job o = *options;
    struct error err;
    film_init(&out->film, render_crop(scene), scene->width, scene->height);
    planes_init(&out->planes, scene, &out->film, lights, alpha, false, o.n_threads);
    struct observers observers = planes_observers(&out->planes);
    o.observers = &observers;
    CHECK(t, render_by(scene, &o, &out->film, &err), "%s", err.text);
    planes_end(&out->planes);
}

static void rendered_free(struct rendered *r)
{
    planes_free(&r->planes);
    film_free(&r->film);
}

/* The picture, 0, or one of its planes. */
static const struct film *plane(const struct rendered *r, int number)
{
    return number == 0 ? &r->film : &r->planes.film[number - 1];
}

static double plane_total(const struct film *film)
{
    double sum = 0;
    for (size_t i = 0; i < SUMS; i++)
        sum += film_value(film, i);
    return sum;
}

/* --- lights apart ------------------------------------------------------------------------------------- */

/* Three groups, in this order: two skies, which are always one; a sun and a lamp of one name; a see-through lamp of two
 * triangles. Each is on or off. */
enum { GROUPS = 3 };
static const char SCENE[] =
    "LookAt 0 1.6 -4.5  0 .9 0  0 1 0 Camera \"perspective\" \"float fov\" 42\n"
    "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 16 PixelFilter \"%s\" WorldBegin\n"
    "LightSource \"infinite\" \"rgb L\" [.3 .4 .5] \"rgb scale\" [%d %d %d]\n"
    "LightSource \"distant\" \"rgb L\" [1 1 1] \"point from\" [1 4 -1] \"rgb scale\" [%d %d %d]\n"
    "\"string group\" \"warm\"\n"
    "LightSource \"point\" \"rgb I\" [3 2 1] \"point from\" [-1 2 0] \"rgb scale\" [%d %d %d]\n"
    "\"string group\" \"warm\"\n"
    "LightSource \"infinite\" \"rgb L\" [.1 0 0] \"rgb scale\" [%d %d %d]\n"
    "Material \"none\" AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [5 5 5] \"rgb scale\" [%d %d %d]\n"
    "\"bool twosided\" \"true\" " QUAD("-2 4 -2  2 4 -2  2 4 2  -2 4 2") "AttributeEnd\n"
    "Material \"matte\" \"rgb Kd\" [.8 .7 .6] " QUAD("-1.5 0 -1.5  1.5 0 -1.5  1.5 0 1.5  -1.5 0 1.5")
    QUAD("-2 0 1.5  2 0 1.5  2 3 1.5  -2 3 1.5")
    "Material \"glass\" Translate 0 .7 0 Shape \"sphere\" \"float radius\" .6 WorldEnd\n";

static bool load(struct test *t, const char *filter, bool sky, bool warm, bool lamp, struct scene *out)
{
    return scene_from_format(t, out, SCENE, filter, sky, sky, sky, warm, warm, warm, warm, warm, warm, sky, sky, sky,
                             lamp, lamp, lamp) &&
           CHECK(t, out->lights.n_groups == GROUPS && strcmp(out->lights.group[1].name, "warm") == 0 &&
                     out->lights.group[2].name == NULL && out->lights.group[2].kind == LIGHT_AREA,
                 "%d groups of %d lights", out->lights.n_groups, out->lights.n);
}

/* Planes of light add up to the picture, and this is what it is without them. */
static void check_sum(struct test *t, const struct scene *scene, const struct render_job *o, const char *what)
{
    struct rendered r;
    struct film plain;
    int wrong = 0;
    render_planes(t, scene, o, true, true, &r);
    render_film(t, scene, o, &plain);
    for (size_t i = 0; i < SUMS; i++) {
        struct exact_sum sum = {{0, 0, 0}, 0};
        for (int g = 1; g <= GROUPS; g++)
            exact_join(&sum, &plane(&r, g)->sum[i]);
        wrong += exact_value(&sum) != film_value(&r.film, i);
    }
    CHECK(t, wrong == 0, "%s: lights do not add up to %d values of the picture", what, wrong);
    CHECK(t, films_equal(&r.film, &plain), "%s: keeping lights apart changes the picture", what);
    for (int g = 1; g <= GROUPS; g++)
        CHECK(t, plane_total(plane(&r, g)) > 1e-3 * plane_total(&r.film) &&
                     plane(&r, g)->iterations == r.film.iterations, "%s: light %d has %g of %g", what, g - 1,
              plane_total(plane(&r, g)), plane_total(&r.film));
    rendered_free(&r);
    film_free(&plain);
}

static void check_sum_by(struct test *t, struct scene *scene, const char *way)
{
    char what[64];
    struct render_job o = {.n_threads = os_cores(), .seed = test_seed(t), .end = 8, .max_depth = 4};
    snprintf(what, sizeof what, "%s", way);
    o.integrator = set_row(scene, what);
    check_sum(t, scene, &o, what);
}

/* By every method, and through media. */
static void test_sum(struct test *t)
{
    static const char *const MEDIA[] = {"pt", "lt", "bdpt", "asbdpt"};
    struct scene scene, foggy;
    if (!load(t, "mitchell", true, true, true, &scene) || !scene_from_text(t, FOGGY, &foggy))
        return;
    for (const struct method *const *m = method_rows; *m != NULL; m++)
        if (!method_is_chain(*m) && !method_merges(*m))
            check_sum_by(t, &scene, method_name(*m));
    for (int i = 0; i < 4 && CHECK(t, foggy.lights.n_groups == GROUPS, "%d groups", foggy.lights.n_groups); i++)
        check_sum_by(t, &foggy, MEDIA[i]);
    scene_free(&scene);
    scene_free(&foggy);
}

/* What no float holds is left out of the lights' planes as it is of the picture. */
static void test_left_out(struct test *t)
{
    static const double STEP[] = {0, 1, 1e39, NAN, 2};
    struct pixel_rect one = {0, 0, 1, 1};
    struct filter box = filter_of("box");
    struct light lights[2] = {{.group = 0}, {.group = 1}};
    struct scene scene = {.lights = {.light = lights, .n = 2, .n_groups = 2}};
    struct film film;
    struct planes p;
    struct tile tile = {.sum = NULL};
    film_init(&film, one, 1, 1);
    planes_init(&p, &scene, &film, true, false, false, 1);
    struct observers o = planes_observers(&p);
    tile_start(&tile, pixels_all(one), one, &box);
    struct observer of_pass = o.begin(o.context, 0, &tile);
    for (int i = 0; i < 4; i++) {
        const struct sample sample = {.value = rgb_grey(STEP[i])};
        const struct connection c = {.light = i % 2, .value = rgb_grey(1)};
        const struct joined step = {.s = 1, .t = 2, .c = &c, .added = rgb_grey(STEP[i + 1] - STEP[i])};
        of_pass.joined(of_pass.context, &sample, &step);
    }
    o.end(o.context, 0);
    CHECK(t, film_value(&p.film[0], 0) == 1 && film_value(&p.film[1], 0) == -1, "lights of %g and %g",
          film_value(&p.film[0], 0), film_value(&p.film[1], 0));
    tile_free(&tile);
    planes_free(&p);
    film_free(&film);
}

/* Batches of some planes of the same renders, averaged over quarters of the picture. */
static void make_batches(struct test *t, const struct scene *scene, const char *integrator, int first, int n,
                         uint64_t seed, struct batches *out)
{
    enum { BATCHES = 12 };
    const int spp = strcmp(integrator, "lt") == 0 ? 16 : 4; /* splats are few */
    struct batches pixels[GROUPS];
    for (int g = 0; g < n; g++)
        pixels[g] = batches_new(BATCHES, SUMS, false);
    for (int k = 0; k < BATCHES; k++) {
        struct render_job o = {.integrator = method_of(scene, integrator), .n_threads = os_cores(), .max_depth = 4,
                                   .seed = (test_seed(t) * 64 + seed) * BATCHES + (uint64_t)k,
                                   .end = spp * test_effort(t)};
        struct rendered r;
        render_planes(t, scene, &o, true, false, &r);
        for (int i = 0; i < n * SUMS; i++)
            pixels[i / SUMS].value[SUMS * k + i % SUMS] =
                film_value(plane(&r, first + i / SUMS), (size_t)(i % SUMS)) / (double)r.film.iterations;
        rendered_free(&r);
    }
    for (int g = 0; g < n; g++) {
        out[g] = batches_tiles(&pixels[g], SIDE, SIDE, SIDE / 2);
        batches_free(&pixels[g]);
    }
}

/* Each light's plane, and the picture of the scene with the others off; what must fail: with another one on. */
static void test_alone(struct test *t, const char *way)
{
    struct scene scene;
    struct batches apart[GROUPS], alone[GROUPS];
    for (int g = -1; g < GROUPS; g++) {
        if (!load(t, "gaussian", g < 0 || g == 0, g < 0 || g == 1, g < 0 || g == 2, &scene))
            return;
        make_batches(t, &scene, set_method(&scene, way), g < 0, g < 0 ? GROUPS : 1, (uint64_t)(g + 1),
                     g < 0 ? apart : &alone[g]);
        scene_free(&scene);
    }
    for (int g = 0; g < GROUPS; g++) {
        double ratio, p = batches_p(&apart[g], &alone[g], &ratio);
        TEST_ACCEPT(t, p, "%s: light %d apart over alone: %g", way, g, ratio);
        p = batches_p(&apart[g], &alone[(g + 1) % GROUPS], &ratio);
        TEST_REJECT(t, p, "%s: light %d over another: %g", way, g, ratio);
    }
    for (int g = 0; g < GROUPS; g++) {
        batches_free(&apart[g]);
        batches_free(&alone[g]);
    }
}

/* --- what the lens sees ------------------------------------------------------------------------------- */

#define CAMERA                                                                                                         \
    "LookAt 0 0 -4  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 40\n"                                            \
    "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 16 PixelFilter \"%s\" WorldBegin\n"
#define HALF QUAD("-9 0 0  9 0 0  9 9 0  -9 9 0")

static bool render_text(struct test *t, const char *text, const char *filter, int spp, struct rendered *out)
{
    struct scene scene;
    struct render_job o = {.integrator = method_named("pt"), .n_threads = 1, .end = spp, .max_depth = 2};
    if (!scene_from_format(t, &scene, text, filter))
        return false;
    render_planes(t, &scene, &o, false, true, out);
    scene_free(&scene);
    return true;
}

/* Alpha of every pixel, where it is the same for all: of each row above `rows`, or in all rows. */
static void check_alpha(struct test *t, const char *what, const char *text, int rows, double above, double below)
{
    static const char *const FILTERS[] = {"box", "triangle", "gaussian"};
    static const double OFF[] = {0, 0.01, 0.01}; /* the weights of the last two are 1 but for tables' steps */
    for (int k = 0; k < 3; k++) {
        struct rendered r;
        float alpha[SUMS];
        int wrong = 0;
        if (!render_text(t, text, FILTERS[k], 64, &r))
            return;
        film_develop(planes_alpha(&r.planes), 1, alpha);
        for (int i = 0; i < SUMS; i++) {
            int row = i / 3 / SIDE;
            bool edge = k > 0 && (row - rows) * (row - rows + 1) <= 2; /* the filters reach two pixels */
            wrong += !edge && !(fabs((double)alpha[i] - (row < rows ? above : below)) <= OFF[k]);
        }
        CHECK(t, wrong == 0, "%s, %s: %d values of alpha are wrong, the first %g, the last %g", what, FILTERS[k], wrong,
              (double)alpha[0], (double)alpha[SUMS - 1]);
        rendered_free(&r);
    }
}

static void test_alpha(struct test *t)
{
    static const char SKY[] = CAMERA "LightSource \"infinite\" WorldEnd";
    static const char HIDDEN[] = CAMERA "LightSource \"infinite\" \"bool visible\" \"false\" WorldEnd";
    static const char BEFORE_HIDDEN[] = CAMERA HALF "LightSource \"infinite\" \"bool visible\" \"false\" WorldEnd";
    static const char LAMP[] = CAMERA "Material \"none\" AreaLightSource \"diffuse\" " HALF "WorldEnd";
    static const char HIDDEN_LAMP[] =
        CAMERA "Material \"none\" AreaLightSource \"diffuse\" \"bool visible\" \"false\" " HALF "WorldEnd";
    check_alpha(t, "nothing", CAMERA "WorldEnd", 0, 0, 0);
    check_alpha(t, "a closed scene", CAMERA "Shape \"sphere\" \"float radius\" 9 WorldEnd", 0, 1, 1);
    check_alpha(t, "half a plane", CAMERA HALF "WorldEnd", SIDE / 2, 1, 0);
    check_alpha(t, "a sky", SKY, 0, 1, 1);
    check_alpha(t, "a hidden sky", HIDDEN, 0, 0, 0);
    check_alpha(t, "half a plane before a hidden sky", BEFORE_HIDDEN, SIDE / 2, 1, 0);
    check_alpha(t, "a see-through lamp", LAMP, SIDE / 2, 1, 0);
    check_alpha(t, "a hidden see-through lamp", HIDDEN_LAMP, 0, 0, 0);
}

/* What a light brings where the lens meets it first is what is missing when it is hidden: L times what is not covered,
 * of a sky; of a lamp L where it is. All other light stays. */
static void test_hidden(struct test *t, const char *what, const char *text, double (*missing)(double alpha))
{
    struct rendered seen, hidden;
    char without[2048], *visible;
    snprintf(without, sizeof without, "%s", text);
    if ((visible = strstr(without, "\"bool visible\" \"false\"")) == NULL)
        return;
    memset(visible, ' ', strlen("\"bool visible\" \"false\""));
    if (!render_text(t, without, "gaussian", 16, &seen))
        return;
    if (render_text(t, text, "gaussian", 16, &hidden)) {
        double worst = 0, light = plane_total(&hidden.film);
        for (size_t i = 0; i < SUMS; i++) {
            double alpha = film_value(plane(&hidden, 1), i) / 16, full = film_value(plane(&seen, 1), i) / 16;
            double difference = (film_value(&seen.film, i) - film_value(&hidden.film, i)) / 16;
            worst = fmax(worst, fabs(difference - missing(full - alpha)));
        }
        CHECK(t, worst < 1e-9 && light > 1, "%s: off by %g, light of %g is left", what, worst, light);
        rendered_free(&hidden);
    }
    rendered_free(&seen);
}

static double once(double share) { return share; }

static void test_unseen(struct test *t)
{
    test_hidden(t, "a sky", CAMERA HALF "LightSource \"infinite\" \"bool visible\" \"false\" WorldEnd", once);
    test_hidden(t, "a see-through lamp", CAMERA "AttributeBegin Material \"none\" AreaLightSource \"diffuse\" "
                "\"bool twosided\" \"true\" \"bool visible\" \"false\" Translate 0 -9 0 " HALF "AttributeEnd "
                "Translate 0 0 1 " HALF "WorldEnd", once);
}

void test_lights(struct test *t)
{
    static const char *const WAYS[] = {"pt", "lt", "bdpt", "asbdpt select=subspaces"};
    test_sum(t);
    test_left_out(t);
    for (int i = 0; i < 4; i++)
        test_alone(t, WAYS[i]);
    test_alpha(t);
    test_unseen(t);
}
