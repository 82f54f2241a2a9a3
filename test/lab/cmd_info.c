/* cmd_info.c: asbdpt-lab info: what is in a scene and how it was prepared, or what is in a picture. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/os.h"
#include "library/job_options.h"
#include "image/image.h"
#include "integrators/prepare.h"
#include "lab/methods.h"
#include "lab/commands.h"
#include "lab/race_table.h"
#include "lab/tree.h"

static void print_lights(const struct light_set *lights)
{
    enum { SHOWN = 16 };
    double total = 0;
    for (int i = 0; i < lights->n; i++)
        total += light_watts(&lights->light[i]);
    printf("lights        %d\n", lights->n);
    for (int i = 0; i < lights->n && i < SHOWN; i++)
        printf("  %-11s power %.4g W (%.1f %%)\n", LIGHT_KINDS[lights->light[i].kind], light_watts(&lights->light[i]),
               total > 0 ? 100 * light_watts(&lights->light[i]) / total : 0);
    if (lights->n > SHOWN)
        printf("  and %d more\n", lights->n - SHOWN);
}

static void print_scene(const struct scene *s, const struct method *m, double seconds)
{
    struct pixel_rect crop = render_crop(s);
    printf("film          %dx%d, crop [%d,%d) x [%d,%d)\n", s->width, s->height, crop.x0, crop.x1, crop.y0, crop.y1);
    static const char *const KINDS[] = {"perspective", "orthographic", "environment"};
    vec3 lo, hi, at = add(s->camera.position, s->origin);
    printf("camera        %s, fov %g degrees, lens radius %g, at (%g, %g, %g)\n", KINDS[s->camera.kind],
           s->camera.kind == CAMERA_PERSPECTIVE ? s->camera.fov : 0, s->camera.lens_radius,
           at.x, at.y, at.z);
    printf("integrator    %s\n", m->name);
    for (int i = 0; i < s->settings.n; i++) {
        struct error line; /* cleaned, as the file's words are */
        error_set(&line, "  %-11s %s", s->settings.item[i].name, s->settings.item[i].value);
        printf("%s\n", line.text);
    }
    printf("triangles     %d (%d vertices)\nquadrics      %d\ncurves        %d\nshapes        %d\n", s->geo.n_triangles,
           s->geo.n_vertices, s->geo.n_quadrics, s->geo.curves.n, s->geo.n_groups);
    printf("materials     %d\ntextures      %d (%d images)\n", s->n_materials, s->textures.n_textures,
           s->textures.n_images);
    print_lights(&s->lights);
    scene_bounds(s, &lo, &hi);
    lo = add(lo, s->origin);
    hi = add(hi, s->origin);
    printf("bounds        (%g, %g, %g) to (%g, %g, %g)\n", lo.x, lo.y, lo.z, hi.x, hi.y, hi.z);
    const struct tree_figures tree = tree_figures(&s->kd);
    printf("kd-tree       %d nodes, %zu references, depth %d, expected cost %.1f\n", s->kd.n_nodes, tree.references,
           tree.depth, tree.cost);
    printf("loaded in     %.2f s\n", seconds);
}

/* --- pictures ------------------------------------------------------------------------------------------ */

/* Least, largest, mean of the finite values of a channel, and how many the others are. */
static void print_channel(const float *value, int channel, long pixels)
{
    double least = INFINITY, most = -INFINITY, sum = 0;
    long n = 0;
    for (long i = 0; i < pixels; i++) {
        double v = (double)value[3 * i + channel];
        if (!isfinite(v))
            continue;
        least = fmin(least, v);
        most = fmax(most, v);
        sum += v;
        n++;
    }
    printf("%-13c ", "RGB"[channel]);
    if (n > 0)
        printf("%.6g to %.6g, mean %.6g%s", least, most, sum / (double)n, n < pixels ? "; " : "\n");
    if (n < pixels)
        printf("%ld NaN or infinite\n", pixels - n);
}

/* The format's, if it is the name of a picture; else NULL. */
static const char *extension(const char *path, char known[IMAGE_LIST_TEXT])
{
    image_list_read(known);
    for (char *name = strtok(known, " "); name != NULL; name = strtok(NULL, " "))
        if (file_has_extension(path, name))
            return name;
    return NULL;
}

static bool print_picture(const char *path, const char *format, struct error *err)
{
    int width, height;
    struct image about;
    float *value = image_read_linear(path, &width, &height, &about, err);
    if (value == NULL)
        return false;
    printf("format        %s, %s\nsize          %dx%d\nchannels      %s\n", format,
           about.linear ? "linear" : "sRGB, here made linear", width, height,
           about.channels == 1 ? "1, grey" : "3, RGB");
    for (int c = 0; c < 3; c++)
        print_channel(value, c, (long)width * height);
    free(value);
    return true;
}

/* --- the command --------------------------------------------------------------------------------------- */

struct info_options {
    struct render_job job;
    bool race;
};

/* By asbdpt, unless another integrator was named. */
static bool print_race(struct render_job *job, struct prepared *p, struct error *err)
{
    if (method_has(job->integrator, "race") == NULL)
        return error_usage(err, "--race: %s has no race; select=subspaces of asbdpt has",
                           job->integrator->name);
    job_prepare(job, p);
    const struct race_result result = race_result(p);
    race_print_table(stdout, &result);
    return true;
}

static int run(void *options)
{
    struct info_options *info = options;
    struct render_job *o = &info->job;
    struct scene scene;
    struct prepared prepared;
    double start = os_wall_seconds();
    struct error err;
    char known[IMAGE_LIST_TEXT];
    const char *format = extension(o->scene_path, known);
    if (format != NULL)
        return print_picture(o->scene_path, format, &err) ? EXIT_OK : fail(&err);
    if (info->race && o->integrator_name == NULL)
        o->integrator_name = "asbdpt";
    int status = load_job(o, &scene, &prepared);
    if (status != EXIT_OK)
        return status;
    print_scene(&scene, o->integrator, os_wall_seconds() - start);
    bool ok = !info->race || print_race(o, &prepared, &err);
    method_release(&prepared);
    scene_free(&scene);
    return ok ? EXIT_OK : fail(&err);
}

static const struct option OPTIONS[] = {
    {"FILE", NULL, OPTION_TEXT, offsetof(struct info_options, job.scene_path), 1, .help = "a scene file, or a picture"},
    {"--race", NULL, OPTION_ON, offsetof(struct info_options, race),
     .help = "also what the race before a render predicts, by asbdpt unless --integrator names another"},
    {.others = RUN_OPTIONS},
};

const struct command command_info = {
    "info", "describe a scene, or a picture", {"SCENE.pbrt [options]", "PICTURE"}, OPTIONS,
    sizeof(struct info_options), run, true, "info scenes/bathroom.pbrt"};
