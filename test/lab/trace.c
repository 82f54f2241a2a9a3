/* trace.c: see trace.h. */
#include "lab/trace.h"

#include <stdlib.h>
#include <string.h>

#include "caustics/derived.h"
#include "integrators/prepare.h"
#include "lab/methods.h"
#include "tables/emission.h"

static void free_path(struct trace_path *path)
{
    free(path->vertex);
    free(path->pdf_rev);
}

void trace_free(struct trace *trace)
{
    for (int i = 0; i < trace->n_lights; i++)
        free_path(&trace->light[i]);
    free_path(&trace->eye);
    free(trace->light);
    free(trace->connection);
    memset(trace, 0, sizeof *trace);
}

/* Copy the vertices that are not there yet. */
static void copy(struct trace_path *to, const struct vertex *path, int n, enum transport mode)
{
    to->source = path;
    to->vertex = mem_grow(to->vertex, &to->capacity, (size_t)n, sizeof *to->vertex);
    to->pdf_rev = mem_grow(to->pdf_rev, &to->pdf_capacity, (size_t)n, sizeof *to->pdf_rev);
    for (; to->n < n; to->n++) {
        if (to->n > 0)
            to->pdf_rev[to->n - 1] = vertex_pdf_rev(&path[to->n - 1], &path[to->n], mode);
        to->vertex[to->n] = path[to->n];
        to->vertex[to->n].bsdf.lobe = NULL;
        to->vertex[to->n].lamp = NULL;
    }
}

/* The number of a light sub-path, of which so many vertices are known by now. */
static int light_path(struct trace *trace, const struct vertex *path, int n)
{
    int i = 0;
    while (i < trace->n_lights && trace->light[i].source != path)
        i++;
    if (i == trace->n_lights) {
        struct trace_path empty = {.n = 0};
        trace->light = mem_grow(trace->light, &trace->light_capacity, (size_t)i + 1, sizeof *trace->light);
        trace->light[trace->n_lights++] = empty;
    }
    copy(&trace->light[i], path, n, IMPORTANCE);
    return i;
}

static bool watches(const struct trace *trace, const struct sample *sample)
{
    return trace->x == sample->x && trace->y == sample->y && trace->iteration == sample->iteration;
}

static void walked(void *context, const struct sample *sample, enum transport mode, const struct vertex *path,
                   int n)
{
    struct trace *trace = context;
    if (!watches(trace, sample))
        return;
    if (mode == IMPORTANCE) {
        trace->lens = sample->sampler;
        light_path(trace, path, n);
        return;
    }
    trace->filter_weight = sample->filter_weight;
    copy(&trace->eye, path, n, RADIANCE);
}

/* The point of the lens: one was drawn for each s from 2 on. */
static vec3 lens_end(const struct trace *trace, const struct camera *camera, const struct joined *p)
{
    struct sampler sampler = trace->lens;
    double u[2];
    for (int s = 2; s < p->s && camera->lens_radius > 0; s++)
        sampler_pair(&sampler, DRAW_LENS_POINT, u);
    return lens_drawn(camera, p->path[p->s - 1].p, sampler);
}

static vec3 end_of(const struct trace *trace, const struct scene *scene, const struct joined *p)
{
    if (p->t == 1)
        return lens_end(trace, &scene->camera, p);
    if (p->s != 1 || p->path == NULL)
        return vec(0, 0, 0);
    return vertex_at_infinity(scene, p->path) ? p->path->wo : p->path->p;
}

/* As connect_vertices makes a value and a weight, without media and what is infinitely far. */
static struct trace_weight weigh(const struct sample *sample, const struct joined *p)
{
    struct trace_weight of = {.n = 0};
    const struct scene *scene = sample->pass->job->scene;
    const struct vertex *y = p->s > 0 && p->path != NULL ? &p->path[p->s - 1] : NULL, *z = p->z;
    if (y == NULL || z == NULL || scene->space != NULL || vertex_at_infinity(scene, y) || rgb_is_black(p->c->value))
        return of;
    const bool light = y->kind == VERTEX_LIGHT;
    const vec3 d = sub(y->p, z->p), w = normalize(d), back = neg(w);
    const double falloff = 1 / length2(d);
    struct bsdf_value at_z = bsdf_eval(&z->bsdf, z->wo, w, RADIANCE), at_y = {.f = {1, 1, 1}, .pdf = 0};
    if (light) {
        const struct light_point at = vertex_light_point(scene, y);
        at_y.pdf = emission_pdf(&sample->pass->counts->tables->emission, &scene->lights, &at, z->p, back);
    } else
        at_y = bsdf_eval(&y->bsdf, y->wo, back, IMPORTANCE);
    of = (struct trace_weight){.f_y = at_y.f, .f_z = at_z.f, .distance = length(d), .n = n_of(sample->pass->counts, y, z)};
    of.cos_y = light ? vertex_cosine(y, back) : scatter_cosine(y, back, IMPORTANCE);
    of.cos_z = scatter_cosine(z, w, RADIANCE);
    of.R_y = at_z.pdf * vertex_cosine(y, w) * falloff;
    of.R_z = at_y.pdf * vertex_cosine(z, w) * falloff;
    of.light_side = mis_side(of.R_y, y->pdf_fwd, y->mis_c, light ? 0 : at_y.pdf_rev, y->mis);
    of.eye_side = mis_side(of.R_z, z->pdf_fwd, z->mis_c, at_z.pdf_rev, z->mis);
    return of;
}

static void joined(void *context, const struct sample *sample, const struct joined *p)
{
    struct trace *trace = context;
    if (!watches(trace, sample))
        return;
    int light = p->s > 1 ? light_path(trace, p->path, p->s) : -1;
    const struct scene *scene = sample->pass->job->scene;
    struct trace_connection made = {p->s, p->t, light, p->pmf, *p->c, p->px, p->py, end_of(trace, scene, p), p->scale,
                                    p->added, weigh(sample, p)};
    trace->n_pool = sample->pass->work->pool.n;
    size_t n = (size_t)trace->n_connections + 1;
    trace->connection = mem_grow(trace->connection, &trace->connection_capacity, n, sizeof *trace->connection);
    trace->connection[trace->n_connections++] = made;
}

rgb trace_sum(const struct trace *trace)
{
    rgb sum = rgb_black();
    for (int i = 0; i < trace->n_connections; i++)
        if (trace->connection[i].t > 1)
            sum = rgb_add(sum, trace->connection[i].added);
    return sum;
}

/* The walk from the other end leaves vertex i+1 towards i; what it is per steradian there was found on the way. */
double trace_pdf_rev(const struct scene *scene, const struct trace_path *path, int i)
{
    if (i + 2 >= path->n || path->vertex[i].kind == VERTEX_LENS)
        return -1;
    const struct vertex *v = &path->vertex[i], *next = &path->vertex[i + 1];
    if (vertex_at_infinity(scene, v))
        return path->pdf_rev[i + 1];
    double falloff = next->kind == VERTEX_ESCAPED ? 1 : 1 / length2(sub(v->p, next->p));
    return path->pdf_rev[i + 1] * vertex_cosine(v, next->wo) * falloff;
}

/* --- rendering --------------------------------------------------------------------------------------- */

static bool check_sample(const struct render_job *o, struct pixel_rect film, const struct trace *t,
                         struct error *err)
{
    if (t->x < film.x0 || t->x >= film.x1 || t->y < film.y0 || t->y >= film.y1)
        return error_usage(err, "--pixel %d,%d is not rendered: x is %d to %d here, y is %d to %d", t->x, t->y, film.x0,
                         film.x1 - 1, film.y0, film.y1 - 1);
    return (t->iteration >= TRACE_BRIGHTEST && t->iteration < o->end) ||
           error_usage(err, "--sample %ld is not taken: they are numbered 0 to %ld, see --spp", t->iteration,
                     o->end - 1);
}

static bool pixels_have(struct tile_pixels p, int x, int y)
{
    int i = pixels_cell(p, x, y), has_x, has_y;
    return i >= 0 && pixels_get(p, i, &has_x, &has_y) && x == has_x && y == has_y;
}

/* A tile pass, of iterations `first` to below `end`. */
static void observe_tile(const struct render_job *job, const struct prepared *prepared, struct tile_pixels pixels,
                         long first, long end, const struct observer *observer)
{
    struct tile tile = {.sum = NULL};
    struct workspace *work = workspaces_new(1, job->max_depth);
    struct tile_pass pass = {.job = job, .counts = &prepared->counts, .first = first, .end = end, .tile = &tile,
                             .work = work, .observer = observer, .ends_at = CANCEL_NOW};
    tile_start(&tile, pixels, job->film_rect, &job->scene->filter);
    prepared->method->render(prepared, &pass);
    tile_free(&tile);
    workspaces_free(work, 1);
}

/* That which holds the pixel. */
static void observe(const struct render_job *job, const struct prepared *prepared, const struct trace *trace,
                    long first, long end, const struct observer *observer)
{
    const struct tiling tiling = tiling_of(job->film_rect, &prepared->size);
    int64_t number = 0;
    while (!pixels_have(tiling_pixels(&tiling, number), trace->x, trace->y))
        number++;
    observe_tile(job, prepared, tiling_pixels(&tiling, number), first, end, observer);
}

/* Where light that is joined to the lens arrives in the pixel, as the film spreads it. */
static void splat(void *context, const struct sample *sample, const struct joined *p)
{
    struct trace *trace = context;
    const struct filter *filter = &sample->pass->job->scene->filter;
    const struct splat s = {p->px, p->py, p->added};
    float part[3];
    if (p->t != 1 || rgb_is_black(p->added) || sample->iteration != trace->iteration)
        return;
    const struct pixel_rect pixel = {trace->x, trace->y, trace->x + 1, trace->y + 1};
    struct pixel_rect in = splat_pixels(&s, filter, pixel);
    if (in.x1 <= in.x0 || in.y1 <= in.y0 || !splat_part(&s, filter, trace->x, trace->y, part))
        return;
    trace->splats = rgb_add(trace->splats, rgb_make((double)part[0], (double)part[1], (double)part[2]));
    trace->n_splats++;
}

static void find_splats(const struct render_job *job, const struct prepared *prepared, struct trace *trace, long first)
{
    const struct observer observer = {.context = trace, .joined = splat};
    const struct tiling tiling = tiling_of(job->film_rect, &prepared->size);
    for (int64_t i = 0; i < tiling_count(&tiling); i++)
        observe_tile(job, prepared, tiling_pixels(&tiling, i), first, trace->iteration + 1, &observer);
}

/* From where what the sample depends on begins: in blocks of a length that the integrator has chosen one iteration
 * builds on another. */
void trace_sample(const struct render_job *job, const struct prepared *prepared, struct trace *trace)
{
    const struct observer observer = {.context = trace, .walked = walked, .joined = joined};
    long block = prepared->size.block > 0 ? prepared->size.block : 1;
    long first = trace->iteration / block * block;
    observe(job, prepared, trace, first, trace->iteration + 1, &observer);
    if (trace->wants_splats)
        find_splats(job, prepared, trace, first);
    bool chooses = prepared->method->build == NULL || prepared->numbers.path_pixels > 0;
    trace->why = chooses ? method_why(prepared->method) : NULL;
    trace->race = race_result(prepared);
    chosen_numbers(prepared, trace->number);
}

/* The sample that contributes most to the pixel. */
struct brightest {
    const struct trace *trace;
    rgb sum; /* so far, of the sample that is summed */
    long summed;
    double luminance;
    long iteration;
};

/* Nothing that is added is negative, so the last sum of a sample is its brightest. */
static void add_path(void *context, const struct sample *sample, const struct joined *path)
{
    struct brightest *b = context;
    if (b->trace->x != sample->x || b->trace->y != sample->y || path->t < 2)
        return;
    b->sum = b->summed == sample->iteration ? rgb_add(b->sum, path->added) : path->added;
    b->summed = sample->iteration;
    if (rgb_luminance(b->sum) > b->luminance) {
        b->luminance = rgb_luminance(b->sum);
        b->iteration = sample->iteration;
    }
}

static long find_brightest(const struct render_job *job, const struct prepared *prepared, const struct trace *trace,
                           long end)
{
    struct brightest found = {.trace = trace, .summed = -1};
    const struct observer observer = {.context = &found, .joined = add_path};
    long block = prepared->size.block > 0 ? prepared->size.block : end;
    for (long first = 0; first < end; first += block)
        observe(job, prepared, trace, first, first + block < end ? first + block : end, &observer);
    return found.iteration;
}

bool trace_render(const struct scene *scene, const struct render_job *options, struct trace *trace,
                  struct error *err)
{
    struct pixel_rect film = render_crop(scene);
    struct render_job job = {.scene = NULL};
    struct prepared prepared;
    if (!method_observable(options->integrator, err) || !check_sample(options, film, trace, err) ||
        !render_prepare(scene, options, film, &job, &prepared, err))
        return false;
    if (trace->iteration == TRACE_BRIGHTEST)
        trace->iteration = find_brightest(&job, &prepared, trace, options->end);
    trace_sample(&job, &prepared, trace);
    method_release(&prepared);
    return true;
}
