/* targets.h: what is fuzzed: one function per reader of something that others may have written.
 *
 * A target takes any bytes. It may refuse them with a message; it must return soon, with all memory released, and what
 * it accepts must be fit for what the program does next: pictures are written and read again, scenes are rendered.
 *
 *     make fuzz                           builds build-fuzz/fuzz, by clang with libFuzzer
 *     sh test/fuzz/run.sh 60 png scene    60 seconds of each of these targets; without names, of all
 *     build/test fuzz                     replays test/fuzz/corpus.txt (in make test and make san)
 *
 * What fuzzing finds becomes a line of the corpus, or a fixture of the reader's own test.
 */
#ifndef ASBDPT_FUZZ_TARGETS_H
#define ASBDPT_FUZZ_TARGETS_H

#include <stddef.h>
#include <stdint.h>

struct fuzz_target {
    const char *name;
    /* `directory` is a place for files of the target. Ends the program by abort() where a promise is broken. */
    void (*run)(const uint8_t *data, size_t size, const char *directory);
};

/* All targets, ended by one without a name. fuzz_find: one by name, or NULL. */
extern const struct fuzz_target fuzz_targets[];
const struct fuzz_target *fuzz_find(const char *name);

/* fuzz_prepare: put into the directory what scenes may name: test/data/fixtures/parts. */
void fuzz_prepare(const char *directory);

#endif
