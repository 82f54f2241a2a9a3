/* cmd_render.c: asbdpt render: a scene to pictures; see cmd_render.h. */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/mem.h"
#include "base/os.h"
#include "cli/cmd_render.h"
#include "cli/command.h"
#include "image/image.h"
#include "render/render.h"

#define AT(member) offsetof(struct render_run, member)
const struct option RENDER_OPTIONS[] = {
    {"SCENE.pbrt", NULL, OPTION_TEXT, AT(of.job.scene_path), 1, .help = "a scene file; - reads standard input"},
    {"-o", "FILE", OPTION_TEXTS, AT(output), .alias = "--outfile", .written = true,
     .help = IMAGE_HELP " (default: the scene's Film name)", .list = image_list_written},
    TONE_ROWS,
    UNCLAMPED_ROW,
    {"--time", "TIME", OPTION_TIME, AT(checkpoint.time), 1e-9, 1e9,
     .help = "render for at most TIME, in seconds or as 90s, 5m, 1h, and write the image so far (default: no limit)"},
    {"--preview", "TIME", OPTION_TIME, AT(checkpoint.preview), 1e-9, 1e9,
     .help = "write the image so far to the first -o file after 1, 2, 4 ... seconds, then every TIME"},
    {"--checkpoint", "FILE", OPTION_TEXT, AT(checkpoint.file), .written = true,
     .help = "save the render in FILE at intervals, and when a signal stops it"},
    {"--interval", "TIME", OPTION_TIME, AT(checkpoint.interval), 0, 1e9, .fallback = "60",
     .help = "time between checkpoints in seconds"},
    {"--resume", "FILE", OPTION_TEXT, AT(checkpoint.resume), .help = "continue the render that a checkpoint holds"},
    {"--stats", "FILE", OPTION_TEXT, AT(stats_path), .written = true,
     .help = "write parameters, times and memory as JSON"},
    {"--aov", .kind = OPTION_ELSEWHERE, .help = "asbdpt-lab render has this option"},
    {"--layers", .kind = OPTION_ELSEWHERE, .help = "asbdpt-lab render has this option"},
    {"--seen", .kind = OPTION_ELSEWHERE, .help = "asbdpt-lab render has this option"},
    {"--lights", .kind = OPTION_ELSEWHERE, .help = "asbdpt-lab render has this option"},
    {"--alpha", .kind = OPTION_ELSEWHERE, .help = "asbdpt-lab render has this option"},
    {.others = LIMIT_OPTIONS},
};

/* The scene's Film filename, with .png in place of an extension this program does not write; never standard output. */
static char *default_output(const struct scene *scene)
{
    const char *name = scene->film_filename != NULL ? scene->film_filename : "asbdpt.png";
    size_t size = strlen(name) + 5;
    char *out = mem_alloc(size, 1);
    strcpy(out, name);
    if (!image_writable(out) || strcmp(out, "-") == 0) {
        const char *slash = os_last_separator(out);
        char *dot = strrchr(out, '.');
        if (dot != NULL && (slash == NULL || dot > slash))
            *dot = '\0';
        strcat(out, ".png");
    }
    return out;
}

static void abandon(struct render_run *r)
{
    outputs_abandon(&r->pictures);
    if (r->stats.stream != NULL)
        file_abandon(&r->stats);
}

/* What needs no scene to be opened. */
static bool open_named(struct render_run *r, struct error *err)
{
    if (r->of.job.samples[1] > 0 && r->output.n == 0)
        return error_usage(err, "--samples needs -o NAME.part");
    return checkpoint_check(&r->checkpoint, &r->of.job, err) &&
           (r->output.n == 0 || outputs_open(&r->output, &r->tone, true, &r->pictures, err)) &&
           (r->stats_path == NULL || file_create(r->stats_path, &r->stats, err));
}

static bool open_default_output(struct render_run *r, struct error *err)
{
    struct texts names = {0};
    char *name = default_output(&r->of.scene);
    texts_add(&names, name);
    bool ok = outputs_open(&names, &r->tone, false, &r->pictures, err);
    free(names.item);
    free(name);
    return ok;
}

/* Does every file have a name of its own? */
static bool names_differ(struct render_run *r, struct error *err)
{
    struct texts names = {0};
    options_written(RENDER_OPTIONS, r, &names);
    if (r->output.n == 0)
        texts_add(&names, r->pictures.item[0].file.path);
    bool ok = texts_differ(&names, err) && job_spares(&r->of.scene, &names, err);
    free(names.item);
    return ok;
}

/* What the scene names, once it is loaded. */
static bool open_others(struct render_run *r, struct error *err)
{
    return (r->pictures.n > 0 || open_default_output(r, err)) &&
           (r->checkpoint.preview == 0 || outputs_previews(&r->pictures, err)) && names_differ(r, err);
}

int render_open(struct render_run *r)
{
    struct error err;
    if (!open_named(r, &err))
        return render_close(r, false, &err);
    if (!state_open(&r->of, &err)) {
        abandon(r);
        return job_failed(&err);
    }
    return open_others(r, &err) ? EXIT_OK : render_close(r, false, &err);
}

/* The last line. Who has not chosen a method may not know which the scene has. */
static void report(const struct render_run *r)
{
    const struct film *film = &r->of.film;
    long n = r->of.scene.n_warnings;
    bool other = r->of.job.integrator_name == NULL && strcmp(r->of.job.integrator->name, "asbdpt") != 0;
    char warnings[48] = "";
    if (n > 0)
        snprintf(warnings, sizeof warnings, "; %ld warning%s about the scene", n, n > 1 ? "s" : "");
    if (!r->of.job.quiet)
        say_line("%s: %dx%d, %ld spp, %s%s; %.2f s, %.2f s of CPU: %.2f us per sample path%s", r->of.job.scene_path,
                 rect_width(film->rect), rect_height(film->rect), film->iterations, r->of.job.integrator->name,
                 other ? " (for asbdpt: --integrator asbdpt)" : "", r->of.wall, r->of.cpu, stats_us_per_path(&r->of), warnings);
}

/* What the camera sees in front of all else, as far as a few rays tell. */
static void describe_view(const struct scene *scene, struct pixel_rect r, char *text, size_t size)
{
    enum { RAYS = 32 }; /* on each axis */
    double nearest = INFINITY;
    snprintf(text, size, "it sees no surface");
    for (int i = 0; i < RAYS * RAYS; i++) {
        double x = (i % RAYS + 0.5) / RAYS, y = (i / RAYS + 0.5) / RAYS;
        struct ray ray = camera_ray(&scene->camera, r.x0 + x * rect_width(r), r.y0 + y * rect_height(r), 0.5, 0.5);
        struct surface at;
        double d = scene_intersect(scene, &ray, &at) ? length(sub(at.p, ray.o)) : INFINITY;
        vec3 p = add(at.p, scene->origin);
        if (d < nearest)
            snprintf(text, size, "the nearest surface that it sees is at (%g %g %g), %.3g away%s", p.x, p.y, p.z, d,
                     dot(at.ng, ray.d) > 0 ? ", and faces away" : "");
        nearest = fmin(d, nearest);
    }
}

/* The radiance that all light of the scene has if it is spread over its sphere in all directions, as a sky's is. */
static double mean_radiance(const struct light_set *lights)
{
    double watts = 0;
    for (int i = 0; i < lights->n; i++)
        watts += light_watts(&lights->light[i]);
    return watts / (4 * sqr(PI * lights->radius));
}

/* A picture without any light is rarely what was wanted. What is below the mean light of the scene by more than the
 * rounding of a float, 2^-24, is none: vertices are floats, so that connections along a surface may pass through it. */
static void warn_of_black(const struct scene *scene, const struct film *film, const char *integrator,
                          const float *pixels)
{
    const double faint = scene->film_scale * mean_radiance(&scene->lights) * 0x1p-24;
    double most = 0;
    char why[300] = "the scene has no light", view[200], largest[64] = "";
    for (size_t i = 0; i < rect_pixels(film->rect) * 3; i++) {
        if (!(fabs((double)pixels[i]) <= faint))
            return;
        most = fmax(most, fabs((double)pixels[i]));
    }
    if (most > 0)
        snprintf(largest, sizeof largest, " (no value is above %.2g)", most);
    describe_view(scene, film->rect, view, sizeof view);
    if (film_samples(film) == 0)
        snprintf(why, sizeof why, "no sample is complete");
    else if (scene->lights.n > 0)
        snprintf(why, sizeof why, "no light has reached the camera by %s%s; %s", integrator, largest, view);
    say_line("asbdpt: warning: the image is black: %s", why);
}

static bool write_pictures(struct render_run *r, bool ok, struct error *err)
{
    const struct film *film = &r->of.film;
    float *pixels = mem_alloc(rect_pixels(film->rect) * 3, sizeof *pixels);
    film_warn(film, outputs_develop(&r->pictures, pixels));
    warn_of_black(&r->of.scene, film, r->of.job.integrator->name, pixels);
    ok = outputs_write(&r->pictures, rect_width(film->rect), rect_height(film->rect), pixels, r->of.job.quiet,
                       ok ? err : NULL) && ok;
    free(pixels);
    return ok;
}

static void write_stats(struct render_run *r)
{
    struct texts files = {0};
    struct growing text = {0};
    for (int i = 0; i < r->pictures.n; i++)
        texts_add(&files, r->pictures.item[i].file.path);
    stats_add(&text, &r->of, &files, r->checkpoint.file);
    fputs(text.text, r->stats.stream);
    free(text.text);
    free(files.item);
}

/* From a film with nothing or something in it to all files. */
bool render_work(struct render_run *r, struct error *err)
{
    r->pictures.place = r->of.part.place;
    r->pictures.part = &r->of.part;
    r->pictures.film = &r->of.film;
    r->pictures.unclamped = r->unclamped;
    if (!checkpoint_begin(&r->checkpoint, &r->of, &r->pictures, err))
        return false;
    r->of.progress = checkpoint_progress;
    r->of.cancel = checkpoint_cancel;
    r->of.context = &r->checkpoint;
    bool ok = state_render(&r->of, 0, err), kept = checkpoint_end(&r->checkpoint, ok, err);
    if (!ok)
        return false;
    if (r->stats.stream != NULL)
        write_stats(r);
    ok = write_pictures(r, kept, err);
    report(r);
    return ok;
}

int render_close(struct render_run *r, bool ok, struct error *err)
{
    if (ok && r->stats.stream != NULL)
        ok = file_commit(&r->stats, err);
    abandon(r);
    state_free(&r->of);
    return !ok ? fail(err) : interrupt_caught() != 0 ? 128 + interrupt_caught() : EXIT_OK;
}

static int run(void *options)
{
    struct error err;
    int status = render_open(options);
    return status == EXIT_OK ? render_close(options, render_work(options, &err), &err) : status;
}

const struct command command_render = {
    "render", "render a scene to images", {"SCENE.pbrt [-o FILE]... [options]"}, RENDER_OPTIONS,
    sizeof(struct render_run), run, false,
    "render scenes/veach-ajar.pbrt --quick --spp 16 -o out/ajar.png"};
