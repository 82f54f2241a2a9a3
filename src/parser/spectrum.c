/* spectrum.c: see spectrum.h. */
#include "parser/spectrum.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/maths.h"
#include "base/mem.h"

/* The range of the CIE tables, nm, in steps of 1 nm. */
enum { FIRST_NM = 360, LAST_NM = 830 };

/* One lobe: a Gaussian around `mean` with a standard deviation of its own on either side, nm. */
static double lobe(double nm, double height, double mean, double below, double above)
{
    double t = (nm - mean) / (nm < mean ? below : above);
    return height * m_exp(-0.5 * t * t);
}

static double match_x(double nm)
{
    return lobe(nm, 1.056, 599.8, 37.9, 31.0) + lobe(nm, 0.362, 442.0, 16.0, 26.7) +
           lobe(nm, -0.065, 501.1, 20.4, 26.2);
}

static double match_y(double nm) { return lobe(nm, 0.821, 568.8, 46.9, 40.5) + lobe(nm, 0.286, 530.9, 16.3, 31.1); }
static double match_z(double nm) { return lobe(nm, 1.217, 437.0, 11.8, 36.0) + lobe(nm, 0.681, 459.0, 26.0, 13.8); }

rgb spectrum_from_xyz(double x, double y, double z)
{
    return rgb_make(3.240479 * x - 1.537150 * y - 0.498535 * z, -0.969256 * x + 1.875991 * y + 0.041556 * z,
                    0.055648 * x - 0.204043 * y + 1.057311 * z);
}

/* The integral of a spectrum against the matching functions, over that of y. */
struct integral {
    double x, y, z, white;
};

static void integrate(struct integral *sum, double nm, double value)
{
    double y = match_y(nm);
    sum->x += value * match_x(nm);
    sum->y += value * y;
    sum->z += value * match_z(nm);
    sum->white += y;
}

static rgb integral_rgb(const struct integral *sum)
{
    return spectrum_from_xyz(sum->x / sum->white, sum->y / sum->white, sum->z / sum->white);
}

/* Samples of one wavelength are put in the order of their values, so that there is only one order. */
static int by_wavelength(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return x[0] != y[0] ? (x[0] > y[0]) - (x[0] < y[0]) : (x[1] > y[1]) - (x[1] < y[1]);
}

/* What is in order stays: two values for one wavelength are a step, up or down. [pbrt-v3 core/spectrum.cpp] */
static void sort_samples(double (*sample)[2], int n)
{
    int i = 1;
    while (i < n && sample[i - 1][0] <= sample[i][0])
        i++;
    if (i < n)
        qsort(sample, (size_t)n, sizeof *sample, by_wavelength);
}

rgb spectrum_from_samples(double (*sample)[2], int n)
{
    sort_samples(sample, n);
    struct integral sum = {0, 0, 0, 0};
    int next = 0; /* first sample beyond nm */
    for (int nm = FIRST_NM; nm <= LAST_NM; nm++) {
        while (next < n && sample[next][0] <= nm)
            next++;
        double value;
        if (next == 0) {
            value = sample[0][1];
        } else if (next == n) {
            value = sample[n - 1][1];
        } else {
            const double *a = sample[next - 1], *b = sample[next];
            value = a[1] + (b[1] - a[1]) * (nm - a[0]) / (b[0] - a[0]);
        }
        integrate(&sum, nm, value);
    }
    return integral_rgb(&sum);
}

/* Planck's law up to a constant factor: with x = h c / (lambda k T) it is x^5 / (e^x - 1) for a given T.
 * [PBRT3 12.1.1] */
static double planck(double x) { return x < 700 ? x * x * x * x * x / m_expm1(x) : 0; }

rgb spectrum_blackbody(double kelvin, double scale)
{
    if (!(kelvin > 0))
        return rgb_black();
    const double hc_over_k = 1.438777e7;   /* nm K */
    const double peak = 4.965114231744276; /* x where planck() is largest: Wien's displacement law */
    struct integral sum = {0, 0, 0, 0};
    for (int nm = FIRST_NM; nm <= LAST_NM; nm++)
        integrate(&sum, nm, scale * planck(hc_over_k / (nm * kelvin)) / planck(peak));
    return integral_rgb(&sum);
}

/* --- files of spectra ----------------------------------------------------------------------------------------- */

double *spd_numbers(struct messages *m, struct source_file *file, struct source_position *at, size_t *n)
{
    static const char OF_NUMBERS[] = "0123456789.+-eE";
    double *number = NULL;
    const char *line = file->text, *warned = NULL;
    int n_lines = 0;
    *at = (struct source_position){file, 1, 1};
    *n = 0;
    for (const char *c = line; c < file->end; c++) {
        char token[64], *end = token;
        size_t length = *c == 'e' || *c == 'E' ? 0 : strspn(c, OF_NUMBERS);
        struct source_position here = {file, n_lines + 1, (int)(c - line) + 1};
        snprintf(token, sizeof token, "%.*s", length < 63 ? (int)length : 63, c);
        double value = strtod(token, &end);
        if (end > token) {
            number = mem_append(number, *n, sizeof *number);
            number[(*n)++] = value;
            *at = here;
            c += length - 1;
        } else if (*c == '#') {
            c += strcspn(c, "\r\n") - 1;
        } else if (*c == '\n' || (*c == '\r' && c[1] != '\n')) {
            n_lines++;
            line = c + 1;
        } else if (strchr(" \t\r,;:", *c) == NULL && warned != line) {
            source_warn(m, here, "this text of a spectrum file is passed over, as in pbrt-v3: it should hold "
                        "pairs of numbers, wavelength in nm and value");
            warned = line;
        }
    }
    return number;
}
