/* lists.h: many small files in one list, NAME.txt. A line "== NAME" begins each of them; a "!" behind the name leaves
 * out its last newline. Below "== NAME packed" bytes are plain characters or a backslash and three octal digits, as
 * printf reads them; ends of lines are none of them. What is above the first such line is for readers.
 * scenes/unpack.sh makes the files in a script. Tests: test_parser.c, test_hdr.c, test_hostile.c read such lists. */
#ifndef ASBDPT_FUZZ_LISTS_H
#define ASBDPT_FUZZ_LISTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"

struct list_file {
    char name[64];
    const char *text; /* as it stands in the list; not ended by a zero */
    size_t size;
    bool packed;
};

/* list_next: the next file of a list in memory; *at goes on behind it. False after the last. */
bool list_next(const char **at, struct list_file *out);

/* list_bytes: what packed text says, into out, which has room for `size`; returns how many bytes. */
size_t list_bytes(const char *text, size_t size, uint8_t *out);

/* list_unpack: make a directory that has the files of all lists of the folder `from`, and links to its other files, or
 * copies where none can be made. Returns false with a message. */
bool list_unpack(const char *from, const char *to, struct error *err);

#endif
