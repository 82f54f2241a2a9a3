/* test_conform.c: the kit that judges other renderers finds nothing wrong with this one, finds planted mistakes and
 * names them, and says where it cannot tell. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lab/conform.h"
#include "lab/stats.h"
#include "render/job.h"
#include "helpers.h"
#include "suites.h"

enum { PICTURES = 8, SPP = 4, NAME = 64, NO_MISTAKE = -1 };
static const double LEVEL = 1e-4;

/* Pictures of a scene of the kit, with so many reflections more, through another filter if one is named. */
static struct side pictures(struct test *t, const char *name, const char *method, int deeper, const char *filter, int n)
{
    char path[256];
    struct scene scene;
    struct side s = {.name = name};
    struct error err = {.text = ""};
    struct prepared prepared;
    snprintf(path, sizeof path, "scenes/conform/%s.pbrt", name);
    if (!scene_from_file(t, path, 0, 0, &scene))
        return s;
    if (filter != NULL)
        scene.filter = filter_of(filter);
    struct render_job o = {.integrator = method_named(method), .seed = test_seed(t), .n_threads = 1,
                               .end = (long)SPP * PICTURES / n * test_effort(t)};
    if (CHECK(t, job_settle(&o, &scene, &prepared, &err), "%s", err.text)) {
        o.max_depth += deeper;
        method_release(&prepared);
        CHECK(t, side_render(&scene, &o, 0, n, true, &s, &err), "%s", err.text);
    }
    scene_free(&scene);
    return s;
}

/* The scenes of the kit, a line each. */
static char *kit_lines(struct test *t)
{
    char *list = text_of(t, "ref/conform", "list.txt"), *end = strchr(list, '\n');
    if (list[0] == '#' && end != NULL)
        memmove(list, end + 1, strlen(end)); /* without the head */
    return list;
}

/* What is known of a scene. */
static struct conform_references references(struct test *t, const char *name, bool closed)
{
    struct conform_references r = {.right = {.name = name}};
    struct conform_sheet sheet;
    struct error err = {.text = ""};
    char *list = kit_lines(t);
    int n = 0, row = -1;
    for (const char *line = list, *end; (end = strchr(line, '\n')) != NULL; line = end + 1, n++)
        if (strncmp(line, name, strlen(name)) == 0 && line[strlen(name)] == ' ')
            row = n;
    if (CHECK(t, row >= 0 && conform_sheet_read("ref/conform/references.pfm", n, &sheet, &err), "%s: %s", name,
              err.text)) {
        r = conform_row(&sheet, row, closed);
        free(sheet.pixels);
    }
    free(list);
    return r;
}

static void release(struct side *pictures, struct conform_references *r)
{
    batches_free(&pictures->pixels);
    conform_free(r);
}

/* --- all scenes -------------------------------------------------------------------------------------- */

/* What the comment of a scene says of its pixels is what the reference shows. */
static bool check_closed(struct test *t, const char *name, const struct side *r)
{
    char file[NAME + 8];
    snprintf(file, sizeof file, "%s.pbrt", name);
    char *text = text_of(t, "scenes/conform", file);
    const char *at = strstr(text, "# closed form"), *colon = at != NULL ? strchr(at, ':') : NULL;
    double error, mean = batches_mean(&r->pixels, &error), wanted = colon != NULL ? strtod(colon + 1, NULL) : mean;
    CHECK(t, fabs(mean - wanted) < 4 * error + 1e-6 * wanted, /* the error of a closed form is 0 */
          "%s: the reference is %g, not %g", name, mean, wanted);
    bool constant = at != NULL && at[strlen("# closed form")] == ':';
    for (long i = 0; constant && i < r->pixels.n; i++)
        if (!CHECK(t, fabs(r->pixels.value[i] - wanted) < 1e-6 * wanted, "%s: a pixel is not %g", name, wanted))
            break;
    free(text);
    return constant;
}

static void test_scene(struct test *t, const char *name, bool closed, const char *method)
{
    struct conform_references r = references(t, name, closed);
    CHECK(t, check_closed(t, name, &r.right) == closed, "%s: list.txt and the scene differ about a closed form", name);
    struct side s = pictures(t, name, method, 0, NULL, PICTURES);
    struct judgement j = conform_judge(&s, &r, LEVEL, 1);
    TEST_ACCEPT(t, j.verdict.p, "%s by %s: ratio %g +- %g %s", name, method, j.verdict.ratio, j.verdict.ratio_error,
                j.why);
    release(&s, &r);
}

static void test_scenes_of_kit(struct test *t, const char *method)
{
    char *list = kit_lines(t), name[NAME];
    int n = 0;
    for (const char *line = list, *end; (end = strchr(line, '\n')) != NULL; line = end + 1) {
        sscanf(line, "%63s", name);
        const char *closed = strstr(line, " closed ");
        test_scene(t, name, closed != NULL && closed < end, method);
        n++;
    }
    CHECK(t, n >= 30, "the kit has %d scenes", n);
    free(list);
}

/* --- planted mistakes -------------------------------------------------------------------------------- */

/* What is wrong with the pictures, and the words for it. */
static const struct fault {
    const char *scene, *words;
    int deeper;
    const char *filter;
    char how; /* 'x', 'y': turned over; 's': sRGB; 'p': times pi; '2': times 1.2; 't': of a sky that is turned */
} FAULTS[] = {{"deep", "depth is counted one less", -1, NULL, ' '},
              {"area", "depth is counted one more", 1, NULL, ' '},
              {"point", "a Gaussian filter instead of a box, or the reverse", 0, "gaussian", ' '},
              {"filter", "a Gaussian filter instead of a box, or the reverse", 0, "box", ' '},
              {"instances", "left and right exchanged", 0, NULL, 'x'},
              {"spot", "upside down", 0, NULL, 'y'},
              {"sky", "sRGB instead of linear values", 0, NULL, 's'},
              {"lens", "scaled by pi", 0, NULL, 'p'},
              {"sky-map", "sky map turned by 90 degrees", 0, NULL, 't'},
              {"normals", NULL, 0, NULL, '2'}};

/* Spoil every picture. */
static void spoil(struct side *s, char how)
{
    struct batches right = batches_tiles(&s->pixels, s->width, s->height, 1);
    for (long k = 0; k < right.n_batches; k++)
        for (long i = 0; i < right.n; i++) {
            long x = i / 3 % s->width, y = i / 3 / s->width;
            x = how == 'x' ? s->width - 1 - x : x;
            y = how == 'y' ? s->height - 1 - y : y;
            double v = right.value[right.n * k + 3 * (y * s->width + x) + i % 3];
            v = how == 's' ? srgb_encode(v) : v;
            s->pixels.value[right.n * k + i] = how == 'p' ? PI * v : how == '2' ? 1.2 * v : v;
        }
    batches_free(&right);
}

/* Which mistake fits best, at this level at least; NULL: none. */
static const char *best_fit(const struct side *s, const struct conform_references *r)
{
    const char *best = NULL;
    double most = LEVEL;
    for (int i = 0; CONFORM_MISTAKES[i].words != NULL; i++) {
        double p = conform_fit_p(s, r, i);
        best = p > most ? CONFORM_MISTAKES[i].words : best;
        most = p > most ? p : most;
    }
    return best;
}

/* Exchange the right reference with that of another mistake. */
static void exchange(struct conform_references *r, const char *words)
{
    for (int i = 0; CONFORM_MISTAKES[i].words != NULL; i++)
        if (strcmp(CONFORM_MISTAKES[i].words, words) == 0) {
            struct side right = r->right;
            r->right = r->wrong[i];
            r->wrong[i] = right;
        }
}

static void test_mistakes(struct test *t)
{
    for (size_t i = 0; i < sizeof FAULTS / sizeof FAULTS[0]; i++) {
        const struct fault *f = &FAULTS[i];
        const char *words = f->words != NULL ? f->words : "a fifth too bright";
        struct side s = pictures(t, f->scene, "bdpt", f->deeper, f->filter, PICTURES);
        struct conform_references r = references(t, f->scene, false);
        spoil(&s, f->how);
        if (f->how == 't')
            exchange(&r, f->words);
        struct judgement j = conform_judge(&s, &r, LEVEL, 1);
        TEST_REJECT(t, j.verdict.p, "%s: %s", f->scene, words);
        const char *fit = best_fit(&s, &r);
        CHECK(t, f->words != NULL ? fit != NULL && strcmp(fit, words) == 0 : fit == NULL, "%s: %s is taken for %s",
              f->scene, words, fit != NULL ? fit : "nothing");
        release(&s, &r);
    }
}

/* --- pictures by strangers --------------------------------------------------------------------------- */

/* One picture, by its blocks: right ones are accepted, others are not. Twice the same picture is one. */
static void test_few(struct test *t)
{
    static const char *const scenes[] = {"area", "point", "glass", "sky-map"};
    for (int i = 0; i < 4; i++) {
        struct side s = pictures(t, scenes[i], "pt", 0, NULL, 1);
        struct conform_references r = references(t, scenes[i], false);
        struct batches twice = batches_new(2, s.pixels.n, false);
        for (long k = 0; k < 2 * s.pixels.n; k++)
            twice.value[k] = s.pixels.value[k % s.pixels.n];
        batches_free(&s.pixels);
        s.pixels = twice;
        int others = conform_distinct(&s);
        CHECK(t, others == 1 && s.pixels.n_batches == 1, "%s: %d of two pictures are left", scenes[i], 2 - others);
        TEST_ACCEPT(t, conform_judge(&s, &r, LEVEL, 1).verdict.p, "%s: one picture", scenes[i]);
        batches_scale(&s.pixels, i == 2 ? 1.3 : 1.1);
        TEST_REJECT(t, conform_judge(&s, &r, LEVEL, 1).verdict.p, "%s: one picture, too bright", scenes[i]);
        release(&s, &r);
    }
}

/* An even picture without noise, rounded as halves are, agrees; one that is off by 1 % does not. */
static void test_rounding(struct test *t)
{
    for (int far = 0; far < 2; far++) {
        struct conform_references r = references(t, "floor-sun", true);
        long n = r.right.pixels.n;
        struct side s = {"floor-sun", r.right.width, r.right.height, batches_new(PICTURES, n, false)};
        for (long i = 0; i < PICTURES * n; i++)
            s.pixels.value[i] = r.right.pixels.value[i % n] * (far ? 1.01 : 1.0002);
        struct judgement j = conform_judge(&s, &r, LEVEL, 1);
        CHECK(t, j.finding == (far ? FINDS_DIFFERENCE : FINDS_AGREEMENT), "off by %s: p is %g, %s",
              far ? "1 %" : "2e-4", j.verdict.p, j.why);
        release(&s, &r);
    }
}

/* Where the pictures cannot decide, that is what is said: a mean that is known to some per cent, one bright pixel. NaN
 * is a difference. */
static void test_doubt(struct test *t)
{
    static const char *const why[] = {"", "too noisy", "heavy tails", "NaN"};
    for (int kind = 0; kind < 4; kind++) {
        struct side s = pictures(t, "point", "bdpt", 0, NULL, PICTURES);
        struct conform_references r = references(t, "point", false);
        for (long i = 0; kind == 1 && i < s.pixels.n * PICTURES; i++)
            s.pixels.value[i] *= i / s.pixels.n % 2 == 0 ? 1.1 : 0.9;
        for (int c = 0; kind > 1 && c < 3; c++)
            s.pixels.value[3 * 100 + c] += kind == 2 ? 3 : NAN;
        struct judgement j = conform_judge(&s, &r, LEVEL, 1);
        CHECK(t, strcmp(j.why, why[kind]) == 0 && j.finding == (kind == 0   ? FINDS_AGREEMENT
                                                                : kind == 3 ? FINDS_DIFFERENCE
                                                                            : FINDS_DOUBT),
              "kind %d: finding %d, %s", kind, j.finding, j.why);
        release(&s, &r);
    }
}

void test_conform(struct test *t)
{
    test_scenes_of_kit(t, "bdpt");
    test_mistakes(t);
    test_few(t);
    test_rounding(t);
    test_doubt(t);
}

void test_conform_long(struct test *t) { test_scenes_of_kit(t, "asbdpt"); }
