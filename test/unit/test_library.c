/* test_library.c: the library's header: wrong order is refused, a text is a scene, calls add up to one render, two
 * renders in two threads and one that is cancelled give the bytes of each alone, and paths add up to the picture. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/os.h"
#include "helpers.h"
#include "library/asbdpt.h"
#include "suites.h"

enum { SIZE = 16, VALUES = 3 * SIZE * SIZE };
static const char SCENE[] = "scenes/cornell-box.pbrt";

/* An open render, with a box filter and one thread; open_with: of 16 pixels a side. */
static asbdpt *open_sized(struct test *t, const char *size, const char *scene, const char *integrator, const char *seed)
{
    asbdpt *r = asbdpt_new();
    bool ok = asbdpt_set(r, "--res", size) == 0 && asbdpt_set(r, "--filter", "box") == 0 &&
              asbdpt_set(r, "--nthreads", "1") == 0 && asbdpt_set(r, "--seed", seed) == 0 &&
              asbdpt_set(r, "--integrator", integrator) == 0 && asbdpt_open(r, scene) == 0;
    CHECK(t, ok, "%s", asbdpt_message(r));
    return r;
}
static asbdpt *open_with(struct test *t, const char *scene, const char *integrator, const char *seed)
{
    return open_sized(t, "16x16", scene, integrator, seed);
}

static void picture(struct test *t, asbdpt *r, float out[VALUES])
{
    CHECK(t, asbdpt_read(r, out) == 0, "%s", asbdpt_message(r));
}

/* --- order and messages ------------------------------------------------------------------------------- */

#define REFUSED(CALL, WORDS) \
    CHECK(t, (CALL) == 1 && strstr(asbdpt_message(r), WORDS) != NULL, "%s: \"%s\"", #CALL, asbdpt_message(r))

static void test_order(struct test *t)
{
    asbdpt *r = asbdpt_new();
    float pixels[VALUES];
    int width, height;
    CHECK(t, strcmp(asbdpt_message(r), "") == 0 && strcmp(asbdpt_warnings(r), "") == 0, "something is said at first");
    REFUSED(asbdpt_render(r, 1, NULL, NULL, NULL), "no scene yet");
    REFUSED(asbdpt_read(r, pixels), "no scene yet");
    REFUSED(asbdpt_size(r, &width, &height), "no scene yet");
    REFUSED(asbdpt_save(r, "x.pfm"), "no scene yet");
    REFUSED(asbdpt_observe(r, NULL, NULL), "no scene yet");
    CHECK(t, asbdpt_statistics(r) == NULL && asbdpt_samples(r) == -1, "there is something without a scene");
    REFUSED(asbdpt_set(r, "--spq", "4"), "did you mean \"--spp\"");
    REFUSED(asbdpt_set(r, "--spp", "0"), "from 1");
    REFUSED(asbdpt_set(r, "--spp", NULL), "needs a value");
    REFUSED(asbdpt_set(r, "4", NULL), "no option");
    REFUSED(asbdpt_open(r, "-"), "standard input");
    REFUSED(asbdpt_open(r, "none.pbrt"), "none.pbrt: cannot open");
    CHECK(t, asbdpt_set(r, "--res", "16x16") == 0 && asbdpt_open(r, SCENE) == 0, "%s", asbdpt_message(r));
    REFUSED(asbdpt_open(r, SCENE), "a scene already");
    REFUSED(asbdpt_set(r, "--spp", "4"), "a scene already");
    REFUSED(asbdpt_render(r, -1, NULL, NULL, NULL), "-1 samples");
    REFUSED(asbdpt_save(r, "x.gif"), ".pfm");
    REFUSED(asbdpt_save(r, "-"), "standard output");
    REFUSED(asbdpt_save(r, SCENE), "the scene is read from this file");
    REFUSED(asbdpt_load_checkpoint(r, SCENE), SCENE);
    REFUSED(asbdpt_error(r, pixels), "asbdpt_keep_error");
    CHECK(t, asbdpt_statistics(r) != NULL, "statistics before the first sample");
    CHECK(t, asbdpt_render(r, 1, NULL, NULL, NULL) == 0 && asbdpt_samples(r) == 1, "%s", asbdpt_message(r));
    REFUSED(asbdpt_keep_error(r), "samples already");
    REFUSED(asbdpt_load_checkpoint(r, "x.part"), "samples already");
    asbdpt_free(r);
    asbdpt_free(NULL);
}

static int open_text(asbdpt *r, const char *name, const char *text)
{
    return asbdpt_open_text(r, name, text, strlen(text));
}

static void test_text(struct test *t)
{
    static const char ROOM[] = "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 16\nWorldBegin\n"
                               "LightSource \"infinite\"\nWorldEnd\n";
    asbdpt *r = asbdpt_new();
    float pixels[VALUES];
    REFUSED(open_text(r, "a text", "WorldBegin\n  Foo 1\nShape \"sphre\"\nWorldEnd\n"), "a text:2:3: unknown directive Foo");
    CHECK(t, strstr(asbdpt_message(r), "\na text:3:7: ") != NULL, "the second error: %s", asbdpt_message(r));
    REFUSED(asbdpt_open_text(r, "short", ROOM, 20), "short:1:");
    REFUSED(asbdpt_open_text(r, "none", NULL, 0), "WorldBegin"); /* an empty text, not a file */
    REFUSED(open_text(r, "scenes/none/a", "Include \"b.pbrt\"\n"), "scenes/none/b.pbrt: cannot open");
    CHECK(t, open_text(r, "a text", ROOM) == 0, "%s", asbdpt_message(r));
    CHECK(t, asbdpt_render(r, 2, NULL, NULL, NULL) == 0, "%s", asbdpt_message(r));
    picture(t, r, pixels);
    CHECK(t, pixels[0] == 1 && pixels[VALUES - 1] == 1, "a sky of 1 is %g", (double)pixels[0]);
    asbdpt_free(r);
    r = asbdpt_new();
    char *name = text_of(t, "scenes", "cornell-box.pbrt"); /* it names files beside it */
    CHECK(t, asbdpt_set(r, "--res", "16x16") == 0 && open_text(r, "scenes/x.pbrt", name) == 0, "%s", asbdpt_message(r));
    free(name);
    asbdpt_free(r);
}

/* --- one render in many calls ------------------------------------------------------------------------- */

/* Renders n samples at once into `out`. */
static void render_whole(struct test *t, const char *integrator, const char *seed, long n, float out[VALUES])
{
    asbdpt *r = open_with(t, SCENE, integrator, seed);
    CHECK(t, asbdpt_render(r, n, NULL, NULL, NULL) == 0, "%s", asbdpt_message(r));
    picture(t, r, out);
    asbdpt_free(r);
}

static void test_calls(struct test *t)
{
    static const char *const METHODS[] = {"pt", "lt", "bdpt", "asbdpt"};
    for (int i = 0; i < 4; i++) {
        float whole[VALUES], parts[VALUES];
        asbdpt *r = open_with(t, SCENE, METHODS[i], "1");
        render_whole(t, METHODS[i], "1", 9, whole);
        for (long n = 1; n <= 5; n += 2)
            CHECK(t, asbdpt_render(r, n, NULL, NULL, NULL) == 0, "%s", asbdpt_message(r));
        picture(t, r, parts);
        CHECK(t, asbdpt_samples(r) == 9 && memcmp(whole, parts, sizeof whole) == 0, "%s: 1, 3 and 5 samples are not 9",
              METHODS[i]);
        CHECK(t, strstr(asbdpt_statistics(r), "\"spp_done\": 9,") != NULL, "%s", asbdpt_statistics(r));
        asbdpt_free(r);
    }
}

/* A block without an end is all of --spp: the first call renders it, and no other can add to it. */
static void test_endless(struct test *t)
{
    float whole[VALUES], pixels[VALUES];
    asbdpt *r[2];
    for (int i = 0; i < 2; i++) {
        r[i] = asbdpt_new();
        CHECK(t, asbdpt_set(r[i], "--res", "16x16") == 0 && asbdpt_set(r[i], "--spp", "6") == 0 &&
              asbdpt_set(r[i], "--integrator", "asbdpt") == 0 && asbdpt_set(r[i], "-P", "select=bins") == 0 &&
              asbdpt_set(r[i], "-P", "restart=0") == 0 && asbdpt_open(r[i], SCENE) == 0, "%s", asbdpt_message(r[i]));
        CHECK(t, asbdpt_render(r[i], i, NULL, NULL, NULL) == 0 && asbdpt_samples(r[i]) == 6, "%g samples of 6; %s",
              asbdpt_samples(r[i]), asbdpt_message(r[i]));
    }
    picture(t, r[0], whole);
    picture(t, r[1], pixels);
    CHECK(t, memcmp(whole, pixels, sizeof whole) == 0, "restart=0: one sample and all of --spp are two pictures");
    CHECK(t, asbdpt_render(r[1], 1, NULL, NULL, NULL) == 1 && strstr(asbdpt_message(r[1]), "one block") != NULL, "%s",
          asbdpt_message(r[1]));
    asbdpt_free(r[0]);
    asbdpt_free(r[1]);
}

static void test_error(struct test *t)
{
    float whole[VALUES], error[VALUES];
    double square = 0;
    asbdpt *r = open_with(t, "scenes/sky.pbrt", "pt", "1");
    CHECK(t, asbdpt_keep_error(r) == 0 && asbdpt_render(r, 32, NULL, NULL, NULL) == 0, "%s", asbdpt_message(r));
    REFUSED(asbdpt_error(r, error), "every 64 samples, not at 32");
    CHECK(t, asbdpt_render(r, 32, NULL, NULL, NULL) == 0 && asbdpt_error(r, error) == 0, "%s", asbdpt_message(r));
    picture(t, r, whole);
    for (int i = 0; i < VALUES; i++)
        square += sqr((double)error[i] / (double)whole[i]) / VALUES;
    CHECK(t, square > 1e-5 && square < 0.1, "relative variance %g", square);
    char path[256];
    snprintf(path, sizeof path, "%s/e.part", test_tmp(t));
    CHECK(t, asbdpt_save_checkpoint(r, path) == 0, "%s", asbdpt_message(r));
    asbdpt_free(r);
    r = open_with(t, "scenes/sky.pbrt", "pt", "1");
    CHECK(t, asbdpt_keep_error(r) == 0 && asbdpt_load_checkpoint(r, path) == 0, "%s", asbdpt_message(r));
    REFUSED(asbdpt_error(r, error), "once asbdpt_render was called");
    asbdpt_free(r);
    remove(path);
}

/* The product of a size and a fraction is a float, as in pbrt: as a double it would be a little more than 55. */
static void test_crop(struct test *t)
{
    asbdpt *r = asbdpt_new();
    int width, height;
    CHECK(t, asbdpt_set(r, "--res", "100x10") == 0 && asbdpt_set(r, "--cropwindow", "0,0.55,0,1") == 0 &&
          asbdpt_open(r, SCENE) == 0 && asbdpt_size(r, &width, &height) == 0 && width == 55 && height == 10,
          "%dx%d pixels; %s", width, height, asbdpt_message(r));
    asbdpt_free(r);
}

/* What is refused changes nothing. */
static void test_refused(struct test *t)
{
    static const char DARK[] = "Film \"image\" \"integer xresolution\" 500 \"integer yresolution\" 500\nWorldBegin\n"
                               "WorldEnd\n";
    float whole[VALUES], pixels[VALUES];
    asbdpt *r = asbdpt_new();
    CHECK(t, asbdpt_set(r, "--seed", "1") == 0 && asbdpt_set(r, "--integrator", "bdpt") == 0 &&
          asbdpt_set(r, "--res", "16x16") == 0, "%s", asbdpt_message(r));
    REFUSED(asbdpt_set(r, "--seed", "12x"), "whole number");
    REFUSED(asbdpt_set(r, "--integrator", ""), "empty");
    REFUSED(asbdpt_set(r, "--integrator", NULL), "needs a value");
    CHECK(t, asbdpt_open(r, SCENE) == 0 && asbdpt_render(r, 1, NULL, NULL, NULL) == 0, "%s", asbdpt_message(r));
    render_whole(t, "bdpt", "1", 1, whole);
    picture(t, r, pixels);
    CHECK(t, memcmp(whole, pixels, sizeof whole) == 0, "a refused option has changed the picture");
    asbdpt_free(r);
    r = asbdpt_new();
    CHECK(t, asbdpt_set(r, "--max-memory", ".05") == 0 && open_text(r, "dark", DARK) == 0, "%s", asbdpt_message(r));
    REFUSED(asbdpt_keep_error(r), "memory");
    CHECK(t, asbdpt_render(r, 100, NULL, NULL, NULL) == 0 && asbdpt_render(r, 0, NULL, NULL, NULL) == 0 &&
          asbdpt_samples(r) == 100, "%g samples of 100", asbdpt_samples(r));
    asbdpt_free(r);
}

/* --- threads, cancelling, checkpoints ------------------------------------------------------------------ */

struct pair {
    asbdpt *render[2];
    int status[2];
};

static void render_one(void *context, int thread)
{
    struct pair *p = context;
    p->status[thread] = asbdpt_render(p->render[thread], 8, NULL, NULL, NULL);
}

static void test_two(struct test *t)
{
    struct pair p = {{open_with(t, SCENE, "asbdpt", "1"), open_with(t, SCENE, "bdpt", "2")}, {1, 1}};
    float alone[2][VALUES], pixels[VALUES];
    render_whole(t, "asbdpt", "1", 8, alone[0]);
    render_whole(t, "bdpt", "2", 8, alone[1]);
    os_run_threads(2, render_one, &p);
    for (int i = 0; i < 2; i++) {
        CHECK(t, p.status[i] == 0, "%s", asbdpt_message(p.render[i]));
        picture(t, p.render[i], pixels);
        CHECK(t, memcmp(alone[i], pixels, sizeof pixels) == 0, "render %d is another beside another", i);
        asbdpt_free(p.render[i]);
    }
}

struct cancelled {
    asbdpt *render;
    struct os_lock *lock;
    int heard, answer, status;
};

static void hear(void *context, double learnt, double done)
{
    struct cancelled *c = context;
    (void)learnt;
    os_lock_take(c->lock);
    c->heard += done > 0;
    os_lock_wake_all(c->lock);
    os_lock_leave(c->lock);
}

static int answer(void *context)
{
    struct cancelled *c = context;
    os_lock_take(c->lock);
    int said = c->answer;
    os_lock_leave(c->lock);
    return said;
}

/* Thread 0 renders; thread 1 waits for two tile passes, and cancels. */
static void render_and_cancel(void *context, int thread)
{
    struct cancelled *c = context;
    if (thread == 0) {
        c->status = asbdpt_render(c->render, 100000, hear, answer, c);
        return;
    }
    os_lock_take(c->lock);
    while (c->heard < 2)
        os_lock_wait(c->lock);
    c->answer = ASBDPT_STOP;
    os_lock_leave(c->lock);
}

static void test_cancel(struct test *t)
{
    struct cancelled c = {.render = open_with(t, SCENE, "bdpt", "1"), .lock = os_lock_new(), .status = 1};
    char path[256];
    float whole[VALUES], pixels[VALUES];
    snprintf(path, sizeof path, "%s/c.part", test_tmp(t));
    os_run_threads(2, render_and_cancel, &c);
    double n = asbdpt_samples(c.render);
    CHECK(t, c.status == 0 && n > 0 && n < 100000, "%g samples; %s", n, asbdpt_message(c.render));
    CHECK(t, asbdpt_save_checkpoint(c.render, path) == 0, "%s", asbdpt_message(c.render));
    asbdpt *again = open_with(t, SCENE, "bdpt", "1");
    long more = 64 + (long)n, end;
    CHECK(t, asbdpt_load_checkpoint(again, path) == 0 && asbdpt_samples(again) == n, "%g samples of %g; %s",
          asbdpt_samples(again), n, asbdpt_message(again));
    CHECK(t, asbdpt_render(again, more, NULL, NULL, NULL) == 0, "%s", asbdpt_message(again));
    end = (long)asbdpt_samples(again);
    render_whole(t, "bdpt", "1", end, whole);
    picture(t, again, pixels);
    CHECK(t, memcmp(whole, pixels, sizeof whole) == 0, "what was cancelled and loaded is another at %ld samples", end);
    asbdpt_free(again);
    asbdpt_free(c.render);
    os_lock_free(c.lock);
    remove(path);
}

static int stop(void *context) { return (void)context, ASBDPT_STOP; }

/* Samples by what was learnt in haste and by all of it are not mixed. */
static void test_haste(struct test *t)
{
    char good[256], bad[256];
    snprintf(good, sizeof good, "%s/good.part", test_tmp(t));
    snprintf(bad, sizeof bad, "%s/bad.part", test_tmp(t));
    asbdpt *r = open_with(t, SCENE, "asbdpt", "1");
    CHECK(t, asbdpt_render(r, 8, NULL, NULL, NULL) == 0 && asbdpt_save(r, good) == 0, "%s", asbdpt_message(r));
    asbdpt_free(r);
    r = open_with(t, SCENE, "asbdpt", "1");
    CHECK(t, asbdpt_render(r, 8, NULL, stop, NULL) == 0 && asbdpt_samples(r) == 0, "%g samples", asbdpt_samples(r));
    REFUSED(asbdpt_load_checkpoint(r, good), "open both again");
    CHECK(t, asbdpt_render(r, 8, NULL, NULL, NULL) == 0 && asbdpt_samples(r) == 8, "%s", asbdpt_message(r));
    REFUSED(asbdpt_save(r, bad), "learning was cut short");
    CHECK(t, asbdpt_save_checkpoint(r, bad) == 0, "%s", asbdpt_message(r));
    asbdpt_free(r);
    r = open_with(t, SCENE, "asbdpt", "1");
    CHECK(t, asbdpt_load_checkpoint(r, bad) == 0 && asbdpt_samples(r) == 0, "%g samples", asbdpt_samples(r));
    asbdpt_free(r);
    r = open_with(t, SCENE, "asbdpt", "1");
    CHECK(t, asbdpt_load_checkpoint(r, good) == 0 && asbdpt_render(r, 0, NULL, stop, NULL) == 0 &&
          asbdpt_samples(r) == 8, "%g samples of 8", asbdpt_samples(r));
    REFUSED(asbdpt_render(r, 0, NULL, NULL, NULL), "open both again");
    REFUSED(asbdpt_render(r, 8, NULL, NULL, NULL), "open both again");
    asbdpt_free(r);
    remove(good);
    remove(bad);
}

/* --- paths -------------------------------------------------------------------------------------------- */

struct told {
    double sum[VALUES];
    long n, wrong;
};

static void take(void *context, const struct asbdpt_path *p)
{
    struct told *told = context;
    int x = p->t == 1 ? (int)p->px : p->x, y = p->t == 1 ? (int)p->py : p->y;
    told->n++;
    told->wrong += p->n != p->s + p->t || !(p->weight >= 0 && p->weight <= 1) || p->vertex[p->n - 1].kind != ASBDPT_LENS;
    told->wrong += p->s > 0 && p->vertex[0].kind != ASBDPT_LIGHT;
    for (int c = 0; c < 3 && x >= 0 && x < SIZE && y >= 0 && y < SIZE; c++)
        told->sum[3 * (SIZE * y + x) + c] += p->value[c] * p->weight;
}

static void count_pass(void *context, double learnt, double done)
{
    int *passes = context;
    (void)learnt;
    *passes += done > 0;
}
static int stop_after_pass(void *context)
{
    const int *passes = context;
    return *passes > 0 ? ASBDPT_STOP : ASBDPT_CONTINUE;
}

/* A block of which one tile of four is there ends where it was to end, though less is asked for then. */
static void test_block(struct test *t)
{
    enum { N = 3 * 32 * 32 };
    float whole[N], pixels[N];
    asbdpt *r = open_sized(t, "32x32", SCENE, "bdpt", "1"), *other = open_sized(t, "32x32", SCENE, "bdpt", "1");
    int passes = 0;
    CHECK(t, asbdpt_render(r, 1000, count_pass, stop_after_pass, &passes) == 0, "%s", asbdpt_message(r));
    double part = asbdpt_samples(r);
    CHECK(t, asbdpt_render(r, 1, NULL, NULL, NULL) == 0, "%s", asbdpt_message(r));
    long n = (long)asbdpt_samples(r);
    CHECK(t, part > 0 && part < (double)n && n < 1000 && (double)n == asbdpt_samples(r), "%g, then %ld samples", part, n);
    CHECK(t, asbdpt_render(other, n, NULL, NULL, NULL) == 0, "%s", asbdpt_message(other));
    CHECK(t, asbdpt_read(r, pixels) == 0 && asbdpt_read(other, whole) == 0 &&
          memcmp(whole, pixels, sizeof whole) == 0, "the picture of %ld samples is another after a cut", n);
    asbdpt_free(r);
    asbdpt_free(other);
}

static void test_paths(struct test *t)
{
    static const char *const METHODS[] = {"pt", "lt", "bdpt", "asbdpt"};
    for (int i = 0; i < 4; i++) {
        asbdpt *r = open_with(t, SCENE, METHODS[i], "3");
        struct told told = {.n = 0};
        float pixels[VALUES], same[VALUES];
        CHECK(t, asbdpt_observe(r, take, &told) == 0 && asbdpt_render(r, 4, NULL, NULL, NULL) == 0, "%s",
              asbdpt_message(r));
        picture(t, r, pixels);
        render_whole(t, METHODS[i], "3", 4, same);
        CHECK(t, memcmp(pixels, same, sizeof same) == 0, "%s: looking on changes the picture", METHODS[i]);
        CHECK(t, told.n > 100 && told.wrong == 0, "%s: of %ld paths %ld are wrong", METHODS[i], told.n, told.wrong);
        for (int k = 0; k < VALUES; k++)
            if (fabs(told.sum[k] / 4 - (double)pixels[k]) > 1e-5 * (1 + fabs((double)pixels[k]))) {
                CHECK(t, false, "%s: value %d is %g, its paths add up to %g", METHODS[i], k, (double)pixels[k],
                      told.sum[k] / 4);
                break;
            }
        asbdpt_free(r);
    }
}

static void test_parameters(struct test *t)
{
    struct asbdpt_parameter p;
    int n = 0, methods = 0;
    bool found = false;
    for (; asbdpt_parameter(n, &p); n++) {
        methods += p.name == NULL;
        found |= p.name != NULL && strcmp(p.method, "asbdpt") == 0 && strcmp(p.name, "maxdepth") == 0 &&
                 strcmp(p.fallback, "5") == 0;
    }
    CHECK(t, n > 20 && methods > 4 && found && !asbdpt_parameter(n + 1, &p), "%d parameters of %d methods", n, methods);
}

void test_library(struct test *t)
{
    test_order(t);
    test_text(t);
    test_calls(t);
    test_endless(t);
    test_error(t);
    test_two(t);
    test_cancel(t);
    test_haste(t);
    test_refused(t);
    test_crop(t);
    test_block(t);
    test_paths(t);
    test_parameters(t);
}
