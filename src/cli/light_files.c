/* light_files.c: render --lights; see render_files.h. */
#include "cli/render_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/os.h"
#include "image/image.h"
#include "scene/develop.h"

static char *path_in(const char *directory, const char *name)
{
    size_t size = strlen(directory) + strlen(name) + 2;
    char *out = mem_alloc(size, 1);
    snprintf(out, size, "%s/%s", directory, name);
    return out;
}

bool lights_possible(const char *directory, struct error *err)
{
    if (directory == NULL)
        return true;
    os_make_directory(directory); /* if that fails, creating a file says why */
    char *path = path_in(directory, "probe");
    bool ok = outputs_possible(path, err);
    free(path);
    return ok;
}

/* A group is called by its name, or by what it is. */
static char *picture_path(const char *directory, const struct light_set *lights, int i)
{
    static const char *const KINDS[] = {
        [LIGHT_AREA] = "area", [LIGHT_POINT] = "point", [LIGHT_SPOT] = "spot", [LIGHT_GONIOMETRIC] = "goniometric",
        [LIGHT_PROJECTION] = "projection", [LIGHT_DISTANT] = "distant", [LIGHT_INFINITE] = "infinite"};
    const struct light_group *g = &lights->group[i];
    char name[64];
    snprintf(name, sizeof name, "light%02d_%s.pfm", i, g->name != NULL ? g->name : KINDS[g->kind]);
    return path_in(directory, name);
}

bool lights_check(const char *directory, const struct scene *scene, struct names *all, struct error *err)
{
    const struct light_set *lights = &scene->lights;
    bool ok = directory == NULL || lights->n_groups <= LIGHT_MAX_GROUPS ||
              error_usage(err, "--lights: %d pictures, one for each light, and %d are the most here; lights with the "
                        "same \"string group\" are one", lights->n_groups, LIGHT_MAX_GROUPS);
    for (int i = 0; ok && directory != NULL && i < lights->n_groups; i++) {
        char *path = picture_path(directory, lights, i);
        ok = names_add(all, FILE_WRITTEN, "--lights", path, err);
        free(path);
    }
    return ok;
}

bool lights_write(const char *directory, const struct scene *scene, const struct film *film, struct error *err)
{
    float *pixels = mem_alloc(rect_pixels(film->rect) * 3, sizeof *pixels);
    bool ok = true;
    for (int i = 0; ok && directory != NULL && i < film->planes.lights; i++) {
        char *path = picture_path(directory, &scene->lights, i);
        film_develop_plane(film, 1 + i, scene->film_scale, pixels);
        ok = image_write(path, rect_width(film->rect), rect_height(film->rect), pixels, err);
        free(path);
    }
    free(pixels);
    return ok;
}
