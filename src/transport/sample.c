/* sample.c: see sample.h. */
#include "transport/sample.h"

struct sampler sample_stream(const struct tile_pass *pass, enum rng_purpose purpose, int x, int y, uint64_t number)
{
    const struct render_job *job = pass->job;
    uint64_t pixel = (uint64_t)y * (uint64_t)job->scene->width + (uint64_t)x;
    return sampler_start(purpose == RNG_EYE ? job->eye_seed : job->seed, purpose, pixel, number);
}

struct sample sample_begin(const struct tile_pass *pass, int i, long iteration)
{
    int x = pass->tile->pixel[i][0], y = pass->tile->pixel[i][1];
    return (struct sample){.pass = pass, .i = i, .x = x, .y = y, .iteration = iteration, .eye = pass->work->eye,
                           .filter_weight = 1,
                           .sampler = sample_stream(pass, RNG_CONNECT, x, y, (uint64_t)iteration)};
}

void sample_end(const struct sample *sample) { tile_add(sample->pass->tile, sample->x, sample->y, sample->value); }

/* --- sub-paths --------------------------------------------------------------------------------------- */

static void tell_walked(const struct sample *sample, enum transport mode, const struct vertex *path, int n)
{
    for (const struct observer *o = sample->pass->observer; o != NULL; o = o->next)
        if (o->walked != NULL)
            o->walked(o->context, sample, mode, path, n);
}

int sample_eye_path(struct sample *sample, int max_vertices)
{
    const struct tile_pass *pass = sample->pass;
    struct sampler sampler = sample_stream(pass, RNG_EYE, sample->x, sample->y, (uint64_t)sample->iteration);
    struct walk w = {pass->job->scene, pass->counts, &pass->work->arena, &sampler, pass->job->rr_threshold};
    int n = path_eye_pixel(&w, sample->x, sample->y, sample->eye, max_vertices, &sample->filter_weight);
    tell_walked(sample, RADIANCE, sample->eye, n);
    return n;
}

int sample_light_path(const struct tile_pass *pass, int i, uint64_t number, struct arena *arena, struct vertex *path)
{
    struct sampler sampler = sample_stream(pass, RNG_LIGHT, pass->tile->pixel[i][0], pass->tile->pixel[i][1], number);
    struct walk w = {pass->job->scene, pass->counts, arena, &sampler, pass->job->rr_threshold};
    return path_light(&w, path, pass->job->max_depth + 1, NULL);
}

/* --- sums of connections ----------------------------------------------------------------------------- */

static void tell_joined(const struct sample *sample, const struct joined *path)
{
    for (const struct observer *o = sample->pass->observer; o != NULL; o = o->next)
        if (o->joined != NULL)
            o->joined(o->context, sample, path);
}

void sample_add(struct sample *sample, struct joined j)
{
    bool black = rgb_is_black(j.c->value); /* then it has no weight */
    if (black && sample->pass->observer == NULL)
        return;
    j.scale *= sample->filter_weight;
    j.added = black ? rgb_black() : rgb_scale(rgb_scale(j.c->value, j.scale), j.c->weight);
    if (!rgb_fits_float(j.added)) { /* the whole sample would be lost */
        sample->pass->tile->nonfinite++;
        return;
    }
    tell_joined(sample, &j);
    sample->value = rgb_add(sample->value, j.added);
}

void sample_s0(struct sample *sample, int t)
{
    const struct counts *counts = sample->pass->counts;
    const struct vertex *z = &sample->eye[t - 1], *prev = z - 1;
    if (t > 2 && !(counts->s0[prev->eye_hit] > 0))
        return;
    struct connection c = connect_s0(sample->pass->job->scene, counts, prev, z);
    sample_add(sample, (struct joined){.s = 0, .t = t, .z = z, .c = &c, .pmf = 1, .scale = 1});
}

void sample_s1(struct sample *sample, int t)
{
    const struct render_job *job = sample->pass->job;
    const struct counts *counts = sample->pass->counts;
    const struct vertex *z = &sample->eye[t - 1];
    int n = counts->light_points[z->eye_hit];
    if (z->kind == VERTEX_ESCAPED || t > job->max_depth + 1)
        return;
    for (int i = 0; i < n; i++) {
        struct vertex y;
        struct connection c = connect_s1(job->scene, counts, z, &sample->sampler, i, n, &y);
        sample_add(sample, (struct joined){.s = 1, .t = t, .path = y.light >= 0 ? &y : NULL, .z = z, .c = &c,
                                           .pmf = 1, .scale = 1.0 / n});
    }
}

void sample_pairs(struct sample *sample, const struct drawn *drawn, int t, double scale)
{
    const struct render_job *job = sample->pass->job;
    const struct vertex *z = &sample->eye[t - 1];
    for (int i = drawn->first; i < drawn->end && i + 1 + t <= job->max_depth + 2; i++) {
        struct connection c = connect_vertices(job->scene, sample->pass->counts, &drawn->path[i], z);
        sample_add(sample, (struct joined){.s = i + 1, .t = t, .path = drawn->path, .z = z, .c = &c,
                                           .pmf = drawn->pmf, .scale = scale});
    }
}

void sample_splat(struct sample *sample, struct joined j)
{
    const struct scene *scene = sample->pass->job->scene;
    const double *radius = scene->filter.radius;
    if (rgb_is_black(j.c->value)) {
        tell_joined(sample, &j);
        return;
    }
    j.added = rgb_scale(j.c->value, j.scale * j.c->weight);
    for (int i = 0, n = camera_images(&scene->camera, radius); i < n; i++) {
        struct joined image = j;
        camera_image(&scene->camera, radius, i, &image.px, &image.py);
        tell_joined(sample, &image);
        tile_add_splat(sample->pass->tile, image.px, image.py, image.added);
    }
}

void sample_lens(struct sample *sample, const struct vertex *path, int n, double scale)
{
    const struct render_job *job = sample->pass->job;
    tell_walked(sample, IMPORTANCE, path, n);
    for (int s = 2; s <= n && s <= job->max_depth + 1; s++) {
        double raster[2];
        struct connection c = connect_lens(job->scene, sample->pass->counts, &path[s - 1], &sample->sampler, raster);
        sample_splat(sample, (struct joined){.s = s, .t = 1, .path = path, .c = &c, .px = raster[0], .py = raster[1],
                                             .pmf = 1, .scale = scale / sample->pass->counts->lens});
    }
}
