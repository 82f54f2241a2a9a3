/* pixel_sample.c: see pixel_sample.h. */
#include "transport/pixel_sample.h"

#include "transport/caustic.h"
#include "transport/regularise.h"

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
    struct pixel_sample sample = {job->scene, counts, pass->tile, job->max_depth, x, y, 1, 0, 1, points, rgb_black(),
                                  rgb_black(), rgb_black(), iteration, trace_watches(pass->trace, x, y, iteration),
                                  pass->worst, &pass->work->arena, 0};
    if (job->regularise > 0)
        sample.eps = regularise_eps(job->regularise, iteration);
    return sample;
}

/* Does the lens see anything there, be it light? */
static bool covered(const struct scene *scene, const struct vertex *eye, int n)
{
    const struct light_set *lights = &scene->lights;
    const struct vertex *z = n > 1 ? &eye[1] : NULL;
    return z != NULL && (z->kind == VERTEX_SURFACE || (z->lamp != NULL && !lights->light[z->lamp->light].hidden) ||
                         (z->lamp == NULL && lights->seen_infinite));
}

int pixel_eye_path(const struct tile_pass *pass, struct pixel_sample *sample, long iteration, struct vertex *path,
                   int max_vertices)
{
    struct sampler sampler = stream(pass->job, pass->job->eye_seed, RNG_EYE, sample->x, sample->y, (uint64_t)iteration);
    struct walk w = {sample->scene, sample->counts, &pass->work->arena, &sampler, pass->job->rr_threshold};
    int n = path_eye_pixel(&w, sample->x, sample->y, path, max_vertices, &sample->filter_weight);
    sample->alpha = covered(sample->scene, path, n) ? sample->filter_weight : 0;
    if (sample->trace != NULL)
        trace_eye_path(sample->trace, path, n, sample->filter_weight);
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

/* What gates and groups of lights tell apart: of the step from `from` to `to` the group has its share. */
static void tell_light(const struct pixel_sample *sample, int light, rgb from, rgb to)
{
    if (sample->tile->planes.lights > 0)
        tile_add_light(sample->tile, sample->x, sample->y, sample->scene->lights.light[light].group, to, from);
}

static void add_by_length(struct pixel_sample *sample, double length, int light, rgb added)
{
    rgb until = sample->until, before = sample->before;
    if (gate_before(length, sample->tile->gate.end)) {
        sample->until = rgb_add(until, added);
        tell_light(sample, light, until, sample->until);
    }
    if (gate_before(length, sample->tile->gate.begin)) {
        sample->before = rgb_add(before, added);
        tell_light(sample, light, sample->before, before);
    }
}

/* Add a strategy's weighted share to the pixel; what it is made of is kept where pictures of single strategies are
 * wanted, or where somebody watches.
 *   light  the light sub-path whose first s vertices were joined; NULL for s <= 1 */
static void contribute(struct pixel_sample *sample, const struct connection *c, int s, int t,
                       const struct vertex *light, struct choice choice)
{
    rgb added = rgb_black();
    if (!rgb_is_black(c->value)) {
        rgb value = rgb_scale(c->value, choice.scale * sample->filter_weight);
        if (sample->tile->keep_records && gate_holds(sample->tile->gate, c->length))
            tile_record_eye(sample->tile, sample->x, sample->y, s, t + c->passed, value, c->weight, c->length);
        added = rgb_scale(value, c->weight);
        sample->sum = rgb_add(sample->sum, added);
        add_by_length(sample, c->length, s > 1 ? light->light : c->light, added);
    }
    if (sample->trace != NULL)
        trace_connect(sample->trace, s, t, light, c, choice.pmf, choice.scale * sample->filter_weight, added);
}

static void sum_direct(struct pixel_sample *sample, const struct vertex *z, int t)
{
    int n = z->eye_end == FIRST_HIT && sample->lights > 0 ? sample->lights : 1;
    const struct choice each = {1, 1.0 / n};
    for (int i = 0; i < n; i++) {
        struct connection c = connect_direct(sample->scene, sample->counts, z, &sample->sampler, i, n);
        contribute(sample, &c, 1, t, NULL, each);
    }
}

static void sum_hit(struct pixel_sample *sample, const struct vertex *eye, int t)
{
    struct connection c = connect_hit(sample->scene, sample->counts, &eye[t - 2], &eye[t - 1], t);
    if (sample->counts->caustics != NULL && !rgb_is_black(c.value))
        caustic_weigh_hit(sample->scene, sample->counts, sample->arena, eye, t, &c.weight);
    contribute(sample, &c, 0, t, NULL, NO_CHOICE);
}

static void sum_caustics(struct pixel_sample *sample, const struct vertex *z, int t)
{
    struct connection made[CAUSTIC_MOST];
    if (z->eye_end != FIRST_HIT || !vertex_connectible(z))
        return;
    int n = caustic_connect(sample->scene, sample->counts, sample->arena, z, t, &sample->sampler,
                            sample->max_depth + 1 - t, made);
    for (int i = 0; i < n; i++)
        contribute(sample, &made[i], 1, t, NULL, NO_CHOICE);
}

/* By a copy of the sampler: what other strategies draw is the same as without. */
static void sum_regularised(struct pixel_sample *sample, const struct vertex *eye, int t)
{
    struct sampler draws = sample->sampler;
    struct connection c = regularise_connect(sample->scene, sample->counts, eye, t, sample->eps, &draws);
    contribute(sample, &c, 1, t, NULL, NO_CHOICE);
}

void pixel_sum_eye(struct pixel_sample *sample, const struct vertex *eye, int n)
{
    for (int t = 2; t <= n; t++) {
        const struct vertex *z = &eye[t - 1];
        if (t == 2 || sample->counts->hit[LATER_HIT] > 0)
            sum_hit(sample, eye, t);
        bool wanted = sample->counts->direct[FIRST_HIT] > 0 && (t > 2 || sample->lights > 0);
        if (wanted && t <= sample->max_depth + 1 && z->kind == VERTEX_SURFACE) {
            sum_direct(sample, z, t);
            if (sample->eps > 0)
                sum_regularised(sample, eye, t);
        }
        if (sample->counts->caustics != NULL && z->kind == VERTEX_SURFACE)
            sum_caustics(sample, z, t);
    }
}

void pixel_sum_pair(struct pixel_sample *sample, const struct vertex *y, int s, const struct vertex *z, int t,
                    struct choice choice)
{
    struct connection c = connect_pair(sample->scene, sample->counts, y, z);
    contribute(sample, &c, s, t, y - (s - 1), choice);
}

void pixel_sum_joint(struct pixel_sample *sample, const struct joint *j, int s, int t, struct choice choice)
{
    struct connection c = connect_joint(sample->scene, sample->counts, j);
    contribute(sample, &c, s, t, j->y - (s - 1), choice);
}

void pixel_sum_connection(struct pixel_sample *sample, const struct connection *c, int s, int t, double scale)
{
    const struct choice choice = {1, scale};
    contribute(sample, c, s, t, NULL, choice);
}

void pixel_sum_pairs(struct pixel_sample *sample, const struct vertex *eye, int n_eye, const struct vertex *light,
                     int n_light, struct choice choice)
{
    if (sample->trace != NULL)
        trace_light_path(sample->trace, light, n_light);
    for (int t = 2; t <= n_eye; t++)
        for (int s = 2; s <= n_light && s + t <= sample->max_depth + 2; s++)
            pixel_sum_pair(sample, &light[s - 1], s, &eye[t - 1], t, choice);
}

static void offer(const struct pixel_sample *s, rgb value, int x, int y)
{
    const struct brought b = {rgb_luminance(value), s->x, s->y, s->iteration, x, y};
    worst_offer(s->worst, b);
}

static void offer_splat(const struct pixel_sample *sample, const struct splat *s)
{
    const struct tile *tile = sample->tile;
    struct pixel_rect range = splat_pixels(s, tile->filter, tile->film_rect);
    float part[3];
    for (int y = range.y0; y < range.y1; y++)
        for (int x = range.x0; x < range.x1; x++)
            if (splat_part(s, tile->filter, x, y, part))
                offer(sample, rgb_make((double)part[0], (double)part[1], (double)part[2]), x, y);
}

/* A light sub-path of s vertices arrives at every raster point that is the same ray. */
static void splat(struct pixel_sample *sample, const struct connection *c, int s, const struct vertex *light,
                  double scale)
{
    const double *radius = sample->scene->filter.radius;
    rgb added = rgb_scale(c->value, scale * c->weight);
    int group = sample->scene->lights.light[light->light].group;
    for (int i = 0; i < camera_images(&sample->scene->camera, radius); i++) {
        struct connection image = *c;
        camera_image(&sample->scene->camera, radius, i, &image.px, &image.py);
        if (tile_add_splat(sample->tile, image.px, image.py, added, c->length, group)) {
            tile_record_splat(sample->tile, s, rgb_scale(c->value, scale), c->weight, c->length);
            if (sample->worst != NULL)
                offer_splat(sample, &sample->tile->splat[sample->tile->n_splats - 1]);
        }
        if (sample->trace != NULL)
            trace_connect(sample->trace, s, 1, light, &image, 1, scale, added);
    }
}

void pixel_splat_path(struct pixel_sample *sample, const struct vertex *light, int n_light, double scale)
{
    double each = scale / sample->counts->splat;
    if (sample->trace != NULL)
        trace_light_path(sample->trace, light, n_light);
    for (int s = 2; s <= n_light && s <= sample->max_depth + 1; s++) {
        struct connection c = connect_lens(sample->scene, sample->counts, light, s, &sample->sampler);
        if (sample->counts->caustics != NULL && !rgb_is_black(c.value))
            caustic_weigh_lens(sample->scene, sample->counts, sample->arena, light, s, c.end, &c.weight);
        if (!rgb_is_black(c.value) && gate_holds(sample->tile->gate, c.length))
            splat(sample, &c, s, light, each);
        else if (sample->trace != NULL)
            trace_connect(sample->trace, s, 1, light, &c, 1, each, rgb_black());
    }
}

void pixel_sample_end(const struct pixel_sample *sample)
{
    tile_add_between(sample->tile, sample->x, sample->y, sample->until, sample->before);
    if (sample->worst != NULL)
        offer(sample, rgb_sub(sample->until, sample->before), sample->x, sample->y);
    if (sample->tile->planes.alpha)
        tile_add_alpha(sample->tile, sample->x, sample->y, sample->alpha);
}
