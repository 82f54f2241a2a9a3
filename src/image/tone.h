/* tone.h: what is done to linear light before it becomes an 8-bit picture, on demand.
 * Tests: test_hdr.c. */
#ifndef ASBDPT_TONE_H
#define ASBDPT_TONE_H

#include <stdbool.h>
#include <stddef.h>

/* Their names as --tonemap has them, ended by NULL. */
enum tone_curve { TONE_NONE, TONE_FILMIC };
extern const char *const TONE_NAMES[];

/* All zeros: light as it is. */
struct tone {
    double stops; /* the light is multiplied by 2^stops, and then goes through the curve, channel by channel */
    enum tone_curve curve;
};

static inline bool tone_is_plain(const struct tone *t) { return t->stops == 0 && t->curve == TONE_NONE; }

/* tone_map: from in[n] to out[n], which may be the same. Negative numbers and NaN become 0 in a curve. */
void tone_map(const struct tone *t, const float *in, size_t n, float *out);

#endif
