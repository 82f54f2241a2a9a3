/* tone.h: what is done to linear light before it becomes an 8-bit picture, on demand.
 *
 * Tests: test_hdr.c.
 */
#ifndef ASBDPT_TONE_H
#define ASBDPT_TONE_H

#include <stdbool.h>
#include <stddef.h>

enum tone_curve {
    TONE_NONE,  /* x */
    TONE_FILMIC /* toe and shoulder of film [Narkowicz 2016]: x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14) */
};

/* All zeros: light as it is. */
struct tone {
    double stops; /* the light is multiplied by 2^stops, and then goes through the curve, channel by channel */
    enum tone_curve curve;
};

/* tone_is_plain: does it leave the light as it is? */
bool tone_is_plain(const struct tone *t);

/* tone_map: from in[n] to out[n], which may be the same. Negative numbers and NaN become 0 in a curve. */
void tone_map(const struct tone *t, const float *in, size_t n, float *out);

#endif
