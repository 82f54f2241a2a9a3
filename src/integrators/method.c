/* method.c: see method.h. */
#include "integrators/method.h"

#include <stdlib.h>
#include <string.h>

const struct field *method_parameters(const struct method *m)
{
    static const struct field NONE = {.name = NULL};
    return m->parameters != NULL ? m->parameters : &NONE;
}

const struct field *method_has(const struct method *m, const char *name)
{
    static const struct field select = {"select", FIELD_WORD, 0, 0, 0, 0, "", NULL};
    return m->select != NULL && strcmp(name, select.name) == 0 ? &select : field_find(method_parameters(m), name);
}

static bool read(const struct method *m, const struct scene *scene, void *state, struct error *err)
{
    return settings_fields(&scene->settings, method_parameters(m), state, err) &&
           (m->check == NULL || m->check(state, scene, err));
}

bool method_check(const struct method *m, const struct scene *scene, struct error *err)
{
    void *state = mem_alloc(1, m->state_size);
    bool ok = read(m, scene, state, err);
    free(state);
    return ok;
}

bool method_prepare(const struct method *m, const struct render_job *job, struct preparation *out, struct error *err)
{
    struct preparation standard = {.method = m, .state = mem_alloc(1, m->state_size),
                                   .size = {0, DEFAULT_TILE_SIZE, 1}};
    struct frozen *f = standard.state;
    *out = standard;
    f->max_depth = job->max_depth;
    f->numbers = m->numbers;
    if (!read(m, job->scene, out->state, err)) {
        free(out->state);
        return false;
    }
    frozen_count(job, f, NO_CREDITS);
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
