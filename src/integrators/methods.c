/* methods.c: the table of rendering methods (method.h). A new method is a new line here. */
#include <string.h>

#include "integrators/asbdpt.h"
#include "integrators/bdpt.h"
#include "integrators/method.h"

static const struct method *const METHODS[] = {&method_pt, &method_lt, &method_bdpt, &method_asbdpt, NULL};

const struct method *const *method_list(void) { return METHODS; }

const struct method *method_find(const char *name)
{
    if (strcmp(name, "path") == 0)
        name = "pt";
    for (const struct method *const *m = METHODS; *m != NULL; m++)
        if (strcmp((*m)->name, name) == 0)
            return *m;
    return NULL;
}
