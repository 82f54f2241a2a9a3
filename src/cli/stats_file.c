/* stats_file.c: render --stats; see render_files.h. */
#include "cli/render_files.h"

#include <stdlib.h>

#include "base/json.h"
#include "base/os.h"
#include "base/version.h"
#include "render/parameters.h"

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

/* Those in force, whoever set them. */
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
    struct render_job job;
    struct error none;
    json_open(j, "parameters", '{');
    if (m != NULL && parameters_read(scene, m, o->max_depth, &job, &none)) { /* they have been read before */
        json_number(j, "maxdepth", job.max_depth);
        json_text(j, "heuristic", job.power_heuristic ? "power" : "balance");
        json_number(j, "rrthreshold", job.rr_threshold);
        json_text(j, "lightsamplestrategy", job.spatial_lights ? "spatial" : "power");
    }
    if (m != NULL && m->select != NULL)
        json_text(j, "select", m->select);
    struct field all[METHOD_FIELDS] = {{.name = NULL}};
    if (m != NULL)
        method_fields(m, all);
    put_table(j, scene, all);
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
    if (render->gate.end > 0)
        json_numbers(j, "gate", (const double[]){render->gate.begin, render->gate.end}, 2);
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
    json_text(j, "note", film->note);
    json_open(j, "chosen", '{');
    for (const struct film_number *n = film->number; n->name != NULL; n++)
        json_number(j, n->name, n->value);
    json_close(j);
    json_close(j);
}
