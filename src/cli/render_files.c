/* render_files.c: render --aov, --lights and --stats; see render_files.h. */
#include "cli/render_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/json.h"
#include "base/mem.h"
#include "base/os.h"
#include "base/version.h"
#include "image/image.h"
#include "render/parameters.h"

bool aov_read(const char *list, struct aov_files *out, struct error *err)
{
    memset(out, 0, sizeof *out);
    for (const char *word = list; word != NULL;) {
        size_t n = strcspn(word, ",");
        int i = 0;
        while (i < N_AOVS && (strlen(aov_name((enum aov)i)) != n || strncmp(word, aov_name((enum aov)i), n) != 0))
            i++;
        if (i == N_AOVS)
            return error_usage(err, "--aov %s: known are albedo, normal, depth, position, variance, with commas "
                                    "between them", list);
        out->wanted[i] = true;
        word = word[n] == ',' ? word + n + 1 : NULL;
    }
    return true;
}

static bool open_one(const char *picture, enum aov which, struct outputs *out, struct error *err)
{
    const char *dot = strrchr(picture, '.'), *slash = os_last_separator(picture);
    int stem = dot != NULL && (slash == NULL || dot > slash) ? (int)(dot - picture) : (int)strlen(picture);
    size_t size = strlen(picture) + 20;
    char *name = mem_alloc(size, 1);
    snprintf(name, size, "%.*s.%s.pfm", stem, picture, aov_name(which));
    bool ok = outputs_add(out, name, false, err);
    free(name);
    return ok;
}

/* Every .exr a second time: it is whole without layers while these are made. */
static bool open_layers(struct aov_files *f, const struct outputs *pictures, struct error *err)
{
    bool ok = true;
    for (int i = 0; ok && i < pictures->n; i++)
        if (!pictures->item[i].is_part && image_keeps_place(pictures->item[i].file.path))
            ok = outputs_add(&f->out, pictures->item[i].file.path, false, err);
    return ok && (f->out.n > 0 || error_usage(err, "--layers: no other format has them than .exr; name one by -o"));
}

bool aov_open(struct aov_files *f, bool layers, const struct outputs *pictures, struct error *err)
{
    bool ok = true;
    f->layers = layers;
    if (layers)
        return open_layers(f, pictures, err);
    for (int i = 0; ok && i < N_AOVS; i++) {
        const char *picture = pictures->item[0].file.path;
        if (f->wanted[i] && strcmp(picture, "-") == 0)
            return error_usage(err, "--aov needs an image with a name (-o), to write next to it");
        ok = !f->wanted[i] || open_one(picture, (enum aov)i, &f->out, err);
    }
    return ok;
}

/* The channels of a picture, at most three. */
static void add_layer(struct outputs *out, enum aov which, const float *picture)
{
    static const char *const NAMES[N_AOVS][3] = {{"albedo.R", "albedo.G", "albedo.B"},
                                                 {"normal.X", "normal.Y", "normal.Z"},
                                                 {"depth.Z", NULL, NULL},
                                                 {"position.X", "position.Y", "position.Z"},
                                                 {"variance.R", "variance.G", "variance.B"}};
    for (int c = 0; c < 3 && NAMES[which][c] != NULL; c++)
        out->layer[out->n_layers++] = (struct channel){NAMES[which][c], picture + c, 3, true};
}

/* Say where each comes from. */
static void place(struct aov_files *f)
{
    struct outputs *out = &f->out;
    for (int i = 0, at = 0; i < N_AOVS; i++)
        if (f->wanted[i] && f->layers)
            add_layer(out, (enum aov)i, f->picture[i]);
        else if (f->wanted[i])
            out->item[at++].pixels = f->picture[i];
}

bool aov_write(struct aov_files *f, const struct scene *scene, const struct render_options *options,
               const struct film *film, bool seen, const float *pixels, bool quiet, struct error *err)
{
    struct render_options first = *options;
    bool first_hit = false, ok = true;
    if (f->out.n == 0)
        return true;
    if (f->wanted[AOV_VARIANCE] && film->iterations < 2)
        return error_set(err, "--aov: not written, for one sample per pixel has no variance");
    first.end = film->iterations > 0 ? film->iterations : 1;
    for (int i = 0; i < N_AOVS; i++) {
        f->picture[i] = mem_alloc(rect_pixels(film->rect) * 3, sizeof *f->picture[i]);
        first_hit |= i < N_FIRST_HIT && f->wanted[i];
    }
    if (f->wanted[AOV_VARIANCE])
        aov_variance(film, scene->film_scale, f->picture[AOV_VARIANCE]);
    if (!first_hit || aov_render(scene, &first, seen, f->picture)) {
        place(f);
        ok = outputs_write(&f->out, rect_width(film->rect), rect_height(film->rect), pixels, quiet, err);
    } else {
        say_line("asbdpt: --aov: not written, for there are pixels that have not been looked at");
    }
    for (int i = 0; i < N_AOVS; i++)
        free(f->picture[i]);
    return ok;
}

/* --- --lights ----------------------------------------------------------------------------------------- */

/* A group is called by its name, or by what it is. */
static char *picture_path(const char *directory, const struct light_set *lights, int i)
{
    static const char *const KINDS[] = {
        [LIGHT_AREA] = "area", [LIGHT_POINT] = "point", [LIGHT_SPOT] = "spot", [LIGHT_DISTANT] = "distant",
        [LIGHT_INFINITE] = "infinite"};
    const struct light_group *g = &lights->group[i];
    size_t size = strlen(directory) + 64;
    char *out = mem_alloc(size, 1);
    snprintf(out, size, "%s/light%02d_%s.pfm", directory, i, g->name != NULL ? g->name : KINDS[g->kind]);
    return out;
}

bool lights_open(const char *directory, const struct scene *scene, struct outputs *out, struct error *err)
{
    const struct light_set *lights = &scene->lights;
    if (directory == NULL)
        return true;
    if (lights->n_groups > LIGHT_MAX_GROUPS)
        return error_usage(err, "--lights: %d images, one for each light, and %d are the most here; lights with the "
                           "same \"string group\" are one", lights->n_groups, LIGHT_MAX_GROUPS);
    bool ok = true;
    os_make_directory(directory); /* if that fails, creating a file says why */
    for (int i = 0; ok && i < lights->n_groups; i++) {
        char *path = picture_path(directory, lights, i);
        ok = outputs_add(out, path, false, err);
        if (ok)
            out->item[out->n - 1].plane = 1 + i;
        free(path);
    }
    return ok;
}

/* --- --stats ------------------------------------------------------------------------------------------ */

double render_us_per_path(const struct film *film, const struct render_times *times)
{
    double paths = times->samples * rect_width(film->rect) * rect_height(film->rect);
    return paths > 0 ? 1e6 * times->cpu / paths : 0;
}

/* A number where the text is one. */
static void put_value(struct json *j, const char *name, const char *text)
{
    char *end;
    double value = strtod(text, &end);
    if (end != text && *end == '\0')
        json_number(j, name, value);
    else
        json_text(j, name, text);
}

/* The values in force, from the scene, -P or the defaults. */
static void put_table(struct json *j, const struct scene *scene, const struct field *p)
{
    char fallback[64];
    for (; p->name != NULL; p++) {
        field_fallback(p, fallback, sizeof fallback);
        put_value(j, p->name, settings_text(&scene->settings, p->name, fallback));
    }
}

static void put_parameters(struct json *j, const struct scene *scene, const struct render_options *o)
{
    const struct method *m = method_find(o->integrator, &scene->settings, NULL);
    struct render_job job = {.max_depth = 0};
    parameters_read(scene, m, o->max_depth, &job, NULL); /* as before, when they were right */
    json_open(j, "parameters", '{');
    json_number(j, "maxdepth", job.max_depth);
    json_text(j, "heuristic", job.power_heuristic ? "power" : "balance");
    json_number(j, "rrthreshold", job.rr_threshold);
    json_text(j, "lightsamplestrategy", job.spatial_lights ? "spatial" : "power");
    if (m->select != NULL)
        json_text(j, "select", m->select);
    if (m->parameters != NULL)
        put_table(j, scene, m->parameters);
    if (m->own != NULL)
        put_table(j, scene, m->own);
    json_close(j);
}

static void put_film(struct json *j, const struct scene *scene, const struct film *film)
{
    json_numbers(j, "film", (const double[]){scene->width, scene->height}, 2);
    json_number(j, "width", rect_width(film->rect));
    json_number(j, "height", rect_height(film->rect));
    json_numbers(j, "corner", (const double[]){film->rect.x0, film->rect.y0}, 2);
}

void stats_write(FILE *f, const struct job_options *o, const struct scene *scene, const struct render_options *render,
                 const struct film *film, const struct outputs *pictures, const struct outputs *features,
                 const struct render_times *times)
{
    struct json json = json_start(f), *j = &json;
    json_open(j, NULL, '{');
    json_text(j, "version", VERSION);
    json_text(j, "scene", o->scene_path);
    json_open(j, "files", '[');
    for (int i = 0; i < pictures->n; i++)
        json_text(j, NULL, pictures->item[i].file.path);
    for (int i = 0; i < features->n && !o->layers; i++)
        json_text(j, NULL, features->item[i].file.path);
    json_close(j);
    json_text(j, "lights", o->lights); /* a directory, or null */
    json_text(j, "checkpoint", o->keep.checkpoint);
    json_text(j, "integrator", render->integrator);
    put_parameters(j, scene, render);
    json_count(j, "seed", render->seed);
    put_film(j, scene, film);
    json_number(j, "spp", (double)render->planned);
    json_number(j, "first_sample", o->keep.samples[0]);
    json_number(j, "spp_done", (double)film->iterations);
    json_number(j, "spp_done_now", times->samples);
    json_number(j, "load_seconds", times->load);
    json_number(j, "wall_seconds", times->wall);
    json_number(j, "cpu_seconds", times->cpu);
    json_number(j, "us_per_path", render_us_per_path(film, times));
    json_number(j, "threads", render->n_threads > 0 ? render->n_threads : os_cores());
    json_number(j, "peak_memory", os_peak_memory());
    json_number(j, "nonfinite", (double)film->nonfinite);
    if (film->number[0].name != NULL) {
        json_open(j, "chosen", '{');
        for (const struct film_number *n = film->number; n->name != NULL; n++)
            json_number(j, n->name, n->value);
        json_close(j);
    }
    json_close(j);
}
