/* strays.c: see strays.h. */
#include "render/strays.h"

#include "transport/path.h"

/* Is the way from a to b, the next vertex, through media in which it cannot be? */
static bool astray(const struct scene *s, const struct vertex *a, const struct vertex *b)
{
    if (b->kind == VERTEX_ESCAPED)
        return b->medium != 0;
    vec3 d = sub(b->p, a->p);
    struct passage way = vertex_pass(s, a, normalize(d), length(d), b->prim_id);
    const int *sides = b->kind == VERTEX_SURFACE ? shape_group_of(&s->geo, (int)b->prim_id - 1)->medium : NULL;
    return way.strayed > 0 || (sides != NULL && sides[0] != sides[1] && sides[dot(b->ng, d) < 0] != way.medium);
}

int strays_count(const struct scene *scene)
{
    enum { LENGTH = 8 };
    const struct mis_counts counts = {.direct = {1, 1}}; /* nobody asks for weights */
    struct arena arena = {NULL, NULL};
    int strays = 0;
    for (int i = 0; scene->media.n > 0 && i < 2 * STRAYS_PATHS; i++) {
        struct sampler sampler = sampler_start(0, RNG_LEARN, (uint64_t)i, 0);
        const struct walk walk = {scene, &counts, &arena, &sampler, 0};
        struct vertex path[LENGTH];
        double u, v;
        sampler_r2(i, &u, &v);
        arena_reset(&arena);
        int n = i % 2 == 0 ? path_eye(&walk, u * scene->width, v * scene->height, path, LENGTH)
                           : path_light(&walk, path, LENGTH), k = 1;
        while (k < n && !astray(scene, &path[k - 1], &path[k]))
            k++;
        strays += k < n;
    }
    arena_free(&arena);
    return strays;
}
