/* cmd_render.c: asbdpt-lab render: the renderer's (src/cli/cmd_render.c), which some methods of the laboratory cannot
 * do all of. */
#include <string.h>

#include "cli/job_options.h"
#include "lab/commands.h"
#include "lab/methods.h"

/* What a chain does not show: its samples are not a pixel's own, and not independent. */
static const char *of_samples(const struct job_options *o)
{
    return o->aov != NULL && strstr(o->aov, "variance") != NULL ? "--aov variance"
           : o->lights != NULL ? "--lights" : o->alpha ? "--alpha" : keep_asks_noise(&o->keep) ? "--noise" : NULL;
}

static int refuse(const struct job_options *o, const struct method *m)
{
    struct error err;
    if (method_is_chain(m))
        error_usage(&err, "%s: the samples of %s are a chain, and do not show that; render several --seed",
                    of_samples(o), m->name);
    else
        error_set(&err, "%s adds what comes of many lights at once: render one of them at a time", m->name);
    return fail(&err);
}

static int run(void *options)
{
    struct job_options before = *(const struct job_options *)options;
    struct scene scene;
    const struct method *m;
    before.quiet = true;
    before.strict = false;
    if (of_samples(&before) == NULL || strcmp(before.scene_path, "-") == 0) /* which cannot be read twice */
        return command_render.run(options);
    int status = job_load(&before, &scene, &m);
    if (status != EXIT_OK)
        return status;
    scene_free(&scene);
    bool can = !method_is_chain(m) && !(before.lights != NULL && method_merges(m));
    return can ? command_render.run(options) : refuse(&before, m);
}

const struct command command_render_more = {
    "render", "render a scene", {"SCENE.pbrt [-o FILE.{pfm,exr,png,ppm}]... [options]"}, RENDER_OPTIONS,
    sizeof(struct job_options), run, false, "render scenes/veach-ajar.pbrt --quick --spp 16 -o out/ajar.png"};
