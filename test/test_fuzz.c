/* test_fuzz.c: replays what fuzzing has found worth keeping, test/fuzz/corpus/TARGET/FILE: every file must be taken or
 * refused, in a process of its own, by targets that test/fuzz/targets.h describes. */
#define _POSIX_C_SOURCE 200809L

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/file.h"
#include "base/os.h"
#include "fuzz/targets.h"
#include "tests.h"

/* How a process ended that ran the target: 0 if well. */
static int run_alone(const struct fuzz_target *target, const uint8_t *data, size_t size, const char *directory)
{
    int status = -1;
    fflush(stdout);
    pid_t child = fork();
    if (child == 0) {
        target->run(data, size, directory);
        _Exit(0);
    }
    return child > 0 && waitpid(child, &status, 0) == child ? status : -1;
}

static int replay(struct test *t, const struct fuzz_target *target, const char *directory)
{
    char corpus[256], path[600];
    int n = 0;
    snprintf(corpus, sizeof corpus, "test/fuzz/corpus/%s", target->name);
    DIR *d = opendir(corpus);
    for (struct dirent *e = NULL; d != NULL && (e = readdir(d)) != NULL;) {
        struct error err;
        uint8_t *data;
        size_t size;
        snprintf(path, sizeof path, "%s/%s", corpus, e->d_name);
        if (e->d_name[0] == '.' || !CHECK(t, file_read(path, &data, &size, &err), "%s", err.text))
            continue;
        int status = run_alone(target, data, size, directory);
        CHECK(t, status == 0, "%s: target %s ended with wait status %d", path, target->name, status);
        free(data);
        n++;
    }
    if (d != NULL)
        closedir(d);
    return n;
}

static void break_promise(const uint8_t *data, size_t size, const char *directory)
{
    (void)data, (void)size, (void)directory;
    abort();
}

void test_fuzz(struct test *t)
{
    static const struct fuzz_target BROKEN = {"broken", break_promise};
    CHECK(t, run_alone(&BROKEN, NULL, 0, test_tmp(t)) != 0, "a target that breaks its promise is not noticed");
    char directory[256];
    snprintf(directory, sizeof directory, "%s/fuzz", test_tmp(t));
    CHECK(t, os_make_directory(directory), "%s cannot be made", directory);
    fuzz_prepare(directory);
    for (const struct fuzz_target *target = fuzz_targets; target->name != NULL; target++)
        CHECK(t, replay(t, target, directory) > 0, "no corpus for the target %s", target->name);
}
