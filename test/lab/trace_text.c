/* trace_text.c: a pixel sample as a page to read, and in some ten lines: where the walks went, and what brought most; and as
 * names and numbers. See trace.h. */
#include <stdio.h>

#include "caustics/derived.h"
#include "lab/trace.h"

/* --- words ------------------------------------------------------------------------------------------- */

const char *trace_what(const struct scene *scene, const struct vertex *v)
{
    static const char *const lights[] = {
        [LIGHT_AREA] = "area light", [LIGHT_POINT] = "point light", [LIGHT_SPOT] = "spot light",
        [LIGHT_DISTANT] = "distant light", [LIGHT_INFINITE] = "infinite light"};
    switch (v->kind) {
    case VERTEX_LENS: return "lens";
    case VERTEX_LIGHT: return lights[scene->lights.light[v->light].kind];
    case VERTEX_SURFACE: return v->light >= 0 ? "area light" : vertex_material(scene, v);
    case VERTEX_MEDIUM: return "medium";
    case VERTEX_ESCAPED: return "escaped";
    }
    return "";
}

const char *trace_measure(const struct scene *scene, const struct vertex *v)
{
    switch (v->kind) {
    case VERTEX_LENS: return NULL;
    case VERTEX_LIGHT:
        return light_is_delta(&scene->lights.light[v->light]) ? "" : vertex_at_infinity(scene, v) ? "sr" : "m^2";
    case VERTEX_SURFACE: return "m^2";
    case VERTEX_MEDIUM: return "m^3";
    case VERTEX_ESCAPED: return "sr";
    }
    return NULL;
}

bool trace_place(const struct scene *scene, const struct vertex *v, vec3 *out)
{
    bool at_infinity = vertex_at_infinity(scene, v);
    *out = v->kind == VERTEX_ESCAPED ? neg(v->wo) : at_infinity ? v->wo : v->p;
    return at_infinity || v->kind == VERTEX_ESCAPED;
}

/* How a light sub-path's vertices are called: y_2, or y_2(5) where there are more sub-paths than one. */
static void name_y(const struct trace *t, int light, int i, char *out, size_t size)
{
    if (t->n_lights > 1)
        snprintf(out, size, "y_%d(%d)", i, light + 1);
    else
        snprintf(out, size, "y_%d", i);
}

void trace_name_joined(const struct trace *t, const struct trace_connection *c, char out[TRACE_JOINED])
{
    const size_t size = TRACE_JOINED;
    char y[32];
    if (c->s > 1)
        name_y(t, c->light, c->s - 1, y, sizeof y);
    else
        snprintf(y, sizeof y, c->s == 1 ? "light" : "");
    if (c->s == 0)
        snprintf(out, size, "z_%d itself", c->t - 1);
    else if (c->t == 1)
        snprintf(out, size, "%s - lens", y);
    else
        snprintf(out, size, "%s - z_%d", y, c->t - 1);
}

/* --- sub-paths --------------------------------------------------------------------------------------- */

/* Below 0: not known. */
static void print_density(FILE *f, double pdf, const char *measure, int width)
{
    if (pdf < 0 || measure == NULL)
        fprintf(f, "  %9s%*s", ".", width, "");
    else
        fprintf(f, "  %9.4g %s%-*s", pdf, measure[0] != '\0' ? "/" : "", width > 0 ? width - 2 : 0, measure);
}

static void print_path(FILE *f, const struct scene *scene, const struct trace_path *path, char letter)
{
    fprintf(f, "  %-6s %-17s %29s  %31s  %9s  %14s\n", "vertex", "what it is", "position", "beta: r g b", "pdf_fwd",
            "pdf_rev");
    for (int i = 0; i < path->n; i++) {
        const struct vertex *v = &path->vertex[i];
        bool delta = i + 1 < path->n && path->vertex[i + 1].prev_delta;
        char what[40];
        vec3 p;
        if (!trace_place(scene, v, &p))
            p = add(p, scene->origin);
        snprintf(what, sizeof what, "%s%s", trace_what(scene, v), delta ? ", delta" : "");
        fprintf(f, "  %c_%-4d %-17s %9.4g %9.4g %9.4g  %9.4g  %9.4g  %9.4g", letter, i, what, p.x, p.y, p.z, v->beta.r,
                v->beta.g, v->beta.b);
        print_density(f, v->pdf_fwd, trace_measure(scene, v), 5);
        print_density(f, trace_pdf_rev(scene, path, i), trace_measure(scene, v), 0);
        fprintf(f, "\n");
    }
}

static void print_paths(FILE *f, const struct trace_story *s)
{
    const struct trace *t = s->trace;
    fprintf(f, "\nEYE SUB-PATH, %d vert%s\n", t->eye.n, t->eye.n == 1 ? "ex" : "ices");
    print_path(f, s->scene, &t->eye, 'z');
    for (int i = 0; i < t->n_lights; i++) {
        fprintf(f, "\nLIGHT SUB-PATH");
        if (t->n_lights > 1)
            fprintf(f, " (%d)", i + 1);
        fprintf(f, ", %d vert%s\n", t->light[i].n, t->light[i].n == 1 ? "ex" : "ices");
        print_path(f, s->scene, &t->light[i], 'y');
    }
    fprintf(f,
            "\n  position  in the scene's unit, called m here; of what is infinitely far the direction towards it\n"
            "  beta      throughput on arrival: all factors so far over the densities of having sampled them; of z_i\n"
            "            dimensionless, of y_1, y_2 ... in W; of y_0 what it emits, in W/(m^2 sr) or W/sr\n"
            "  pdf_fwd   density with which this walk made the vertex: per area; if infinitely far, per solid angle;\n"
            "            of a light that is a point or a direction its probability\n"
            "  pdf_rev   density with which a walk from the other end, coming from the vertex below, would have made "
            "it;\n"
            "            \".\" where two more vertices would be needed: each connection has its own\n"
            "  delta     left by a mirror's or smooth glass' only direction; densities there are coefficients of "
            "deltas\n");
}

/* --- connections ------------------------------------------------------------------------------------- */

static void print_connection(FILE *f, const struct trace *t, const struct trace_connection *c)
{
    char strategy[32], joined[TRACE_JOINED], chance[16] = "";
    snprintf(strategy, sizeof strategy, "(%d,%d)", c->s, c->t);
    trace_name_joined(t, c, joined);
    if (c->pmf < 1)
        snprintf(chance, sizeof chance, "%.3g", c->pmf);
    fprintf(f, "  %-7s %-15s %-9s", strategy, joined, chance);
    if (rgb_is_black(c->c.value)) {
        fprintf(f, " %9d\n", 0);
        return;
    }
    fprintf(f, " %9.4g %9.4g %9.4g  %9.4g  %7.5f  %9.4g %9.4g %9.4g", c->c.value.r, c->c.value.g, c->c.value.b,
            c->scale, c->c.weight, c->added.r, c->added.g, c->added.b);
    if (c->t == 1)
        fprintf(f, "  at %.2f, %.2f", c->px, c->py);
    fprintf(f, "\n");
}

static int print_connections(FILE *f, const struct trace *t, bool splats)
{
    int n = 0;
    fprintf(f, "  %-7s %-15s %-9s %29s  %9s  %7s  %29s%s\n", "(s,t)", "joined",
            t->why != NULL && !splats ? "chosen" : "", "C*: r g b", "times", "weight", "added: r g b",
            splats ? "  at raster point" : "");
    for (int i = 0; i < t->n_connections; i++)
        if ((t->connection[i].t == 1) == splats) {
            print_connection(f, t, &t->connection[i]);
            n++;
        }
    return n;
}

/* Which strategies brought what, by the length of the path. */
static void print_shares(FILE *f, const struct trace *t)
{
    enum { MOST = 12 };
    double share[MOST][MOST] = {{0}}, total = rgb_luminance(trace_sum(t));
    int longest = 0;
    for (int i = 0; i < t->n_connections; i++) {
        const struct trace_connection *c = &t->connection[i];
        int edges = c->s + c->t - 1;
        if (c->t == 1 || edges >= MOST || rgb_is_black(c->added))
            continue;
        share[edges][c->s] += rgb_luminance(c->added);
        longest = edges > longest ? edges : longest;
    }
    if (!(total > 0))
        return;
    fprintf(f, "\n  Per cent of the sum, in luminance, by the path's edges and the strategy's s:\n    edges");
    for (int s = 0; s < longest; s++)
        fprintf(f, "  s =%3d", s);
    for (int edges = 1; edges <= longest; edges++) {
        fprintf(f, "\n    %5d", edges);
        for (int s = 0; s < edges; s++)
            fprintf(f, "  %6.2f", 100 * share[edges][s] / total);
    }
    fprintf(f, "\n");
}

void trace_text(FILE *f, const struct trace_story *s)
{
    const struct trace *t = s->trace;
    rgb sum = trace_sum(t);
    fprintf(f, "\n(s,t): a path of s vertices from the light, y_0 ... y_{s-1}, and t from the eye, z_{t-1} ... z_0.\n");
    print_paths(f, s);
    if (t->why != NULL)
        fprintf(f, "\nCHOICE of what to connect with: %s.\n", t->why);
    for (const struct chosen_number *n = t->number; n->name[0] != '\0'; n++)
        fprintf(f, "  chosen: %s %.3g\n", n->name, n->value);
    fprintf(f, "\nCONNECTIONS, t >= 2: C* times the next two columns is added to the pixel\n");
    print_connections(f, t, false);
    fprintf(f, "  %-84s %9.4g %9.4g %9.4g\n", "sum, which the film receives", sum.r, sum.g, sum.b);
    print_shares(f, t);
    fprintf(f, "\nCONNECTIONS, t = 1: light sub-paths joined to the lens, added wherever they are seen\n");
    if (print_connections(f, t, true) == 0)
        fprintf(f, "  none in this sample\n");
    fprintf(f,
            "\n  chosen  probability of the draw, where there was a choice\n"
            "  C*      what one sample of the strategy alone would contribute, not weighted: W/(m^2 sr)\n"
            "  times   1/number of samples, filter weight (%.4g here), 1/probability of the choice where that is made "
            "up for\n"
            "  weight  share of the strategy in multiple importance sampling; of one path they add up to 1 over (s,t)\n"
            "  0       nothing arrives: blocked, turned away, no light there, or outside the picture\n",
            t->filter_weight);
}

/* --- in some ten lines ---------------------------------------------------------------------------------------- */

enum { TOLD = 3 }; /* connections, those that contribute most */

/* "lens, mirror (delta), matte": what a walk met, in its order. */
static void print_walk(FILE *f, const struct scene *scene, const struct trace_path *path)
{
    for (int i = 0; i < path->n; i++) {
        bool delta = i + 1 < path->n && path->vertex[i + 1].prev_delta;
        fprintf(f, "%s %s%s", i > 0 ? "," : "", trace_what(scene, &path->vertex[i]), delta ? " (delta)" : "");
    }
    fprintf(f, ": %d vert%s.\n", path->n, path->n == 1 ? "ex" : "ices");
}

static bool is_splat(const struct trace_connection *c) { return c->t == 1; }

/* The connection that contributes most to the pixel, of those below `limit` and after it in order; NULL: none. */
static const struct trace_connection *next_most(const struct trace *t, const struct trace_connection *limit)
{
    const struct trace_connection *found = NULL;
    double below = limit != NULL ? rgb_luminance(limit->added) : INFINITY, most = 0;
    for (const struct trace_connection *c = t->connection; c < t->connection + t->n_connections; c++) {
        double brings = is_splat(c) ? 0 : rgb_luminance(c->added);
        if (brings > most && (brings < below || (brings <= below && c > limit))) {
            found = c;
            most = brings;
        }
    }
    return found;
}

static void print_most(FILE *f, const struct trace *t)
{
    const struct trace_connection *c = NULL;
    double sum = rgb_luminance(trace_sum(t));
    for (int i = 0; i < TOLD && (c = next_most(t, c)) != NULL; i++) {
        char joined[TRACE_JOINED];
        trace_name_joined(t, c, joined);
        fprintf(f, "  (%d,%d) %-15s %5.1f %% of the sum, with weight %.5f\n", c->s, c->t, joined,
                100 * rgb_luminance(c->added) / sum, c->c.weight);
    }
}

void trace_tell(FILE *f, const struct trace_story *s, bool all)
{
    const struct trace *t = s->trace;
    int tried[2] = {0}, bright[2] = {0}; /* those of the pixel, those joined to the lens */
    rgb sum = trace_sum(t);
    for (const struct trace_connection *c = t->connection; c < t->connection + t->n_connections; c++) {
        tried[is_splat(c)]++;
        bright[is_splat(c)] += !rgb_is_black(c->added);
    }
    fprintf(f, "%s, pixel %d,%d, sample %ld: %s, seed %llu\n", s->scene_path, t->x, t->y, t->iteration,
            s->integrator->name, (unsigned long long)s->seed);
    fputs("The eye sub-path:  ", f);
    print_walk(f, s->scene, &t->eye);
    if (t->n_lights > 0 && t->light[0].n > 0) {
        fputs("The light sub-path:", f);
        print_walk(f, s->scene, &t->light[0]);
    }
    if (t->n_lights > 1)
        fprintf(f, "  and %d light sub-path%s more.\n", t->n_lights - 1, t->n_lights > 2 ? "s" : "");
    if (t->why != NULL)
        fprintf(f, "CHOICE of what to connect with: %s.\n", t->why);
    race_print_winner(f, &t->race);
    fprintf(f, "Strategies (s,t) join s light and t eye vertices: %d tried, %d brought light to the pixel%s\n",
            tried[0], bright[0], bright[0] > TOLD ? ", most of all:" : bright[0] > 0 ? ":" : ".");
    print_most(f, t);
    fprintf(f, "The pixel receives %.4g %.4g %.4g.", sum.r, sum.g, sum.b);
    if (tried[1] > 0)
        fprintf(f, " Joined to the lens, %d of %d light vertices lit a pixel of the picture.", bright[1], tried[1]);
    fputs(all ? "\n" : "\nEvery vertex, density and weight, and what they mean: --all\n", f);
    if (all)
        trace_text(f, s);
}

/* --- as names and numbers ------------------------------------------------------------------------------------- */

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

static void print_joined(FILE *f, const struct trace_story *s, const char *of, const struct trace_connection *c)
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
        print_joined(f, s, of, c);
        if (c->s >= 2 && c->of.n > 0 && (most == NULL || rgb_luminance(c->added) > rgb_luminance(most->added)))
            most = c;
    }
    if (most != NULL)
        print_joined(f, s, "c.most", most);
    rgb sum = trace_sum(t), all = rgb_add(sum, t->splats);
    fprintf(f, "sum %.9g %.9g %.9g\nsplats.n %d\nsplats %.9g %.9g %.9g\npixel %.9g %.9g %.9g\n", sum.r, sum.g, sum.b,
            t->n_splats, t->splats.r, t->splats.g, t->splats.b, all.r, all.g, all.b);
}
