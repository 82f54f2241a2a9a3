/* libfuzzer.c: the targets as libFuzzer calls them. The environment says which: TARGET=png build-fuzz/fuzz CORPUS.
 * Files of the target are in /dev/shm, which is no disk, where there is one. */
#define _POSIX_C_SOURCE 200809L
#define _DARWIN_C_SOURCE /* mkdtemp, on macOS */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "targets.h"

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static const struct fuzz_target *target;
static char directory[64];

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argc, (void)argv;
    const char *name = getenv("TARGET");
    target = name != NULL ? fuzz_find(name) : NULL;
    snprintf(directory, sizeof directory, "%s/asbdpt-fuzz-XXXXXX", access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp");
    if (target == NULL || mkdtemp(directory) == NULL) {
        fprintf(stderr, target == NULL ? "set TARGET to one of test/fuzz/targets.c\n" : "no temporary directory\n");
        exit(2);
    }
    fuzz_prepare(directory);
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    target->run(data, size, directory);
    return 0;
}
