/* timed.c: see timed.h. */
#include "lab/timed.h"

#include <math.h>
#include <stdlib.h>

#include "base/mem.h"
#include "base/os.h"
#include "image/zlib.h"

bool timed_film(const struct scene *scene, const struct render_options *o, struct film *film, struct timed *out,
                struct error *err)
{
    double cpu = os_cpu_seconds(), wall = os_wall_seconds();
    bool ok = render_scene(scene, o, film, err);
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

bool timed_render(const struct scene *scene, const struct render_options *o, struct timed *out, struct error *err)
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

unsigned long timed_checksum(const float *pixels, int width, int height)
{
    return checksum_crc32(0, (const uint8_t *)pixels, (size_t)width * (size_t)height * 3 * sizeof *pixels);
}

unsigned long timed_probe(const struct scene *scene, const struct render_options *o)
{
    struct render_options first = *o;
    struct timed picture;
    unsigned long crc = 0;
    first.seed = 0;
    first.first = 0;
    first.end = 1;
    if (timed_render(scene, &first, &picture, NULL)) {
        crc = timed_checksum(picture.pixels, scene->width, scene->height);
        free(picture.pixels);
    }
    return crc;
}
