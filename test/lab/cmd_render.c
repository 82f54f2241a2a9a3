/* cmd_render.c: asbdpt-lab render: the renderer's (src/cli/cmd_render.c), with more methods, some of which cannot do
 * all of it, and more images of the same paths: what the camera sees first (aov.h); lights apart, alpha and variance
 * (planes.h).
 *
 * Next to NAME.png are NAME.albedo.pfm, NAME.normal.pfm, ..., or NAME.exr has them as layers, with the channels
 * albedo.R, .G, .B, normal.X, .Y, .Z, depth.Z and so on, as compositors name them. Layers and alpha are in the
 * picture's own files, which are written again when these are made.
 *
 * Tests: test/run/cli.sh, test/run/outputs.sh. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/interrupt.h"
#include "base/mem.h"
#include "base/os.h"
#include "cli/cmd_render.h"
#include "image/image.h"
#include "lab/aov.h"
#include "lab/commands.h"
#include "lab/methods.h"
#include "lab/planes.h"

struct channel_options {
    const char *aov;    /* list or NULL */
    bool layers, seen;  /* they go into the picture's own file; see aov.h */
    const char *lights; /* directory or NULL */
    bool alpha;
};

/* One more file, and what is in it. */
struct channel_file {
    struct file_output file; /* its stream NULL: it is written */
    int light;               /* a group of lights; -1: none */
    enum aov aov;            /* else, N_AOVS: the picture, with layers and alpha */
};

struct channels {
    const struct channel_options *options;
    struct render_run *run;
    bool wanted[N_AOVS];
    struct channel_file *item; /* [n], owned */
    int n;
    struct planes planes;
    struct observers observers; /* of the planes */
};

/* --- options ------------------------------------------------------------------------------------------ */

/* Names of aov_name with commas between them; NULL: none. */
static bool read_list(const char *list, bool wanted[N_AOVS], struct error *err)
{
    for (const char *word = list; word != NULL;) {
        size_t n = strcspn(word, ",");
        int i = 0;
        while (i < N_AOVS && (strlen(aov_name((enum aov)i)) != n || strncmp(word, aov_name((enum aov)i), n) != 0))
            i++;
        if (i == N_AOVS)
            return error_usage(err, "--aov %s: known are albedo, normal, depth, position, variance, with commas "
                                    "between them", list);
        wanted[i] = true;
        word = word[n] == ',' ? word + n + 1 : NULL;
    }
    return true;
}

/* Can the options be as they are? False with a message. */
static bool channels_check(const struct channel_options *o, struct error *err)
{
    bool wanted[N_AOVS] = {false};
    return read_list(o->aov, wanted, err);
}

/* Do they ask for the variance? */
static bool channels_variance(const struct channel_options *o)
{
    bool wanted[N_AOVS] = {false};
    struct error ignored;
    return read_list(o->aov, wanted, &ignored) && wanted[AOV_VARIANCE];
}

/* --- files -------------------------------------------------------------------------------------------- */

static bool add_file(struct channels *l, const char *name, int light, enum aov aov, struct error *err)
{
    struct channel_file f = {.light = light, .aov = aov};
    if (!image_create(name, &f.file, err))
        return false;
    l->item = mem_append(l->item, (size_t)l->n, sizeof *l->item);
    l->item[l->n++] = f;
    return true;
}

static bool open_aov(struct channels *l, const char *picture, enum aov which, struct error *err)
{
    const char *dot = strrchr(picture, '.'), *slash = os_last_separator(picture);
    int stem = dot != NULL && (slash == NULL || dot > slash) ? (int)(dot - picture) : (int)strlen(picture);
    size_t size = strlen(picture) + 20;
    if (strcmp(picture, "-") == 0)
        return error_usage(err, "--aov needs an image with a name (-o), to write next to it");
    char *name = mem_alloc(size, 1);
    snprintf(name, size, "%.*s.%s.pfm", stem, picture, aov_name(which));
    bool ok = add_file(l, name, -1, which, err);
    free(name);
    return ok;
}

/* Every picture that has layers or alpha a second time: it is whole without them while they are made. */
static bool open_again(struct channels *l, struct error *err)
{
    const struct outputs *pictures = &l->run->pictures;
    bool ok = true;
    int n = l->n;
    for (int i = 0; ok && i < pictures->n; i++) {
        const char *name = pictures->item[i].file.path;
        bool exr = file_has_extension(name, ".exr"), png = file_has_extension(name, ".png");
        if (!pictures->item[i].is_part && (exr || (png && l->options->alpha)))
            ok = add_file(l, name, -1, N_AOVS, err);
    }
    return ok && (l->n > n || !l->options->layers ||
                  error_usage(err, "--layers: no other format has them than .exr; name one by -o"));
}

/* A group is called by its name, or by what it is. */
static bool open_light(struct channels *l, int i, struct error *err)
{
    const struct light_group *g = &l->run->of.scene.lights.group[i];
    size_t size = strlen(l->options->lights) + 64;
    char *name = mem_alloc(size, 1);
    snprintf(name, size, "%s/light%02d_%s.pfm", l->options->lights, i,
             g->name != NULL ? g->name : LIGHT_KINDS[g->kind]);
    bool ok = add_file(l, name, i, N_AOVS, err);
    free(name);
    return ok;
}

static bool open_lights(struct channels *l, struct error *err)
{
    int n = l->run->of.scene.lights.n_groups;
    bool ok = true;
    if (n > LIGHT_MAX_GROUPS)
        return error_usage(err, "--lights: %d images, one for each light, and %d are the most here; lights with the "
                           "same \"string group\" are one", n, LIGHT_MAX_GROUPS);
    os_make_directory(l->options->lights); /* if that fails, creating a file says why */
    for (int i = 0; ok && i < n; i++)
        ok = open_light(l, i, err);
    return ok;
}

/* Does every file have a name of its own, and is the scene read from none? */
static bool names_differ(const struct channels *l, struct error *err)
{
    struct texts names = {0};
    options_written(RENDER_OPTIONS, l->run, &names);
    if (l->run->output.n == 0)
        texts_add(&names, l->run->pictures.item[0].file.path);
    for (int i = 0; i < l->n; i++)
        if (l->item[i].light >= 0 || l->item[i].aov < N_AOVS)
            texts_add(&names, l->item[i].file.path);
    bool ok = texts_differ(&names, err) && job_spares(&l->run->of.scene, &names, err);
    free(names.item);
    return ok;
}

static bool open_files(struct channels *l, struct error *err)
{
    const struct channel_options *o = l->options;
    bool ok = read_list(o->aov, l->wanted, err);
    for (int i = 0; ok && i < N_AOVS && !o->layers; i++)
        ok = !l->wanted[i] || open_aov(l, l->run->pictures.item[0].file.path, (enum aov)i, err);
    return ok && (o->lights == NULL || open_lights(l, err)) && ((!o->layers && !o->alpha) || open_again(l, err)) &&
           names_differ(l, err);
}

static void release(struct channels *l)
{
    for (int i = 0; i < l->n; i++)
        if (l->item[i].file.stream != NULL)
            file_abandon(&l->item[i].file);
    free(l->item);
    planes_free(&l->planes);
}

static bool begin_planes(struct channels *l, struct error *err)
{
    struct render_run *r = l->run;
    const struct channel_options *o = l->options;
    struct error why;
    planes_init(&l->planes, &r->of.scene, &r->of.film, o->lights != NULL, o->alpha, l->wanted[AOV_VARIANCE],
                r->of.job.n_threads);
    if (!budget_has(&r->of.scene.memory, (1 + l->planes.n) * film_bytes(r->of.film.rect, false), &why))
        return error_set(err, "%s: its film and %d more of %dx%d pixels: %s; --res makes them smaller",
                         r->of.job.scene_path, l->planes.n, r->of.scene.width, r->of.scene.height, why.text);
    l->observers = planes_observers(&l->planes);
    if (l->planes.n > 0 && (r->of.scene.lights.n > 0 || o->alpha)) /* else all samples are black */
        r->of.job.observers = &l->observers;
    return true;
}

/* Begin to write the files, and look on at the render, which is open. False with a message, after which nothing needs
 * release. */
static bool channels_open(struct channels *l, const struct channel_options *o, struct render_run *run, struct error *err)
{
    *l = (struct channels){.options = o, .run = run};
    bool ok = open_files(l, err) && begin_planes(l, err);
    if (!ok)
        release(l);
    return ok;
}

/* --- images ------------------------------------------------------------------------------------------- */

static bool late(const struct checkpoint *k)
{
    return k->time > 0 && os_wall_seconds() - k->begun >= k->time;
}

/* First-hit images, too, end at a signal and in time. */
static enum cancel cancel(void *context)
{
    return interrupt_caught() != 0 ? CANCEL_NOW : late(context) ? CANCEL_BLOCK : CANCEL_NOT;
}

static void progress(void *context, double learnt, double done)
{
    struct checkpoint *k = context;
    (void)learnt;
    progress_update(&k->bar, done);
}

static bool make_first_hit(const struct channels *l, float *const picture[N_AOVS])
{
    struct checkpoint *k = &l->run->checkpoint;
    struct render_job o = l->run->of.job;
    o.end = l->run->of.film.iterations > 0 ? l->run->of.film.iterations : 1;
    o.progress = progress;
    o.cancel = cancel;
    o.context = k;
    progress_start(&k->bar, l->run->of.job.quiet);
    strcpy(k->bar.note, " of --aov");
    bool ok = aov_render(&l->run->of.scene, &o, l->options->seen, picture);
    progress_end(&k->bar);
    return ok;
}

static float *image_of(const struct film *f, double scale)
{
    float *out = mem_alloc(rect_pixels(f->rect) * 3, sizeof *out);
    film_develop(f, scale, out);
    return out;
}

/* The picture as it is to be shown: it is the colours that a curve is for, not their multiples by alpha. */
static void show(const struct tone *tone, const float *alpha, size_t n, float *pixels)
{
    for (size_t i = 0; alpha != NULL && i < n; i++)
        pixels[i] = alpha[i] > 0 ? pixels[i] / alpha[i] : 0;
    tone_map(tone, pixels, n, pixels);
    for (size_t i = 0; alpha != NULL && i < n; i++)
        pixels[i] *= alpha[i];
}

/* The channels of the picture's own file. Returns their number. */
static int channels_of(const struct channels *l, const float *alpha, float *const picture[N_AOVS], struct channel *out)
{
    static const char *const NAMES[N_AOVS][3] = {{"albedo.R", "albedo.G", "albedo.B"},
                                                 {"normal.X", "normal.Y", "normal.Z"},
                                                 {"depth.Z", NULL, NULL},
                                                 {"position.X", "position.Y", "position.Z"},
                                                 {"variance.R", "variance.G", "variance.B"}};
    int n = 0;
    if (alpha != NULL)
        out[n++] = (struct channel){"A", alpha, 3, false};
    for (int i = 0; i < N_AOVS && l->options->layers; i++)
        for (int c = 0; c < 3 && picture[i] != NULL && NAMES[i][c] != NULL; c++)
            out[n++] = (struct channel){NAMES[i][c], picture[i] + c, 3, true};
    return n;
}

static bool write_one(const struct channels *l, struct channel_file *f, float *const picture[N_AOVS], struct error *err)
{
    const struct render_run *r = l->run;
    const struct film *film = f->light >= 0 ? &l->planes.film[f->light] : &r->of.film;
    float *pixels = f->aov < N_AOVS ? NULL : image_of(film, r->of.scene.film_scale), *alpha = NULL;
    struct raster raster = {r->of.part.place, rect_width(film->rect), rect_height(film->rect), pixels, NULL, 0, false};
    struct channel channel[1 + 3 * N_AOVS];
    if (f->aov < N_AOVS)
        raster.pixels = picture[f->aov];
    if (f->light < 0 && f->aov == N_AOVS) {
        outputs_develop(&r->pictures, pixels);
        alpha = l->options->alpha ? image_of(planes_alpha(&l->planes), 1) : NULL;
        raster.more = channel;
        raster.n_more = channels_of(l, alpha, picture, channel);
        if (image_is_8_bit(f->file.path))
            show(&r->pictures.tone, alpha, 3 * rect_pixels(film->rect), pixels);
    }
    bool ok = image_finish(&f->file, &raster, err);
    free(alpha);
    free(pixels);
    return ok;
}

/* One that fails does not keep the others from being written: the first message is kept. */
static bool write_all(struct channels *l, float *const picture[N_AOVS], bool ok, struct error *err)
{
    for (int i = 0; i < l->n; i++) {
        struct channel_file *f = &l->item[i];
        if (f->aov < N_AOVS && picture[f->aov] == NULL)
            continue;
        char *name = mem_copy_text(f->file.path);
        bool done = write_one(l, f, picture, ok ? err : NULL);
        if (done && !l->run->of.job.quiet)
            say_line("wrote %s", name);
        ok = ok && done;
        free(name);
    }
    return ok;
}

/* The images of --aov that are wanted, to be given to free(); NULL where they were not made. False with a message. */
static bool make_aovs(const struct channels *l, float *picture[N_AOVS], struct error *err)
{
    const struct film *film = &l->run->of.film;
    bool first_hit = false;
    if (l->wanted[AOV_VARIANCE] && film->iterations < 2)
        return error_set(err, "--aov: not written, for one sample per pixel has no variance");
    for (int i = 0; i < N_AOVS; i++) {
        picture[i] = mem_alloc(rect_pixels(film->rect) * 3, sizeof *picture[i]);
        first_hit |= i < N_FIRST_HIT && l->wanted[i];
    }
    if (l->wanted[AOV_VARIANCE])
        planes_variance(&l->planes, l->run->of.scene.film_scale, picture[AOV_VARIANCE]);
    bool looked = first_hit && make_first_hit(l, picture);
    if (first_hit && !looked)
        say_line("asbdpt: --aov: not written, for there are pixels that have not been looked at");
    for (int i = 0; i < N_AOVS; i++)
        if (!l->wanted[i] || (first_hit && !looked)) {
            free(picture[i]);
            picture[i] = NULL;
        }
    return true;
}

/* Write them when the render is over if it went well, and release everything. False with a message; err stays as it is
 * where the render did not go well. */
static bool channels_write(struct channels *l, bool ok, struct error *err)
{
    float *picture[N_AOVS] = {NULL};
    planes_end(&l->planes);
    if (ok && l->n > 0) {
        ok = make_aovs(l, picture, err);
        ok = write_all(l, picture, ok, err) && ok;
    }
    for (int i = 0; i < N_AOVS; i++)
        free(picture[i]);
    release(l);
    return ok;
}

/* --- the command ----------------------------------------------------------------------------------------------- */

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
