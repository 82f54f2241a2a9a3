/* timed.c: see timed.h. */
#include "lab/timed.h"

#include <math.h>

#include "base/mem.h"
#include "base/os.h"
#include "lab/methods.h"

bool timed_film(const struct scene *scene, const struct render_job *o, struct film *film, struct timed *out,
                struct error *err)
{
    double cpu = os_cpu_seconds(), wall = os_wall_seconds();
    bool ok = render_by(scene, o, film, err);
    out->seconds += fmax(os_cpu_seconds() - cpu, 1e-6);
    out->wall += fmax(os_wall_seconds() - wall, 1e-6);
    out->nonfinite = film->nonfinite;
    return ok;
}

float *timed_develop(const struct scene *scene, const struct film *film)
{
    float *pixels = mem_alloc((size_t)rect_width(film->rect) * (size_t)rect_height(film->rect) * 3, sizeof *pixels);
    film_develop(film, scene->film_scale, pixels);
    return pixels;
}

bool timed_render(const struct scene *scene, const struct render_job *o, struct timed *out, struct error *err)
{
    struct film film;
    struct timed none = {0};
    *out = none;
    film_init(&film, render_crop(scene), scene->width, scene->height);
    bool ok = timed_film(scene, o, &film, out, err);
    if (ok)
        out->pixels = timed_develop(scene, &film);
    film_free(&film);
    return ok;
}

bool timed_prepare(const struct scene *scene, const struct render_job *o, double *seconds, int *block,
                   struct error *err)
{
    struct render_job job = {.scene = NULL};
    struct prepared prepared;
    double start = os_cpu_seconds();
    if (!render_prepare(scene, o, render_crop(scene), &job, &prepared, err))
        return false;
    *block = prepared.size.block;
    method_release(&prepared);
    *seconds = os_cpu_seconds() - start;
    return true;
}
