/* tone.c: see tone.h. */
#include "image/tone.h"

#include "base/maths.h"
#include "base/number.h"

const char *const TONE_NAMES[] = {"none", "filmic", NULL};

/* Toe and shoulder of film [Narkowicz 2016]: between 0 and 1.033; beyond 1e6 it has the limit's digits. */
static double filmic(double x)
{
    x = x > 0 ? fmin(x, 1e6) : 0;
    return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}

void tone_map(const struct tone *t, const float *in, size_t n, float *out)
{
    double factor = m_pow(2, t->stops);
    for (size_t i = 0; i < n; i++) {
        double x = factor * (double)in[i];
        out[i] = float_within(t->curve == TONE_FILMIC ? filmic(x) : x);
    }
}
