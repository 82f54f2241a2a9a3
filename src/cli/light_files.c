/* light_files.c: render --lights; see render_files.h. */
#include "cli/render_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/os.h"
#include "image/image.h"

/* A group is called by its name, or by what it is. */
static char *picture_path(const char *directory, const struct light_set *lights, int i)
{
    static const char *const KINDS[] = {
        [LIGHT_AREA] = "area", [LIGHT_POINT] = "point", [LIGHT_SPOT] = "spot", [LIGHT_GONIOMETRIC] = "goniometric",
        [LIGHT_PROJECTION] = "projection", [LIGHT_DISTANT] = "distant", [LIGHT_INFINITE] = "infinite"};
    const struct light_group *g = &lights->group[i];
    size_t size = strlen(directory) + 64;
    char *out = mem_alloc(size, 1);
    snprintf(out, size, "%s/light%02d_%s.pfm", directory, i, g->name != NULL ? g->name : KINDS[g->kind]);
    return out;
}

bool lights_open(const char *directory, const struct scene *scene, struct names *all, struct outputs *out,
                 struct error *err)
{
    const struct light_set *lights = &scene->lights;
    if (directory == NULL)
        return true;
    if (lights->n_groups > LIGHT_MAX_GROUPS)
        return error_usage(err, "--lights: %d pictures, one for each light, and %d are the most here; lights with the "
                           "same \"string group\" are one", lights->n_groups, LIGHT_MAX_GROUPS);
    bool ok = true;
    os_make_directory(directory); /* if that fails, creating a file says why */
    for (int i = 0; ok && i < lights->n_groups; i++) {
        char *path = picture_path(directory, lights, i);
        ok = names_add(all, FILE_WRITTEN, "--lights", path, err) && outputs_add(out, path, false, err);
        if (ok)
            out->item[out->n - 1].plane = 1 + i;
        free(path);
    }
    return ok;
}
