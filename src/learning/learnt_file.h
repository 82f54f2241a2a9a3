/* learnt_file.h: what has been learnt, as bytes: kept in checkpoints, or as a file that the parts of a picture share.
 *
 *     asbdpt learnt 2          a line
 *     of 0123456789abcdef      another: what picture it is for, by a number of the caller's
 *     numbers                  eight bytes each, the lowest first: whole numbers as they are, others as IEEE 754 bits
 *     check                    CRC-32 of all before, four bytes
 *
 * What is read back is what was written to the last bit, so a render by it has the same bytes. Bytes from elsewhere are
 * checked: none makes a table that would be read beyond its end.
 *
 * Tests: test_learning.c.
 */
#ifndef ASBDPT_LEARNT_FILE_H
#define ASBDPT_LEARNT_FILE_H

#include "base/error.h"
#include "learning/learnt.h"

/* learnt_write: into `out`, empty before. */
void learnt_write(const struct learnt *l, uint64_t of, struct bytes *out);

/* learnt_read: from bytes into l, zero-initialised; learnt_free releases it either way. False with a message "NAME:
 * ..." if they are not what learnt_write wrote for `of`, or for lights of another number. */
bool learnt_read(struct learnt *l, const struct light_set *lights, uint64_t of, const struct bytes *in,
                 const char *name, struct error *err);

#endif
