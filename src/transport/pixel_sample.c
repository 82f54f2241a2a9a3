/* pixel_sample.c: see pixel_sample.h. */
#include "transport/pixel_sample.h"

/* --- sub-paths --------------------------------------------------------------------------------------- */

static uint64_t pixel_number(const struct scene *scene, int x, int y)
{
    return (uint64_t)y * (uint64_t)scene->width + (uint64_t)x;
}

/* The stream of a pixel, by whatever number of its own. */
static struct sampler stream(const struct render_job *job, uint64_t seed, enum rng_purpose purpose, int x, int y,
                             uint64_t number)
{
    struct sampler s = sampler_start(seed, purpose, pixel_number(job->scene, x, y), number);
    s.tape = job->tape;
    return s;
}

struct pixel_sample pixel_sample_begin(const struct tile_pass *pass, const struct mis_counts *counts, int x, int y,
                                       long iteration)
{
    const struct render_job *job = pass->job;
    struct sampler points = stream(job, job->seed, RNG_CONNECT, x, y, (uint64_t)iteration);
    struct pixel_sample g = {job->scene, counts, pass->tile, job->max_depth, x, y, 1, 1, points, rgb_black(),
                             trace_watches(pass->trace, x, y, iteration)};
    return g;
}

int pixel_eye_path(const struct tile_pass *pass, struct pixel_sample *g, long iteration, struct vertex *path,
                   int max_vertices)
{
    struct sampler sampler = stream(pass->job, pass->job->eye_seed, RNG_EYE, g->x, g->y, (uint64_t)iteration);
    struct walk w = {g->scene, g->counts, &pass->work->arena, &sampler, pass->job->rr_threshold};
    int n = path_eye_pixel(&w, g->x, g->y, path, max_vertices, &g->filter_weight);
    if (g->trace != NULL)
        trace_eye(g->trace, path, n, g->filter_weight);
    return n;
}

struct sampler pixel_sampler(const struct tile_pass *pass, enum rng_purpose purpose, int x, int y, long iteration)
{
    return stream(pass->job, pass->job->seed, purpose, x, y, (uint64_t)iteration);
}

int pixel_light_path(const struct tile_pass *pass, const struct mis_counts *counts, int x, int y, uint64_t number,
                     struct arena *arena, struct vertex *path)
{
    const struct render_job *job = pass->job;
    struct sampler sampler = stream(job, job->seed, RNG_LIGHT, x, y, number);
    struct walk w = {job->scene, counts, arena, &sampler, job->rr_threshold};
    return path_light(&w, path, job->max_depth + 1);
}

double pixel_light_count(const struct render_job *job)
{
    return (double)rect_width(job->film_rect) * rect_height(job->film_rect);
}

/* --- sums of connections ----------------------------------------------------------------------------- */

/* Add a strategy's weighted share to the pixel; what it is made of is kept where pictures of single strategies are
 * wanted, or where somebody watches.
 *   light  the light sub-path whose first s vertices were joined; NULL for s <= 1 */
static void contribute(struct pixel_sample *g, const struct connection *c, int s, int t, const struct vertex *light,
                       struct choice choice)
{
    rgb added = rgb_black();
    if (!rgb_is_black(c->value)) {
        rgb value = rgb_scale(c->value, choice.scale * g->filter_weight);
        if (g->tile->keep_records)
            tile_record_eye(g->tile, g->x, g->y, s, t, value, c->weight);
        added = rgb_scale(value, c->weight);
        g->sum = rgb_add(g->sum, added);
    }
    if (g->trace != NULL)
        trace_connect(g->trace, s, t, light, c, choice.pmf, choice.scale * g->filter_weight, added);
}

static void sum_direct(struct pixel_sample *g, const struct vertex *z, int t)
{
    int n = z->eye_end == FIRST_HIT ? g->lights : 1;
    const struct choice each = {1, 1.0 / n};
    for (int i = 0; i < n; i++) {
        struct connection c = connect_direct(g->scene, g->counts, z, &g->sampler);
        contribute(g, &c, 1, t, NULL, each);
    }
}

static void sum_hit(struct pixel_sample *g, const struct vertex *eye, int t)
{
    struct connection c = connect_hit(g->scene, g->counts, &eye[t - 2], &eye[t - 1], t);
    contribute(g, &c, 0, t, NULL, NO_CHOICE);
}

void pixel_sum_eye(struct pixel_sample *g, const struct vertex *eye, int n)
{
    for (int t = 2; t <= n; t++) {
        const struct vertex *z = &eye[t - 1];
        if (t == 2 || g->counts->hit > 0)
            sum_hit(g, eye, t);
        if (g->counts->direct[FIRST_HIT] > 0 && t <= g->max_depth + 1 && z->kind == VERTEX_SURFACE)
            sum_direct(g, z, t);
    }
}

void pixel_sum_pair(struct pixel_sample *g, const struct vertex *y, int s, const struct vertex *z, int t,
                    struct choice choice)
{
    struct connection c = connect_pair(g->scene, g->counts, y, z);
    contribute(g, &c, s, t, y - (s - 1), choice);
}

void pixel_sum_joint(struct pixel_sample *g, const struct joint *j, int s, int t, struct choice choice)
{
    struct connection c = connect_joint(g->scene, g->counts, j);
    contribute(g, &c, s, t, j->y - (s - 1), choice);
}

void pixel_sum_pairs(struct pixel_sample *g, const struct vertex *eye, int n_eye, const struct vertex *light,
                     int n_light, struct choice choice)
{
    if (g->trace != NULL)
        trace_light(g->trace, light, n_light);
    for (int t = 2; t <= n_eye; t++)
        for (int s = 2; s <= n_light && s + t <= g->max_depth + 2; s++)
            pixel_sum_pair(g, &light[s - 1], s, &eye[t - 1], t, choice);
}

/* A light sub-path of s vertices arrives at every raster point that is the same ray. */
static void splat(struct pixel_sample *g, const struct connection *c, int s, const struct vertex *light, double scale)
{
    const double *radius = g->scene->filter.radius;
    rgb added = rgb_scale(c->value, scale * c->weight);
    for (int i = 0; i < camera_images(&g->scene->camera, radius); i++) {
        struct connection image = *c;
        camera_image(&g->scene->camera, radius, i, &image.px, &image.py);
        if (tile_add_splat(g->tile, image.px, image.py, added))
            tile_record_splat(g->tile, s, rgb_scale(c->value, scale), c->weight);
        if (g->trace != NULL)
            trace_connect(g->trace, s, 1, light, &image, 1, scale, added);
    }
}

void pixel_splat_path(struct pixel_sample *g, const struct vertex *light, int n_light, double scale)
{
    double each = scale / g->counts->splat;
    if (g->trace != NULL)
        trace_light(g->trace, light, n_light);
    for (int s = 2; s <= n_light && s <= g->max_depth + 1; s++) {
        struct connection c = connect_lens(g->scene, g->counts, light, s, &g->sampler);
        if (!rgb_is_black(c.value))
            splat(g, &c, s, light, each);
        else if (g->trace != NULL)
            trace_connect(g->trace, s, 1, light, &c, 1, each, rgb_black());
    }
}
