/* emit.c: see emit.h. */
#include "tables/emit.h"

rgb emit_sample(const struct emission *e, const struct light_set *lights, const struct geometry *geo, const double u[3],
                double direction[2], struct light_point *at, struct ray *ray, double *pdf, double *pdf_mis)
{
    double rho;
    *pdf = *pdf_mis = 0;
    if (lights->choice.n == 0)
        return rgb_black();
    int cell = emission_draw(e, lights, u[0], direction, &rho);
    if (!light_sample_cell(lights, geo, cell, u[1], u[2], at))
        return rgb_black();
    rgb emitted = light_sample_emission(lights, at, direction, ray, pdf);
    *pdf *= rho;
    bool several = lights->n_infinite > 1 && lights->light[at->light].kind == LIGHT_INFINITE;
    *pdf_mis = several ? emit_pdf(e, lights, at, ray->o, ray->d) : *pdf;
    return emitted;
}

double emit_pdf(const struct emission *e, const struct light_set *lights, const struct light_point *y0, vec3 p, vec3 w)
{
    bool infinite = y0->light < 0 || lights->light[y0->light].kind == LIGHT_INFINITE;
    double pdf = infinite ? 1 / (PI * sqr(lights->radius)) : light_pdf_emission(lights, y0, w);
    struct light_point at = *y0;
    if (infinite && lights->n_infinite > 1)
        at.light = -1;
    return pdf > 0 ? pdf * emission_density(e, lights, &at, p, w) : pdf;
}
