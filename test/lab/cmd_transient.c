/* cmd_transient.c: asbdpt-lab transient: light in flight: a picture for each of some gates that follow each other
 * (paths.h), all from one render, and a contact sheet. */
#include <stdio.h>
#include <stdlib.h>

#include "base/mem.h"
#include "base/number.h"
#include "library/job_options.h"
#include "image/image.h"
#include "lab/bar.h"
#include "lab/compare.h"
#include "lab/files.h"
#include "lab/commands.h"
#include "lab/paths.h"
#include "lab/sheet.h"

struct transient_options {
    struct render_job job;
    const char *directory;
    double range[2]; /* 0, 0: across the scene */
    int n;
};

#define AT(member) offsetof(struct transient_options, member)
static const struct option OPTIONS[] = {
    {"SCENE.pbrt", NULL, OPTION_TEXT, AT(job.scene_path), 1, .help = "a scene file"},
    {"-o", "DIR", OPTION_TEXT, AT(directory), 1, .help = "a directory for gate000.pfm ... and transient.png"},
    {"--gates", "N", OPTION_INTEGER, AT(n), 1, 256, .fallback = "16", .help = "how many pictures"},
    {"--gate", "L0:L1", OPTION_LENGTHS, AT(range), 0, 1e30,
     .help = "path lengths that they divide (default: from 0 to the way across the scene and back)"},
    {.others = RUN_OPTIONS},
};

/* One render by all gates. Pictures, [gates.n][pixels*3], to be freed; NULL with a message. */
static float *render(const struct scene *scene, const struct render_job *o, struct gates gates, struct error *err)
{
    struct film film;
    size_t n = 3 * rect_pixels(render_crop(scene)) * (size_t)gates.n;
    float *out = NULL;
    film_init(&film, render_crop(scene), scene->width, scene->height);
    double *sum = mem_alloc(n, sizeof *sum);
    if (gates_render(scene, o, &gates, &film, sum, err)) {
        out = mem_alloc(n, sizeof *out);
        for (size_t i = 0; i < n; i++)
            out[i] = float_within(sum[i] * scene->film_scale / (double)film.iterations);
    }
    free(sum);
    film_free(&film);
    return out;
}

static void choose_range(const struct scene *scene, struct gates *out)
{
    const struct light_set *l = &scene->lights;
    out->begin = 0;
    out->width = 2 * (l->radius + length(sub(scene->camera.position, l->center))) / out->n;
}

/* A file for each picture, and a sheet of all in rows of four, by one exposure. */
static bool write_all(const char *directory, struct gates g, const float *pixels, int w, int h, struct error *err)
{
    enum { COLUMNS = 4, CELL = 240, GAP = 8, LABEL = 20, HEAD = 24, PERCENTILE = 99 };
    size_t n = 3 * (size_t)w * (size_t)h;
    double white = fmax(picture_percentile(pixels, (long)n * g.n, PERCENTILE), 1e-30);
    int shrink = int_within(w / CELL, 1, h), k = int_within(CELL / w, 1, CELL);
    int width = w / shrink * k + GAP, height = h / shrink * k + GAP + LABEL;
    char text[4096];
    struct sheet sheet;
    sheet_init(&sheet, COLUMNS * width + GAP, HEAD + (g.n + COLUMNS - 1) / COLUMNS * height + GAP, SHEET_PAPER);
    snprintf(text, sizeof text, "length of paths from light to camera, in units of the scene; white: %.3g", white);
    sheet_text(&sheet, GAP, GAP, 2, SHEET_INK, text);
    bool ok = true;
    for (int i = 0; ok && i < g.n; i++, pixels += n) {
        int x = GAP + i % COLUMNS * width, y = HEAD + GAP + i / COLUMNS * height;
        snprintf(text, sizeof text, "%.4g to %.4g", g.begin + i * g.width, g.begin + (i + 1) * g.width);
        sheet_text(&sheet, x, y, 2, SHEET_INK, text);
        sheet_cell(&sheet, x, y + LABEL, pixels, w, h, shrink, k, 1 / white);
        snprintf(text, sizeof text, "%s/gate%03d.pfm", directory, i);
        ok = image_write(text, w, h, pixels, err);
    }
    if (ok)
        return sheet_write(&sheet, directory, "transient.png", err);
    sheet_free(&sheet);
    return false;
}

static int run(void *options)
{
    struct transient_options *o = options;
    struct gates gates = {o->range[0], (o->range[1] - o->range[0]) / o->n, o->n};
    struct scene scene;
    struct prepared prepared;
    struct bar bar;
    struct error err;
    int status = load_job(&o->job, &scene, &prepared);
    if (status != EXIT_OK)
        return status;
    bar_start(&bar, o->job.quiet);
    bar_follow(&bar, 1, &o->job);
    struct pixel_rect r = render_crop(&scene);
    if (!(o->range[1] > 0))
        choose_range(&scene, &gates);
    bool ok = file_make_directory(o->directory, &err);
    float *pictures = ok ? render(&scene, &o->job, gates, &err) : NULL;
    ok = pictures != NULL && write_all(o->directory, gates, pictures, rect_width(r), rect_height(r), &err);
    bar_clear(&bar);
    free(pictures);
    method_release(&prepared);
    scene_free(&scene);
    if (ok && !o->job.quiet)
        say_line("wrote %d pictures, and transient.png, into %s", gates.n, o->directory);
    return ok ? EXIT_OK : fail(&err);
}

const struct command command_transient = {
    "transient", "light in flight: pictures by how far light has come", {"SCENE.pbrt -o DIR [options]"}, OPTIONS,
    sizeof(struct transient_options), run, false, "transient scenes/cornell-box.pbrt --quick --spp 64 -o out/flight"};
