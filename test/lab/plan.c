/* plan.c: see plan.h. */
#include "lab/plan.h"

#include <stdio.h>
#include <string.h>

#include "look/markup.h"

const struct variant VARIANTS[N_VARIANTS] = {
    {"bdpt", "BDPT", "bdpt", NULL, 0, 0, true, false},
    {"bins", "ASBDPT bins", "asbdpt", "bins", 8, 32, true, false},
    {"pool", "ASBDPT pool", "asbdpt", "pool", 0, 0, true, false},
    {"vertices", "ASBDPT vertices", "asbdpt", "vertices", 0, 0, true, false},
    {"subspaces", "ASBDPT subspaces", "asbdpt", "subspaces", 0, 0, true, true},
    {"bins-paths-4", "bins, 4 paths per set", "asbdpt", "bins", 4, 32, false, false},
    {"bins-paths-16", "bins, 16 paths per set", "asbdpt", "bins", 16, 32, false, false},
    {"bins-paths-32", "bins, 32 paths per set", "asbdpt", "bins", 32, 32, true, false},
    {"bins-restart-0", "bins, never restarted", "asbdpt", "bins", 8, 0, true, false},
    {"bins-restart-8", "bins, restart every 8", "asbdpt", "bins", 8, 8, false, false},
    {"bins-restart-16", "bins, restart every 16", "asbdpt", "bins", 8, 16, false, false},
};

const struct sweep_point SWEEPS[N_SWEEPS][SWEEP_LENGTH] = {
    {{5, "4 paths per set"}, {VARIANT_BINS, "8 paths per set"}, {6, "16 paths per set"}, {7, "32 paths per set"}},
    {{8, "no restart"}, {9, "restart every 8"}, {10, "restart every 16"}, {VARIANT_BINS, "restart every 32"}},
};

void plan_preset(struct plan *p, bool quick)
{
    p->quick = quick;
    p->width = quick ? 0 : 320;
    p->height = 0;
    p->n_seeds = 3;
    p->reference_spp = quick ? 256 : 4096;
    plan_set_spp(p, quick ? 8 : 32, quick ? 64 : 512, NULL);
}

bool plan_set_spp(struct plan *p, long first, long last, struct error *err)
{
    p->n_steps = 0;
    for (long n = first; n < last; n *= 2) {
        if (p->n_steps >= PLAN_MAX_STEPS - 1)
            return error_set(err, "more than %d doublings of the samples from %ld to %ld", PLAN_MAX_STEPS - 1, first,
                             last);
        p->spp[p->n_steps++] = n;
    }
    p->spp[p->n_steps++] = last;
    return true;
}

int plan_seeds(const struct plan *p, int variant)
{
    if (variant < N_COMPARED)
        return p->n_seeds;
    return p->quick && !VARIANTS[variant].quick ? 0 : 1;
}

long plan_seed(int variant, int i) { return 100L * variant + i; }

long plan_first_sample(const struct plan *p, int variant, int i)
{
    const struct variant *v = &VARIANTS[variant];
    if (i == 0 || v->planned)
        return 0;
    bool whole = v->bin_paths == 0 || (v->restart > 0 && p->spp[i - 1] % v->restart == 0);
    return whole ? p->spp[i - 1] : 0;
}

long plan_run_spp(const struct plan *p, int variant)
{
    long sum = 0;
    for (int i = 0; i < p->n_steps; i++)
        sum += p->spp[i] - plan_first_sample(p, variant, i);
    return sum;
}

bool plan_create(const struct plan *p, const char *name, struct file_output *out, struct error *err)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", p->directory, name);
    return file_create(path, out, err);
}

static void write_path(FILE *f, const char *before, const char *path, bool html)
{
    fputs(before, f);
    if (html)
        xml_text(f, path);
    else
        fputs(path, f);
}

void plan_command(FILE *f, const struct plan *p, const char *how, const char *margin, bool html)
{
    fprintf(f, "%s./asbdpt experiment %s --seeds %d --reference-spp %ld", margin, how, p->n_seeds, p->reference_spp);
    if (p->width > 0)
        fprintf(f, " --res %d", p->width);
    if (p->height > 0)
        fprintf(f, "x%d", p->height);
    if (p->max_depth > 0)
        fprintf(f, " --maxdepth %d", p->max_depth);
    if (p->reference != NULL)
        write_path(f, " --reference ", p->reference, html);
    write_path(f, " -o ", p->directory, html);
    for (int i = 0; i < p->n_scenes; i++) {
        if (i % 3 == 0)
            fprintf(f, " \\\n%s   ", margin);
        write_path(f, " ", p->scene[i], html);
    }
    fputs("\n", f);
}

void variant_settings(const struct variant *v, struct settings *out)
{
    char paths[32], restart[32];
    snprintf(paths, sizeof paths, "%d", v->bin_paths);
    snprintf(restart, sizeof restart, "%d", v->restart);
    settings_clear(out);
    settings_set(out, "rrthreshold", "0", "experiment"); /* what is compared is the choice of sub-paths alone */
    if (v->select != NULL)
        settings_set(out, "select", v->select, "experiment");
    if (v->bin_paths > 0) {
        settings_set(out, "binpaths", paths, "experiment");
        settings_set(out, "restart", restart, "experiment");
    }
}
