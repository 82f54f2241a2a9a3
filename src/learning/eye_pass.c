/* eye_pass.c: the pass that learns how much light the camera can use from a place (importance.h), and which lights the
 * place sees (guide.h); see training.h. */
#include "learning/training.h"
#include "transport/connect.h"

enum { LIGHTS_PER_VERTEX = 2 };        /* number of light points that each eye vertex tries, for the guide */
static const double GUIDE_DELTA = 0.2; /* share of s = 1 samples that choose lights by power */

struct eye_pass {
    struct tables tables; /* learnt so far */
    struct guide_sums lights; /* its sums are NULL if there is to be no guide */
};

static void trace(const struct pass *p, int thread, long i, struct findings *out)
{
    const struct eye_pass *e = p->context;
    struct training *l = p->training;
    struct sampler sampler;
    int n = pass_eye(p, thread, i, STREAM_EYE, &sampler);
    for (const struct vertex *z = l->work[thread].eye + 1; z < l->work[thread].eye + n; z++) {
        if (!vertex_connectible(z))
            continue;
        struct finding f = {.kind = EYE_VERTEX, .x = rgb_luminance(z->beta)};
        f.eye = regions_key(&e->tables.eye, z->p, vertex_side(z));
        f.light = regions_key(&e->tables.light, z->p, vertex_side(z));
        findings_add(out, f);
        f.kind = LIGHT_SEEN;
        for (int j = 0; e->lights.arrived != NULL && j < LIGHTS_PER_VERTEX; j++) {
            struct connection light = connect_direct(l->job->scene, &p->counts, z, &sampler, j, LIGHTS_PER_VERTEX);
            f.cell = light.cell;
            f.x = rgb_luminance(light.value);
            findings_add(out, f);
        }
    }
}

static void take(void *context, const struct finding *f)
{
    struct eye_pass *e = context;
    struct tables *t = &e->tables;
    int region = regions_add(&t->eye, f->eye);
    if (f->kind == LIGHT_SEEN) {
        guide_sums_add(&e->lights, &t->eye, region, f->cell, f->x);
        return;
    }
    if (t->importance.E != NULL)
        t->importance.E[regions_add(&t->light, f->light)] += f->x;
}

struct tables train_importance(struct training *t, struct tables known, long n, bool guide)
{
    struct eye_pass e = {.tables = known};
    struct pass pass = {t, any_counts(&NO_TABLES), 0, n, &e, trace, take};
    if (guide)
        guide_sums_init(&e.lights, &t->job->scene->lights, &known.eye);
    pass_run(&pass);
    if (guide)
        e.tables.guide = guide_build(&e.lights, &e.tables.eye, GUIDE_DELTA);
    return e.tables;
}
