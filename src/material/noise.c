/* noise.c: see noise.h. */
#include "material/noise.h"

#include "base/maths.h"
#include "base/number.h"

/* A random permutation of 0 to 255: the table that Perlin published, so that the noise is everybody's. [Perlin 2002] */
static const unsigned char PERMUTED[256] = {
    151, 160, 137,  91,  90,  15, 131,  13, 201,  95,  96,  53, 194, 233,   7, 225, 140,  36, 103,  30,  69, 142,   8,
     99,  37, 240,  21,  10,  23, 190,   6, 148, 247, 120, 234,  75,   0,  26, 197,  62,  94, 252, 219, 203, 117,  35,
     11,  32,  57, 177,  33,  88, 237, 149,  56,  87, 174,  20, 125, 136, 171, 168,  68, 175,  74, 165,  71, 134, 139,
     48,  27, 166,  77, 146, 158, 231,  83, 111, 229, 122,  60, 211, 133, 230, 220, 105,  92,  41,  55,  46, 245,  40,
    244, 102, 143,  54,  65,  25,  63, 161,   1, 216,  80,  73, 209,  76, 132, 187, 208,  89,  18, 169, 200, 196, 135,
    130, 116, 188, 159,  86, 164, 100, 109, 198, 173, 186,   3,  64,  52, 217, 226, 250, 124, 123,   5, 202,  38, 147,
    118, 126, 255,  82,  85, 212, 207, 206,  59, 227,  47,  16,  58,  17, 182, 189,  28,  42, 223, 183, 170, 213, 119,
    248, 152,   2,  44, 154, 163,  70, 221, 153, 101, 155, 167,  43, 172,   9, 129,  22,  39, 253,  19,  98, 108, 110,
     79, 113, 224, 232, 178, 185, 112, 104, 218, 246,  97, 228, 251,  34, 242, 193, 238, 210, 144,  12, 191, 179, 162,
    241,  81,  51, 145, 235, 249,  14, 239, 107,  49, 192, 214,  31, 181, 199, 106, 157, 184,  84, 204, 176, 115, 121,
     50,  45, 127,   4, 150, 254, 138, 236, 205,  93, 222, 114,  67,  29,  24,  72, 243, 141, 128, 195,  78,  66, 215,
     61, 156, 180,
};

/* Twelve gradients, from the centre of a cube to the middles of its edges; four of them occur twice, those that pbrt-v3
 * repeats. [pbrt-v3 core/texture.cpp] */
static const signed char GRADIENT[16][3] = {{1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0}, {1, 0, 1},  {-1, 0, 1},
                                            {1, 0, -1}, {-1, 0, -1}, {0, 1, 1}, {0, -1, 1}, {0, 1, -1}, {0, -1, -1},
                                            {1, 1, 0}, {-1, 1, 0}, {0, 1, -1}, {0, -1, -1}};

/* A coordinate: its cell modulo 256, where it is in the cell, and how far it has faded over to the next lattice point.
 */
struct lattice {
    int cell;
    double offset, fade;
};

static struct lattice lattice_of(double x)
{
    double low = floor(x), t = x - low;
    return (struct lattice){int_within(low - 256 * floor(low / 256), 0, 255), t, t * t * t * (t * (6 * t - 15) + 10)};
}

double noise(vec3 p)
{
    if (!is_finite3(p))
        return 0;
    const struct lattice x = lattice_of(p.x), y = lattice_of(p.y), z = lattice_of(p.z);
    double sum = 0;
    for (int corner = 0; corner < 8; corner++) {
        int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
        int h = PERMUTED[(PERMUTED[(PERMUTED[(x.cell + i) & 255] + y.cell + j) & 255] + z.cell + k) & 255];
        const signed char *g = GRADIENT[h & 15];
        double slope = g[0] * (x.offset - i) + g[1] * (y.offset - j) + g[2] * (z.offset - k);
        sum += slope * (i ? x.fade : 1 - x.fade) * (j ? y.fade : 1 - y.fade) * (k ? z.fade : 1 - z.fade);
    }
    return sum;
}

/* The sum of octaves, of their absolute values if `folded`; *weight: that of the next one. */
static double sum_octaves(vec3 p, double omega, int octaves, bool folded, double *weight)
{
    double sum = 0, frequency = 1;
    *weight = 1;
    for (int i = 0; i < octaves; i++) {
        double octave = noise(mul(p, frequency));
        sum += *weight * (folded ? fabs(octave) : octave);
        *weight *= omega;
        frequency *= 1.99;
    }
    return sum;
}

double noise_fbm(vec3 p, double omega, int octaves)
{
    double next;
    return sum_octaves(p, omega, octaves, false, &next);
}

double noise_turbulence(vec3 p, double omega, int octaves)
{
    double next, sum = sum_octaves(p, omega, octaves, true, &next);
    return sum + next * 0.2;
}

double noise_waves(vec3 p) { return fabs(noise_fbm(mul(p, 0.1), 0.5, 3)) * noise_fbm(p, 0.5, 6); }

bool noise_in_dot(double s, double t)
{
    const double radius = 0.35, most = 0.5 - radius;
    double cs = floor(s + 0.5), ct = floor(t + 0.5);
    if (!(noise(vec(cs + 0.5, ct + 0.5, 0.5)) > 0))
        return false;
    double ds = s - (cs + most * noise(vec(cs + 1.5, ct + 2.8, 0.5)));
    double dt = t - (ct + most * noise(vec(cs + 4.5, ct + 9.8, 0.5)));
    return sqr(ds) + sqr(dt) < sqr(radius);
}

/* Six cubic Bezier curves over t in [0,1], each of four neighbours in a row of colours, times 1.5.
 * pbrt-v3's program has, since October 2019, no curve after the second and prolongs that one, up to reflectances of 40:
 * a slip in the repair of an index. This is what it did before, as the book does. */
static rgb marble_colour(double t)
{
    enum { SEGMENTS = 6 };
    static const double row[SEGMENTS + 3][3] = {{0.58, 0.58, 0.6}, {0.58, 0.58, 0.6}, {0.58, 0.58, 0.6},
                                                {0.5, 0.5, 0.5},   {0.6, 0.59, 0.58}, {0.58, 0.58, 0.6},
                                                {0.58, 0.58, 0.6}, {0.2, 0.2, 0.33},  {0.58, 0.58, 0.6}};
    int first = int_within(t * SEGMENTS, 0, SEGMENTS - 1);
    double x = t * SEGMENTS - first, y = 1 - x;
    const double weight[4] = {y * y * y, 3 * x * y * y, 3 * x * x * y, x * x * x};
    rgb sum = rgb_black();
    for (int i = 0; i < 4; i++)
        sum = rgb_add(sum, rgb_scale(rgb_make(row[first + i][0], row[first + i][1], row[first + i][2]), weight[i]));
    return rgb_scale(sum, 1.5);
}

rgb noise_marble(vec3 p, double omega, int octaves, double variation)
{
    double layer = p.y + variation * noise_fbm(p, omega, octaves);
    return isfinite(layer) ? marble_colour(0.5 + 0.5 * m_sin(layer)) : rgb_black();
}
