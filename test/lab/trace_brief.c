/* trace_brief.c: a pixel sample in some ten lines: where the walks went, and what brought most. See trace_report.h. */
#include <stdio.h>

#include "lab/trace_report.h"

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
