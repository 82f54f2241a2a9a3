/* equal_time.c: see equal_time.h. */
#include "lab/equal_time.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/maths.h"
#include "base/number.h"
#include "base/os.h"
#include "lab/csv.h"
#include "lab/table.h"

enum { SEED_BASE = 5000, MOST_SAMPLES = 1 << 20 };

void equal_free(struct equal_time *e)
{
    free(e->scene);
    e->scene = NULL;
}

/* --- arithmetic -------------------------------------------------------------------------------------- */

bool equal_met(double seconds, double target) { return fabs(seconds / target - 1) <= EQUAL_PERCENT / 100.0; }

bool equal_comparable(double seconds, double target)
{
    return fabs(seconds / target - 1) <= EQUAL_FARTHEST / 100.0;
}

long equal_seed(int method, int i) { return SEED_BASE + 100L * method + i; }

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
    double square = which == EQUAL_RMSE8 ? r->rmse8 * r->rmse8 - noise * noise :
                    which == EQUAL_RELMSE ? r->relmse : r->blocks;
    return equal_comparable(r->seconds, r->target) ? square * m_pow(r->seconds / r->target, r->growth) : NAN;
}

struct interval equal_ratio(const struct equal_time *e, const struct equal_scene *s, int method,
                            enum equal_error which)
{
    double ours[PLAN_MAX_SEEDS], first[PLAN_MAX_SEEDS];
    int n = e->plan->n_seeds;
    for (int i = 0; i < n; i++) {
        ours[i] = equal_square(&s->render[method][i], s->noise8, which);
        first[i] = equal_square(&s->render[0][i], s->noise8, which);
    }
    return results_ratio(ours, n, first, n);
}

struct equal_summary equal_summarize(const struct equal_time *e, int method, enum equal_error which)
{
    struct equal_summary out = {NAN, NAN, NAN, "-", "-", 0};
    double log_sum = 0;
    for (const struct equal_scene *s = e->scene; s < e->scene + e->n_scenes; s++) {
        double ratio = equal_ratio(e, s, method, which).value;
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

/* Two lines: the key, the numbers. */
bool equal_keep(const char *path, const char *key, const struct equal_render *r, struct error *err)
{
    struct file_output f;
    if (!file_create(path, &f, err))
        return false;
    fprintf(f.stream, "# %s\n%ld,%ld,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%ld\n", key, r->seed, r->spp, r->seconds,
            r->target, r->growth, r->rmse8, r->relmse, r->blocks, r->nonfinite);
    return file_commit(&f, err);
}

bool equal_recall(const char *path, const char *key, struct equal_render *r)
{
    char line[EQUAL_KEY + 4] = "", end = 0;
    struct equal_render in;
    FILE *f = os_open_input(path);
    if (f == NULL)
        return false;
    size_t n = strlen(key);
    bool ok = fgets(line, sizeof line, f) != NULL && strncmp(line, "# ", 2) == 0 && strncmp(line + 2, key, n) == 0 &&
              strcmp(line + 2 + n, "\n") == 0 &&
              fscanf(f, "%ld,%ld,%lf,%lf,%lf,%lf,%lf,%lf,%ld%c", &in.seed, &in.spp, &in.seconds, &in.target,
                     &in.growth, &in.rmse8, &in.relmse, &in.blocks, &in.nonfinite, &end) == 10 && end == '\n';
    fclose(f);
    if (ok)
        *r = in;
    return ok;
}

void equal_csv(FILE *f, const struct equal_time *e)
{
    fputs("scene,method,seed,spp,seconds,rmse8,relmse,relmse8x8,target_seconds,growth,reference_noise8,nonfinite\n", f);
    for (const struct equal_scene *s = e->scene; s < e->scene + e->n_scenes; s++)
        for (int v = 0; v < e->plan->methods.n; v++)
            for (const struct equal_render *r = s->render[v]; r < s->render[v] + e->plan->n_seeds; r++) {
                csv_text(f, s->name);
                fprintf(f, ",%s,%ld,%ld,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,", e->plan->methods.item[v].text, r->seed, r->spp,
                        r->seconds, r->rmse8, r->relmse, r->blocks, r->target, r->growth);
                if (isfinite(s->noise8))
                    fprintf(f, "%.9g", s->noise8);
                fprintf(f, ",%ld\n", r->nonfinite);
            }
}

const char *const EQUAL_NAMES[N_EQUAL_ERRORS] = {"rmse8", "relmse", "8x8"};

/* The columns: the scene, T, samples per pixel, and for each method but the first both ratios. */
static void begin_table(struct table *t, const struct equal_time *e)
{
    table_begin(t, "Squared error over that of %s after the same CPU time, with its 95 %% interval over %d seed%s; "
                   "below 1 is a gain", e->plan->methods.item[0].text, e->plan->n_seeds,
                e->plan->n_seeds == 1 ? "" : "s");
    table_column(t, "scene");
    table_column(t, "seconds");
    table_column(t, "spp of each");
    for (int v = 1; v < e->plan->methods.n; v++)
        for (int k = 0; k < N_EQUAL_ERRORS; k++)
            table_column(t, "%s, %s", e->plan->methods.item[v].text, EQUAL_NAMES[k]);
}

/* A scene: means over seeds of T and of the samples, then the ratios. */
static void add_scene(struct table *t, const struct equal_time *e, const struct equal_scene *s)
{
    char samples[TABLE_CELL] = "";
    double seconds = 0;
    for (int i = 0; i < e->plan->n_seeds; i++)
        seconds += s->render[0][i].target / e->plan->n_seeds;
    for (int v = 0, n = 0; v < e->plan->methods.n; v++) {
        double spp = 0;
        for (int i = 0; i < e->plan->n_seeds; i++)
            spp += (double)s->render[v][i].spp / e->plan->n_seeds;
        n += snprintf(samples + n, sizeof samples - (size_t)n, "%s%.4g", v > 0 ? ", " : "", spp);
    }
    table_add(t, NAN, "%s", s->name);
    table_add(t, seconds, "%.3g", seconds);
    table_add(t, NAN, "%s", samples);
    for (int v = 1; v < e->plan->methods.n; v++)
        for (int k = 0; k < N_EQUAL_ERRORS; k++)
            table_add_interval(t, equal_ratio(e, s, v, (enum equal_error)k));
}

/* Rows for all scenes together. */
static void add_summaries(struct table *t, const struct equal_time *e)
{
    static const char *const rows[3] = {"geometric mean", "best", "WORST"};
    for (int row = 0; row < 3; row++) {
        table_add(t, NAN, "**%s**", rows[row]);
        table_add(t, NAN, "");
        table_add(t, NAN, "");
        for (int i = N_EQUAL_ERRORS; i < e->plan->methods.n * N_EQUAL_ERRORS; i++) {
            struct equal_summary s = equal_summarize(e, i / N_EQUAL_ERRORS, (enum equal_error)(i % N_EQUAL_ERRORS));
            if (s.n == 0)
                table_add_missing(t, 1);
            else if (row == 0)
                table_add(t, s.mean, "**%.3f** of %d", s.mean, s.n);
            else if (row == 1)
                table_add(t, s.best, "**%.3f** %s", s.best, s.best_scene);
            else
                table_add(t, s.worst, "**%.3f** %s", s.worst, s.worst_scene);
        }
    }
}

/* How well the times were met. */
static void write_times(FILE *f, const struct equal_time *e)
{
    for (int v = 0; v < e->plan->methods.n; v++) {
        int near = 0, far = 0, n = 0;
        long nonfinite = 0;
        double farthest = 0;
        for (const struct equal_scene *s = e->scene; s < e->scene + e->n_scenes; s++)
            for (const struct equal_render *r = s->render[v]; r < s->render[v] + e->plan->n_seeds; r++, n++) {
                double off = r->seconds / r->target - 1;
                near += equal_met(r->seconds, r->target);
                far += !equal_comparable(r->seconds, r->target);
                farthest = fabs(off) > fabs(farthest) ? off : farthest;
                nonfinite += r->nonfinite;
            }
        fprintf(f, "- %s: %d of %d renders took the given time within %d %%; the farthest was off by %+.1f %%.",
                e->plan->methods.item[v].text, near, n, EQUAL_PERCENT, 100 * farthest);
        if (far > 0)
            fprintf(f, " %d %s off by more than %d %%: too far to be accounted for, so the scene has no ratio.", far,
                    far == 1 ? "was" : "were", EQUAL_FARTHEST);
        if (nonfinite > 0)
            fprintf(f, " %ld values were no numbers and are left out.", nonfinite);
        fputs("\n", f);
    }
}

void equal_notes(FILE *f, const struct equal_time *e)
{
    fputs("rmse8: of the squared error of 8-bit values, that of the reference itself subtracted where known; relmse: "
          "of the relative squared error of linear values as it stands; 8x8: the same of means over 8x8 pixels, which "
          "pixels that err together do not hide. One thread. "
          "The samples per pixel were chosen by the time they take, with all that is prepared; what still differed "
          "between the time t taken and the given T is accounted for by error^2(T) = error^2(t) (t / T)^growth, growth "
          "being that of samples over time as measured.\n\n",
          f);
    write_times(f, e);
    fputs("\n", f);
    plan_write_command(f, e->plan);
}

void equal_table(FILE *f, const struct equal_time *e)
{
    struct table t;
    begin_table(&t, e);
    for (const struct equal_scene *s = e->scene; s < e->scene + e->n_scenes; s++)
        add_scene(&t, e, s);
    add_summaries(&t, e);
    table_markdown(f, &t);
    table_free(&t);
    equal_notes(f, e);
}

void equal_picture(const struct equal_time *e, const struct equal_scene *s, int method, char *out, size_t size)
{
    snprintf(out, size, "%s/images/%s-%s.pfm", e->plan->directory, s->name,
             method < 0 ? "reference" : e->plan->methods.item[method].file);
}

bool equal_write_file(const struct equal_time *e, const char *name, void (*write)(FILE *, const struct equal_time *),
                      struct error *err)
{
    struct file_output f;
    if (!plan_create(e->plan, name, &f, err))
        return false;
    write(f.stream, e);
    return file_commit(&f, err);
}

bool equal_write(const struct equal_time *e, struct error *err)
{
    return equal_write_file(e, "equal-time.csv", equal_csv, err) &&
           equal_write_file(e, "equal-time.md", equal_table, err);
}
