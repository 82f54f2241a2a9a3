/* pairs.c: see pairs.h. */
#include "learning/pairs.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"

static const double KAPPA = 4; /* trials of mean weight that the pair above counts for */

void pair_lessons_init(struct pair_lessons *l, const struct regions *eye, const struct regions *light)
{
    memset(l, 0, sizeof *l);
    l->n_eye = eye->n;
    l->n_light = light->n;
    l->worth = mem_alloc((size_t)eye->n * (size_t)light->n, sizeof *l->worth);
    l->weight = mem_alloc((size_t)eye->n * (size_t)light->n, sizeof *l->weight);
}

void pair_lessons_free(struct pair_lessons *l)
{
    free(l->worth);
    free(l->weight);
    memset(l, 0, sizeof *l);
}

static size_t entry(int e, int y, int n_light) { return (size_t)e * (size_t)n_light + (size_t)y; }

/* The pair above: both one level up, or the finer one alone until they are of the same level. False at the top. */
static bool pair_above(const struct regions *eye, const struct regions *light, int *e, int *y)
{
    const struct region *re = &eye->region[*e], *ry = &light->region[*y];
    if (*e == 0 && *y == 0)
        return false;
    if (re->level <= ry->level && *e != 0)
        *e = re->above;
    if (ry->level <= re->level && *y != 0)
        *y = ry->above;
    return true;
}

void pair_lessons_add(struct pair_lessons *l, const struct regions *eye, const struct regions *light, int e, int y,
                      double x, double w)
{
    l->total += w;
    l->trials++;
    do {
        l->worth[entry(e, y, l->n_light)] += w * x;
        l->weight[entry(e, y, l->n_light)] += w;
    } while (pair_above(eye, light, &e, &y));
}

/* m(e,l) of all pairs into `m`. A pair comes after the one above it. */
static void shrink(const struct pair_lessons *l, const struct regions *eye, const struct regions *light, double *m)
{
    double prior = l->trials > 0 ? KAPPA * l->total / l->trials : 1;
    for (int e = 0; e < l->n_eye; e++)
        for (int y = 0; y < l->n_light; y++) {
            size_t i = entry(e, y, l->n_light);
            int e_above = e, y_above = y;
            double above = pair_above(eye, light, &e_above, &y_above) ? m[entry(e_above, y_above, l->n_light)] : 0;
            m[i] = (l->worth[i] + prior * above) / (l->weight[i] + prior);
        }
}

void pairs_build(struct pairs *p, const struct pair_lessons *l, const struct regions *eye, const struct regions *light,
                 const double *vertices, int n_vertices, double delta)
{
    size_t n = (size_t)l->n_light;
    double *m = mem_alloc((size_t)l->n_eye * n, sizeof *m), all = 0;
    shrink(l, eye, light, m);
    p->n_eye = l->n_eye;
    p->n_light = l->n_light;
    p->h = mem_alloc((size_t)l->n_eye * n, sizeof *p->h);
    for (int y = 0; y < n_vertices; y++)
        all += vertices[y];
    for (int e = 0; e < p->n_eye; e++) {
        const double *row = &m[(size_t)e * n];
        double mean = 0;
        for (int y = 0; y < n_vertices; y++)
            mean += vertices[y] * row[y];
        for (size_t y = 0; y < n; y++)
            p->h[(size_t)e * n + y] =
                mean > 0 ? (1 - delta) * row[y] / mean + delta / all : all > 0 ? 1 / all : 1;
    }
    free(m);
}

void pairs_from_row(struct pairs *p, const double *row, int n_light)
{
    p->n_eye = 1;
    p->n_light = n_light;
    p->h = mem_alloc((size_t)n_light, sizeof *p->h);
    for (int y = 0; y < n_light; y++)
        p->h[y] = row[y];
}

void pairs_free(struct pairs *p)
{
    free(p->h);
    memset(p, 0, sizeof *p);
}
