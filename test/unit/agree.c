/* agree.c: see agree.h. */
#include "agree.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "helpers.h"
#include "lab/methods.h"

void check_agree(struct test *t, struct batches *a, const struct batches *b, bool paired, double planted,
                 const char *format, ...)
{
    char what[256];
    va_list args;
    va_start(args, format);
    vsnprintf(what, sizeof what, format, args);
    va_end(args);
    double ratio, p = (paired ? batches_paired_p : batches_p)(a, b, &ratio);
    TEST_ACCEPT(t, p, "%s: ratio %.4f", what, ratio);
    batches_scale(a, 1 + planted);
    p = (paired ? batches_paired_p : batches_p)(a, b, &ratio);
    if (planted != 0)
        TEST_REJECT(t, p, "%s: the first made %g %% brighter", what, 100 * planted);
    batches_free(a);
}

static struct batches render(struct test *t, struct scene *scene, const char *way, const struct agreement *a, int spp,
                             uint64_t seed)
{
    struct error err;
    const char *integrator = set_method(scene, way);
    const struct method *m = method_find(integrator, &scene->settings, &err);
    if (m != NULL && (method_is_chain(m) || method_merges(m))) /* batches would share what is prepared */
        return independent_batches(t, scene, integrator, a->depth, spp, a->batches, a->tile, test_seed(t) + seed);
    return render_batches(t, scene, integrator, a->depth, spp, a->batches, a->tile, seed);
}

void check_agreement_in(struct test *t, struct scene *scene, const struct agreement *a, int more)
{
    enum { SEED = 53 };
    char way[128];
    int used;
    struct batches right = render(t, scene, a->right, a, a->right_spp * more, SEED);
    for (const char *p = a->ways; sscanf(p, " %127[^,]%n", way, &used) == 1; p += used + (p[used] == ',')) {
        struct batches b = render(t, scene, way, a, a->spp * more, a->paired ? SEED : SEED + 1);
        check_agree(t, &b, &right, a->paired, a->planted, "%.60s: %s against %s", a->scene, way, a->right);
    }
    batches_free(&right);
}

void check_agreements(struct test *t, const struct agreement *a, size_t n, int more)
{
    for (; n > 0; a++, n--) {
        char path[128];
        struct scene scene;
        snprintf(path, sizeof path, "%.100s.pbrt", a->scene);
        if (!(strstr(a->scene, "WorldBegin") != NULL ? scene_from_text(t, a->scene, &scene)
                                                      : scene_from_file(t, path, a->width, a->height, &scene)))
            continue;
        check_agreement_in(t, &scene, a, more);
        scene_free(&scene);
    }
}
