/* stats.c: what a render was of and how it went, for programs; see cmd_render.h. */
#include "cli/cmd_render.h"

#include <stdlib.h>

#include "base/json.h"
#include "base/os.h"
#include "base/version.h"
#include "render/parameters.h"

double stats_us_per_path(const struct render_run *r)
{
    double paths = r->samples * (double)rect_pixels(r->film.rect);
    return paths > 0 ? 1e6 * r->cpu / paths : 0;
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

void stats_write(FILE *f, const struct render_run *r)
{
    const struct job_options *o = r->asked;
    struct json json = json_start(f), *j = &json;
    json_open(j, NULL, '{');
    json_text(j, "version", VERSION);
    json_text(j, "scene", o->scene_path);
    json_open(j, "files", '[');
    for (int i = 0; i < r->pictures.n; i++)
        json_text(j, NULL, r->pictures.item[i].file.path);
    json_close(j);
    json_text(j, "checkpoint", o->keep.checkpoint);
    json_text(j, "integrator", r->render.integrator);
    put_parameters(j, &r->scene, &r->render);
    json_count(j, "seed", r->render.seed);
    put_film(j, &r->scene, &r->film);
    json_number(j, "spp", (double)r->render.planned);
    json_number(j, "first_sample", o->keep.samples[0]);
    json_number(j, "spp_done", (double)r->film.iterations);
    json_number(j, "spp_done_now", r->samples);
    json_number(j, "load_seconds", r->load);
    json_number(j, "wall_seconds", r->wall);
    json_number(j, "cpu_seconds", r->cpu);
    json_number(j, "us_per_path", stats_us_per_path(r));
    json_number(j, "threads", r->render.n_threads > 0 ? r->render.n_threads : os_cores());
    json_number(j, "peak_memory", os_peak_memory());
    json_number(j, "nonfinite", (double)r->film.nonfinite);
    if (r->film.number[0].name != NULL) {
        json_open(j, "chosen", '{');
        for (const struct film_number *n = r->film.number; n->name != NULL; n++)
            json_number(j, n->name, n->value);
        json_close(j);
    }
    json_close(j);
}
