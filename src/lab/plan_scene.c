/* plan_scene.c: see plan_scene.h. */
#include "lab/plan_scene.h"

#include <stdio.h>
#include <string.h>

#include "base/os.h"
#include "lab/reference.h"
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

bool plan_scene_load(const struct plan *p, const char *path, const char *name, struct scene *scene, int *depth,
                     struct error *err)
{
    static const double whole[4] = {0, 1, 0, 1};
    int width = p->width, height = p->height, max_depth = p->max_depth, stored[3];
    if (width == 0 && reference_shape(p->reference, path, name, stored)) {
        width = stored[0];
        height = stored[1];
        max_depth = max_depth > 0 ? max_depth : stored[2];
    }
    if (!parse_scene(path, scene, NULL, err))
        return false;
    parameters_adapt(scene, NULL);
    width = width > 0 ? width : WIDTH_WITHOUT_REFERENCE;
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
