/* plan_scene.c: see plan_scene.h. */
#include "lab/plan_scene.h"

#include <stdio.h>
#include <string.h>

#include "base/os.h"
#include "parser/parser.h"
#include "render/parameters.h"

void plan_scene_name(const char *path, char *out, int size)
{
    const char *slash = os_last_separator(path), *start = slash != NULL ? slash + 1 : path;
    const char *end = strrchr(start, '.');
    if (end == NULL || strcmp(end, ".pbrt") != 0)
        end = start + strlen(start);
    if (slash != NULL && strcmp(start, "scene.pbrt") == 0) { /* NAME/scene.pbrt */
        end = slash;
        start = end;
        while (start > path && !os_separator(start[-1]))
            start--;
    }
    snprintf(out, (size_t)size, "%.*s", (int)(end - start), start);
}

bool plan_scene_read(const char *path, int width, int height, int max_depth, struct scene *scene, int *depth,
                     struct error *err)
{
    static const double whole[4] = {0, 1, 0, 1};
    if (!parse_scene(path, scene, NULL, err))
        return false;
    parameters_adapt(scene, method_list(), NULL);
    /* Widths of plans go up to 8192 and films up to 65536 a side: below 2^30. */
    int by_aspect = (int)(0.5 + (double)width * scene->height / scene->width);
    memcpy(scene->crop, whole, sizeof whole);
    scene->width = width;
    scene->height = height > 0 ? height : by_aspect > 1 ? by_aspect : 1;
    filter_default("box", &scene->filter);
    if (!parameters_max_depth(scene, max_depth, depth, err)) {
        scene_free(scene);
        return false;
    }
    scene_prepare(scene);
    return true;
}

bool plan_scene_load(const struct plan *p, const char *path, const char *name, struct scene *scene, int *depth,
                     struct reference *stored, struct error *err)
{
    int width = p->width > 0 ? p->width : WIDTH_WITHOUT_REFERENCE, height = p->height, max_depth = p->max_depth;
    if (!reference_find(p->reference, path, name, stored, err))
        return false;
    if (p->width == 0 && stored->pixels != NULL) {
        width = stored->width;
        height = stored->height;
        max_depth = max_depth > 0 ? max_depth : (int)stored->max_depth;
    }
    bool ok = plan_scene_read(path, width, height, max_depth, scene, depth, err);
    if (!ok || stored->pixels == NULL || reference_fit(stored, scene->width, scene->height, *depth, err))
        return ok;
    reference_free(stored);
    if (p->reference == NULL)
        return true;
    scene_free(scene);
    return false;
}
