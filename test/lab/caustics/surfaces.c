/* surfaces.c: see surfaces.h. */
#include "caustics/surfaces.h"

bool surfaces_alone(const struct prepared *p, const struct scene *scene, struct error *err)
{
    (void)p;
    return scene->space == NULL ||
           error_set(err, "this integrator knows of surfaces alone, and the scene has media; bdpt can render it");
}
