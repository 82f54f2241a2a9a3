/* results.c: see results.h. */
#include "lab/results.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/alias.h"
#include "base/file.h"
#include "base/maths.h"
#include "lab/stats.h"

static const char *const NAMES[N_QUANTITIES] = {"seconds", "rmse8", "mean_error"};

void results_free(struct results *r)
{
    for (int i = 0; r->scene != NULL && i < r->plan->n_scenes; i++) {
        reference_free(&r->scene[i].reference);
        for (int v = 0; v < METHODS_MAX; v++)
            free(r->scene[i].image[v]);
    }
    free(r->scene);
    r->scene = NULL;
}

/* --- files ------------------------------------------------------------------------------------------- */

/* A field of a line of comma-separated values: in quotes where it has to be, whatever a scene is called. */
static void write_text(FILE *f, const char *text)
{
    const char *quote = strpbrk(text, ",\"\r\n") != NULL ? "\"" : "";
    fputs(quote, f);
    for (; *text != '\0'; text++)
        fputs(*text == '"' ? "\"\"" : (const char[]){*text, '\0'}, f);
    fputs(quote, f);
}

static void write_number(FILE *f, double v)
{
    if (isfinite(v))
        fprintf(f, ",%.9g", v);
    else
        fputc(',', f);
}

/* A line of runs.csv. */
static void write_run(FILE *f, const struct scene_results *s, int method, int seed, const struct run *run)
{
    const struct measured *m = &s->plan->methods.item[method];
    write_text(f, s->name);
    fprintf(f, ",%s,%" PRIu64 ",%ld", m->text, plan_seed(s->plan, method, seed + 1), run->spp);
    for (int q = 0; q < N_QUANTITIES; q++)
        write_number(f, run->value[q]);
    for (int k = 0; k < N_SQUARES; k++)
        write_number(f, run->square[k]);
    fprintf(f, ",%ld", run->nonfinite);
    write_number(f, s->plan->equal ? s->price[method][seed].before : NAN);
    write_number(f, s->plan->equal ? s->price[method][seed].each : NAN);
    fprintf(f, ",%s,%s,%s\n", MARKS[s->mark[method]], m->label,
            (const char *const[]){"", "choice", "services", "both"}[m->halves]);
}

void results_csv(FILE *f, const struct results *r)
{
    fputs("scene,method,seed,spp", f);
    for (int q = 0; q < N_QUANTITIES; q++)
        fprintf(f, ",%s", NAMES[q]);
    fputs(",mse8,relmse,relmse8x8,nonfinite,price_before,price_each,mark,label,half\n", f);
    for (const struct scene_results *s = r->scene; s < r->scene + r->plan->n_scenes; s++)
        for (int v = 0; v < r->plan->methods.n; v++)
            for (int i = 0; i < plan_seeds(r->plan, v); i++)
                for (int step = 0; step < r->plan->n_steps; step++)
                    write_run(f, s, v, i, &s->run[v][i][step]);
}

bool results_write(const struct results *r, const char *name, void (*write)(FILE *, const struct results *),
                   struct error *err)
{
    struct file_output f;
    if (!plan_create(r->plan, name, &f, err))
        return false;
    write(f.stream, r);
    return file_commit(&f, err);
}

/* --- statistics over seeds --------------------------------------------------------------------------- */

static struct estimate mean_of(const double *x, int n)
{
    struct estimate e = {n > 0 ? sum_of(x, n) / n : NAN, NAN, n};
    double square = 0;
    for (int i = 0; i < n; i++)
        square += sqr(x[i] - e.mean);
    if (n > 1)
        e.error = sqrt(square / (n - 1) / n);
    return e;
}

struct estimate results_mean(const struct scene_results *s, int method, int step, enum quantity q)
{
    double x[PLAN_MAX_SEEDS];
    int n = plan_seeds(s->plan, method);
    for (int i = 0; i < n; i++)
        x[i] = s->run[method][i][step].value[q];
    struct estimate e = mean_of(x, n);
    if (q == Q_MEAN_ERROR && isfinite(s->reference.mean_error))
        e.error = sqrt(sqr(e.error) + sqr((1 + e.mean) * s->reference.mean_error));
    return e;
}

void results_pairs(const double *half, int n, double *out)
{
    double all = 0;
    for (int i = 0; i < n; i++) {
        out[i] = 0;
        for (int j = 0; j < n; j++)
            out[i] += i != j ? half[i * n + j] / (n - 1) : 0;
        all += out[i] / n;
    }
    for (int i = 0; i < n; i++)
        out[i] = all + 2.0 * (n - 1) / (n - 2) * (out[i] - all);
}

bool results_by_pairs(const struct scene_results *s, int method)
{
    return plan_seeds(s->plan, method) >= 3 && s->plan->reference == NULL && s->reference.variance != NULL &&
           !s->lacks && s->mark[0] == MARK_NONE && s->mark[method] == MARK_NONE;
}

static double mean_square(const struct scene_results *s, int method, int step, enum square which)
{
    double sum = 0;
    int n = plan_seeds(s->plan, method);
    for (int i = 0; i < n; i++)
        sum += s->run[method][i][step].square[which] / n;
    return sum;
}

double results_doubt(const struct scene_results *s, int method, int step, enum square which)
{
    double sum = mean_square(s, method, step, which), noise = s->reference.noise[which];
    if (results_by_pairs(s, method))
        return 0;
    return noise <= sum ? sqr(noise / sum) : NAN;
}

double results_square(const struct scene_results *s, int method, int step, enum square which)
{
    return isnan(results_doubt(s, method, step, which)) ? NAN : mean_square(s, method, step, which);
}

double results_seconds(const struct scene_results *s, int method, int step)
{
    double sum = 0;
    int n = plan_seeds(s->plan, method);
    if (!s->plan->equal)
        return results_mean(s, method, step, Q_SECONDS).mean;
    for (int i = 0; i < n; i++)
        sum += s->price[method][i].before + s->price[method][i].each * (double)s->run[method][i][step].spp;
    return s->seconds * sum / n;
}

int results_marked(const struct results *r, int method)
{
    int n = 0;
    for (int i = 0; i < r->plan->n_scenes; i++)
        n += r->scene[i].mark[method] != MARK_NONE;
    return n;
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

struct interval results_ratio(const double *a, int na, const double *b, int nb, double doubt)
{
    struct estimate ea = mean_of(a, na), eb = mean_of(b, nb);
    struct interval out = {ea.mean / eb.mean, NAN, NAN};
    if (!(ea.mean > 0 && eb.mean > 0 && doubt >= 0)) {
        out.value = NAN;
        return out;
    }
    if (na < 2 || nb < 2)
        return out;
    /* var ln x = var x / x^2; Welch's degrees of freedom. */
    double va = sqr(ea.error / ea.mean), vb = sqr(eb.error / eb.mean), v = va + vb + doubt;
    double dof = v > 0 ? sqr(v) / (sqr(va) / (na - 1) + sqr(vb) / (nb - 1)) : 1;
    double factor = m_exp(student_quantile(0.05, dof) * sqrt(v));
    out.low = out.value / factor;
    out.high = out.value * factor;
    return out;
}

struct interval results_mean_log(const double *log, int n)
{
    struct estimate e = mean_of(log, n);
    double half = n > 1 ? student_quantile(0.05, n - 1) * e.error : NAN;
    struct interval out = {m_exp(e.mean), m_exp(e.mean - half), m_exp(e.mean + half)};
    return out;
}

struct interval results_over_first(const struct scene_results *s, int method, int step, bool paid)
{
    double x[2][PLAN_MAX_SEEDS], doubt = 0;
    int compared[2] = {method, 0}, n[2];
    for (int k = 0; k < 2; k++) {
        n[k] = plan_seeds(s->plan, compared[k]);
        for (int i = 0; i < n[k]; i++) {
            const struct run *r = &s->run[compared[k]][i][step];
            x[k][i] = paid ? r->square[SQUARE_MSE8] * r->value[Q_SECONDS] : r->value[Q_RMSE8];
        }
        doubt += paid ? results_doubt(s, compared[k], step, SQUARE_MSE8) : 0;
    }
    return results_ratio(x[0], n[0], x[1], n[1], doubt);
}
