/* test_ris.c: the weights of ris (test/lab/rivals): those of all strategies that make a path sum to 1, draws have the
 * probabilities that they say, and records know what they have met. */
#include <math.h>
#include <string.h>

#include "rivals/ris.h"
#include "bench.h"
#include "helpers.h"
#include "oracle.h"
#include "suites.h"

enum { SIDE = 16 };

/* The eye vertex that lies where light vertex x does, the eye walk coming from z with that density, 1/sr, there: what
 * strategies with fewer light vertices have of the same path. */
static struct vertex as_eye_vertex(const struct vertex *x, const struct vertex *z, double pdf)
{
    struct vertex v = *x;
    vec3 d = sub(x->p, z->p);
    v.wo = neg(normalize(d));
    v.kind = VERTEX_SURFACE;
    v.prev_delta = false;
    v.g = vertex_cosine(z, v.wo) / length2(d);
    v.pdf_fwd = pdf * abs_dot(x->ng, v.wo) / length2(d);
    v.beta = rgb_grey(1);
    return v;
}

/* The strategies s, s - 1 ... 0 of the path of s light vertices and two eye vertices, all one after the other weighed
 * by ris: each takes the last light vertex of the one before for an eye vertex. Returns the sum. */
static double sum_weights(struct cache *r, const struct vertex *light, int s, struct vertex *eye)
{
    double sum = 0;
    for (int t = 2; s >= 0; s--, t++) {
        struct vertex *z = &eye[t - 1];
        struct connection c;
        if (s >= 2) {
            struct joint j;
            if (!connect_join(&light[s - 1], z, &j))
                return NAN;
            r->one = r->all = ris_worth(r, &light[s - 1], z);
            c = ris_joint(r, &j);
            eye[t] = as_eye_vertex(&light[s - 1], z, j.pdf_z);
        } else if (s == 1) {
            struct light_point at = vertex_light_point(r->scene, light);
            struct lit l;
            at.pdf = at.pdf_cell = light->pdf_fwd;
            if (!connect_light(r->scene, z, &at, at.pdf, &l))
                return NAN;
            c = ris_lit(r, &l);
            eye[t] = as_eye_vertex(light, z, l.pdf_z);
        } else {
            c = ris_hit(r, &eye[t - 2], z, t);
        }
        sum += rgb_is_black(c.value) ? NAN : c.weight;
    }
    return sum;
}

/* What an eye vertex draws from: probabilities sum to 1, and evenly spread numbers draw by them, each part of the
 * mixture being off by less than one number. */
static void check_mixture(struct test *t, const struct cache *r, const struct vertex *z)
{
    enum { NUMBERS = 5000, MOST = 4000 };
    static int drawn[MOST];
    int V = r->V, which, parts = RECORDS_NEAR + 1;
    double sum = 0, worst = 0;
    if (!CHECK(t, V > 0 && V <= MOST, "%d light vertices", V))
        return;
    struct mixture m = records_mixture(&r->records, r->scene, z, 0.5, false, V);
    memset(drawn, 0, sizeof drawn);
    for (int i = 0; i < NUMBERS; i++)
        drawn[mixture_draw(&m, (i + 0.5) / NUMBERS, &which)]++;
    for (int v = 0; v < V; v++) {
        double P = mixture_pmf(&m, v);
        sum += P;
        worst = fmax(worst, fabs(drawn[v] - P * NUMBERS));
    }
    CHECK(t, fabs(sum - 1) < 1e-12 && worst <= parts, "P sums to 1 but for %g, draws are off by %g", sum - 1, worst);
}

/* Given the pool, the mean of what an eye vertex z_1 draws is the sum over all it could draw, over K. */
static void check_draws(struct test *t, struct cache *r, const char *method, struct sample sample,
                        const struct vertex *z)
{
    enum { BATCHES = 32, DRAWS = 300 };
    struct batches drawn = batches_new(BATCHES, 1, false);
    double expected = 0;
    sample.choice = sampler_start(test_seed(t), RNG_TEST, (uint64_t)sample.x, (uint64_t)sample.y);
    sample.filter_weight = 1;
    for (int v = 0; v < r->V; v++) {
        const struct vertex *y = r->found[v];
        struct joint j;
        r->one = r->all = ris_worth(r, y, z);
        if (drawn_vertex(y, 1).end + 2 > sample.pass->job->max_depth + 2 || !connect_join(y, z, &j))
            continue;
        struct connection k = ris_joint(r, &j);
        expected += rgb_is_black(k.value) ? 0 : rgb_luminance(k.value) * k.weight * (r->u != NULL ? r->u[v] : 1) / r->K;
    }
    for (int b = 0; b < BATCHES; b++) {
        sample.value = rgb_black();
        for (int i = 0; i < DRAWS * test_effort(t); i++)
            ris_join(r, &sample, z, 2);
        drawn.value[b] = rgb_luminance(sample.value) / (DRAWS * test_effort(t));
    }
    if (expected > 0)
        TEST_ACCEPT(t, mean_p(&drawn, expected), "%s, pixel (%d,%d): %g drawn, %g expected", method, sample.x,
                    sample.y, batches_mean(&drawn, NULL), expected);
    batches_free(&drawn);
}

/* Q of a record is what records of another iteration have met, not those of its own. */
static void check_expected(struct test *t, const struct cache *r)
{
    int same = 0;
    for (int i = 0; i < r->records.n; i++) {
        int near[RECORDS_NEAR], n = records_near(&r->records, r->scene, &r->records.item[i].z, 0, near);
        double sum = 0;
        for (int k = 0; k < n; k++)
            sum += r->records.item[near[k]].sum / r->K / n;
        same += fabs(sum - r->records.item[i].expected) < 1e-9 * sum;
    }
    CHECK(t, r->records.n > 0 && same == 0, "%d of %d records know what they have met", same, r->records.n);
}

/* Sums of weights, t = 1 being BDPT's by the oracle, of all light sub-paths of a pool of the given number of them, each
 * joined to the first hit of a pixel; twice, since what roulette has done must not matter. */
static void check_weights(struct test *t, const char *path, const char *method)
{
    struct scene scene;
    struct bench b;
    if (!scene_from_file(t, path, SIDE, SIDE, &scene) || !bench_new(t, &scene, set_method(&scene, method), 5, 0, &b))
        return;
    struct tile_pass pass = bench_pass(&b, 3, 4);
    struct cache r = {.scene = NULL};
    ris_begin(&r, &b.prepared, &pass, 3);
    check_expected(t, &r);
    double worst = 0, weight[16];
    int n = 0;
    for (int k = 0; k < r.K; k++)
        for (int s = 2; s <= r.pool->length[k] && pass_goes_on(&pass, k); s++) {
            const struct vertex *light = pool_path(r.pool, k);
            if (light[s - 1].prev_delta)
                break;
            struct sample sample = sample_begin(&pass, k, 3);
            struct vertex *eye = sample.eye;
            if (sample_eye_path(&sample, 2) < 2 || !oracle_weights(&scene, r.counts, light, s, eye, 2, weight))
                continue;
            if (s == 2)
                check_mixture(t, &r, &eye[1]);
            if (s == 2 && k % 20 == 0)
                check_draws(t, &r, method, sample, &eye[1]);
            double sum = sum_weights(&r, light, s, eye) + weight[s + 1];
            worst = sum == sum ? fmax(worst, fabs(sum - 1)) : worst; /* NaN: they do not see each other */
            n += sum == sum;
        }
    CHECK(t, n > 20 && worst < 1e-6, "%s: weights of %d paths sum to 1 but for %g", method, n, worst);
    ris_end(&r);
    bench_free(&b);
    scene_free(&scene);
}

void test_ris(struct test *t)
{
    check_weights(t, "scenes/cornell-box-modified.pbrt", "ris records=.02 subpaths=200 rrthreshold=1");
    check_weights(t, "scenes/cornell-box-modified.pbrt", "ris2 records=.02 presampled=30");
    check_weights(t, "scenes/veach-ajar.pbrt", "ris records=.02 subpaths=200");
    check_weights(t, "scenes/many-lights.pbrt", "ris records=.02 subpaths=200 emission=0.2");
}
