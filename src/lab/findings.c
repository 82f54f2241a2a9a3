/* findings.c: see findings.h. */
#include "lab/findings.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "lab/published.h"

static void say(struct findings *f, const char *format, ...)
{
    va_list args;
    if (f->n >= FINDINGS_MAX)
        return;
    va_start(args, format);
    vsnprintf(f->text[f->n++], FINDING_SIZE, format, args);
    va_end(args);
}

enum verdict verdict_of(struct interval ratio)
{
    if (ratio.high < 1)
        return VERDICT_GAIN;
    return ratio.low > 1 ? VERDICT_LOSS : VERDICT_UNDECIDED;
}

static const char *verdict_text(enum verdict v)
{
    switch (v) {
    case VERDICT_GAIN: return "a gain";
    case VERDICT_LOSS: return "a loss";
    case VERDICT_UNDECIDED: return "undecided, the interval holds 1";
    }
    return "";
}

static const char *interval_text(struct interval i, char out[64])
{
    if (isfinite(i.low) && isfinite(i.high))
        snprintf(out, 64, "%.3f (95 %% interval %.3g to %.3g)", i.value, i.low, i.high);
    else
        snprintf(out, 64, "%.3f (no interval from one seed)", i.value);
    return out;
}

/* --- one scene --------------------------------------------------------------------------------------- */

/* The printed ratio at a number of samples, or at the nearest one that was printed. */
static double printed_ratio(const struct published *p, long spp, long *at)
{
    int i = 0;
    while (i + 1 < PUBLISHED_STEPS && published_spp(i + 1) <= spp)
        i++;
    *at = published_spp(i);
    return p->asbdpt[i] / p->bdpt[i];
}

/* Is the dissertation's direction found again at the last step? The printed table has no errors, so its ratio is
 * taken as it stands. */
static enum verdict agreement(const struct results *r, const struct scene_results *s, double *printed, long *at)
{
    int last = r->plan->n_steps - 1;
    const struct published *p = published_find(s->name);
    enum verdict ours = verdict_of(results_rmse_ratio(r, s, VARIANT_BINS, last));
    *printed = NAN;
    if (p == NULL)
        return VERDICT_UNDECIDED;
    *printed = printed_ratio(p, r->plan->spp[last], at);
    if (ours == VERDICT_UNDECIDED)
        return ours;
    return (ours == VERDICT_GAIN) == (*printed < 1) ? VERDICT_GAIN : VERDICT_LOSS;
}

static void compare_with_printed(const struct results *r, const struct scene_results *s, struct findings *f)
{
    char text[64];
    int last = r->plan->n_steps - 1;
    long at = 0;
    double printed;
    struct interval ours = results_rmse_ratio(r, s, VARIANT_BINS, last);
    enum verdict same = agreement(r, s, &printed, &at);
    say(f, "After %ld samples per pixel the RMSE of bins is that of BDPT times %s: %s.", r->plan->spp[last],
        interval_text(ours, text), verdict_text(verdict_of(ours)));
    if (!isfinite(printed))
        return;
    say(f, "The dissertation prints %.3f after %ld samples, %s: %s.", printed, at,
        printed < 1 ? "a gain" : "a loss",
        same == VERDICT_UNDECIDED ? "neither confirmed nor refuted here"
        : same == VERDICT_GAIN    ? "found again here"
                                  : "not found here");
}

static double mean_rmse(const struct results *r, const struct scene_results *s, int variant, int step)
{
    return results_mean(s, plan_seeds(r->plan, variant), variant, step, Q_RMSE8).mean;
}

/* How fast the error still falls over the last doubling. */
static void tell_convergence(const struct results *r, const struct scene_results *s, struct findings *f)
{
    int last = r->plan->n_steps - 1;
    if (last < 1)
        return;
    double more = (double)r->plan->spp[last] / (double)r->plan->spp[last - 1];
    say(f,
        "From %ld to %ld samples the RMSE falls by a factor of %.3f for BDPT, %.3f for bins, %.3f for pool and "
        "%.3f for "
        "vertices; without bias and with a perfect reference it would be %.3f.",
        r->plan->spp[last - 1], r->plan->spp[last],
        mean_rmse(r, s, VARIANT_BDPT, last - 1) / mean_rmse(r, s, VARIANT_BDPT, last),
        mean_rmse(r, s, VARIANT_BINS, last - 1) / mean_rmse(r, s, VARIANT_BINS, last),
        mean_rmse(r, s, VARIANT_POOL, last - 1) / mean_rmse(r, s, VARIANT_POOL, last),
        mean_rmse(r, s, VARIANT_VERTICES, last - 1) / mean_rmse(r, s, VARIANT_VERTICES, last), sqrt(more));
}

static void tell_bias(const struct results *r, const struct scene_results *s, struct findings *f)
{
    int last = r->plan->n_steps - 1;
    for (int v = 0; v < N_METHODS; v++) {
        struct bias b = results_bias(r, s, v, last);
        if (isfinite(b.p))
            say(f,
                "The mean of %s is off by %+.3f %% with a standard error of %.2g %% (of which the reference %.2g "
                "%%), p = %.2g: %s.",
                VARIANTS[v].label, 100 * b.mean, 100 * b.error, 100 * s->reference.mean_error, b.p,
                b.p < 0.01 ? "a bias" : "no bias seen");
    }
}

static void tell_equal_time(const struct results *r, const struct scene_results *s, struct findings *f)
{
    char text[64];
    int last = r->plan->n_steps - 1;
    for (int v = VARIANT_BDPT + 1; v < N_METHODS; v++) {
        struct interval i = results_equal_time(r, s, v, last);
        if (isfinite(i.value))
            say(f, "At equal time the squared error of %s is that of BDPT times %s: %s.", VARIANTS[v].label,
                interval_text(i, text), verdict_text(verdict_of(i)));
        else
            say(f, "At equal time %s cannot be compared: its error is below the noise of the reference.",
                VARIANTS[v].label);
    }
}

void findings_scene(const struct results *r, const struct scene_results *s, struct findings *out)
{
    out->n = 0;
    compare_with_printed(r, s, out);
    tell_equal_time(r, s, out);
    tell_convergence(r, s, out);
    tell_bias(r, s, out);
}

/* --- all scenes -------------------------------------------------------------------------------------- */

static void count_agreement(const struct results *r, struct findings *f)
{
    int count[3] = {0, 0, 0}, scenes = 0;
    for (int i = 0; i < r->plan->n_scenes; i++) {
        double printed;
        long at;
        enum verdict v = agreement(r, &r->scene[i], &printed, &at);
        if (!isfinite(printed))
            continue;
        scenes++;
        count[v]++;
    }
    if (scenes > 0)
        say(f,
            "Whether bins has a lower or a higher RMSE than BDPT at the same number of samples agrees with the "
            "dissertation in %d of %d scenes, differs in %d and is undecided in %d.",
            count[VERDICT_GAIN], scenes, count[VERDICT_LOSS], count[VERDICT_UNDECIDED]);
}

static void count_gains(const struct results *r, int variant, struct findings *f)
{
    int count[3] = {0, 0, 0}, known = 0;
    double log_sum = 0;
    for (int i = 0; i < r->plan->n_scenes; i++) {
        struct interval ratio = results_equal_time(r, &r->scene[i], variant, r->plan->n_steps - 1);
        count[verdict_of(ratio)]++;
        if (isfinite(ratio.value)) {
            known++;
            log_sum += log(ratio.value);
        }
    }
    say(f,
        "At equal time %s has less squared error than BDPT in %d of %d scenes, more in %d, undecided in %d; the "
        "geometric mean of the ratios is %.3f.",
        VARIANTS[variant].label, count[VERDICT_GAIN], r->plan->n_scenes, count[VERDICT_LOSS],
        count[VERDICT_UNDECIDED], known > 0 ? exp(log_sum / known) : NAN);
}

static void count_biases(const struct results *r, struct findings *f)
{
    int biased[N_METHODS] = {0};
    if (r->plan->n_seeds < 2)
        return;
    for (int i = 0; i < r->plan->n_scenes; i++)
        for (int v = 0; v < N_METHODS; v++)
            biased[v] += results_bias(r, &r->scene[i], v, r->plan->n_steps - 1).p < 0.01;
    say(f,
        "The mean of the picture is off (p < 0.01) in %d of %d scenes for BDPT, %d for bins, %d for pool and %d "
        "for vertices.",
        biased[VARIANT_BDPT], r->plan->n_scenes, biased[VARIANT_BINS], biased[VARIANT_POOL],
        biased[VARIANT_VERTICES]);
}

void findings_total(const struct results *r, struct findings *out)
{
    out->n = 0;
    count_agreement(r, out);
    for (int v = VARIANT_BDPT + 1; v < N_METHODS; v++)
        count_gains(r, v, out);
    count_biases(r, out);
    if (r->plan->n_seeds < 2)
        say(out, "One seed gives no confidence intervals: every comparison stays undecided.");
}
