/* trace.c: see trace.h. */
#include "transport/trace.h"

#include <stdlib.h>
#include <string.h>

void trace_free(struct trace *t)
{
    for (int i = 0; i < t->n_lights; i++)
        free(t->light[i].vertex);
    free(t->eye.vertex);
    free(t->light);
    free(t->connection);
    memset(t, 0, sizeof *t);
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

void trace_eye_path(struct trace *t, const struct vertex *path, int n, double filter_weight)
{
    t->filter_weight = filter_weight;
    copy(&t->eye, path, n);
}

int trace_light_path(struct trace *t, const struct vertex *path, int n)
{
    int i = 0;
    while (i < t->n_lights && t->light[i].source != path)
        i++;
    if (i == t->n_lights) {
        struct trace_path empty = {NULL, 0, 0, NULL};
        t->light = mem_grow(t->light, &t->light_capacity, (size_t)i + 1, sizeof *t->light);
        t->light[t->n_lights++] = empty;
    }
    copy(&t->light[i], path, n);
    return i;
}

void trace_connect(struct trace *t, int s, int for_t, const struct vertex *light, const struct connection *c,
                   double pmf, double scale, rgb added)
{
    int path = light != NULL ? trace_light_path(t, light, s) : -1;
    struct trace_connection made = {s, for_t, path, pmf, *c, scale, added};
    t->connection =
        mem_grow(t->connection, &t->connection_capacity, (size_t)t->n_connections + 1, sizeof *t->connection);
    t->connection[t->n_connections++] = made;
}

rgb trace_sum(const struct trace *t)
{
    rgb sum = rgb_black();
    for (int i = 0; i < t->n_connections; i++)
        if (t->connection[i].t > 1)
            sum = rgb_add(sum, t->connection[i].added);
    return sum;
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
