/* stats.c: what a render was of and how it went, for programs; see cmd_render.h. */
#include "cli/cmd_render.h"

#include "base/json.h"
#include "base/os.h"
#include "base/version.h"

double stats_us_per_path(const struct render_run *r)
{
    double paths = r->samples * (double)rect_pixels(r->film.rect);
    return paths > 0 ? 1e6 * r->cpu / paths : 0;
}

/* The values in force, from the scene, -P or the defaults, as they have been read. */
static void put_table(struct json *j, const struct field *p, const void *from)
{
    for (; p != NULL && p->name != NULL; p++) {
        const void *value = (const char *)from + p->place;
        if (p->kind == FIELD_WORD)
            json_text(j, p->name, p->words[*(const int *)value]);
        else
            json_number(j, p->name, p->kind == FIELD_INTEGER ? *(const int *)value : *(const double *)value);
    }
}

static void put_parameters(struct json *j, const struct job *job)
{
    const struct method *m = job->options.integrator;
    json_open(j, "parameters", '{');
    json_number(j, "maxdepth", job->state.max_depth);
    json_text(j, "heuristic", job->state.power_heuristic ? "power" : "balance");
    json_number(j, "rrthreshold", job->state.rr_threshold);
    json_text(j, "lightsamplestrategy", job->state.spatial_lights ? "spatial" : "power");
    if (m->select != NULL)
        json_text(j, "select", m->select);
    put_table(j, m->parameters, &job->prepared.parameters);
    put_table(j, m->own, job->prepared.own);
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
    struct method_number chosen[METHOD_NUMBERS];
    struct json json = json_start(f), *j = &json;
    method_numbers(&r->job.prepared, chosen);
    json_open(j, NULL, '{');
    json_text(j, "version", VERSION);
    json_text(j, "scene", o->scene_path);
    json_open(j, "files", '[');
    for (int i = 0; i < r->pictures.n; i++)
        json_text(j, NULL, r->pictures.item[i].file.path);
    json_close(j);
    json_text(j, "checkpoint", o->keep.checkpoint);
    json_text(j, "integrator", r->job.options.integrator->name);
    put_parameters(j, &r->job);
    json_count(j, "seed", r->job.options.seed);
    put_film(j, &r->scene, &r->film);
    json_number(j, "spp", (double)r->job.options.planned);
    json_number(j, "first_sample", o->keep.samples[0]);
    json_number(j, "spp_done", (double)r->film.iterations);
    json_number(j, "spp_done_now", r->samples);
    json_number(j, "load_seconds", r->load);
    json_number(j, "wall_seconds", r->wall);
    json_number(j, "cpu_seconds", r->cpu);
    json_number(j, "us_per_path", stats_us_per_path(r));
    json_number(j, "threads", r->job.options.n_threads);
    json_number(j, "peak_memory", os_peak_memory());
    json_number(j, "nonfinite", (double)r->film.nonfinite);
    json_open(j, "chosen", '{');
    for (const struct method_number *n = chosen; n->name != NULL; n++)
        json_number(j, n->name, n->value);
    json_close(j);
    json_close(j);
}
