/* method.c: what is done with a row; see method.h. */
#include "integrators/method.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const SWITCH[] = {"off", "on", NULL};

#define AT(member) offsetof(struct frozen, services.member)
/* In the order of method_fields. */
static const struct field SERVICES[] = {
    {"guide", FIELD_WORD, AT(guide), 0, 0, 0, "choose lights by what a region sees, where there are several", SWITCH},
    {"emission", FIELD_NUMBER, AT(emission), 1, 1e-6, 1,
     "share of light sub-paths that leave lights as if nothing were learnt", NULL},
    {"credit", FIELD_WORD, AT(credit), 0, 0, 0, "measure what light that comes straight counts for", SWITCH},
    {"pilot", FIELD_WORD, AT(pilot), 0, 0, 0, "choose numbers of samples by what some tiles show", SWITCH},
    {"tile", FIELD_INTEGER, AT(tile), 0, 1, MAX_TILE_SIZE, "pixels along a side of those that share a pool", NULL},
    {"spread", FIELD_INTEGER, AT(spread), 0, 1, 64, "tiles that are interleaved along each axis", NULL},
    {.name = NULL}};

const struct field *method_has(const struct method *m, const char *name)
{
    static const struct field select = {"select", FIELD_WORD, 0, 0, 0, 0, "", NULL};
    if (m->select != NULL && strcmp(name, select.name) == 0)
        return &select;
    const struct field *own = m->parameters != NULL ? field_find(m->parameters, name) : NULL;
    return own != NULL || m->services.tile == 0 ? own : field_find(SERVICES, name);
}

void method_fields(const struct method *m, struct field out[METHOD_FIELDS])
{
    const struct field *own = m->parameters;
    const struct services *d = &m->services;
    const double fallback[] = {d->guide, d->emission, d->credit, d->pilot, d->tile, d->spread};
    while (own != NULL && own->name != NULL)
        *out++ = *own++;
    for (int i = 0; m->services.tile > 0 && SERVICES[i].name != NULL; i++) {
        *out = SERVICES[i];
        (*out++).fallback = fallback[i];
    }
    out->name = NULL;
}

static bool read(const struct method *m, const struct settings *s, void *state, struct error *err)
{
    struct field all[METHOD_FIELDS];
    method_fields(m, all);
    return settings_fields(s, all, state, err) && (m->check == NULL || m->check(state, err));
}

bool method_check(const struct method *m, const struct settings *s, struct error *err)
{
    void *state = mem_alloc(1, m->state_size);
    bool ok = read(m, s, state, err);
    free(state);
    return ok;
}

bool method_prepare(const struct method *m, const struct render_job *job, struct preparation *out, struct error *err)
{
    struct preparation standard = {.method = m, .state = mem_alloc(1, m->state_size),
                                   .size = {0, DEFAULT_TILE_SIZE, 1}};
    struct mis_counts bdpt = {{1, 1}, {1, 1}, {1, 1}, {1, 1}, pixel_light_count(job), .power = job->power_heuristic};
    struct frozen *f = standard.state;
    *out = standard;
    f->counts = bdpt;
    f->max_depth = job->max_depth;
    f->lights = f->path_pixels = 1;
    if (!read(m, &job->scene->settings, out->state, err)) {
        free(out->state);
        return false;
    }
    f->counts.splat /= f->path_pixels;
    if (f->services.tile > 0) {
        out->size.tile = f->services.tile;
        out->size.spread = f->services.spread;
    }
    if (m->prepare != NULL)
        m->prepare(job, out);
    return true;
}

void method_release(struct preparation *p)
{
    if (p->method->release != NULL)
        p->method->release(p->state);
    tables_free(&((struct frozen *)p->state)->tables);
    free(p->state);
}

void *method_scratch(const struct preparation *p)
{
    if (p->method->scratch_size == 0)
        return NULL;
    void *scratch = mem_alloc(1, p->method->scratch_size);
    if (p->method->scratch_init != NULL)
        p->method->scratch_init(scratch, p->state);
    return scratch;
}

void method_scratch_free(const struct preparation *p, void *scratch)
{
    if (scratch != NULL && p->method->scratch_free != NULL)
        p->method->scratch_free(scratch);
    free(scratch);
}
