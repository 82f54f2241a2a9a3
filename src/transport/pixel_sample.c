/* pixel_sample.c: see pixel_sample.h. */
#include "transport/pixel_sample.h"

/* --- observers --------------------------------------------------------------------------------------- */

static void tell_walked(const struct pixel_sample *sample, enum transport mode, const struct vertex *path, int n)
{
    for (const struct observer *o = sample->observer; o != NULL; o = o->next)
        if (o->walked != NULL)
            o->walked(o->context, sample, mode, path, n);
}

static void tell_joined(const struct pixel_sample *sample, const struct joined *path)
{
    for (const struct observer *o = sample->observer; o != NULL; o = o->next)
        if (o->joined != NULL)
            o->joined(o->context, sample, path);
}

/* --- sub-paths --------------------------------------------------------------------------------------- */

/* The stream of a pixel, for a purpose and by a number of its own. */
static struct sampler stream(const struct render_job *job, uint64_t seed, enum rng_purpose purpose, int x, int y,
                             uint64_t number)
{
    uint64_t pixel = (uint64_t)y * (uint64_t)job->scene->width + (uint64_t)x;
    return sampler_start(seed, purpose, pixel, number);
}

struct pixel_sample pixel_sample_begin(const struct tile_pass *pass, const struct mis_counts *counts, int x, int y,
                                       long iteration)
{
    const struct render_job *job = pass->job;
    struct pixel_sample sample = {.scene = job->scene, .counts = counts, .tile = pass->tile, .observer = pass->observer,
                                  .max_depth = job->max_depth, .x = x, .y = y, .iteration = iteration,
                                  .filter_weight = 1, .light_points = 1};
    sample.sampler = stream(job, job->seed, RNG_CONNECT, x, y, (uint64_t)iteration);
    return sample;
}

int pixel_eye_path(const struct tile_pass *pass, struct pixel_sample *sample, struct vertex *path, int max_vertices)
{
    struct sampler sampler = stream(pass->job, pass->job->eye_seed, RNG_EYE, sample->x, sample->y,
                                    (uint64_t)sample->iteration);
    struct walk w = {sample->scene, sample->counts, &pass->work->arena, &sampler, pass->job->rr_threshold};
    int n = path_eye_pixel(&w, sample->x, sample->y, path, max_vertices, &sample->filter_weight);
    tell_walked(sample, RADIANCE, path, n);
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
    int n = path_light(&w, path, job->max_depth + 1);
    return n;
}

double pixel_light_count(const struct render_job *job)
{
    return (double)rect_width(job->film_rect) * rect_height(job->film_rect);
}

/* --- sums of connections ----------------------------------------------------------------------------- */

void pixel_add(struct pixel_sample *sample, const struct connection *c, int s, int t, const struct vertex *y,
               const struct vertex *z, struct choice choice)
{
    bool black = rgb_is_black(c->value);
    if (black && sample->observer == NULL)
        return;
    double scale = choice.scale * sample->filter_weight;
    rgb added = black ? rgb_black() : rgb_scale(rgb_scale(c->value, scale), c->weight);
    if (!black && !rgb_is_finite(added)) { /* the whole sample would be lost */
        sample->tile->nonfinite++;
        return;
    }
    if (sample->observer != NULL) {
        const struct joined path = {s, t, y, z, c, choice.pmf, scale, added};
        tell_joined(sample, &path);
    }
    sample->value = rgb_add(sample->value, added);
}

void pixel_sum_hit(struct pixel_sample *sample, const struct vertex *eye, int t)
{
    struct connection c = connect_hit(sample->scene, sample->counts, &eye[t - 2], &eye[t - 1], t);
    pixel_add(sample, &c, 0, t, NULL, &eye[t - 1], NO_CHOICE);
}

void pixel_sum_direct(struct pixel_sample *sample, const struct vertex *eye, int t)
{
    const struct vertex *z = &eye[t - 1];
    if (z->kind == VERTEX_ESCAPED || t > sample->max_depth + 1)
        return;
    int n = z->eye_end == FIRST_HIT ? sample->light_points : 1;
    const struct choice each = {1, 1.0 / n};
    for (int i = 0; i < n; i++) {
        struct connection c = connect_direct(sample->scene, sample->counts, z, &sample->sampler, i, n);
        pixel_add(sample, &c, 1, t, NULL, z, each);
    }
}

void pixel_sum_eye(struct pixel_sample *sample, const struct vertex *eye, int n)
{
    for (int t = 2; t <= n; t++) {
        if (t == 2 || sample->counts->hit[eye[t - 2].eye_end] > 0)
            pixel_sum_hit(sample, eye, t);
        if (sample->counts->direct[eye[t - 1].eye_end] > 0)
            pixel_sum_direct(sample, eye, t);
    }
}

void pixel_sum_pair(struct pixel_sample *sample, const struct vertex *y, int s, const struct vertex *z, int t,
                    struct choice choice)
{
    struct connection c = connect_pair(sample->scene, sample->counts, y, z);
    pixel_add(sample, &c, s, t, y, z, choice);
}

void pixel_sum_pairs(struct pixel_sample *sample, const struct vertex *eye, int n_eye, const struct vertex *light,
                     int n_light, struct choice choice)
{
    tell_walked(sample, IMPORTANCE, light, n_light);
    for (int t = 2; t <= n_eye; t++)
        for (int s = 2; s <= n_light && s + t <= sample->max_depth + 2; s++)
            pixel_sum_pair(sample, &light[s - 1], s, &eye[t - 1], t, choice);
}

void pixel_splat(struct pixel_sample *sample, const struct connection *c, int s, const struct vertex *y, double scale)
{
    const double *radius = sample->scene->filter.radius;
    bool seen = !rgb_is_black(c->value);
    rgb added = seen ? rgb_scale(c->value, scale * c->weight) : rgb_black();
    if (!seen && sample->observer == NULL)
        return;
    int group = sample->scene->lights.light[y[1 - s].light].group;
    for (int i = 0, n = seen ? camera_images(&sample->scene->camera, radius) : 1; i < n; i++) {
        double px = c->px, py = c->py;
        if (seen)
            camera_image(&sample->scene->camera, radius, i, &px, &py);
        if (sample->observer != NULL) {
            struct connection image = *c;
            image.px = px;
            image.py = py;
            const struct joined path = {s, 1, y, NULL, &image, 1, scale, added};
            tell_joined(sample, &path);
        }
        if (seen)
            tile_add_splat(sample->tile, px, py, added, group);
    }
}

void pixel_splat_path(struct pixel_sample *sample, const struct vertex *light, int n_light, double scale)
{
    double each = scale / sample->counts->splat;
    tell_walked(sample, IMPORTANCE, light, n_light);
    for (int s = 2; s <= n_light && s <= sample->max_depth + 1; s++) {
        struct connection c = connect_lens(sample->scene, sample->counts, light, s, &sample->sampler);
        pixel_splat(sample, &c, s, &light[s - 1], each);
    }
}

void pixel_sample_end(const struct pixel_sample *sample)
{
    tile_add(sample->tile, sample->x, sample->y, sample->value);
}
