/* tone.h: what is done to linear light before it becomes an 8-bit picture, on demand.
 * Tests: test_hdr.c. */
#ifndef ASBDPT_TONE_H
#define ASBDPT_TONE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/maths.h"
#include "base/number.h"

enum tone_curve {
    TONE_NONE,  /* x */
    TONE_FILMIC /* toe and shoulder of film [Narkowicz 2016]: x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14) */
};

/* All zeros: light as it is. */
struct tone {
    double stops; /* the light is multiplied by 2^stops, and then goes through the curve, channel by channel */
    enum tone_curve curve;
};

static inline bool tone_is_plain(const struct tone *t) { return t->stops == 0 && t->curve == TONE_NONE; }

/* Between 0 and 1.033; beyond 1e6 it has the limit's digits. */
static inline double tone_filmic(double x)
{
    x = x > 0 ? fmin(x, 1e6) : 0;
    return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}

/* tone_map: from in[n] to out[n], which may be the same. Negative numbers and NaN become 0 in a curve. */
static inline void tone_map(const struct tone *t, const float *in, size_t n, float *out)
{
    double factor = m_pow(2, t->stops);
    for (size_t i = 0; i < n; i++) {
        double x = factor * (double)in[i];
        out[i] = float_within(t->curve == TONE_FILMIC ? tone_filmic(x) : x);
    }
}

#endif
