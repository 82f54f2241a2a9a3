/* test_sampler.c: the numbers of a stream, and the points of the unit square that samples use.
 *
 * A stream: the low-discrepancy part has exactly one point per stratum and is uniform and independent over pixels; the
 * rest are plain random numbers. What becomes of them: samples of whole integrators are watched (trace.h), the points
 * of the unit square that were used are read off the sub-paths and connections themselves, by the inverses of all
 * maps, and must be strata's, too. That sees whatever the code does with its numbers on the way. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/rng.h"
#include "base/sampler.h"
#include "base/warp.h"
#include "lab/stats.h"
#include "lab/trace.h"
#include "bench.h"
#include "helpers.h"
#include "suites.h"

enum { N = 64 };

/* Of n points, a power of two, does each elementary interval of area 1/n, n x 1, n/2 x 2, ..., 1 x n, hold at most one?
 * A negative x stands for a point that is not known. */
static bool is_net(const double (*u)[2], int n)
{
    for (int columns = 1; columns <= n; columns *= 2) {
        int rows = n / columns, count[N];
        memset(count, 0, sizeof count);
        for (int i = 0; i < n; i++)
            if (u[i][0] >= 0 && count[(int)(u[i][0] * columns) * rows + (int)(u[i][1] * rows)]++ > 0)
                return false;
    }
    return true;
}

/* --- streams ------------------------------------------------------------------------------------------- */

/* The first N iterations of a decision's k-th point are a net. */
static bool stream_is_net(uint64_t seed, uint64_t pixel, enum decision d, int k, bool planted)
{
    double u[N][2];
    for (int i = 0; i < N; i++) {
        struct sampler s = sampler_start(seed, RNG_EYE, pixel, (uint64_t)(planted ? i * 3 : i));
        for (int times = 0; times <= k; times++)
            sampler_pair(&s, d, u[i]);
    }
    return is_net((const double(*)[2])u, N);
}

/* Points and numbers of low discrepancy, and after them plain ones. */
enum { NUMBERS = 12, SIDE = 8, PIXELS = 40000 };
static void draw_numbers(struct sampler *s, double u[NUMBERS])
{
    sampler_pair(s, DRAW_LIGHT_POINT, &u[0]);
    for (int k = 0; k <= SAMPLER_TIMES; k++)
        sampler_pair(s, DRAW_SCATTERING, &u[k < 2 ? 2 + 2 * k : 6]);
    u[8] = sampler_number(s, DRAW_LIGHT);
    u[9] = sampler_number(s, DRAW_LIGHT_END);
    u[10] = sampler_number(s, DRAW_LOBE);
    u[11] = sampler_number(s, DRAW_ROULETTE);
}

/* For every two numbers, cells of both over many pixels at one iteration. */
static void count_cells(uint64_t seed, uint64_t iteration, double (*cells)[NUMBERS][SIDE * SIDE])
{
    double u[NUMBERS];
    for (int i = 0; i < PIXELS; i++) {
        struct sampler s = sampler_start(seed, RNG_LIGHT, (uint64_t)i, iteration);
        draw_numbers(&s, u);
        for (int a = 0; a < NUMBERS; a++)
            for (int b = a; b < NUMBERS; b++)
                cells[a][b][(int)(u[a] * SIDE) * SIDE + (int)(u[b] * SIDE)]++;
    }
}

static double even_p(const double observed[SIDE * SIDE])
{
    double expected[SIDE * SIDE];
    for (int i = 0; i < SIDE * SIDE; i++)
        expected[i] = (double)PIXELS / (SIDE * SIDE);
    return stats_chi2_test(observed, expected, SIDE * SIDE);
}

static void test_streams_of_decisions(struct test *t)
{
    uint64_t seed = test_seed(t);
    for (uint64_t pixel = 0; pixel < 20; pixel++)
        for (int d = DRAW_FILM_POINT; d <= DRAW_SCATTERING; d++)
            for (int k = 0; k < SAMPLER_TIMES; k++)
                CHECK(t, stream_is_net(seed, pixel, (enum decision)d, k, false),
                      "pixel %d, decision %d, time %d: not one point per stratum", (int)pixel, d, k);
    CHECK(t, !stream_is_net(seed, 1, DRAW_FILM_POINT, 0, true), "a sequence with holes passes for a net");
    double (*cells)[NUMBERS][SIDE * SIDE] = mem_alloc(NUMBERS, sizeof *cells);
    count_cells(seed, 5, cells);
    for (int a = 0; a < NUMBERS; a++)
        for (int b = a + 1; b < NUMBERS; b++)
            TEST_ACCEPT(t, even_p(cells[a][b]), "numbers %d and %d over pixels", a, b);
    TEST_REJECT(t, even_p(cells[3][3]), "a number against itself");
    free(cells);
}

/* What a decision draws is the same, whatever others have drawn before and between. */
static void test_others(struct test *t)
{
    for (int d = DRAW_FILM_POINT; d < DRAW_LOBE; d++)
        for (int e = DRAW_FILM_POINT; e <= DRAW_ORDER; e++) {
            struct sampler alone = sampler_start(test_seed(t), RNG_EYE, 7, 3), among = alone;
            bool same = true;
            for (int k = 0; d != e && k < SAMPLER_TIMES; k++) {
                double a[2], b[2], other[2];
                sampler_number(&among, (enum decision)e);
                sampler_pair(&among, (enum decision)e, other);
                sampler_pair(&alone, (enum decision)d, a);
                sampler_pair(&among, (enum decision)d, b);
                same = same && a[0] == b[0] && a[1] == b[1];
            }
            CHECK(t, same, "decision %d draws other numbers after decision %d", d, e);
        }
}

/* --- decisions as they were used ------------------------------------------------------------------------- */

/* Inside of a sphere, under two triangular lamps with corners (x, 0, 9), (x + 1, 0, 9), (x, 1, 9), x = 0 and 2, seen
 * by a lens at the middle; nothing hides anything. */
static const char HALL[] =
    "Film \"image\" \"integer xresolution\" 1 \"integer yresolution\" 1 PixelFilter \"box\"\n"
    "LookAt 0 0 6  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 150\n"
    "\"float lensradius\" 0.5 \"float focaldistance\" 3\n"
    "WorldBegin Material \"matte\" \"rgb Kd\" [.9 .9 .9] ReverseOrientation Shape \"sphere\" \"float radius\" 10\n"
    "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] Shape \"trianglemesh\" \"integer indices\" [0 1 2 3 4 5]\n"
    "\"point P\" [0 0 9  1 0 9  0 1 9  2 0 9  3 0 9  2 1 9]\n"
    "WorldEnd\n";

/* The points of one decision's one time over the iterations; a negative x: not seen. */
enum { SAMPLES = 32, DEPTH = 6 };
struct used {
    const char *what;
    int k; /* which vertex, or which try */
    double u[SAMPLES][2];
};

struct usage {
    const struct scene *scene;
    struct used used[64];
    int n;
};

static double *place(struct usage *all, const char *what, int k, int sample)
{
    int i = 0;
    while (i < all->n && !(all->used[i].k == k && strcmp(all->used[i].what, what) == 0))
        i++;
    if (i == all->n) {
        all->n++;
        all->used[i].what = what;
        all->used[i].k = k;
        for (int j = 0; j < SAMPLES; j++)
            all->used[i].u[j][0] = -1;
    }
    return all->used[i].u[sample];
}

/* The inverse of warp_disk. */
static void disk_inverse(double x, double y, double u[2])
{
    bool wide = fabs(x) > fabs(y);
    double r = sqrt(x * x + y * y);
    double a = wide ? (x < 0 ? -r : r) : (y < 0 ? -r : r);
    double b = wide ? a * 4 / PI * atan(y / x) : a * 4 / PI * atan(x / y);
    u[0] = ((wide ? a : b) + 1) / 2;
    u[1] = ((wide ? b : a) + 1) / 2;
}

/* Cosine-weighted around the frame's normal, on either side. */
static void direction_inverse(const struct frame *f, vec3 from, vec3 to, double u[2])
{
    vec3 w = to_local(f, normalize(sub(to, from)));
    disk_inverse(w.x, w.y, u);
}

static void lamp_inverse(vec3 p, double u[2])
{
    double b1 = p.x - (p.x >= 2 ? 2 : 0), s = 1 - b1; /* warp_triangle */
    u[0] = s * s;
    u[1] = p.y / s;
}

static void lens_inverse(const struct camera *c, vec3 p, double u[2])
{
    vec3 at = transform_point(&c->world_to_camera, p);
    disk_inverse(at.x / c->lens_radius, at.y / c->lens_radius, u);
}

/* Of the straight line from p to a raster point: it goes through the point that is in focus there. */
static void lens_inverse_through(const struct camera *c, vec3 p, double px, double py, double u[2])
{
    struct ray middle = camera_ray(c, px, py, 0.5, 0.5);
    vec3 from = transform_point(&c->world_to_camera, p), d = transform_vector(&c->world_to_camera, middle.d);
    vec3 focus = mul(d, c->focal_distance / d.z), w = sub(focus, from);
    vec3 at = add(from, mul(w, -from.z / w.z));
    disk_inverse(at.x / c->lens_radius, at.y / c->lens_radius, u);
}

/* How the surfaces of a sub-path were left. */
static void note_bounces(struct usage *all, const char *what, const struct trace_path *path, int sample)
{
    for (int i = 1; i + 1 < path->n && i <= SAMPLER_TIMES; i++)
        direction_inverse(&path->vertex[i].bsdf.shading, path->vertex[i].p, path->vertex[i + 1].p,
                          place(all, what, i, sample));
}

static void note_sub_paths(struct usage *all, const struct trace *trace, int sample)
{
    const struct trace_path *eye = &trace->eye;
    const struct camera *camera = &all->scene->camera;
    if (eye->n > 1) {
        double *film = place(all, "point on the film", 0, sample);
        vec3 lens = eye->vertex[0].p;
        camera_project(camera, lens, normalize(sub(eye->vertex[1].p, lens)), &film[0], &film[1]);
        lens_inverse(camera, lens, place(all, "lens point of an eye sub-path", 0, sample));
        note_bounces(all, "direction of an eye sub-path from vertex", eye, sample);
    }
    for (int k = 0; k < trace->n_lights; k++) {
        const struct trace_path *light = &trace->light[k];
        if (light->n < 2)
            continue;
        struct frame f = frame_from_normal(light->vertex[0].ng);
        lamp_inverse(light->vertex[0].p, place(all, "point of emission", k, sample));
        direction_inverse(&f, light->vertex[0].p, light->vertex[1].p, place(all, "direction of emission", k, sample));
        note_bounces(all, "direction of a light sub-path from vertex", light, sample);
    }
}

/* A connection that brought nothing does not tell its point. */
static void note_connections(struct usage *all, const struct trace *trace, int sample)
{
    int directs = 0;
    for (int i = 0; i < trace->n_connections; i++) {
        const struct trace_connection *c = &trace->connection[i];
        int k = c->s == 1 ? directs++ : c->s - 2;
        if (k >= SAMPLER_TIMES || rgb_is_black(c->c.value))
            continue;
        if (c->s == 1)
            lamp_inverse(c->end, place(all, "light point of try", k, sample));
        else if (c->t == 1)
            lens_inverse_through(&all->scene->camera, trace->light[c->light].vertex[c->s - 1].p, c->px, c->py,
                                 place(all, "lens point of try", k, sample));
    }
}

/* Watch the samples of the only pixel; `stride` plants a sequence with holes. */
static void watch(struct test *t, struct usage *all, const char *integrator, int stride)
{
    struct bench b;
    if (!bench_new(t, all->scene, integrator, DEPTH, 0, &b))
        return;
    for (int i = 0; i < SAMPLES; i++) {
        struct trace trace = {.iteration = i * stride};
        trace_sample(&b.job, &b.prepared, &trace);
        note_sub_paths(all, &trace, i);
        note_connections(all, &trace, i);
        trace_free(&trace);
    }
    bench_free(&b);
}

/* How many decisions were seen often; whether all are nets, for all powers of two. */
static int count_nets(struct test *t, const struct usage *all, const char *integrator, bool planted)
{
    int often = 0, nets = 0;
    for (int i = 0; i < all->n; i++) {
        const struct used *used = &all->used[i];
        int seen = 0;
        bool net = true;
        for (int k = 0; k < SAMPLES; k++)
            seen += used->u[k][0] >= 0;
        if (2 * seen < SAMPLES)
            continue;
        often++;
        for (int n = 2; n <= SAMPLES; n *= 2)
            net = net && is_net(used->u, n);
        nets += net;
        CHECK(t, net || planted, "%s: %s %d: the %d points used are no net", integrator, used->what, used->k, seen);
    }
    return planted ? nets : often;
}

static void test_usage(struct test *t)
{
    static const struct {
        const char *integrator;
        int decisions; /* at least; asbdpt: two light points at the first vertex, and lights are left evenly */
    } ways[] = {{"pt", 6}, {"lt", 7}, {"bdpt", 11}, {"asbdpt emission=1", 11}};
    struct scene scene;
    if (!scene_from_text(t, HALL, &scene))
        return;
    for (size_t i = 0; i < sizeof ways / sizeof ways[0]; i++)
        for (int stride = 1; stride <= 3; stride += 2) {
            struct usage *all = mem_alloc(1, sizeof *all);
            all->scene = &scene;
            const char *integrator = set_method(&scene, ways[i].integrator);
            watch(t, all, integrator, stride);
            int n = count_nets(t, all, integrator, stride > 1);
            CHECK(t, stride > 1 ? n == 0 : n >= ways[i].decisions, "%s: %d of %d decisions", ways[i].integrator, n,
                  all->n);
            free(all);
        }
    scene_free(&scene);
}

void test_sampler(struct test *t)
{
    test_streams_of_decisions(t);
    test_others(t);
    test_usage(t);
}

/* --- the suite warp ------------------------------------------------------------------------------------------- */

enum { ROWS = 10, COLUMNS = 20, DRAWS = 100000 };

enum warp_kind { DISK, COS_HEMISPHERE, SPHERE, CONE, TRIANGLE, N_WARPS };
static const char *const NAME[] = {"disk", "cos hemisphere", "sphere", "cone", "triangle"};
static const double CONE_COS = 0.7;

/* Where the sample lies: `a` along the rows and `b` along the columns, both in [0,1]. */
static void locate(enum warp_kind kind, double u1, double u2, double *a, double *b)
{
    double x = 0, y = 0;
    vec3 w = vec(0, 0, 0);
    switch (kind) {
    case DISK:
        warp_disk(u1, u2, &x, &y);
        *a = sqrt(x * x + y * y);
        break;
    case COS_HEMISPHERE:
        w = warp_cos_hemisphere(u1, u2);
        *a = w.z;
        break;
    case SPHERE:
        w = warp_sphere(u1, u2);
        *a = 0.5 + 0.5 * w.z;
        break;
    case CONE:
        w = warp_cone(u1, u2, CONE_COS);
        *a = (w.z - CONE_COS) / (1 - CONE_COS);
        break;
    case TRIANGLE: /* a: height above the side b1 + b2 = 0 ... 1, b: place along the parallel */
        warp_triangle(u1, u2, &x, &y);
        *a = 1 - x;
        *b = y / (1 - x);
        return;
    case N_WARPS: break;
    }
    if (kind != DISK) {
        x = w.x;
        y = w.y;
    }
    *b = 0.5 + atan2(y, x) / (2 * PI);
}

/* The probability of a in [a0,a1], by integrating the density of warp.h over the ring it stands for (b is uniform).
 */
static double ring(enum warp_kind kind, double a0, double a1)
{
    switch (kind) {
    case DISK: return a1 * a1 - a0 * a0;
    case COS_HEMISPHERE: return 2 * PI * (a1 - a0) * warp_cos_hemisphere_pdf_w(0.5 * (a0 + a1));
    case SPHERE: return 2 * PI * 2 * (a1 - a0) * warp_sphere_pdf_w();
    case CONE: return 2 * PI * (1 - CONE_COS) * (a1 - a0) * warp_cone_pdf_w(CONE_COS);
    case TRIANGLE: return a1 * a1 - a0 * a0;
    case N_WARPS: break;
    }
    return 0;
}

static double warp_p(enum warp_kind sampled, enum warp_kind claimed, int n, struct rng *r)
{
    double count[ROWS * COLUMNS] = {0}, expected[ROWS * COLUMNS];
    for (int i = 0; i < n; i++) {
        double a = 0, b = 0, u1 = rng_uniform(r), u2 = rng_uniform(r);
        locate(sampled, u1, u2, &a, &b);
        int row = (int)(clamp(a, 0, 1) * ROWS), column = (int)(clamp(b, 0, 1) * COLUMNS);
        row = row < ROWS ? row : ROWS - 1;
        column = column < COLUMNS ? column : COLUMNS - 1;
        count[row * COLUMNS + column]++;
    }
    for (int row = 0; row < ROWS; row++)
        for (int column = 0; column < COLUMNS; column++)
            expected[row * COLUMNS + column] =
                n * ring(claimed, (double)row / ROWS, (row + 1.0) / ROWS) / COLUMNS;
    return stats_chi2_test(count, expected, ROWS * COLUMNS);
}

/* Unit length, right side, and no trouble at the ends of the square. */
static void facts(struct test *t)
{
    const double last = 1 - 1.0 / 4294967296.0;
    for (int i = 0; i <= 10; i++)
        for (int j = 0; j <= 10; j++) {
            double u1 = fmin(i / 10.0, last), u2 = fmin(j / 10.0, last), x, y;
            vec3 h = warp_cos_hemisphere(u1, u2), s = warp_sphere(u1, u2), c = warp_cone(u1, u2, CONE_COS);
            CHECK(t, fabs(length(h) - 1) < 1e-12 && h.z >= 0, "hemisphere at %g %g", u1, u2);
            CHECK(t, fabs(length(s) - 1) < 1e-12, "sphere at %g %g", u1, u2);
            CHECK(t, fabs(length(c) - 1) < 1e-12 && c.z >= CONE_COS, "cone at %g %g", u1, u2);
            warp_disk(u1, u2, &x, &y);
            CHECK(t, x * x + y * y <= 1 + 1e-12, "disk at %g %g", u1, u2);
            warp_triangle(u1, u2, &x, &y);
            CHECK(t, x >= 0 && y >= 0 && x + y <= 1 + 1e-15, "triangle at %g %g", u1, u2);
        }
    CHECK(t, warp_cos_hemisphere_pdf_w(-0.5) == 0, "nothing below the horizon");
}

/* warp: every map of warp.h draws with the density that it states. Each sample is turned into two coordinates
 * in which the density is known in closed form per cell of a grid. */
void test_warp(struct test *t)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 7, 0);
    int n = DRAWS * test_effort(t);
    facts(t);
    for (int kind = 0; kind < N_WARPS; kind++)
        TEST_ACCEPT(t, warp_p((enum warp_kind)kind, (enum warp_kind)kind, n, &r), "warp %s", NAME[kind]);
    TEST_REJECT(t, warp_p(COS_HEMISPHERE, CONE, n, &r), "cosine-weighted directions claimed to be uniform");
    TEST_REJECT(t, warp_p(SPHERE, DISK, n, &r), "uniform directions claimed to have a radial density");
    TEST_REJECT(t, warp_p(CONE, TRIANGLE, n, &r), "cone samples with a wrong density");
}
