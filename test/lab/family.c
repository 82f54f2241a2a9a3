/* family.c: see family.h. */
#include "lab/family.h"

#include <math.h>
#include <string.h>

#include "lab/claims.h"
#include "lab/equal.h"
#include "lab/text.h"
#include "lab/page.h"
#include "lab/pictures.h"

/* The methods that a table or figure shows, the first of them that which all are compared with. */
struct view {
    int method[METHODS_MAX], n;
};

static bool has_halves(const struct results *e)
{
    unsigned all = 0;
    for (int i = 0; i < e->plan->methods.n; i++)
        all |= e->plan->methods.item[i].halves;
    return all == 3;
}

/* Those of a half, or all where there are not both halves. */
static struct view view_of(const struct results *e, enum half half)
{
    struct view v = {.n = 0};
    bool all = !has_halves(e);
    for (int i = 0; i < e->plan->methods.n; i++)
        if (all || (e->plan->methods.item[i].halves >> half & 1) != 0)
            v.method[v.n++] = i;
    return v;
}

static const char *label(const struct results *e, int method) { return e->plan->methods.item[method].label; }

/* --- tables ------------------------------------------------------------------------------------------ */

/* A ratio and what it is of. */
static void add_of(struct md_table *t, double ratio, const char *of)
{
    if (isfinite(ratio))
        md_add(t, "%.3g %s", ratio, of);
    else
        md_add_missing(t, 1);
}

static void square_columns(struct md_table *t)
{
    for (int k = 0; k < N_SQUARES; k++)
        md_column(t, "%s", EQUAL_NAMES[k]);
}

static bool is_ours(const struct results *e, int method)
{
    return strcmp(e->plan->methods.item[method].integrator, METHOD_PARTNER) == 0;
}

/* Of each scene the best unbiased method that is not asbdpt's, over the first; and the default over that. */
static void best_rival_rows(struct md_table *t, const struct results *e, const struct view *view)
{
    struct view rivals = {.n = 0};
    int ours = -1;
    for (int i = 0; i < view->n; i++)
        if (!is_ours(e, view->method[i]) && !measured_biased(&e->plan->methods.item[view->method[i]]))
            rivals.method[rivals.n++] = view->method[i];
        else if (strcmp(label(e, view->method[i]), "subspaces") == 0)
            ours = view->method[i];
    for (int row = 0; row < 2 && ours >= 0 && rivals.n > 1; row++) {
        md_add(t, row == 0 ? "best rival" : "%s over best rival", label(e, ours));
        md_add_missing(t, 1);
        for (int k = 0; k < N_SQUARES; k++) {
            int over = row == 0 ? view->method[0] : ours;
            struct interval i = equal_over_best(e, over, rivals.method, rivals.n, (enum square)k);
            md_add_interval(t, row == 0 ? (struct interval){1 / i.value, 1 / i.high, 1 / i.low} : i, "");
        }
        md_add_missing(t, 3);
    }
}

static void summary_table(FILE *f, const struct results *e, enum half half)
{
    struct view view = view_of(e, half);
    int first = view.method[0];
    struct md_table t =
        md_begin(f, "Squared error over that of %s after the same CPU time: geometric mean over %d scene%s with "
                    "its 95 %% interval, and the ends of relmse. 0.59: the same noise in 59 %% of the time. Price: "
                    "time of a sample over that of %s. Best rival: in each scene the unbiased method of others without "
                    "a mark that has the least error; for each seed the other seeds say which",
                    label(e, first), e->plan->n_scenes, e->plan->n_scenes == 1 ? "" : "s", label(e, first));
    md_column(&t, "method");
    md_column(&t, "price");
    square_columns(&t);
    md_column(&t, "best");
    md_column(&t, "worst");
    md_column(&t, "marked in");
    for (int i = 1; i < view.n; i++) {
        int v = view.method[i], n;
        struct equal_ends s = equal_ends(e, v, first, SQUARE_RELMSE);
        md_add(&t, "%s", label(e, v));
        md_add(&t, "%.2f", equal_price(e, v) / equal_price(e, first));
        for (int k = 0; k < N_SQUARES; k++)
            md_add_interval(&t, equal_mean(e, v, first, (enum square)k, AT_EQUAL_TIME, NULL, &n), "");
        add_of(&t, s.best, s.best_scene);
        add_of(&t, s.worst, s.worst_scene);
        md_add(&t, "%d", results_marked(e, v));
    }
    best_rival_rows(&t, e, &view);
    md_end(&t);
}

static void ratio_table(FILE *f, const struct results *e, enum half half, enum square which)
{
    struct view view = view_of(e, half);
    int first = view.method[0];
    struct md_table t =
        md_begin(f, "%s: squared error over that of %s, with its 95 %% interval over %d seed%s", EQUAL_NAMES[which],
                    label(e, first), e->plan->n_seeds, e->plan->n_seeds == 1 ? "" : "s");
    md_column(&t, "method");
    for (const struct scene_results *s = e->scene; s < e->scene + e->plan->n_scenes; s++)
        md_column(&t, s->mark[first] == MARK_NONE ? "%s, %dx%d" : "%s, %dx%d (%s: %s)", s->name, s->width, s->height,
                     label(e, first), MARKS[s->mark[first]]);
    for (int v = 1; v < view.n; v++) {
        md_add(&t, "%s", label(e, view.method[v]));
        for (int i = 0; i < e->plan->n_scenes; i++)
            md_add_interval(&t, equal_ratio(&e->scene[i], view.method[v], first, which),
                               MARKS[e->scene[i].mark[view.method[v]]]);
    }
    md_end(&t);
}

/* What was given, and what it came to. */
static void write_samples(FILE *f, const struct results *e)
{
    for (const struct scene_results *s = e->scene; s < e->scene + e->plan->n_scenes; s++) {
        double seconds = (s->price[0][0].before + (double)equal_samples(s, 0, 0)) * s->seconds;
        fprintf(f, "- %s: %.3g s of CPU; samples of each:", s->name, seconds);
        for (int v = 0; v < e->plan->methods.n; v++)
            fprintf(f, "%s %ld", v > 0 ? "," : "", s->run[v][0][0].spp);
        fputs("\n", f);
    }
    fprintf(f, "\nThese are of the first seed. Prices of a sample by seeds differ by %.0f %% at most.\n\n",
            100 * equal_spread(e));
}

/* What errors are against, and what the marks mean. */
static void write_light(FILE *f, const struct results *e)
{
    fputs("With two seeds or more each method's mean and blocks are tested against a reference. What is "
          "significantly darker misses light, what differs otherwise is biased. One page in a hundred has a false "
          "mark. With three seeds, and no reference given, errors of methods without a mark are half the squared "
          "differences of pairs of renders. All other errors are against the reference. Its own noise is "
          "subtracted, and intervals allow for an error of that subtraction as large as itself. Where the noise is "
          "unknown, or more than the error that is left, there is no number. Intervals know only what their seeds "
          "have met: where a few very bright samples carry the error they can be far too narrow. mse8 clips such "
          "samples. ", f);
    for (const struct scene_results *s = e->scene; s < e->scene + e->plan->n_scenes; s++)
        if (s->lacks)
            fprintf(f, "Perhaps no method finds all light of %s, which has lights that nothing can hit and mirrors or "
                       "glass: there all errors are against the reference, by %s. ", s->name,
                    s->by != NULL ? s->by : "others");
}

static void write_notes(FILE *f, const struct results *e)
{
    fputs("mse8: of the squared error of 8-bit values, which clip what is very bright, the square of what "
          "`compare` calls rmse8; relmse: of the relative squared error of linear values; 8x8: the same of means "
          "over 8x8 pixels, which pixels that err together do not hide. ", f);
    write_light(f, e);
    fputs("Prices were measured by turns with the first method, on one thread, in three rounds of each seed, of which "
          "the medians count. Samples are those that the time affords, all that is prepared included.\n\n", f);
    write_samples(f, e);
    plan_write_command(f, e->plan);
}

/* What shared techniques contribute to each method that has any: with them over without. */
static void services_table(FILE *f, const struct results *e)
{
    const struct methods *m = &e->plan->methods;
    int n;
    struct md_table t =
        md_begin(f, "What shared techniques contribute: squared error of a method with all over that without, "
                    "after the same CPU time, geometric mean over scenes with its 95 %% interval");
    md_column(&t, "method");
    square_columns(&t);
    for (int v = 0; v < m->n; v++)
        for (int with = v + 1; with < m->n; with++)
            if (strcmp(m->item[v].label, m->item[with].label) == 0) {
                md_add(&t, "%s", m->item[v].label);
                for (int k = 0; k < N_SQUARES; k++)
                    md_add_interval(&t, equal_mean(e, with, v, (enum square)k, AT_EQUAL_TIME, NULL, &n), "");
            }
    md_end(&t);
}

static void write_half(FILE *f, const struct results *e, enum half half)
{
    summary_table(f, e, half);
    for (int k = 0; k < N_SQUARES; k++)
        ratio_table(f, e, half, (enum square)k);
}

void family_tables(FILE *f, const struct results *e)
{
    bool both = has_halves(e);
    for (int h = 0; both && h < N_HALVES; h++) {
        fprintf(f, "## %s\n\n", HALVES[h]);
        write_half(f, e, (enum half)h);
        claims_table(f, e, (enum half)h);
    }
    if (both)
        services_table(f, e);
    else
        write_half(f, e, HALF_SERVICES);
    write_notes(f, e);
}

bool family_write(const struct results *r, const char *name, void (*page)(FILE *, const struct results *),
                  struct error *err)
{
    bool ok = results_write(r, "runs.csv", results_csv, err) && results_write(r, name, page, err) &&
              page_write(r, "Methods after the same CPU time", name, NULL, err);
    for (int i = 0; ok && r->plan->n_compared <= PICTURES_MOST && i < r->plan->n_scenes; i++)
        ok = pictures_write(&r->scene[i], err);
    return ok;
}
