/* learnt.c: see learnt.h. */
#include "learning/learnt.h"

#include <string.h>

static void locate(const void *learnt, vec3 p, vec3 side, int *eye_region, int *light_region)
{
    const struct learnt *l = learnt;
    *eye_region = region_at(&l->eye, p, side);
    *light_region = region_at(&l->light, p, side);
}

static double connect_factor(const void *learnt, int y, int e)
{
    const struct learnt *l = learnt;
    return pairs_row(&l->pairs, e)[y];
}

static int choose_light(const void *learnt, const struct light_set *lights, int e, double u, double *pmf)
{
    const struct learnt *l = learnt;
    return guide_choose(&l->guide, lights, e, u, pmf);
}

static double direct_factor(const void *learnt, const struct light_set *lights, int e, int cell, vec3 w)
{
    const struct learnt *l = learnt;
    return guide_ratio(&l->guide, lights, e, cell, w);
}

static int choose_emission(const void *learnt, const struct light_set *lights, double u, double direction[2],
                           double *rho)
{
    const struct learnt *l = learnt;
    return emission_choose(&l->emission, lights, u, direction, rho);
}

static double emission_factor(const void *learnt, const struct light_set *lights, const struct light_point *y0, vec3 p,
                              vec3 w)
{
    const struct learnt *l = learnt;
    return emission_ratio(&l->emission, lights, y0, p, w);
}

void learnt_freeze(struct learnt *l)
{
    struct count_model m = {.learnt = l, .locate = locate};
    m.connect = l->paired ? connect_factor : NULL;
    m.choose_light = l->guided ? choose_light : NULL;
    m.direct = l->guided ? direct_factor : NULL;
    m.choose_emission = l->aimed ? choose_emission : NULL;
    m.emission = l->aimed ? emission_factor : NULL;
    l->model = m;
}

void learnt_free(struct learnt *l)
{
    regions_free(&l->eye);
    regions_free(&l->light);
    importance_free(&l->importance);
    guide_free(&l->guide);
    emission_free(&l->emission);
    pairs_free(&l->pairs);
    memset(l, 0, sizeof *l);
}
