/* scene_files.h: the files that a scene names: where they are, which may be read, and how often.
 *
 * A scene is data from somebody else, and so are the names in it. Only regular files are read: a pipe may never end,
 * reading a device may do something, and standard input belongs to the user. A few bytes can name a
 * large file many times, under whatever name.
 * Tests: test_parser.c, test_hostile.c. */
#ifndef ASBDPT_SCENE_FILES_H
#define ASBDPT_SCENE_FILES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/file.h"
#include "base/error.h"
#include "parser/symbols.h"

struct scene_files {
    const char *scene_path; /* the main file: relative names start in its directory */
    uint64_t *content;      /* where the hashes of all files are combined */
    struct symbols paths;   /* of the files that were named so far */
    struct budget *memory;  /* of all that the scene takes */
};

/* text_read: a whole file as a zero-terminated text, to be given to free(); NULL with a message (path and reason).
 *   size  out: bytes without the zero */
char *text_read(const char *path, size_t *size, struct error *err);

/* scene_files_path: where a file of this name is, to be given to free(); NULL with a message if there is something
 * that is no regular file, or is too large. Backslashes, as in names from Windows, are slashes if no file has the very
 * name. */
char *scene_files_path(struct scene_files *f, const char *name, struct error *err);

/* scene_files_read: text_read, counted. scene_files_copy: the same of a text in memory. scene_files_count: a file of that hash_content has been read, and so many bytes
 * have been taken. Whatever is read counts as if it stayed: where a file is read again and again, that ends. NULL, or
 * false, with a message where that is too much. */
char *scene_files_read(struct scene_files *f, const char *path, size_t *size, struct error *err);
char *scene_files_copy(struct scene_files *f, const char *path, const char *given, size_t size, struct error *err);
bool scene_files_count(struct scene_files *f, uint64_t content, double bytes, struct error *err);

#endif
