/* test_equal_time.c: methods given equal time: the arithmetic, its intervals and tables on planted numbers, and a tiny
 * measurement carried out and resumed. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/mem.h"
#include "lab/claims.h"
#include "helpers.h"
#include "lab/equal.h"
#include "lab/family.h"
#include "lab/measure.h"
#include "lab/store.h"
#include "render/job.h"
#include "suites.h"

/* --- planted numbers ----------------------------------------------------------------------------------- */

enum { SCENES = 3, SEEDS = 3 };

/* Squared errors at equal time over bdpt's are 0.5, 4 and 1 for asbdpt, 0.25 for lvc, in all three ways of measuring;
 * asbdpt prepares for 8 samples of bdpt and pays 1.5 each: 16 in the time of bdpt's 32; lvc pays 0.5. With its last
 * seed asbdpt pays 3 each in c: 8 samples have the error of 16. */
static void plant(struct plan *p, struct results *r)
{
    static const double ratio[3][SCENES] = {{1, 1, 1}, {0.5, 4, 1}, {0.25, 0.25, 0.25}};
    static const struct price price[3] = {{0, 1}, {8, 1.5}, {0, 0.5}};
    static const char *const paths[SCENES] = {"a.pbrt", "b.pbrt", "c.pbrt"};
    struct error err = {.text = ""};
    memset(p, 0, sizeof *p);
    p->n_scenes = SCENES;
    p->n_seeds = SEEDS;
    p->equal = true;
    p->scene = mem_alloc(SCENES, sizeof *p->scene);
    p->directory = "results";
    p->command = "equal-time --spp 32";
    plan_set_methods(p, "bdpt,asbdpt,lvc", &err);
    plan_set_spp(p, 32, 32, &err);
    r->plan = p;
    r->scene = mem_alloc(SCENES, sizeof *r->scene);
    for (int i = 0; i < SCENES; i++) {
        struct scene_results *s = &r->scene[i];
        s->plan = p;
        s->path = p->scene[i] = paths[i];
        s->name[0] = (char)('a' + i);
        s->seconds = 0.1;
        for (int v = 0; v < 3; v++) {
            for (int k = 0; k < SEEDS; k++) {
                s->price[v][k] = price[v];
                s->price[v][k].each *= i == 2 && v == 1 && k == 2 ? 2 : 1;
                struct run *step = &s->run[v][k][0];
                step->spp = equal_samples(s, v, k);
                for (int q = 0; q < N_SQUARES; q++)
                    step->square[q] = ratio[v][i] * (1 + 0.1 * k);
            }
        }
    }
}

static bool near(double a, double b) { return fabs(a - b) < 1e-9 * fabs(b); }

/* What the writer puts into a file, as text to be freed. */
static char *written(struct test *t, const struct results *r, void (*write)(FILE *, const struct results *))
{
    char path[512];
    snprintf(path, sizeof path, "%s/equal", test_tmp(t));
    FILE *f = fopen(path, "w");
    if (CHECK(t, f != NULL, "%s", path)) {
        write(f, r);
        fclose(f);
    }
    return text_of(t, test_tmp(t), "equal");
}

/* --- the arithmetic ------------------------------------------------------------------------------------ */

static void check_time(struct test *t, struct results *r)
{
    struct scene_results *s = &r->scene[1];
    struct plan *p = (struct plan *)r->plan;
    CHECK(t, equal_samples(s, 0, 0) == 32 && equal_samples(s, 1, 0) == 16 && equal_samples(s, 2, 0) == 64,
          "%ld, %ld, %ld",
          equal_samples(s, 0, 0), equal_samples(s, 1, 0), equal_samples(s, 2, 0));
    CHECK(t, equal_samples(&r->scene[2], 1, 2) == 8 && equal_samples(&r->scene[2], 1, 1) == 16, "seeds' own prices");
    s->price[0][0].before = s->price[0][1].before = s->price[0][2].before = 4; /* which all are given, too */
    CHECK(t, near(equal_afforded(s, 0, 0), 32) && near(equal_afforded(s, 1, 0), 28 / 1.5) &&
          equal_samples(s, 1, 0) == 19,
          "%g, %g", equal_afforded(s, 0, 0), equal_afforded(s, 1, 0));
    /* 16 samples were rendered, 18.67 can be afforded: the squared error at T is less by their ratio. */
    CHECK(t, near(equal_ratio(s, 1, 0, SQUARE_RELMSE).value, 4 * 16 / (28 / 1.5)), "%g",
          equal_ratio(s, 1, 0, SQUARE_RELMSE).value);
    s->price[0][0].before = s->price[0][1].before = s->price[0][2].before = 0;
    p->seconds = 1.4; /* 14 samples of bdpt at 0.1 s */
    CHECK(t, equal_samples(s, 0, 0) == 14 && equal_samples(s, 1, 0) == 4 && equal_samples(s, 2, 0) == 28,
          "%ld, %ld, %ld",
          equal_samples(s, 0, 0), equal_samples(s, 1, 0), equal_samples(s, 2, 0));
    p->seconds = 0.85; /* a third of a sample is left for asbdpt */
    CHECK(t, equal_samples(s, 1, 0) == 1 && isnan(equal_ratio(s, 1, 0, SQUARE_RELMSE).value) &&
          strcmp(equal_ends(r, 1, 0, SQUARE_RELMSE).best_scene, "-") == 0, "what cannot be afforded has a ratio");
    p->seconds = 0;
}

static void check_ratios(struct test *t, struct results *r)
{
    struct interval i = equal_ratio(&r->scene[1], 1, 0, SQUARE_RELMSE), one;
    double v = pow(0.1 / 1.1, 2) / 3; /* of the logarithm: three values, this far apart */
    CHECK(t, near(i.value, 4) && near(log(i.high / 4), student_quantile(0.05, 4) * sqrt(2 * v)) &&
          near(i.low * i.high, 16), "interval of three seeds each: %g [%g, %g]", i.value, i.low, i.high);
    i = equal_ratio(&r->scene[1], 2, 0, SQUARE_RELMSE);
    CHECK(t, near(log(i.high / i.value), student_quantile(0.05, 4) * sqrt(2 * v)), "Welch's interval: to %g", i.high);
    struct equal_ends s = equal_ends(r, 1, 0, SQUARE_MSE8);
    CHECK(t, near(s.best, 0.5) && near(s.worst, 4), "best %g, worst %g", s.best, s.worst);
    CHECK(t, strcmp(s.best_scene, "a") == 0 && strcmp(s.worst_scene, "b") == 0, "in their scenes");
    int n;
    i = equal_mean(r, 1, 0, SQUARE_BLOCKS, AT_EQUAL_TIME, NULL, &n);
    CHECK(t, n == 3 && near(i.value, cbrt(2)) && i.low < 0.5 && i.high > 4 &&
          near(log(i.high / i.value), student_quantile(0.05, 2) * sqrt((pow(log(0.5) - log(2) / 3, 2) +
               pow(log(4) - log(2) / 3, 2) + pow(log(2) / 3, 2)) / 6)), "three unlike scenes: %g [%g, %g]",
          i.value, i.low, i.high);
    i = equal_mean(r, 2, 1, SQUARE_BLOCKS, AT_EQUAL_TIME, "a", &n);
    one = equal_ratio(&r->scene[0], 2, 1, SQUARE_BLOCKS);
    CHECK(t, n == 1 && near(i.value, 0.5) && i.low == one.low, "one scene, over another method: %g", i.value);
    i = equal_mean(r, 2, 1, SQUARE_BLOCKS, AT_EQUAL_TIME, "no-such", &n);
    CHECK(t, n == 0 && isnan(i.value), "no scene has a ratio");
    const int both[2] = {0, 2};
    i = equal_over_best(r, 1, both, 2, SQUARE_BLOCKS);
    CHECK(t, near(i.value, cbrt(2) * 4), "over the best of two, which is lvc everywhere: %g", i.value);
    r->scene[1].mark[2] = MARK_DARK;
    i = equal_over_best(r, 1, both, 2, SQUARE_BLOCKS);
    r->scene[1].mark[2] = MARK_NONE;
    CHECK(t, near(i.value, cbrt(2 * 4 * 4)), "what misses light is not the best: %g", i.value);
    static const double lucky[SEEDS] = {0.1, 0.1, 9}; /* bdpt: 1, 1.1, 1.2; two of lvc's seeds are its luck */
    double old[SEEDS];
    for (int k = 0; k < SEEDS; k++) {
        old[k] = r->scene[0].run[2][k][0].square[SQUARE_BLOCKS];
        r->scene[0].run[2][k][0].square[SQUARE_BLOCKS] = lucky[k];
    }
    i = equal_over_best(r, 1, both, 2, SQUARE_BLOCKS);
    for (int k = 0; k < SEEDS; k++)
        r->scene[0].run[2][k][0].square[SQUARE_BLOCKS] = old[k];
    CHECK(t, near(i.value, cbrt(1.65 / (1 + 1.1 + 9) * 16 * 4)), "seeds choose for others: %g", i.value);
    const struct measured *item = r->plan->methods.item;
    CHECK(t, !measured_biased(&item[0]) && !measured_biased(&item[1]), "bdpt or asbdpt is biased");
    struct measured vcm = {.integrator = "vcm"};
    CHECK(t, measured_biased(&vcm), "vcm is not biased");
}

/* lvc has a quarter of bdpt's error everywhere; asbdpt half, four times and as much. */
static void check_claims(struct test *t, struct results *r)
{
    static const struct {
        struct claim claim;
        enum verdict_of verdict;
        int scenes;
    } cases[] = {{{.method = "lvc", .over = "bdpt", .below = 0.5}, CLAIM_FOUND, 3},
                 {{.method = "lvc", .over = "bdpt", .below = 0.1}, CLAIM_NOT_FOUND, 3},
                 {{.method = "asbdpt", .over = "bdpt", .below = 1}, CLAIM_OPEN, 3},
                 {{.method = "asbdpt", .over = "bdpt", .below = 1, .where = "b"}, CLAIM_NOT_FOUND, 1},
                 {{.method = "asbdpt", .over = "bdpt", .below = 1, .where = "a"}, CLAIM_FOUND, 1},
                 {{.method = "asbdpt", .over = "bdpt", .below = 0.4, .where = "a"}, CLAIM_NOT_FOUND, 1},
                 {{.method = "asbdpt", .over = "bdpt", .below = 0.4, .where = "a", .at = AT_EQUAL_SAMPLES},
                  CLAIM_FOUND, 1},
                 {{.method = "lvc", .over = "bdpt", .below = 0.5, .lacks = "a part"}, CLAIM_NOT_JUDGED, 3},
                 {{.method = "pt", .over = "bdpt", .below = 1, .lacks = "a part"}, CLAIM_UNMEASURED, 0},
                 {{.method = "lvc", .over = "bdpt", .below = 1, .where = "no-such"}, CLAIM_UNMEASURED, 0}};
    struct interval ratio[N_SQUARES];
    int n;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        enum verdict_of v = claim_judge(r, &cases[i].claim, HALF_CHOICE, ratio, &n);
        CHECK(t, v == cases[i].verdict && n == cases[i].scenes, "claim %d: verdict %d, %d scenes", (int)i, (int)v, n);
    }
    for (int k = 0; k < SEEDS; k++) /* what one of the three says against is not found */
        r->scene[0].run[1][k][0].square[SQUARE_BLOCKS] *= 8;
    CHECK(t, claim_judge(r, &cases[4].claim, HALF_CHOICE, ratio, &n) == CLAIM_NOT_FOUND, "8x8 does not count");
    for (int k = 0; k < SEEDS; k++)
        r->scene[0].run[1][k][0].square[SQUARE_BLOCKS] /= 4;
    CHECK(t, claim_judge(r, &cases[4].claim, HALF_CHOICE, ratio, &n) == CLAIM_OPEN, "two of three are enough");
}

/* --- what is written ----------------------------------------------------------------------------------- */

static void check_tables(struct test *t, struct results *r)
{
    static const char *const lines[] = {
        "| method | price | mse8 | relmse | 8x8 | best | worst | marked in |",
        "| asbdpt | 1.62 | 1.260 [", "| 0.5 a | 4 b | 0 |\n",
        "| lvc | 0.50 | 0.250 [0.",
        "| method | a, 0x0 | b, 0x0 | c, 0x0 |",
        "| asbdpt | 0.500 [", "half the squared differences of pairs",
        "- b: 3.2 s of CPU; samples of each: 32, 16, 64\n",
        "differ by 100 % at most",
        "    ./asbdpt-lab equal-time --spp 32 -o results \\\n",
        "\n        a.pbrt b.pbrt c.pbrt\n"};
    snprintf(r->scene[2].name, sizeof r->scene[2].name, "c|d");
    char *barred = written(t, r, family_tables);
    CHECK(t, strstr(barred, "| c\\|d, 0x0 |") != NULL && strstr(barred, "| c|d, 0x0 |") == NULL,
          "a bar in a name ends a cell:\n%s", barred);
    free(barred);
    snprintf(r->scene[2].name, sizeof r->scene[2].name, "c");
    char *table = written(t, r, family_tables), *csv = written(t, r, results_csv);
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++)
        CHECK(t, strstr(table, lines[i]) != NULL, "the tables lack %s:\n%s", lines[i], table);
    CHECK(t, strncmp(csv, "scene,method,seed,spp,seconds,rmse8,mean_error,mse8,", 52) == 0, "head of the CSV: %.60s",
          csv);
    free(table);
    free(csv);
    char *said = written(t, r, equal_verdict);
    int lines_said = 0;
    for (const char *p = said; (p = strchr(p, '\n')) != NULL; p++)
        lines_said++;
    CHECK(t, strstr(said, "lvc over that of bdpt after the same time, per pixel: 0.25 (95 %: ") != NULL &&
          strstr(said, "): a gain.\n- In means over 8x8 ") != NULL && strstr(said, "per pixel: 1.26 (95 %: ") != NULL &&
          strstr(said, "): undecided; ") != NULL, "%s", said);
    CHECK(t, lines_said == 2 * (r->plan->methods.n - 1) + 1, "two lines for a method, and one: %s", said);
    free(said);
}

/* Every row of the table of methods, the reference's first, as methods_read wants them. */
static void check_all_methods(struct test *t)
{
    char text[METHODS_TEXT];
    struct methods all;
    struct error err = {.text = ""};
    int rows = 0;
    while (method_rows[rows] != NULL)
        rows++;
    methods_all(text);
    CHECK(t, methods_read(text, &all, &err) && all.n == rows && strcmp(all.item[0].text, METHOD_REFERENCE) == 0,
          "%d rows, %d methods in %s: %s", rows, all.n, text, err.text);
}

/* --- carried out --------------------------------------------------------------------------------------- */

/* A plan of two scenes, 8x8 pixels. */
static void small_plan(struct plan *p, const char **scenes, const char *directory, const char *methods)
{
    struct error err = {.text = ""};
    memset(p, 0, sizeof *p);
    scenes[0] = "scenes/cornell-box.pbrt";
    scenes[1] = "scenes/spot.pbrt";
    p->scene = scenes;
    p->n_scenes = 2;
    p->n_threads = 1;
    p->n_seeds = 3;
    p->width = p->height = 8;
    p->directory = directory;
    p->equal = p->quiet = true;
    p->command = "";
    plan_set_spp(p, 32, 32, &err);
    plan_set_methods(p, methods, &err);
}

static bool same(const struct results *a, const struct results *b, int scene, int method, int seed)
{
    const struct run *x = &a->scene[scene].run[method][seed][0];
    const struct run *y = &b->scene[scene].run[method][seed][0];
    return x->spp == y->spp && x->square[SQUARE_RELMSE] == y->square[SQUARE_RELMSE];
}

/* A record that is cut anywhere, or of which a byte has changed, is none, or still the same. */
static void check_damage(struct test *t, const char *directory)
{
    static const char *const ENDS[] = {"txt", "pfm"};
    static const char OTHERS[] = "-0719n \n";
    float pixels[2 * 1 * 3] = {0, 1, 2, 3, 0.5f, 0.25f};
    const struct record kept = {{1, 2.5, 0, 1e-3}, pixels, 2, 1};
    struct error err = {.text = ""};
    int tried = 0;
    CHECK(t, store_write(directory, "z", "key", &kept, &err), "%s", err.text);
    for (int end = 0; end < 2; end++) {
        char path[512];
        uint8_t *data;
        size_t n;
        snprintf(path, sizeof path, "%s/z.%s", directory, ENDS[end]);
        CHECK(t, file_read(path, &data, &n, &err), "%s", err.text);
        for (size_t at = 0; data != NULL && at < n; at++)
            for (size_t other = 0; other < sizeof OTHERS; other++) {
                struct record r = {{0}, NULL, 0, 0};
                uint8_t was = data[at];
                data[at] = (uint8_t)OTHERS[other];
                write_bytes(path, data, other > 0 ? n : at); /* the first time cut */
                bool same = store_read(directory, "z", "key", &r) &&
                            memcmp(r.number, kept.number, sizeof r.number) == 0 && r.width == 2 && r.height == 1 &&
                            memcmp(r.pixels, pixels, sizeof pixels) == 0;
                CHECK(t, same || r.pixels == NULL, "byte %d of z.%s is now %d", (int)at, ENDS[end], data[at]);
                free(r.pixels);
                data[at] = was;
                tried++;
            }
        write_bytes(path, data, n);
        free(data);
    }
    CHECK(t, tried > 500, "%d damages", tried);
}


/* Started again, nothing is rendered twice, but what is lost or has another key; with one more method, all the others
 * stay as they are. */
static void check_resumed(struct test *t)
{
    static const char *const files[] = {"family.md", "runs.csv", "images/cornell-box.png", "report.html"};
    const char *scenes[2];
    char directory[300], path[512];
    struct error err = {.text = ""};
    struct plan p, more;
    struct results first = {0}, again = {0}, third = {0};
    snprintf(directory, sizeof directory, "%s/family", test_tmp(t));
    small_plan(&p, scenes, directory, "bdpt,lvc");
    small_plan(&more, scenes, directory, "bdpt,pt,lvc");
    if (!CHECK(t, measure(&p, &first, &err) && family_write(&first, "family.md", family_tables, &err), "%s", err.text))
        return;
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        snprintf(path, sizeof path, "%s/%s", directory, files[i]);
        CHECK(t, file_exists(path), "%s is not there", path);
    }
    long spp = first.scene[0].run[1][1][0].spp;
    snprintf(path, sizeof path, "%s/store/cornell-box--lvc--8--seed%" PRIu64 "--%ld.txt", directory,
             plan_seed(&p, 1, 2), spp);
    CHECK(t, remove(path) == 0 && measure(&p, &again, &err), "%s: %s", path, err.text);
    CHECK(t, measure(&more, &third, &err), "%s", err.text);
    for (int k = 0; k < 12; k++) {
        int scene = k / 6, method = k / 3 % 2, seed = k % 3;
        double a = first.scene[scene].run[method][seed][0].value[Q_SECONDS];
        double b = again.scene[scene].run[method][seed][0].value[Q_SECONDS];
        CHECK(t, same(&first, &again, scene, method, seed), "picture %d", k);
        struct run(*of)[PLAN_MAX_STEPS] = first.scene[scene].run[method], *early = &of[seed][1];
        bool due = of[0][0].spp > 1 && of[1][0].spp > 1 && of[2][0].spp > 1;
        CHECK(t, (due || method > 0) && due == (early->spp > 0), "picture %d has an earlier step", k);
        CHECK(t, !due || early->square[0] == again.scene[scene].run[method][seed][1].square[0], "its earlier step");
        CHECK(t, k == 4 || a == b, "picture %d is rendered again", k);
        CHECK(t, third.scene[scene].run[2 * method][seed][0].value[Q_SECONDS] == b, "beside one more method");
    }
    CHECK(t, file_exists(path), "what was lost is kept again");
    const struct record kept = {{1, 2, 3, 4}, NULL, 0, 0};
    struct record r;
    CHECK(t, store_write(directory, "x", "key of it", &kept, &err) && store_read(directory, "x", "key of it", &r) &&
          r.number[3] == 4, "%s", err.text);
    CHECK(t, !store_read(directory, "x", "key", &r), "a key that begins alike is another");
    check_damage(t, directory);
    CHECK(t, first.scene[0].price[1][2].each == third.scene[0].price[2][2].each, "a price is measured once");
    results_free(&first);
    results_free(&again);
    results_free(&third);
}

static struct estimate mean_square(const struct scene_results *s, int method, int k)
{
    int n = s->plan->n_seeds;
    double sum = 0, squares = 0;
    for (int i = 0; i < n; i++)
        sum += s->run[method][i][0].square[k];
    for (int i = 0; i < n; i++)
        squares += pow(s->run[method][i][0].square[k] - sum / n, 2);
    struct estimate e = {sum / n, sqrt(squares / (n - 1) / n), n};
    return e;
}

/* Errors by pairs are those against a reference: of bdpt, pt and lvc in the Cornell box with many seeds, within what
 * seeds scatter, all together to well within a factor of 2; and none is marked. */
static void check_both_ways(struct test *t)
{
    const char *scenes[2];
    char directory[300]; /* keeps the prices, so that samples are the same */
    struct error err = {.text = ""};
    struct plan p;
    struct results by_pairs = {0}, by_reference = {0};
    snprintf(directory, sizeof directory, "%s/both", test_tmp(t));
    small_plan(&p, scenes, directory, "bdpt,pt,lvc");
    p.n_scenes = 1;
    p.n_seeds = 8;
    p.seconds = 0;
    double all = 0; /* mean logarithm of the ratio: seeds are the same, so it scatters less than each */
    bool ok = measure(&p, &by_pairs, &err);
    p.reference = "ref"; /* 32x32, shrunk */
    ok = ok && measure(&p, &by_reference, &err);
    CHECK(t, ok, "%s", err.text);
    for (int v = 0; ok && v < 3; v++)
        for (int k = 0; k < N_SQUARES; k++) {
            struct estimate a = mean_square(&by_pairs.scene[0], v, k);
            struct estimate b = mean_square(&by_reference.scene[0], v, k);
            double na = (double)by_pairs.scene[0].run[v][0][0].spp;
            double nb = (double)by_reference.scene[0].run[v][0][0].spp;
            double z = (a.mean * na - b.mean * nb) / sqrt(a.error * a.error * na * na + b.error * b.error * nb * nb);
            all += log(a.mean * na / (b.mean * nb)) / (3 * N_SQUARES);
            CHECK(t, fabs(z) < 5, "%s, %s: by pairs %g +- %g of %g samples, by reference %g +- %g of %g",
                  p.methods.item[v].text, EQUAL_NAMES[k], a.mean, a.error, na, b.mean, b.error, nb);
        }
    CHECK(t, !ok || fabs(all) < log(2) / 2, "pairs see %g times the squared error that a reference does", exp(all));
    for (int v = 0; ok && v < 3; v++)
        CHECK(t, by_pairs.scene[0].mark[v] == MARK_NONE && by_reference.scene[0].mark[v] == MARK_NONE, "%s is marked",
              p.methods.item[v].text);
    p.reference = NULL;
    CHECK(t, !ok || results_by_pairs(&by_pairs.scene[0], 1), "pt is not measured by pairs");
    by_pairs.scene[0].mark[0] = MARK_DARK;
    CHECK(t, !ok || !results_by_pairs(&by_pairs.scene[0], 1), "a ratio to a marked method is measured in two ways");
    struct run early[3]; /* of bdpt, after 4, 8 and 16 of its 32 samples: what is rendered by itself below */
    memcpy(early, &by_pairs.scene[0].run[0][1][2], sizeof early);
    results_free(&by_pairs);
    p.equal = false;
    double sum[3] = {0, 0, 0}; /* after 4, 8 and 16 samples: each step has pairs of its own */
    ok = plan_set_spp(&p, 4, 16, &err) && measure(&p, &by_pairs, &err);
    for (int i = 0; ok && i < 9 * p.n_seeds; i++)
        sum[i % 3] += by_pairs.scene[0].run[i / 3 % 3][i / 9][i % 3].square[SQUARE_MSE8];
    for (int i = 0; ok && i < 3; i++) {
        const struct run *alone = &by_pairs.scene[0].run[0][1][i];
        CHECK(t, early[i].spp == 4 << i && early[i].value[Q_RMSE8] == alone->value[Q_RMSE8] &&
                 early[i].square[SQUARE_RELMSE] == alone->square[SQUARE_RELMSE],
              "on the way, after %ld samples: rmse8 %g, rendered by itself %g", early[i].spp, early[i].value[Q_RMSE8],
              alone->value[Q_RMSE8]);
    }
    CHECK(t, sum[0] / sum[2] > 2 && sum[0] / sum[2] < 8, "by pairs: %g, %g, %g", sum[0], sum[1], sum[2]);
    results_free(&by_pairs);
    results_free(&by_reference);
}

/* Glass under a spot light: pt lacks its caustics, which pairs of renders do not see, and caustics does not. */
static void check_missing(struct test *t)
{
    const char *scenes[2] = {NULL, NULL};
    char directory[300];
    struct error err = {.text = ""};
    struct plan p;
    struct results r = {0};
    snprintf(directory, sizeof directory, "%s/missing", test_tmp(t));
    small_plan(&p, scenes, directory, "bdpt,pt,caustics");
    scenes[0] = "scenes/caustic-glass.pbrt";
    p.n_scenes = 1;
    p.width = 36;
    p.height = 24;
    if (CHECK(t, measure(&p, &r, &err), "%s", err.text)) {
        struct scene_results *s = &r.scene[0];
        char *said = written(t, &r, equal_verdict), *page = written(t, &r, family_tables);
        CHECK(t, s->lacks && s->mark[1] == MARK_DARK && s->mark[2] == MARK_NONE, "marks %d, %d", s->mark[1],
              s->mark[2]);
        CHECK(t, equal_ratio(s, 1, 0, SQUARE_BLOCKS).value > 5, "pt has %g of bdpt's error",
              equal_ratio(s, 1, 0, SQUARE_BLOCKS).value);
        CHECK(t, strstr(said, "In caustic-glass, pt: misses light") != NULL && strstr(said, "a gain") == NULL, "%s",
              said);
        CHECK(t, strstr(page, "] misses light |") != NULL && strstr(page, "Perhaps no method finds all light of "
              "caustic-glass") != NULL, "%s", page);
        free(said);
        free(page);
    }
    results_free(&r);
}

void test_equal_time(struct test *t)
{
    struct plan p;
    struct results r;
    plant(&p, &r);
    check_tables(t, &r);
    check_ratios(t, &r);
    check_time(t, &r);
    check_claims(t, &r);
    results_free(&r);
    free(p.scene);
    check_all_methods(t);
    check_resumed(t);
    check_both_ways(t);
    check_missing(t);
}
