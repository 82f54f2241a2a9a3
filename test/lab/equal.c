/* equal.c: see equal.h. */
#include "lab/equal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/alias.h"
#include "base/maths.h"
#include "base/number.h"
#include "base/progress.h"
#include "base/rng.h"
#include "lab/numbers.h"
#include "lab/stats.h"

enum { MOST_SAMPLES = 1 << 20, DRAWS = 2000, MOST_SCENES = 64 };

const char *const EQUAL_NAMES[N_SQUARES] = {"rmse8", "relmse", "8x8"};

/* --- arithmetic -------------------------------------------------------------------------------------- */

double equal_afforded(const struct scene_results *s, int method)
{
    const struct plan *p = s->plan;
    double time = p->seconds > 0 ? p->seconds / s->seconds : s->price[0].before + (double)plan_last_spp(p);
    return (time - s->price[method].before) / s->price[method].each;
}

long equal_samples(const struct scene_results *s, int method)
{
    double n = floor(equal_afforded(s, method) + 0.5);
    return n >= 1 ? (long)fmin(n, MOST_SAMPLES) : 1;
}

void equal_squares(const struct scene_results *s, int method, enum square which, enum basis basis, double *out)
{
    double n = equal_afforded(s, method);
    for (int i = 0; i < s->plan->n_seeds; i++) {
        const struct run_step *r = &s->run[method][i].step[0];
        out[i] = n >= 1 ? r->square[which] * (double)r->spp / (basis == AT_EQUAL_TIME ? n : 1) : NAN;
    }
}

struct interval equal_ratio(const struct scene_results *s, int method, int over, enum square which)
{
    double x[PLAN_MAX_SEEDS], y[PLAN_MAX_SEEDS];
    equal_squares(s, method, which, AT_EQUAL_TIME, x);
    equal_squares(s, over, which, AT_EQUAL_TIME, y);
    return results_ratio(x, s->plan->n_seeds, y, s->plan->n_seeds);
}

struct equal_ends equal_ends(const struct results *r, int method, enum square which)
{
    struct equal_ends out = {NAN, NAN, "-", "-"};
    for (const struct scene_results *s = r->scene; s < r->scene + r->plan->n_scenes; s++) {
        double ratio = equal_ratio(s, method, 0, which).value;
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
    for (int i = 0; i < r->plan->n_scenes; i++)
        sum += m_log(r->scene[i].price[method].each);
    return m_exp(sum / r->plan->n_scenes);
}

/* --- the bootstrap ----------------------------------------------------------------------------------- */

/* The logarithm of the mean of n seeds drawn from n, never far below that of all. */
static double drawn_log(struct rng *rng, const double *x, int n, double all)
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += x[rng_below(rng, (uint32_t)n)];
    return m_log(fmax(sum / n, 1e-3 * all));
}

struct interval equal_bootstrap(const struct results *r, int method, int over, enum square which, enum basis basis,
                                const char *wanted, int *n)
{
    static const struct interval none = {NAN, NAN, NAN};
    double x[MOST_SCENES][2][PLAN_MAX_SEEDS], all[MOST_SCENES][2], deviation[DRAWS], value = 0;
    int seeds = r->plan->n_seeds, k = 0;
    struct rng rng = rng_stream(0, RNG_TEST, 0, 0);
    for (int i = 0; i < r->plan->n_scenes && k < MOST_SCENES; i++) {
        const struct scene_results *s = &r->scene[i];
        if (wanted != NULL && strncmp(s->name, wanted, strlen(wanted)) != 0)
            continue;
        if (basis == AT_EQUAL_SAMPLES && (s->mark[method] != MARK_NONE || s->mark[over] != MARK_NONE))
            continue;
        for (int side = 0; side < 2; side++) {
            equal_squares(s, side == 0 ? method : over, which, basis, x[k][side]);
            all[k][side] = sum_of(x[k][side], seeds) / seeds;
        }
        value += m_log(all[k][0] / all[k][1]);
        k++;
    }
    *n = k;
    value /= k;
    if (k == 0 || !isfinite(value))
        return none;
    if (k == 1)
        return results_ratio(x[0][0], seeds, x[0][1], seeds);
    for (int d = 0; d < DRAWS; d++) {
        double sum = 0;
        for (int i = 0; i < k; i++) {
            uint32_t at = rng_below(&rng, (uint32_t)k);
            sum += drawn_log(&rng, x[at][0], seeds, all[at][0]) - drawn_log(&rng, x[at][1], seeds, all[at][1]);
        }
        deviation[d] = sum / k - value;
    }
    stats_sort(deviation, DRAWS);
    double wider = sqrt(k / (k - 1.0));
    struct interval out = {m_exp(value), m_exp(value + wider * deviation[DRAWS / 40]),
                           m_exp(value + wider * deviation[DRAWS - 1 - DRAWS / 40])};
    return out;
}

/* --- the words --------------------------------------------------------------------------------------- */

double equal_seconds(const struct scene_results *s)
{
    double sum = 0;
    for (int v = 0; v < s->plan->methods.n; v++)
        sum += s->price[v].before + (double)equal_samples(s, v) * s->price[v].each;
    return sum * s->seconds;
}

double equal_seeds_wanted(struct interval r, int n)
{
    return ceil(n * sqr((m_log(r.high) - m_log(r.low)) / (2 * m_log(r.value))));
}

/* "0.8 (95 %: 0.6 to 1.1): undecided; --seeds 12 may decide, some 40 s of CPU more". What is marked has less
 * error, but no gain. */
static void say(FILE *f, const struct results *all, struct interval r, bool marked)
{
    bool decided = r.high < 1 || r.low > 1;
    int n = all->plan->n_seeds;
    double seeds = equal_seeds_wanted(r, n), seconds = 0;
    char more[32];
    if (!isfinite(r.value)) {
        fputs("unknown, as the time is too short for it: more --spp.\n", f);
        return;
    }
    fprintf(f, "%.3g (95 %%: %.3g to %.3g): %s", r.value, r.low, r.high,
            !decided ? "undecided" : r.low > 1 ? "a loss" : marked ? "less error, but see above" : "a gain");
    for (int i = 0; i < all->plan->n_scenes; i++)
        seconds += equal_seconds(&all->scene[i]);
    if (!decided && seeds <= PLAN_MAX_SEEDS) {
        progress_duration((seeds - n) * seconds, more, sizeof more);
        fprintf(f, "; --seeds %.0f may decide, some %s of CPU more", seeds, more);
    } else if (!decided)
        fputs("; it is so near 1 that only a larger --res, or more --spp, will tell", f);
    fputs(".\n", f);
}

void equal_verdict(FILE *f, const struct results *r)
{
    const struct plan *p = r->plan;
    int n;
    for (int v = 0; v < p->methods.n; v++)
        for (const struct scene_results *s = r->scene; s < r->scene + p->n_scenes; s++)
            if (s->mark[v] != MARK_NONE)
                fprintf(f, "In %s, %s: %s, compared with a reference by %s.\n", s->name, p->methods.item[v].text,
                        MARKS[s->mark[v]], s->by != NULL ? s->by : "others");
    for (int v = 1; v < p->methods.n; v++) {
        bool marked = results_marked(r, v) > 0;
        fprintf(f, "Squared error of %s over that of %s after the same time, per pixel: ", p->methods.item[v].text,
                p->methods.item[0].text);
        say(f, r, equal_bootstrap(r, v, 0, SQUARE_RELMSE, AT_EQUAL_TIME, NULL, &n), marked);
        fputs("In means over 8x8 pixels, where errors that neighbours share do not hide: ", f);
        say(f, r, equal_bootstrap(r, v, 0, SQUARE_BLOCKS, AT_EQUAL_TIME, NULL, &n), marked);
    }
    fprintf(f, "Measured with %d seed%s on", p->n_seeds, p->n_seeds == 1 ? "" : "s");
    for (int i = 0; i < p->n_scenes; i++)
        fprintf(f, "%s %s %dx%d", i > 0 ? "," : "", r->scene[i].name, r->scene[i].width, r->scene[i].height);
    fputs(".\n", f);
}
