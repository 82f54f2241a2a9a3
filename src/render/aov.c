/* aov.c: see aov.h. */
#include "render/aov.h"

#include <stdlib.h>

#include "base/mem.h"
#include "base/number.h"
#include "base/os.h"
#include "base/parallel.h"
#include "base/sampler.h"
#include "scene/develop.h"

enum { ALBEDO_DRAWS = 32 };

const char *aov_name(enum aov which)
{
    static const char *const names[N_AOVS] = {"albedo", "normal", "depth", "position", "variance"};
    return names[which];
}

/* Rows of the picture are the jobs. */
struct rows {
    const struct scene *scene;
    struct pixel_rect rect;
    uint64_t seed;
    int samples, surfaces; /* of a pixel; of an eye sub-path that are looked at */
    double draw[ALBEDO_DRAWS][3];
    float *const *out;   /* [N_FIRST_HIT] */
    struct arena *arena; /* [n_threads] */
};

/* Sums over the samples of a pixel. */
struct sums {
    rgb albedo;
    vec3 normal, position;
    double depth;
    int hits;
};

/* The integral of f |cos| over all directions wi, for light that leaves in direction wo: the mean of f |cos| / pdf.
 * Importance, for what radiance gains by being refracted into a cone is no albedo. All hits share the same draws, as in
 * pbrt-v4, so that what is wrong with them does not show as noise. */
static rgb albedo(const struct bsdf *b, vec3 wo, const double draw[ALBEDO_DRAWS][3])
{
    rgb sum = rgb_black();
    for (int i = 0; i < ALBEDO_DRAWS; i++) {
        struct bsdf_sample s;
        if (bsdf_sample(b, wo, draw[i], IMPORTANCE, &s))
            sum = rgb_add(sum, rgb_scale(s.f, abs_dot(s.wi, b->shading.n) / s.pdf));
    }
    sum = rgb_scale(sum, 1.0 / ALBEDO_DRAWS);
    return rgb_make(clamp(sum.r, 0, 1), clamp(sum.g, 0, 1), clamp(sum.b, 0, 1));
}

/* Of the n >= 2 vertices, the first being on the lens: the surface whose albedo and normal count. */
static const struct vertex *seen_surface(const struct vertex *eye, int n)
{
    int i = 1;
    while (i + 1 < n && eye[i + 1].kind == VERTEX_SURFACE && !vertex_connectible(&eye[i]))
        i++;
    return &eye[i];
}

/* What the way from the first surface to another leaves of light. */
static double left_of(double to, double from) { return from > 0 ? to / from : 0; }

/* What the eye sub-path of this iteration meets first. */
static void add_sample(const struct rows *r, struct arena *arena, int x, int y, int iteration, struct sums *sums)
{
    const struct scene *scene = r->scene;
    uint64_t pixel = (uint64_t)y * (uint64_t)scene->width + (uint64_t)x;
    struct sampler sampler = sampler_start(r->seed, RNG_EYE, pixel, (uint64_t)iteration);
    struct mis_counts counts = {.hit = {1, 1}}; /* nobody asks for weights */
    struct walk walk = {scene, &counts, arena, &sampler, 0};
    struct vertex eye[1 + AOV_SEEN_DEPTH], *first = &eye[1];
    double filter_weight;
    int n = path_eye_pixel(&walk, x, y, eye, 1 + r->surfaces, &filter_weight);
    if (n > 1 && first->kind == VERTEX_SURFACE) {
        const struct vertex *z = seen_surface(eye, n);
        vec3 normal = z->bsdf.shading.n, seen = sub(first->p, scene->camera.position);
        rgb a = albedo(&z->bsdf, z->wo, r->draw), to = z->beta, from = first->beta;
        sums->hits++;
        sums->albedo.r += a.r * clamp(left_of(to.r, from.r), 0, 1);
        sums->albedo.g += a.g * clamp(left_of(to.g, from.g), 0, 1);
        sums->albedo.b += a.b * clamp(left_of(to.b, from.b), 0, 1);
        sums->normal = add(sums->normal, dot(normal, z->wo) < 0 ? neg(normal) : normal);
        sums->position = add(sums->position, first->p);
        sums->depth += scene->camera.kind == CAMERA_ENVIRONMENT ? length(seen) : dot(seen, scene->camera.forward);
    }
    arena_reset(arena);
}

static void put(float *out, double a, double b, double c)
{
    out[0] = float_within(a);
    out[1] = float_within(b);
    out[2] = float_within(c);
}

static void do_row(void *context, int64_t row, int slot, int thread)
{
    const struct rows *r = context;
    (void)slot; /* a row is nobody else's: it is written where it belongs */
    for (int x = r->rect.x0; x < r->rect.x1; x++) {
        struct sums s = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0, 0};
        for (int i = 0; i < r->samples; i++)
            add_sample(r, &r->arena[thread], x, r->rect.y0 + (int)row, i, &s);
        size_t at = 3 * ((size_t)row * (size_t)rect_width(r->rect) + (size_t)(x - r->rect.x0));
        double all = 1.0 / r->samples, hits = s.hits > 0 ? 1.0 / s.hits : 0;
        put(r->out[AOV_ALBEDO] + at, s.albedo.r * all, s.albedo.g * all, s.albedo.b * all);
        put(r->out[AOV_NORMAL] + at, s.normal.x * all, s.normal.y * all, s.normal.z * all);
        put(r->out[AOV_DEPTH] + at, s.depth * hits, s.depth * hits, s.depth * hits);
        put(r->out[AOV_POSITION] + at, s.position.x * hits, s.position.y * hits, s.position.z * hits);
    }
}

static bool row_done(void *context, int64_t row, int slot)
{
    (void)context;
    (void)row;
    (void)slot;
    return true;
}

void aov_render(const struct scene *scene, const struct render_options *options, bool seen,
                float *const out[N_FIRST_HIT])
{
    struct rows r = {.scene = scene, .rect = render_crop(scene), .seed = options->seed, .out = out};
    int threads = options->n_threads < 1 ? os_cores() : options->n_threads;
    r.samples = seen ? AOV_SEEN_SAMPLES : options->end < AOV_SAMPLES ? (int)options->end : AOV_SAMPLES;
    r.surfaces = seen ? AOV_SEEN_DEPTH : 1;
    for (int i = 0; i < ALBEDO_DRAWS; i++) {
        struct sampler sampler = sampler_start(0, RNG_SELECT, 0, (uint64_t)i);
        r.draw[i][0] = sampler_number(&sampler, DRAW_LOBE);
        sampler_pair(&sampler, DRAW_SCATTERING, &r.draw[i][1]);
    }
    r.arena = mem_alloc((size_t)threads, sizeof *r.arena);
    struct parallel_jobs jobs = {rect_height(r.rect), threads, 2 * threads, &r, do_row, row_done, NULL};
    parallel_run(&jobs);
    for (int i = 0; i < threads; i++)
        arena_free(&r.arena[i]);
    free(r.arena);
}

void aov_variance(const struct film *film, double scale, float *out)
{
    film_standard_error(film, scale, out);
    for (size_t i = 0; i < rect_pixels(film->rect) * 3; i++)
        out[i] = float_within((double)out[i] * (double)out[i]);
}
