/* cmd_info.c: asbdpt info SCENE: what is in a scene and how it was prepared. */
#include <stdio.h>

#include "base/os.h"
#include "base/progress.h"
#include "cli/command.h"
#include "cli/job_options.h"

static const char *const LIGHT_NAMES[] = {
    [LIGHT_AREA] = "area", [LIGHT_POINT] = "point", [LIGHT_SPOT] = "spot",
    [LIGHT_GONIOMETRIC] = "goniometric", [LIGHT_PROJECTION] = "projection",
    [LIGHT_DISTANT] = "distant", [LIGHT_INFINITE] = "infinite",
};

static void print_lights(const struct light_set *lights)
{
    enum { SHOWN = 16 };
    double total = 0;
    for (int i = 0; i < lights->n; i++)
        total += lights->light[i].power;
    printf("lights        %d\n", lights->n);
    for (int i = 0; i < lights->n && i < SHOWN; i++)
        printf("  %-11s power %.4g W (%.1f %%)\n", LIGHT_NAMES[lights->light[i].kind], lights->light[i].power,
               total > 0 ? 100 * lights->light[i].power / total : 0);
    if (lights->n > SHOWN)
        printf("  and %d more\n", lights->n - SHOWN);
}

static void print_scene(const struct scene *s, const struct integrator *m, double seconds)
{
    const struct kdtree *kd = &s->kd;
    struct pixel_rect crop = render_crop(s);
    printf("film          %dx%d, crop [%d,%d) x [%d,%d)\n", s->width, s->height, crop.x0, crop.x1, crop.y0, crop.y1);
    static const char *const KINDS[] = {"perspective", "orthographic", "environment"};
    printf("camera        %s, fov %g degrees, lens radius %g, at (%g, %g, %g)\n", KINDS[s->camera.kind],
           s->camera.kind == CAMERA_PERSPECTIVE ? s->camera.fov : 0, s->camera.lens_radius,
           s->camera.position.x, s->camera.position.y, s->camera.position.z);
    printf("integrator    %s\n", m->name);
    for (int i = 0; i < s->settings.n; i++) {
        struct error line; /* cleaned, as the file's words are */
        error_set(&line, "  %-11s %s", s->settings.item[i].name, s->settings.item[i].value);
        printf("%s\n", line.text);
    }
    printf("triangles     %d (%d vertices)\nquadrics      %d\nshapes        %d\n", s->geo.n_triangles,
           s->geo.n_vertices, s->geo.n_quadrics, s->geo.n_groups);
    printf("materials     %d\ntextures      %d (%d images)\n", s->n_materials, s->textures.n_textures,
           s->textures.n_images);
    print_lights(&s->lights);
    printf("bounds        (%g, %g, %g) to (%g, %g, %g)\n", (double)kd->lo[0], (double)kd->lo[1], (double)kd->lo[2],
           (double)kd->hi[0], (double)kd->hi[1], (double)kd->hi[2]);
    printf("kd-tree       %d nodes, %d references, depth %d, expected cost %.1f\n", kd->n_nodes, kd->n_items,
           kd->depth, kd->cost);
    printf("loaded in     %.2f s\n", seconds);
}

static int run(void *options)
{
    struct scene scene;
    const struct integrator *integrator;
    double start = os_wall_seconds();
    int status = job_load(options, &scene, &integrator);
    if (status == EXIT_OK) {
        print_scene(&scene, integrator, os_wall_seconds() - start);
        scene_free(&scene);
    }
    return status;
}

const struct command command_info = {
    "info", "describe a scene", {"SCENE.pbrt [options]"}, SCENE_OPTIONS, sizeof(struct job_options), run};
