/* hostile.h: scenes that are well formed and mean harm: of every type of object and every parameter that the parser's
 * tables have, with numbers that are 0, negative, minute, immense or none at all; surfaces without area, lights without
 * light, names that refer to each other in circles, blocks that cross, thousands of the same. Bytes choose: a generator
 * of random numbers makes as many as are wanted, and a fuzzer finds its way. */
#ifndef ASBDPT_FUZZ_HOSTILE_H
#define ASBDPT_FUZZ_HOSTILE_H

#include <stddef.h>
#include <stdint.h>

/* hostile_scene: a scene of these bytes; when they are used up it ends.
 *   length  out: of the text, without the zero byte that ends it
 * To be given to free(). At most 4 MB. */
char *hostile_scene(const uint8_t *bytes, size_t n, size_t *length);

/* hostile_number: a number that no scene should have, the i-th in a circle, as it is written. */
const char *hostile_number(unsigned i);

#endif
