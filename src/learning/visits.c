/* visits.c: the passes that look where sub-paths come to; see lessons.h. */
#include <stdlib.h>

#include "learning/lessons.h"
#include "transport/connect.h"

enum {
    EXTENT_PATHS = 1024,
    LIGHTS_PER_VERTEX = 2 /* light points tried from each eye vertex for the guide */
};
static const double OUTSIDE = 0.01;     /* share of vertices beyond either side of the extent, along each axis */
static const double GUIDE_DELTA = 0.2;  /* share of s = 1 samples that choose lights by power */
static const double FIRST_VERTEX = 0.2; /* what the first vertex of a light sub-path counts for in emission */

/* --- extent ------------------------------------------------------------------------------------------ */

struct extent {
    double *along[3]; /* [n] coordinates of vertices, owned */
    size_t n, capacity[3];
};

static void trace_extent(void *context, struct lessons *l, int thread, long i, struct findings *out)
{
    struct sampler sampler;
    (void)context;
    int n = lessons_eye(l, thread, i, STREAM_EXTENT, &sampler);
    for (int k = 1; k < n; k++)
        if (vertex_connectible(&l->work[thread].eye[k])) {
            struct finding f = {.kind = VISIT, .p = l->work[thread].eye[k].p, .x = 1};
            findings_add(out, f);
        }
}

static void take_extent(void *context, struct lessons *l, const struct finding *f)
{
    struct extent *e = context;
    const double p[3] = {f->p.x, f->p.y, f->p.z};
    (void)l;
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

void visits_extent(struct lessons *l, vec3 *low, vec3 *high)
{
    struct extent e = {.n = 0};
    const struct light_set *lights = &l->job->scene->lights;
    struct pass pass = {l, 0, EXTENT_PATHS, &e, NULL, trace_extent, take_extent};
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

/* --- eye sub-paths ----------------------------------------------------------------------------------- */

struct visits {
    struct guide_lessons lights;
    long n;
};

static void trace_visits(void *context, struct lessons *l, int thread, long i, struct findings *out)
{
    struct sampler sampler;
    (void)context;
    int n = lessons_eye(l, thread, i, STREAM_EYE, &sampler);
    for (int k = 1; k < n; k++) {
        const struct vertex *z = &l->work[thread].eye[k];
        if (!vertex_connectible(z))
            continue;
        struct finding f = {.kind = VISIT, .p = z->p, .p_side = vertex_side(z), .first = z->eye_end == FIRST_HIT};
        f.x = rgb_luminance(z->beta);
        findings_add(out, f);
        f.kind = LIGHT_SEEN;
        for (int j = 0; l->wish->guide && j < LIGHTS_PER_VERTEX; j++) {
            struct connection light = connect_direct(l->job->scene, &l->counts, z, &sampler, j, LIGHTS_PER_VERTEX);
            f.cell = light.cell;
            f.x = rgb_luminance(light.value);
            findings_add(out, f);
        }
    }
}

static void take_visit(void *context, struct lessons *l, const struct finding *f)
{
    struct visits *v = context;
    struct importance *importance = &l->learnt->importance;
    struct regions *eye = &l->learnt->eye, *light = &l->learnt->light;
    int region = regions_add(eye, regions_key(eye, f->p, f->p_side));
    if (f->kind == LIGHT_SEEN) {
        guide_lessons_add(&v->lights, eye, region, f->cell, f->x);
        return;
    }
    importance->eye_vertices += 1.0 / (double)v->n;
    importance->first_vertices += f->first / (double)v->n;
    if (l->wish->importance)
        importance_add(importance, regions_add(light, regions_key(light, f->p, f->p_side)), f->x);
}

void visits_run(struct lessons *l, long n)
{
    struct learnt *learnt = l->learnt;
    const struct light_set *lights = &l->job->scene->lights;
    struct visits v = {.n = n};
    struct pass pass = {l, 0, n, &v, NULL, trace_visits, take_visit};
    guide_lessons_init(&v.lights, lights);
    pass_run(&pass);
    if (l->wish->guide)
        guide_build(&learnt->guide, &v.lights, &learnt->eye, lights, GUIDE_DELTA);
    learnt->guided = l->wish->guide;
    learnt_freeze(learnt);
    guide_lessons_free(&v.lights);
}

/* --- light sub-paths --------------------------------------------------------------------------------- */

/* What a light sub-path is worth is a lesson about how it begins. Its first vertex counts little: what comes from there
 * is what s = 1 finds as well. */
static void trace_emission(void *context, struct lessons *l, int thread, long i, struct findings *out)
{
    struct workspace *work = &l->work[thread];
    int n = lessons_light(l, &work->arena, i, STREAM_LIGHT, work->light);
    (void)context;
    if (n < 2)
        return;
    struct light_point at = vertex_light_point(&work->light[0]);
    struct finding f = {.kind = LIGHT_LEFT, .cell = at.cell};
    light_emission_numbers(&l->job->scene->lights, &at, work->light[1].p, neg(work->light[1].wo), f.u);
    f.x = FIRST_VERTEX * importance_of_path(&l->learnt->importance, work->light, 2) +
          importance_of_path(&l->learnt->importance, work->light + 1, n - 1);
    findings_add(out, f);
}

static void take_emission(void *context, struct lessons *l, const struct finding *f)
{
    (void)l;
    emission_lessons_add(context, f->cell, f->u, f->x);
}

void visits_emission(struct lessons *l, long n)
{
    struct emission_lessons lessons;
    const struct light_set *lights = &l->job->scene->lights;
    struct pass pass = {l, 0, n, &lessons, NULL, trace_emission, take_emission};
    if (lights->choice.n == 0)
        return;
    emission_lessons_init(&lessons, lights);
    pass_run(&pass);
    emission_build(&l->learnt->emission, &lessons, lights, (double)n, l->wish->emission);
    l->learnt->aimed = true;
    learnt_freeze(l->learnt);
    emission_lessons_free(&lessons);
}

/* Sums over the connectible vertices of light sub-paths; I = luminance(beta) E. */
struct light_sums {
    double vertices, E, I, square; /* square: of I */
    long n;                        /* sub-paths */
};

static void trace_light(void *context, struct lessons *l, int thread, long i, struct findings *out)
{
    struct workspace *work = &l->work[thread];
    int n = lessons_light(l, &work->arena, i, STREAM_LIGHT, work->light);
    (void)context;
    for (int k = 1; k < n; k++) {
        const struct vertex *y = &work->light[k];
        struct finding f = {.kind = LIGHT_VERTEX, .p = y->p, .p_side = vertex_side(y), .x = rgb_luminance(y->beta)};
        if (vertex_connectible(y))
            findings_add(out, f);
    }
}

static void take_light(void *context, struct lessons *l, const struct finding *f)
{
    struct light_sums *s = context;
    struct importance *importance = &l->learnt->importance;
    struct regions *light = &l->learnt->light;
    uint64_t key = regions_key(light, f->p, f->p_side);
    int region = l->wish->pairs ? regions_add(light, key) : regions_find(light, key);
    double E = importance_in(importance, region), I = f->x * E;
    s->vertices++;
    s->E += E;
    s->I += I;
    s->square += I * I;
    if (l->wish->pairs)
        importance_add_light(importance, region, 1.0 / (double)s->n);
}

void visits_light(struct lessons *l, long first, long n)
{
    struct importance *importance = &l->learnt->importance;
    struct light_sums s = {.n = n};
    struct pass pass = {l, first, first + n, &s, NULL, trace_light, take_light};
    l->learnt->model.locate = NULL; /* while regions are added */
    pass_run(&pass);
    learnt_freeze(l->learnt);
    importance->light_vertices = s.vertices / (double)n;
    importance->mean = s.E / (double)n;
    importance->useful = s.square > 0 ? s.I * s.I / (s.square * s.vertices) : 1;
}
