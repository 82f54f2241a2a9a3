/* sky.c: the sky of scenes/sky.pbrt, written to scenes/sky/: a blue gradient, a bright region round the sun, the
 * ground. */
#include <math.h>

#include "model.h"

static void colour(const double d[3], double out[3])
{
    static const double sun[3] = {-0.707, 0.530, -0.468}; /* to the left, behind the camera */
    static const double zenith[3] = {0.12, 0.26, 0.62}, horizon[3] = {0.58, 0.66, 0.76}, ground[3] = {0.20, 0.18, 0.15};
    static const double warm[3] = {1.0, 0.88, 0.68};
    double c = d[0] * sun[0] + d[1] * sun[1] + d[2] * sun[2], angle = acos(c > 1 ? 1 : c < -1 ? -1 : c) * 360 / TAU;
    mix3(horizon, zenith, pow(d[1] > 0 ? d[1] : 0, 0.5), out);
    mix3(out, ground, smooth(0.0, -0.08, d[1]), out);
    double glow = 58 * exp(-angle * angle / (2 * 4.5 * 4.5)) + 0.6 * exp(-angle / 14);
    for (int i = 0; i < 3; i++) out[i] += glow * warm[i];
}

int main(void)
{
    sky_write("sky/sky.pfm", 64, 32, colour);
    return 0;
}
