/* strategy_files.c: render --strategies; see render_files.h. */
#include "cli/render_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/os.h"
#include "image/image.h"
#include "look/pyramid.h"
#include "render/parameters.h"

static const char SHEET[] = "pyramid.png";

char *path_in(const char *directory, const char *name)
{
    size_t size = strlen(directory) + strlen(name) + 2;
    char *out = mem_alloc(size, 1);
    snprintf(out, size, "%s/%s", directory, name);
    return out;
}

static char *picture_path(const char *directory, int s, int t, bool weighted)
{
    char name[64];
    snprintf(name, sizeof name, "d%02d_s%02d_t%02d_%s.pfm", s + t - 2, s, t, weighted ? "weighted" : "unweighted");
    return path_in(directory, name);
}

bool directory_possible(const char *directory, struct error *err)
{
    if (directory == NULL)
        return true;
    os_make_directory(directory); /* if that fails, creating a file says why */
    char *path = path_in(directory, "probe");
    bool ok = outputs_possible(path, err);
    free(path);
    return ok;
}

/* The path, which is given back, is that of no other file. */
static bool add_name(struct names *all, char *path, struct error *err)
{
    bool ok = names_add(all, FILE_WRITTEN, "--strategies", path, err);
    free(path);
    return ok;
}

bool strategies_check(const char *directory, const struct scene *scene, int max_depth, struct names *all,
                      struct error *err)
{
    int most = 0;
    if (directory == NULL)
        return true;
    if (!parameters_max_depth(scene, max_depth, &most, err))
        return false;
    if (most > STRATEGIES_MAX_DEPTH)
        return error_set(err, "--strategies: paths of up to %d edges have %d pictures; --maxdepth %d is the most here",
                         most + 1, (most + 1) * (most + 4), STRATEGIES_MAX_DEPTH);
    bool ok = add_name(all, path_in(directory, SHEET), err);
    for (int edges = 1; edges <= most + 1; edges++)
        for (int s = 0; ok && s <= edges; s++)
            ok = add_name(all, picture_path(directory, s, edges + 1 - s, false), err) &&
                 add_name(all, picture_path(directory, s, edges + 1 - s, true), err);
    return ok;
}

static bool write_picture(const char *directory, const struct film *film, double scale, int s, int t, bool weighted,
                          struct error *err)
{
    float *pixels = pyramid_strategy(film, scale, s, t, weighted);
    char *path = picture_path(directory, s, t, weighted);
    bool ok = image_write(path, rect_width(film->rect), rect_height(film->rect), pixels, err);
    free(path);
    free(pixels);
    return ok;
}

bool strategies_write(const char *directory, const struct film *film, double scale, struct error *err)
{
    bool ok = true;
    if (directory == NULL)
        return true;
    for (int edges = 1; edges <= film->strategies->max_depth + 1; edges++)
        for (int s = 0; ok && s <= edges; s++)
            ok = write_picture(directory, film, scale, s, edges + 1 - s, false, err) &&
                 write_picture(directory, film, scale, s, edges + 1 - s, true, err);
    char *path = path_in(directory, SHEET);
    ok = ok && pyramid_write(path, film, scale, err);
    free(path);
    return ok;
}
