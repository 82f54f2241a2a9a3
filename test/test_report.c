/* test_report.c: experiments: statistics, plots, a tiny experiment carried out, resumed and written, its files
 * read. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/mem.h"
#include "base/rng.h"
#include "lab/stats.h"
#include "image/image.h"
#include "look/compare.h"
#include "lab/experiment.h"
#include "lab/figures.h"
#include "look/markup.h"
#include "lab/pictures.h"
#include "lab/plan_scene.h"
#include "lab/published.h"
#include "lab/report.h"
#include "lab/tables.h"
#include "parser/parser.h"
#include "helpers.h"
#include "tests.h"

/* The content of a file as text, to be freed; an empty text after a failed check. */
static char *text_of(struct test *t, const char *path)
{
    uint8_t *data = NULL;
    size_t size = 0;
    struct error err;
    if (!CHECK(t, file_read(path, &data, &size, &err), "%s", err.text))
        size = 0;
    char *text = mem_alloc(size + 1, 1);
    if (size > 0)
        memcpy(text, data, size);
    free(data);
    return text;
}

/* The content of a file that the experiment left. */
static char *output_of(struct test *t, const struct results *r, const char *name)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s", r->plan->directory, name);
    return text_of(t, path);
}

/* --- statistics -------------------------------------------------------------------------------------- */

static double normal(struct rng *r)
{
    double u = 1 - rng_uniform(r), v = rng_uniform(r);
    return sqrt(-2 * log(u)) * cos(2 * PI * v);
}

/* p-value of "a 95 % interval whose ends are drawn in by `shrink` holds the true ratio at least 95 times of 100". Not
 * "exactly": with Welch's degrees of freedom for few values it does so 96 times. */
static double coverage_p(struct test *t, double shrink)
{
    enum { TRIALS = 4000, SEEDS = 4 };
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 77, 0);
    int inside = 0;
    for (int i = 0; i < TRIALS; i++) {
        double a[SEEDS], b[SEEDS];
        for (int k = 0; k < SEEDS; k++) {
            a[k] = 3 + 0.1 * normal(&r);
            b[k] = 2 + 0.066667 * normal(&r);
        }
        struct interval ratio = results_ratio(a, SEEDS, b, SEEDS);
        double low = ratio.value + shrink * (ratio.low - ratio.value);
        double high = ratio.value + shrink * (ratio.high - ratio.value);
        inside += low <= 1.5 && 1.5 <= high;
    }
    double observed[2] = {inside, TRIALS - inside}, expected[2] = {0.95 * TRIALS, 0.05 * TRIALS};
    double both_sides = stats_chi2_test(observed, expected, 2);
    return observed[0] < expected[0] ? both_sides / 2 : 1 - both_sides / 2;
}

static void test_statistics(struct test *t)
{
    CHECK(t, fabs(student_quantile(0.05, 2) - 4.302653) < 1e-5, "t(2) at 5 %%: %g", student_quantile(0.05, 2));
    CHECK(t, fabs(student_quantile(0.05, 10) - 2.228139) < 1e-5, "t(10) at 5 %%: %g", student_quantile(0.05, 10));
    const double a[3] = {2.0, 2.2, 2.4}, b[2] = {1.0, 1.2};
    struct interval i = results_ratio(a, 3, b, 2);
    double va = 0.04 / 3 / (2.2 * 2.2), vb = 0.02 / 2 / (1.1 * 1.1);
    double dof = (va + vb) * (va + vb) / (va * va / 2 + vb * vb / 1);
    CHECK(t, fabs(i.value - 2) < 1e-12, "ratio of means: %g", i.value);
    CHECK(t, fabs(log(i.high / 2) - student_quantile(0.05, dof) * sqrt(va + vb)) < 1e-9, "upper end %g", i.high);
    CHECK(t, fabs(i.low * i.high - 4) < 1e-9, "the interval is symmetric in the logarithm: %g %g", i.low, i.high);
    CHECK(t, isnan(results_ratio(a, 1, b, 2).low) && isfinite(results_ratio(a, 1, b, 2).value),
          "one seed has no interval");
    const double below[2] = {-1, -2};
    CHECK(t, isnan(results_ratio(below, 2, b, 2).value), "error below the reference's noise has no ratio");
    TEST_ACCEPT(t, coverage_p(t, 1), "95 %% intervals of a ratio hold it at least 95 times of 100");
    TEST_REJECT(t, coverage_p(t, 0.7), "intervals drawn in to 0.7 hold it as often");
}

/* --- plots ------------------------------------------------------------------------------------------- */

static void check_axis(struct test *t, const struct plot_axis *a)
{
    double tick[AXIS_MAX_TICKS];
    bool major[AXIS_MAX_TICKS];
    int n = axis_ticks(a, tick, major), majors = 0;
    for (int i = 0; i < n; i++) {
        majors += major[i];
        double at = axis_position(a, tick[i]);
        CHECK(t, at > -1e-9 && at < 1 + 1e-9, "tick %g lies on the axis [%g, %g]", tick[i], a->low, a->high);
        CHECK(t, i == 0 || tick[i] > tick[i - (i > 0)], "ticks rise: number %d is %g", i, tick[i]);
        char digits[32]; /* round numbers need few digits */
        snprintf(digits, sizeof digits, "%.3g", tick[i]);
        CHECK(t, fabs(atof(digits) - tick[i]) <= 1e-9 * fmax(fabs(tick[i]), a->high - a->low),
              "tick %.12g is round", tick[i]);
    }
    CHECK(t, majors >= (a->logarithmic ? 1 : 3) && majors <= 14, "%d numbers on [%g, %g]", majors, a->low, a->high);
}

/* The errors of the seeds' mean and of the reference's: 3.160 +- 0.099 % is a bias, and 0.160 is none. */
static void test_bias(struct test *t)
{
    enum { METHOD = 1 };
    struct plan p = {.n_seeds = 3, .n_compared = 2};
    struct scene_results *s = mem_alloc(1, sizeof *s);
    s->plan = &p;
    s->reference.mean_error = 0.0004;
    for (int biased = 0; biased < 2; biased++) {
        for (int i = 0; i < 3; i++)
            s->run[METHOD][i].step[0].value[Q_MEAN_ERROR] = 0.0016 + 0.03 * biased + 0.001715 * (i - 1);
        p.n_steps = 1;
        struct estimate e = results_mean(s, METHOD, 0, Q_MEAN_ERROR);
        double found = results_bias_p(s, METHOD, 0);
        double error = sqrt(e.error * e.error + 0.0004 * 0.0004), dof = 2 * pow(error / e.error, 4);
        CHECK(t, fabs(found - stats_student_p(e.mean / error, dof)) < 1e-12 && (found < 0.01) == biased,
              "p is %g", found);
    }
    free(s);
}

static void test_axes(struct test *t)
{
    static const double range[][2] = {{0.01, 0.02}, {1, 1},  {3, 700},    {0.0004, 12},
                                      {2e-9, 3e9},  {8, 64}, {0.99, 1.01}};
    for (size_t i = 0; i < sizeof range / sizeof range[0]; i++) {
        struct plot_axis log_axis = axis_make(true, range[i][0], range[i][1]);
        struct plot_axis linear = axis_make(false, -range[i][0], range[i][1]);
        check_axis(t, &log_axis);
        check_axis(t, &linear);
    }
    struct plot_axis a = axis_make(true, 1, 100);
    double middle = 0.5 * (axis_position(&a, 1) + axis_position(&a, 100));
    CHECK(t, fabs(axis_position(&a, 10) - middle) < 1e-12, "10 lies half way between 1 and 100");
    a = axis_make(false, 1, 3);
    middle = 0.5 * (axis_position(&a, 1) + axis_position(&a, 3));
    CHECK(t, fabs(axis_position(&a, 2) - middle) < 1e-12, "2 lies half way between 1 and 3");
}

/* --- well-formedness --------------------------------------------------------------------------------- */

/* Does every tag close in order? Enough for what this program writes: no comments, no CDATA. */
static bool xml_ok(const char *p)
{
    enum { DEPTH = 32, NAME = 32 };
    char open[DEPTH][NAME];
    int depth = 0;
    while ((p = strchr(p, '<')) != NULL) {
        const char *end = strchr(p, '>');
        size_t n = strcspn(p + 1 + (p[1] == '/'), " \n/>");
        if (end == NULL || n == 0 || n >= NAME || depth >= DEPTH - 1)
            return false;
        if (p[1] == '/') {
            if (depth == 0 || strlen(open[--depth]) != n || strncmp(open[depth], p + 2, n) != 0)
                return false;
        } else if (end[-1] != '/') {
            memcpy(open[depth], p + 1, n);
            open[depth++][n] = '\0';
        }
        p = end;
    }
    return depth == 0;
}

/* Do all lines have as many fields as the first? No quoted fields. Returns the number of lines, 0 if not. */
static int csv_lines(const char *p)
{
    int lines = 0, first = 0, commas = 0;
    for (; *p != '\0'; p++) {
        commas += *p == ',';
        if (*p != '\n')
            continue;
        if (lines++ == 0)
            first = commas;
        if (commas != first)
            return 0;
        commas = 0;
    }
    return lines;
}

static void test_markup(struct test *t)
{
    char path[256];
    snprintf(path, sizeof path, "%s/markup", test_tmp(t));
    FILE *f = fopen(path, "w");
    xml_print(f, "<%s>%s</p> %d %04ld %.1f %s|", "p", "a<b & \"c\" %d", 3, 14L, 0.25, "x");
    fclose(f);
    char *text = text_of(t, path);
    CHECK(t, strcmp(text, "<p>a&lt;b &amp; &quot;c&quot; %d</p> 3 0014 0.2 x|") == 0, "markup printed: %s", text);
    free(text);
    CHECK(t, xml_ok("<a><b/>x</a>") && !xml_ok("<a><b></a></b>") && !xml_ok("<a>"),
          "tags out of order are refused by the checker");
    CHECK(t, csv_lines("a,b\n1,2\n") == 2 && csv_lines("a,b\n1\n") == 0, "and lines of unequal fields");
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
static const char METHODS[] = "bdpt,asbdpt:select=bins/pool/subspaces";
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

/* A plan of one scene in a directory of its own. */
static void set_up(struct test *t, const char *name, struct setup *s)
{
    struct error err = {""};
    memset(s, 0, sizeof *s);
    snprintf(s->scene_path, sizeof s->scene_path, "%s/cornell-box.pbrt",
             test_tmp(t)); /* a scene with printed numbers */
    snprintf(s->directory, sizeof s->directory, "%s/%s", test_tmp(t), name);
    write_scene(s->scene_path, "[6 6 6]");
    CHECK(t, plan_set_methods(&s->plan, METHODS, &err) && plan_add_sweep(&s->plan, SWEEP, &err), "%s",
          err.text);
    plan_set_spp(&s->plan, 16, 64, NULL);
    s->plan.command = "experiment";
    s->scene[0] = s->scene_path;
    s->plan.scene = s->scene;
    s->plan.n_scenes = 1;
    s->plan.n_seeds = 2;
    s->plan.width = 8;
    s->plan.reference_spp = 64;
    s->plan.n_threads = 1;
    s->plan.quiet = true;
    s->plan.directory = s->directory;
}

static bool carry_out(struct test *t, struct setup *s, struct results *out)
{
    struct error err = {""};
    memset(out, 0, sizeof *out);
    return CHECK(t, experiment_run(&s->plan, out, &err), "experiment: %s", err.text);
}

/* Are all measurements but the times the same, and the times too if `times`? */
static bool same_results(const struct results *a, const struct results *b, bool times)
{
    for (int v = 0; v < N_METHODS; v++)
        for (int seed = 0; seed < plan_seeds(a->plan, v); seed++)
            for (int i = 0; i < a->plan->n_steps; i++) {
                const struct run_step *p = &a->scene[0].run[v][seed].step[i],
                                      *q = &b->scene[0].run[v][seed].step[i];
                bool same = p->spp == q->spp;
                for (int k = times ? 0 : Q_SECONDS + 1; k < N_QUANTITIES; k++)
                    same = same && p->value[k] == q->value[k];
                if (!same)
                    return false;
            }
    const struct reference *r = &a->scene[0].reference, *s = &b->scene[0].reference;
    if (r->noise8 != s->noise8 || r->mean_error != s->mean_error)
        return false;
    for (int v = 0; v < COMPARED; v++)
        if (memcmp(a->scene[0].image[v], b->scene[0].image[v], 8 * 6 * 3 * sizeof(float)) != 0)
            return false;
    return true;
}

/* The step's picture rendered in one go, without the experiment. */
static double direct_rmse8(struct test *t, const struct results *r, int method, int step)
{
    struct scene scene;
    struct film film;
    struct error err = {""};
    float pixels[8 * 6 * 3];
    if (!scene_from_file(t, r->scene[0].path, 8, 6, &scene))
        return NAN;
    const struct measured *m = &r->plan->methods.item[method];
    struct settings base = {0}, s = {0};
    settings_set(&base, "rrthreshold", "0", "test");
    s = measured_settings(m, &base);
    settings_clear(&base);
    settings_clear(&scene.settings);
    scene.settings = s;
    struct render_options o = {.integrator = m->integrator, .n_threads = 2, .max_depth = 4};
    o.seed = (uint64_t)plan_seed(method, 1);
    o.end = r->plan->spp[step];
    film_init(&film, render_crop(&scene), 8, 6);
    CHECK(t, render_scene(&scene, &o, &film, &err), "%s", err.text);
    film_develop(&film, scene.film_scale, pixels);
    double rmse8 = compare_pixels(pixels, r->scene[0].reference.pixels, 8 * 6 * 3).rmse8;
    film_free(&film);
    scene_free(&scene);
    return rmse8;
}

static void check_runs(struct test *t, const struct results *r)
{
    const struct scene_results *s = &r->scene[0];
    CHECK(t, s->width == 8 && s->height == 6 && s->max_depth == 4, "%dx%d, depth %d", s->width, s->height,
          s->max_depth);
    CHECK(t, strcmp(s->name, "cornell-box") == 0, "scene name %s", s->name);
    for (int v = 0; v < N_METHODS; v++)
        for (int i = 0; i < r->plan->n_steps; i++) {
            double direct = direct_rmse8(t, r, v, i), ours = s->run[v][0].step[i].value[Q_RMSE8];
            CHECK(t, fabs(direct - ours) < 1e-9, "%s after %ld spp: rmse8 %g, rendered in one go %g",
                  r->plan->methods.item[v].text, r->plan->spp[i], ours, direct);
        }
    const struct run_step *step = s->run[0][0].step;
    double seconds[2] = {step[0].value[Q_SECONDS], step[r->plan->n_steps - 1].value[Q_SECONDS]};
    CHECK(t, seconds[0] > 0 && seconds[1] > seconds[0], "time rises: %g, %g s", seconds[0], seconds[1]);
}

static void check_tables(struct test *t, const struct results *r)
{
    const struct scene_results *s = &r->scene[0];
    struct table table;
    int last = r->plan->n_steps - 1;
    const struct run_step *a = &s->run[POOL][0].step[last], *b = &s->run[POOL][1].step[last];
    table_make(r, s, TABLE_RMSE, &table);
    size_t cell = (size_t)last * table.columns + 1 + POOL;
    double x = a->value[Q_RMSE8], y = b->value[Q_RMSE8], mean = 0.5 * (x + y), error = 0.5 * fabs(x - y);
    CHECK(t, table.cell[cell].value == mean, "RMSE of pool in the table: %g, computed: %g", table.cell[cell].value,
          mean);
    struct estimate e = results_mean(s, POOL, last, Q_RMSE8);
    CHECK(t, fabs(e.error - error) < 1e-12, "standard error of two values: %g, %g", e.error, error);
    table_free(&table);

    double n2 = s->reference.noise8 * s->reference.noise8, cost[2] = {0, 0};
    for (int v = 0; v < 2; v++)
        for (int i = 0; i < 2; i++) {
            const struct run_step *p = &s->run[v == 0 ? 0 : POOL][i].step[last];
            cost[v] += 0.5 * (p->value[Q_RMSE8] * p->value[Q_RMSE8] - n2) * p->value[Q_SECONDS];
        }
    table_make(r, s, TABLE_COST, &table);
    cell = (size_t)last * table.columns + 1 + COMPARED + POOL - 1;
    CHECK(t, !(cost[0] > 0 && cost[1] > 0) || fabs(table.cell[cell].value * cost[0] / cost[1] - 1) < 1e-9,
          "equal-time ratio of pool in the table: %g, computed: %g", table.cell[cell].value, cost[1] / cost[0]);
    table_free(&table);

    CHECK(t, table_make(r, s, TABLE_PRINTED, &table), "the scene has printed numbers");
    const struct published *p = published_find("cornell-box");
    cell = table_rows(&table) * table.columns - 1;
    CHECK(t, table.cell[cell].value == p->asbdpt[4] / p->bdpt[4], "the last printed ratio: %g",
          table.cell[cell].value);
    table_free(&table);
}

/* The heat map of a method on the sheet has the colours that its errors have on the common scale. */
static void check_sheet(struct test *t, const struct results *r)
{
    const struct scene_results *s = &r->scene[0];
    struct image img;
    struct error err = {""};
    char path[512];
    snprintf(path, sizeof path, "%s/images/cornell-box.png", r->plan->directory);
    if (!CHECK(t, image_read(path, &img, &err), "%s", err.text))
        return;
    int k = COLUMN_WIDTH / s->width, column = s->width * k + COLUMN_GAP;
    CHECK(t, img.width == (COMPARED + 1) * column + COLUMN_GAP, "%d columns of %d", COMPARED + 1, column);
    int below = img.height - COLUMN_GAP - s->height * k;
    double scale = pictures_error_scale(s);
    CHECK(t, scale > 0, "the scale is %g", scale);
    for (int i = 0; i < s->width * s->height; i++) {
        float e = (float)compare_pixels(s->image[POOL] + 3 * i, s->reference.pixels + 3 * i, 3).rmse8, colour[3];
        int x = COLUMN_GAP + (POOL + 1) * column + i % s->width * k, y = below + i / s->width * k;
        compare_heatmap(&e, 1, scale, colour);
        for (int c = 0; c < 3; c++)
            CHECK(t, srgb_byte((double)colour[c]) == img.u8[3 * (y * img.width + x) + c], "pixel %d, error %g of %g", i,
                  (double)e, scale);
    }
    image_free(&img);
}

/* Every file the experiment leaves is well-formed, and every one that the page names is there. */
static void check_output(struct test *t, const struct results *r)
{
    static const char *const plots[] = {"convergence", "samples", "bias", "sweep-1"};
    struct error err = {""};
    CHECK(t, report_write(r, &err), "output: %s", err.text);
    check_sheet(t, r);
    for (size_t i = 0; i < sizeof plots / sizeof plots[0]; i++) {
        char name[128];
        snprintf(name, sizeof name, "plots/cornell-box-%s.svg", plots[i]);
        char *svg = output_of(t, r, name);
        CHECK(t, xml_ok(svg) && strstr(svg, "nan") == NULL && strstr(svg, "inf\"") == NULL, "%s", name);
        free(svg);
    }
    int runs = 0;
    for (int v = 0; v < N_METHODS; v++)
        runs += plan_seeds(r->plan, v);
    char *means = output_of(t, r, "results.csv"), *each = output_of(t, r, "runs.csv");
    CHECK(t, csv_lines(means) == 1 + N_METHODS * r->plan->n_steps, "results.csv has %d lines", csv_lines(means));
    CHECK(t, csv_lines(each) == 1 + runs * r->plan->n_steps, "runs.csv has %d lines", csv_lines(each));
    free(means);
    free(each);

    char *page = output_of(t, r, "results.md");
    int named = 0;
    for (const char *p = page; (p = strstr(p, "](")) != NULL; p += 2, named++) {
        char path[512];
        snprintf(path, sizeof path, "%s/%.*s", r->plan->directory, (int)strcspn(p + 2, ")"), p + 2);
        CHECK(t, file_exists(path), "%s, which the page names, is not there", path);
    }
    CHECK(t, named == 2 + 2 + 4 && strstr(page, "nan") == NULL, "the page names %d files", named);
    free(page);
}

/* What is not known of a reference is said to be so. */
static void check_unknown(struct test *t, struct results *r)
{
    struct table table;
    double *error = &r->scene[0].reference.mean_error, known = *error;
    *error = NAN;
    table_make(r, &r->scene[0], TABLE_BIAS, &table);
    CHECK(t, strstr(table.caption, "error: not known)") != NULL, "caption \"%s\"", table.caption);
    table_free(&table);
    *error = known;
}

/* The experiment once more: are its results those of the first time? */
static void check_again(struct test *t, struct setup *s, const struct results *first, bool same, bool times,
                        const char *what)
{
    struct results again;
    carry_out(t, s, &again);
    CHECK(t, same_results(first, &again, times) == same, "%s", what);
    again.scene[0].run[POOL][0] = again.scene[0].run[POOL][1];
    CHECK(t, !same_results(first, &again, false), "two seeds have different results");
    results_free(&again);
}

static void test_experiment(struct test *t)
{
    struct setup s, other;
    struct results first;
    char path[512];
    set_up(t, "experiment", &s);
    if (!carry_out(t, &s, &first)) {
        results_free(&first);
        return;
    }
    check_runs(t, &first);
    check_tables(t, &first);
    check_output(t, &first);
    check_unknown(t, &first);

    /* Started again, nothing is done twice: even the times are the old ones. */
    check_again(t, &s, &first, true, true, "an experiment started again has the same results");
    /* Interrupted: one run is lost, one is damaged. */
    snprintf(path, sizeof path, "%s/runs/cornell-box--asbdpt-select-bins--seed1.csv", s.directory);
    CHECK(t, remove(path) == 0, "%s exists", path);
    snprintf(path, sizeof path, "%s/runs/cornell-box--asbdpt-select-pool--seed2.csv", s.directory);
    FILE *f = fopen(path, "a");
    fputs("64,1", f);
    fclose(f);
    check_again(t, &s, &first, true, false, "an interrupted experiment ends with the same results");
    /* Another directory and other threads give the same measurements. */
    set_up(t, "elsewhere", &other);
    other.plan.n_threads = 3;
    check_again(t, &other, &first, true, false, "the results do not depend on threads");
    /* A scene that has changed begins anew. */
    f = fopen(s.scene_path, "a");
    fputs("# nothing\n", f);
    fclose(f);
    check_again(t, &s, &first, true, false, "a comment in the scene changes nothing");
    write_scene(s.scene_path, "[9 9 9]");
    check_again(t, &s, &first, false, false, "a brighter light does");
    results_free(&first);
}

/* --- the plan and the reference ---------------------------------------------------------------------- */

static void test_methods(struct test *t)
{
    static const char *const wrong[][2] = {
        {"bdtp", "did you mean bdpt"}, {"bdpt,", "expected methods"}, {"bdpt,bdpt", "given twice"},
        {"asbdpt:select", "expected NAME=VALUE"}, {"asbdpt:selects=bins", "no parameter \"selects\""},
        {"asbdpt:select=bin", "\"bin\" is unknown"}, {"asbdpt:select=bins:restart=x", "restart = \"x\""},
        {"bdpt:select=bins", "no parameter \"select\""}, {"lt:rrthreshold=0/1/0", "given twice"}};
    struct methods m;
    struct error err = {""};
    CHECK(t, methods_read("bdpt,asbdpt:select=bins/pool,asbdpt:select=bins:restart=0/8:binpaths=4/16", &m, &err), "%s",
          err.text);
    CHECK(t, m.n == 7 && strcmp(m.item[2].text, "asbdpt:select=pool") == 0, "%d methods, %s", m.n, m.item[2].text);
    CHECK(t, strcmp(m.item[4].text, "asbdpt:select=bins:restart=0:binpaths=16") == 0, "%s", m.item[4].text);
    CHECK(t, strcmp(m.item[4].file, "asbdpt-select-bins-restart-0-binpaths-16") == 0, "%s", m.item[4].file);
    struct settings base = {0};
    settings_set(&base, "restart", "32", "test");
    settings_set(&base, "rrthreshold", "0", "test");
    struct settings s = measured_settings(&m.item[4], &base);
    CHECK(t, s.n == 4 && strcmp(settings_text(&s, "restart", ""), "0") == 0 &&
                 strcmp(settings_text(&s, "binpaths", ""), "16") == 0 &&
                 strcmp(settings_text(&s, "rrthreshold", ""), "0") == 0, "its own settings over the others'");
    settings_clear(&s);
    settings_clear(&base);
    static const char *const usual[] = {METHODS_EXPERIMENT, METHODS_EQUAL_TIME, METHODS_DEMO, SWEEPS_FULL, SWEEPS_QUICK,
                                        METHOD_REFERENCE "," METHOD_PARTNER "," METHOD_PRINTED, METHODS_BENCH};
    for (size_t i = 0; i < sizeof usual / sizeof usual[0]; i++)
        CHECK(t, methods_read(usual[i], &m, &err) && m.n > 0, "%s", err.text);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        CHECK(t, !methods_read(wrong[i][0], &m, &err) && strstr(err.text, wrong[i][1]) != NULL, "%s: %s", wrong[i][0],
              err.text);
}

static void test_plan(struct test *t)
{
    struct plan p = {0};
    char name[64];
    struct error err = {""};
    CHECK(t, plan_set_spp(&p, 32, 100, NULL) && p.n_steps == 3 && p.spp[2] == 100,
          "the last step is what was asked for");
    CHECK(t, !plan_set_spp(&p, 1, 1L << 24, NULL), "too many steps are refused");
    CHECK(t, plan_set_methods(&p, "bdpt,asbdpt", &err) && plan_add_sweep(&p, "asbdpt,asbdpt:select=pool/bins", &err),
          "%s", err.text);
    CHECK(t, p.methods.n == 4 && p.n_compared == 2 && p.sweep[0].n == 3, "%d methods", p.methods.n);
    CHECK(t, p.sweep[0].method[0] == 1 && p.sweep[0].method[2] == 3, "what is compared is not measured twice");
    plan_scene_name("a/b/veach-ajar/scene.pbrt", name, sizeof name);
    CHECK(t, strcmp(name, "veach-ajar") == 0, "name of a directory's scene: %s", name);
    plan_scene_name("scenes/bathroom.pbrt", name, sizeof name);
    CHECK(t, strcmp(name, "bathroom") == 0, "name of a file: %s", name);
}

/* What a plan leaves open is the stored reference's; without one, or where it says a width, the scene's. */
static void test_planned_scene(struct test *t)
{
    static const struct {
        int width, max_depth;
        const char *name;
        int expected[3];
        bool fits; /* the stored one */
    } cases[] = {{0, 0, "bathroom", {36, 24, 10}, true}, {0, 3, "bathroom", {36, 24, 3}, false},
                 {72, 0, "bathroom", {72, 48, 10}, false}, {18, 0, "bathroom", {18, 12, 10}, true},
                 {0, 0, "no-such-name", {WIDTH_WITHOUT_REFERENCE, 32, 10}, false}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct plan p = {.width = cases[i].width, .max_depth = cases[i].max_depth, .quiet = true};
        const int *expected = cases[i].expected;
        struct scene scene;
        struct reference stored;
        struct error err = {""};
        int depth;
        bool ok = plan_scene_load(&p, "scenes/bathroom.pbrt", cases[i].name, &scene, &depth, &stored, &err);
        if (!CHECK(t, ok, "%s", err.text))
            continue;
        CHECK(t, (stored.pixels != NULL) == cases[i].fits, "case %d: a stored reference", (int)i);
        reference_free(&stored);
        CHECK(t, scene.width == expected[0] && scene.height == expected[1] && depth == expected[2],
              "case %d: %dx%d, depth %d", (int)i, scene.width, scene.height, depth);
        scene_free(&scene);
    }
}

static void test_reference(struct test *t)
{
    char path[300];
    float pixels[4 * 4 * 3];
    struct reference r = {0};
    struct error err = {""};
    for (int i = 0; i < 48; i++)
        pixels[i] = (float)(i / 12 * 4 + i / 3 % 4); /* row * 4 + column */
    snprintf(path, sizeof path, "%s/room.txt", test_tmp(t));
    FILE *f = fopen(path, "w");
    fputs("comment\nmaxdepth 5\nnoise8 0.5\nmean_error 0.001\n", f);
    fclose(f);
    snprintf(path, sizeof path, "%s/room.pfm", test_tmp(t));
    image_write(path, 4, 4, pixels, &err);
    CHECK(t, reference_find(test_tmp(t), "x/room.pbrt", "room", &r, &err), "%s", err.text);
    CHECK(t, !reference_fit(&r, 2, 2, 6, &err) && strstr(err.text, "maxdepth 5") != NULL,
          "another depth is refused: %s", err.text);
    CHECK(t, !reference_fit(&r, 3, 3, 5, &err) && strstr(err.text, "multiple") != NULL, "another size is refused: %s",
          err.text);
    CHECK(t, r.width == 4 && reference_fit(&r, 2, 2, 5, &err) && r.width == 2 && r.height == 2, "%s", err.text);
    CHECK(t, fabs((double)r.pixels[0] - 2.5) < 1e-6 && fabs((double)r.pixels[9] - 12.5) < 1e-6,
          "means of 2 x 2 pixels");
    CHECK(t, r.noise8 == 0.25 && r.mean_error == 0.001, "noise %g, %g", r.noise8, r.mean_error);
    reference_free(&r);
    CHECK(t, !reference_find("no-such-file.pfm", "", "room", &r, &err), "what was given is needed");
    CHECK(t, reference_find(NULL, "nowhere/room.pbrt", "no-such-room", &r, &err) && r.pixels == NULL, "none is found");
}

void test_report(struct test *t)
{
    test_statistics(t);
    test_bias(t);
    test_axes(t);
    test_markup(t);
    test_methods(t);
    test_plan(t);
    test_reference(t);
    test_planned_scene(t);
    test_experiment(t);
    test_equal_time(t);
}
