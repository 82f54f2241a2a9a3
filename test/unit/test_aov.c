/* test_aov.c: images of what the camera sees first: planes, mirrors and empty space, whose images are known;
 * the variance that a render tells. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/number.h"
#include "lab/aov.h"
#include "lab/planes.h"
#include "lab/stats.h"
#include "transport/sample.h"
#include "helpers.h"
#include "suites.h"

enum { W = 12, H = 8, VALUES = 3 * W * H };

struct pictures {
    float *of[N_FIRST_HIT];
};

static struct pictures render_seen(const struct scene *scene, long spp, int threads, bool seen)
{
    struct pictures p;
    struct render_job o = {.seed = 5, .end = spp, .n_threads = threads};
    for (int i = 0; i < N_FIRST_HIT; i++)
        p.of[i] = mem_alloc(VALUES, sizeof *p.of[i]);
    aov_render(scene, &o, seen, p.of);
    return p;
}

static struct pictures render_aovs(const struct scene *scene, long spp, int threads)
{
    return render_seen(scene, spp, threads, false);
}

static void pictures_free(struct pictures *p)
{
    for (int i = 0; i < N_FIRST_HIT; i++)
        free(p->of[i]);
}

/* The largest deviation of the pixels' channel c from a value, over columns [x0, x1). */
static double deviation(const float *picture, int c, double value, int x0, int x1)
{
    double largest = 0;
    for (int y = 0; y < H; y++)
        for (int x = x0; x < x1; x++)
            largest = most_of(largest, fabs((double)picture[3 * (y * W + x) + c] - value));
    return largest;
}

/* The camera looks from (1,2,3) along x; a wall across its axis, 4 away, fills the left half of the picture. */
static const char WALL[] =
    "Film \"image\" \"integer xresolution\" 12 \"integer yresolution\" 8 PixelFilter \"box\"\n"
    "LookAt 1 2 3  2 2 3  0 0 1  Camera \"perspective\" \"float fov\" 60\n"
    "WorldBegin LightSource \"infinite\"\n%s\n"
    QUAD("5 %d -50  5 52 -50  5 52 50  5 %d 50") "WorldEnd\n";

static bool wall_scene(struct test *t, const char *material, int edge, struct scene *scene)
{
    return scene_from_format(t, scene, WALL, material, edge, edge);
}

/* Where the wall is, which depends on the camera's handedness, everything is known; elsewhere nothing is seen. */
static void test_wall(struct test *t)
{
    struct scene scene;
    if (!wall_scene(t, "Material \"matte\" \"rgb Kd\" [.25 .5 .75]", 2, &scene))
        return;
    struct pictures p = render_aovs(&scene, 4, 1);
    const double albedo[3] = {0.25, 0.5, 0.75}, normal[3] = {-1, 0, 0};
    bool left = p.of[AOV_DEPTH][0] > 0;
    int x0 = left ? 0 : W / 2, x1 = x0 + W / 2, rest = left ? W / 2 : 0;
    for (int c = 0; c < 3; c++) {
        double off = deviation(p.of[AOV_ALBEDO], c, albedo[c], x0, x1);
        CHECK(t, off < 1e-6, "albedo, channel %d, is off by %g", c, off);
        CHECK(t, deviation(p.of[AOV_NORMAL], c, normal[c], x0, x1) < 1e-6, "normal, channel %d", c);
        off = deviation(p.of[AOV_DEPTH], c, 4, x0, x1); /* also far from the axis */
        CHECK(t, off < 1e-6, "depth, channel %d, is off by %g", c, off);
        for (int i = 0; i < N_FIRST_HIT; i++)
            CHECK(t, deviation(p.of[i], c, 0, rest, rest + W / 2) == 0, "%s where nothing is hit",
                  aov_name((enum aov)i));
    }
    CHECK(t, deviation(p.of[AOV_POSITION], 0, 5, x0, x1) < 1e-6, "the wall is at x = 5");
    /* Pixels are squares of 8 tan(30 degrees) / 8 there; a mean of 4 points lies within one. */
    double side = 8 * tan(PI / 6) / 8, first = (double)p.of[AOV_POSITION][3 * x0 + 2];
    double expected = 3 + 4 * tan(PI / 6) - side / 2;
    CHECK(t, fabs(first - expected) < side / 2, "the top row is at z = %g, not %g", first, expected);
    pictures_free(&p);
    scene_free(&scene);
}

/* A layer before the wall, between two interfaces, which nothing shows: depth and place are the wall's. Albedo lacks
 * what the medium absorbs, and as much of what another scatters. */
static void test_layer(struct test *t)
{
    static const char LAYER[] =
        "Integrator \"bdpt\" Film \"image\" \"integer xresolution\" 12 \"integer yresolution\" 8\n"
        "PixelFilter \"box\" MakeNamedMedium \"layer\" \"string type\" \"homogeneous\"\n"
        "\"rgb sigma_a\" [%g %g %g] \"rgb sigma_s\" [%g %g %g]\n"
        "LookAt 1 2 3  2 2 3  0 0 1  Camera \"orthographic\" WorldBegin\n"
        "AttributeBegin Material \"\" MediumInterface \"layer\" \"\" Rotate 90 0 1 0\n"
        "Shape \"disk\" \"float radius\" 50 \"float height\" 4 ReverseOrientation\n"
        "Shape \"disk\" \"float radius\" 50 \"float height\" 2 AttributeEnd\n"
        "Material \"matte\" \"rgb Kd\" [.25 .5 .75] Rotate -90 0 1 0\n"
        "Shape \"disk\" \"float radius\" 50 \"float height\" -5 WorldEnd\n";
    static const double SIGMA[3][2] = {{0, 0}, {0.4, 0}, {0, 0.4}};
    for (int i = 0; i < 3; i++) {
        const double a = SIGMA[i][0], s = SIGMA[i][1], left = exp(-2 * (a + s));
        struct scene scene;
        if (!scene_from_format(t, &scene, LAYER, a, a, a, s, s, s))
            continue;
        struct pictures p = render_aovs(&scene, AOV_SAMPLES, 2);
        double sum = 0;
        for (int k = 0; k < W * H; k++)
            sum += (double)p.of[AOV_ALBEDO][3 * k + 1] / (W * H);
        CHECK(t, fabs(sum / (0.5 * left) - 1) < (i == 0 ? 1e-6 : 0.05), "layer %d: albedo %g, not %g", i, sum,
              0.5 * left);
        CHECK(t, deviation(p.of[AOV_DEPTH], 0, 4, 0, W) < 1e-6, "layer %d: depth", i);
        CHECK(t, deviation(p.of[AOV_POSITION], 0, 5, 0, W) < 1e-6, "layer %d: place", i);
        pictures_free(&p);
        scene_free(&scene);
    }
}

/* A pixel that is half covered: albedo is its mean, depth and position are those of what is there. */
static void test_edge(struct test *t)
{
    struct scene scene;
    if (!wall_scene(t, "Material \"mirror\" \"rgb Kr\" [.5 .5 .5]", 0, &scene))
        return;
    struct pictures p = render_aovs(&scene, 1000, 2);
    int edge = 0, full = 0;
    for (int x = 0; x < W; x++) {
        double a = (double)p.of[AOV_ALBEDO][3 * x], d = (double)p.of[AOV_DEPTH][3 * x];
        CHECK(t, a == 0 ? d == 0 : fabs(d - 4) < 1e-6, "depth %g at an albedo of %g", d, a);
        full += fabs(a - 0.5) < 1e-6;
        edge += a > 0 && a < 0.5 - 1e-6;
    }
    CHECK(t, edge == 1 && full >= 8, "%d pixels hold the edge, %d the wall alone", edge, full);
    pictures_free(&p);
    scene_free(&scene);
}

/* Glass sends on all it gets, from either side: albedo 1, not the radiance that refraction gains or loses. */
static void test_glass(struct test *t)
{
    static const char *const materials[] = {"Material \"glass\" \"float index\" 2",
                                            "ReverseOrientation Material \"glass\" \"float index\" 2"};
    for (int i = 0; i < 2; i++) {
        struct scene scene;
        if (!wall_scene(t, materials[i], -50, &scene))
            continue;
        struct pictures p = render_aovs(&scene, 2, 1);
        double off = deviation(p.of[AOV_ALBEDO], 1, 1, 0, W);
        CHECK(t, off < 1e-6, "albedo of glass, side %d, is off by %g", i, off);
        pictures_free(&p);
        scene_free(&scene);
    }
}

/* What is asked of a mirror is what it shows, a wall behind the camera, dimmed by it; of a pane of glass the wall
 * behind it; where a mirror shows nothing it is itself. Depth is that of mirror and glass. */
static void test_seen(struct test *t)
{
    static const char BEHIND[] =
        "Material \"matte\" \"rgb Kd\" [.2 .4 .6] " QUAD("%d -%d -%d  %d %d -%d  %d %d %d  %d -%d %d") "%s";
    static const struct {
        int x, size; /* of the wall */
        const char *material;
        double albedo, normal; /* in the second channel; along x */
    } CASES[] = {{-3, 500, "Material \"mirror\" \"rgb Kr\" [.5 .5 .5]", 0.2, 1},
                 {9, 500, "Material \"glass\" \"float index\" 1.0001", 0.4, -1},
                 {900, 1, "Material \"mirror\" \"rgb Kr\" [.5 .5 .5]", 0.5, -1}};
    for (int i = 0; i < 3; i++) {
        struct scene scene;
        char material[600];
        int x = CASES[i].x, s = CASES[i].size;
        snprintf(material, sizeof material, BEHIND, x, s, s, x, s, s, x, s, s, x, s, s, CASES[i].material);
        if (!wall_scene(t, material, -50, &scene))
            continue;
        struct pictures p = render_seen(&scene, 1, 2, true), first = render_aovs(&scene, 1, 2);
        double off = deviation(p.of[AOV_ALBEDO], 1, CASES[i].albedo, 0, W);
        CHECK(t, off < 1e-3, "case %d: albedo is off by %g", i, off);
        off = deviation(p.of[AOV_NORMAL], 0, CASES[i].normal, 0, W);
        CHECK(t, off < 1e-3, "case %d: the normal is off by %g", i, off);
        CHECK(t, deviation(p.of[AOV_DEPTH], 0, 4, 0, W) < 1e-5, "case %d: depth", i);
        off = deviation(first.of[AOV_ALBEDO], 1, CASES[i].albedo, 0, W);
        CHECK(t, i == 2 ? off < 1e-6 : off > 0.2, "case %d: the first hit has the same albedo", i);
        pictures_free(&p);
        pictures_free(&first);
        scene_free(&scene);
    }
}

/* The same bytes for any number of threads, and a crop window holds its part of the whole. */
static void test_same(struct test *t)
{
    struct scene scene;
    if (!scene_from_file(t, "scenes/bathroom.pbrt", W, H, &scene))
        return;
    struct pictures a = render_aovs(&scene, 3, 1), b = render_aovs(&scene, 3, 3);
    const double crop[4] = {0.5, 1, 0.25, 1};
    memcpy(scene.crop, crop, sizeof crop);
    struct pictures part = render_aovs(&scene, 3, 2);
    for (int i = 0; i < N_FIRST_HIT; i++) {
        CHECK(t, memcmp(a.of[i], b.of[i], VALUES * sizeof *a.of[i]) == 0, "%s depends on the threads",
              aov_name((enum aov)i));
        for (int y = 2; y < H; y++)
            CHECK(t, memcmp(part.of[i] + 3 * (y - 2) * (W / 2), a.of[i] + 3 * (y * W + W / 2),
                            3 * (W / 2) * sizeof *a.of[i]) == 0,
                  "%s of a crop window, row %d", aov_name((enum aov)i), y);
    }
    CHECK(t, deviation(a.of[AOV_ALBEDO], 0, (double)a.of[AOV_ALBEDO][0], 0, W) > 0.01, "the scene has one albedo only");
    pictures_free(&a);
    pictures_free(&b);
    pictures_free(&part);
    scene_free(&scene);
}

/* Of one sample, the position is the first vertex that the eye sub-path of the render meets: also behind a lens. */
static void test_path(struct test *t)
{
    struct scene scene;
    if (!scene_from_file(t, "scenes/forest.pbrt", W, H, &scene))
        return;
    scene.camera.lens_radius = 0.05;
    scene.camera.focal_distance = 2;
    struct pictures p = render_aovs(&scene, 1, 1);
    struct counts counts = {.s0 = {1, 1}, .s1 = {1, 1}, .tables = &NO_TABLES};
    struct arena arena = {0};
    int hits = 0;
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            struct sampler sampler = sampler_start(5, RNG_EYE, (uint64_t)(y * W + x), 0);
            struct walk walk = {.scene = &scene, .counts = &counts, .arena = &arena, .sampler = &sampler};
            struct vertex path[2];
            double weight;
            const float *ours = p.of[AOV_POSITION] + 3 * (y * W + x);
            if (path_eye_pixel(&walk, x, y, path, 2, &weight) < 2 || path[1].kind != VERTEX_SURFACE)
                continue;
            vec3 q = {(double)ours[0], (double)ours[1], (double)ours[2]};
            double off = length(sub(add(path[1].p, scene.origin), q));
            CHECK(t, off < 1e-5 * (1 + sqrt(length2(q))), "pixel (%d,%d): off by %g", x, y, off);
            hits++;
        }
    CHECK(t, hits > W * H / 2, "%d pixels hit something", hits);
    arena_free(&arena);
    pictures_free(&p);
    scene_free(&scene);
}

/* Samples of a picture of 8x8 pixels, told to an observer of its variance as a render tells them. */
struct told {
    struct film film;
    struct tile tile;
    struct planes planes;
    struct observers all;
    struct observer of_pass;
};
enum { SIDE = 8, PIXELS = SIDE * SIDE };

static void told_begin(struct told *p, const struct filter *filter, struct scene *scene)
{
    struct pixel_rect all = {0, 0, SIDE, SIDE};
    memset(p, 0, sizeof *p);
    film_init(&p->film, all, SIDE, SIDE);
    planes_init(&p->planes, scene, &p->film, false, false, true, 1);
    p->all = planes_observers(&p->planes);
    tile_start(&p->tile, pixels_all(all), all, filter);
    p->of_pass = p->all.begin(p->all.context, 0, &p->tile);
}

/* A path to pixel (x,y), whose sample has a value so far; t = 1: a splat. */
static void tell(struct told *p, int x, int y, int t, rgb before, rgb value)
{
    const struct sample sample = {.x = x, .y = y, .value = before};
    const struct connection c = {.value = rgb_grey(1)};
    const struct joined path = {.s = 1, .t = t, .c = &c, .px = x + 0.5, .py = y + 0.5, .added = value};
    p->of_pass.joined(p->of_pass.context, &sample, &path);
}

static void told_end(struct told *p, long iterations, double scale, float variance[3 * PIXELS])
{
    p->film.block.iterations = iterations;
    p->all.end(p->all.context, 0);
    p->film.iterations = iterations;
    planes_end(&p->planes);
    planes_variance(&p->planes, scale, variance);
    tile_free(&p->tile);
    planes_free(&p->planes);
    film_free(&p->film);
}

/* Two samples, the second of two paths. */
static void test_variance(struct test *t)
{
    struct scene none = {.width = SIDE};
    struct filter box = filter_of("box");
    struct told p;
    float v[3 * PIXELS];
    told_begin(&p, &box, &none);
    tell(&p, 0, 0, 2, rgb_black(), rgb_make(2, 0, 0));
    tell(&p, 0, 0, 2, rgb_black(), rgb_make(1, 0, 5));
    tell(&p, 0, 0, 3, rgb_make(1, 0, 5), rgb_make(3, 0, -1)); /* 4 0 4 */
    told_end(&p, 2, 3, v);
    CHECK(t, fabs((double)v[0] - 9) < 1e-5 && v[1] == 0 && fabs((double)v[2] - 36) < 1e-4,
          "variances %g %g %g of the means", (double)v[0], (double)v[1], (double)v[2]);
}

/* Known noise: own values uniform in [0,1) plus rare splats. */
static void test_known_noise(struct test *t)
{
    enum { ITERATIONS = 500, SPLATS = 20 };
    struct scene none = {.width = SIDE};
    struct filter box = filter_of("box");
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 4, 0);
    struct told p;
    float v[3 * PIXELS];
    double sum[PIXELS] = {0}, chi2 = 0, mean = 0;
    told_begin(&p, &box, &none);
    for (int i = 0; i < ITERATIONS; i++) {
        for (int k = 0; k < PIXELS; k++) {
            double value = rng_uniform(&r);
            sum[k] += value;
            tell(&p, k % SIDE, k / SIDE, 2, rgb_black(), rgb_grey(value));
        }
        for (int k = 0; k < SPLATS; k++) {
            int x = (int)(SIDE * rng_uniform(&r)), y = (int)(SIDE * rng_uniform(&r));
            sum[y * SIDE + x]++;
            tell(&p, x, y, 1, rgb_black(), rgb_grey(1));
        }
    }
    told_end(&p, ITERATIONS, 2, v);
    /* Variance of one iteration: 1/12 of the uniform number, SPLATS/64 of the splats' count; scale 2. */
    double expected = 4 * (1.0 / 12 + SPLATS / 64.0) / ITERATIONS;
    for (int i = 0; i < PIXELS; i++) {
        mean += (double)v[3 * i] / PIXELS;
        chi2 += sqr(2 * sum[i] / ITERATIONS - 2 * (0.5 + SPLATS / 64.0)) / (double)v[3 * i];
    }
    CHECK(t, fabs(mean / expected - 1) < 0.1, "variance %g, expected %g", mean, expected);
    TEST_ACCEPT(t, stats_chi2_p(chi2, PIXELS), "pixel means in units of their standard errors");
    TEST_REJECT(t, stats_chi2_p(chi2 * 4, PIXELS), "the same with errors half as large");
}

/* The sum over all pixels of the variance that renders tell, over that of their scatter over seeds. */
static double told_variance(struct test *t, const char *path, const char *integrator)
{
    enum { SEEDS = 16 };
    struct error err = {.text = ""};
    struct scene scene;
    double told = 0, sum[VALUES] = {0}, squares[VALUES] = {0}, scatter = 0;
    float value[VALUES], variance[VALUES];
    if (!scene_from_file(t, path, W, H, &scene))
        return NAN;
    for (int seed = 0; seed < SEEDS; seed++) {
        struct render_job o = {.integrator = method_of(&scene, integrator), .end = 16, .n_threads = 2,
                                   .max_depth = 5,
                                   .seed = test_seed(t) + (uint64_t)seed};
        struct film film;
        struct planes planes;
        film_init(&film, render_crop(&scene), W, H);
        planes_init(&planes, &scene, &film, false, false, true, o.n_threads);
        struct observers observers = planes_observers(&planes);
        o.observers = &observers;
        CHECK(t, render_by(&scene, &o, &film, &err), "%s", err.text);
        planes_end(&planes);
        film_develop(&film, 1, value);
        planes_variance(&planes, 1, variance);
        planes_free(&planes);
        film_free(&film);
        for (int i = 0; i < VALUES; i++) {
            told += (double)variance[i] / SEEDS;
            sum[i] += (double)value[i];
            squares[i] += (double)value[i] * (double)value[i];
        }
    }
    for (int i = 0; i < VALUES; i++)
        scatter += (squares[i] - sum[i] * sum[i] / SEEDS) / (SEEDS - 1);
    scene_free(&scene);
    return told / scatter;
}

/* What is told is a bound: never surely below the scatter over seeds, and in the Cornell box, whose light has a sharp
 * edge, far above, since the samples of a pixel are points of nets. */
static void test_variance_bound(struct test *t)
{
    static const char *const scenes[] = {"scenes/cornell-box.pbrt", "scenes/corridor.pbrt", "scenes/spot.pbrt"};
    static const char *const methods[] = {"pt", "bdpt", "asbdpt"};
    for (int i = 0; i < 9; i++) {
        double ratio = told_variance(t, scenes[i / 3], methods[i % 3]);
        CHECK(t, ratio > 0.8 && (i >= 3 || ratio > 2), "%s, %s: the variance told is %g times that over seeds",
              scenes[i / 3], methods[i % 3], ratio);
    }
}

/* Who watches, and what they say after so many rows. */
struct watcher {
    int rows, patience;
    double last;
    enum cancel then;
};

static void watch(void *context, double learnt, double done)
{
    struct watcher *w = context;
    (void)learnt;
    w->rows++;
    w->last = done;
}

static enum cancel answer(void *context)
{
    const struct watcher *w = context;
    return w->rows > w->patience ? w->then : CANCEL_NOT;
}

/* There are as many samples as the render has, at most; when time is over as many as there are, but one; at a signal
 * the rest is black. */
static void test_ends(struct test *t)
{
    static const struct {
        long end;
        bool seen;
        int patience;
        enum cancel then;
        int rows, like; /* asked so often; the same as with so many samples; 0: not whole */
    } CASES[] = {
        {3, false, 1000, CANCEL_NOW, 3 * H, 3},    {3, true, 1000, CANCEL_NOW, 3 * H, 3},
        {99, false, 9999, CANCEL_NOW, 64 * H, 64}, {9999, true, 9999, CANCEL_NOW, 256 * H, 256},
        {9, false, 2, CANCEL_BLOCK, H, 1},      {9, true, H, CANCEL_NOW, H + 1, -1},
        {9, false, 2, CANCEL_NOW, 3, 0}};
    struct scene scene;
    if (!wall_scene(t, "Material \"matte\" \"rgb Kd\" [.25 .5 .75]", 2, &scene))
        return;
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        struct watcher w = {0, CASES[i].patience, 0, CASES[i].then};
        struct render_job o = {.seed = 5, .end = CASES[i].end, .n_threads = 1, .progress = watch,
                               .cancel = answer, .context = &w};
        struct pictures p;
        for (int k = 0; k < N_FIRST_HIT; k++)
            p.of[k] = mem_alloc(VALUES, sizeof *p.of[k]);
        bool whole = aov_render(&scene, &o, CASES[i].seen, p.of);
        CHECK(t, whole == (CASES[i].like != 0) && w.rows == CASES[i].rows, "case %d: asked %d times", (int)i, w.rows);
        CHECK(t, w.last <= 1 && (w.last == 1) == (CASES[i].like > 1), "case %d: %g is done", (int)i, w.last);
        struct pictures q = render_seen(&scene, CASES[i].like > 0 ? CASES[i].like : 1, 2, CASES[i].seen);
        for (int k = 0; k < N_FIRST_HIT && CASES[i].like > 0; k++)
            CHECK(t, memcmp(p.of[k], q.of[k], VALUES * sizeof(float)) == 0, "case %d, picture %d", (int)i, k);
        for (int k = 3 * 3 * W; k < VALUES && CASES[i].like == 0; k++)
            CHECK(t, p.of[AOV_ALBEDO][k] == 0, "case %d: rows that were not looked at", (int)i);
        pictures_free(&p);
        pictures_free(&q);
    }
    scene_free(&scene);
}

void test_aov(struct test *t)
{
    test_wall(t);
    test_layer(t);
    test_edge(t);
    test_glass(t);
    test_seen(t);
    test_same(t);
    test_path(t);
    test_variance(t);
    test_known_noise(t);
    test_variance_bound(t);
    test_ends(t);
}
