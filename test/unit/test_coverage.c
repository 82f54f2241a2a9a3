/* test_coverage.c: do intervals of squared errors hold the truth as often as they say? On pictures of a known
 * expectation, with noise as rare light makes it, against noisy references and one without noise. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/number.h"
#include "lab/equal.h"
#include "lab/sides.h"
#include "lab/stats.h"
#include "helpers.h"
#include "suites.h"

enum { MOST = 3 * 64 * 48, SPP = 16, BATCHES = 4, TRIALS = 40 };

struct size {
    int w, h, values;
};
static const struct size LARGE = {64, 48, MOST}, SMALL = {24, 16, 3 * 24 * 16};

/* Two methods: a sample has light with this probability, and then the more. */
static const double CHANCE[2] = {0.4, 0.1};

/* From .02 to 1, and every ninth pixel beyond white. */
static void expect(struct size size, float mean[MOST])
{
    for (int i = 0; i < size.values; i++)
        mean[i] = (float)(i / 3 % 9 == 0 ? 2 : 0.02 * pow(50, 3.0 * (i / 3) / size.values));
}

/* How many of spp samples have light: the least k at which the distribution function is above u. */
static int hits(double p, int spp, double u)
{
    double term = pow(1 - p, spp);
    int k = 0;
    for (; k < spp && u >= term; k++) {
        u -= term;
        term *= p / (1 - p) * (spp - k) / (k + 1);
    }
    return k;
}

static void draw(struct rng *r, struct size size, const float *mean, int method, int spp, float *out)
{
    for (int i = 0; i < size.values; i += 3) {
        double lit = hits(CHANCE[method], spp, rng_uniform(r)) / (CHANCE[method] * spp);
        for (int c = 0; c < 3; c++)
            out[i + c] = (float)((double)mean[i + c] * lit);
    }
}

/* A reference by the second method, of two sides as reference_make has them. */
static bool make_reference(struct test *t, struct rng *r, const float *mean, int spp, struct reference *out)
{
    char name[300];
    float pixels[MOST];
    struct error err = {.text = ""};
    struct side side[2];
    struct provenance from = {"test", "here", 0, 0, NULL};
    for (int s = 0; s < 2; s++) {
        side[s] = (struct side){"b", LARGE.w, LARGE.h, batches_new(BATCHES, MOST, false)};
        for (int k = 0; k < BATCHES; k++) {
            draw(r, LARGE, mean, 1, spp, pixels);
            for (int i = 0; i < MOST; i++)
                side[s].pixels.value[MOST * k + i] = (double)pixels[i];
        }
    }
    snprintf(name, sizeof name, "%s/drawn", test_tmp(t));
    bool ok = CHECK(t, sides_store(name, &side[0], &side[1], &from, &err), "%s", err.text);
    snprintf(name, sizeof name, "%s/drawn.pfm", test_tmp(t));
    ok = ok && CHECK(t, reference_find(name, "", "drawn", out, &err), "%s", err.text);
    for (int s = 0; s < 2; s++)
        batches_free(&side[s].pixels);
    return ok;
}

/* Mean squared errors of the first method over those of the second, against what is expected. */
static void measure_truth(struct rng *r, struct size size, int n, double ratio[N_SQUARES])
{
    float mean[MOST], x[MOST];
    double square[N_SQUARES], sum[2][N_SQUARES] = {{0}};
    expect(size, mean);
    for (int i = 0; i < 2 * n; i++) {
        draw(r, size, mean, i % 2, SPP, x);
        compare_squares(x, mean, mean, size.w, size.h, square);
        for (int k = 0; k < N_SQUARES; k++)
            sum[i % 2][k] += square[k];
    }
    for (int k = 0; k < N_SQUARES; k++)
        ratio[k] = sum[0][k] / sum[1][k];
}

/* One measurement of both methods, of this many samples, against the reference. */
static void measure_once(struct rng *r, struct size size, const float *mean, struct scene_results *s)
{
    float x[MOST];
    for (int v = 0; v < 2; v++)
        for (int i = 0; i < s->plan->n_seeds; i++) {
            struct run *run = &s->run[v][i][0];
            run->spp = SPP;
            draw(r, size, mean, v, SPP, x);
            compare_squares(x, s->reference.pixels, s->reference.pixels, size.w, size.h, run->square);
            for (int k = 0; k < N_SQUARES; k++)
                run->square[k] -= s->reference.noise[k];
        }
}

/* A plan of two methods, and room for what is measured; both to be freed at once. */
struct trial {
    struct plan plan;
    struct scene_results scene;
};

static struct trial *trial_new(int seeds)
{
    struct trial *out = mem_alloc(1, sizeof *out);
    out->plan = (struct plan){.n_seeds = seeds, .n_scenes = 1, .n_steps = 1, .spp = {SPP}, .equal = true,
                              .reference = "given"};
    out->plan.methods.n = out->plan.n_compared = 2;
    out->scene.plan = &out->plan;
    for (int i = 0; i < 2 * seeds; i++)
        out->scene.price[i % 2][i / 2] = (struct price){0, 1};
    return out;
}

/* Of measurements against references of so many samples at most one in ten has an interval without the truth, whether
 * or not there are numbers; against clean ones there are. What references say of their own noise is true. */
static void check_noisy(struct test *t, int seeds, int reference_spp, bool clean, const double ratio[N_SQUARES])
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 880, (uint64_t)(100 * reference_spp + seeds));
    struct trial *trial = trial_new(seeds);
    struct reference *reference = &trial->scene.reference;
    int told[N_SQUARES] = {0}, wrong[N_SQUARES] = {0};
    double noise = 0, real = 0, square[N_SQUARES];
    float mean[MOST];
    expect(LARGE, mean);
    for (int n = 0; n < TRIALS && make_reference(t, &r, mean, reference_spp, reference); n++) {
        measure_once(&r, LARGE, mean, &trial->scene);
        compare_squares(reference->pixels, mean, mean, LARGE.w, LARGE.h, square);
        noise += reference->noise[SQUARE_MSE8] / TRIALS;
        real += square[SQUARE_MSE8] / TRIALS;
        for (int k = 0; k < N_SQUARES; k++) {
            struct interval i = equal_ratio(&trial->scene, 0, 1, (enum square)k);
            told[k] += isfinite(i.value);
            wrong[k] += i.low > ratio[k] || i.high < ratio[k];
        }
        reference_free(reference);
    }
    for (int k = 0; k < N_SQUARES; k++)
        CHECK(t, wrong[k] <= TRIALS / 10 && (!clean || told[k] > TRIALS * 9 / 10), "%d seeds, a reference of %d "
              "samples: %d of %d measurements have %s, %d of them a wrong one", seeds,
              2 * BATCHES * reference_spp, told[k], TRIALS, EQUAL_NAMES[k], wrong[k]);
    CHECK(t, noise > real / 1.4 && noise < real * 1.4, "the reference's squared error is %g, not %g", noise, real);
    free(trial);
}

/* The probability that so many or more of n intervals miss, if each misses with 0.05. */
static double miss_p(int wrong, int n)
{
    double sum = 0;
    for (int k = wrong; k <= n; k++)
        sum += exp(lgamma(n + 1.0) - lgamma(k + 1.0) - lgamma(n - k + 1.0) + k * log(0.05) + (n - k) * log(0.95));
    return sum;
}

/* Against what is expected itself, intervals of five seeds hold the truth in 95 of 100 measurements, and no more than
 * that: those of 92 of 100 are told apart. (Noise of references makes them wider.) */
static void check_exact(struct test *t, int many)
{
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 882, 0);
    struct trial *trial = trial_new(5);
    int wrong[N_SQUARES] = {0}, n = many * test_effort(t);
    double ratio[N_SQUARES];
    float mean[MOST];
    measure_truth(&r, SMALL, 1000, ratio);
    expect(SMALL, mean);
    trial->scene.reference.pixels = mean;
    for (int i = 0; i < n; i++) {
        measure_once(&r, SMALL, mean, &trial->scene);
        for (int k = 0; k < N_SQUARES; k++) {
            struct interval x = equal_ratio(&trial->scene, 0, 1, (enum square)k);
            wrong[k] += !(x.low <= ratio[k] && x.high >= ratio[k]);
        }
    }
    for (int k = 0; k < N_SQUARES; k++)
        TEST_ACCEPT(t, miss_p(wrong[k], n), "%d of %d intervals of %s miss the truth", wrong[k], n, EQUAL_NAMES[k]);
    TEST_REJECT(t, miss_p(many * 8 / 100, many), "of %d intervals 8 %% miss the truth", many);
    free(trial);
}

void test_coverage(struct test *t)
{
    double ratio[N_SQUARES];
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 881, 0);
    measure_truth(&r, LARGE, 200, ratio);
    check_noisy(t, 2, 2, false, ratio); /* as noisy as what is measured */
    check_noisy(t, 5, 40, true, ratio);
    check_exact(t, 1200);
}

void test_coverage_long(struct test *t)
{
    double ratio[N_SQUARES];
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 881, 0);
    measure_truth(&r, LARGE, 200, ratio);
    check_noisy(t, 5, 2, false, ratio);
    check_noisy(t, 2, 40, true, ratio);
    check_exact(t, 2500);
}

/* --- the suite claimed ---------------------------------------------------------------------------------------- */

static const char CORNER[] =
    "LookAt 1 2 3  0 .5 0  0 1 0 Camera \"perspective\" \"float fov\" 20\n"
    "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4 PixelFilter \"box\" WorldBegin\n"
    "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] " QUAD("-1 3 0  1 3 0  1 3 2  -1 3 2")
    "AttributeEnd Material \"matte\" \"rgb Kd\" [.6 .5 .4]\n"
    QUAD("-4 0 0  4 0 0  4 0 4  -4 0 4")
    QUAD("-4 0 0  4 0 0  4 4 0  -4 4 0") "WorldEnd\n";

enum { SETS = 1000, EACH = 4, OF_SET = 2, SIDE = 4 };

/* Two-sided p-value of "the claimed errors are right". */
static double claim_p(const double *value, const double *error, double dof, double *ratio)
{
    double mean = 0, scatter = 0, claimed = 0;
    for (int i = 0; i < SETS; i++)
        mean += value[i] / SETS;
    for (int i = 0; i < SETS; i++) {
        scatter += sqr(value[i] - mean) / (SETS - 1);
        claimed += sqr(error[i]) / SETS;
    }
    *ratio = sqrt(claimed / scatter);
    double more = stats_fisher_p(scatter / claimed, SETS - 1, dof * SETS);
    return 2 * fmin(more, 1 - more);
}

static void check_claims(struct test *t, const char *method, const char *what, const double *value, double *error,
                         double dof)
{
    double ratio, p = claim_p(value, error, dof, &ratio);
    TEST_ACCEPT(t, p, "%s, %s: errors are %.4f of the scatter", method, what, ratio);
    for (int i = 0; i < SETS; i++)
        error[i] *= 0.85;
    p = claim_p(value, error, dof, &ratio);
    TEST_REJECT(t, p, "%s, %s: errors made 15 %% smaller, %.4f of the scatter", method, what, ratio);
}

/* Set number i. */
static struct batches set_of(const struct batches *all, int i)
{
    struct batches set = *all;
    set.n_batches = EACH;
    set.value += all->n * EACH * i;
    return set;
}

/* Of the mean of a picture, and of the ratio of two means as `verify` says it. */
static void test_method(struct test *t, struct scene *scene, const char *way)
{
    double *value = mem_alloc(SETS, sizeof *value), *error = mem_alloc(SETS, sizeof *error);
    const char *integrator = set_method(scene, way);
    struct batches a = render_batches(t, scene, integrator, 3, OF_SET, SETS * EACH, SIDE, 61);
    struct batches b = render_batches(t, scene, integrator, 3, OF_SET, SETS * EACH, SIDE, 62);
    for (int i = 0; i < SETS; i++) {
        const struct batches set = set_of(&a, i);
        value[i] = batches_mean(&set, &error[i]);
    }
    check_claims(t, way, "mean", value, error, EACH - 1);
    for (int i = 0; i < SETS; i++) {
        const struct batches x = set_of(&a, i), y = set_of(&b, i);
        const struct verdict v = verify_batches(&x, &y, test_seed(t));
        value[i] = v.ratio;
        error[i] = v.ratio_error;
    }
    check_claims(t, way, "ratio", value, error, 2 * (EACH - 1));
    batches_free(&a);
    batches_free(&b);
    free(value);
    free(error);
}

/* claimed: the standard errors that renders in batches claim are their scatter, by the test of two variances
 * of [Subr & Arvo 2007].
 *
 * A set of EACH independent batches claims the error of its mean, from dof degrees of freedom. Of SETS such sets the
 * variance of the means, over the mean of the claimed variances, is distributed as Fisher's F with SETS - 1 and
 * dof SETS degrees of freedom. That is exact of normal values; means of 16 pixels of a corner whose lamp is not seen are
 * nearly so. (Ratios of noisier means scatter more than their errors say, which are linear in both.) Errors that are 15 %
 * too small must be found.
 */
void test_claimed(struct test *t)
{
    static const char *const WAYS[] = {"pt", "asbdpt"};
    struct scene scene;
    if (!scene_from_text(t, CORNER, &scene))
        return;
    for (int i = 0; i < 2; i++)
        test_method(t, &scene, WAYS[i]);
    scene_free(&scene);
}
