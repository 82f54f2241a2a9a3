/* main.c: the test runner: build/test [-l] [--slow] [--seed N] [--scenes FIRST:END] [NAME...]
 * or build/test --scene N, which prints random scene N; --evil N prints it with numbers that no scene should have.
 * Exit status 0 only if every check and every hypothesis came out as it must. The last line is
 * "N passed, N failed". */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/os.h"
#include "base/stats.h"
#include "helpers.h"
#include "random_scene.h"
#include "tests.h"

static const double SUITE_ALPHA = 0.001;

struct entry {
    const char *name;
    void (*run)(struct test *t);
    bool slow; /* only with --slow or by name */
};

static const struct entry ENTRIES[] = {
    {"maths", test_maths, false},     {"vec", test_vec, false},
    {"warp", test_warp, false},     {"stats", test_stats, false},
    {"alias", test_alias, false},     {"zlib", test_zlib, false},     {"image", test_image, false},
    {"hdr", test_hdr, false},
    {"sheet", test_sheet, false},
    {"file", test_file, false},       {"ply", test_ply, false},
    {"features", test_features, false}, {"format", test_format, false},
    {"shape", test_shape, false},     {"subdivide", test_subdivide, false},
    {"kdtree", test_kdtree, false}, {"texture", test_texture, false},
    {"lobe", test_lobe, false},       {"bsdf", test_bsdf, false},       {"material", test_material, false},
    {"light", test_light, false},   {"camera", test_camera, false},
    {"film", test_film, false},       {"parser", test_parser, false}, {"sampler", test_sampler, false},
    {"mis", test_mis, false}, {"pairs", test_pairs, false}, {"learning", test_learning, false},
    {"options", test_options, false}, {"render", test_render, false}, {"asbdpt", test_asbdpt, false},
    {"part", test_part, false}, {"trace", test_trace, false},
    {"report", test_report, false}, {"pictures", test_pictures, false},
    {"aov", test_aov, false},
#if !defined _WIN32 && !defined __wasi__ /* which have no fork, and no devices among the files */
    {"devices", test_devices, false}, {"fuzz", test_fuzz, false}, {"hostile", test_hostile, true},
#endif
    {"threads", test_threads, false}, {"verify", test_verify, false},
    {"strategies", test_strategies, false}, {"streams", test_streams, false},
    {"scenes", test_scenes, false},   {"reference", test_references, false},
    {"random", test_random, false}, {"random-long", test_random_long, true},
    {"scenes-long", test_scenes_long, true}, {"reference-long", test_references_long, true},
};
enum { N_ENTRIES = sizeof ENTRIES / sizeof ENTRIES[0] };

struct hypothesis {
    double p;
    bool must_hold;
    int entry;
    char text[256];
};

struct test {
    uint64_t seed;
    uint64_t first_scene, end_scene; /* of random scenes; both 0: each test's own */
    char tmp[128];
    int entry;               /* index of the running test */
    int failures[N_ENTRIES]; /* failed checks and hypotheses per test */
    int checks;
    struct hypothesis *hypothesis; /* [n] */
    size_t n, capacity;
};

bool test_check(struct test *t, const char *file, int line, bool ok, const char *format, ...)
{
    t->checks++;
    if (ok)
        return true;
    t->failures[t->entry]++;
    va_list args;
    va_start(args, format);
    printf("  FAIL %s:%d: ", file, line);
    vprintf(format, args);
    printf("\n       repeat with: build/test --seed %llu %s\n", (unsigned long long)t->seed, ENTRIES[t->entry].name);
    va_end(args);
    return false;
}

void test_hypothesis(struct test *t, const char *file, int line, bool must_hold, double p, const char *format, ...)
{
    t->hypothesis = mem_grow(t->hypothesis, &t->capacity, t->n + 1, sizeof *t->hypothesis);
    struct hypothesis *h = &t->hypothesis[t->n++];
    h->p = p;
    h->must_hold = must_hold;
    h->entry = t->entry;
    int used = snprintf(h->text, sizeof h->text, "%s:%d: ", file, line);
    va_list args;
    va_start(args, format);
    if (used > 0 && (size_t)used < sizeof h->text)
        vsnprintf(h->text + used, sizeof h->text - (size_t)used, format, args);
    va_end(args);
}

uint64_t test_seed(const struct test *t) { return t->seed; }
const char *test_tmp(const struct test *t) { return t->tmp; }

bool test_range(const struct test *t, uint64_t *first, uint64_t *end)
{
    if (t->end_scene <= t->first_scene)
        return false;
    *first = t->first_scene;
    *end = t->end_scene;
    return true;
}

/* Judge all p-values together. NaN counts as a failure either way. */
static void judge(struct test *t)
{
    if (t->n == 0)
        return;
    double level = stats_sidak(SUITE_ALPHA, 1 / (double)t->n);
    double smallest = 1;
    for (size_t i = 0; i < t->n; i++) {
        const struct hypothesis *h = &t->hypothesis[i];
        bool ok = h->must_hold ? h->p >= level : h->p < level;
        if (h->must_hold && h->p < smallest)
            smallest = h->p;
        if (ok)
            continue;
        t->failures[h->entry]++;
        printf("  FAIL %s\n       p = %.3g, must be %s %.3g\n       repeat with: build/test --seed %llu %s\n", h->text,
               h->p, h->must_hold ? ">=" : "<", level, (unsigned long long)t->seed, ENTRIES[h->entry].name);
    }
    printf("%lu hypotheses at suite level %g: each at %.3g; smallest p of a true one %.3g\n", (unsigned long)t->n,
           SUITE_ALPHA, level, smallest);
}

static bool selected(const struct entry *e, int n_names, char **names, bool slow)
{
    for (int i = 0; i < n_names; i++)
        if (strcmp(names[i], e->name) == 0)
            return true;
    return n_names == 0 && (slow || !e->slow);
}

static bool known(const char *name)
{
    for (int i = 0; i < N_ENTRIES; i++)
        if (strcmp(ENTRIES[i].name, name) == 0)
            return true;
    return false;
}

int main(int argc, char **argv)
{
    struct test t = {0};
    t.seed = 1;
    bool slow = false;
    int first = 1;
    for (; first < argc && argv[first][0] == '-'; first++) {
        if (strcmp(argv[first], "-l") == 0) {
            for (int i = 0; i < N_ENTRIES; i++)
                printf("%s%s\n", ENTRIES[i].name, ENTRIES[i].slow ? " (slow)" : "");
            return 0;
        } else if (strcmp(argv[first], "--slow") == 0) {
            slow = true;
        } else if (strcmp(argv[first], "--seed") == 0 && first + 1 < argc) {
            t.seed = strtoull(argv[++first], NULL, 10);
        } else if (strcmp(argv[first], "--scenes") == 0 && first + 1 < argc) {
            char *end;
            t.first_scene = strtoull(argv[++first], &end, 10);
            t.end_scene = *end == ':' ? strtoull(end + 1, NULL, 10) : t.first_scene + 1;
        } else if ((strcmp(argv[first], "--scene") == 0 || strcmp(argv[first], "--evil") == 0) && first + 1 < argc) {
            bool evil = strcmp(argv[first++], "--evil") == 0;
            struct random_scene scene = random_scene(strtoull(argv[first], NULL, 10), "", evil);
            fputs(scene.text, stdout);
            free(scene.text);
            return 0;
        } else {
            fprintf(stderr, "usage: build/test [-l] [--slow] [--seed N] [--scenes FIRST:END] [NAME...]\n"
                            "       build/test --scene N | --evil N\n");
            return 2;
        }
    }
    for (int i = first; i < argc; i++)
        if (!known(argv[i])) {
            fprintf(stderr, "build/test: no test named %s; -l lists them\n", argv[i]);
            return 2;
        }
    const char *tmp = getenv("TMPDIR");
    int length = snprintf(t.tmp, sizeof t.tmp, "%s/asbdpt-test-%016llx", tmp != NULL ? tmp : "/tmp",
                          (unsigned long long)os_unique());
    if (length >= (int)sizeof t.tmp || os_kind_of(t.tmp) != OS_NOTHING || !os_make_directory(t.tmp)) {
        fprintf(stderr, "build/test: cannot make a temporary directory %s\n", t.tmp);
        return 1;
    }
    bool ran[N_ENTRIES] = {false};
    for (int i = 0; i < N_ENTRIES; i++) {
        if (!selected(&ENTRIES[i], argc - first, argv + first, slow))
            continue;
        t.entry = i;
        ran[i] = true;
        double start = os_wall_seconds();
        ENTRIES[i].run(&t);
        printf("%-10s %6.2f s\n", ENTRIES[i].name, os_wall_seconds() - start);
        fflush(stdout);
    }
    judge(&t);
    int passed = 0, failed = 0;
    for (int i = 0; i < N_ENTRIES; i++) {
        passed += ran[i] && t.failures[i] == 0;
        failed += ran[i] && t.failures[i] != 0;
    }
    free(t.hypothesis);
    if (!remove_tree(t.tmp))
        fprintf(stderr, "build/test: could not remove %s\n", t.tmp);
    printf("%d checks\n%d passed, %d failed\n", t.checks, passed, failed);
    return failed == 0 ? 0 : 1;
}
