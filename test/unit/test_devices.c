/* test_devices.c: names that are no ordinary files (base/file.h, parser/scene_files.h). */
#define _XOPEN_SOURCE 700 /* symlink, on NetBSD */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file.h"
#include "base/mem.h"
#include "base/os.h"
#include "lab/files.h"
#include "parser/scene_files.h"
#include "suites.h"

static void check_full(struct test *t, const char *path, int size)
{
    struct error err = {.text = ""};
    struct stat info;
    float *p = mem_alloc(3 * (size_t)size * (size_t)size, sizeof *p);
    CHECK(t, !image_write(path, size, size, p, &err) && strstr(err.text, "cannot be written") != NULL, "%s: \"%s\"",
          path, err.text);
    CHECK(t, lstat(path, &info) == 0 && S_ISLNK(info.st_mode), "a link to a device is not replaced");
    free(p);
}

/* A device of some systems only, which accepts nothing. */
static void test_full(struct test *t)
{
    static const char *const NAMES[] = {"full.pfm", "full.ppm", "full.png", "full.exr"};
    for (size_t i = 0; os_kind_of("/dev/full") == OS_OTHER && i < sizeof NAMES / sizeof NAMES[0]; i++) {
        char path[256];
        snprintf(path, sizeof path, "%s/%s", test_tmp(t), NAMES[i]);
        if (!CHECK(t, symlink("/dev/full", path) == 0, "%s cannot be linked", path))
            continue;
        check_full(t, path, 2);   /* found when the buffer is flushed */
        check_full(t, path, 200); /* found before */
        remove(path);
    }
}

/* Reading never waits for ever: a pipe that nobody writes to is empty, what stands behind the end of a file is not
 * read, devices are refused. */
static void test_endless(struct test *t)
{
    char path[256];
    uint8_t *data = NULL;
    size_t size = 1;
    struct error err = {.text = ""};
    snprintf(path, sizeof path, "%s/pipe", test_tmp(t));
    alarm(20); /* who waits is ended */
    CHECK(t, mkfifo(path, 0600) == 0 && file_read(path, &data, &size, &err) && size == 0, "%s", err.text);
    alarm(0);
    free(data);
    remove(path);
    if (os_kind_of("/proc/self/status") == OS_FILE) { /* says that it is empty */
        CHECK(t, file_read("/proc/self/status", &data, &size, &err) && size == 0, "%lu bytes behind a file's end",
              (unsigned long)size);
        free(data);
    }
    if (os_kind_of("/dev/zero") == OS_OTHER)
        CHECK(t, !file_read("/dev/zero", &data, &size, &err) && strstr(err.text, "cannot be opened") != NULL,
              "/dev/zero: %s", err.text);
}

/* A text that is too large is refused by its size: no memory is taken for it. */
static void test_too_large(struct test *t)
{
    char path[256];
    size_t size;
    struct rusage before, after;
    struct error err = {.text = ""};
    snprintf(path, sizeof path, "%s/huge", test_tmp(t));
    FILE *f = fopen(path, "w");
    CHECK(t, f != NULL && ftruncate(fileno(f), (off_t)1 << 31) == 0 && fclose(f) == 0, "no file of 2 GiB of holes");
    getrusage(RUSAGE_SELF, &before);
    CHECK(t, text_read(path, &size, &err) == NULL && strstr(err.text, "larger than 2 GiB") != NULL, "%s", err.text);
    getrusage(RUSAGE_SELF, &after);
    long taken = after.ru_maxrss - before.ru_maxrss;
    CHECK(t, taken < 1 << 20, "%ld kB are taken", taken);
    remove(path);
}

/* devices: names that are no ordinary files: a device that is full, one that never ends, a pipe that nobody
 * writes to. */
void test_devices(struct test *t)
{
    test_full(t);
    test_endless(t);
    test_too_large(t);
}
