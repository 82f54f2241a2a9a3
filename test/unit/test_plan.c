/* test_plan.c: what an experiment consists of: methods, steps, sweeps, scenes and their stored references. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "image/image.h"
#include "lab/files.h"
#include "lab/plan.h"
#include "suites.h"

static void test_methods(struct test *t)
{
    static const char *const wrong[][2] = {
        {"bdtp", "no integrator bdtp; known are"}, {"bdpt,", "expected methods"}, {"bdpt,bdpt", "given twice"},
        {"asbdpt:select", "expected NAME=VALUE"}, {"asbdpt:selects=bins", "no parameter \"selects\""},
        {"asbdpt:select=bin", "\"bin\" is unknown"}, {"asbdpt:select=bins:restart=x", "restart = \"x\""},
        {"bdpt:select=bins", "no parameter \"select\""}, {"lt:rrthreshold=0/1/0", "given twice"}};
    static const char *const usual[] = {METHODS_EXPERIMENT, METHODS_EQUAL_TIME, METHODS_OWN_SCENE, SWEEPS_FULL,
                                        SWEEPS_QUICK, METHOD_REFERENCE "," METHOD_PARTNER "," METHOD_PRINTED,
                                        METHODS_BENCH};
    static const char *const set[][2] = {{"restart", "0"}, {"binpaths", "16"}, {"rrthreshold", "0"}};
    struct methods m;
    struct error err = {.text = ""};
    CHECK(t, methods_read("bdpt,asbdpt:select=bins/pool,asbdpt:select=bins:restart=0/8:binpaths=4/16", &m, &err), "%s",
          err.text);
    CHECK(t, m.n == 7 && strcmp(m.item[2].text, "asbdpt:select=pool") == 0 &&
                 strcmp(m.item[4].text, "asbdpt:select=bins:restart=0:binpaths=16") == 0 &&
                 strcmp(m.item[4].file, "asbdpt-select-bins-restart-0-binpaths-16") == 0,
          "%d methods, %s, %s", m.n, m.item[2].text, m.item[4].file);
    struct settings base = {0};
    settings_set(&base, "restart", "32", "test");
    settings_set(&base, "rrthreshold", "0", "test");
    struct settings s = measured_settings(&m.item[4], &base);
    for (int i = 0; i < 3; i++) /* its own over the others' */
        CHECK(t, s.n == 4 && strcmp(settings_find(&s, set[i][0])->value, set[i][1]) == 0, "%s of %d", set[i][0], s.n);
    settings_clear(&s);
    settings_clear(&base);
    for (size_t i = 0; i < sizeof usual / sizeof usual[0]; i++)
        CHECK(t, methods_read(usual[i], &m, &err) && m.n > 0, "%s", err.text);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        CHECK(t, !methods_read(wrong[i][0], &m, &err) && strstr(err.text, wrong[i][1]) != NULL, "%s: %s", wrong[i][0],
              err.text);
    for (const struct method *const *row = method_rows; *row != NULL; row++) { /* also those of one row, without any */
        char text[64];
        snprintf(text, sizeof text, "%s:select=none", (*row)->name);
        CHECK(t, !methods_read(text, &m, &err) && strstr(err.text, "select") != NULL, "%s: %s", text, err.text);
    }
}

/* A method with services is another in each half, under one label; one without is the same in both. */
static void test_halves_of_family(struct test *t)
{
    struct methods m = {.n = 0};
    struct error err = {.text = ""};
    CHECK(t, methods_add_halves("bdpt,lvc:guide=on,ellipse", 3, &m, &err) && m.n == 5, "%d methods: %s", m.n,
          err.text);
    int with = methods_find_half(&m, "lvc:guide=on", HALF_SERVICES);
    int without = methods_find_half(&m, "lvc:guide=on", HALF_CHOICE);
    CHECK(t, with >= 0 && without >= 0 && with != without && m.item[with].halves == 2 && m.item[without].halves == 1 &&
          strcmp(m.item[with].label, m.item[without].label) == 0, "lvc is number %d with services, %d without", with,
          without);
    CHECK(t, strstr(m.item[without].text, "guide=on:emission=1:") != NULL, "what was given stays: %s",
          m.item[without].text);
    CHECK(t, methods_find_half(&m, "bdpt", HALF_CHOICE) == 0 && strcmp(m.item[0].text, "bdpt:guide=off") == 0 &&
          strcmp(m.item[3].text, "bdpt:guide=on") == 0, "%s, %s", m.item[0].text, m.item[3].text);
    CHECK(t, m.item[2].halves == 3 && methods_find_half(&m, "ellipse", HALF_SERVICES) == 2, "ellipse in both");
    CHECK(t, methods_add_halves("bdpt,lvc", 1, &m, &err) && m.n == 2, "one half: %d methods", m.n);
}

static void test_lists(struct test *t)
{
    struct plan p = {0};
    char name[64];
    struct error err = {.text = ""};
    CHECK(t, plan_set_spp(&p, 32, 100, NULL) && p.n_steps == 3 && p.spp[2] == 100,
          "the last step is what was asked for");
    CHECK(t, !plan_set_spp(&p, 1, 1L << 24, NULL), "too many steps are refused");
    CHECK(t, plan_set_methods(&p, "bdpt,asbdpt", &err) && plan_add_sweep(&p, "asbdpt,asbdpt:select=pool/bins", &err),
          "%s", err.text);
    CHECK(t, p.methods.n == 4 && p.n_compared == 2, "%d methods: what is compared is not measured twice", p.methods.n);
    plan_scene_name("a/b/veach-ajar/scene.pbrt", name, sizeof name);
    CHECK(t, strcmp(name, "veach-ajar") == 0, "name of a directory's scene: %s", name);
    plan_scene_name("scenes/bathroom.pbrt", name, sizeof name);
    CHECK(t, strcmp(name, "bathroom") == 0, "name of a file: %s", name);
}

/* What a plan leaves open is the stored reference's if that is given or large enough to be looked at; without one, or
 * where it says a width, the scene's. */
static void test_planned_scene(struct test *t)
{
    static const struct {
        int width, max_depth;
        const char *name, *given;
        int expected[3];
        bool fits; /* the stored one */
    } cases[] = {{0, 0, "bathroom", "ref", {36, 24, 10}, true}, {0, 0, "bathroom", NULL, {WIDTH_TO_SEE, 64, 10}, false},
                 {36, 3, "bathroom", NULL, {36, 24, 3}, false}, {36, 0, "bathroom", NULL, {36, 24, 10}, true},
                 {72, 0, "bathroom", NULL, {72, 48, 10}, false}, {18, 0, "bathroom", NULL, {18, 12, 10}, true},
                 {0, 0, "no-such-name", NULL, {WIDTH_WITHOUT_REFERENCE, 107, 10}, false}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct plan p = {.width = cases[i].width, .max_depth = cases[i].max_depth, .reference = cases[i].given,
                         .quiet = true};
        const int *expected = cases[i].expected;
        struct scene scene;
        struct reference stored;
        struct error err = {.text = ""};
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

static void test_stored(struct test *t)
{
    char path[300];
    float pixels[4 * 4 * 3];
    struct reference r = {0};
    struct error err = {.text = ""};
    for (int i = 0; i < 48; i++)
        pixels[i] = (float)(i / 12 * 4 + i / 3 % 4); /* row * 4 + column */
    snprintf(path, sizeof path, "%s/room.txt", test_tmp(t));
    FILE *f = fopen(path, "w");
    fputs("comment\nmaxdepth 5\nnoise8 0.5\nmean_error 0.001\n", f);
    fclose(f);
    snprintf(path, sizeof path, "%s/room.pfm", test_tmp(t));
    image_write(path, 4, 4, pixels, &err);
    CHECK(t, reference_find(test_tmp(t), "x/room.pbrt", "room", &r, &err), "%s", err.text);
    CHECK(t, strcmp(r.kind, "stored picture") == 0 && strncmp(r.origin, "stored picture: ", 16) == 0, "%s", r.origin);
    CHECK(t, !reference_fit(&r, 2, 2, 6, &err) && strstr(err.text, "maxdepth 5") != NULL,
          "another depth is refused: %s", err.text);
    CHECK(t, !reference_fit(&r, 3, 3, 5, &err) && strstr(err.text, "multiple") != NULL, "another size is refused: %s",
          err.text);
    CHECK(t, r.width == 4 && reference_fit(&r, 2, 2, 5, &err) && r.width == 2 && r.height == 2, "%s", err.text);
    CHECK(t, fabs((double)r.pixels[0] - 2.5) < 1e-6 && fabs((double)r.pixels[9] - 12.5) < 1e-6,
          "means of 2 x 2 pixels");
    CHECK(t, r.noise8 == 0.25 && r.mean_error == 0.001, "noise %g, %g", r.noise8, r.mean_error);
    CHECK(t, r.noise[SQUARE_MSE8] == 0.0625 && isnan(r.noise[SQUARE_RELMSE]) && isnan(r.noise[SQUARE_BLOCKS]),
          "what is not known of it: %g, %g", r.noise[SQUARE_RELMSE], r.noise[SQUARE_BLOCKS]);
    reference_free(&r);
    pixels[7] = NAN;
    image_write(path, 4, 4, pixels, &err);
    CHECK(t, !reference_find(path, "", "room", &r, &err) && strstr(err.text, "NaN") != NULL, "NaN is no reference");
    pixels[7] = 1;
    image_write(path, 4, 4, pixels, &err);
    snprintf(path, sizeof path, "%s/room.txt", test_tmp(t));
    f = fopen(path, "w");
    fputs("files 1 2\n", f);
    fclose(f);
    CHECK(t, !reference_find(test_tmp(t), "", "room", &r, &err) && strstr(err.text, "damaged") != NULL,
          "a picture of another hash is a reference");
    remove(path);
    snprintf(path, sizeof path, "%s/made.txt", test_tmp(t));
    f = fopen(path, "w");
    fputs("== roo\nfiles 1 2\n== room\nmaxdepth 7\n== rooms\nmaxdepth 8\n", f);
    fclose(f);
    CHECK(t, reference_find(test_tmp(t), "", "room", &r, &err) && r.max_depth == 7, "made.txt: depth %ld; %s", r.max_depth,
          err.text);
    reference_free(&r);
    CHECK(t, !reference_find("no-such-file.pfm", "", "room", &r, &err), "what was given is needed");
    CHECK(t, reference_find(NULL, "nowhere/room.pbrt", "no-such-room", &r, &err) && r.pixels == NULL, "none is found");
}

void test_plan(struct test *t)
{
    test_methods(t);
    test_halves_of_family(t);
    test_lists(t);
    test_stored(t);
    test_planned_scene(t);
}
