/* test_threads.c: small renders by every integrator on four threads, meant for the thread sanitizer (make tsan); the
 * bytes must be those of one thread. */
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "render/render.h"
#include "helpers.h"
#include "tests.h"

static void test_way(struct test *t, const struct scene *scene, const char *integrator, const char *what)
{
    size_t n = (size_t)scene->width * (size_t)scene->height * 3;
    float *image[2];
    for (int i = 0; i < 2; i++) {
        struct film film;
        struct error err;
        struct render_options o = {.integrator = integrator_find(integrator), .end = 40, .n_threads = i == 0 ? 1 : 4,
                                   .seed = test_seed(t)};
        film_init(&film, render_crop(scene), scene->width, scene->height);
        film_keep_strategies(&film, 4);
        o.max_depth = 4;
        CHECK(t, render_scene(scene, &o, &film, &err), "%s", err.text);
        image[i] = mem_alloc(n, sizeof(float));
        film_develop(&film, 1, image[i]);
        film_free(&film);
    }
    CHECK(t, memcmp(image[0], image[1], n * sizeof(float)) == 0, "%s: four threads give other bytes than one", what);
    free(image[0]);
    free(image[1]);
}

void test_threads(struct test *t)
{
    static const char *const selections[] = {"bins", "pool", "vertices", "subspaces", "lvc", "combinatorial"};
    struct scene scene;
    if (!scene_from_file(t, "scenes/test/light-kinds.pbrt", 40, 24, &scene))
        return;
    test_way(t, &scene, "pt", "pt");
    test_way(t, &scene, "lt", "lt");
    test_way(t, &scene, "bdpt", "bdpt");
    for (int i = 0; i < (int)(sizeof selections / sizeof selections[0]); i++) {
        settings_set(&scene.settings, "select", selections[i], "test");
        test_way(t, &scene, "asbdpt", selections[i]);
    }
    scene_free(&scene);
}
