/* test_equal_time.c: methods given equal time: the arithmetic and the table on planted numbers, and a tiny
 * experiment carried out. A part of the test `report`. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/mem.h"
#include "lab/equal_page.h"
#include "lab/equal_run.h"
#include "lab/family.h"
#include "render/methods.h"
#include "tests.h"

/* --- bringing an error from the time taken to the time given ------------------------------------------ */

/* A renderer as one imagines it: so many seconds before the first sample and for each, squared error 1 / samples. */
static const double BEFORE = 0.3, EACH = 0.1;
static double seconds_of(double spp) { return BEFORE + EACH * spp; }
static double samples_in(double seconds) { return (seconds - BEFORE) / EACH; }

static struct equal_render imagined(long spp, double target)
{
    struct equal_render r = {.seed = 1, .spp = spp, .seconds = seconds_of((double)spp), .target = target};
    r.growth = equal_growth(4, seconds_of(4), spp, r.seconds);
    r.rmse8 = sqrt(1 / (double)spp);
    r.relmse = 1 / (double)spp;
    return r;
}

/* Within 3 % of the time the law leaves a thousandth. Without it, three percent and more would be left; with the wrong
 * sign, twice as much. */
static void check_law(struct test *t, double off)
{
    double target = seconds_of(20) * (1 + off), truth = 1 / samples_in(target);
    struct equal_render r = imagined(20, target), wrong = r;
    wrong.growth = -r.growth;
    double right = equal_square(&r, NAN, EQUAL_RELMSE) / truth - 1;
    double sign = equal_square(&wrong, NAN, EQUAL_RELMSE) / truth - 1, none = r.relmse / truth - 1;
    CHECK(t, fabs(right) < 0.001, "time off by %g: the error at T is off by %g", off, right);
    CHECK(t, fabs(none) > 0.03 && fabs(sign) > 0.06, "without the law by %g, with the wrong sign by %g", none, sign);
    CHECK(t, fabs(equal_square(&r, NAN, EQUAL_RMSE8) - equal_square(&r, NAN, EQUAL_RELMSE)) < 1e-12,
          "both errors follow the same law");
    CHECK(t, (equal_square(&r, NAN, EQUAL_RELMSE) < r.relmse) == (off > 0), "more time, less error");
}

static void check_samples(struct test *t)
{
    double target = 7.3;                                     /* 70 samples */
    long first = equal_samples(4, seconds_of(4), 1, target); /* too few, as if nothing were paid before */
    double growth = equal_growth(4, seconds_of(4), first, seconds_of((double)first));
    long second = equal_samples(first, seconds_of((double)first), growth, target);
    CHECK(t, first < 60 && second == 70, "70 samples take the time, %ld and then %ld are given", first, second);
    CHECK(t, equal_samples(4, 1, 1, 1e-9) == 1, "at least one sample");
    CHECK(t, equal_samples(4, 1, 1, 2) == 8 && equal_samples(10, 1, 1, 0.76) == 8, "the nearest number of samples");
    CHECK(t, fabs(equal_growth(4, 1, 16, 4) - 1) < 1e-12, "time in proportion to samples: growth 1");
    CHECK(t, equal_growth(4, 1, 4, 1.1) == 1 && equal_growth(4, 1, 5, 1) == 1 && equal_growth(4, 1, 5, 0.9) == 1,
          "growth that cannot be told is 1");
}

/* --- the table ----------------------------------------------------------------------------------------- */

enum { SCENES = 3, SEEDS = 2 };

/* Planted: squared errors over bdpt's are 0.5, 4 and 1 for asbdpt, 0.25 for lvc; rmse8 has twice the
 * ratios of relmse, and noise 3 on top of it. */
static void plant(struct plan *p, struct equal_time *e)
{
    static const double ratio[3][SCENES] = {{1, 1, 1}, {0.5, 4, 1}, {0.25, 0.25, 0.25}};
    static const char *const paths[SCENES] = {"a.pbrt", "b.pbrt", "c.pbrt"};
    memset(p, 0, sizeof *p);
    memset(e, 0, sizeof *e);
    p->n_scenes = SCENES;
    p->n_seeds = SEEDS;
    p->scene = mem_alloc(SCENES, sizeof *p->scene);
    p->directory = "results";
    p->command = "equal-time --spp 32";
    plan_set_methods(p, "bdpt,asbdpt,lvc", NULL);
    plan_set_spp(p, 32, 32, NULL);
    e->plan = p;
    e->n_scenes = SCENES;
    e->scene = mem_alloc(SCENES, sizeof *e->scene);
    for (int i = 0; i < SCENES; i++) {
        struct equal_scene *s = &e->scene[i];
        s->path = p->scene[i] = paths[i];
        s->name[0] = (char)('a' + i);
        s->noise8 = 3;
        for (int v = 0; v < 3; v++)
            for (int k = 0; k < SEEDS; k++) {
                double square = ratio[v][i] * (1 + 0.1 * k);
                struct equal_render r = {equal_seed(v, k + 1), 32 - 8 * v, 2, 2, 1, 0, square, square / 2, 0, 0};
                r.rmse8 = sqrt((v > 0 ? 2 : 1) * square + 9);
                s->render[v][k] = r;
            }
    }
}

static bool near(double a, double b) { return fabs(a - b) < 1e-9 * fabs(b); }

/* What the writer puts into a file, as text to be freed. */
static char *written(struct test *t, const struct equal_time *e, void (*write)(FILE *, const struct equal_time *))
{
    char path[512];
    snprintf(path, sizeof path, "%s/equal", test_tmp(t));
    char *text = mem_alloc(1 << 16, 1);
    FILE *f = fopen(path, "w+");
    if (!CHECK(t, f != NULL, "%s", path))
        return text;
    write(f, e);
    rewind(f);
    text[fread(text, 1, (1 << 16) - 1, f)] = '\0';
    fclose(f);
    return text;
}

static void check_ratios(struct test *t, const struct equal_time *e)
{
    struct interval i = equal_ratio(e, &e->scene[1], 1, EQUAL_RELMSE), j = equal_ratio(e, &e->scene[1], 1, EQUAL_RMSE8);
    double v = 2 * pow(0.05 / 1.05, 2); /* of the logarithm: both have two values of this relative distance */
    CHECK(t, near(i.value, 4) && near(j.value, 8), "planted ratios 4 and 8, found %g and %g", i.value, j.value);
    CHECK(t, near(log(i.high / 4), student_quantile(0.05, 2) * sqrt(v)) && near(i.low * i.high, 16),
          "Welch's interval of two seeds each: %g to %g", i.low, i.high);
    struct equal_summary s = equal_summarize(e, 1, EQUAL_RELMSE), all = equal_summarize(e, 2, EQUAL_RMSE8);
    CHECK(t, near(s.mean, cbrt(2)) && near(s.best, 0.5) && near(s.worst, 4) && s.n == 3, "mean %g, best %g, worst %g",
          s.mean, s.best, s.worst);
    CHECK(t, strcmp(s.best_scene, "a") == 0 && strcmp(s.worst_scene, "b") == 0, "in their scenes");
    CHECK(t, near(all.mean, 0.5) && near(all.best, 0.5) && near(all.worst, 0.5), "one ratio everywhere: %g", all.mean);
    /* A fifth more time is worth a fifth more error; the wrong sign would make it a sixth less. Twice the time is
     * beyond what can be told, in one render too. */
    e->scene[0].render[1][0].seconds = e->scene[0].render[1][1].seconds = 2.4;
    CHECK(t, near(equal_ratio(e, &e->scene[0], 1, EQUAL_RELMSE).value, 0.6), "an error reached in more time");
    e->scene[0].render[1][1].seconds = 4;
    CHECK(t, isnan(equal_ratio(e, &e->scene[0], 1, EQUAL_RELMSE).value) && equal_summarize(e, 1, EQUAL_RMSE8).n == 2,
          "twice the time is accounted for");
    char *table = written(t, e, equal_table);
    CHECK(t, strstr(table, " 1 was off by more than 25 %: too far") != NULL, "the table says so:\n%s", table);
    free(table);
    e->scene[0].render[1][0].seconds = e->scene[0].render[1][1].seconds = 2;
    e->scene[0].render[2][0].rmse8 = e->scene[0].render[2][1].rmse8 = 2; /* below the noise */
    all = equal_summarize(e, 2, EQUAL_RMSE8);
    CHECK(t, all.n == 2 && near(all.mean, 0.5), "a scene whose ratio cannot be told is left out");
}

static void check_files(struct test *t, const struct equal_time *e)
{
    static const char *const lines[] = {
        ("| scene | seconds | spp of each | asbdpt, rmse8 | asbdpt, relmse | asbdpt, 8x8 | "
         "lvc, rmse8 | lvc, relmse | lvc, 8x8 |"),
        "| b | 2 | 32, 24, 16 | 8.000 [",
        "| **geometric mean** | | | **2.520** of 3 | **1.260** of 3 | **1.260** of 3 |",
        "| **best** | | | **1.000** a | **0.500** a | **0.500** a |",
        "| **WORST** | | | **8.000** b | **4.000** b | **4.000** b |",
        "- asbdpt: 6 of 6 renders took the given time within 3 %",
        "    ./asbdpt-lab equal-time --spp 32 -o results \\\n",
        "\n        a.pbrt b.pbrt c.pbrt\n"};
    char last[256];
    memcpy(last, e->scene[2].name, sizeof last);
    snprintf(e->scene[2].name, sizeof last, "c|d");
    char *barred = written(t, e, equal_table);
    CHECK(t, strstr(barred, "\n| c\\|d | ") != NULL, "a bar in a name ends a cell:\n%s", barred);
    free(barred);
    memcpy(e->scene[2].name, last, sizeof last);
    char *table = written(t, e, equal_table), *csv = written(t, e, equal_csv);
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++)
        CHECK(t, strstr(table, lines[i]) != NULL, "the table lacks %s:\n%s", lines[i], table);
    CHECK(t, strncmp(csv, "scene,method,seed,spp,seconds,rmse8,relmse,", 43) == 0, "head of the CSV: %.60s", csv);
    CHECK(t, strstr(csv, "\nb,asbdpt,5102,24,2,") != NULL, "a line of the CSV:\n%s", csv);
    free(table);
    free(csv);
}

/* --- carried out --------------------------------------------------------------------------------------- */

static void check_run(struct test *t)
{
    const char *scene[1] = {"scenes/cornell-box.pbrt"};
    char directory[300];
    struct error err = {""};
    struct plan p = {.scene = scene, .n_scenes = 1, .n_seeds = 2, .width = 8, .height = 8, .n_threads = 1};
    struct equal_time e = {.plan = &p, .seconds = 0.02};
    snprintf(directory, sizeof directory, "%s/equal-time", test_tmp(t));
    p.directory = directory;
    p.quiet = true;
    plan_set_spp(&p, 32, 32, NULL);
    p.command = "";
    CHECK(t, plan_set_methods(&p, METHODS_EQUAL_TIME, &err) && p.methods.n == 5, "%s", err.text);
    CHECK(t, plan_set_methods(&p, "bdpt,lvc,asbdpt:select=bins", &err), "%s", err.text); /* those that begin quickly */
    for (int bdpt = 0; bdpt < 2; bdpt++) { /* so many seconds; the time of bdpt */
        e.seconds = bdpt ? 0 : 0.02;
        if (!CHECK(t, equal_run(&e, &err), "%s", err.text))
            break;
        const struct equal_scene *s = &e.scene[0];
        CHECK(t, e.n_scenes == 1 && s->width == 8 && s->max_depth == 6, "width %d, depth %d", s->width, s->max_depth);
        CHECK(t, isfinite(s->noise8) && s->noise8 > 0, "the stored reference's noise: %g", s->noise8);
        for (int v = 0; v < p.methods.n; v++)
            for (int i = 0; i < 2; i++) {
                const struct equal_render *r = &s->render[v][i];
                CHECK(t, r->seed == 5000 + 100 * v + i + 1 && r->spp >= 1 && r->rmse8 > 0 && r->relmse > 0,
                      "seed %ld, %ld spp, rmse8 %g, relmse %g", r->seed, r->spp, r->rmse8, r->relmse);
                CHECK(t, r->target == (bdpt ? s->render[0][i].seconds : 0.02), "time given: %g", r->target);
            }
        CHECK(t, !bdpt || s->render[0][0].spp == 32, "bdpt's samples: %ld", s->render[0][0].spp);
        equal_free(&e);
    }
    equal_free(&e);
}

/* --- all methods side by side -------------------------------------------------------------------------- */

static void check_family_tables(struct test *t, const struct equal_time *e)
{
    char *table = written(t, e, family_tables), *svg = written(t, e, family_figure);
    CHECK(t, strstr(table, "| asbdpt | 1.33 | 2.52 of 3 | 1.26 of 3 | 1.26 of 3 | 1 a | 8 b |") != NULL,
          "samples cost 32/24 times as much, means and ends as planted:\n%s", table);
    CHECK(t, strstr(table, "| b, 0x0 | 8.000 [5.988, 10.689] | 0.500 [0.374, 0.668] |") != NULL, "a scene:\n%s", table);
    int dots = 0, gains = 0;
    for (const char *p = svg; (p = strstr(p, "<circle class=")) != NULL; p++, dots++)
        gains += strncmp(p + 15, "gain", 4) == 0;
    CHECK(t, dots == 6 && gains == 3 && strstr(svg, "nan") == NULL, "%d ratios in the figure, %d gains", dots, gains);
    free(table);
    free(svg);
}

/* asbdpt's planted ratios have the mean cbrt(2), lvc's 1/4, each over three scenes of the same interval. */
static void check_verdict(struct test *t, const struct equal_time *e)
{
    struct interval one = equal_ratio(e, &e->scene[0], 2, EQUAL_RELMSE), all = equal_overall(e, 2, EQUAL_RELMSE);
    CHECK(t, near(all.value, 0.25) && near(log(all.high / all.value), log(one.high / one.value) / sqrt(3)) &&
          near(all.low * all.high, all.value * all.value), "%g [%g, %g]", all.value, all.low, all.high);
    const struct interval wide = {exp(0.1), exp(-0.1), exp(0.3)};
    CHECK(t, equal_seeds_wanted(wide, 2) == 8, "half the width, four times the seeds: %g", equal_seeds_wanted(wide, 2));
    char *said = written(t, e, equal_verdict);
    CHECK(t, strstr(said, "lvc over that of bdpt after the same time, per pixel: 0.25 (95 %: ") != NULL &&
          strstr(said, "): a gain.\nIn means over 8x8") != NULL && strstr(said, "per pixel: 1.26 (95 %: ") != NULL &&
          strstr(said, "): a loss.\n") != NULL, "%s", said);
    int lines = 0;
    for (const char *p = said; (p = strchr(p, '\n')) != NULL; p++)
        lines++;
    CHECK(t, lines == 2 * (e->plan->methods.n - 1) + 1, "two lines for a method, and one: %s", said);
    free(said);
}

/* Every row of the table of methods, the reference's first, as methods_read wants them. */
static void check_all_methods(struct test *t)
{
    char text[METHODS_TEXT];
    struct methods all;
    struct error err = {""};
    int rows = 0;
    while (method_rows[rows] != NULL)
        rows++;
    methods_all(text);
    CHECK(t, methods_read(text, &all, &err) && all.n == rows && strcmp(all.item[0].text, METHOD_REFERENCE) == 0,
          "%d rows, %d methods in %s: %s", rows, all.n, text, err.text);
}

/* Started again, nothing is rendered twice, but what is lost or has another key. */
static void check_family_run(struct test *t)
{
    static const char *const files[] = {"family.md", "family.csv", "family.svg", "family.png",
                                        "images/cornell-box-published-lvc.pfm"};
    const char *scenes[2] = {"scenes/cornell-box.pbrt", "scenes/cornell-box.pbrt"};
    char directory[300], path[512];
    struct error err = {""};
    struct plan p = {.scene = scenes, .n_scenes = 2, .n_own = 1, .n_seeds = 2, .width = 8, .height = 8, .n_threads = 1};
    struct equal_time first = {.plan = &p, .pictures = true}, again = first;
    snprintf(directory, sizeof directory, "%s/family", test_tmp(t));
    p.directory = directory;
    p.quiet = true;
    p.command = "";
    plan_set_spp(&p, 32, 32, NULL);
    plan_set_methods(&p, "bdpt,lvc", &err);
    if (CHECK(t, equal_run(&first, &err) && family_write(&first, &err), "%s", err.text)) {
        for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
            snprintf(path, sizeof path, "%s/%s", directory, files[i]);
            CHECK(t, file_exists(path), "%s is not there", path);
        }
        snprintf(path, sizeof path, "%s/runs/cornell-box--lvc--seed2.csv", directory);
        CHECK(t, remove(path) == 0 && equal_run(&again, &err), "%s: %s", path, err.text);
        for (int k = 0; k < 8; k++) {
            const struct equal_render *a = &first.scene[k / 4].render[k / 2 % 2][k % 2];
            const struct equal_render *b = &again.scene[k / 4].render[k / 2 % 2][k % 2];
            CHECK(t, k == 3 || (a->seconds == b->seconds && a->spp == b->spp && a->rmse8 == b->rmse8), "render %d", k);
            CHECK(t, a->target == b->target && a->seed == b->seed && b->blocks > 0, "render %d, kept or not", k);
        }
        CHECK(t, file_exists(path), "what was lost is kept again");
        struct equal_render r;
        CHECK(t, !equal_recall(path, "cornell-box", &r), "a key that begins alike is another");
    }
    equal_free(&first);
    equal_free(&again);
}

void test_equal_time(struct test *t)
{
    struct plan p;
    struct equal_time e;
    check_law(t, 0.03);
    check_law(t, -0.03);
    check_samples(t);
    plant(&p, &e);
    check_files(t, &e);
    check_family_tables(t, &e);
    check_verdict(t, &e);
    check_ratios(t, &e);
    equal_free(&e);
    free(p.scene);
    check_run(t);
    check_all_methods(t);
    check_family_run(t);
}
