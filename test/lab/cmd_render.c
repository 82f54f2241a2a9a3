/* cmd_render.c: asbdpt-lab render: the renderer's (src/cli/cmd_render.c), with more methods, some of which cannot do
 * all of it, and more images of the same paths. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/os.h"
#include "cli/cmd_render.h"
#include "lab/commands.h"
#include "lab/channels.h"
#include "lab/methods.h"

struct more_options {
    struct render_run run;
    struct channel_options channel;
};

#define AT(member) offsetof(struct more_options, channel.member)
static const struct option OPTIONS[] = {
    {"--aov", "LIST", OPTION_TEXT, AT(aov),
     .help = "also write NAME.albedo.pfm and so on: some of albedo,normal,depth,position,variance"},
    {"--layers", NULL, OPTION_ON, AT(layers),
     .help = "write the images of --aov as layers of the .exr"},
    {"--seen", NULL, OPTION_ON, AT(seen),
     .help = "albedo and normal show what is seen in mirrors and through glass, for denoisers"},
    {"--lights", "DIR", OPTION_TEXT, AT(lights),
     .help = "write into DIR an image for each light, or each \"string group\" of lights; sum --weights adds them"},
    {"--alpha", NULL, OPTION_ON, AT(alpha),
     .help = "write alpha into .exr and .png: 0 where the lens sees nothing, or a light of \"bool visible\" \"false\""},
    {.others = RENDER_OPTIONS},
};

/* What a chain does not show: its samples are not a pixel's own, and not independent. */
static const char *of_samples(const struct more_options *o)
{
    return channels_variance(&o->channel) ? "--aov variance" : o->channel.lights != NULL ? "--lights"
           : o->channel.alpha ? "--alpha" : job_asks_noise(&o->run.of.job) ? "--noise" : NULL;
}

/* Can the method show that? */
static bool can_show(const struct more_options *o, const struct method *m, struct error *err)
{
    if (of_samples(o) != NULL && method_is_chain(m))
        return error_usage(err, "%s: the samples of %s are a chain, and do not show that; render several --seed",
                           of_samples(o), m->name);
    return o->channel.lights == NULL || !method_merges(m) ||
           error_set(err, "%s adds what comes of many lights at once: render one of them at a time", m->name);
}

/* Can the options be as they are? */
static bool check(const struct more_options *o, struct error *err)
{
    bool kept = channels_variance(&o->channel) || o->channel.lights != NULL || o->channel.alpha;
    if (o->run.checkpoint.resume != NULL && kept)
        return error_set(err, "%s: variance, lights and alpha are not saved and cannot be resumed; render them by "
                         "--samples, and take the mean by sum --weights", o->run.checkpoint.resume);
    return channels_check(&o->channel, err);
}

static int run(void *options)
{
    struct more_options *o = options;
    struct render_run *r = &o->run;
    struct channels channels;
    struct error err;
    if (!check(o, &err))
        return fail(&err);
    int status = render_open(r);
    if (status != EXIT_OK)
        return status;
    bool ok = can_show(o, r->of.job.integrator, &err) && channels_open(&channels, &o->channel, r, &err);
    if (ok) {
        ok = render_work(r, &err);
        ok = channels_write(&channels, ok, &err);
    }
    return render_close(r, ok, &err);
}

const struct command command_render_more = {
    "render", "render a scene", {"SCENE.pbrt [-o FILE]... [options]"}, OPTIONS,
    sizeof(struct more_options), run, false, "render scenes/veach-ajar.pbrt --quick --spp 16 -o out/ajar.png"};
