/* cmd_strategies.c: asbdpt-lab strategies: a picture of every strategy (s,t) alone, unweighted and weighted, all from
 * one render, and all of them on one sheet. */
#include <stdio.h>

#include "library/job_options.h"
#include "lab/bar.h"
#include "lab/files.h"
#include "lab/commands.h"
#include "lab/strategies.h"
#include "lab/sheet.h"
#include "render/job.h"

/* Two pictures of each: (d + 1) (d + 4) for paths of up to d + 1 edges. */
enum { STRATEGIES_MAX_DEPTH = 20 };

struct strategies_options {
    struct render_job job;
    const char *directory;
};

#define AT(member) offsetof(struct strategies_options, member)
static const struct option OPTIONS[] = {
    {"SCENE.pbrt", NULL, OPTION_TEXT, AT(job.scene_path), 1, .help = "a scene file"},
    {"-o", "DIR", OPTION_TEXT, AT(directory), 1,
     .help = "a directory for d01_s00_t03_weighted.pfm and so on, and pyramid.png"},
    {.others = RUN_OPTIONS},
};

static bool write_picture(const char *directory, const struct strategy_images *images, double scale, int s, int t,
                          bool weighted, struct error *err)
{
    char name[64];
    struct sheet picture = {rect_width(images->rect), rect_height(images->rect),
                            strategies_picture(images, scale, s, t, weighted)};
    snprintf(name, sizeof name, "d%02d_s%02d_t%02d_%s.pfm", s + t - 2, s, t, weighted ? "weighted" : "unweighted");
    return sheet_write(&picture, directory, name, err);
}

static bool write_all(const char *directory, const struct strategy_images *images, double scale, struct error *err)
{
    bool ok = true;
    for (int edges = 1; edges <= images->max_depth + 1; edges++)
        for (int s = 0; ok && s <= edges; s++)
            ok = write_picture(directory, images, scale, s, edges + 1 - s, false, err) &&
                 write_picture(directory, images, scale, s, edges + 1 - s, true, err);
    return ok && pyramid_write(directory, images, scale, err);
}

static bool render(const struct scene *scene, struct render_job o, const char *directory, struct error *err)
{
    struct strategy_images images;
    if (o.max_depth > STRATEGIES_MAX_DEPTH)
        return error_set(err, "paths of up to %d edges have %d pictures; --maxdepth %d is the most here",
                         o.max_depth + 1, (o.max_depth + 1) * (o.max_depth + 4), STRATEGIES_MAX_DEPTH);
    strategies_init(&images, render_crop(scene), o.max_depth);
    bool ok = strategies_render(scene, &o, &images, err) && write_all(directory, &images, scene->film_scale, err);
    strategies_free(&images);
    return ok;
}

static int run(void *options)
{
    struct strategies_options *o = options;
    struct scene scene;
    struct prepared prepared;
    struct error err;
    struct bar bar;
    int status = load_job(&o->job, &scene, &prepared);
    if (status != EXIT_OK)
        return status;
    bar_start(&bar, o->job.quiet);
    bar_follow(&bar, 1, &o->job);
    bool ok = file_make_directory(o->directory, &err) &&
              render(&scene, o->job, o->directory, &err);
    bar_clear(&bar);
    method_release(&prepared);
    scene_free(&scene);
    if (ok && !o->job.quiet)
        say_line("wrote the pictures of all strategies, and pyramid.png, into %s", o->directory);
    return ok ? EXIT_OK : fail(&err);
}

const struct command command_strategies = {
    "strategies", "every strategy (s,t) alone, unweighted and weighted", {"SCENE.pbrt -o DIR [options]"}, OPTIONS,
    sizeof(struct strategies_options), run, false,
    "strategies scenes/cornell-box.pbrt --quick --spp 64 --maxdepth 3 -o out/box"};
