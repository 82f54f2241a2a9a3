/* file.h: whole files in, whole files out, and their names.
 *
 * Reading takes a file into memory at once, so that a format's parser knows the file's length before it believes
 * any size written in it. Writing goes to a temporary file in the target's directory. That takes the target's name
 * only when every byte is on the disk: a full disk or an interrupted run leaves the old file, never half a new one. A
 * symbolic link to a file is replaced, not followed. The name - is standard input or output.
 * Tests: test_file.c. */
#ifndef ASBDPT_FILE_H
#define ASBDPT_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "base/error.h"

/* file_read: the content of a file.
 *   data, size  out; data to be given to free(), NULL on failure; a zero byte follows the last that size counts
 * A file is as long as the system says, whatever can be read behind that; pipes are read to their end, up to 256 MiB.
 * Returns false with a message "PATH: ..." when the file is missing, a directory, a device or unreadable; errno then
 * says why, 0 for a file that is too long. */
bool file_read(const char *path, uint8_t **data, size_t *size, struct error *err);

/* file_exists: is there anything of this name? file_has_extension: does a path end in this extension (lower case, with
 * its dot), in whatever case? */
bool file_exists(const char *path);
bool file_has_extension(const char *path, const char *extension);

/* file_beside: where a file is that another one names, to be given to free(): a relative name starts in the directory
 * of `path`; never "-", which only the user may mean. */
char *file_beside(const char *path, const char *name);

/* A file being written. */
struct file_output {
    FILE *stream;    /* where to write, binary; write errors stick to it and are found by file_commit */
    char *path;      /* as it was given; owned */
    char *temporary; /* what is really written, or NULL where the target is a device, a pipe or -; owned */
};

/* file_create: begin to write `path`. Returns false with a message when that is impossible, for want of a directory or
 * of rights; *out is then empty. After success exactly one of the others must follow.
 * file_commit: flush, wait for the disk, check, close, rename. Returns false with a message, leaving no file behind,
 * when any write since file_create has failed. Standard output then has no error any more: nobody reports it again.
 * file_abandon: close and remove what was written. */
bool file_create(const char *path, struct file_output *out, struct error *err);
bool file_commit(struct file_output *out, struct error *err);
void file_abandon(struct file_output *out);

/* How much memory the files of a job may take. It is asked before anything is allocated whose size a file says. */
struct budget {
    double limit, taken; /* bytes */
    const char *advice;  /* for messages: how to raise the limit */
};

/* budget_new: of so many bytes; 0: of three quarters of the machine's memory, or of 4 GB where nobody knows that. */
struct budget budget_new(double limit, const char *advice);

/* budget_has: are so many bytes left? budget_take: take them. False with a message of how many were asked for. */
bool budget_has(const struct budget *b, double bytes, struct error *err);
bool budget_take(struct budget *b, double bytes, struct error *err);

#endif
