/* test_fuzz.c: inputs that fuzzing found worth keeping: each must be read, or refused, as its list states. Every line
 * of test/fuzz/corpus.txt is an input. Targets, which test/fuzz/targets.h describes, end the process where they
 * do not: each has one of its own. */
#define _POSIX_C_SOURCE 200809L
#define _DARWIN_C_SOURCE /* mkdtemp, on macOS */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/mem.h"
#include "fuzz/lists.h"
#include "fuzz/targets.h"
#include "helpers.h"
#include "suites.h"

/* The inputs of a target, packed: a line each. */
struct corpus {
    char *all;
    struct list_file part;
    int n;
};

static struct corpus read_corpus(struct test *t, const char *target)
{
    struct corpus c = {.all = text_of(t, "test/fuzz", "corpus.txt")};
    const char *at = c.all;
    while (list_next(&at, &c.part) && strcmp(c.part.name, target) != 0)
        ;
    for (size_t i = 0; strcmp(c.part.name, target) == 0 && i < c.part.size; i++)
        c.n += c.part.text[i] == '\n';
    return c;
}

/* Line k, packed as lists.h says. To be given to free(). */
static uint8_t *unpack(const struct corpus *c, int k, size_t *size)
{
    const char *p = c->part.text;
    for (; k > 0; k -= *p++ == '\n')
        ;
    size_t length = strcspn(p, "\n");
    uint8_t *out = mem_alloc(length + 1, 1);
    *size = list_bytes(p, length, out);
    return out;
}

static void run_input(const struct fuzz_target *target, const struct corpus *c, int k, const char *directory)
{
    size_t size;
    uint8_t *data = unpack(c, k, &size), *exact = mem_alloc(size, 1); /* a memory checker sees what is read beyond */
    memcpy(exact, data, size);
    target->run(exact, size, directory);
    free(exact);
    free(data);
}

/* How a process ends that runs the target on inputs first .. end - 1: 0 if well. */
static int run_alone(const struct fuzz_target *target, const struct corpus *c, int first, int end,
                     const char *directory)
{
    int status = -1;
    fflush(stdout);
    pid_t child = fork();
    if (child == 0) {
        for (int i = first; i < end; i++)
            run_input(target, c, i, directory);
        _Exit(0);
    }
    return child > 0 && waitpid(child, &status, 0) == child ? status : -1;
}

/* All of them in one process, or, if that does not end well, each in its own. */
static void replay(struct test *t, const struct fuzz_target *target, const char *directory)
{
    struct corpus c = read_corpus(t, target->name);
    bool ok = CHECK(t, c.n > 0, "%s: no inputs", target->name) &&
              CHECK(t, run_alone(target, &c, 0, c.n, directory) == 0, "target %s breaks a promise", target->name);
    for (int i = 0; !ok && i < c.n; i++)
        CHECK(t, run_alone(target, &c, i, i + 1, directory) == 0, "%s: input of line %d", target->name, i + 1);
    free(c.all);
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
    struct corpus c = read_corpus(t, "png");
    CHECK(t, run_alone(&BROKEN, &c, 0, 1, test_tmp(t)) != 0, "a target that breaks its promise is not noticed");
    free(c.all);
    /* Hundreds of pictures are written: in memory, where that can be had. */
    snprintf(directory, sizeof directory, "%s/fuzz-XXXXXX", access("/dev/shm", W_OK) == 0 ? "/dev/shm" : test_tmp(t));
    if (!CHECK(t, mkdtemp(directory) != NULL, "%s cannot be made", directory))
        return;
    fuzz_prepare(directory);
    for (const struct fuzz_target *target = fuzz_targets; target->name != NULL; target++)
        replay(t, target, directory);
    CHECK(t, remove_tree(directory), "%s is left behind", directory);
}
