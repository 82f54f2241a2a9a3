/* test_caustic.c: chains of mirrors and glass: their derivatives, closed forms, and that no path is counted twice or
 * lost. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/exact_sum.h"
#include "caustics/caustic.h"
#include "agree.h"
#include "helpers.h"
#include "random_parts.h"
#include "suites.h"

/* --- one chain --------------------------------------------------------------------------------------- */

/* Where the chain left in direction w meets the plane across the last edge of `c` through y. */
static vec3 arrival(const struct quest *q, vec3 w, const struct specular_chain *c)
{
    struct specular_chain moved;
    if (!specular_trace(q, normalize(w), &moved))
        return vec(NAN, NAN, NAN);
    if (q->parallel)
        return moved.d;
    return add(moved.p, mul(moved.d, dot(sub(q->y->p, moved.p), c->d) / dot(moved.d, c->d)));
}

/* |det J| by differences. */
static double area_by_differences(const struct quest *q, const struct specular_chain *c)
{
    const double h = 1e-6; /* chains may be nearly singular */
    const struct frame f = frame_from_normal(c->w);
    vec3 s = mul(f.s, h), t = mul(f.t, h);
    vec3 ds = sub(arrival(q, add(c->w, s), c), arrival(q, sub(c->w, s), c));
    vec3 dt = sub(arrival(q, add(c->w, t), c), arrival(q, sub(c->w, t), c));
    return fabs(dot(cross(ds, dt), c->d)) / (4 * h * h);
}

#define SMOOTH                                                                                                         \
    QUAD("-1 -1 0  1 -1 0  1 1 .1  -1 1 0") "\"normal N\" [-.2 -.2 1  .2 -.3 1  .2 .3 1  -.1 .2 1]"

/* From many points below a thing to many above it, or to directions: chains through it, or by way of it. */
static void test_derivatives(struct test *t)
{
    static const struct {
        const char *what, *thing;
        int group, k;
        double below; /* height of z */
    } cases[] = {
        {"glass ball", "Material \"glass\" Shape \"sphere\" \"float radius\" .5", -1, 2, -1},
        {"glass egg", "Scale .8 1.2 1 Material \"glass\" Shape \"sphere\" \"float radius\" .5", -1, 2, -1},
        {"one surface", "Material \"glass\" Shape \"sphere\" \"float radius\" 1 \"float zmin\" .2", -1, 1, -1},
        {"mirror ball", "Material \"mirror\" Shape \"sphere\" \"float radius\" .5", 0, 1, 1},
        {"mirror bowl", "Material \"mirror\" Shape \"paraboloid\" \"float radius\" 1 \"float zmax\" .4", 0, 1, 1},
        {"smooth mesh", "Material \"mirror\" " SMOOTH, 0, 1, 1},
        {"smooth pane", "Material \"glass\" " SMOOTH, -1, 1, -1}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct scene scene;
        struct arena arena = {NULL, NULL};
        struct rng r = rng_stream(test_seed(t), RNG_TEST, i, 0);
        int found = 0;
        double worst = 0;
        if (!scene_from_format(t, &scene, "WorldBegin LightSource \"point\" Rotate 20 1 1 0 %s WorldEnd",
                               cases[i].thing))
            continue;
        for (int n = 0; n < 200; n++) {
            struct vertex z = {.p = vec(rng_uniform(&r) - .5, rng_uniform(&r) - .5, 1 + rng_uniform(&r))};
            z.p.z *= cases[i].below;
            struct light_point y = {.p = vec(rng_uniform(&r) - .5, rng_uniform(&r) - .5, 1.5 + rng_uniform(&r))};
            y.w = normalize(y.p);
            struct quest q = {&scene, &arena, &z, &y, n % 2 == 1, cases[i].group, 1, cases[i].k};
            vec3 middle = vec(0.1 * rng_uniform(&r), 0.1 * rng_uniform(&r), cases[i].below > 0 ? 0 : 0.3);
            struct specular_chain c;
            if (!specular_search(&q, normalize(sub(middle, z.p)), &c))
                continue;
            double area = specular_area(&q, &c), differences = area_by_differences(&q, &c);
            if (isnan(differences))
                continue;
            found++;
            worst = fmax(worst, fabs(area - differences) / (differences + 1e-3));
        }
        CHECK(t, found > 40, "%s: only %d chains found", cases[i].what, found);
        CHECK(t, worst < 1e-3, "%s: J is wrong by a factor of %g", cases[i].what, 1 + worst);
        arena_free(&arena);
        scene_free(&scene);
    }
}

/* --- closed forms ------------------------------------------------------------------------------------ */

/* Chains count in the length of a path. */
static void test_depth(struct test *t)
{
    struct scene scene;
    if (!scene_from_file(t, "scenes/test/caustic-pane.pbrt", 0, 0, &scene))
        return;
    for (int depth = 2; depth <= 3; depth++) {
        const char *way = set_method(&scene, "caustics with=pt longest=2");
        struct batches b = render_batches(t, &scene, way, depth, 1, 2, 4, 3);
        CHECK(t, (batches_mean(&b, NULL) > 0) == (depth == 3), "a chain of two at maxdepth %d", depth);
        batches_free(&b);
    }
    scene_free(&scene);
}

static void test_closed_forms(struct test *t)
{
    static const struct {
        const char *scene;
        double radiance;
    } cases[] = {{"scenes/test/caustic-pane.pbrt", 1.3637342561791495},
                 {"scenes/test/caustic-mirror.pbrt", 4.536155547174597}};
    static const char *const ways[] = {"caustics with=pt", "caustics with=bdpt", "caustics with=asbdpt"};
    for (int i = 0; i < 6; i++) {
        struct scene scene;
        if (!scene_from_file(t, cases[i % 2].scene, 0, 0, &scene))
            return;
        struct batches b = render_batches(t, &scene, set_method(&scene, ways[i / 2]), 5, 1, 2, 4, 3);
        double mean = batches_mean(&b, NULL), wanted = cases[i % 2].radiance;
        CHECK(t, fabs(mean / wanted - 1) < 1e-4, "%s by %s: %.6f, not %.6f", cases[i % 2].scene,
              ways[i / 2], mean, wanted);
        batches_free(&b);
        scene_free(&scene);
    }
}

#define FLOOR                                                                                                          \
    "LookAt 0 2 -2  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 20\n"                                            \
    "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8 PixelFilter \"box\"\n"                         \
    "WorldBegin LightSource \"point\" \"point from\" [0 3 0] \"rgb I\" [9 9 9] Material \"matte\"\n"                   \
    QUAD("-2 0 -2  2 0 -2  2 0 2  -2 0 2")

static struct film floor_under(struct test *t, const char *things, const char *way, long spp)
{
    struct scene scene;
    struct film film = {.sum = NULL};
    if (scene_from_format(t, &scene, FLOOR "%s WorldEnd", things)) {
        struct render_job o = {.integrator = set_row(&scene, way), .end = spp, .max_depth = 3, .n_threads = 1};
        render_film(t, &scene, &o, &film);
        scene_free(&scene);
    }
    return film;
}

/* A pane of index 1 is not there; where nothing is specular caustics change no bit. */
static void test_nothing_there(struct test *t)
{
    static const char pane[] = "Material \"glass\" \"float index\" 1 \"rgb Kr\" [0 0 0]\n"
                               "Shape \"sphere\" \"float radius\" 1.9\n";
    struct film bare = floor_under(t, "", "pt", 2), with = floor_under(t, "", "caustics with=pt longest=2", 2),
                behind = floor_under(t, pane, "caustics with=pt longest=1", 2);
    double worst = 0;
    CHECK(t, films_equal(&bare, &with), "caustics change a scene without specular surfaces");
    for (int i = 0; i < 8 * 8 * 3; i++)
        worst = fmax(worst, fabs(exact_value(&bare.sum[i]) / exact_value(&behind.sum[i]) - 1));
    CHECK(t, worst < 1e-6, "through a ball of index 1: off by %g", worst);
    film_free(&bare);
    film_free(&with);
    film_free(&behind);
}

/* --- the partition ----------------------------------------------------------------------------------- */

/* By the same numbers they share sub-paths, and most of their noise; lt has no part in that. */
static const struct agreement PARTITION[] = {
    {"scenes/test/caustic-ball", 12, 8, 4, "lt", "caustics with=bdpt longest=2", 256, 96, 12, 4, false, 0.15},
    {"scenes/test/caustic-bulb", 12, 8, 4, "bdpt", "caustics with=pt longest=2", 64, 64, 12, 4, true, 0.15},
    {"scenes/test/caustic-diver", 12, 8, 4, "lt", "caustics with=asbdpt longest=1", 32, 32, 12, 4, false, 0.15},
    {"scenes/test/mirror-glass", 12, 8, 4, "bdpt", "caustics with=pt longest=2", 24, 24, 12, 4, true, 0.15},
    {"scenes/test/mirror-glass", 12, 8, 4, "bdpt", "caustics with=bdpt longest=2", 16, 16, 12, 4, true, 0.15}};

/* Here a path tracer wins the race of asbdpt: its weights count light sub-paths in one of 32 iterations. */
static void test_path_tracer(struct test *t)
{
    static const struct agreement row = {"yard", .depth = 4, .right = "bdpt", .ways = "caustics with=asbdpt longest=1",
                                         .right_spp = 16, .spp = 16, .batches = 12, .tile = 12, .planted = 0.15};
    struct scene scene;
    if (!scene_from_structure(t, 354, 48, 36, &scene))
        return;
    check_agreement_in(t, &scene, &row, 1);
    scene_free(&scene);
}

/* --- any receiver -------------------------------------------------------------------------------------- */

/* A floor of any material at y = 0; above it a pane that is not there, of index 1, or a mirror behind; a lamp, which
 * points are seldom drawn on, since there is a bright point light, too. To be given to free(). */
static char *receiver(uint64_t number, const char *top, bool mirror)
{
    struct writer w = {.rng = rng_stream(number, RNG_TEST, 8, mirror), .top = top};
    put(&w, "LookAt %g 3 -4  0 0 0  0 1 0 Camera \"perspective\" WorldBegin\n", between(&w, -1, 1));
    put(&w, "LightSource \"point\" \"point from\" [0 9 0] \"float scale\" %g AttributeBegin\n", across(&w, 1, 1e4));
    put(&w, "AreaLightSource \"diffuse\" \"bool twosided\" \"true\" Translate 0 3 %g Rotate 90 1 0 0\n"
            "Shape \"disk\" \"float radius\" %g AttributeEnd\nAttributeBegin ", mirror ? 1.5 : 3, across(&w, 0.3, 1));
    put(&w, mirror ? "Material \"mirror\" Translate 0 0 4 Shape \"disk\" \"float radius\" 9 AttributeEnd\n"
                   : "Material \"glass\" \"float index\" 1 Translate 0 1.5 1.7 Rotate 90 1 0 0\n"
                     "Shape \"disk\" \"float radius\" 1.2 AttributeEnd\n");
    put_textures(&w);
    put_material(&w, false);
    put(&w, QUAD("-3 0 -3  3 0 -3  3 0 3  -3 0 3") "WorldEnd");
    return w.text;
}

static bool meet(const struct scene *scene, vec3 from, vec3 to, uint64_t left, struct surface *at)
{
    struct ray ray = {from, normalize(sub(to, from)), ray_margin(from), INFINITY, left, 0};
    return scene_intersect(scene, &ray, at);
}

/* Where the eye's walk arrives at the floor. */
static bool first_hit(const struct scene *scene, struct arena *arena, vec3 eye, vec3 at, struct vertex *z)
{
    struct surface hit;
    double px, py;
    if (!meet(scene, eye, at, 0, &hit) || length(sub(hit.p, at)) > 1e-6)
        return false;
    vec3 d = sub(hit.p, eye), w = normalize(d);
    double pdf = camera_project(&scene->camera, eye, w, &px, &py) * camera_falloff(&scene->camera, length2(d));
    *z = (struct vertex){.kind = VERTEX_SURFACE, .eye_hit = FIRST_HIT, .light = -1, .p = hit.p,
                         .ng = hit.ng, .prim_id = hit.prim_id, .wo = neg(w), .beta = rgb_grey(1),
                         .pdf_fwd = pdf * abs_dot(hit.ng, w)};
    material_bsdf(scene->material, hit.material, &scene->textures, &hit, arena, &z->bsdf);
    return true;
}

/* What the three that make the path weigh it, together, where a chain of one vertex leads to y by way of `image`. */
static double all_weights(const struct one_more *extra, const struct sample *sample, vec3 eye, const struct vertex *z,
                          const struct one_more_path *made, vec3 image)
{
    const struct light_point *y0 = &made->y0;
    struct surface at;
    if (!meet(sample->pass->job->scene, z->p, image, z->prim_id, &at))
        return 0;
    struct vertex x = {.kind = VERTEX_SURFACE, .light = -1, .p = at.p, .ng = at.ng, .prim_id = at.prim_id};
    struct vertex y = {.kind = VERTEX_SURFACE, .prev_delta = true, .light = y0->light, .p = y0->p,
                       .ng = vec(0, 1, 0), .wo = normalize(sub(x.p, y0->p))};
    struct vertex seen[4] = {{.kind = VERTEX_LENS, .p = eye}, *z, x, y}, sent[3] = {y, x, *z};
    sent[0].kind = VERTEX_LIGHT;
    sent[0].prev_delta = false;
    sent[0].pdf_fwd = y0->pdf;
    sent[2].prev_delta = true;
    sent[2].wo = normalize(sub(x.p, z->p));
    struct connection hit = {.weight = -1}, splat = {.weight = -1};
    const struct joined by_chance = {.s = 0, .t = 4, .z = &seen[3], .c = &hit};
    const struct joined to_lens = {.s = 3, .t = 1, .path = sent, .c = &splat};
    extra->weigh(extra, sample, &by_chance, z->p, &hit);
    extra->weigh(extra, sample, &to_lens, eye, &splat);
    return made->c.weight + hit.weight + splat.weight;
}

/* Whoever makes a path of Psi, and from whichever end: the weights add up to 1, on all that scatters. */
static void test_receivers(struct test *t)
{
    char top[1024];
    int met = 0;
    top_directory(top, sizeof top);
    for (uint64_t i = 0; i < 100; i++) {
        bool mirror = i % 2 == 1;
        struct scene scene;
        struct workspace work = {.arena = {NULL, NULL}};
        char *text = receiver(i, top, mirror);
        struct rng r = rng_stream(test_seed(t), RNG_TEST, i, 9);
        if (!scene_from_text(t, text, &scene))
            continue;
        vec3 eye = scene.camera.position;
        struct one_more *extra = caustics_new(&scene, 1);
        const struct counts counts = {.s0 = {1, 1}, .s1 = {1, 1}, .pair = {1, 1}, .lens = 640 * 480,
                                      .tables = &NO_TABLES};
        const struct render_job job = {.scene = &scene, .max_depth = 5};
        const struct tile_pass pass = {.job = &job, .counts = &counts, .work = &work, .ends_at = CANCEL_NOW};
        struct sample sample = {.pass = &pass};
        for (int n = 0; n < 40; n++) {
            vec3 at = sub(vec(4 * rng_uniform(&r) - 2, 0, 4 * rng_uniform(&r) - 2), scene.origin);
            struct vertex z, path[2];
            struct one_more_path c[ONE_MORE_MOST];
            if (!first_hit(&scene, &work.arena, eye, at, &z))
                continue;
            path[1] = z;
            sample.sampler = sampler_start(test_seed(t), RNG_TEST, i, (uint64_t)n);
            for (int k = extra->connect(extra, &sample, path, 2, c); k-- > 0;)
                if (!rgb_is_black(c[k].c.value) && c[k].y0.p.y + scene.origin.y < 9) {
                    vec3 image = add(c[k].y0.p, scene.origin);
                    image.z = mirror ? 8 - image.z : image.z;
                    double sum = all_weights(extra, &sample, eye, &z, &c[k], sub(image, scene.origin));
                    met++;
                    CHECK(t, fabs(sum - 1) < 1e-6, "receiver %d: weights add up to %.9f", (int)i, sum);
                }
        }
        caustics_free(extra);
        arena_free(&work.arena);
        scene_free(&scene);
        free(text);
    }
    CHECK(t, met > 1000, "only %d chains", met);
}

/* --- regularisation ---------------------------------------------------------------------------------- */

/* Mean of a film. */
static double mean_of(const struct film *film)
{
    double sum = 0;
    for (int i = 0; i < 8 * 8 * 3; i++)
        sum += exact_value(&film->sum[i]);
    return sum / (8 * 8 * 3) / (double)film->iterations;
}

#define MIRROR "Material \"mirror\" \"rgb Kr\" [1 1 1]\n" QUAD("-9 0 1  9 0 1  9 9 1  -9 9 1")

/* FLOOR is lit by way of a mirror, too: cones give the picture of caustic connections, to eps^2, and so do these if
 * they have to look for another mirror, far away, half of the time. By bdpt light sub-paths make what the lens sees, so
 * that there is nothing to regularise. */
static void test_cones(struct test *t)
{
    static const struct {
        const char *things, *way;
        long spp;
    } cases[] = {{MIRROR, "caustics with=pt longest=1", 2},
                 {MIRROR "Translate 90 0 0 Shape \"sphere\"", "caustics with=pt longest=1", 64},
                 {MIRROR, "regularise with=pt angle=.4", 1024},
                 {MIRROR, "regularise with=pt angle=.3", 1024},
                 {MIRROR, "regularise with=bdpt angle=.3", 256}};
    double wanted = 0;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct film film = floor_under(t, cases[i].things, cases[i].way, cases[i].spp);
        double mean = mean_of(&film);
        wanted = i == 0 ? mean : wanted;
        CHECK(t, fabs(mean / wanted - 1) < .06, "%s: %.5f, not %.5f", cases[i].way, mean, wanted);
        film_free(&film);
    }
}

/* What nothing else makes is never left out, however dim. */
static void test_dim(struct test *t)
{
    static const char DIM[] = "Material \"mirror\" \"rgb Kr\" [.05 .05 .05]\n" QUAD("-9 0 1  9 0 1  9 9 1  -9 9 1");
    struct film with = floor_under(t, DIM, "caustics with=pt longest=1", 2), without = floor_under(t, DIM, "pt", 2);
    double ratio = mean_of(&with) / mean_of(&without);
    CHECK(t, ratio > 1.02 && ratio < 1.05, "a dim mirror's light makes a picture %g times as bright", ratio);
    film_free(&with);
    film_free(&without);
}

/* Where area lights are, or light sub-paths make the path, no bit changes, whatever the method has learnt; nor where light
 * sub-paths make what chains would so well that chains do not pay; but for a small ball of glass they do. */
static void test_no_rival(struct test *t)
{
    static const struct {
        const char *scene, *with, *without;
        bool same;
    } cases[] = {{"scenes/test/caustic-ball.pbrt", "regularise with=bdpt angle=.1", "bdpt", true},
                 {"scenes/test/mirror-glass.pbrt", "regularise with=pt angle=.1", "pt", true},
                 {"scenes/forest.pbrt", "caustics with=asbdpt", "asbdpt", true},
                 {"scenes/test/caustic-lens.pbrt", "caustics with=bdpt longest=2", "bdpt", true},
                 {"scenes/test/caustic-lens.pbrt", "caustics with=pt longest=2", "pt", false},
                 {"scenes/test/caustic-ball.pbrt", "caustics with=bdpt longest=2", "bdpt", false}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const struct render_job o = {.end = 8, .max_depth = 4, .n_threads = 1};
        struct scene scene;
        if (!scene_from_file(t, cases[i].scene, 16, 16, &scene))
            return;
        CHECK(t, same_picture(t, &scene, cases[i].without, cases[i].with, o) == cases[i].same, "%s: %s %s the picture",
              cases[i].scene, cases[i].with, cases[i].same ? "changes" : "does not change");
        scene_free(&scene);
    }
}

void test_caustic(struct test *t)
{
    test_cones(t);
    test_dim(t);
    test_no_rival(t);
    test_derivatives(t);
    test_closed_forms(t);
    test_depth(t);
    test_nothing_there(t);
    check_agreements(t, PARTITION, sizeof PARTITION / sizeof PARTITION[0], 1);
    test_path_tracer(t);
    test_receivers(t);
}
