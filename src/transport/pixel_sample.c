/* pixel_sample.c: see pixel_sample.h. */
#include "transport/pixel_sample.h"

/* --- sub-paths --------------------------------------------------------------------------------------- */

static uint64_t pixel_number(const struct scene *scene, int x, int y)
{
    return (uint64_t)y * (uint64_t)scene->width + (uint64_t)x;
}

struct pixel_sample pixel_sample_begin(const struct tile_pass *pass, const struct mis_counts *counts, int x, int y,
                                       long iteration)
{
    const struct render_job *job = pass->job;
    struct sampler points = sampler_start(job->seed, RNG_CONNECT, pixel_number(job->scene, x, y), (uint64_t)iteration);
    struct pixel_sample g = {job->scene, counts, pass->tile, job->max_depth, x, y, 1, 1, points};
    return g;
}

int pixel_eye_path(const struct tile_pass *pass, struct pixel_sample *g, long iteration, struct vertex *path,
                   int max_vertices)
{
    uint64_t pixel = pixel_number(g->scene, g->x, g->y);
    struct sampler sampler = sampler_start(pass->job->eye_seed, RNG_EYE, pixel, (uint64_t)iteration);
    struct walk w = {g->scene, g->counts, &pass->work->arena, &sampler, pass->job->rr_threshold};
    return path_eye_pixel(&w, g->x, g->y, path, max_vertices, &g->filter_weight);
}

struct sampler pixel_sampler(const struct tile_pass *pass, enum rng_purpose purpose, int x, int y, long iteration)
{
    uint64_t pixel = pixel_number(pass->job->scene, x, y);
    return sampler_start(pass->job->seed, purpose, pixel, (uint64_t)iteration);
}

int pixel_light_path(const struct tile_pass *pass, const struct mis_counts *counts, int x, int y,
                uint64_t number, struct arena *arena, struct vertex *path)
{
    const struct render_job *job = pass->job;
    uint64_t pixel = pixel_number(job->scene, x, y);
    struct sampler sampler = sampler_start(job->seed, RNG_LIGHT, pixel, number);
    struct walk w = {job->scene, counts, arena, &sampler, job->rr_threshold};
    return path_light(&w, path, job->max_depth + 1);
}

double pixel_light_count(const struct render_job *job)
{
    return (double)rect_width(job->film_rect) * rect_height(job->film_rect);
}

/* --- sums of connections ----------------------------------------------------------------------------- */

/* A strategy's weighted share of the pixel; what it is made of is kept where pictures of single strategies are wanted.
 * */
static rgb weigh(struct pixel_sample *g, struct connection c, int s, int t, double scale)
{
    if (rgb_is_black(c.value))
        return rgb_black();
    rgb value = rgb_scale(c.value, scale * g->filter_weight);
    if (g->tile->keep_records)
        tile_record_eye(g->tile, g->x, g->y, s, t, value, c.weight);
    return rgb_scale(value, c.weight);
}

static rgb sum_direct(struct pixel_sample *g, const struct vertex *z, int t)
{
    rgb sum = rgb_black();
    int n = t == 2 ? g->lights : 1;
    for (int i = 0; i < n; i++)
        sum = rgb_add(sum, weigh(g, connect_direct(g->scene, g->counts, z, &g->sampler, NULL), 1, t, 1.0 / n));
    return sum;
}

/* s = 0: the light at z_{t-1}, and those passed on the way there. */
static rgb sum_hits(struct pixel_sample *g, const struct vertex *eye, int t)
{
    rgb sum = rgb_black();
    for (const struct vertex *z = &eye[t - 1]; z != NULL; z = z->passed)
        sum = rgb_add(sum, weigh(g, connect_hit(g->scene, g->counts, &eye[t - 2], z, t), 0, t, 1));
    return sum;
}

rgb pixel_sum_eye(struct pixel_sample *g, const struct vertex *eye, int n)
{
    rgb sum = rgb_black();
    for (int t = 2; t <= n; t++) {
        const struct vertex *z = &eye[t - 1];
        if (t == 2 || g->counts->hit > 0)
            sum = rgb_add(sum, sum_hits(g, eye, t));
        if (g->counts->direct[0] > 0 && t <= g->max_depth + 1 && z->kind == VERTEX_SURFACE)
            sum = rgb_add(sum, sum_direct(g, z, t));
    }
    return sum;
}

rgb pixel_sum_pair(struct pixel_sample *g, const struct vertex *y, int s, const struct vertex *z, int t, double scale)
{
    return weigh(g, connect_pair(g->scene, g->counts, y, z), s, t, scale);
}

rgb pixel_sum_pairs(struct pixel_sample *g, const struct vertex *eye, int n_eye, const struct vertex *light,
                    int n_light, double scale)
{
    rgb sum = rgb_black();
    for (int t = 2; t <= n_eye; t++)
        for (int s = 2; s <= n_light && s + t <= g->max_depth + 2; s++)
            sum = rgb_add(sum, pixel_sum_pair(g, &light[s - 1], s, &eye[t - 1], t, scale));
    return sum;
}

void pixel_splat_path(struct pixel_sample *g, const struct vertex *light, int n_light, double scale)
{
    double each = scale / g->counts->splat;
    for (int s = 2; s <= n_light && s <= g->max_depth + 1; s++) {
        struct connection c = connect_lens(g->scene, g->counts, light, s, &g->sampler);
        if (rgb_is_black(c.value))
            continue;
        const double *radius = g->scene->filter.radius;
        for (int i = 0; i < camera_images(&g->scene->camera, radius); i++) {
            double px = c.px, py = c.py;
            camera_image(&g->scene->camera, radius, i, &px, &py);
            if (g->tile->keep_records)
                tile_record_splat(g->tile, px, py, s, 1, rgb_scale(c.value, each), c.weight);
            tile_add_splat(g->tile, px, py, rgb_scale(c.value, each * c.weight));
        }
    }
}
