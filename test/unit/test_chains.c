/* test_chains.c: Markov chains: their steps are as wide and as large as they must be, and their images are those of
 * bdpt. */
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "caustics/joint.h"
#include "caustics/lamp.h"
#include "chains/mlt.h"
#include "lab/stats.h"
#include "render/render.h"
#include "agree.h"
#include "bench.h"
#include "helpers.h"
#include "suites.h"

/* --- numbers ----------------------------------------------------------------------------------------- */

/* Are all numbers of `next` as near to those of `now` as those of a small step are? */
static bool is_near(const struct chain *c)
{
    for (int i = 0; i < CHAIN_STREAMS; i++)
        for (size_t k = 0; k < c->now.number[i].n && k < c->next.number[i].n; k++) {
            double d = fabs(c->next.number[i].number[k] - c->now.number[i].number[k]);
            if (fmin(d, 1 - d) > 8 * c->all->sigma)
                return false;
        }
    return true;
}

/* Small steps are normal, around the ends; after many of them, all accepted, a number may be anywhere. */
static void test_steps(struct test *t)
{
    enum { NUMBERS = 50, STEPS = 4000, CELLS = 20, EVERY = 40 };
    double where[CELLS] = {0}, how[CELLS] = {0}, even_where[CELLS], even_how[CELLS];
    struct scene scene;
    struct bench b;
    if (!chain_room(t, 4, 4, "", "box", &scene) || !bench_new(t, &scene, "pssmlt", CHAIN_DEPTH, 0, &b))
        return;
    struct chain *c = b.chain;
    const struct chains *all = b.prepared.own;
    struct primary p;
    double sigma = all->sigma;
    primary_begin(&p, c, false);
    for (int i = 0; i < NUMBERS; i++)
        sampler_number(&p.sampler[EYE_NUMBERS], DRAW_LOBE);
    primary_end(&p);
    chain_swap(c);
    long large = 0;
    for (int k = 0; k < STEPS; k++) {
        primary_begin(&p, c, true);
        for (int i = 0; i < NUMBERS; i++) {
            double u = sampler_number(&p.sampler[EYE_NUMBERS], DRAW_LOBE);
            double d = u - c->now.number[EYE_NUMBERS].number[i];
            d = (d > 0.5 ? d - 1 : d < -0.5 ? d + 1 : d) / sigma;
            double below = 0.5 * (1 + copysign(1 - stats_normal_p(d), d)); /* normal distribution function */
            CHECK(t, u >= 0 && u < 1, "a number is %g", u);
            how[(int)(below * CELLS) % CELLS]++;
            if (k % EVERY == EVERY - 1)
                where[(int)(u * CELLS)]++;
        }
        primary_end(&p);
        chain_swap(c);
    }
    for (int i = 0; i < CELLS; i++) {
        even_where[i] = (double)NUMBERS * (STEPS / EVERY) / CELLS;
        even_how[i] = (double)NUMBERS * STEPS / CELLS;
    }
    chain_candidate(c, 1);
    chain_swap(c);
    for (int k = 0; k < STEPS; k++) {
        chain_propose(c);
        large += !is_near(c);
    }
    double z = ((double)large - all->large_step * STEPS) / sqrt(STEPS * all->large_step * (1 - all->large_step));
    TEST_ACCEPT(t, stats_chi2_test(how, even_how, CELLS), "steps are normal");
    /* numbers EVERY steps apart are not independent: the bound is wide, and far below what a wall at the ends makes */
    double chi = 0;
    for (int i = 0; i < CELLS; i++)
        chi += (where[i] - even_where[i]) * (where[i] - even_where[i]) / even_where[i];
    CHECK(t, chi < 6 * CELLS, "numbers are not uniform: chi-square %g of %d cells", chi, CELLS);
    TEST_ACCEPT(t, stats_normal_p(z), "large steps are as frequent as wanted: %ld of %d", large, STEPS);
    bench_free(&b);
    scene_free(&scene);
}

/* --- sub-paths walked again --------------------------------------------------------------------------- */

static bool near_to(double a, double b) { return fabs(a - b) <= 1e-9 * fabs(b); }

/* A light sub-path that goes again through the vertices of one that was walked is that one, whatever its stops know. */
static void test_follow(struct test *t)
{
    enum { PATHS = 500 };
    struct scene scene;
    struct bench b;
    int met = 0;
    if (!chain_room(t, 4, 4, "", "box", &scene) || !bench_new(t, &scene, "mlt", CHAIN_DEPTH, 0, &b))
        return;
    for (uint64_t i = 0; i < PATHS; i++) {
        struct vertex walked[CHAIN_DEPTH + 1], again[CHAIN_DEPTH + 1];
        struct path_stop stop[CHAIN_DEPTH + 1];
        struct sampler sampler = sampler_start(test_seed(t), RNG_TEST, 17, i);
        struct walk w = {&scene, &b.chain->all->counts, &b.work->arena, &sampler, 0};
        int n = path_light(&w, walked, CHAIN_DEPTH + 1, NULL), smooth = n > 0;
        while (smooth < n && !walked[smooth].prev_delta && walked[smooth].kind == VERTEX_SURFACE)
            smooth++;
        for (int k = 0; k < smooth; k++) {
            stop[k] = (struct path_stop){.v = walked[k]};
            if (k > 0) {
                stop[k].v.mis = stop[k].v.pdf_fwd = -1;
                stop[k].v.beta = rgb_grey(-1);
            }
        }
        if (smooth == 0 || !CHECK(t, follow_light(&w, stop, smooth, again) == smooth, "light does not come again"))
            continue;
        for (int k = 1; k < smooth; k++, met++) {
            CHECK(t, near_to(again[k].mis, walked[k].mis) && near_to(again[k].g, walked[k].g),
                  "vertex %d: weights %g, not %g", k, again[k].mis, walked[k].mis);
            CHECK(t, near_to(again[k].pdf_fwd, walked[k].pdf_fwd) && near_to(again[k].mis_c, walked[k].mis_c),
                  "vertex %d: density %g, not %g", k, again[k].pdf_fwd, walked[k].pdf_fwd);
            CHECK(t, near_to(again[k].beta.r, walked[k].beta.r) && near_to(again[k].beta.b, walked[k].beta.b),
                  "vertex %d: throughput %g, not %g", k, again[k].beta.r, walked[k].beta.r);
        }
    }
    CHECK(t, met > PATHS / 2, "only %d vertices met again", met);
    bench_free(&b);
    scene_free(&scene);
}

/* --- the pool of states ------------------------------------------------------------------------------- */

/* Goes on when asked so many times. */
static enum cancel hurry(void *context)
{
    int *left = context;
    *left -= *left >= 0;
    return *left < 0 ? CANCEL_BLOCK : CANCEL_NOT;
}

/* The luminance of a picture of so many samples, for whose pool of states somebody waits so many times. */
static double luminance(struct test *t, const struct scene *scene, const char *integrator, long spp, int waits)
{
    struct film film;
    double sum = 0;
    struct render_job o = {.integrator = method_of(scene, integrator), .end = spp, .max_depth = CHAIN_DEPTH,
                               .n_threads = 1, .seed = test_seed(t), .cancel = hurry, .context = &waits};
    render_film(t, scene, &o, &film);
    for (size_t i = 0; i < (size_t)scene->width * (size_t)scene->height; i++)
        sum += rgb_luminance(rgb_make(film_value(&film, 3 * i), film_value(&film, 3 * i + 1),
                                      film_value(&film, 3 * i + 2)));
    double mean = sum / (double)film.iterations;
    film_free(&film);
    return mean;
}

/* Without a state no chain begins, with some states it does. */
static void test_no_start(struct test *t)
{
    struct scene scene;
    if (!chain_room(t, 16, 16, "", "box", &scene))
        return;
    double none = luminance(t, &scene, "mmlt", 32, 0), some = luminance(t, &scene, "mmlt", 32, 4);
    CHECK(t, none == 0 && some > 0, "pictures have %g without states, %g with some", none, some);
    scene_free(&scene);
}

/* --- pictures ---------------------------------------------------------------------------------------- */

/* A lamp of which one state in some thousand sees anything is bright enough for a third of the light. A pool that is
 * large enough knows its brightness; that of 256 states does not. */
static void test_rare_lamp(struct test *t, const char *const *methods)
{
    static const char room[] =
        "LookAt 0 0 -.9 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" 80\n"
        "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8\nPixelFilter \"box\"\n"
        "WorldBegin\nMaterial \"matte\" \"rgb Kd\" [.5 .5 .5]\n"
        "ReverseOrientation\nShape \"sphere\" \"float radius\" 1\nReverseOrientation\n"
        "AttributeBegin\nTranslate .4 .4 .3\nAreaLightSource \"diffuse\" \"rgb L\" [6 6 6]\n"
        "Shape \"sphere\" \"float radius\" .1\nAttributeEnd\n"
        "LightSource \"spot\" \"point from\" [0 .9 0] \"point to\" [0 -1 .1] \"rgb I\" [3e3 3e3 3e3]\n"
        "\"float coneangle\" 1 \"float conedeltaangle\" .1\nWorldEnd\n";
    static const char *const STATES[] = {"1", "400000"};
    struct scene scene;
    if (!scene_from_text(t, room, &scene))
        return;
    double truth = luminance(t, &scene, "bdpt", 1024, INT_MAX), found[2];
    for (; *methods != NULL; methods++) {
        for (int i = 0; i < 2; i++) {
            settings_set(&scene.settings, "starts", STATES[i], "test");
            found[i] = luminance(t, &scene, *methods, 256, INT_MAX);
        }
        CHECK(t, fabs(found[1] / truth - 1) < 0.05, "%s: the picture has %g, bdpt's %g", *methods, found[1], truth);
        CHECK(t, fabs(found[0] / truth - 1) > 0.1, "%s: %g of few states is right", *methods, found[0]);
    }
    scene_free(&scene);
}

static void test_means(struct test *t, const char *methods, int more)
{
    struct scene scene;
    struct agreement a = {"room", 16, 16, CHAIN_DEPTH, "bdpt", methods, 16, 64, 48, 8, false, 0.3};
    if (chain_room(t, 16, 16, "\"float lensradius\" .05 \"float focaldistance\" 4", "gaussian", &scene)) {
        check_agreement_in(t, &scene, &a, more);
        scene_free(&scene);
    }
    a.scene = "scenes/cornell-box";
    check_agreements(t, &a, more > 1, more);
}

static const char *const METHODS[] = {"pssmlt", "mmlt", "mlt", NULL};
static const char *const QUICK[] = {"mmlt", NULL}; /* they all share chain.c, which makes pictures of states */

void test_chains(struct test *t)
{
    test_steps(t);
    test_follow(t);
    test_no_start(t);
    test_rare_lamp(t, QUICK);
    test_means(t, "mmlt starts=20000", 1);
}

void test_chains_long(struct test *t)
{
    test_rare_lamp(t, METHODS);
    test_means(t, "pssmlt starts=20000, mmlt starts=20000, mlt starts=20000", 8);
    static const struct agreement guided = {"scenes/test/light-kinds", 16, 16, CHAIN_DEPTH, "bdpt",
                                            "pssmlt starts=20000 guide=on, mmlt starts=20000 guide=on",
                                            16, 64, 48, 8, false, 0.3};
    check_agreements(t, &guided, 1, 8);
}

/* --- the suite balance ---------------------------------------------------------------------------------------- */

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

/* balance: Markov chains, each mutation alone: moves and reverse moves balance, and a path of mlt that is made
 * again is the same path. */
void test_balance(struct test *t)
{
    test_paths(t);
    test_method(t, "pssmlt");
    test_method(t, "mmlt");
    test_method(t, "mlt");
}
