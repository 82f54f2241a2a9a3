/* Gates: light whose path to the lens has a length between two bounds (lab/paths.h). Gates that follow each other
 * add up to the ungated film, but for rounding, by every method; totals are those of the pixels. The lengths of
 * chains and cones have a closed form. That all strategies give a path the length that it has is in test_mis.c. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/os.h"
#include "lab/paths.h"
#include "lab/methods.h"
#include "agree.h"
#include "bench.h"
#include "helpers.h"
#include "suites.h"

/* A film, and what comes by each of some gates, [n][pixels*3]. */
struct flight {
    struct film film;
    double *sum;
    size_t values; /* of the film, pixels*3 */
};

static struct flight fly(struct test *t, const struct scene *scene, const struct render_job *o, struct gates gates)
{
    struct flight f;
    struct error err;
    film_init(&f.film, render_crop(scene), scene->width, scene->height);
    f.values = 3 * rect_pixels(f.film.rect);
    f.sum = mem_alloc((size_t)gates.n * f.values, sizeof *f.sum);
    CHECK(t, gates_render(scene, o, &gates, &f.film, f.sum, &err), "%s", err.text);
    return f;
}

static void flight_free(struct flight *f)
{
    film_free(&f->film);
    free(f->sum);
}

/* What comes by gate i. */
static double total(const struct flight *f, int i)
{
    double sum = 0;
    for (size_t k = 0; k < f->values; k++)
        sum += f->sum[(size_t)i * f->values + k];
    return sum;
}

static double film_total(const struct film *film)
{
    double sum = 0;
    for (size_t i = 0; i < 3 * rect_pixels(film->rect); i++)
        sum += film_value(film, i);
    return sum;
}

/* --- the sum ------------------------------------------------------------------------------------------ */

/* Light of all sorts, a see-through lamp among them, by way of glass; a filter with negative lobes. */
static const char MIXED[] =
    "LookAt 0 1.6 -4.5  0 .9 0  0 1 0 Camera \"perspective\" \"float fov\" 42\n"
    "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 14 PixelFilter \"mitchell\" WorldBegin\n"
    "LightSource \"infinite\" \"rgb L\" [.3 .4 .5]\n"
    "LightSource \"distant\" \"rgb L\" [1 1 1] \"point from\" [1 4 -1] \"point to\" [0 0 0]\n"
    "LightSource \"point\" \"rgb I\" [3 2 1] \"point from\" [-1 2 0]\n"
    "Material \"none\" AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [5 5 5] \"bool twosided\" \"true\"\n"
    QUAD("-2 4 -2  2 4 -2  2 4 2  -2 4 2")
    "AttributeEnd Material \"matte\" \"rgb Kd\" [.8 .7 .6] " QUAD("-1.5 0 -1.5  1.5 0 -1.5  1.5 0 1.5  -1.5 0 1.5")
    QUAD("-2 0 1.5  2 0 1.5  2 3 1.5  -2 3 1.5")
    "Material \"glass\" Translate 0 .7 0 Shape \"sphere\" \"float radius\" .6 WorldEnd\n";

/* The film is what it is without an observer, to the bit. Gates are sums of floats (paths.h): they add up to the film
 * within a few parts in 10^7 of what a value of it is in the mean. */
static void test_sum(struct test *t, const struct scene *scene, const struct render_job *o, const char *what)
{
    const struct gates gates = {0, 9, 12}; /* the last has the longest of four bounces and more */
    struct film plain;
    render_film(t, scene, o, &plain);
    struct flight f = fly(t, scene, o, gates);
    double whole = film_total(&plain), worst = 0;
    CHECK(t, films_equal(&f.film, &plain), "%s: a film with an observer is another", what);
    for (int i = 0; i < 2; i++)
        CHECK(t, total(&f, i) > 1e-3 * whole && total(&f, i) < 0.99 * whole, "%s: gate %d has %g of %g", what, i,
              total(&f, i), whole);
    for (size_t k = 0; k < f.values; k++) {
        double sum = 0;
        for (int i = 0; i < gates.n; i++)
            sum += f.sum[(size_t)i * f.values + k];
        worst = fmax(worst, fabs(sum - film_value(&plain, k)));
    }
    CHECK(t, worst < 2e-6 * whole / (double)f.values, "%s: gates do not add up to the picture: off by %g of %g", what,
          worst, whole / (double)f.values);
    film_free(&plain);
    flight_free(&f);
}

static void test_method(struct test *t, const char *text, const char *name)
{
    char way[64];
    struct scene scene;
    struct render_job o = {.n_threads = os_cores(), .seed = test_seed(t), .end = 8, .max_depth = 4};
    if (!scene_from_text(t, text, &scene))
        return;
    snprintf(way, sizeof way, "%s", name);
    o.integrator = set_row(&scene, way);
    test_sum(t, &scene, &o, way);
    scene_free(&scene);
}

/* Through media a length is counted from one point within them to the next. */
static void test_methods(struct test *t)
{
    static const char *const CAUSTICS[] = {"caustics with=pt longest=2", "caustics with=bdpt longest=2",
                                           "caustics with=asbdpt longest=2", "regularise with=pt angle=.2",
                                           "regularise with=bdpt angle=.2"};
    static const char *const MEDIA[] = {"pt", "lt", "bdpt", "asbdpt"};
    for (const struct method *const *m = method_rows; *m != NULL; m++)
        if (!method_is_chain(*m) && !method_merges(*m))
            test_method(t, MIXED, method_name(*m));
    for (int i = 0; i < 5; i++)
        test_method(t, MIXED, CAUSTICS[i]);
    for (int i = 0; i < 4; i++)
        test_method(t, FOGGY, MEDIA[i]);
}

/* Gates of one render are those of renders of their own, and begin where they are to. */
static void test_totals(struct test *t)
{
    enum { N = 5 };
    const struct gates gates = {5, 1.5, N};
    struct scene scene;
    struct render_job o = {.integrator = method_named("bdpt"), .n_threads = os_cores(), .end = 16, .max_depth = 4};
    if (!scene_from_text(t, MIXED, &scene))
        return;
    struct flight f = fly(t, &scene, &o, gates);
    for (int i = 0; i < N; i++) {
        struct flight one = fly(t, &scene, &o, (struct gates){gates.begin + i * gates.width, gates.width, 1});
        double added = total(&f, i);
        CHECK(t, added > 0 && total(&one, 0) == added, "gate %d: %g of one render, %g of its own", i, added,
              total(&one, 0));
        flight_free(&one);
    }
    flight_free(&f);
    scene_free(&scene);
}

/* --- beyond the scene --------------------------------------------------------------------------------- */

/* The sky all around a lens far outside the scene's sphere: nothing is lost of what it sees on the side away from the
 * scene, where light is at the lens before it is at the sphere. */
static void test_outside(struct test *t)
{
    static const char TEXT[] =
        "LookAt 0 0 50  0 0 0  0 1 0 Camera \"environment\" Film \"image\" \"integer xresolution\" 16\n"
        "\"integer yresolution\" 8 WorldBegin LightSource \"infinite\" \"rgb L\" [1 1 1]\n"
        "Material \"matte\" \"rgb Kd\" [0 0 0] Shape \"sphere\" \"float radius\" .01 WorldEnd\n";
    struct scene scene;
    struct render_job o = {.integrator = method_named("pt"), .n_threads = 1, .end = 16, .max_depth = 1};
    if (!scene_from_text(t, TEXT, &scene))
        return;
    struct flight early = fly(t, &scene, &o, (struct gates){0, 1e-6, 1});
    double all = 3.0 * 16 * 8 * 16, share = total(&early, 0) / all;
    CHECK(t, film_total(&early.film) > 0.99 * all && share > 0.49 && share < 0.51,
          "of the sky %g, before the sphere %g of it", film_total(&early.film) / all, share);
    flight_free(&early);
    scene_free(&scene);
}

/* --- chains and cones --------------------------------------------------------------------------------- */

/* The share of a method's light that is shorter than `end`. */
static double share(struct test *t, const char *text, const char *way, long spp, double end)
{
    struct scene scene;
    struct render_job o = {.n_threads = os_cores(), .end = spp, .max_depth = 3};
    if (!scene_from_text(t, text, &scene))
        return NAN;
    o.integrator = set_row(&scene, way);
    struct flight f = fly(t, &scene, &o, (struct gates){0, end, 1});
    double out = total(&f, 0) / film_total(&f.film);
    flight_free(&f);
    scene_free(&scene);
    return out;
}

/* A point light 3 above the middle of a floor, which the lens sees from 2 above, and its image in a mirror, sqrt(13)
 * away, which chains and cones make. */
static void test_mirror(struct test *t)
{
    static const char MIRROR[] =
        "LookAt 0 2 0  0 0 0  0 0 1 Camera \"perspective\" \"float fov\" 2\n"
        "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8 PixelFilter \"box\" WorldBegin\n"
        "LightSource \"point\" \"point from\" [0 3 0] Material \"matte\"\n"
        QUAD("-2 0 -2  2 0 -2  2 0 1  -2 0 1")
        "Material \"mirror\" \"rgb Kr\" [1 1 1] " QUAD("-9 0 1  9 0 1  9 9 1  -9 9 1") "WorldEnd\n";
    static const double END[] = {4.9, 5.1, 5.5, 5.9};
    const double direct = 1.0 / 9, image = 3 / sqrt(13) / 13; /* cosine over distance^2 */
    for (int i = 0; i < 4; i++) {
        double wanted = i == 0 ? 0 : i == 3 ? 1 : direct / (direct + image);
        double chains = share(t, MIRROR, "caustics with=pt longest=1", 4, END[i]);
        double cones = share(t, MIRROR, "regularise with=pt angle=.2", 512, END[i]);
        CHECK(t, fabs(chains - wanted) < 1e-3 && fabs(cones - wanted) < 0.06,
              "shorter than %g: %g by chains, %g by cones, not %g", END[i], chains, cones, wanted);
    }
}

/* --- ellipsoidal connections -------------------------------------------------------------------------- */

/* The whole film of an `ellipse` with these bounds is what pt has in that gate. */
static void agrees_with_pt(struct test *t, const char *text, double begin, double end, double brighter)
{
    const struct gate gate = {begin, end};
    struct scene scene;
    if (!scene_from_text(t, text, &scene))
        return;
    char way[64];
    snprintf(way, sizeof way, "ellipse from=%g to=%g", begin, end);
    struct batches a = render_batches(t, &scene, set_method(&scene, way), 4, 64, 12, 4, 91);
    struct batches b = render_gated(t, &scene, set_method(&scene, "pt"), 4, gate, 128, 12, 4, 92);
    check_agree(t, &a, &b, false, brighter - 1, "ellipse against pt, %g to %g", begin, end);
    batches_free(&b);
    scene_free(&scene);
}

/* The second scene has no light in its gates but what ellipsoidal connections make: by way of a wall of few triangles,
 * or two bounces more. */
static void test_ellipses(struct test *t)
{
    static const char WALL[] =
        "LookAt 0 2 0  0 0 0  0 0 1 Camera \"perspective\" \"float fov\" 10\n"
        "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8 PixelFilter \"box\" WorldBegin\n"
        "LightSource \"point\" \"point from\" [.5 1.5 -.5] Material \"matte\" \"rgb Kd\" [.8 .7 .6]\n"
        QUAD("-2 0 -2  2 0 -2  2 0 1.5  -2 0 1.5")
        QUAD("-2 0 1.5  2 0 1.5  2 3 1.5  -2 3 1.5") "WorldEnd\n";
    agrees_with_pt(t, MIXED, 9, 9.3, 1.25);
    agrees_with_pt(t, WALL, 5.6, 6.2, 1.1);
    agrees_with_pt(t, WALL, 6.2, 7, 1.1);
}

void test_gates(struct test *t)
{
    test_methods(t);
    test_mirror(t);
    test_ellipses(t);
    test_totals(t);
    test_outside(t);
}
