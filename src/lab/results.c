/* results.c: see results.h. */
#include "lab/results.h"

#include <math.h>
#include <stdlib.h>

#include "base/stats.h"

void results_free(struct results *r)
{
    for (int i = 0; r->scene != NULL && i < r->plan->n_scenes; i++) {
        reference_free(&r->scene[i].reference);
        for (int v = 0; v < N_METHODS; v++)
            free(r->scene[i].image[v]);
    }
    free(r->scene);
    r->scene = NULL;
}

static double step_value(const struct run_step *s, enum quantity q)
{
    switch (q) {
    case Q_SECONDS: return s->seconds;
    case Q_RMSE: return s->rmse;
    case Q_RMSE8: return s->rmse8;
    case Q_RELMSE: return s->relmse;
    case Q_MEAN_ERROR: return s->mean_error;
    }
    return NAN;
}

static struct estimate mean_of(const double *x, int n)
{
    struct estimate e = {NAN, NAN, n};
    double sum = 0, square = 0;
    for (int i = 0; i < n; i++)
        sum += x[i];
    if (n > 0)
        e.mean = sum / n;
    for (int i = 0; i < n; i++)
        square += (x[i] - e.mean) * (x[i] - e.mean);
    if (n > 1)
        e.error = sqrt(square / (n - 1) / n);
    return e;
}

struct estimate results_mean(const struct scene_results *s, int n_seeds, int variant, int step, enum quantity q)
{
    double x[PLAN_MAX_SEEDS];
    for (int i = 0; i < n_seeds; i++)
        x[i] = step_value(&s->run[variant][i].step[step], q);
    return mean_of(x, n_seeds);
}

double student_quantile(double p, double dof)
{
    double low = 0, high = 1;
    while (stats_student_p(high, dof) > p && high < 1e12)
        high *= 2;
    for (int i = 0; i < 100; i++) {
        double middle = 0.5 * (low + high);
        if (stats_student_p(middle, dof) > p)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

struct interval results_ratio(const double *a, int na, const double *b, int nb)
{
    struct estimate ea = mean_of(a, na), eb = mean_of(b, nb);
    struct interval out = {ea.mean / eb.mean, NAN, NAN};
    if (!(ea.mean > 0 && eb.mean > 0)) {
        out.value = NAN;
        return out;
    }
    if (na < 2 || nb < 2)
        return out;
    /* var ln x = var x / x^2; Welch's degrees of freedom. */
    double va = ea.error * ea.error / (ea.mean * ea.mean), vb = eb.error * eb.error / (eb.mean * eb.mean);
    double v = va + vb, dof = v > 0 ? v * v / (va * va / (na - 1) + vb * vb / (nb - 1)) : 1;
    double factor = exp(student_quantile(0.05, dof) * sqrt(v));
    out.low = out.value / factor;
    out.high = out.value * factor;
    return out;
}

struct interval results_rmse_ratio(const struct results *r, const struct scene_results *s, int variant, int step)
{
    double a[PLAN_MAX_SEEDS], b[PLAN_MAX_SEEDS];
    int na = plan_seeds(r->plan, variant), nb = plan_seeds(r->plan, VARIANT_BDPT);
    for (int i = 0; i < na; i++)
        a[i] = s->run[variant][i].step[step].rmse8;
    for (int i = 0; i < nb; i++)
        b[i] = s->run[VARIANT_BDPT][i].step[step].rmse8;
    return results_ratio(a, na, b, nb);
}

/* Squared error times seconds: what a method pays for the inverse of its variance. */
static double cost(const struct scene_results *s, const struct run_step *step)
{
    double noise = isfinite(s->reference.noise8) ? s->reference.noise8 : 0;
    return (step->rmse8 * step->rmse8 - noise * noise) * step->seconds;
}

struct interval results_equal_time(const struct results *r, const struct scene_results *s, int variant, int step)
{
    double a[PLAN_MAX_SEEDS], b[PLAN_MAX_SEEDS];
    int na = plan_seeds(r->plan, variant), nb = plan_seeds(r->plan, VARIANT_BDPT);
    for (int i = 0; i < na; i++)
        a[i] = cost(s, &s->run[variant][i].step[step]);
    for (int i = 0; i < nb; i++)
        b[i] = cost(s, &s->run[VARIANT_BDPT][i].step[step]);
    return results_ratio(a, na, b, nb);
}

struct bias results_bias(const struct results *r, const struct scene_results *s, int variant, int step)
{
    struct estimate e = results_mean(s, plan_seeds(r->plan, variant), variant, step, Q_MEAN_ERROR);
    struct bias out = {e.mean, NAN, NAN};
    double pixels = 0;
    for (int i = 0; i < e.n; i++)
        pixels += sqr(s->run[variant][i].step[step].mean_noise / e.n);
    double own = fmax(sqr(e.error), isfinite(pixels) ? pixels : 0);
    double total = own + (isfinite(s->reference.mean_error) ? sqr(s->reference.mean_error) : 0);
    if (e.n < 2 || !(own > 0))
        return out;
    out.error = sqrt(total);
    /* Welch's degrees of freedom; the reference's error is known from thousands of pixels. */
    out.p = stats_student_p(out.mean / out.error, sqr(total) / (sqr(own) / (e.n - 1)));
    return out;
}
