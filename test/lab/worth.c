/* worth.c: see worth.h. */
#include "lab/worth.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/maths.h"
#include "base/mem.h"
#include "base/number.h"
#include "caustics/visible.h"
#include "integrators/prepare.h"
#include "lab/aov.h"
#include "lab/methods.h"

enum { LIGHT_PATHS = 64 * 1024, GAP = 8, LABEL = 24, TEXT = 2, WIDE = 320 };

struct view {
    struct render_job job;
    struct counts counts; /* for the walks, which look regions up; the weights are not used */
    struct workspace *work;
    struct vertex *light; /* [max_depth + 1] */
    const double *ratio;  /* [regions] of the region of the point */
    float *worth, *draws;
};

static struct walk walk_of(const struct view *v, struct sampler *sampler)
{
    struct walk w = {v->job.scene, &v->counts, &v->work->arena, sampler, v->job.rr_threshold};
    return w;
}

/* The first surface through the middle of a pixel, in work->eye[1]; false if there is none to connect to. */
static bool look(const struct view *v, int x, int y)
{
    arena_reset(&v->work->arena);
    struct sampler sampler = sampler_start(v->job.seed, RNG_TEST, 0, 0);
    struct walk w = walk_of(v, &sampler);
    return path_eye(&w, x + 0.5, y + 0.5, v->work->eye, 2) == 2 && v->work->eye[1].kind == VERTEX_SURFACE &&
           vertex_connectible(&v->work->eye[1]);
}

static void map_worth(const struct view *v)
{
    const struct scene *s = v->job.scene;
    for (int y = 0; y < s->height; y++)
        for (int x = 0; x < s->width; x++)
            v->worth[y * s->width + x] = look(v, x, y) ? float_within(v->ratio[v->work->eye[1].place]) : 0;
}

/* Adds p to the pixel in which the camera sees the light vertex y, if it does. */
static void add_draw(const struct view *v, const struct vertex *y, double p)
{
    const struct scene *s = v->job.scene;
    vec3 lens = camera_sample_lens(&s->camera, y->p, 0.5, 0.5), d = sub(y->p, lens);
    double px, py;
    if (!(length2(d) > 0) || camera_project(&s->camera, lens, normalize(d), &px, &py) == 0)
        return;
    if (px >= 0 && py >= 0 && px < s->width && py < s->height && scene_visible(s, lens, 0, y->p, y->prim_id))
        v->draws[(int)py * s->width + (int)px] += float_within(p);
}

/* Twice the same light sub-paths: the sum of ratio L of all their vertices, then each one's share of it. */
static void map_draws(const struct view *v)
{
    double total = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k < LIGHT_PATHS && (pass == 0 || total > 0); k++) {
            arena_reset(&v->work->arena);
            struct sampler sampler = sampler_start(v->job.seed, RNG_LIGHT, (uint64_t)k, 0);
            struct walk w = walk_of(v, &sampler);
            int n = path_light(&w, v->light, v->job.max_depth + 1, NULL);
            for (int i = 1; i < n; i++) {
                const struct vertex *y = &v->light[i];
                double worth = vertex_connectible(y) ? v->ratio[y->place] * rgb_worth(y->beta) : 0;
                if (pass == 0)
                    total += worth;
                else if (worth > 0)
                    add_draw(v, y, worth / total);
            }
        }
}

static bool fill(struct view *v, int x, int y, struct error *err)
{
    const struct scene *s = v->job.scene;
    if (s->lights.n == 0)
        return error_set(err, "the scene has no light");
    if (v->counts.tables->pairs.rows < 2)
        return error_set(err, "this selection learns nothing about pairs of places; select=subspaces does");
    if (x < 0 || y < 0 || x >= s->width || y >= s->height)
        return error_usage(err, "--pixel %d,%d lies outside the film of %dx%d", x, y, s->width, s->height);
    if (!look(v, x, y))
        return error_set(err, "no surface that can be connected to is seen through pixel %d,%d", x, y);
    v->ratio = table_row(&v->counts.tables->pairs, v->work->eye[1].place);
    map_worth(v);
    map_draws(v);
    return true;
}

bool worth_values(const struct scene *scene, const struct render_job *options, int x, int y, float *worth,
                  float *draws, struct error *err)
{
    struct view v = {.worth = worth, .draws = draws};
    struct prepared prepared;
    v.job = *options;
    if (!job_settle(&v.job, scene, &prepared, err))
        return false;
    v.job.film_rect = (struct pixel_rect){0, 0, scene->width, scene->height};
    prepared.parameters.race = RACE_OFF; /* which may choose a path tracer, that has no pairs */
    job_prepare(&v.job, &prepared);
    v.counts = prepared.counts;
    v.light = mem_alloc((size_t)v.job.max_depth + 1, sizeof *v.light);
    v.work = workspaces_new(1, v.job.max_depth);
    bool ok = fill(&v, x, y, err);
    workspaces_free(v.work, 1);
    free(v.light);
    method_release(&prepared);
    return ok;
}

/* --- the sheet --------------------------------------------------------------------------------------- */

/* Colours by the logarithm of a share of the largest value. */
static void colour(const float *value, size_t n, float *out)
{
    double most = 0;
    for (size_t i = 0; i < n; i++)
        most = fmax(most, (double)value[i]);
    for (size_t i = 0; i < n; i++) {
        double share = most > 0 ? (double)value[i] / most : 0;
        viridis(share > 0 ? 1 + m_log(share) / m_log(WORTH_RANGE) : 0, &out[3 * i]);
    }
}

/* Lit from the camera: surfaces of one colour are told apart. */
static void shade(const struct scene *scene, float *const aov[N_FIRST_HIT], size_t n)
{
    for (size_t i = 0; i < 3 * n; i += 3) {
        const float *p = &aov[AOV_POSITION][i], *m = &aov[AOV_NORMAL][i];
        vec3 at = sub(vec((double)p[0], (double)p[1], (double)p[2]), scene->origin); /* as the camera has it */
        vec3 towards = sub(camera_sample_lens(&scene->camera, at, 0.5, 0.5), at);
        vec3 normal = vec((double)m[0], (double)m[1], (double)m[2]);
        double length = sqrt(length2(towards));
        double facing = length > 0 ? fabs(dot(normal, towards)) / length : 0;
        for (int c = 0; c < 3; c++)
            aov[AOV_ALBEDO][i + (size_t)c] = float_within((double)aov[AOV_ALBEDO][i + (size_t)c] * facing);
    }
}

/* A white square around the pixel, on every picture. */
static void mark(struct sheet *s, int left, int x, int y, int scale)
{
    const float white[3] = {1, 1, 1};
    for (int i = -2; i <= 2; i++)
        for (int j = -2; j <= 2; j++)
            if (i == -2 || i == 2 || j == -2 || j == 2)
                sheet_paste(s, left + (x + i) * scale, LABEL + (y + j) * scale, white, 1, 1, scale);
}

static void draw_sheet(struct sheet *s, const struct scene *scene, const float *const picture[3], int x, int y,
                       int scale)
{
    static const char *const labels[3] = {"scene", "worth", "draws"};
    char least[32];
    int width = scene->width * scale, below = LABEL + scene->height * scale + GAP;
    sheet_init(s, 3 * width + 2 * GAP, below + SHEET_BAR, SHEET_PAPER);
    snprintf(least, sizeof least, "1/%d", WORTH_RANGE);
    sheet_bar(s, width + GAP, below, 2 * width + GAP, least, "share of the largest value (logarithm)", "1");
    for (int i = 0; i < 3; i++) {
        int left = i * (width + GAP);
        sheet_text(s, left + GAP, (LABEL - TEXT * FONT_HEIGHT) / 2, TEXT, SHEET_INK, labels[i]);
        sheet_paste(s, left, LABEL, picture[i], scene->width, scene->height, scale);
        mark(s, left, x, y, scale);
    }
}

bool worth_picture(const struct scene *scene, const struct render_job *options, int x, int y, int scale,
                   struct sheet *out, struct error *err)
{
    size_t n = (size_t)scene->width * (size_t)scene->height;
    float *value = mem_alloc(2 * n, sizeof *value), *pixels = mem_alloc((2 + N_FIRST_HIT) * 3 * n, sizeof *pixels);
    float *aov[N_FIRST_HIT];
    for (int i = 0; i < N_FIRST_HIT; i++)
        aov[i] = pixels + (size_t)(2 + i) * 3 * n;
    bool ok = worth_values(scene, options, x, y, value, value + n, err);
    if (ok) {
        const double all[4] = {0, 1, 0, 1};
        struct scene whole = *scene; /* whatever its crop window is */
        memcpy(whole.crop, all, sizeof all);
        aov_render(&whole, options, false, aov);
        shade(scene, aov, n);
        colour(value, n, pixels);
        colour(value + n, n, pixels + 3 * n);
        const float *const picture[3] = {aov[AOV_ALBEDO], pixels, pixels + 3 * n};
        draw_sheet(out, scene, picture, x, y, scale > 0 ? scale : (WIDE + scene->width - 1) / scene->width);
    }
    free(value);
    free(pixels);
    return ok;
}
