/* aov.c: see aov.h. */
#include "lab/aov.h"

#include <stdlib.h>

#include "base/mem.h"
#include "base/number.h"
#include "base/os.h"
#include "base/parallel.h"
#include "base/sampler.h"

enum { ALBEDO_DRAWS = 32 };

const char *aov_name(enum aov which)
{
    static const char *const names[N_AOVS] = {"albedo", "normal", "depth", "position", "variance"};
    return names[which];
}

/* A sample of each pixel; rows of the picture are the jobs. */
struct pass {
    const struct scene *scene;
    const struct render_job *options;
    struct pixel_rect rect;
    int samples, surfaces; /* of a pixel; of an eye sub-path that are looked at */
    int sample;            /* this one */
    int *done;             /* [rows] samples that are in */
    int *hits;             /* [rows * columns] of a pixel's samples those that have hit something */
    bool stopped;
    double draw[ALBEDO_DRAWS][3];
    float *const *out;   /* [N_FIRST_HIT], sums so far */
    struct arena *arena; /* [n_threads] */
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

static void add_values(float *sum, double a, double b, double c)
{
    sum[0] = float_within((double)sum[0] + a);
    sum[1] = float_within((double)sum[1] + b);
    sum[2] = float_within((double)sum[2] + c);
}

/* What the eye sub-path of this sample meets first, to the sums of its pixel. */
static void add_sample(const struct pass *r, struct arena *arena, int x, int y, size_t at)
{
    const struct scene *scene = r->scene;
    uint64_t pixel = (uint64_t)y * (uint64_t)scene->width + (uint64_t)x;
    struct sampler sampler = sampler_start(r->options->seed, RNG_EYE, pixel, (uint64_t)r->sample);
    const struct counts counts = {.s0 = {1, 1}, .tables = &NO_TABLES}; /* nobody asks for weights */
    struct walk walk = {scene, &counts, arena, &sampler, 0};
    struct vertex eye[1 + AOV_SEEN_DEPTH], *first = &eye[1];
    double filter_weight;
    int n = path_eye_pixel(&walk, x, y, eye, 1 + r->surfaces, &filter_weight);
    if (n > 1 && first->kind == VERTEX_SURFACE) {
        const struct vertex *z = seen_surface(eye, n);
        vec3 normal = z->bsdf.shading.n, seen = sub(first->p, scene->camera.position);
        normal = dot(normal, z->wo) < 0 ? neg(normal) : normal;
        rgb a = albedo(&z->bsdf, z->wo, r->draw), to = z->beta, from = first->beta;
        double depth = scene->camera.kind == CAMERA_ENVIRONMENT ? length(seen) : dot(seen, scene->camera.forward);
        add_values(r->out[AOV_ALBEDO] + at, a.r * clamp(left_of(to.r, from.r), 0, 1),
            a.g * clamp(left_of(to.g, from.g), 0, 1), a.b * clamp(left_of(to.b, from.b), 0, 1));
        add_values(r->out[AOV_NORMAL] + at, normal.x, normal.y, normal.z);
        add_values(r->out[AOV_POSITION] + at, first->p.x, first->p.y, first->p.z);
        add_values(r->out[AOV_DEPTH] + at, depth, depth, depth);
        r->hits[at / 3]++;
    }
    arena_reset(arena);
}

static size_t row_begin(const struct pass *r, int64_t row) { return 3 * (size_t)row * (size_t)rect_width(r->rect); }

static void do_row(void *context, int64_t row, int slot, int thread)
{
    const struct pass *r = context;
    (void)slot; /* a row is nobody else's: it is written where it belongs */
    for (int x = r->rect.x0; x < r->rect.x1; x++)
        add_sample(r, &r->arena[thread], x, r->rect.y0 + (int)row, row_begin(r, row) + 3 * (size_t)(x - r->rect.x0));
    r->done[row]++;
}

/* Once all have a sample the end of a block is wherever one likes. */
static bool row_done(void *context, int64_t row, int slot)
{
    struct pass *r = context;
    const struct render_job *o = r->options;
    double done = r->sample + (double)(row + 1) / rect_height(r->rect);
    (void)slot;
    job_progress(o, 1, done / r->samples);
    enum cancel cancel = job_cancelled(o);
    r->stopped = cancel == CANCEL_NOW || (cancel == CANCEL_BLOCK && done >= 1);
    return !r->stopped;
}

/* From sums to means, positions in the coordinates of the file. False where a row has nothing. */
static bool divide(const struct pass *r)
{
    const double origin[3] = {r->scene->origin.x, r->scene->origin.y, r->scene->origin.z};
    bool all = true;
    for (int row = 0; row < rect_height(r->rect); row++) {
        all = all && r->done[row] > 0;
        for (size_t i = row_begin(r, row); i < row_begin(r, row + 1); i++)
            for (int k = 0; k < N_FIRST_HIT; k++) {
                bool of_hits = k == AOV_DEPTH || k == AOV_POSITION;
                double n = most_of(of_hits ? r->hits[i / 3] : r->done[row], 1);
                double shift = k == AOV_POSITION && r->hits[i / 3] > 0 ? origin[i % 3] : 0;
                r->out[k][i] = float_within((double)r->out[k][i] / n + shift);
            }
    }
    return all;
}

bool aov_render(const struct scene *scene, const struct render_job *options, bool seen,
                float *const out[N_FIRST_HIT])
{
    struct pass r = {.scene = scene, .rect = render_crop(scene), .options = options, .out = out};
    int threads = options->n_threads < 1 ? os_cores() : options->n_threads, rows = rect_height(r.rect);
    r.samples = int_within((double)options->end, 1, seen ? AOV_SEEN_SAMPLES : AOV_SAMPLES);
    r.surfaces = seen ? AOV_SEEN_DEPTH : 1;
    for (int i = 0; i < ALBEDO_DRAWS; i++) {
        struct sampler sampler = sampler_start(0, RNG_SELECT, 0, (uint64_t)i);
        r.draw[i][0] = sampler_number(&sampler, DRAW_LOBE);
        sampler_pair(&sampler, DRAW_SCATTERING, &r.draw[i][1]);
    }
    r.arena = mem_alloc((size_t)threads, sizeof *r.arena);
    r.done = mem_alloc((size_t)rows, sizeof *r.done);
    r.hits = mem_alloc(rect_pixels(r.rect), sizeof *r.hits);
    struct parallel_jobs jobs = {rows, threads, 2 * threads, &r, do_row, row_done, NULL};
    for (; !r.stopped && r.sample < r.samples; r.sample++)
        parallel_run(&jobs);
    bool all = divide(&r);
    for (int i = 0; i < threads; i++)
        arena_free(&r.arena[i]);
    free(r.arena);
    free(r.done);
    free(r.hits);
    return all;
}
