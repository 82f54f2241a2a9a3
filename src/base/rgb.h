/* rgb.h: a colour or any three-channel quantity, linear, with the primaries of sRGB.
 *
 * Radiance in W/(sr m^2), power in W, reflectance dimensionless: the name of the variable says which.
 * A type of its own, though its operations look like those of vec3: a compiler then tells light from directions. */
#ifndef ASBDPT_RGB_H
#define ASBDPT_RGB_H

#include <math.h>
#include <stdbool.h>

typedef struct {
    double r, g, b;
} rgb;

static inline rgb rgb_make(double r, double g, double b) { return (rgb){r, g, b}; }
static inline rgb rgb_grey(double v) { return rgb_make(v, v, v); }
static inline rgb rgb_black(void) { return rgb_grey(0); }
static inline rgb rgb_add(rgb a, rgb b) { return rgb_make(a.r + b.r, a.g + b.g, a.b + b.b); }
static inline rgb rgb_sub(rgb a, rgb b) { return rgb_make(a.r - b.r, a.g - b.g, a.b - b.b); }
static inline rgb rgb_mul(rgb a, rgb b) { return rgb_make(a.r * b.r, a.g * b.g, a.b * b.b); }
static inline rgb rgb_scale(rgb a, double s) { return rgb_make(a.r * s, a.g * s, a.b * s); }
static inline bool rgb_is_black(rgb a) { return a.r == 0 && a.g == 0 && a.b == 0; }
static inline bool rgb_is_finite(rgb a) { return isfinite(a.r) && isfinite(a.g) && isfinite(a.b); }
static inline double rgb_max(rgb a) { return fmax(a.r, fmax(a.g, a.b)); }
static inline rgb rgb_abs(rgb a) { return rgb_make(fabs(a.r), fabs(a.g), fabs(a.b)); }
static inline double rgb_mean(rgb a) { return (a.r + a.g + a.b) / 3; }

/* rgb_luminance: the Y of CIE XYZ for sRGB primaries (Rec. 709 weights). */
static inline double rgb_luminance(rgb a) { return 0.212671 * a.r + 0.715160 * a.g + 0.072169 * a.b; }

/* rgb_worth: by what light is drawn: as luminance, but components below 0 are worth as much as those above. The light of
 * narrow spectra has such, and a wall may leave nothing else of it. */
static inline double rgb_worth(rgb a) { return rgb_luminance(rgb_abs(a)); }

#endif
