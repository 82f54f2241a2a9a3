/* light_pass.c: the pass that learns which light sub-paths the camera can use (emission.h), and the pass that counts
 * the vertices of sub-paths that start by that table; see training.h. */
#include "learning/training.h"

static const double FIRST_VERTEX = 0.2; /* factor of the first vertex of a light sub-path in its worth */

/* --- emission ---------------------------------------------------------------------------------------- */

/* The worth of a light sub-path is that of its first ray. Its first vertex has a small factor, because s = 1 finds the
 * same light. */
static void trace_emission(const struct pass *p, int thread, long i, struct findings *out)
{
    const struct importance *importance = &p->counts.tables->importance;
    struct workspace *work = &p->training->work[thread];
    int n = pass_light(p, &work->arena, i, STREAM_LIGHT, work->light);
    if (n < 2)
        return;
    struct light_point at = vertex_light_point(&work->light[0]);
    struct finding f = {.kind = RAY_LEFT, .cell = at.cell};
    light_emission_numbers(&p->training->job->scene->lights, &at, work->light[1].p, neg(work->light[1].wo), f.u);
    f.x = FIRST_VERTEX * path_importance(importance, work->light, 2) +
          path_importance(importance, work->light + 1, n - 1);
    findings_add(out, f);
}

static void take_emission(void *context, const struct finding *f) { emission_sums_add(context, f->cell, f->u, f->x); }

struct tables train_emission(struct training *t, struct tables known, long n, double delta)
{
    struct emission_sums sums;
    const struct light_set *lights = &t->job->scene->lights;
    struct pass pass = {t, any_counts(&known), 0, n, &sums, trace_emission, take_emission};
    if (lights->choice.n == 0)
        return known;
    emission_sums_init(&sums, lights);
    pass_run(&pass);
    known.emission = emission_build(&sums, (double)n, delta);
    return known;
}

/* --- vertices ---------------------------------------------------------------------------------------- */

/* Sums over the connectible vertices of light sub-paths. */
struct light_pass {
    struct tables tables; /* learnt so far */
    double vertices, E;
    long n; /* sub-paths */
};

static void trace_vertices(const struct pass *p, int thread, long i, struct findings *out)
{
    const struct light_pass *l = p->context;
    struct workspace *work = &p->training->work[thread];
    int n = pass_light(p, &work->arena, i, STREAM_LIGHT, work->light);
    for (const struct vertex *y = work->light + 1; y < work->light + n; y++) {
        struct finding f = {.kind = LIGHT_VERTEX, .x = rgb_luminance(y->beta)};
        if (!vertex_connectible(y))
            continue;
        f.light = regions_key(&l->tables.light, y->p, vertex_side(y));
        findings_add(out, f);
    }
}

static void take_vertex(void *context, const struct finding *f)
{
    struct light_pass *l = context;
    struct importance *importance = &l->tables.importance;
    struct regions *light = &l->tables.light;
    int region = importance->vertices != NULL ? regions_add(light, f->light) : regions_find(light, f->light);
    l->vertices++;
    l->E += importance_in(importance, region);
    if (importance->vertices != NULL)
        importance->vertices[region] += 1.0 / (double)l->n;
}

/* This pass adds regions, so its walks must not look them up: the only table of the walks is emission. */
struct tables train_vertices(struct training *t, struct tables known, long first, long n)
{
    struct light_pass l = {.tables = known, .n = n};
    struct importance *importance = &l.tables.importance;
    const struct tables aim = {.emission = known.emission};
    struct pass pass = {t, any_counts(&aim), first, first + n, &l, trace_vertices, take_vertex};
    pass_run(&pass);
    importance->light_vertices = l.vertices / (double)n;
    importance->mean = l.E / (double)n;
    return l.tables;
}
