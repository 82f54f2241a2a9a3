/* test_fuzz.c: replays what fuzzing has found worth keeping, test/fuzz/corpus/TARGET/FILE: every file must be taken or
 * refused. Targets, which test/fuzz/targets.h describes, end the process where they do not: each has one of its own. */
#define _POSIX_C_SOURCE 200809L
#define _DARWIN_C_SOURCE /* mkdtemp, on macOS */

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/file.h"
#include "base/mem.h"
#include "fuzz/targets.h"
#include "helpers.h"
#include "tests.h"

enum { MAX_FILES = 500 };

/* The files of a target. */
struct corpus {
    char path[MAX_FILES][160];
    int n;
};

static void list_corpus(const char *target, struct corpus *out)
{
    char directory[128];
    snprintf(directory, sizeof directory, "test/fuzz/corpus/%s", target);
    DIR *d = opendir(directory);
    out->n = 0;
    for (struct dirent *e = NULL; d != NULL && out->n < MAX_FILES && (e = readdir(d)) != NULL;)
        if (e->d_name[0] != '.' && strlen(e->d_name) < 80)
            snprintf(out->path[out->n++], sizeof out->path[0], "%.70s/%.80s", directory, e->d_name);
    if (d != NULL)
        closedir(d);
}

static void run_file(const struct fuzz_target *target, const char *path, const char *directory)
{
    struct error err;
    uint8_t *data;
    size_t size;
    if (!file_read(path, &data, &size, &err))
        abort();
    uint8_t *exact = mem_alloc(size, 1); /* no byte more: a memory checker sees what is read beyond */
    memcpy(exact, data, size);
    target->run(exact, size, directory);
    free(exact);
    free(data);
}

/* How a process ends that runs the target on files first .. end - 1: 0 if well. */
static int run_alone(const struct fuzz_target *target, const struct corpus *c, int first, int end,
                     const char *directory)
{
    int status = -1;
    fflush(stdout);
    pid_t child = fork();
    if (child == 0) {
        for (int i = first; i < end; i++)
            run_file(target, c->path[i], directory);
        _Exit(0);
    }
    return child > 0 && waitpid(child, &status, 0) == child ? status : -1;
}

/* All of them in one process, or, if that does not end well, each in its own. */
static void replay(struct test *t, const struct fuzz_target *target, const char *directory)
{
    struct corpus *c = mem_alloc(1, sizeof *c);
    list_corpus(target->name, c);
    bool ok = CHECK(t, c->n > 0 && c->n < MAX_FILES, "%s: %d files", target->name, c->n) &&
              CHECK(t, run_alone(target, c, 0, c->n, directory) == 0, "target %s breaks a promise", target->name);
    for (int i = 0; !ok && i < c->n; i++)
        CHECK(t, run_alone(target, c, i, i + 1, directory) == 0, "%s", c->path[i]);
    free(c);
}

static void break_promise(const uint8_t *data, size_t size, const char *directory)
{
    (void)data, (void)size, (void)directory;
    abort();
}

void test_fuzz(struct test *t)
{
    static const struct fuzz_target BROKEN = {"png", break_promise};
    char directory[256];
    struct corpus *c = mem_alloc(1, sizeof *c);
    list_corpus("png", c);
    CHECK(t, run_alone(&BROKEN, c, 0, 1, test_tmp(t)) != 0, "a target that breaks its promise is not noticed");
    free(c);
    /* Hundreds of pictures are written: in memory, where that can be had. */
    snprintf(directory, sizeof directory, "%s/fuzz-XXXXXX", access("/dev/shm", W_OK) == 0 ? "/dev/shm" : test_tmp(t));
    if (!CHECK(t, mkdtemp(directory) != NULL, "%s cannot be made", directory))
        return;
    fuzz_prepare(directory);
    for (const struct fuzz_target *target = fuzz_targets; target->name != NULL; target++)
        replay(t, target, directory);
    CHECK(t, remove_tree(directory), "%s is left behind", directory);
}
