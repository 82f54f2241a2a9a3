/* text.h: a text made of pieces, in memory of a fixed size.
 *
 * Tests: test/run/lab.sh.
 */
#ifndef ASBDPT_LAB_TEXT_H
#define ASBDPT_LAB_TEXT_H

#include <stdbool.h>
#include <stddef.h>

/* text_add: write behind the end of a text, printf style. size: of its memory, in bytes. False if it does not fit: then
 * as much is there as fits, and it ends with 0. */
bool text_add(char *text, size_t size, const char *format, ...);

#endif
