/* output.c: see output.h. */
#include "lab/output.h"

#include <stdio.h>

#include "lab/figures.h"
#include "base/file.h"
#include "lab/pictures.h"
#include "lab/report.h"
#include "lab/results_file.h"

/* Begin DIRECTORY/NAME. */
static bool begin(const struct results *r, const char *name, struct file_output *f, struct error *err)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", r->plan->directory, name);
    return file_create(path, f, err);
}

static bool write_with(const struct results *r, const char *name, void (*write)(FILE *, const struct results *),
                       struct error *err)
{
    struct file_output f;
    if (!begin(r, name, &f, err))
        return false;
    write(f.stream, r);
    return file_commit(&f, err);
}

static bool write_plots(const struct results *r, const struct scene_results *s, struct error *err)
{
    bool ok = true;
    for (int k = 0; ok && k < N_FIGURES; k++) {
        struct plot plot;
        struct figure_text text;
        struct file_output f;
        char name[400];
        if (!figure_make(r, s, (enum figure)k, &plot, &text))
            continue;
        snprintf(name, sizeof name, "plots/%s-%s.svg", s->name, figure_name((enum figure)k));
        ok = begin(r, name, &f, err);
        if (ok) {
            plot_write(f.stream, &plot, "plot", true);
            ok = file_commit(&f, err);
        }
    }
    return ok;
}

static bool write_report(const struct results *r, struct error *err)
{
    struct file_output f;
    if (!begin(r, "report.html", &f, err))
        return false;
    if (report_html(f.stream, r, err))
        return file_commit(&f, err);
    file_abandon(&f);
    return false;
}

bool output_write(const struct results *r, struct error *err)
{
    for (int i = 0; i < r->plan->n_scenes; i++)
        if (!pictures_write(r, &r->scene[i], err) || !write_plots(r, &r->scene[i], err))
            return false;
    return write_with(r, "results.csv", results_csv, err) && write_with(r, "runs.csv", results_runs_csv, err) &&
           write_with(r, "results.json", results_json, err) && write_with(r, "results.md", report_markdown, err) &&
           write_report(r, err);
}
