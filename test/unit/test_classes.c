/* test_classes.c: scenes whose light takes paths of one class, a word such as SDDTS (random_class.h): all methods have
 * the expectation of bdpt.
 *
 * bdpt is compared with
 *     the default, and each runner of its race alone
 *     pool, vertices and subspaces, with parameters that are drawn
 *     pt     unless a specular letter follows a delta light
 *     lt     unless a specular letter is next to the lens
 * verify.h compares the means. If p is below CUTOFF both render again, with new seeds and ten times the samples. Then
 * the new p counts alone. All comparisons are one family: the least p is judged, by Sidak's formula. A p that is below
 * BEYOND_DOUBT fails by itself, whatever the number of comparisons.
 *
 * bdpt measures which share of the light the class has. If the share is below LEAST_SHARE, or the mean is not known to
 * 1/SIGMAS of the share, the scene is drawn again. So a method that lacks the class is noticed: each scene has a
 * planted fault, bdpt without the class.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "caustics/derived.h"
#include "helpers.h"
#include "lab/numbers.h"
#include "lab/stats.h"
#include "random_class.h"
#include "suites.h"

enum { BATCHES = 24, LEAST_SPP = 2, SIZE = 8, STAGES = 3, SHARE_SPP = 32, TRIES = 300 };
static const double LEAST_SHARE = 0.1, SIGMAS = 25, CUTOFF = 0.01, BEYOND_DOUBT = 1e-12;

/* --- which class a path is of --------------------------------------------------------------------------- */

/* What the walk does at v; next: the vertex after it, NULL if v is connected. */
static char letter_of(const struct scene *scene, const struct vertex *v, const struct vertex *next)
{
    vec3 w = next == NULL ? vec(0, 0, 0) : next->kind == VERTEX_ESCAPED ? neg(next->wo) : sub(next->p, v->p);
    if (v->kind == VERTEX_MEDIUM)
        return 'M';
    if (next != NULL && next->prev_delta)
        return dot(v->wo, v->ng) * dot(w, v->ng) > 0 ? 'S' : 'T';
    return strcmp(vertex_material(scene, v), "metal") == 0 ? 'G' : 'D';
}

static void word_of(const struct scene *scene, const struct joined *p, char *word)
{
    int last = p->s == 0 ? p->t - 2 : p->t - 1; /* s = 0: z is on the light */
    const struct vertex *eye = p->t > 1 ? p->z - (p->t - 1) : NULL;
    for (int i = 1; i < p->s; i++)
        *word++ = letter_of(scene, &p->path[i], i + 1 < p->s ? &p->path[i + 1] : NULL);
    for (int i = last; i >= 1; i--)
        *word++ = letter_of(scene, &eye[i], i + 1 < p->t ? &eye[i + 1] : NULL);
    *word = '\0';
}

struct share {
    const char *word;
    double class, all;
};

static void joined(void *context, const struct sample *sample, const struct joined *p)
{
    struct share *share = context;
    char word[CLASS_LETTERS + 8];
    double light = rgb_luminance(p->added);
    if (!(light > 0))
        return;
    word_of(sample->pass->job->scene, p, word);
    share->all += light;
    share->class += strcmp(word, share->word) == 0 ? light : 0;
}

static double share_of(struct test *t, const struct scene *scene, const struct random_class *c)
{
    struct share share = {c->word, 0, 0};
    const struct observer observer = {.context = &share, .joined = joined};
    struct bench b;
    if (!bench_new(t, scene, "bdpt", c->max_depth, 0, &b))
        return 0;
    struct tile_pass pass = bench_pass(&b, 0, SHARE_SPP);
    pass.observer = &observer;
    b.prepared.method->render(&b.prepared, &pass);
    bench_free(&b);
    return share.all > 0 ? share.class / share.all : 0;
}

/* --- comparisons ---------------------------------------------------------------------------------------- */

/* All comparisons. */
struct family {
    struct test *t;
    bool show; /* each is printed */
    int n, n_classes, redrawn;
    double least; /* p */
    char worst[256];
};

/* A class that is looked at. */
struct subject {
    struct family *all;
    uint64_t number;
    struct random_class made;
    struct scene scene;
    double share;
    int spp;                      /* of a batch at the first stage */
    struct batches right[STAGES]; /* by bdpt, as far as it is known */
};

static struct batches render(struct subject *s, const char *way, int stage)
{
    uint64_t seed = hash_combine(s->number, (uint64_t)stage);
    for (const char *c = way; *c != '\0'; c++)
        seed = hash_combine(seed, (uint64_t)*c);
    const char *integrator = set_method(&s->scene, way);
    return render_batches(s->all->t, &s->scene, integrator, s->made.max_depth, s->spp * (int)pow(10, stage), BATCHES,
                          SIZE, seed);
}

static const struct batches *right(struct subject *s, int stage)
{
    if (s->right[stage].value == NULL)
        s->right[stage] = render(s, "bdpt", stage);
    return &s->right[stage];
}

/* p of one expectation. NaN: 0. */
static double differ_p(const struct batches *a, const struct batches *b)
{
    double p = verify_batches(a, b, 1).p;
    return p >= 0 && isfinite(batches_mean(a, NULL)) && isfinite(batches_mean(b, NULL)) ? p : 0;
}

static void compare(struct subject *s, const char *way)
{
    struct family *all = s->all;
    double p = 1, ratio = 1;
    for (int stage = 0; stage < STAGES && !(stage > 0 && p >= CUTOFF) && !(stage > 1 && p < BEYOND_DOUBT); stage++) {
        struct batches x = render(s, way, stage);
        p = differ_p(&x, right(s, stage));
        ratio = batches_mean(&x, NULL) / batches_mean(right(s, stage), NULL);
        batches_free(&x);
    }
    char what[256];
    snprintf(what, sizeof what, "class %llu (%s %s %s), %s: %.4f of bdpt's light", (unsigned long long)s->number,
             s->made.light, s->made.word, s->made.camera, way, ratio);
    if (p < BEYOND_DOUBT)
        TEST_ACCEPT(all->t, p, "%s", what);
    if (all->n++ == 0 || p < all->least) {
        all->least = p;
        memcpy(all->worst, what, sizeof what);
    }
    if (all->show)
        printf("    p = %-8.3g %.4f of bdpt's light by %s\n", p, ratio, way);
}

/* Each runner alone; and one of those with rare draws, of a method with the loop of loop.h. */
static void compare_runners(struct subject *s)
{
    char way[64];
    for (int i = 0; i < RUNNERS; i++) {
        snprintf(way, sizeof way, "asbdpt race=%s", runner_name(i));
        compare(s, way);
    }
    int rare = RUNNER_PATH_TRACER + (int)(s->number / 2 % (RUNNERS - RUNNER_PATH_TRACER));
    snprintf(way, sizeof way, "asbdpt select=%s race=%s", s->number % 2 == 0 ? "pool" : "vertices", runner_name(rare));
    compare(s, way);
}

/* One of these, with the numbers of its list. */
static void compare_drawn(struct subject *s, struct rng *r, const char *name, bool numbers)
{
    static const char *const LISTS[] = {"", " guide=off", " emission=0.05", " delta=1", " tile=4 spread=1",
                                        " lightpoints=3 emission=1", " rrthreshold=0", " rrthreshold=4"};
    char way[128];
    snprintf(way, sizeof way, "%s%s", name, LISTS[rng_below(r, sizeof LISTS / sizeof LISTS[0])]);
    if (numbers && rng_below(r, 2) == 0) {
        size_t used = strlen(way);
        int connections = 1 + (int)rng_below(r, 8), path_pixels = 1 << rng_below(r, 6);
        snprintf(way + used, sizeof way - used, " connections=%d pathpixels=%d", connections, path_pixels);
    }
    compare(s, way);
}

static void compare_all(struct subject *s)
{
    struct rng r = rng_stream(s->number, RNG_TEST, 11, 0);
    const char *word = s->made.word;
    struct batches x = render(s, "bdpt rrthreshold=0", 0);
    batches_scale(&x, 1 - s->share);
    TEST_REJECT(s->all->t, differ_p(&x, right(s, 0)), "class %llu: %s is missing", (unsigned long long)s->number, word);
    batches_free(&x);
    compare(s, "asbdpt");
    compare_runners(s);
    compare_drawn(s, &r, "asbdpt select=pool", false);
    compare_drawn(s, &r, "asbdpt select=vertices", true);
    compare_drawn(s, &r, "asbdpt race=off", true);
    if (!s->made.delta_light || strchr("ST", word[0]) == NULL)
        compare(s, "pt");
    if (!s->made.far_light && strchr("ST", word[strlen(word) - 1]) == NULL)
        compare(s, "lt");
    for (int stage = 0; stage < STAGES; stage++)
        batches_free(&s->right[stage]);
}

/* --- classes -------------------------------------------------------------------------------------------- */

/* Draw the class for the n-th time. Is its share large enough, and the mean known with few enough samples? */
static bool draw(struct subject *s, int n, int most_spp)
{
    s->made = random_class(s->number, n);
    if (!CHECK(s->all->t, scene_from_text(s->all->t, s->made.text, &s->scene), "class %llu is refused",
               (unsigned long long)s->number)) {
        free(s->made.text);
        return false;
    }
    s->share = share_of(s->all->t, &s->scene, &s->made);
    bool hopeful = s->share >= LEAST_SHARE;
    for (s->spp = LEAST_SPP; hopeful && s->spp <= most_spp; s->spp *= 2) {
        double error, mean = batches_mean(right(s, 0), &error), wanted = s->share / SIGMAS * mean;
        if (mean > 0 && error <= wanted)
            return true;
        batches_free(&s->right[0]);
        hopeful = s->spp * pow(error / wanted, 2) <= 2 * most_spp; /* not if the mean is 0 */
    }
    scene_free(&s->scene);
    free(s->made.text);
    return false;
}

/* Classes [first, end), unless the user wants others, whose comparisons are printed. */
static void test_range_of(struct test *t, uint64_t first, uint64_t end, int most_spp)
{
    struct family all = {.t = t, .least = 1};
    all.show = test_range(t, &first, &end);
    for (uint64_t i = first; i < end; i++) {
        struct subject s = {.all = &all, .number = i};
        int n = 0;
        while (n < TRIES && !draw(&s, n, most_spp))
            n++;
        if (!CHECK(t, n < TRIES, "class %llu: no scene shows it", (unsigned long long)i))
            continue;
        printf("  class %llu: %s %s %s: %.0f %% of the light, maxdepth %d, %d samples, drawing %d\n",
               (unsigned long long)i, s.made.light, s.made.word, s.made.camera, 100 * s.share, s.made.max_depth,
               s.spp * BATCHES, n + 1);
        fflush(stdout);
        all.n_classes++;
        all.redrawn += n;
        compare_all(&s);
        scene_free(&s.scene);
        free(s.made.text);
    }
    printf("  %d classes, %d scenes drawn again, %d comparisons\n", all.n_classes, all.redrawn, all.n);
    TEST_ACCEPT(t, stats_sidak(all.least, all.n), "of %d comparisons: %s", all.n, all.worst);
}

void test_classes(struct test *t) { test_range_of(t, 0, 10, 8); }

void test_classes_long(struct test *t) { test_range_of(t, 1000, 1200, 16); }
