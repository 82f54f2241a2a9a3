/* equal_time.c: see equal_time.h. */
#include "lab/equal_time.h"

#include <math.h>
#include <stdlib.h>

#include "base/file.h"
#include "base/maths.h"
#include "base/number.h"

const struct variant EQUAL_VARIANTS[EQUAL_MAX] = {
    {"bdpt", "BDPT", "bdpt", NULL, 0, 0, true, false},
    {"vertices", "ASBDPT vertices", "asbdpt", "vertices", 0, 0, true, false},
    {"subspaces", "ASBDPT subspaces", "asbdpt", "subspaces", 0, 0, true, true},
    {"lvc", "light vertex cache", "asbdpt", "lvc", 0, 0, true, false},
    {"combinatorial", "combinatorial BDPT", "asbdpt", "combinatorial", 0, 0, true, false},
    {.name = NULL},
};

enum { SEED_BASE = 5000, MOST_SAMPLES = 1 << 20 };
static const double NEAR = 0.03; /* how far t should be from T at most, as a share of T */

int equal_variants(void)
{
    int n = 0;
    while (EQUAL_VARIANTS[n].name != NULL)
        n++;
    return n;
}

void equal_free(struct equal_time *e)
{
    free(e->scene);
    e->scene = NULL;
}

/* --- arithmetic -------------------------------------------------------------------------------------- */

long equal_seed(int variant, int i) { return SEED_BASE + 100L * variant + i; }

double equal_growth(long spp0, double seconds0, long spp1, double seconds1)
{
    double each = (seconds1 - seconds0) / (double)(spp1 - spp0); /* what one sample more costs */
    double growth = seconds1 / ((double)spp1 * each);
    return isfinite(growth) && growth > 0 ? clamp(growth, 1, 4) : 1;
}

long equal_samples(long spp, double seconds, double growth, double target)
{
    double wanted = (double)spp * (1 + growth * (target / seconds - 1));
    return isfinite(wanted) ? (long)clamp(floor(wanted + 0.5), 1, MOST_SAMPLES) : spp;
}

double equal_square(const struct equal_render *r, double noise8, enum equal_error which)
{
    double noise = isfinite(noise8) ? noise8 : 0;
    double square = which == EQUAL_RMSE8 ? r->rmse8 * r->rmse8 - noise * noise : r->relmse;
    return square * m_pow(r->seconds / r->target, r->growth);
}

struct interval equal_ratio(const struct equal_time *e, const struct equal_scene *s, int variant,
                            enum equal_error which)
{
    double ours[PLAN_MAX_SEEDS], bdpt[PLAN_MAX_SEEDS];
    int n = e->plan->n_seeds;
    for (int i = 0; i < n; i++) {
        ours[i] = equal_square(&s->render[variant][i], s->noise8, which);
        bdpt[i] = equal_square(&s->render[0][i], s->noise8, which);
    }
    return results_ratio(ours, n, bdpt, n);
}

struct equal_summary equal_summarize(const struct equal_time *e, int variant, enum equal_error which)
{
    struct equal_summary out = {NAN, NAN, NAN, "-", "-", 0};
    double log_sum = 0;
    for (const struct equal_scene *s = e->scene; s < e->scene + e->n_scenes; s++) {
        double ratio = equal_ratio(e, s, variant, which).value;
        if (!isfinite(ratio))
            continue;
        log_sum += m_log(ratio);
        if (!(out.best <= ratio)) {
            out.best = ratio;
            out.best_scene = s->name;
        }
        if (!(out.worst >= ratio)) {
            out.worst = ratio;
            out.worst_scene = s->name;
        }
        out.n++;
    }
    out.mean = out.n > 0 ? m_exp(log_sum / out.n) : NAN;
    return out;
}

/* --- files ------------------------------------------------------------------------------------------- */

void equal_csv(FILE *f, const struct equal_time *e)
{
    fputs("scene,variant,seed,spp,seconds,rmse8,relmse,target_seconds,growth,reference_noise8,nonfinite\n", f);
    for (const struct equal_scene *s = e->scene; s < e->scene + e->n_scenes; s++)
        for (int v = 0; v < equal_variants(); v++)
            for (const struct equal_render *r = s->render[v]; r < s->render[v] + e->plan->n_seeds; r++) {
                fprintf(f, "%s,%s,%ld,%ld,%.9g,%.9g,%.9g,%.9g,%.9g,", s->name, EQUAL_VARIANTS[v].name, r->seed, r->spp,
                        r->seconds, r->rmse8, r->relmse, r->target, r->growth);
                if (isfinite(s->noise8))
                    fprintf(f, "%.9g", s->noise8);
                fprintf(f, ",%ld\n", r->nonfinite);
            }
}

static const char *const ERROR_NAMES[N_EQUAL_ERRORS] = {"rmse8", "relmse"};

/* The columns: the scene, T, samples per pixel, and for each variant but the first both ratios. */
static void write_head(FILE *f)
{
    fputs("| scene | seconds | spp:", f);
    for (int v = 0; v < equal_variants(); v++)
        fprintf(f, "%s %s", v > 0 ? "," : "", EQUAL_VARIANTS[v].name);
    fputs(" |", f);
    for (int v = 1; v < equal_variants(); v++)
        for (int k = 0; k < N_EQUAL_ERRORS; k++)
            fprintf(f, " %s, %s |", EQUAL_VARIANTS[v].label, ERROR_NAMES[k]);
    fputs("\n|---|---:|---:|", f);
    for (int i = 0; i < (equal_variants() - 1) * N_EQUAL_ERRORS; i++)
        fputs("---:|", f);
    fputs("\n", f);
}

static void write_ratio(FILE *f, struct interval i)
{
    if (!isfinite(i.value))
        fputs(" - |", f);
    else if (!isfinite(i.low) || !isfinite(i.high))
        fprintf(f, " %.3f |", i.value);
    else
        fprintf(f, " %.3f [%.3f, %.3f] |", i.value, i.low, i.high);
}

/* A scene: means over seeds of T and of the samples, then the ratios. */
static void write_scene(FILE *f, const struct equal_time *e, const struct equal_scene *s)
{
    double seconds = 0;
    for (int i = 0; i < e->plan->n_seeds; i++)
        seconds += s->render[0][i].target / e->plan->n_seeds;
    fprintf(f, "| %s | %.3g |", s->name, seconds);
    for (int v = 0; v < equal_variants(); v++) {
        double spp = 0;
        for (int i = 0; i < e->plan->n_seeds; i++)
            spp += (double)s->render[v][i].spp / e->plan->n_seeds;
        fprintf(f, "%s %.4g", v > 0 ? "," : "", spp);
    }
    fputs(" |", f);
    for (int v = 1; v < equal_variants(); v++)
        for (int k = 0; k < N_EQUAL_ERRORS; k++)
            write_ratio(f, equal_ratio(e, s, v, (enum equal_error)k));
    fputs("\n", f);
}

/* All scenes together: a row for the mean, the best and the worst. */
static void write_summaries(FILE *f, const struct equal_time *e)
{
    static const char *const rows[] = {"geometric mean", "best", "WORST"};
    for (int row = 0; row < 3; row++) {
        fprintf(f, "| **%s** | | |", rows[row]);
        for (int v = 1; v < equal_variants(); v++)
            for (int k = 0; k < N_EQUAL_ERRORS; k++) {
                struct equal_summary s = equal_summarize(e, v, (enum equal_error)k);
                double value = row == 0 ? s.mean : row == 1 ? s.best : s.worst;
                if (!isfinite(value))
                    fputs(" - |", f);
                else if (row == 0)
                    fprintf(f, " **%.3f** of %d |", value, s.n);
                else
                    fprintf(f, " **%.3f** %s |", value, row == 1 ? s.best_scene : s.worst_scene);
            }
        fputs("\n", f);
    }
}

/* How well the times were met. */
static void write_times(FILE *f, const struct equal_time *e)
{
    for (int v = 0; v < equal_variants(); v++) {
        int near = 0, n = 0;
        long nonfinite = 0;
        double farthest = 0;
        for (const struct equal_scene *s = e->scene; s < e->scene + e->n_scenes; s++)
            for (const struct equal_render *r = s->render[v]; r < s->render[v] + e->plan->n_seeds; r++, n++) {
                double off = r->seconds / r->target - 1;
                near += fabs(off) <= NEAR;
                farthest = fabs(off) > fabs(farthest) ? off : farthest;
                nonfinite += r->nonfinite;
            }
        fprintf(f, "- %s: %d of %d renders took the given time within %.0f %%; the farthest was off by %+.1f %%.",
                EQUAL_VARIANTS[v].label, near, n, 100 * NEAR, 100 * farthest);
        if (nonfinite > 0)
            fprintf(f, " %ld values were no numbers and are left out.", nonfinite);
        fputs("\n", f);
    }
}

static void write_command(FILE *f, const struct equal_time *e)
{
    const struct plan *p = e->plan;
    fputs("\n    ./asbdpt experiment --equal-time", f);
    if (e->seconds > 0)
        fprintf(f, " %g", e->seconds);
    else
        fprintf(f, " --spp %ld", p->spp[p->n_steps - 1]);
    fprintf(f, " --seeds %d --reference-spp %ld", p->n_seeds, p->reference_spp);
    if (p->width > 0)
        fprintf(f, " --res %d", p->width);
    if (p->height > 0)
        fprintf(f, "x%d", p->height);
    if (p->max_depth > 0)
        fprintf(f, " --maxdepth %d", p->max_depth);
    if (p->reference != NULL)
        fprintf(f, " --reference %s", p->reference);
    fprintf(f, " -o %s", p->directory);
    for (int i = 0; i < p->n_scenes; i++)
        fprintf(f, "%s%s", i % 3 == 0 ? " \\\n        " : " ", p->scene[i]);
    fputs("\n", f);
}

void equal_table(FILE *f, const struct equal_time *e)
{
    fprintf(f,
            "Squared error over that of BDPT after the same CPU time, with its 95 %% interval over %d seed%s; below 1 "
            "is a gain\n\n",
            e->plan->n_seeds, e->plan->n_seeds == 1 ? "" : "s");
    write_head(f);
    for (const struct equal_scene *s = e->scene; s < e->scene + e->n_scenes; s++)
        write_scene(f, e, s);
    write_summaries(f, e);
    fputs("\nrmse8: of the squared error of 8-bit values, that of the reference itself subtracted where known; relmse: "
          "of the relative squared error of linear values as it stands. All with their default parameters, one thread. "
          "The samples per pixel were chosen by the time they take, with all that is prepared; what still differed "
          "between the time t taken and the given T is accounted for by error^2(T) = error^2(t) (t / T)^growth, growth "
          "being that of samples over time as measured.\n\n",
          f);
    write_times(f, e);
    write_command(f, e);
}

static bool write_file(const struct equal_time *e, const char *name, void (*write)(FILE *, const struct equal_time *),
                       struct error *err)
{
    char path[4096];
    struct file_output f;
    snprintf(path, sizeof path, "%s/%s", e->plan->directory, name);
    if (!file_create(path, &f, err))
        return false;
    write(f.stream, e);
    return file_commit(&f, err);
}

bool equal_write(const struct equal_time *e, struct error *err)
{
    return write_file(e, "equal-time.csv", equal_csv, err) && write_file(e, "equal-time.md", equal_table, err);
}
