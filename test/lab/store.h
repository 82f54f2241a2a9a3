/* store.h: what has been measured, kept in files, so that nothing is measured twice.
 *
 * A record is a few numbers, and a picture if it is of one. It has a name, which is that of its files, and a key, which
 * says all that it depends on: a record of another key is none. Its numbers are written after its picture, with the
 * picture's checksum; so an interrupted program leaves whole records alone.
 *
 * Tests: test_equal_time.c, test_report.c.
 */
#ifndef ASBDPT_LAB_STORE_H
#define ASBDPT_LAB_STORE_H

#include <stdbool.h>

#include "base/error.h"

enum { STORE_NUMBERS = 4, STORE_NAME = 512, STORE_KEY = 1024 };

struct record {
    double number[STORE_NUMBERS]; /* finite */
    float *pixels;                /* [height*width*3] linear; owned; NULL: it is of no picture */
    int width, height;
};

/* store_read: DIRECTORY/NAME.txt, and NAME.pfm if the record has a picture. False, without a message, when there
 * is none, its key is another or it is damaged. store_write: false with a message. */
bool store_read(const char *directory, const char *name, const char *key, struct record *out);
bool store_write(const char *directory, const char *name, const char *key, const struct record *r, struct error *err);

/* store_checksum: of a picture. */
unsigned long store_checksum(const float *pixels, int width, int height);

#endif
