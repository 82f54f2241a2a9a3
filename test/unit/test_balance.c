/* test_balance.c: Markov chains, each mutation alone: moves and reverse moves balance, and a path of mlt that is made
 * again is the same path. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "caustics/joint.h"
#include "caustics/lamp.h"
#include "chains/mlt.h"
#include "bench.h"
#include "suites.h"

/* --- paths made again -------------------------------------------------------------------------------- */

/* A path made again where it is, by whichever strategy a perturbation uses, counts as it did when another had made it:
 * that depends on the path alone. */
static void test_remake(struct test *t, struct scene *scene, long made[MLT_PERTURBATIONS])
{
    struct bench b;
    settings_set(&scene->settings, "starts", "81920", "test");
    if (!bench_new(t, scene, "mlt", CHAIN_DEPTH, 0, &b))
        return;
    struct chain *c = b.chain;
    const struct chains *all = b.prepared.own;
    for (long i = 0; i < all->n; i += 4) {
        chain_candidate(c, i);
        if (!(c->next.I > 0))
            continue;
        chain_swap(c);
        const struct mlt_path *path = c->now.own;
        for (int which = 0; which < MLT_PERTURBATIONS; which++) {
            struct strategy to = {.n = c->now.length > 2 ? c->now.length : 1};
            struct primary p = {.chain = c};
            if (!path->can[which])
                continue;
            struct mlt_move stay = mlt_stay(path, (enum mlt_perturbation)which);
            double L = mlt_remake(&p, path, (enum mlt_perturbation)which, &stay, &to);
            primary_end(&p);
            CHECK(t, L > 0 && fabs(c->next.I / c->now.I - 1) < 1e-9,
                  "path %ld, k %d, m %d, l %d, strategy %d,%d: %g, not %g", i, path->k, path->m, path->l, to.s, to.t,
                  c->next.I, c->now.I);
            made[which]++;
        }
    }
    bench_free(&b);
}

static void test_paths(struct test *t)
{
    static const char *const LENS[] = {"", "\"float lensradius\" .05 \"float focaldistance\" 4"};
    long made[MLT_PERTURBATIONS] = {0, 0};
    struct scene scene;
    for (int i = 0; i < 2; i++)
        if (chain_room(t, 16, 16, LENS[i], "gaussian", &scene)) {
            test_remake(t, &scene, made);
            scene_free(&scene);
        }
    CHECK(t, made[0] > 1000 && made[1] > 40, "only %ld and %ld paths", made[0], made[1]);
}

/* --- balance ----------------------------------------------------------------------------------------- */

/* The probability of a new path, of mlt. */
static double chance(const struct chain *c, const struct mlt_path *path)
{
    return path->can[LENS_PERTURBATION] || path->can[CAUSTIC_PERTURBATION] ? c->all->large_step : 1;
}

/* L of the path whose sub-paths have just been made again, by its strategy's own functions. */
static double contribution(struct chain *c, const struct mlt_path *path, enum mlt_perturbation which,
                           const struct mlt_move *move, struct primary *p, const struct strategy *strategy)
{
    const struct scene *scene = c->job->scene;
    const struct counts *counts = &c->all->counts;
    const struct vertex *light = c->light, *eye = c->work->eye, *x = &light[path->l];
    int s = strategy->s, n = strategy->t;
    struct light_point at = vertex_light_point(scene, &path->x[0].v);
    if (which == LENS_PERTURBATION) {
        struct connection c2 = s == 0   ? connect_s0(scene, counts, &eye[n - 2], &eye[n - 1])
                               : s == 1 ? lamp_connect(scene, counts, &eye[n - 1], &at, at.pdf)
                                        : connect_vertices(scene, counts, &light[s - 1], &eye[n - 1]);
        return rgb_luminance(c2.value);
    }
    p->state->number[LENS_NUMBERS].at = 0;
    double raster[2];
    struct connection c1 = connect_lens(scene, counts, &light[s - 1], &p->sampler[LENS_NUMBERS], raster);
    return rgb_luminance(c1.value) * (path->l == 0 ? light_pdf_emission(&scene->lights, &at, move->wi)
                                                   : bsdf_eval(&x->bsdf, x->wo, move->wi, IMPORTANCE).pdf);
}

/* What the latest proposal of mlt was: a perturbation, or MLT_PERTURBATIONS for a new path. */
static int mutation(const struct mlt_path *to)
{
    int which = 0;
    while (which < MLT_PERTURBATIONS && to->L[which] < 0)
        which++;
    return which;
}

/* Could b's caustic perturbation be by the angle that lies between a and b? */
static bool in_range(const struct chain *c, const struct mlt_path *a, const struct mlt_path *b)
{
    vec3 wa = mlt_stay(a, CAUSTIC_PERTURBATION).wi, wb = mlt_stay(b, CAUSTIC_PERTURBATION).wi;
    double angle = atan2(length(cross(wa, wb)), dot(wa, wb)), pixels = angle * mlt_pixels_per_angle(c, b);
    return pixels >= 0.1 && pixels <= sqrt(0.05 * c->all->width * c->all->height / PI);
}

/* The way back of a perturbation leads back: b moved to where a is counts as a. */
static void check_back(struct test *t, struct chain *c, enum mlt_perturbation which)
{
    const struct mlt_path *from = c->now.own, *to = c->next.own;
    double L = from->L[which], I = c->now.I;
    struct mlt_move move = mlt_stay(from, which);
    chain_swap(c);
    struct strategy strategy = {.n = c->now.length > 2 ? c->now.length : 1};
    struct primary p = {.chain = c};
    struct chain_state kept = c->next, room = {.length = kept.length};
    c->next = room; /* where the path from which it came is, is none of this one's business */
    double back = mlt_remake(&p, to, which, &move, &strategy);
    primary_end(&p);
    double plain = contribution(c, from, which, &move, &p, &strategy);
    CHECK(t, fabs(plain / back - 1) < 1e-9, "L is %g, not %g", back, plain);
    CHECK(t, fabs(back / L - 1) < 1e-6 && fabs(c->next.I / I - 1) < 1e-6,
          "the way back of a %s perturbation leads elsewhere: %g, %g",
          which == LENS_PERTURBATION ? "lens" : "caustic", back / L, c->next.I / I);
    for (int i = 0; i < CHAIN_STREAMS; i++)
        free(c->next.number[i].number);
    tile_free(&c->next.heard);
    c->next = kept;
    chain_swap(c);
}

/* How many moves there were, in all and such as put a rule to the test. */
struct moves {
    long all, doubtful;   /* accepted with less than 1 */
    long unlike, no_back; /* of mlt: new paths between states of other mutations; there, but not back */
};

/* One proposal: it leaves the present state alone, and T f a is the same both ways: what T is not alike both ways in is
 * the probability to choose the mutation; where there is no way back there is none there. */
static void check_proposal(struct test *t, struct chain *c, bool paths, struct moves *n)
{
    struct mlt_path *from = c->now.own, *to = c->next.own;
    double I = c->now.I, here = I, there;
    int which = MLT_PERTURBATIONS;
    if (paths)
        to->k = 0;
    double a = chain_propose(c);
    CHECK(t, c->now.I == I && a >= 0 && a <= 1, "a proposal changes the present state");
    if (!((there = c->next.I) > 0) || (paths && to->k == 0))
        return;
    if (paths && (which = mutation(to)) < MLT_PERTURBATIONS) {
        here = from->L[which];
        there = to->L[which];
    } else if (paths) {
        n->unlike += chance(c, from) < chance(c, to) || chance(c, from) > chance(c, to);
        here *= chance(c, from);
        there *= chance(c, to);
    }
    if (which == CAUSTIC_PERTURBATION && !in_range(c, from, to)) {
        n->no_back++;
        there = 0;
    } else if (which < MLT_PERTURBATIONS) {
        check_back(t, c, (enum mlt_perturbation)which);
    }
    double back = there > 0 ? there * fmin(1, here / there) : 0;
    CHECK(t, fabs(here * a - back) < 1e-9 * here, "mutation %d: there %g, back %g", which, here * a, back);
    n->doubtful += a < 1;
    n->all++;
}

/* From independent states, a few steps of a chain each; of mlt, from all that have a caustic or only new paths. */
static void test_method(struct test *t, const char *integrator)
{
    struct scene scene;
    struct bench b;
    struct moves n = {0, 0, 0, 0};
    bool paths = strcmp(integrator, "mlt") == 0;
    if (!chain_room(t, 16, 16, "\"float lensradius\" .05 \"float focaldistance\" 4", "gaussian", &scene))
        return;
    settings_set(&scene.settings, "starts", strcmp(integrator, "pssmlt") == 0 ? "16384" : "81920", "test");
    if (!bench_new(t, &scene, integrator, CHAIN_DEPTH, 0, &b))
        return;
    struct chain *c = b.chain;
    const struct chains *all = b.prepared.own;
    for (long i = 0; i < all->n; i += paths ? 1 : 23) {
        double I = all->before[i + 1] - all->before[i];
        if (!(I > 0))
            continue;
        chain_candidate(c, i);
        CHECK(t, fabs(c->next.I - I) < 1e-9 * all->before[all->n], "%s: a start is another",
              integrator);
        const struct mlt_path *path = c->next.own;
        if (i % 23 != 0 && !path->can[CAUSTIC_PERTURBATION] && path->can[LENS_PERTURBATION])
            continue;
        chain_swap(c);
        for (int k = 0; k < (paths && chance(c, c->now.own) >= 1 ? 60 : 4); k++)
            check_proposal(t, c, paths, &n);
    }
    /* of a move and its way back one is sure: about half are */
    CHECK(t, n.doubtful > 300 && 3 * n.doubtful > n.all && 3 * n.doubtful < 2 * n.all, "%s: %ld moves, %ld doubtful",
          integrator, n.all, n.doubtful);
    CHECK(t, !paths || (n.unlike > 30 && n.no_back > 10), "only %ld moves to other mutations, %ld without a way back",
          n.unlike, n.no_back);
    bench_free(&b);
    scene_free(&scene);
}

void test_balance(struct test *t)
{
    test_paths(t);
    test_method(t, "pssmlt");
    test_method(t, "mmlt");
    test_method(t, "mlt");
}
