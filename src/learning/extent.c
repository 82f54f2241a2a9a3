/* extent.c: the pass that looks where eye vertices are; see training.h. */
#include <stdlib.h>

#include "learning/training.h"

enum { EXTENT_PATHS = 1024 };
static const double OUTSIDE = 0.01; /* share of vertices beyond either side of the extent, along each axis */

struct extent {
    double *along[3]; /* [n] coordinates of vertices, owned */
    size_t n, capacity[3];
};

static void trace(const struct pass *p, int thread, long i, struct findings *out)
{
    const struct vertex *eye = p->training->work[thread].eye;
    struct sampler sampler;
    int n = pass_eye(p, thread, i, STREAM_EXTENT, &sampler);
    for (int k = 1; k < n; k++)
        if (vertex_connectible(&eye[k])) {
            struct finding f = {.kind = EYE_VERTEX, .p = eye[k].p, .x = 1};
            findings_add(out, f);
        }
}

static void take(void *context, const struct finding *f)
{
    struct extent *e = context;
    const double p[3] = {f->p.x, f->p.y, f->p.z};
    for (int k = 0; k < 3; k++) {
        e->along[k] = mem_grow(e->along[k], &e->capacity[k], e->n + 1, sizeof *e->along[k]);
        e->along[k][e->n] = p[k];
    }
    e->n++;
}

static int by_size(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

void train_extent(struct training *t, vec3 *low, vec3 *high)
{
    struct extent e = {.n = 0};
    const struct light_set *lights = &t->job->scene->lights;
    struct pass pass = {t, &NO_TABLES, 0, EXTENT_PATHS, &e, NULL, trace, take};
    double side[2][3];
    pass_run(&pass);
    size_t outside = (size_t)(OUTSIDE * (double)e.n);
    for (int k = 0; k < 3 && e.n > 0; k++) {
        qsort(e.along[k], e.n, sizeof *e.along[k], by_size);
        side[0][k] = e.along[k][outside];
        side[1][k] = e.along[k][e.n - 1 - outside];
    }
    for (int k = 0; k < 3; k++)
        free(e.along[k]);
    *low = e.n > 0 ? vec(side[0][0], side[0][1], side[0][2]) : lights->center;
    *high = e.n > 0 ? vec(side[1][0], side[1][1], side[1][2]) : lights->center;
}
