/* test_claimed.c: the standard errors that renders in batches claim are their scatter, by the test of two variances
 * of [Subr & Arvo 2007].
 *
 * A set of EACH independent batches claims the error of its mean, from dof degrees of freedom. Of SETS such sets the
 * variance of the means, over the mean of the claimed variances, is distributed as Fisher's F with SETS - 1 and
 * dof SETS degrees of freedom. That is exact of normal values; means of 16 pixels of a corner whose lamp is not seen are
 * nearly so. (Ratios of noisier means scatter more than their errors say, which are linear in both.) Errors that are 15 %
 * too small must be found.
 */
#include <math.h>
#include <stdlib.h>

#include "base/mem.h"
#include "base/number.h"
#include "helpers.h"
#include "lab/stats.h"
#include "suites.h"

static const char CORNER[] =
    "LookAt 1 2 3  0 .5 0  0 1 0 Camera \"perspective\" \"float fov\" 20\n"
    "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4 PixelFilter \"box\" WorldBegin\n"
    "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] " QUAD("-1 3 0  1 3 0  1 3 2  -1 3 2")
    "AttributeEnd Material \"matte\" \"rgb Kd\" [.6 .5 .4]\n"
    QUAD("-4 0 0  4 0 0  4 0 4  -4 0 4")
    QUAD("-4 0 0  4 0 0  4 4 0  -4 4 0") "WorldEnd\n";

enum { SETS = 1000, EACH = 4, SPP = 2, SIDE = 4 };

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
    struct batches a = render_batches(t, scene, integrator, 3, SPP, SETS * EACH, SIDE, 61);
    struct batches b = render_batches(t, scene, integrator, 3, SPP, SETS * EACH, SIDE, 62);
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
