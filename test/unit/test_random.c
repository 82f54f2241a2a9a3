/* test_random.c: random scenes (random_scene.h): all methods have the same expectation, and the known value where
 * there is one.
 *
 * bdpt is compared with one other method and some of its parameters, drawn from the number as the gate is,
 * by itself; with pt where no delta light could be behind a specular surface, and with lt where no
 * specular surface is.
 * Renders are made in independent batches; Welch's test compares the means of the picture and of its tiles. Where light
 * is found rarely such p-values are too small (doc/evidence.md), so the comparison goes by stages: if p is below CUTOFF
 * the scene is rendered again, with new seeds and ten times the samples, and what comes out then counts alone. Of true
 * hypotheses fewer are rejected than by the last stage itself, and means of a hundred times the samples are nearer to
 * normal. A fault that one scene is too short to see is left to all scenes together: where two methods were compared in
 * ten scenes or more, the mean of what one has more than the other, relative, must be 0. The quick scenes give so many
 * to bdpt against pt, and to all other methods as one.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/maths.h"
#include "caustics/surfaces.h"
#include "lab/methods.h"
#include "lab/numbers.h"
#include "lab/stats.h"
#include "render/job.h"
#include "render/render.h"
#include "helpers.h"
#include "random_scene.h"
#include "random_structure.h"
#include "suites.h"

enum { BATCHES = 8, TILE = 6, STAGES = 3 };
static const double CUTOFF = 0.01, BEYOND_DOUBT = 1e-15;

/* A method's name, and all that set_method wants. */
struct way {
    char name[64], text[128];
};
static const struct way BDPT = {"bdpt", "bdpt"}, PT = {"pt", "pt"}, LT = {"lt", "lt"};

/* What methods had more than others, relative to both, in all scenes where both are settled. */
struct together {
    struct difference {
        char name[160];
        int n;
        double sum, square;
    } of[64];
    int n;
};

static void together_add(struct together *all, const char *a, const char *b, double x, double y)
{
    char name[160];
    int i = 0;
    double d = 2 * (x - y) / (x + y);
    snprintf(name, sizeof name, "%s against %s", a, b);
    while (i < all->n && strcmp(all->of[i].name, name) != 0)
        i++;
    if (i == 64 || !(x + y > 0))
        return;
    struct difference *of = &all->of[i];
    all->n += i == all->n;
    memcpy(of->name, name, sizeof name);
    of->n++;
    of->sum += d;
    of->square += d * d;
}

/* Of less than ten scenes nothing can be said. What is 5 % brighter must be found. */
static void together_judge(struct test *t, const struct together *all)
{
    for (const struct difference *of = all->of; of < all->of + all->n; of++) {
        double n = of->n, mean = of->sum / n, error = sqrt((of->square / n - mean * mean) / (n - 1));
        if (of->n < 10)
            continue;
        TEST_ACCEPT(t, stats_student_p(mean / error, n - 1), "%s: %.3f +- %.3f %% more in %d scenes", of->name,
                    100 * mean, 100 * error, of->n);
        TEST_REJECT(t, stats_student_p((mean + 0.05) / error, n - 1), "%s: 5 %% more in %d scenes", of->name, of->n);
    }
}

/* A scene that is looked at. */
struct subject {
    struct test *t;
    struct together *all;
    struct random_scene made;
    struct scene scene;
    uint64_t number;
    double samples; /* of a render at the first stage */
    struct gate gate; /* its end 0: all light */
};

static struct batches render(struct subject *s, const struct way *m, int stage)
{
    struct pixel_rect crop = render_crop(&s->scene);
    double pixels = (double)rect_width(crop) * rect_height(crop);
    double samples = s->made.one_ray ? 1 : s->samples * pow(10, stage);
    int spp = (int)ceil(samples / pixels / BATCHES);
    uint64_t seed = hash_combine(s->number, (uint64_t)stage);
    for (const char *c = m->text; *c != '\0'; c++)
        seed = hash_combine(seed, (uint64_t)*c);
    const char *integrator = set_method(&s->scene, m->text);
    return render_gated(s->t, &s->scene, integrator, s->made.max_depth, s->gate, spp, BATCHES, TILE, seed);
}

/* --- p-values ------------------------------------------------------------------------------------------- */

/* Moments of the sum of values [from, to) of every batch. */
static struct moments sum_moments(const struct batches *b, long from, long to)
{
    struct batches sum = batches_new(b->n_batches, 1, false);
    for (int k = 0; k < b->n_batches; k++)
        for (long i = from; i < to; i++)
            sum.value[k] += b->value[b->n * k + i];
    struct moments m = batches_moments(&sum, 0);
    batches_free(&sum);
    return m;
}

/* Exact values, but for rounding; it also bends planes of two triangles, which send each other some light. */
static double welch(struct moments a, struct moments b)
{
    double close = 1e-9 * (fabs(a.mean) + fabs(b.mean)) + 1e-15;
    if (a.variance + b.variance <= close * close)
        return fabs(a.mean - b.mean) <= close ? 1 : 0;
    return stats_welch_p(a.mean, a.variance, a.n, b.mean, b.variance, b.n);
}

/* Where even the whole is uncertain, so few samples bring most of the light that most tiles miss it in all batches. */
static bool settled(const struct batches *b)
{
    double error, mean = batches_mean(b, &error);
    return error <= 0.03 * mean;
}

/* Half the level for the whole, half for the tiles, unless these have rare light. Not a number: 0. */
static double batches_differ_p(const struct batches *a, const struct batches *b, bool rare)
{
    double whole = welch(sum_moments(a, 0, a->n), sum_moments(b, 0, b->n)), least = 1;
    for (long i = 0; !rare && i < a->n && settled(a) && settled(b); i += 3) {
        double p = welch(sum_moments(a, i, i + 3), sum_moments(b, i, i + 3));
        least = least <= p ? least : p;
    }
    double tiles = stats_sidak(least, (double)a->n / 3), both = stats_sidak(whole <= tiles ? whole : tiles, 2);
    return both >= 0 && isfinite(batches_mean(a, NULL)) && isfinite(batches_mean(b, NULL)) ? both : 0;
}

/* Where each sample is exact but for the rounding of its vertices, which are floats, so is the mean. */
static double known_p(const struct batches *b, double low, double high)
{
    double error, mean = batches_mean(b, &error);
    double p = mean < low * (1 - 1e-8) ? mean_p(b, low) : mean > high * (1 + 1e-8) ? mean_p(b, high) : 1;
    return isfinite(mean) ? p : 0;
}

/* --- comparisons ---------------------------------------------------------------------------------------- */

static void report(struct subject *s, double p, const char *what, double found, double expected)
{
    char text[512];
    snprintf(text, sizeof text, "scene %llu (%s): %s %.6g, not %.6g: build/test --scenes %llu random",
             (unsigned long long)s->number, s->made.family, what, found, expected, (unsigned long long)s->number);
    if (!(p >= 1e-4))
        printf("  p = %.3g: %s\n", p, text);
    fflush(stdout);
    TEST_ACCEPT(s->t, p, "%s", text);
}

/* Two methods, or one (b NULL) and the truth. What lt brings comes so unevenly that no few samples are its mean. */
static void compare(struct subject *s, const struct way *a, const struct way *b)
{
    double p = 1, found = 0, expected = s->made.high;
    for (int stage = 0; stage < STAGES; stage++) {
        struct batches x = render(s, a, stage), y = {0};
        found = batches_mean(&x, NULL);
        if (b != NULL) {
            y = render(s, b, stage);
            expected = batches_mean(&y, NULL);
            p = batches_differ_p(&x, &y, s->made.rare);
            if (stage == 0 && a != &LT && settled(&x) && settled(&y)) {
                together_add(s->all, a->name, b->name, found, expected);
                if (a != &BDPT)
                    together_add(s->all, "all others", b->name, found, expected);
            }
            batches_free(&y);
        } else {
            p = known_p(&x, s->made.low, s->made.high);
        }
        batches_free(&x);
        if (p >= CUTOFF || (stage > 0 && p < BEYOND_DOUBT))
            break;
    }
    char what[400];
    snprintf(what, sizeof what, "%s against %s, gate %g:%g:", a->text, b != NULL ? b->text : "the truth",
             s->gate.begin, s->gate.end);
    report(s, p, what, found, expected);
}

/* Is it a method of independent samples without bias, and none of the three above, that sees media if there are? */
static bool is_other(const struct method *m, bool media)
{
    static const char *const not[] = {"pt", "lt", "bdpt", "asbdpt select=bins", "pathgraph", "ellipse"};
    for (size_t i = 0; i < sizeof not / sizeof not[0]; i++)
        if (strcmp(method_name(m), not[i]) == 0)
            return false;
    return !method_is_chain(m) && !(media && m->check == surfaces_alone);
}

/* One of them; each of these parameters, where it has them, is its default as often as not. */
static const struct {
    const char *name;
    uint32_t least, most;
} DRAWN[] = {{"connections", 1, 4}, {"pathpixels", 1, 8}, {"candidates", 1, 8}, {"neighbours", 0, 8},
             {"longest", 1, 2}};

static struct way draw_other(struct rng *r, bool media)
{
    const struct method *other[64];
    uint32_t n = 0;
    for (int i = 0; method_rows[i] != NULL; i++)
        if (is_other(method_rows[i], media))
            other[n++] = method_rows[i];
    const struct method *m = other[rng_below(r, n)];
    struct way way;
    snprintf(way.name, sizeof way.name, "%s", method_name(m));
    snprintf(way.text, sizeof way.text, "%s", way.name);
    for (size_t i = 0; i < sizeof DRAWN / sizeof DRAWN[0]; i++)
        if (method_has(m, DRAWN[i].name) != NULL && rng_below(r, 2) == 0) {
            size_t used = strlen(way.text);
            uint32_t value = DRAWN[i].least + rng_below(r, DRAWN[i].most - DRAWN[i].least + 1);
            snprintf(way.text + used, sizeof way.text - used, " %s=%u", DRAWN[i].name, (unsigned)value);
        }
    if (method_has(m, "combine") != NULL) /* batches would share what training has found */
        strcat(way.text, " combine=off");
    if (method_has(m, "with") != NULL) {
        static const char *const WITH[] = {"bdpt", "asbdpt", "pt"};
        size_t used = strlen(way.text);
        snprintf(way.text + used, sizeof way.text - used, " with=%s", WITH[rng_below(r, 3)]);
    }
    return way;
}

/* Mostly none; else short paths, or long ones. */
static struct gate draw_gate(struct rng *r, double unit)
{
    double length = unit * (6 + 10 * rng_uniform(r));
    struct gate gate[] = {{0, 0}, {0, 0}, {0, length}, {length, INFINITY}};
    return gate[rng_below(r, 4)];
}

/* Is a surface so near to the lens that few vertices of lt lie on what a pixel sees of it? */
static bool is_near(const struct scene *s)
{
    double least = INFINITY;
    vec3 lo, hi;
    scene_bounds(s, &lo, &hi);
    for (int y = 0; y < s->height; y++)
        for (int x = 0; x < s->width; x++) {
            struct ray ray = camera_ray(&s->camera, x + 0.5, y + 0.5, 0.5, 0.5);
            struct surface at;
            if (scene_intersect(s, &ray, &at))
                least = fmin(least, length(sub(at.p, ray.o)));
        }
    return least < 0.05 * length(sub(hi, lo));
}

static void look_at(struct subject *s)
{
    struct rng r = rng_stream(s->number, RNG_TEST, 8, 0);
    struct way other = draw_other(&r, s->made.media);
    bool pt = !(s->made.delta_light && (s->made.specular || s->made.fog));
    bool lt = !s->made.specular && !s->made.one_ray && !s->made.fog && !is_near(&s->scene);
    if (s->made.known && pt)
        compare(s, &PT, NULL);
    if (s->made.one_ray)
        return;
    s->gate = draw_gate(&r, s->made.unit);
    /* One strategy more finds what others do not where a delta light is behind a specular surface; restirgi and ppg
     * make the paths of pt. */
    if (pt || strstr(other.text, " with=") == NULL)
        compare(s, &other, strcmp(other.name, "restirgi") == 0 || strcmp(other.name, "ppg") == 0 ? &PT : &BDPT);
    if (pt)
        compare(s, &BDPT, &PT);
    if (lt)
        compare(s, &LT, &BDPT);
}

/* Scenes [first, end), unless the user wants others; from `cheap` on only those that one ray decides. */
static void test_range_of(struct test *t, uint64_t first, uint64_t cheap, uint64_t end, double samples)
{
    char top[1024];
    top_directory(top, sizeof top);
    if (test_range(t, &first, &end))
        cheap = end;
    struct together all = {.n = 0};
    for (uint64_t i = first; i < end; i++) {
        struct subject s = {.t = t, .all = &all, .number = i, .samples = samples};
        s.made = random_scene(i, top, false);
        if ((i < cheap || s.made.one_ray) &&
            CHECK(t, scene_from_text(t, s.made.text, &s.scene), "scene %llu is refused", (unsigned long long)i)) {
            look_at(&s);
            scene_free(&s.scene);
        }
        free(s.made.text);
    }
    together_judge(t, &all);
}

void test_random(struct test *t) { test_range_of(t, 0, 48, 800, 3e3); }

void test_random_long(struct test *t) { test_range_of(t, 1000, 3000, 9000, 1e4); }

/* --- the suite structure -------------------------------------------------------------------------------------- */

enum { WIDTH = 16, HEIGHT = 12, SAMPLES = 16 };

/* The share of tiles of 4x4 pixels that show light; 0: the scene is refused. */
static double lit(struct test *t, const char *text)
{
    struct scene scene;
    if (!scene_from_text(t, text, &scene))
        return 0;
    scene.width = WIDTH;
    scene.height = HEIGHT;
    camera_prepare(&scene.camera, WIDTH, HEIGHT);
    struct batches b = render_batches(t, &scene, "bdpt", 5, SAMPLES, 1, 4, test_seed(t));
    double n = 0;
    for (long i = 0; i < b.n; i++)
        n += b.value[i] > 1e-4;
    n /= (double)b.n;
    batches_free(&b);
    scene_free(&scene);
    return n;
}

/* structure: generated scenes that measure efficiency (random_structure.h): all kinds are equally frequent,
 * load without warnings, and show light to the camera. */
void test_structure(struct test *t)
{
    const char *kind[2 * N_STRUCTURES];
    for (uint64_t i = 0; i < 2 * N_STRUCTURES; i++) {
        char *text = random_structure(i, &kind[i]);
        double share = lit(t, text);
        CHECK(t, share > 0.4, "structure %d, %s: light in %.2f of the picture", (int)i, kind[i], share);
        for (uint64_t j = i / N_STRUCTURES * N_STRUCTURES; j < i; j++)
            CHECK(t, strcmp(kind[j], kind[i]) != 0, "%s comes twice of twelve", kind[j]);
        free(text);
    }
    CHECK(t, lit(t, "Film \"image\" WorldBegin Shape \"sphere\" LightSource \"point\" \"rgb I\" [0 0 0] WorldEnd") == 0,
          "light where there is none");
}
