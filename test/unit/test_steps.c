/* test_steps.c: walks, connections and weights by hand, one step at a time, in matte rooms where every number is known.
 * Other tests see more; these are quick and say which step is wrong. (The course's grader asks them first.) */
#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "caustics/visible.h"
#include "helpers.h"
#include "lab/stats.h"
#include "suites.h"
#include "transport/connect.h"
#include "transport/mis.h"

static const struct counts ALL = {{1, 1}, {1, 1}, {1, 1}, .lens = 1024, .tables = &NO_TABLES};
enum { MAX = 12, ALBEDO_PERCENT = 30 };

/* A closed box of six matte sides, and what %s adds; the lens in its middle. The ceiling gives light and reflects. */
static const char BOX[] =
    "Integrator \"bdpt\" Camera \"perspective\" \"float fov\" 90\n"
    "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 16\nWorldBegin\n"
    "Material \"matte\" \"rgb Kd\" [.3 .3 .3]\n%s"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3  4 5 6 4 6 7  0 1 5 0 5 4  1 2 6 1 6 5  3 0 4 3 4 7]\n"
    " \"point P\" [-2 -2 -2  2 -2 -2  2 -2 2  -2 -2 2  -2 2 -2  2 2 -2  2 2 2  -2 2 2]\n"
    "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 2 1 0 3 2] \"point P\" [-2 -2 2  2 -2 2  2 2 2  -2 2 2]\nWorldEnd\n";

struct room {
    struct scene scene;
    struct arena arena;
    struct sampler sampler;
};

/* Rooms of a millimetre's fraction and of kilometres: what is compared with a fixed number is seen in one of them. */
static const char *const SCALES[] = {"", "Scale 1e-5 1e-5 1e-5\n", "Scale 1000 1000 1000\n"};

static bool build(struct test *t, const char *text, const char *more, struct room *r)
{
    char all[4096];
    memset(r, 0, sizeof *r);
    snprintf(all, sizeof all, text, more);
    return scene_from_text(t, all, &r->scene);
}

static void tear_down(struct room *r)
{
    arena_free(&r->arena);
    scene_free(&r->scene);
}

static int walk(struct test *t, struct room *r, enum transport mode, uint64_t i, double threshold, struct vertex *path,
                int max)
{
    struct walk w = {&r->scene, &ALL, &r->arena, &r->sampler, threshold};
    arena_reset(&r->arena);
    r->sampler = sampler_start(test_seed(t), mode == RADIANCE ? RNG_EYE : RNG_LIGHT, 1, i);
    return mode == RADIANCE ? path_eye(&w, (double)(i % 16) + 0.3, 8.5, path, max) : path_light(&w, path, max, NULL);
}

static int walk_eye(struct test *t, struct room *r, uint64_t i, double threshold, struct vertex *path, int max)
{
    return walk(t, r, RADIANCE, i, threshold, path, max);
}

/* --- the walk ---------------------------------------------------------------------------------------- */

/* In the box every vertex is matte: beta is albedo to a power, and no walk ends. */
static void walks_in_a_box(struct test *t, const char *scale, enum transport mode)
{
    struct room r;
    struct vertex path[MAX + 1];
    double beta = 0, itself = 0;
    int shorter = 0, longer = 0, vain = 0;
    if (!build(t, BOX, scale, &r))
        return;
    for (uint64_t i = 0; i < 500; i++) {
        int max = 2 + (int)(i % (MAX - 2)), n;
        memset(path, 0, sizeof path);
        path[max].pdf_fwd = -7;
        n = walk(t, &r, mode, i, 0, path, max);
        shorter += n < max;
        longer += n > max || path[max].pdf_fwd != -7;
        vain += r.sampler.drawn[DRAW_SCATTERING] > max - 2;
        for (int k = 1; k < n && k < max; k++) {
            beta = most_of(beta, fabs(path[k].beta.g / path[1].beta.g / pow(ALBEDO_PERCENT / 100.0, k - 1) - 1));
            itself += path[k].prim_id == path[k - 1].prim_id && k > 1;
        }
    }
    CHECK(t, longer == 0, "full: %d walks have more vertices than they may", longer);
    CHECK(t, vain == 0, "full: %d walks depart in vain from the last vertex that they may have", vain);
    CHECK(t, shorter == 0, "vertices: %d of 500 walks end within a closed box", shorter);
    CHECK(t, beta < 1e-9, "throughput: beta is off by a factor of %g where it is a power of the albedo", beta + 1);
    CHECK(t, itself == 0, "itself: %g rays meet the flat surface that they leave", itself);
    tear_down(&r);
}

/* What a departure says, of surfaces and in fog, of very bright walks and very dim ones. */
static void departures(struct test *t, const char *scale)
{
    struct room r;
    struct vertex path[3];
    if (!build(t, BOX, scale, &r))
        return;
    for (uint64_t i = 0; i < 100; i++) {
        struct walk w = {&r.scene, &ALL, &r.arena, &r.sampler, 0};
        struct departure out;
        if (walk_eye(t, &r, i, 0, path, 2) != 2)
            continue;
        struct vertex v = path[1];
        bool fog = i % 2 == 1;
        v.kind = fog ? VERTEX_MEDIUM : v.kind;
        v.prim_id = fog ? WITHIN_MEDIUM : v.prim_id;
        v.beta = rgb_grey(pow(10, (double)(i % 41) - 20));
        if (!CHECK(t, walk_leave(&w, &v, RADIANCE, &out), "throughput: a walk of beta %g ends", v.beta.g))
            continue;
        CHECK(t, fog || fabs(out.beta.g / v.beta.g * 100 / ALBEDO_PERCENT - 1) < 1e-9,
              "throughput: of %g the walls leave %g", v.beta.g, out.beta.g);
        double rev = fabs(dot(v.ng, v.wo)) * INV_PI;
        CHECK(t, fabs(out.pdf_rev / rev - 1) < 1e-9, "pdf_rev of a matte vertex is %g, not %g", out.pdf_rev, rev);
        double margin = fog ? 0 : ray_margin(v.p);
        CHECK(t, length(sub(out.ray.o, v.p)) == 0 && out.ray.tmin == margin && out.ray.tmax == INFINITY &&
              out.ray.from == v.prim_id, "itself: the ray from %s begins at %g, not %g, ends at %g, not at infinity, "
              "and starts on surface %d, not %d", fog ? "fog" : "a wall", out.ray.tmin, margin, out.ray.tmax,
              (int)out.ray.from, (int)v.prim_id);
    }
    tear_down(&r);
}

/* After two reflections 0.09 of the first throughput is left: with threshold 1 the third vertex survives with
 * probability 0.3, which pays for it, and no vertex before it plays. A light's first throughput is not 1. */
static void roulette(struct test *t, enum transport mode)
{
    enum { WALKS = 20000 };
    struct room r;
    struct vertex path[MAX];
    double count[2] = {0, 0};
    const double q = ALBEDO_PERCENT / 100.0, expected[2] = {WALKS * q, WALKS * (1 - q)};
    int early = 0, unpaid = 0;
    if (!build(t, BOX, "", &r))
        return;
    for (uint64_t i = 0; i < WALKS; i++) {
        int n = walk(t, &r, mode, i, 1, path, 4);
        early += n < 3;
        count[n < 4]++;
        unpaid += n == 4 && fabs(path[3].beta.g / (path[1].beta.g * q) - 1) > 1e-9;
    }
    CHECK(t, early == 0, "roulette ends %d walks before their third vertex", early);
    CHECK(t, unpaid == 0, "roulette: %d survivors are not paid for", unpaid);
    TEST_ACCEPT(t, stats_chi2_test(count, expected, 2), "roulette lets %g of %d walks survive, not %g", count[0], WALKS,
                expected[0]);
    tear_down(&r);
}

/* What the eye meets at once is black, or a mirror, or nothing but the sky. */
static void ends(struct test *t)
{
    static const char OPEN[] = "Camera \"perspective\" \"float fov\" 30\n"
                               "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 16\nWorldBegin\n%s\n"
                               "LightSource \"infinite\" \"rgb L\" [1 1 1]\nWorldEnd\n";
    struct room r;
    struct vertex path[MAX];
    int n;
    if (build(t, OPEN, "Material \"matte\" \"rgb Kd\" [0 0 0] Translate 0 0 5 Shape \"sphere\" \"float radius\" 3",
              &r)) {
        n = walk_eye(t, &r, 1, 0, path, MAX);
        CHECK(t, n == 2, "black: a walk that meets a black ball has %d vertices, not 2", n);
        tear_down(&r);
    }
    if (build(t, OPEN, "Material \"matte\" \"rgb Kd\" [0 1 0] Shape \"sphere\" \"float radius\" 50 "
              "Material \"matte\" \"rgb Kd\" [1 0 0] Translate 0 0 5 Shape \"sphere\" \"float radius\" 3", &r)) {
        n = walk_eye(t, &r, 1, 0, path, MAX);
        CHECK(t, n == 3, "throughput: of red and then green nothing is left, but the walk has %d vertices, not 3", n);
        tear_down(&r);
    }
    if (build(t, OPEN, "Material \"mirror\" \"rgb Kr\" [1 1 1] Translate 0 0 5 Shape \"sphere\" \"float radius\" 3",
              &r)) {
        n = walk_eye(t, &r, 1, 0, path, MAX);
        CHECK(t, n == 3 && path[2].kind == VERTEX_ESCAPED, "sky: by way of a mirror it is the third vertex, not %d", n);
        CHECK(t, n < 3 || path[2].prev_delta, "delta: what a mirror leads to does not say so");
        tear_down(&r);
    }
    if (build(t, OPEN, "AttributeBegin Material \"none\" AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] Translate 0 0 2 "
              "Shape \"sphere\" \"float radius\" .9 AttributeEnd Material \"matte\" Translate 0 0 8 "
              "Shape \"sphere\" \"float radius\" 4", &r)) {
        n = walk_eye(t, &r, 1, 0, path, MAX);
        CHECK(t, n > 1 && path[1].lamp != NULL, "lamp: a see-through lamp before a ball is not told of");
        tear_down(&r);
    }
}

/* Emitted light does not pass see-through lamps, reflected light does: here from wall to wall by way of a ball. */
static void light_passes(struct test *t)
{
    struct room r;
    struct vertex path[4];
    int passed = 0, emitted = 0;
    if (!build(t, BOX, "AttributeBegin Material \"none\" AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] "
               "Shape \"sphere\" \"float radius\" .9 AttributeEnd\n", &r))
        return;
    for (uint64_t i = 0; i < 200; i++) {
        int n = walk(t, &r, IMPORTANCE, i, 0, path, 4);
        for (int k = 0; k + 1 < n; k++) {
            bool through = length(cross(path[k].p, normalize(sub(path[k + 1].p, path[k].p)))) < 0.85;
            passed += k > 0 && through;
            emitted += k == 0 && through && length(path[0].p) > 1; /* by the ceiling, not by the ball itself */
        }
    }
    CHECK(t, emitted == 0, "lamp: emitted light passes a see-through lamp %d times in 200 walks", emitted);
    CHECK(t, passed > 10, "lamp: reflected light passes a see-through lamp %d times in 200 walks", passed);
    tear_down(&r);
}

/* Most rays that enter a ball of thick milk are scattered in it: a vertex that is on no surface. */
static void scattered(struct test *t, enum transport mode)
{
    struct room r;
    struct vertex path[4];
    int within = 0;
    if (!build(t, BOX, "MakeNamedMedium \"milk\" \"string type\" \"homogeneous\" \"rgb sigma_s\" [50 50 50]\n"
               "AttributeBegin Material \"\" MediumInterface \"milk\" \"\" Translate 0 0 1 "
               "Shape \"sphere\" \"float radius\" .9 AttributeEnd\n", &r))
        return;
    for (uint64_t i = 0; i < 200; i++) {
        int n = walk(t, &r, mode, i, 0, path, 4);
        for (int k = 1; k < n; k++)
            within += path[k].kind == VERTEX_MEDIUM;
    }
    CHECK(t, within > 20, "fog: 200 walks in a box with a ball of milk are scattered %d times within it", within);
    tear_down(&r);
}

void test_walk(struct test *t)
{
    for (int i = 0; i < 3; i++) {
        walks_in_a_box(t, SCALES[i], RADIANCE);
        walks_in_a_box(t, SCALES[i], IMPORTANCE);
        departures(t, SCALES[i]);
    }
    roulette(t, RADIANCE);
    roulette(t, IMPORTANCE);
    ends(t);
    light_passes(t);
    scattered(t, RADIANCE);
    scattered(t, IMPORTANCE);
}

/* --- two vertices joined ----------------------------------------------------------------------------- */

static bool close_to(double a, double b) { return fabs(a - b) <= 1e-9 * (fabs(a) + fabs(b)); }

/* Of two matte vertices that face each other: the value, and the weight with one side of strategies and with both. A
 * side is heard alone where the other vertex has no strategies behind it. */
static void check_joint(struct test *t, const struct scene *scene, const struct vertex *y, const struct vertex *z)
{
    vec3 d = sub(y->p, z->p), w = normalize(d);
    double d2 = length2(d), at_y = fabs(dot(y->ng, w)), at_z = fabs(dot(z->ng, w)), a = ALBEDO_PERCENT / 100.0;
    double value = y->beta.g * z->beta.g * sqr(a * INV_PI) * at_y * at_z / d2, geometry = at_y * at_z * INV_PI / d2;
    double light = geometry / y->pdf_fwd * (y->mis_c + fabs(dot(y->ng, y->wo)) * INV_PI * y->mis);
    double eye = geometry / z->pdf_fwd * (z->mis_c + fabs(dot(z->ng, z->wo)) * INV_PI * z->mis);
    struct vertex y_alone = *y, z_alone = *z;
    y_alone.mis = y_alone.mis_c = z_alone.mis = z_alone.mis_c = 0;
    struct connection c = connect_vertices(scene, &ALL, y, z);
    struct connection light_alone = connect_vertices(scene, &ALL, y, &z_alone);
    struct connection eye_alone = connect_vertices(scene, &ALL, &y_alone, z);
    CHECK(t, c.value.g > 0, "refused: two that face each other are not joined");
    CHECK(t, close_to(c.value.g, value), "value: %g, not %g", c.value.g, value);
    CHECK(t, close_to(light_alone.weight, 1 / (1 + light)), "light side: %g, not %g", 1 / light_alone.weight - 1,
          light);
    CHECK(t, close_to(eye_alone.weight, 1 / (1 + eye)), "eye side: %g, not %g", 1 / eye_alone.weight - 1, eye);
    CHECK(t, close_to(c.weight, 1 / (1 + light + eye)), "weight: %g, not %g", c.weight, 1 / (1 + light + eye));
}

static void refused(struct test *t, const struct scene *scene, const struct vertex *y, const struct vertex *z,
                    const char *why)
{
    CHECK(t, rgb_is_black(connect_vertices(scene, &ALL, y, z).value), "%s: such vertices are joined", why);
}

static void joints_in_a_box(struct test *t, const char *scale)
{
    struct room r;
    struct vertex eye[MAX], light[MAX];
    int joined = 0;
    if (!build(t, BOX, scale, &r))
        return;
    for (uint64_t i = 0; i < 40; i++) {
        int n = walk_eye(t, &r, i, 0, eye, 5);
        struct sampler other = sampler_start(test_seed(t), RNG_LIGHT, 1, i);
        struct walk w = {&r.scene, &ALL, &r.arena, &other, 0};
        int m = path_light(&w, light, 5, NULL);
        for (int s = 2; s <= m; s++)
            light[s - 1].beta = rgb_scale(light[s - 1].beta, i % 2 == 0 ? 1 : 1e9); /* a light of any brightness */
        for (int s = 2; s <= m; s++)
            for (int k = 2; k <= n; k++) {
                const struct vertex *y = &light[s - 1], *z = &eye[k - 1];
                if (dot(y->ng, sub(z->p, y->p)) * dot(y->ng, y->wo) <= 1e-9) /* one side of the box has both */
                    continue;
                check_joint(t, &r.scene, y, z);
                struct vertex dark = *y;
                dark.beta = rgb_black();
                refused(t, &r.scene, &dark, z, "black");
                joined++;
            }
        refused(t, &r.scene, &eye[1], &eye[1], "same point");
        struct vertex outside = eye[1];
        outside.p = add(outside.p, mul(outside.wo, -1)); /* behind the other's surface */
        refused(t, &r.scene, &outside, &eye[1], "behind");
    }
    CHECK(t, joined > 100, "only %d pairs", joined);
    tear_down(&r);
}

/* Through a ball no light comes. */
static void blocked(struct test *t, struct room *r)
{
    struct vertex eye[MAX], light[MAX];
    int n_blocked = 0;
    for (uint64_t i = 0; i < 40; i++) {
        int n = walk_eye(t, r, i, 0, eye, 5);
        struct sampler other = sampler_start(test_seed(t), RNG_LIGHT, 1, i);
        struct walk w = {&r->scene, &ALL, &r->arena, &other, 0};
        int m = path_light(&w, light, 5, NULL);
        for (int s = 2; s <= m; s++)
            for (int k = 2; k <= n; k++) {
                const struct vertex *y = &light[s - 1], *z = &eye[k - 1];
                if (scene_visible(&r->scene, z->p, z->prim_id, y->p, y->prim_id))
                    continue;
                refused(t, &r->scene, y, z, "blocked");
                n_blocked++;
            }
    }
    CHECK(t, n_blocked > 10, "only %d pairs do not see each other", n_blocked);
}

void test_joint(struct test *t)
{
    struct room r;
    struct vertex eye[MAX];
    for (int i = 0; i < 3; i++)
        joints_in_a_box(t, SCALES[i]);
    if (build(t, BOX, "AttributeBegin Material \"mirror\" Translate 0 0 1 Shape \"sphere\" \"float radius\" .9 "
              "AttributeEnd\n", &r)) {
        int n = walk_eye(t, &r, 1, 0, eye, 5);
        if (CHECK(t, n > 2 && eye[2].prev_delta, "the ball is not met")) {
            refused(t, &r.scene, &eye[2], &eye[1], "mirror");
            refused(t, &r.scene, &eye[1], &eye[2], "mirror");
        }
        blocked(t, &r);
        tear_down(&r);
    }
}

/* --- the formulas of the weights --------------------------------------------------------------------- */

/* With densities per area of a large world, x small, and of a small one. Is mis_step right? */
static bool formulas(struct test *t, double x)
{
    const double g = 0.7 * x, c = 3, rev = 0.4, mis = 5, F = 2.5 * x, R = 1.75 * x, n = 4, A = 6 / x, B = 9 * x;
    CHECK(t, close_to(mis_side(R, F, c, rev, mis), R / F * (c + rev * mis)), "mis_side");
    CHECK(t, close_to(mis_weight(n, A, B), n / (n + A + B)), "mis_weight");
    return CHECK(t, close_to(mis_step(c, rev, mis, F, g), g * (c + rev * mis) / F), "mis_step");
}

static void measured(struct test *t, const char *scale)
{
    struct room r;
    struct vertex path[MAX];
    double pdf = 0, camera = 0, g = 0, recursion = 0;
    if (!build(t, BOX, scale, &r))
        return;
    for (uint64_t i = 0; i < 200; i++) {
        int m = walk_eye(t, &r, i, 0, path, 6);
        for (int k = 1; k < m; k++) {
            const struct vertex *v = &path[k], *prev = &path[k - 1];
            vec3 d = sub(v->p, prev->p), w = normalize(d);
            double x, y, spread = 1 / length2(d), at_prev = fabs(dot(prev->ng, w));
            double rev = fabs(dot(prev->ng, prev->wo)) * INV_PI;
            double left = k == 1 ? camera_project(&r.scene.camera, prev->p, w, &x, &y) : at_prev * INV_PI;
            double off = fabs(v->pdf_fwd / (left * fabs(dot(v->ng, w)) * spread) - 1);
            pdf = most_of(pdf, k > 1 ? off : 0);
            camera = most_of(camera, k == 1 ? off : 0);
            if (k == 1)
                continue;
            g = most_of(g, fabs(v->g / (at_prev * spread) - 1));
            recursion = most_of(recursion, fabs(v->mis * prev->pdf_fwd / v->g / (prev->mis_c + rev * prev->mis) - 1));
        }
    }
    CHECK(t, pdf < 1e-9, "pdf_fwd of a vertex on a matte wall is off by a factor of %g", pdf + 1);
    CHECK(t, camera < 1e-9, "camera: pdf_fwd of the first vertex is off by a factor of %g", camera + 1);
    CHECK(t, g < 1e-9, "g of a vertex is off by a factor of %g", g + 1);
    CHECK(t, recursion < 1e-9, "recursion: mis of a vertex is off by a factor of %g", recursion + 1);
    tear_down(&r);
}

/* At distance 2, and at right angles, of rays that come from `prev`. */
static void check_parallel(struct test *t, const struct walk *w, const struct vertex *prev, const char *what)
{
    const struct departure from = {.ray = {.d = {0, 0, 1}}, .pdf = 3};
    struct vertex v = {.kind = VERTEX_SURFACE, .ng = {0, 0, -1}};
    walk_measure(w, &v, prev, &from, 4);
    CHECK(t, v.pdf_fwd == from.pdf && v.g == 1, "%s: where parallel rays arrive F is %g and g %g, not %g and 1", what,
          v.pdf_fwd, v.g, from.pdf);
}

/* What no walk in the box meets: a light at infinity, a lens of parallel rays, and a departure by a delta lobe. */
static void exceptions(struct test *t)
{
    static const char PARALLEL[] = "Camera \"orthographic\"\n"
                                   "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 16\nWorldBegin\n"
                                   "%sLightSource \"infinite\" \"rgb L\" [1 1 1]\nWorldEnd\n";
    const struct vertex sky = {.kind = VERTEX_LIGHT, .pdf_fwd = 2.5, .mis_c = 1};
    const struct vertex lens = {.kind = VERTEX_LENS, .pdf_fwd = 1};
    const struct vertex wall = {.kind = VERTEX_SURFACE, .ng = {0.6, 0, 0.8}, .pdf_fwd = 2.5, .mis = 5, .mis_c = 3};
    struct departure from = {.ray = {.d = {0, 0, 1}}, .pdf = 3, .pdf_rev = 0.4};
    struct vertex joined = {.kind = VERTEX_SURFACE, .ng = {0, 0.6, 0.8}}, mirrored = joined;
    struct room r;
    if (!build(t, PARALLEL, "Shape \"sphere\"\n", &r))
        return;
    const struct walk w = {&r.scene, &ALL, &r.arena, &r.sampler, 0};
    check_parallel(t, &w, &sky, "parallel");
    check_parallel(t, &w, &lens, "camera");
    walk_measure(&w, &joined, &wall, &from, 4);
    from.delta = true;
    walk_measure(&w, &mirrored, &wall, &from, 4);
    CHECK(t, close_to(mirrored.mis / joined.mis, 0.4 * 5 / (3 + 0.4 * 5)),
          "delta: mis after a mirror is %g times that after a wall, not %g", mirrored.mis / joined.mis,
          0.4 * 5 / (3 + 0.4 * 5));
    tear_down(&r);
}

/* walk_measure calls mis_step: what becomes of a wrong one says nothing of walk_measure. */
void test_weights(struct test *t)
{
    bool right = true;
    for (int i = -1; i <= 1; i++)
        right = formulas(t, pow(1e12, i)) && right;
    if (!right)
        return;
    for (int i = 0; i < 3; i++)
        measured(t, SCALES[i]);
    exceptions(t);
}
