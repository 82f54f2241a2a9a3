/* trace_values.c: a pixel sample as names and numbers; see trace.h. */
#include <stdio.h>

#include "lab/trace.h"

enum { NAME = 32 };

static void print_number(FILE *f, const char *of, const char *name, double x)
{
    fprintf(f, "%s.%s %.9g\n", of, name, x);
}

static void print_rgb(FILE *f, const char *of, const char *name, rgb c)
{
    fprintf(f, "%s.%s %.9g %.9g %.9g\n", of, name, c.r, c.g, c.b);
}

static void print_vertex(FILE *f, const struct trace_story *s, const char *of, const struct vertex *v)
{
    vec3 p;
    if (!trace_place(s->scene, v, &p))
        p = add(p, s->scene->origin);
    fprintf(f, "%s.what %s\n", of, trace_what(s->scene, v));
    fprintf(f, "%s.p %.9g %.9g %.9g\n", of, p.x, p.y, p.z);
    print_rgb(f, of, "beta", v->beta);
    print_number(f, of, "luminance", rgb_luminance(v->beta));
    print_number(f, of, "F", v->pdf_fwd);
    print_number(f, of, "mis", v->mis);
    print_number(f, of, "c", v->mis_c);
}

static void print_connection(FILE *f, const struct trace_story *s, const char *of, const struct trace_connection *c)
{
    const struct trace_weight *w = &c->of;
    char joined[TRACE_JOINED], y[NAME];
    trace_name_joined(s->trace, c, joined);
    fprintf(f, "%s.s %d\n%s.t %d\n%s.joined %s\n", of, c->s, of, c->t, of, joined);
    print_rgb(f, of, "C", c->c.value);
    print_number(f, of, "times", c->scale);
    print_number(f, of, "weight", rgb_is_black(c->c.value) ? 0 : c->c.weight);
    print_rgb(f, of, "added", c->added);
    if (!(w->n > 0))
        return;
    print_number(f, of, "P", c->pmf);
    print_rgb(f, of, "f_y", w->f_y);
    print_rgb(f, of, "f_z", w->f_z);
    print_number(f, of, "cos_y", w->cos_y);
    print_number(f, of, "cos_z", w->cos_z);
    print_number(f, of, "d", w->distance);
    print_number(f, of, "n", w->n);
    print_number(f, of, "R_y", w->R_y);
    print_number(f, of, "R_z", w->R_z);
    print_number(f, of, "A", w->light_side);
    print_number(f, of, "B", w->eye_side);
    snprintf(y, sizeof y, "%s.y", of);
    if (c->light >= 0)
        print_vertex(f, s, y, &s->trace->light[c->light].vertex[c->s - 1]);
    snprintf(y, sizeof y, "%s.z", of);
    print_vertex(f, s, y, &s->trace->eye.vertex[c->t - 1]);
}

void trace_values(FILE *f, const struct trace_story *s)
{
    const struct trace *t = s->trace;
    const struct trace_connection *most = NULL;
    char of[NAME];
    int n = 0;
    fprintf(f, "at %d,%d\nsample %ld\nmethod %s\nK %d\n", t->x, t->y, t->iteration, s->integrator->name, t->n_pool);
    for (const struct chosen_number *m = t->number; m->name[0] != '\0'; m++)
        fprintf(f, "%s %.9g\n", m->name, m->value);
    for (int i = 0; i < t->eye.n; i++) {
        snprintf(of, sizeof of, "z.%d", i);
        print_vertex(f, s, of, &t->eye.vertex[i]);
    }
    for (const struct trace_connection *c = t->connection; c < t->connection + t->n_connections; c++) {
        if (c->t < 2)
            continue;
        snprintf(of, sizeof of, "c.%d", ++n);
        print_connection(f, s, of, c);
        if (c->s >= 2 && c->of.n > 0 && (most == NULL || rgb_luminance(c->added) > rgb_luminance(most->added)))
            most = c;
    }
    if (most != NULL)
        print_connection(f, s, "c.most", most);
    rgb sum = trace_sum(t), all = rgb_add(sum, t->splats);
    fprintf(f, "sum %.9g %.9g %.9g\nsplats.n %d\nsplats %.9g %.9g %.9g\npixel %.9g %.9g %.9g\n", sum.r, sum.g, sum.b,
            t->n_splats, t->splats.r, t->splats.g, t->splats.b, all.r, all.g, all.b);
}
