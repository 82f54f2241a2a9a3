/* results_file.c: see results_file.h. */
#include "lab/results_file.h"

#include "lab/markup.h"

static const struct {
    const char *name;
    enum quantity quantity;
} QUANTITIES[] = {{"seconds", Q_SECONDS},
                  {"rmse", Q_RMSE},
                  {"rmse8", Q_RMSE8},
                  {"relmse", Q_RELMSE},
                  {"mean_error", Q_MEAN_ERROR}};
enum { N_QUANTITIES = sizeof QUANTITIES / sizeof QUANTITIES[0] };

/* --- CSV --------------------------------------------------------------------------------------------- */

static void csv_interval(FILE *f, struct interval i)
{
    fputc(',', f);
    csv_number(f, i.value);
    fputc(',', f);
    csv_number(f, i.low);
    fputc(',', f);
    csv_number(f, i.high);
}

static void csv_step(FILE *f, const struct results *r, const struct scene_results *s, int v, int step)
{
    int seeds = plan_seeds(r->plan, v);
    fprintf(f, "%s,%s,%ld,%d", s->name, VARIANTS[v].name, r->plan->spp[step], seeds);
    for (int q = 0; q < N_QUANTITIES; q++) {
        struct estimate e = results_mean(s, seeds, v, step, QUANTITIES[q].quantity);
        fputc(',', f);
        csv_number(f, e.mean);
        fputc(',', f);
        csv_number(f, e.error);
    }
    csv_interval(f, results_rmse_ratio(r, s, v, step));
    csv_interval(f, results_equal_time(r, s, v, step));
    fputc('\n', f);
}

void results_csv(FILE *f, const struct results *r)
{
    fputs("scene,variant,spp,seeds", f);
    for (int q = 0; q < N_QUANTITIES; q++)
        fprintf(f, ",%s,%s_error", QUANTITIES[q].name, QUANTITIES[q].name);
    fputs(",rmse8_ratio,rmse8_ratio_low,rmse8_ratio_high,equal_time_mse,equal_time_mse_low,equal_time_mse_high\n",
          f);
    for (int i = 0; i < r->plan->n_scenes; i++)
        for (int v = 0; v < N_VARIANTS; v++)
            for (int k = 0; k < r->plan->n_steps && plan_seeds(r->plan, v) > 0; k++)
                csv_step(f, r, &r->scene[i], v, k);
}

static void csv_run(FILE *f, const struct scene_results *s, int v, int seed)
{
    const struct run *run = &s->run[v][seed - 1];
    for (int k = 0; k < run->n; k++) {
        const struct run_step *p = &run->step[k];
        fprintf(f, "%s,%s,%ld,%ld,", s->name, VARIANTS[v].name, plan_seed(v, seed), p->spp);
        csv_number(f, p->seconds);
        fputc(',', f);
        csv_number(f, p->rmse);
        fputc(',', f);
        csv_number(f, p->rmse8);
        fputc(',', f);
        csv_number(f, p->relmse);
        fputc(',', f);
        csv_number(f, p->mean_error);
        fputc(',', f);
        csv_number(f, p->mean_noise);
        fprintf(f, ",%ld\n", p->nonfinite);
    }
}

void results_runs_csv(FILE *f, const struct results *r)
{
    fputs("scene,variant,seed,spp,seconds,rmse,rmse8,relmse,mean_error,mean_noise,nonfinite\n", f);
    for (int i = 0; i < r->plan->n_scenes; i++)
        for (int v = 0; v < N_VARIANTS; v++)
            for (int seed = 1; seed <= plan_seeds(r->plan, v); seed++)
                csv_run(f, &r->scene[i], v, seed);
}

/* --- JSON -------------------------------------------------------------------------------------------- */

static void json_interval(FILE *f, const char *name, struct interval i)
{
    fprintf(f, ", \"%s\": [", name);
    json_number(f, i.value);
    fputs(", ", f);
    json_number(f, i.low);
    fputs(", ", f);
    json_number(f, i.high);
    fputc(']', f);
}

/* The value of a quantity in every seed. */
static void json_seeds(FILE *f, const struct scene_results *s, int v, int step, int seeds, int q)
{
    fprintf(f, ", \"%s\": [", QUANTITIES[q].name);
    for (int i = 0; i < seeds; i++) {
        const struct run_step *p = &s->run[v][i].step[step];
        const double value[N_QUANTITIES] = {p->seconds, p->rmse, p->rmse8, p->relmse, p->mean_error};
        fputs(i > 0 ? ", " : "", f);
        json_number(f, value[q]);
    }
    fputc(']', f);
}

static void json_step(FILE *f, const struct results *r, const struct scene_results *s, int v, int step)
{
    fprintf(f, "        {\"spp\": %ld", r->plan->spp[step]);
    for (int q = 0; q < N_QUANTITIES; q++)
        json_seeds(f, s, v, step, plan_seeds(r->plan, v), q);
    json_interval(f, "rmse8_ratio", results_rmse_ratio(r, s, v, step));
    json_interval(f, "equal_time_mse", results_equal_time(r, s, v, step));
    fputc('}', f);
}

static void json_variant(FILE *f, const struct results *r, const struct scene_results *s, int v)
{
    fprintf(f, "      {\"name\": \"%s\", \"label\": \"%s\", \"seeds\": %d, \"steps\": [\n", VARIANTS[v].name,
            VARIANTS[v].label, plan_seeds(r->plan, v));
    for (int k = 0; k < r->plan->n_steps; k++) {
        fputs(k > 0 ? ",\n" : "", f);
        json_step(f, r, s, v, k);
    }
    fputs("]}", f);
}

static void json_scene(FILE *f, const struct results *r, const struct scene_results *s)
{
    fputs("    {\"name\": ", f);
    json_text(f, s->name);
    fputs(", \"path\": ", f);
    json_text(f, s->path);
    fprintf(f, ", \"width\": %d, \"height\": %d, \"maxdepth\": %d,\n     \"reference\": {\"origin\": ", s->width,
            s->height, s->max_depth);
    json_text(f, s->reference.origin);
    fputs(", \"noise8\": ", f);
    json_number(f, s->reference.noise8);
    fputs(", \"mean_error\": ", f);
    json_number(f, s->reference.mean_error);
    fputs("},\n     \"variants\": [\n", f);
    int n = 0;
    for (int v = 0; v < N_VARIANTS; v++) {
        if (plan_seeds(r->plan, v) == 0)
            continue;
        fputs(n++ > 0 ? ",\n" : "", f);
        json_variant(f, r, s, v);
    }
    fputs("]}", f);
}

void results_json(FILE *f, const struct results *r)
{
    fprintf(f, "{\"preset\": \"%s\", \"seeds\": %d, \"scenes\": [\n", r->plan->quick ? "quick" : "full",
            r->plan->n_seeds);
    for (int i = 0; i < r->plan->n_scenes; i++) {
        fputs(i > 0 ? ",\n" : "", f);
        json_scene(f, r, &r->scene[i]);
    }
    fputs("]}\n", f);
}
