/* integrators.c: the table of integrators (integrator.h). A new integrator is a new line here. */
#include <string.h>

#include "integrators/asbdpt.h"
#include "integrators/bdpt.h"
#include "integrators/integrator.h"

static const struct integrator *const INTEGRATORS[] = {&integrator_pt, &integrator_lt, &integrator_bdpt,
                                                       &integrator_asbdpt, NULL};

const struct integrator *const *integrator_list(void) { return INTEGRATORS; }

const struct integrator *integrator_find(const char *name)
{
    if (strcmp(name, "path") == 0)
        name = "pt";
    for (const struct integrator *const *m = INTEGRATORS; *m != NULL; m++)
        if (strcmp((*m)->name, name) == 0)
            return *m;
    return NULL;
}
