/* trace_json.c: a pixel sample as JSON, every number with all its digits; see trace_report.h. doc/tour/trace.md has a
 * table of the keys. */
#include "base/json.h"
#include "lab/trace_report.h"

static void put_vec(struct json *j, const char *name, vec3 v)
{
    json_numbers(j, name, (const double[]){v.x, v.y, v.z}, 3);
}

static void put_rgb(struct json *j, const char *name, rgb c)
{
    json_numbers(j, name, (const double[]){c.r, c.g, c.b}, 3);
}

static void put_path(struct json *j, const char *name, const struct scene *scene, const struct trace_path *path)
{
    json_open(j, name, '[');
    for (int i = 0; i < path->n; i++) {
        const struct vertex *v = &path->vertex[i];
        double pdf_rev = trace_pdf_rev(scene, path, i);
        vec3 place;
        bool at_infinity = trace_place(scene, v, &place);
        json_open(j, NULL, '{');
        json_text(j, "what", trace_what(scene, v));
        json_number(j, "light", v->light);
        put_vec(j, at_infinity ? "towards" : "position", place);
        put_vec(j, "normal", v->ng);
        put_rgb(j, "beta", v->beta);
        json_text(j, "per", trace_measure(scene, v));
        json_number(j, "pdf_fwd", v->pdf_fwd);
        if (pdf_rev >= 0)
            json_number(j, "pdf_rev", pdf_rev);
        json_word(j, "left_by_delta", i + 1 < path->n && path->vertex[i + 1].prev_delta ? "true" : "false");
        json_close(j);
    }
    json_close(j);
}

static void put_connections(struct json *j, const struct trace *t)
{
    json_open(j, "connections", '[');
    for (int i = 0; i < t->n_connections; i++) {
        const struct trace_connection *c = &t->connection[i];
        json_open(j, NULL, '{');
        json_number(j, "s", c->s);
        json_number(j, "t", c->t);
        json_number(j, "light_path", c->light);
        json_number(j, "probability", c->pmf);
        put_rgb(j, "unweighted", c->c.value);
        json_number(j, "times", c->scale);
        json_number(j, "weight", c->c.weight);
        put_rgb(j, "added", c->added);
        if (c->s == 1 && !rgb_is_black(c->c.value)) {
            json_number(j, "light", c->c.light);
            put_vec(j, "end", c->c.end);
            json_number(j, "end_pdf", c->c.pdf);
        }
        if (c->t == 1 && !rgb_is_black(c->c.value)) {
            put_vec(j, "end", c->c.end);
            json_number(j, "x", c->c.px);
            json_number(j, "y", c->c.py);
        }
        json_close(j);
    }
    json_close(j);
}

void trace_json(FILE *f, const struct trace_story *s)
{
    const struct trace *t = s->trace;
    struct json j = json_start(f);
    json_open(&j, NULL, '{');
    json_text(&j, "scene", s->scene_path);
    json_text(&j, "integrator", s->integrator->name);
    json_number(&j, "x", t->x);
    json_number(&j, "y", t->y);
    json_number(&j, "sample", (double)t->iteration);
    json_count(&j, "seed", s->seed);
    json_number(&j, "filter_weight", t->filter_weight);
    put_path(&j, "eye_path", s->scene, &t->eye);
    json_open(&j, "light_paths", '[');
    for (int i = 0; i < t->n_lights; i++)
        put_path(&j, NULL, s->scene, &t->light[i]);
    json_close(&j);
    json_text(&j, "why", t->why);
    json_open(&j, "chosen", '{');
    for (const struct film_number *n = t->number; n->name != NULL; n++)
        json_number(&j, n->name, n->value);
    json_close(&j);
    put_connections(&j, t);
    put_rgb(&j, "sum", trace_sum(t));
    json_close(&j);
}
