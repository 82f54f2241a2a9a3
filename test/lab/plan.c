/* plan.c: see plan.h. */
#include "lab/plan.h"

#include <stdio.h>
#include <string.h>

#include "base/os.h"
#include "image/zlib.h"
#include "parser/parser.h"
#include "render/job.h"

bool plan_set_spp(struct plan *p, long first, long last, struct error *err)
{
    p->n_steps = 0;
    for (long n = first; n < last; n *= 2) {
        if (p->n_steps >= PLAN_MAX_STEPS - 1)
            return error_set(err, "more than %d doublings of the samples from %ld to %ld", PLAN_MAX_STEPS - 1, first,
                             last);
        p->spp[p->n_steps++] = n;
    }
    p->spp[p->n_steps++] = last;
    return true;
}

bool plan_set_methods(struct plan *p, const char *list, struct error *err)
{
    bool ok = methods_read(list, &p->methods, err);
    p->n_compared = p->methods.n;
    return ok;
}

bool plan_add_sweep(struct plan *p, const char *list, struct error *err)
{
    struct methods more;
    if (!methods_read(list, &more, err))
        return false;
    if (p->methods.n + more.n > METHODS_MAX)
        return error_set(err, "%s: too many methods", list);
    for (int i = 0; i < more.n; i++)
        if (methods_find(&p->methods, more.item[i].text) < 0)
            p->methods.item[p->methods.n++] = more.item[i];
    return true;
}

int plan_seeds(const struct plan *p, int method) { return method < p->n_compared ? p->n_seeds : 1; }

uint64_t plan_seed(const struct plan *p, int method, int i)
{
    const char *text = p->methods.item[method].text;
    uint64_t number = checksum_crc32(0, (const uint8_t *)text, strlen(text)) % 999983;
    return 1000000000 * p->seed + 1000 * number + (uint64_t)i; /* no two sets have a seed in common */
}

bool plan_create(const struct plan *p, const char *name, struct file_output *out, struct error *err)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", p->directory, name);
    return file_create(path, out, err);
}

void plan_write_command(FILE *f, const struct plan *p)
{
    fprintf(f, "    ./asbdpt-lab %s -o %s", p->command, p->directory);
    for (int i = 0; i < p->n_scenes; i++) {
        char path[4096];
        snprintf(path, sizeof path, "%s", p->scene[i]);
        error_clean(path);
        fprintf(f, "%s %s", i % 3 == 0 ? " \\\n       " : "", path);
    }
    fputs("\n\n", f);
}

/* --- scenes, and their stored references ---------------------------------------------------------------------- */

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
    error_clean(out); /* it is printed, and names files */
}

bool plan_scene_read(const char *path, int width, int height, int max_depth, struct scene *scene, int *depth,
                     struct error *err)
{
    static const double whole[4] = {0, 1, 0, 1};
    if (!parse_scene(path, NULL, scene, NULL, err))
        return false;
    job_adapt(scene, method_rows, NULL, NULL);
    if (width == 0)
        width = scene->width < WIDTH_WITHOUT_REFERENCE ? scene->width : WIDTH_WITHOUT_REFERENCE;
    memcpy(scene->crop, whole, sizeof whole);
    scene_resize(scene, width, height);
    filter_default("box", &scene->filter);
    struct render_job any = {.integrator = method_named(METHOD_REFERENCE), .max_depth = max_depth};
    struct prepared prepared;
    if (!job_settle(&any, scene, &prepared, err)) {
        scene_free(scene);
        return false;
    }
    *depth = any.max_depth;
    method_release(&prepared);
    scene_prepare(scene);
    return true;
}

/* At the plan's size and depth, or what it leaves open at the stored reference's, unless people could not see anything
 * in pictures of that size and nobody has asked for it. */
static bool read_planned(const struct plan *p, const char *path, const struct reference *stored, struct scene *scene,
                         int *depth, struct error *err)
{
    int width = p->width, height = p->height, max_depth = p->max_depth;
    if (width == 0 && stored->pixels != NULL && stored->width < WIDTH_TO_SEE && p->reference == NULL)
        width = WIDTH_TO_SEE;
    else if (width == 0 && stored->pixels != NULL) {
        width = stored->width;
        height = stored->height;
        max_depth = max_depth > 0 ? max_depth : (int)stored->max_depth;
    }
    return plan_scene_read(path, width, height, max_depth, scene, depth, err);
}

static void warn(const struct plan *p, const struct scene *scene, const char *path, const char *why)
{
    if (!p->quiet)
        say_line("asbdpt: warning: %s: %s: measured at %dx%d pixels, whatever the film's own are (see --res)", path,
                 why, scene->width, scene->height);
}

bool plan_scene_load(const struct plan *p, const char *path, const char *name, struct scene *scene, int *depth,
                     struct reference *stored, struct error *err)
{
    struct error why = {.text = "there is no stored reference"};
    bool given = p->reference != NULL;
    if (!reference_find(p->reference, path, name, stored, err) || !read_planned(p, path, stored, scene, depth, err))
        return false;
    bool found = stored->pixels != NULL, same = found && reference_is_of(stored, scene, given, &why);
    if (same && reference_fit(stored, scene->width, scene->height, *depth, &why))
        return true;
    reference_free(stored);
    if (given || (found && !same))
        scene_free(scene);
    if (given)
        return error_set(err, "%s", why.text);
    if (found && !same && !read_planned(p, path, stored, scene, depth, err)) /* not at the size of another's */
        return false;
    warn(p, scene, path, why.text);
    return true;
}

bool plan_names_differ(const struct plan *p, struct error *err)
{
    char name[PLAN_NAME], other[PLAN_NAME];
    for (int i = 0; i < p->n_scenes; i++) {
        plan_scene_name(p->scene[i], name, PLAN_NAME);
        for (int k = 0; k < i; k++) {
            plan_scene_name(p->scene[k], other, PLAN_NAME);
            if (strcmp(name, other) == 0)
                return error_set(err, "%s and %s have the same name, %s; experiment with them one at a time",
                                 p->scene[i], p->scene[k], name);
        }
    }
    return true;
}
