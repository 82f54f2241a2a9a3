/* plan.c: see plan.h. */
#include "learning/plan.h"

#include "base/maths.h"
#include "base/number.h"

const struct plan PLAN_TRIED = {{4, 4, 4, 0.25}};
static const struct plan PLAN_USUAL = {{3, 1, 2, 1}};

/* The choice moves from the usual numbers by BOLDNESS of the way, on a logarithmic scale: more samples of a kind also
 * take over weight from others, so its variance falls more slowly than 1/n. */
static const double BOLDNESS = 2.0 / 3;

/* What plan_costs does not count, keeping a pool of light sub-paths and choosing from it, as a factor of all costs. */
static const double KEEPING = 1.08;

/* CONNECTION, POINT: what a connection, and a light point with its connection, cost in rays; measured. */
struct costs plan_costs(const struct importance *means)
{
    const double CONNECTION = 0.6, POINT = 0.8;
    double n_first = means->first_vertices, n_later = means->eye_vertices - n_first;
    struct costs c = {1 + means->eye_vertices + POINT * n_later,
                      {CONNECTION * n_first, CONNECTION * n_later, POINT * n_first,
                       1 + (1 + CONNECTION) * means->light_vertices}};
    return c;
}

bool plan_paths_pay(const struct costs *c, const struct noise *s, const struct plan *p)
{
    double paths = c->fixed + c->each[LIGHT_FIRST] * p->n[LIGHT_FIRST], all = paths;
    for (int k = 0; k < N_KINDS; k++)
        all += k == LIGHT_FIRST ? 0 : c->each[k] * p->n[k];
    return (s->total + s->tail) * paths > KEEPING * s->total * all;
}

struct plan plan_numbers(const struct costs *c, const struct noise *s)
{
    const double LEAST = 0.2, LEAST_PATH = 0.02; /* shares of the variance that A and light sub-paths have at least */
    const double LOW[N_KINDS] = {0.25, 0.125, 1, 1.0 / 64}, HIGH[N_KINDS] = {16, 8, 8, 1};
    double A = fmax(s->total - s->given_eye, LEAST * s->total), b[N_KINDS], drawn = 0;
    struct plan p = PLAN_USUAL;
    if (!(s->total > 0))
        return p;
    for (int k = 0; k < LIGHT_PATH; k++)
        drawn += b[k] = s->spread[k];
    b[LIGHT_PATH] = fmax(fmax(s->given_eye, s->blocks) - drawn, LEAST_PATH * s->total);
    for (int k = 0; k < N_KINDS; k++) {
        double best = c->each[k] > 0 ? sqrt(b[k] * PLAN_TRIED.n[k] / c->each[k] * c->fixed / A) : p.n[k];
        p.n[k] = clamp(p.n[k] * m_pow(fmax(best, 1e-3) / p.n[k], BOLDNESS), LOW[k], HIGH[k]);
    }
    return p;
}
