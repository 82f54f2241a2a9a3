/* equal.c: see equal.h. */
#include "lab/equal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alias.h"
#include "base/maths.h"
#include "base/number.h"

enum { MOST_SAMPLES = 1 << 20, MOST_SCENES = 64 };

const char *const EQUAL_NAMES[N_SQUARES] = {"mse8", "relmse", "8x8"};

/* --- arithmetic -------------------------------------------------------------------------------------- */

double equal_afforded(const struct scene_results *s, int method, int seed)
{
    const struct plan *p = s->plan;
    const struct price *price = &s->price[method][seed];
    double time = p->seconds > 0 ? p->seconds / s->seconds : s->price[0][seed].before + (double)plan_last_spp(p);
    return (time - price->before) / price->each;
}

long equal_samples(const struct scene_results *s, int method, int seed)
{
    double n = floor(equal_afforded(s, method, seed) + 0.5);
    return n >= 1 ? (long)fmin(n, MOST_SAMPLES) : 1;
}

void equal_squares(const struct scene_results *s, int method, enum square which, enum basis basis, double *out)
{
    for (int i = 0; i < s->plan->n_seeds; i++) {
        const struct run *r = &s->run[method][i][0];
        double n = equal_afforded(s, method, i);
        out[i] = n >= 1 ? r->square[which] * (double)r->spp / (basis == AT_EQUAL_TIME ? n : 1) : NAN;
    }
}

static struct interval ratio_at(const struct scene_results *s, int method, int over, enum square which,
                                enum basis basis)
{
    double x[PLAN_MAX_SEEDS], y[PLAN_MAX_SEEDS];
    double doubt = results_doubt(s, method, 0, which) + results_doubt(s, over, 0, which);
    equal_squares(s, method, which, basis, x);
    equal_squares(s, over, which, basis, y);
    return results_ratio(x, s->plan->n_seeds, y, s->plan->n_seeds, doubt);
}

struct interval equal_ratio(const struct scene_results *s, int method, int over, enum square which)
{
    return ratio_at(s, method, over, which, AT_EQUAL_TIME);
}

struct equal_ends equal_ends(const struct results *r, int method, int over, enum square which)
{
    struct equal_ends out = {NAN, NAN, "-", "-"};
    for (const struct scene_results *s = r->scene; s < r->scene + r->plan->n_scenes; s++) {
        double ratio = equal_ratio(s, method, over, which).value;
        if (!isfinite(ratio))
            continue;
        if (!(out.best <= ratio)) {
            out.best = ratio;
            out.best_scene = s->name;
        }
        if (!(out.worst >= ratio)) {
            out.worst = ratio;
            out.worst_scene = s->name;
        }
    }
    return out;
}

double equal_price(const struct results *r, int method)
{
    double sum = 0;
    int n = r->plan->n_scenes * r->plan->n_seeds;
    for (int i = 0; i < n; i++)
        sum += m_log(r->scene[i / r->plan->n_seeds].price[method][i % r->plan->n_seeds].each);
    return m_exp(sum / n);
}

double equal_spread(const struct results *r)
{
    double spread = 0;
    for (const struct scene_results *s = r->scene; s < r->scene + r->plan->n_scenes; s++)
        for (int v = 0; v < r->plan->methods.n; v++) {
            double least = s->price[v][0].each, most = least;
            for (int i = 1; i < r->plan->n_seeds; i++) {
                least = fmin(least, s->price[v][i].each);
                most = fmax(most, s->price[v][i].each);
            }
            spread = fmax(spread, most / least - 1);
        }
    return spread;
}

/* --- means over scenes ------------------------------------------------------------------------------- */

/* Logarithm of a method's ratio to another in one scene; NaN where there is none. */
static double log_ratio(const struct scene_results *s, int method, int over, enum square which, enum basis basis)
{
    double ratio = ratio_at(s, method, over, which, basis).value;
    return isnan(ratio) ? NAN : m_log(ratio);
}

struct interval equal_mean(const struct results *r, int method, int over, enum square which, enum basis basis,
                           const char *wanted, int *n)
{
    const struct scene_results *last = NULL;
    double log[MOST_SCENES];
    *n = 0;
    for (const struct scene_results *s = r->scene; s < r->scene + r->plan->n_scenes && *n < MOST_SCENES; s++) {
        if (wanted != NULL && strncmp(s->name, wanted, strlen(wanted)) != 0)
            continue;
        if (basis == AT_EQUAL_SAMPLES && (s->mark[method] != MARK_NONE || s->mark[over] != MARK_NONE))
            continue;
        last = s;
        log[(*n)++] = log_ratio(s, method, over, which, basis);
    }
    return *n == 1 ? ratio_at(last, method, over, which, basis) : results_mean_log(log, *n);
}

/* Logarithm of the sum of a method's squares over that of the best others, of which seed i takes the one with the least
 * sum over the other seeds. */
static double log_over_best(const struct scene_results *s, int method, const int *others, int n_others,
                            enum square which)
{
    int n = s->plan->n_seeds;
    double own[PLAN_MAX_SEEDS], x[METHODS_MAX][PLAN_MAX_SEEDS], best = 0;
    equal_squares(s, method, which, AT_EQUAL_TIME, own);
    for (int k = 0; k < n_others; k++)
        equal_squares(s, others[k], which, AT_EQUAL_TIME, x[k]);
    for (int i = 0; i < n; i++) {
        double least = NAN, of_seed = NAN;
        for (int k = 0; k < n_others; k++) {
            double sum = sum_of(x[k], n) - (n > 1 ? x[k][i] : 0);
            if (s->mark[others[k]] != MARK_NONE || isnan(results_doubt(s, others[k], 0, which)) || !(sum > 0) ||
                sum >= least)
                continue;
            least = sum;
            of_seed = x[k][i];
        }
        best += of_seed;
    }
    double ratio = sum_of(own, n) / best;
    return ratio > 0 && !isnan(results_doubt(s, method, 0, which)) ? m_log(ratio) : NAN;
}

struct interval equal_over_best(const struct results *r, int method, const int *others, int n_others, enum square which)
{
    double log[MOST_SCENES];
    int n = r->plan->n_scenes < MOST_SCENES ? r->plan->n_scenes : MOST_SCENES;
    for (int i = 0; i < n; i++)
        log[i] = log_over_best(&r->scene[i], method, others, n_others, which);
    return results_mean_log(log, n);
}

/* --- the words --------------------------------------------------------------------------------------- */

/* "0.8 (95 %: 0.6 to 1.1): undecided; more seeds may decide". What is marked has less error, but no gain. */
static void say(FILE *f, const struct results *all, struct interval r, bool marked)
{
    if (!isfinite(r.value)) {
        fputs("unknown. The time is too short for a sample (more --spp), or the noise of the reference is unknown or "
              "too large (more --reference-spp).\n", f);
        return;
    }
    if (!isfinite(r.low)) {
        fprintf(f, "%.3g; more --seeds tell how sure this is.\n", r.value);
        return;
    }
    fprintf(f, "%.3g (95 %%: %.3g to %.3g): %s.\n", r.value, r.low, r.high,
            r.low > 1 ? "a loss" : r.high < 1 ? (marked ? "less error, but see above" : "a gain") :
            all->plan->n_scenes > 1 ? "undecided; more scenes may decide" :
                                      "undecided; more --seeds or a larger --res may decide");
}

void equal_verdict(FILE *f, const struct results *r)
{
    const struct plan *p = r->plan;
    int n;
    for (int v = 0; v < p->methods.n; v++)
        for (const struct scene_results *s = r->scene; s < r->scene + p->n_scenes; s++)
            if (s->mark[v] != MARK_NONE)
                fprintf(f, "- In %s, %s: %s, compared with a reference by %s.\n", s->name, p->methods.item[v].text,
                        MARKS[s->mark[v]], s->by != NULL ? s->by : "others");
    for (int v = 1; v < p->methods.n; v++) {
        bool marked = results_marked(r, v) > 0;
        fprintf(f, "- Squared error of %s over that of %s after the same time, per pixel: ", p->methods.item[v].text,
                p->methods.item[0].text);
        say(f, r, equal_mean(r, v, 0, SQUARE_RELMSE, AT_EQUAL_TIME, NULL, &n), marked);
        fputs("- In means over 8x8 pixels, where errors that neighbours share do not hide: ", f);
        say(f, r, equal_mean(r, v, 0, SQUARE_BLOCKS, AT_EQUAL_TIME, NULL, &n), marked);
    }
    fprintf(f, "- Measured with %d seed%s on", p->n_seeds, p->n_seeds == 1 ? "" : "s");
    for (int i = 0; i < p->n_scenes; i++)
        fprintf(f, "%s %s %dx%d", i > 0 ? "," : "", r->scene[i].name, r->scene[i].width, r->scene[i].height);
    fputs(".\n", f);
}
