/* findings.c: see findings.h. */
#include "lab/findings.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "base/maths.h"
#include "lab/published.h"

static void add_finding(struct findings *f, const char *format, ...)
{
    va_list args;
    if (f->n >= FINDINGS_MAX)
        return;
    va_start(args, format);
    vsnprintf(f->text[f->n++], FINDING_SIZE, format, args);
    va_end(args);
}

enum outcome outcome_of(struct interval ratio)
{
    if (ratio.high < 1)
        return OUTCOME_GAIN;
    return ratio.low > 1 ? OUTCOME_LOSS : OUTCOME_UNDECIDED;
}

static const char *const OUTCOMES[] = {"a gain", "a loss", "undecided, the interval holds 1"}; /* by enum outcome */

static const char *interval_text(struct interval i, char out[64])
{
    if (isfinite(i.low) && isfinite(i.high))
        snprintf(out, 64, "%.3f (95 %% interval %.3g to %.3g)", i.value, i.low, i.high);
    else
        snprintf(out, 64, "%.3f (no interval from one seed)", i.value);
    return out;
}

/* --- one scene --------------------------------------------------------------------------------------- */

/* The ratio that the dissertation prints, after as many samples as the last step has, or fewer if need be; *at becomes
 * their number. NaN: it does not have this scene. */
static double printed_ratio(const struct scene_results *s, long *at)
{
    const struct published *p = published_find(s->name);
    int i = 0;
    if (p == NULL)
        return NAN;
    while (i + 1 < PUBLISHED_STEPS && published_spp(i + 1) <= plan_last_spp(s->plan))
        i++;
    *at = published_spp(i);
    return p->asbdpt[i] / p->bdpt[i];
}

/* Is the printed ratio on the same side of 1 as ours? It has no interval, so it is taken as it stands. */
enum agreement { AGREES, DIFFERS, NOT_DECIDED };
static enum agreement agreement(struct interval ours, double printed)
{
    enum outcome outcome = outcome_of(ours);
    if (outcome == OUTCOME_UNDECIDED)
        return NOT_DECIDED;
    return (outcome == OUTCOME_GAIN) == (printed < 1) ? AGREES : DIFFERS;
}

static void add_comparison_with_printed(const struct scene_results *s, struct findings *f)
{
    static const char *const agreements[] = {"found again here", "not found here",
                                             "neither confirmed nor refuted here"};
    char text[64];
    long at = 0;
    double printed = printed_ratio(s, &at);
    struct interval ours = results_rmse_ratio(s, VARIANT_BINS, plan_last_step(s->plan));
    add_finding(f, "After %ld samples per pixel the RMSE of bins is that of BDPT times %s: %s.",
                plan_last_spp(s->plan), interval_text(ours, text), OUTCOMES[outcome_of(ours)]);
    if (isfinite(printed))
        add_finding(f, "The dissertation prints %.3f after %ld samples, %s: %s.", printed, at,
                    printed < 1 ? "a gain" : "a loss", agreements[agreement(ours, printed)]);
}

/* How much the error still falls over the last doubling. */
static void add_convergence(const struct scene_results *s, struct findings *f)
{
    int last = plan_last_step(s->plan);
    double factor[N_COMPARED];
    if (last < 1)
        return;
    for (int v = 0; v < N_COMPARED; v++)
        factor[v] = results_mean(s, v, last - 1, Q_RMSE8).mean / results_mean(s, v, last, Q_RMSE8).mean;
    add_finding(f,
                "From %ld to %ld samples the RMSE falls by a factor of %.3f for BDPT, %.3f for bins, %.3f for pool, "
                "%.3f for vertices and %.3f for subspaces; without bias and with a perfect reference it would be %.3f.",
                s->plan->spp[last - 1], s->plan->spp[last], factor[VARIANT_BDPT], factor[VARIANT_BINS],
                factor[VARIANT_POOL], factor[VARIANT_VERTICES], factor[VARIANT_SUBSPACES],
                sqrt((double)s->plan->spp[last] / (double)s->plan->spp[last - 1]));
}

static void add_biases(const struct scene_results *s, struct findings *f)
{
    char own[32] = "not known";
    if (isfinite(s->reference.mean_error))
        snprintf(own, sizeof own, "%.2g %%", 100 * s->reference.mean_error);
    for (int v = 0; v < N_COMPARED; v++) {
        struct bias b = results_bias(s, v, plan_last_step(s->plan));
        if (isfinite(b.p))
            add_finding(f,
                        "The mean of %s is off by %+.3f %% with a standard error over seeds of %.2g %% (that of the "
                        "reference: %s), p = %.2g: %s.",
                        VARIANTS[v].label, 100 * b.mean, 100 * b.error, own, b.p,
                        b.p < 0.01 ? "a bias" : "no bias seen");
    }
}

static void add_equal_times(const struct scene_results *s, struct findings *f)
{
    char text[64];
    int last = plan_last_step(s->plan);
    for (int v = VARIANT_BDPT + 1; v < N_COMPARED; v++) {
        struct interval i = results_equal_time(s, v, last);
        if (isfinite(i.value))
            add_finding(f, "At equal time the squared error of %s is that of BDPT times %s: %s.", VARIANTS[v].label,
                        interval_text(i, text), OUTCOMES[outcome_of(i)]);
        else
            add_finding(f, "At equal time %s cannot be compared: its error is below the noise of the reference.",
                        VARIANTS[v].label);
    }
}

/* --- all scenes -------------------------------------------------------------------------------------- */

static void add_agreement(const struct results *r, struct findings *f)
{
    int count[3] = {0, 0, 0}, scenes = 0;
    for (int i = 0; i < r->plan->n_scenes; i++) {
        const struct scene_results *s = &r->scene[i];
        long at;
        double printed = printed_ratio(s, &at);
        if (!isfinite(printed))
            continue;
        scenes++;
        count[agreement(results_rmse_ratio(s, VARIANT_BINS, plan_last_step(r->plan)), printed)]++;
    }
    if (scenes > 0)
        add_finding(f,
                    "Whether bins has a lower or a higher RMSE than BDPT at the same number of samples agrees with the "
                    "dissertation in %d of %d scenes, differs in %d and is undecided in %d.",
                    count[AGREES], scenes, count[DIFFERS], count[NOT_DECIDED]);
}

static void add_gains(const struct results *r, int variant, struct findings *f)
{
    int count[3] = {0, 0, 0}, known = 0;
    double log_sum = 0;
    for (int i = 0; i < r->plan->n_scenes; i++) {
        struct interval ratio = results_equal_time(&r->scene[i], variant, plan_last_step(r->plan));
        count[outcome_of(ratio)]++;
        if (isfinite(ratio.value)) {
            known++;
            log_sum += m_log(ratio.value);
        }
    }
    add_finding(
        f,
        "At equal time %s has less squared error than BDPT in %d of %d scenes, more in %d, undecided in %d; the "
        "geometric mean of the ratios is %.3f.",
        VARIANTS[variant].label, count[OUTCOME_GAIN], r->plan->n_scenes, count[OUTCOME_LOSS], count[OUTCOME_UNDECIDED],
        known > 0 ? m_exp(log_sum / known) : NAN);
}

static void add_bias_counts(const struct results *r, struct findings *f)
{
    int biased[N_COMPARED] = {0};
    if (r->plan->n_seeds < 2)
        return;
    for (int i = 0; i < r->plan->n_scenes; i++)
        for (int v = 0; v < N_COMPARED; v++)
            biased[v] += results_bias(&r->scene[i], v, plan_last_step(r->plan)).p < 0.01;
    add_finding(
        f,
        "The mean of the picture is off (p < 0.01) in %d of %d scenes for BDPT, %d for bins, %d for pool, %d for "
        "vertices and %d for subspaces.",
        biased[VARIANT_BDPT], r->plan->n_scenes, biased[VARIANT_BINS], biased[VARIANT_POOL], biased[VARIANT_VERTICES],
        biased[VARIANT_SUBSPACES]);
}

void findings_make(const struct results *r, const struct scene_results *s, struct findings *out)
{
    out->n = 0;
    if (s != NULL) {
        add_comparison_with_printed(s, out);
        add_equal_times(s, out);
        add_convergence(s, out);
        add_biases(s, out);
        return;
    }
    add_agreement(r, out);
    for (int v = VARIANT_BDPT + 1; v < N_COMPARED; v++)
        add_gains(r, v, out);
    add_bias_counts(r, out);
    if (r->plan->n_seeds < 2)
        add_finding(out, "One seed gives no confidence intervals: every comparison stays undecided.");
}
