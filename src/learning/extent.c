/* extent.c: the pass that finds the box of the eye vertices; see training.h. */
#include <stdlib.h>

#include "learning/training.h"

enum { EXTENT_PATHS = 1024 };
static const double OUTSIDE = 0.01; /* share of vertices outside the box, on each side of each axis */

struct extent {
    double *along[3]; /* [n] coordinates of vertices, owned */
    size_t n;
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
        e->along[k] = mem_append(e->along[k], e->n, sizeof *e->along[k]);
        e->along[k][e->n] = p[k];
    }
    e->n++;
}

static int by_size(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

/* The box on one axis; *low and *high stay as they are if there is no vertex. */
static void find_ends(double *x, size_t n, double *low, double *high)
{
    size_t outside = (size_t)(OUTSIDE * (double)n);
    if (n > 0) {
        qsort(x, n, sizeof *x, by_size);
        *low = x[outside];
        *high = x[n - 1 - outside];
    }
    free(x);
}

void train_extent(struct training *t, vec3 *low, vec3 *high)
{
    struct extent e = {.n = 0};
    struct pass pass = {t, any_counts(&NO_TABLES), 0, EXTENT_PATHS, &e, trace, take};
    pass_run(&pass);
    *low = *high = t->job->scene->lights.center;
    find_ends(e.along[0], e.n, &low->x, &high->x);
    find_ends(e.along[1], e.n, &low->y, &high->y);
    find_ends(e.along[2], e.n, &low->z, &high->z);
}
