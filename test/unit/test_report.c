/* test_report.c: experiments: statistics, marks, and a tiny experiment that is run, written and read. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/mem.h"
#include "lab/stats.h"
#include "image/image.h"
#include "lab/compare.h"
#include "lab/measure.h"
#include "lab/pictures.h"
#include "lab/report.h"
#include "parser/parser.h"
#include "helpers.h"
#include "suites.h"

/* --- statistics -------------------------------------------------------------------------------------- */

static void test_statistics(struct test *t)
{
    CHECK(t, fabs(student_quantile(0.05, 2) - 4.302653) < 1e-5 && fabs(student_quantile(0.05, 10) - 2.228139) < 1e-5,
          "t(2) and t(10) at 5 %%: %g, %g", student_quantile(0.05, 2), student_quantile(0.05, 10));
    const double a[3] = {2.0, 2.2, 2.4}, b[2] = {1.0, 1.2}, below[2] = {-1, -2};
    struct interval i = results_ratio(a, 3, b, 2, 0), one = results_ratio(a, 1, b, 2, 0);
    double va = 0.04 / 3 / (2.2 * 2.2), vb = 0.02 / 2 / (1.1 * 1.1);
    double dof = (va + vb) * (va + vb) / (va * va / 2 + vb * vb / 1);
    CHECK(t, fabs(i.value - 2) < 1e-12 && fabs(i.low * i.high - 4) < 1e-9 &&
                 fabs(log(i.high / 2) - student_quantile(0.05, dof) * sqrt(va + vb)) < 1e-9,
          "ratio %g of means, from %g to %g: symmetric in the logarithm", i.value, i.low, i.high);
    struct interval doubted = results_ratio(a, 3, b, 2, 0.01), mean = results_mean_log(a, 3);
    double v = va + vb + 0.01, freedom = v * v / (va * va / 2 + vb * vb / 1);
    CHECK(t, fabs(log(doubted.high / 2) - student_quantile(0.05, freedom) * sqrt(v)) < 1e-9, "a doubt: to %g",
          doubted.high);
    CHECK(t, fabs(log(mean.value) - 2.2) < 1e-12 && fabs(log(mean.high) - 2.2 - 4.302653 * 0.2 / sqrt(3)) < 1e-5,
          "geometric mean %g, to %g", mean.value, mean.high);
    struct plan p = {.n_seeds = 2, .n_compared = 1};
    struct scene_results *s = mem_alloc(1, sizeof *s);
    s->plan = &p;
    s->run[0][1][0].value[Q_MEAN_ERROR] = 0.02;
    s->reference.mean_error = 0.01;
    struct estimate off = results_mean(s, 0, 0, Q_MEAN_ERROR);
    CHECK(t, fabs(off.mean - 0.01) < 1e-12 && fabs(off.error - sqrt(1 + 1.01 * 1.01) / 100) < 1e-12,
          "off by %g +- %g, of which the reference has 0.0101", off.mean, off.error);
    free(s);
    CHECK(t, isnan(one.low) && isfinite(one.value), "one seed has no interval");
    CHECK(t, isnan(results_ratio(below, 2, b, 2, 0).value), "error below the reference's noise has no ratio");
}

/* Of values of a known variance their pairs tell it: the mean of seeds' squares is that of all pairs; each seed's is
 * its own squared deviation but for noise. */
static void test_pairs_of_seeds(struct test *t)
{
    enum { SEEDS = 4 };
    static const double x[SEEDS] = {1, 2, 4, 9};
    double half[SEEDS * SEEDS] = {0}, out[SEEDS], sum = 0, variance = 0;
    for (int i = 0; i < SEEDS; i++)
        for (int j = 0; j < SEEDS; j++)
            half[i * SEEDS + j] = i == j ? NAN : (x[i] - x[j]) * (x[i] - x[j]) / 2;
    results_pairs(half, SEEDS, out);
    for (int i = 0; i < SEEDS; i++) {
        variance += (x[i] - 4) * (x[i] - 4) / (SEEDS - 1);
        sum += out[i];
        /* Of one number: (x - mean)^2 S / (S-2) less what the others' scatter says. */
        double own = (x[i] - 4) * (x[i] - 4) * SEEDS / (SEEDS - 2.0) - 38.0 / (SEEDS - 1) / (SEEDS - 2);
        CHECK(t, fabs(out[i] - own) < 1e-12, "seed %d: %g, not %g", i, out[i], own);
    }
    CHECK(t, fabs(sum / SEEDS - variance) < 1e-12, "pairs give %g, the variance is %g", sum / SEEDS, variance);
}

/* --- marks ------------------------------------------------------------------------------------------- */

/* Pictures of noise beside a reference with a tenth of its variance. What has the same mean is marked as rarely as the
 * level says. What lacks 2 % everywhere misses light. What has a fifth of one block in another, is too bright or no
 * number is biased. */
static void test_marks(struct test *t)
{
    enum { SIDE = 32, N = 3 * SIDE * SIDE, SEEDS = 3, TRIALS = 400 };
    static const enum mark expected[] = {MARK_NONE, MARK_DARK, MARK_BIASED, MARK_BIASED, MARK_BIASED};
    static float pixels[N], variance[N], x[SEEDS][N];
    const struct reference r = {.pixels = pixels, .variance = variance, .width = SIDE, .height = SIDE};
    float *picture[SEEDS] = {x[0], x[1], x[2]};
    int low[2] = {0, 0}, met = 0;
    struct rng rng = rng_stream(test_seed(t), RNG_TEST, 0, 0);
    for (int trial = 0; trial < TRIALS; trial++) {
        int which = trial < TRIALS - 20 ? 0 : trial % 5;
        for (int i = 0; i < N; i++) {
            double moved = i / 3 / SIDE < 8 && i / 3 % SIDE < 16 ? (i / 3 % SIDE < 8 ? 0.2 : -0.2) : 0;
            double lacks = which == 1 ? 0.02 : which == 2 ? moved : which == 3 ? -0.02 : 0;
            variance[i] = 0.0025f;
            pixels[i] = (float)(1 + 0.05 * sqrt(12) * (rng_uniform(&rng) - 0.5));
            for (int k = 0; k < SEEDS; k++)
                x[k][i] = (float)(1 - lacks + 0.16 * sqrt(12) * (rng_uniform(&rng) - 0.5));
        }
        x[1][77] = which == 4 ? NAN : x[1][77];
        struct mark_tests found = mark_tests(picture, SEEDS, &r);
        low[0] += which == 0 && found.blocks < 0.05;
        low[1] += which == 0 && found.mean < 0.05;
        met += mark_of(found, 10) == expected[which];
    }
    CHECK(t, low[0] <= 34 && low[1] >= 3 && low[1] <= 34, "%d and %d p-values of %d are below 0.05", low[0],
          low[1], TRIALS - 16);
    CHECK(t, met == TRIALS, "%d of %d marks are right", met, TRIALS);
}

static int lines_of(const char *text)
{
    int n = 0;
    for (; (text = strchr(text, '\n')) != NULL; text++)
        n++;
    return n;
}

/* --- a tiny experiment ------------------------------------------------------------------------------- */

static const char ROOM[] =
    "LookAt 0 0 -.9 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" 80\n"
    "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 12\nPixelFilter \"gaussian\"\n"
    "Integrator \"asbdpt\" \"integer maxdepth\" 4\nWorldBegin\n"
    "Material \"matte\" \"rgb Kd\" [.7 .5 .3]\nReverseOrientation\nShape \"sphere\" \"float radius\" 1\n"
    "ReverseOrientation\nTranslate .4 .4 .3\nAreaLightSource \"diffuse\" \"rgb L\" %s\n"
    "Shape \"sphere\" \"float radius\" .1\nWorldEnd\n";

/* What is measured: four methods, and a sweep that holds the second of them and another. */
enum { POOL = 2, N_METHODS = 5, COMPARED = 4 };
static const char METHODS[] = "bdpt:lightsamplestrategy=power,asbdpt:select=bins/pool/subspaces";
static const char SWEEP[] = "asbdpt:select=bins,asbdpt:select=bins:restart=0";

struct setup {
    char scene_path[300], directory[300];
    const char *scene[1];
    struct plan plan;
};

/* The scene with this emission. */
static void write_scene(const char *path, const char *emission)
{
    FILE *f = fopen(path, "w");
    fprintf(f, ROOM, emission);
    fclose(f);
}

/* A plan of one scene, which is called as one with printed numbers. */
static void set_up(struct test *t, struct setup *s)
{
    const struct plan plan = {.command = "experiment", .scene = s->scene, .n_scenes = 1, .n_seeds = 2, .width = 8,
                              .reference_spp = 64, .n_threads = 1, .quiet = true, .directory = s->directory,
                              .no_roulette = true};
    struct error err = {.text = ""};
    snprintf(s->scene_path, sizeof s->scene_path, "%s/cornell-box.pbrt", test_tmp(t));
    snprintf(s->directory, sizeof s->directory, "%s/experiment", test_tmp(t));
    write_scene(s->scene_path, "[6 6 6]");
    s->scene[0] = s->scene_path;
    s->plan = plan;
    CHECK(t, plan_set_methods(&s->plan, METHODS, &err) && plan_add_sweep(&s->plan, SWEEP, &err), "%s", err.text);
    plan_set_spp(&s->plan, 16, 64, NULL);
}

static bool carry_out(struct test *t, struct setup *s, struct results *out)
{
    struct error err = {.text = ""};
    memset(out, 0, sizeof *out);
    return CHECK(t, measure(&s->plan, out, &err), "experiment: %s", err.text);
}

/* The step's picture rendered in one go, without the experiment. */
static double direct_rmse8(struct test *t, const struct results *r, int method, int step)
{
    const struct measured *m = &r->plan->methods.item[method];
    struct scene scene;
    struct settings base = {0};
    float pixels[8 * 6 * 3];
    if (!scene_from_file(t, r->scene[0].path, 8, 6, &scene))
        return NAN;
    settings_set(&base, "rrthreshold", "0", "test");
    settings_clear(&scene.settings);
    scene.settings = measured_settings(m, &base);
    settings_clear(&base);
    struct render_job o = {.integrator = method_of(&scene, m->integrator), .n_threads = 2, .max_depth = 4,
                               .seed = plan_seed(r->plan, method, 1), .end = r->plan->spp[step]};
    render_pixels(t, &scene, &o, pixels);
    scene_free(&scene);
    return compare_pixels(pixels, r->scene[0].reference.pixels, 8 * 6 * 3).rmse8;
}

static void check_runs(struct test *t, const struct results *r)
{
    const struct scene_results *s = &r->scene[0];
    CHECK(t, s->width == 8 && s->height == 6 && s->max_depth == 4, "%dx%d, depth %d", s->width, s->height,
          s->max_depth);
    CHECK(t, strcmp(s->name, "cornell-box") == 0, "scene name %s", s->name);
    for (int v = 0; v < N_METHODS; v++)
        for (int i = 0; i < r->plan->n_steps; i++) {
            double direct = direct_rmse8(t, r, v, i), ours = s->run[v][0][i].value[Q_RMSE8];
            CHECK(t, fabs(direct - ours) < 1e-9, "%s after %ld spp: rmse8 %g, rendered in one go %g",
                  r->plan->methods.item[v].text, r->plan->spp[i], ours, direct);
        }
    const struct run *step = s->run[0][0];
    double rmse8 = step[0].value[Q_RMSE8], noise8 = s->reference.noise8;
    CHECK(t, fabs(step[0].square[SQUARE_MSE8] - (rmse8 * rmse8 - noise8 * noise8)) < 1e-6 * rmse8 * rmse8,
          "squared error %g, of %g with the reference's %g", step[0].square[SQUARE_MSE8], rmse8, noise8);
    CHECK(t, strcmp(s->reference.kind, "rendered here") == 0, "a reference that was made here is a %s",
          s->reference.kind);
    CHECK(t, s->reference.noise[SQUARE_RELMSE] > 1e-9, "the reference has noise in relmse, too");
    double seconds[2] = {step[0].value[Q_SECONDS], step[r->plan->n_steps - 1].value[Q_SECONDS]};
    CHECK(t, seconds[0] > 0 && seconds[1] >= seconds[0], "time falls: %g, %g s", seconds[0], seconds[1]);
}

/* The page has the mean of pool's two seeds, and what was printed. */
static void check_tables(struct test *t, const struct results *r, const char *page)
{
    const struct scene_results *s = &r->scene[0];
    int last = r->plan->n_steps - 1;
    double x = s->run[POOL][0][last].value[Q_RMSE8], y = s->run[POOL][1][last].value[Q_RMSE8];
    struct estimate e = results_mean(s, POOL, last, Q_RMSE8);
    CHECK(t, e.mean == 0.5 * (x + y) && fabs(e.error - 0.5 * fabs(x - y)) < 1e-12, "mean and error of two values: %g, "
          "%g", e.mean, e.error);
    const char *row = strstr(page, "| 64 | asbdpt:select=pool | "), *bdpt = strstr(page, "| 64 | bdpt:lights");
    double found = row != NULL ? strtod(strstr(row, "pool | ") + 7, NULL) : NAN;
    CHECK(t, fabs(found - e.mean) < 0.5 * e.error, "the table says %g of pool, not %g", found, e.mean);
    CHECK(t, bdpt != NULL && strncmp(strstr(bdpt, " | - | "), " | - | 1.9842 | ", 16) == 0, "what was printed: %.80s",
          bdpt);
}

/* The heat map of a method on the sheet has the colours that its errors have on the common scale. */
static void check_sheet(struct test *t, const struct results *r)
{
    const struct scene_results *s = &r->scene[0];
    struct image img;
    struct error err = {.text = ""};
    char path[512];
    snprintf(path, sizeof path, "%s/images/cornell-box.png", r->plan->directory);
    if (!CHECK(t, pictures_write(s, &err) && image_read(path, NULL, &img, &err), "%s", err.text))
        return;
    int k = COLUMN_WIDTH / s->width, column = s->width * k + COLUMN_GAP;
    CHECK(t, img.width == (COMPARED + 1) * column + COLUMN_GAP, "%d columns of %d", COMPARED + 1, column);
    int below = img.height - COLUMN_GAP - s->height * k;
    float error[COMPARED * 8 * 6];
    for (int v = 0; v < COMPARED; v++)
        for (int i = 0; i < 8 * 6; i++)
            error[v * 8 * 6 + i] =
                (float)compare_pixels(s->image[v] + 3 * i, s->reference.pixels + 3 * i, 3).rmse8;
    double scale = picture_percentile(error, COMPARED * 8 * 6, PICTURES_PERCENTILE);
    CHECK(t, scale > 0, "the scale is %g", scale);
    for (int i = 0; i < s->width * s->height; i++) {
        float e = (float)compare_pixels(s->image[POOL] + 3 * i, s->reference.pixels + 3 * i, 3).rmse8, colour[3];
        int x = COLUMN_GAP + POOL * column + i % s->width * k, y = below + i / s->width * k;
        compare_heatmap(&e, 1, scale, colour);
        for (int c = 0; c < 3; c++)
            CHECK(t, srgb_byte((double)colour[c]) == img.u8[3 * (y * img.width + x) + c], "pixel %d, error %g of %g", i,
                  (double)e, scale);
    }
    image_free(&img);
}

static int times(const char *text, const char *piece)
{
    int n = 0;
    for (; (text = strstr(text, piece)) != NULL; text++)
        n++;
    return n;
}

/* report.html needs nothing from elsewhere, has each method once, its points and, unless it is of a sweep alone, its
 * picture; and whatever a file is called, it ends no string and no element. */
static void check_page(struct test *t, struct results *r)
{
    static const char *const nowhere[] = {"http", " src=", "url(", "@import", "nan", "inf,", "inf]", "Infinity"};
    char *page = text_of(t, r->plan->directory, "report.html"), *data = strstr(page, "id=\"data\">");
    int depth = 0;
    struct error err;
    if (!CHECK(t, data != NULL && strlen(page) < 100000, "a page of %d bytes", (int)strlen(page)))
        return;
    for (size_t i = 0; i < sizeof nowhere / sizeof nowhere[0]; i++) {
        const char *found = strstr(i < 4 ? page : data, nowhere[i]);
        CHECK(t, found == NULL || found > strstr(data, "</script>"), "the page has %.60s", found);
    }
    CHECK(t, strncmp(page, "<!DOCTYPE html>", 15) == 0 && strcmp(page + strlen(page) - 8, "</html>\n") == 0 &&
          times(page, "<script") == 2 && times(page, "</script>") == 2 && times(page, "<style>") == 1, "a whole page");
    for (const char *c = data; c < strstr(data, "</script>"); c++)
        depth += (*c == '{' || *c == '[') - (*c == '}' || *c == ']');
    CHECK(t, depth == times(r->plan->command, "{"), "%d brackets are open", depth);
    for (int v = 0; v < N_METHODS; v++) {
        char text[METHOD_TEXT + 40];
        snprintf(text, sizeof text, "\"text\":\"%s\",", r->plan->methods.item[v].text);
        CHECK(t, times(data, text) == 1, "%s is there %d times", text, times(data, text));
    }
    char point[40];
    snprintf(point, sizeof point, "[%ld,%.5g,%.5g,", r->plan->spp[0], results_seconds(&r->scene[0], 0, 0),
             sqrt(results_square(&r->scene[0], 0, 0, SQUARE_MSE8))); /* after more the reference is too noisy */
    CHECK(t, strstr(data, point) != NULL, "no point %s", point);
    CHECK(t, times(data, "\"png\":\"iVBORw0KGgo") == COMPARED + 1 && strstr(data, "[64,1.9842]") != NULL,
          "%d pictures", times(data, "\"png\":\"iVBORw0KGgo"));
    free(page);
    snprintf(r->scene[0].reference.origin, sizeof r->scene[0].reference.origin, "</script>\"&\\");
    CHECK(t, report_write(r, &err), "%s", err.text);
    page = text_of(t, r->plan->directory, "report.html");
    CHECK(t, strstr(page, "\"origin\":\"\\u003c/script\\u003e\\u0022\\u0026\\u005c\",") != NULL &&
          times(page, "</script>") == 2, "a name that ends an element");
    free(page);
}

/* Every file the experiment leaves is well-formed, and every one that the page names is there. */
static void check_output(struct test *t, struct results *r)
{
    struct error err = {.text = ""};
    CHECK(t, report_write(r, &err), "output: %s", err.text);
    check_sheet(t, r);
    int runs = 0;
    for (int v = 0; v < N_METHODS; v++)
        runs += plan_seeds(r->plan, v);
    char *each = text_of(t, r->plan->directory, "runs.csv");
    CHECK(t, lines_of(each) == 1 + runs * r->plan->n_steps, "runs.csv has %d lines", lines_of(each));
    free(each);
    char *page = text_of(t, r->plan->directory, "results.md");
    int named = 0;
    for (const char *p = page; (p = strstr(p, "](")) != NULL; p += 2, named++) {
        char path[512];
        snprintf(path, sizeof path, "%s/%.*s", r->plan->directory, (int)strcspn(p + 2, ")"), p + 2);
        CHECK(t, file_exists(path), "%s, which the page names, is not there", path);
    }
    CHECK(t, named == 2 && strstr(page, "nan") == NULL, "the page names %d files", named);
    CHECK(t, strstr(page, "larger than what it judges; use more --reference-spp:** bdpt") != NULL, "64 samples are "
          "compared with a reference of 64");
    check_tables(t, r, page);
    free(page);
    check_page(t, r);
}

static void test_experiment(struct test *t)
{
    struct setup s;
    struct results first;
    set_up(t, &s);
    if (!carry_out(t, &s, &first)) {
        results_free(&first);
        return;
    }
    check_runs(t, &first);
    check_output(t, &first);

    first.scene[0].reference.mean_error = NAN; /* what is not known of a reference is said to be so */
    struct error err;
    CHECK(t, report_write(&first, &err), "%s", err.text);
    char *page = text_of(t, s.directory, "results.md");
    CHECK(t, strstr(page, "mean is not known.") != NULL, "an unknown error of the reference");
    free(page);
    results_free(&first);
}

void test_report(struct test *t)
{
    test_statistics(t);
    test_pairs_of_seeds(t);
    test_marks(t);
    test_experiment(t);
}
