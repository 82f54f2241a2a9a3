/* test_structure.c: generated scenes that measure efficiency (random_structure.h): all kinds are equally frequent,
 * load without warnings, and show light to the camera. */
#include <stdlib.h>
#include <string.h>

#include "helpers.h"
#include "lab/numbers.h"
#include "random_structure.h"
#include "suites.h"

enum { WIDTH = 16, HEIGHT = 12, SAMPLES = 16 };

/* The share of tiles of 4x4 pixels that show light; 0: the scene is refused. */
static double lit(struct test *t, const char *text)
{
    struct scene scene;
    if (!scene_from_text(t, text, &scene))
        return 0;
    scene.width = WIDTH;
    scene.height = HEIGHT;
    camera_prepare(&scene.camera, WIDTH, HEIGHT);
    struct batches b = render_batches(t, &scene, "bdpt", 5, SAMPLES, 1, 4, test_seed(t));
    double n = 0;
    for (long i = 0; i < b.n; i++)
        n += b.value[i] > 1e-4;
    n /= (double)b.n;
    batches_free(&b);
    scene_free(&scene);
    return n;
}

void test_structure(struct test *t)
{
    const char *kind[2 * N_STRUCTURES];
    for (uint64_t i = 0; i < 2 * N_STRUCTURES; i++) {
        char *text = random_structure(i, &kind[i]);
        double share = lit(t, text);
        CHECK(t, share > 0.4, "structure %d, %s: light in %.2f of the picture", (int)i, kind[i], share);
        for (uint64_t j = i / N_STRUCTURES * N_STRUCTURES; j < i; j++)
            CHECK(t, strcmp(kind[j], kind[i]) != 0, "%s comes twice of twelve", kind[j]);
        free(text);
    }
    CHECK(t, lit(t, "Film \"image\" WorldBegin Shape \"sphere\" LightSource \"point\" \"rgb I\" [0 0 0] WorldEnd") == 0,
          "light where there is none");
}
