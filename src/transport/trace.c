/* trace.c: see trace.h. */
#include "transport/trace.h"

#include <stdlib.h>
#include <string.h>

void trace_free(struct trace *trace)
{
    for (int i = 0; i < trace->n_lights; i++)
        free(trace->light[i].vertex);
    free(trace->eye.vertex);
    free(trace->light);
    free(trace->connection);
    memset(trace, 0, sizeof *trace);
}

/* Copy the vertices that are not there yet. */
static void copy(struct trace_path *to, const struct vertex *path, int n)
{
    to->source = path;
    to->vertex = mem_grow(to->vertex, &to->capacity, (size_t)n, sizeof *to->vertex);
    for (; to->n < n; to->n++) {
        to->vertex[to->n] = path[to->n];
        to->vertex[to->n].bsdf.lobe = NULL;
        to->vertex[to->n].lamp = NULL;
    }
}

void trace_eye_path(struct trace *trace, const struct vertex *path, int n, double filter_weight)
{
    trace->filter_weight = filter_weight;
    copy(&trace->eye, path, n);
}

int trace_light_path(struct trace *trace, const struct vertex *path, int n)
{
    int i = 0;
    while (i < trace->n_lights && trace->light[i].source != path)
        i++;
    if (i == trace->n_lights) {
        struct trace_path empty = {NULL, 0, 0, NULL};
        trace->light = mem_grow(trace->light, &trace->light_capacity, (size_t)i + 1, sizeof *trace->light);
        trace->light[trace->n_lights++] = empty;
    }
    copy(&trace->light[i], path, n);
    return i;
}

void trace_connect(struct trace *trace, int s, int t, const struct vertex *light, const struct connection *c,
                   double pmf, double scale, rgb added)
{
    int path = light != NULL ? trace_light_path(trace, light, s) : -1;
    struct trace_connection made = {s, t, path, pmf, *c, scale, added};
    size_t n = (size_t)trace->n_connections + 1;
    trace->connection = mem_grow(trace->connection, &trace->connection_capacity, n, sizeof *trace->connection);
    trace->connection[trace->n_connections++] = made;
}

rgb trace_sum(const struct trace *trace)
{
    rgb sum = rgb_black();
    for (int i = 0; i < trace->n_connections; i++)
        if (trace->connection[i].t > 1)
            sum = rgb_add(sum, trace->connection[i].added);
    return sum;
}

static bool before(const struct brought *a, const struct brought *b)
{
    if (a->luminance != b->luminance)
        return a->luminance > b->luminance;
    if (a->iteration != b->iteration)
        return a->iteration < b->iteration;
    return a->y != b->y ? a->y < b->y : a->x < b->x;
}

static bool same_sample(const struct brought *a, const struct brought *b)
{
    return a->x == b->x && a->y == b->y && a->iteration == b->iteration;
}

void worst_offer(struct worst *w, struct brought b)
{
    int i = 0;
    while (i < w->n && !same_sample(&w->item[i], &b))
        i++;
    if (i == w->most) /* a sample that is not among them: it takes the place of the last, or none */
        i--;
    if (!(b.luminance > 0) || !fits_float(b.luminance) || (i < w->n && !before(&b, &w->item[i])))
        return;
    w->n += i == w->n;
    for (; i > 0 && before(&b, &w->item[i - 1]); i--)
        w->item[i] = w->item[i - 1];
    w->item[i] = b;
}

/* The walk from the other end leaves vertex i+1 towards i; what it is per steradian there was found on the way. */
double trace_pdf_rev(const struct scene *scene, const struct trace_path *path, int i)
{
    if (i + 2 >= path->n || path->vertex[i].kind == VERTEX_LENS)
        return -1;
    const struct vertex *v = &path->vertex[i], *next = &path->vertex[i + 1];
    if (vertex_at_infinity(scene, v))
        return next->pdf_rev;
    double cosine = length2(v->ng) > 0 ? abs_dot(v->ng, next->wo) : 1;
    double spread = next->kind == VERTEX_ESCAPED ? 1 : 1 / length2(sub(v->p, next->p));
    return next->pdf_rev * cosine * spread;
}
