/* test_reference.c: all methods against the stored references of the five scenes (ref/), tile by tile; the dissertation's
 * bins, with the same samples, are found out. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lab/compare.h"
#include "base/mem.h"
#include "lab/verify.h"
#include "helpers.h"
#include "tests.h"

enum { TILE = 8 }; /* pixels; smaller ones have means too skewed for the few samples of the quick test */

static bool load(struct test *t, const char *path, int *width, int *height, double **out)
{
    struct error err;
    float *pixels = load_linear(path, width, height, &err);
    if (!CHECK(t, pixels != NULL, "%s", err.text))
        return false;
    long n = 3L * *width * *height;
    *out = mem_alloc((size_t)n, sizeof **out);
    for (long i = 0; i < n; i++)
        (*out)[i] = (double)pixels[i];
    free(pixels);
    return true;
}

/* The stored picture with its errors, in tiles. */
static bool load_reference(struct test *t, const char *name, int *width, int *height, struct sample *out)
{
    char path[256];
    struct sample pixels = {.n_batches = 1};
    snprintf(path, sizeof path, "ref/%s.pfm", name);
    bool ok = load(t, path, width, height, &pixels.value);
    snprintf(path, sizeof path, "ref/%s.error.pfm", name);
    ok = ok && load(t, path, width, height, &pixels.error);
    if (ok) {
        pixels.n = 3L * *width * *height;
        *out = sample_tiles(&pixels, *width, *height, TILE);
    }
    sample_free(&pixels);
    return ok;
}

struct way {
    const char *name, *method, *select;
};

static const struct way WAYS[] = {
    {"pt", "pt", NULL},
    {"lt", "lt", NULL},
    {"bdpt", "bdpt", NULL},
    {"pool", "asbdpt", "pool"},
    {"vertices", "asbdpt", "vertices"},
    {"bins", "asbdpt", "bins"},
};

/* Is the word in the list? */
static bool listed(const char *list, const char *word)
{
    size_t n = strlen(word);
    for (const char *at = list; (at = strstr(at, word)) != NULL; at += n)
        if ((at == list || at[-1] == ' ') && (at[n] == ' ' || at[n] == '\0'))
            return true;
    return false;
}

/* Light tracing cannot see what reaches the lens by way of a mirror or glass only: lt has the boxes alone. */
static bool can(const struct way *w, const char *scene)
{
    return strcmp(w->name, "lt") != 0 || strncmp(scene, "cornell", 7) == 0;
}

static void test_way(struct test *t, const struct way *w, const char *name, struct scene *scene, const struct sample *reference,
                     int spp, int n_batches, uint64_t seed, bool must_hold)
{
    if (w->select != NULL)
        settings_set(&scene->settings, "select", w->select, "test");
    struct batches b = render_batches(t, scene, w->method, 0, spp, n_batches, TILE, seed);
    struct sample s = {b.n_batches, b.n, b.value, NULL};
    struct verdict v = verify_samples(&s, reference, seed, NULL);
    if (must_hold) {
        TEST_ACCEPT(t, v.smallest, "%s by %s against its reference, worst tile %ld", name, w->name, v.where / 3);
        TEST_ACCEPT(t, v.mean, "%s by %s against its reference, ratio of the means %.4f +- %.4f", name, w->name, v.ratio,
                    v.ratio_error);
        TEST_ACCEPT(t, v.uniform, "%s by %s against its reference, p-values of all tiles", name, w->name);
    } else {
        TEST_REJECT(t, v.p, "%s by %s against its reference, ratio of the means %.4f +- %.4f", name, w->name, v.ratio,
                    v.ratio_error);
    }
    batches_free(&b);
}

static void test_scene(struct test *t, const char *name, const char *ways, int spp, int n_batches, bool bins_rejected)
{
    char path[256];
    struct scene scene;
    struct sample reference;
    int width, height;
    if (!load_reference(t, name, &width, &height, &reference))
        return;
    snprintf(path, sizeof path, "scenes/%s.pbrt", name);
    if (scene_from_file(t, path, width, height, &scene)) {
        for (size_t i = 0; i < sizeof WAYS / sizeof WAYS[0]; i++) {
            bool bins = strcmp(WAYS[i].name, "bins") == 0;
            if (listed(ways, WAYS[i].name) && can(&WAYS[i], name) && (!bins || bins_rejected))
                test_way(t, &WAYS[i], name, &scene, &reference, spp, n_batches, 860 + i, !bins);
        }
        scene_free(&scene);
    }
    sample_free(&reference);
}

/* The few samples of the quick version are enough where a tile's mean is nearly normal: not for pt where light is rare. */
void test_references(struct test *t)
{
    test_scene(t, "cornell-box", "pt lt bdpt pool vertices bins", 16, 16, true);
    test_scene(t, "cornell-box-modified", "bdpt vertices", 8, 16, false);
    test_scene(t, "veach-ajar", "bdpt vertices", 8, 16, false);
    test_scene(t, "bathroom", "bdpt vertices", 8, 16, false);
    test_scene(t, "living-room", "bdpt vertices", 8, 16, false);
}

void test_references_long(struct test *t)
{
    static const char all[] = "pt lt bdpt pool vertices bins";
    test_scene(t, "cornell-box", all, 256, 16, true);
    test_scene(t, "cornell-box-modified", all, 256, 16, true);
    test_scene(t, "veach-ajar", all, 256, 16, true);
    test_scene(t, "bathroom", all, 256, 16, false);
    test_scene(t, "living-room", all, 256, 16, false);
}
