/* method.c: see method.h. */
#include "integrators/method.h"

#include <stdlib.h>
#include <string.h>

const char *const OFF_ON[] = {"off", "on", NULL};
const char *const RACES[] = {"off", "on", "all", "quarter", "quarter_first", "path_tracer", NULL};

const struct field *method_has(const struct method *m, const char *name)
{
    static const struct field select = {"select", FIELD_WORD, 0, 0, 0, 0, "", NULL};
    const struct field *f = m->parameters != NULL ? field_find(m->parameters, name) : NULL;
    if (f == NULL && m->own != NULL)
        f = field_find(m->own, name);
    return m->select != NULL && strcmp(name, select.name) == 0 ? &select : f;
}

bool method_read(const struct method *m, const struct scene *scene, struct prepared *p, struct error *err)
{
    const struct settings *s = &scene->settings;
    *p = (struct prepared){.method = m, .parameters = {.numbers = m->numbers, .emission = 1, .delta = 1, .spread = 1,
                                                       .tile = DEFAULT_TILE_SIZE}};
    p->own = m->own_size > 0 ? mem_alloc(1, m->own_size) : NULL;
    bool ok = (m->parameters == NULL || settings_fields(s, m->parameters, &p->parameters, err)) &&
              (m->own == NULL || settings_fields(s, m->own, p->own, err)) &&
              (m->check == NULL || m->check(p, scene, err));
    if (!ok)
        free(p->own);
    return ok;
}
