/* test_media.c: the scenes of scenes/media by all methods that render media: each has the expectation of bdpt, and a
 * planted fault is found. test_medium.c has closed forms, test_strategies.c one strategy after another. */
#include <stdio.h>
#include <string.h>

#include "helpers.h"
#include "tests.h"

enum { SIZE = 16, BATCHES = 12 };

/* `spp` of bdpt bring the noise down so far that what is `planted` is seen. Light sub-paths alone do not show what is
 * behind glass; eye sub-paths do not find a thread of light before long, nor chains of mmlt a lamp behind glass. */
static const struct {
    const char *name;
    int depth, spp;
    const char *without; /* these methods */
    double planted;
} SCENES[] = {{"fog-cornell", 6, 4, "", 0.3}, {"laser", 5, 8, "pt", 0.5}, {"milk-ball", 8, 8, "lt mmlt", 0.25},
              {"murky-water", 8, 16, "lt mmlt", 0.8}, {"nested", 6, 4, "", 0.3}, {"inside", 6, 8, "", 0.8}};
enum { N_SCENES = sizeof SCENES / sizeof SCENES[0] };

/* How many times the samples that SCENES says are taken, and how large tiles are. */
struct effort {
    int more, tile;
};

/* Batches of a Markov chain are renders of their own, and few. */
static bool is_chain(const char *way) { return strstr(way, "mlt") != NULL; }

static struct batches render(struct test *t, struct scene *scene, int i, const char *way, const struct effort *e)
{
    int spp = SCENES[i].spp * e->more * (strcmp(way, "pt") == 0 ? 4 : 1);
    const char *integrator = set_method(scene, way);
    if (is_chain(way))
        return independent_batches(t, scene, integrator, SCENES[i].depth, spp, BATCHES, e->tile, 873);
    return render_batches(t, scene, integrator, SCENES[i].depth, spp, BATCHES, e->tile,
                          strcmp(way, "bdpt") == 0 ? 871 : 872);
}

static void compare(struct test *t, struct scene *scene, int i, const char *way, const struct batches *right,
                    const struct effort *e)
{
    struct batches b = render(t, scene, i, way, e);
    check_agree(t, &b, right, false, is_chain(way) ? 0 : SCENES[i].planted, "%s: %s against bdpt", SCENES[i].name, way);
}

/* The first `n` scenes by these ways, which end with NULL. */
static void test_first(struct test *t, int n, const char *const *ways, struct effort e)
{
    for (int i = 0; i < n; i++) {
        char path[64];
        struct scene scene;
        snprintf(path, sizeof path, "scenes/media/%s.pbrt", SCENES[i].name);
        if (!scene_from_file(t, path, SIZE, SIZE, &scene))
            continue;
        struct batches right = render(t, &scene, i, "bdpt", &e);
        for (int k = 0; ways[k] != NULL; k++)
            if (strstr(SCENES[i].without, ways[k]) == NULL)
                compare(t, &scene, i, ways[k], &right, &e);
        batches_free(&right);
        scene_free(&scene);
    }
}

void test_media(struct test *t)
{
    static const char *const eye[] = {"pt", NULL}, *const light[] = {"lt", "asbdpt", NULL};
    test_first(t, N_SCENES, eye, (struct effort){1, SIZE});
    test_first(t, 3, light, (struct effort){1, SIZE});
}

void test_media_long(struct test *t)
{
    static const char *const ways[] = {"pt", "lt", "asbdpt", "asbdpt select=pool", "asbdpt select=vertices", "lvc",
                                       "cbdpt", "mbdpt", "pssmlt", "mmlt", NULL};
    test_first(t, N_SCENES, ways, (struct effort){4, SIZE / 2});
}
