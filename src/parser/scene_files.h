/* scene_files.h: the files that a scene names: where they are, which may be read, and how often.
 *
 * A scene is data from somebody else, and so are the names in it. Only regular files are read: a pipe may never end,
 * reading a device may do something, and standard input belongs to the user. A few bytes can name a
 * large file many times: what has been read before, under whatever name, counts.
 * Tests: test_parser.c, test_hostile.c. */
#ifndef ASBDPT_SCENE_FILES_H
#define ASBDPT_SCENE_FILES_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "image/picture.h"
#include "parser/symbols.h"

/* Of files, and pictures as they are in memory, that have been read before a scene may read MAX_READ_AGAIN bytes, or
 * READ_AGAIN_PER_BYTE for each byte that it has read for the first time. What its pictures take in memory beyond
 * PICTURE_BYTES_PER_BYTE is at most MAX_UNPACKED for all together. */
enum { MAX_READ_AGAIN = 1 << 26, READ_AGAIN_PER_BYTE = 8, MAX_UNPACKED = 3 << 26 };

struct scene_files {
    const char *scene_path; /* the main file: relative names start in its directory */
    uint64_t *content;      /* where the hashes of all files are combined */
    struct symbols paths;   /* of the files that were named so far */
    struct symbols known;   /* hashes of those that were read, as texts */
    uint64_t first, again;  /* bytes read for the first time and again */
    uint64_t unpacked;      /* bytes of images beyond what the size of their files allows */
    bool full;              /* it was too much: nothing more is read */
};

/* text_read: a whole file as a zero-terminated text, to be given to free(); NULL with a message (path and reason).
 *   size  out: bytes without the zero */
char *text_read(const char *path, size_t *size, struct error *err);

/* scene_files_path: where a file of this name is, to be given to free(); NULL with a message if there is something
 * that is no regular file, or once there was too much. Backslashes, as in names from Windows, are slashes if no file
 * has the very name. */
char *scene_files_path(struct scene_files *f, const char *name, struct error *err);

/* scene_files_read: text_read, counted. scene_files_count: a file of that hash_content and size has been read.
 * scene_files_picture: a picture, for which `tables` bytes more have been made. NULL, or false, with a message where
 * that is too much. */
char *scene_files_read(struct scene_files *f, const char *path, size_t *size, struct error *err);
bool scene_files_count(struct scene_files *f, uint64_t content, uint64_t size, struct error *err);
bool scene_files_picture(struct scene_files *f, const struct image *img, uint64_t tables, struct error *err);

#endif
