/* stats.c: what a render was of and how it went, for programs: one object of JSON; see state.h. */
#include <inttypes.h>
#include <math.h>

#include "base/os.h"
#include "base/version.h"
#include "library/state.h"
#include "render/chosen.h"

double stats_us_per_path(const struct asbdpt *r)
{
    double paths = r->samples * (double)rect_pixels(r->film.rect);
    return paths > 0 ? 1e6 * r->cpu / paths : 0;
}

/* In quotes; a byte that is no part of UTF-8 becomes U+FFFD. NULL: null. */
static void quote(struct growing *f, const char *text)
{
    growing_add(f, "%s", text != NULL ? "\"" : "null");
    for (int n; text != NULL && *text != '\0'; text += n > 0 ? n : 1) {
        unsigned char c = (unsigned char)*text;
        n = printable_length(text);
        if (c == '"' || c == '\\')
            growing_add(f, "\\%c", c);
        else if (n > 0)
            growing_add(f, "%.*s", n, text);
        else
            growing_add(f, "\\u%04x", c < 0x80 ? c : 0xfffdu);
    }
    growing_add(f, "%s", text != NULL ? "\"" : "");
}

static void put_text(struct growing *f, const char *name, const char *text)
{
    growing_add(f, ",\n\"%s\": ", name);
    quote(f, text);
}

/* With 17 digits, so that it is read back as it was. */
static void put_number(struct growing *f, const char *name, double value)
{
    if (isfinite(value))
        growing_add(f, ",\n\"%s\": %.17g", name, value);
    else
        put_text(f, name, NULL);
}

/* The values in force, from the scene, -P or the defaults, as they have been read. */
static void put_table(struct growing *f, const struct field *p, const void *from)
{
    for (; p != NULL && p->name != NULL; p++) {
        const void *value = (const char *)from + p->place;
        if (p->kind == FIELD_WORD)
            put_text(f, p->name, p->words[*(const int *)value]);
        else
            put_number(f, p->name, p->kind == FIELD_INTEGER ? *(const int *)value : *(const double *)value);
    }
}

static void put_parameters(struct growing *f, const struct render_job *job, const struct prepared *p)
{
    const struct method *m = job->integrator;
    growing_add(f, ",\n\"parameters\": {\n\"maxdepth\": %d", job->max_depth);
    put_number(f, "rrthreshold", job->rr_threshold);
    put_text(f, "lightsamplestrategy", LIGHT_STRATEGIES[job->strategy]);
    if (m->select != NULL)
        put_text(f, "select", m->select);
    put_table(f, m->parameters, &p->parameters);
    put_table(f, m->own, p->own);
    growing_add(f, "%s", "}");
}

void stats_add(struct growing *f, const struct asbdpt *r, const struct texts *files, const char *checkpoint)
{
    const struct film *film = &r->film;
    struct chosen_number chosen[CHOSEN_NUMBERS];
    chosen_numbers(&r->prepared, chosen);
    growing_add(f, "{\n\"version\": \"%s\"", VERSION);
    put_text(f, "scene", r->job.scene_path);
    growing_add(f, "%s", ",\n\"files\": [");
    for (int i = 0; i < files->n; i++) {
        growing_add(f, "%s", i > 0 ? ", " : "");
        quote(f, files->item[i]);
    }
    growing_add(f, "%s", "]");
    put_text(f, "checkpoint", checkpoint);
    put_text(f, "integrator", r->job.integrator->name);
    put_parameters(f, &r->job, &r->prepared);
    growing_add(f, ",\n\"seed\": %" PRIu64 ",\n\"film\": [%d, %d],\n\"corner\": [%d, %d]", r->job.seed,
            r->scene.width, r->scene.height, film->rect.x0, film->rect.y0);
    put_number(f, "width", rect_width(film->rect));
    put_number(f, "height", rect_height(film->rect));
    put_number(f, "spp", (double)r->job.planned);
    put_number(f, "first_sample", r->job.samples[0]);
    put_number(f, "spp_done", (double)film->iterations);
    put_number(f, "spp_done_now", r->samples);
    put_number(f, "load_seconds", r->load);
    put_number(f, "wall_seconds", r->wall);
    put_number(f, "cpu_seconds", r->cpu);
    put_number(f, "us_per_path", stats_us_per_path(r));
    put_number(f, "threads", r->job.n_threads);
    put_number(f, "peak_memory", os_peak_memory());
    put_number(f, "nonfinite", (double)film->nonfinite);
    growing_add(f, ",\n\"chosen\": {\n\"%s\": %.17g", chosen->name, chosen->value);
    for (const struct chosen_number *n = chosen + 1; n->name[0] != '\0'; n++)
        put_number(f, n->name, n->value);
    growing_add(f, "%s", "}\n}\n");
}
