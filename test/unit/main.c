/* main.c: the test runner:
 *   build/test [-l] [--slow] [--once | --first] [--show] [--seed N] [--scenes FIRST:END] [--classes N | NAME...]
 *   build/test --scene N    prints random scene N; --evil N: with numbers that no scene should have
 *   build/test --structure N   prints random scene N of those for efficiency; --class N: class N of paths
 * --once: doubtful hypotheses fail at once; --first: they do, and the first failure is the end. --show: every p is
 * printed. --classes N: the suite `classes`, of N classes of paths, as --scenes 0:N classes.
 * Exit status 0 only if every check and every hypothesis came out as it must. The last line is
 * "N passed, N failed". */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/os.h"
#include "helpers.h"
#include "random_class.h"
#include "random_scene.h"
#include "random_structure.h"
#include "suites.h"

static const struct test_entry ENTRIES[] = {SUITES};
enum { N_ENTRIES = sizeof ENTRIES / sizeof ENTRIES[0] };

static bool selected(const struct test_entry *e, int n_names, char **names, bool slow)
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
    char tmp[128];
    struct test_setting setting = {.seed = 1, .tmp = tmp, .out = stdout};
    bool slow = false, of_classes = false;
    char classes[] = "classes", *only = classes;
    const char *last = NULL; /* line, for somebody who wants to know that the program has come to its end */
    int first = 1;
    for (; first < argc && argv[first][0] == '-'; first++) {
        if (strcmp(argv[first], "-l") == 0) {
            for (int i = 0; i < N_ENTRIES; i++)
                printf("%-17s%s%s\n", ENTRIES[i].name, ENTRIES[i].slow ? "(slow) " : "", ENTRIES[i].what);
            return 0;
        } else if (strcmp(argv[first], "--slow") == 0) {
            slow = true;
        } else if (strcmp(argv[first], "--once") == 0) {
            setting.once = true;
        } else if (strcmp(argv[first], "--first") == 0) {
            setting.once = setting.first = true;
        } else if (strcmp(argv[first], "--show") == 0) {
            setting.show = true;
        } else if (strcmp(argv[first], "--last") == 0 && first + 1 < argc) {
            last = argv[++first];
        } else if (strcmp(argv[first], "--seed") == 0 && first + 1 < argc) {
            setting.seed = strtoull(argv[++first], NULL, 10);
        } else if (strcmp(argv[first], "--scenes") == 0 && first + 1 < argc) {
            char *end;
            setting.first_scene = strtoull(argv[++first], &end, 10);
            setting.end_scene = *end == ':' ? strtoull(end + 1, NULL, 10) : setting.first_scene + 1;
        } else if ((strcmp(argv[first], "--scene") == 0 || strcmp(argv[first], "--evil") == 0) && first + 1 < argc) {
            bool evil = strcmp(argv[first++], "--evil") == 0;
            struct random_scene scene = random_scene(strtoull(argv[first], NULL, 10), "", evil);
            fputs(scene.text, stdout);
            free(scene.text);
            return 0;
        } else if (strcmp(argv[first], "--structure") == 0 && first + 1 < argc) {
            const char *kind;
            char *text = random_structure(strtoull(argv[first + 1], NULL, 10), &kind);
            fputs(text, stdout);
            free(text);
            return 0;
        } else if (strcmp(argv[first], "--class") == 0 && first + 1 < argc) {
            struct random_class c = random_class(strtoull(argv[first + 1], NULL, 10), 0);
            fputs(c.text, stdout);
            free(c.text);
            return 0;
        } else if (strcmp(argv[first], "--classes") == 0 && first + 1 < argc) {
            setting.end_scene = strtoull(argv[++first], NULL, 10);
            of_classes = true;
        } else {
            fprintf(stderr, "usage: build/test [-l] [--slow] [--once | --first] [--show] [--seed N]"
                            " [--scenes FIRST:END] [--last LINE] [--classes N | NAME...]\n"
                            "       build/test --scene N | --evil N | --structure N | --class N\n");
            return 2;
        }
    }
    char **names = of_classes ? &only : argv + first;
    int n_names = of_classes ? 1 : argc - first;
    for (int i = 0; i < n_names; i++)
        if (!known(names[i])) {
            fprintf(stderr, "build/test: no test named %s; -l lists them\n", names[i]);
            return 2;
        }
    struct test_entry chosen[N_ENTRIES];
    int n = 0;
    for (int i = 0; i < N_ENTRIES; i++)
        if (selected(&ENTRIES[i], n_names, names, slow))
            chosen[n++] = ENTRIES[i];
    const char *where = getenv("TMPDIR");
    int length = snprintf(tmp, sizeof tmp, "%s/asbdpt-test-%016llx", where != NULL ? where : "/tmp",
                          (unsigned long long)os_unique());
    if (length >= (int)sizeof tmp || os_kind_of(tmp) != OS_NOTHING || !os_make_directory(tmp)) {
        fprintf(stderr, "build/test: cannot make a temporary directory %s\n", tmp);
        return 1;
    }
    int failed = test_run(chosen, n, &setting);
    if (!remove_tree(tmp))
        fprintf(stderr, "build/test: could not remove %s\n", tmp);
    if (last != NULL)
        puts(last);
    return failed == 0 ? 0 : 1;
}
