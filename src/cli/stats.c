/* stats.c: what a render was of and how it went, for programs: one object of JSON [RFC 8259]; see cmd_render.h. */
#include <inttypes.h>
#include <math.h>

#include "base/os.h"
#include "base/version.h"
#include "cli/cmd_render.h"

double stats_us_per_path(const struct render_run *r)
{
    double paths = r->samples * (double)rect_pixels(r->film.rect);
    return paths > 0 ? 1e6 * r->cpu / paths : 0;
}

/* In quotes; a byte that is no part of UTF-8 becomes U+FFFD. NULL: null. */
static void quote(FILE *f, const char *text)
{
    fputs(text != NULL ? "\"" : "null", f);
    for (int n; text != NULL && *text != '\0'; text += n > 0 ? n : 1) {
        unsigned char c = (unsigned char)*text;
        n = printable_length(text);
        if (c == '"' || c == '\\')
            fprintf(f, "\\%c", c);
        else if (n > 0)
            fwrite(text, 1, (size_t)n, f);
        else
            fprintf(f, "\\u%04x", c < 0x80 ? c : 0xfffdu);
    }
    fputs(text != NULL ? "\"" : "", f);
}

static void put_text(FILE *f, const char *name, const char *text)
{
    fprintf(f, ",\n\"%s\": ", name);
    quote(f, text);
}

/* With 17 digits, so that it is read back as it was. */
static void put_number(FILE *f, const char *name, double value)
{
    if (isfinite(value))
        fprintf(f, ",\n\"%s\": %.17g", name, value);
    else
        put_text(f, name, NULL);
}

/* The values in force, from the scene, -P or the defaults, as they have been read. */
static void put_table(FILE *f, const struct field *p, const void *from)
{
    for (; p != NULL && p->name != NULL; p++) {
        const void *value = (const char *)from + p->place;
        if (p->kind == FIELD_WORD)
            put_text(f, p->name, p->words[*(const int *)value]);
        else
            put_number(f, p->name, p->kind == FIELD_INTEGER ? *(const int *)value : *(const double *)value);
    }
}

static void put_parameters(FILE *f, const struct render_job *job, const struct prepared *p)
{
    const struct method *m = job->integrator;
    fprintf(f, ",\n\"parameters\": {\n\"maxdepth\": %d", job->max_depth);
    put_number(f, "rrthreshold", job->rr_threshold);
    put_text(f, "lightsamplestrategy", LIGHT_STRATEGIES[job->strategy]);
    if (m->select != NULL)
        put_text(f, "select", m->select);
    put_table(f, m->parameters, &p->parameters);
    put_table(f, m->own, p->own);
    fputs("}", f);
}

void stats_write(FILE *f, const struct render_run *r)
{
    const struct film *film = &r->film;
    struct method_number chosen[METHOD_NUMBERS];
    method_numbers(&r->prepared, chosen);
    fprintf(f, "{\n\"version\": \"%s\"", VERSION);
    put_text(f, "scene", r->job.scene_path);
    for (int i = 0; i < r->pictures.n; i++) {
        fputs(i > 0 ? ", " : ",\n\"files\": [", f);
        quote(f, r->pictures.item[i].file.path);
    }
    fputs("]", f);
    put_text(f, "checkpoint", r->keep.checkpoint);
    put_text(f, "integrator", r->job.integrator->name);
    put_parameters(f, &r->job, &r->prepared);
    fprintf(f, ",\n\"seed\": %" PRIu64 ",\n\"film\": [%d, %d],\n\"corner\": [%d, %d]", r->job.seed,
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
    fprintf(f, ",\n\"chosen\": {\n\"%s\": %.17g", chosen->name, chosen->value);
    for (const struct method_number *n = chosen + 1; n->name != NULL; n++)
        put_number(f, n->name, n->value);
    fputs("}\n}\n", f);
}
