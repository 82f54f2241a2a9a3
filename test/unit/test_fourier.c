/* test_fourier.c: tables of layered materials against the functions from which they were made, and damaged files. That
 * what is drawn has the density that is claimed, is in test_bsdf.c.
 *
 * The table is scenes/features/layered.bsdf: it must be the bytes that are made here.
 */
#include "material/fourier.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/file.h"
#include "base/rng.h"
#include "base/warp.h"
#include "helpers.h"
#include "suites.h"

static struct bsdf_value scattered(const struct fourier_table *table, vec3 wo, vec3 wi)
{
    const struct lobe l = {.of.table = table};
    return form_fourier.eval(&l, wo, wi, true, RADIANCE);
}

static bool draw(const struct fourier_table *table, vec3 wo, const double u[3], vec3 *wi)
{
    const struct lobe l = {.of.table = table};
    return form_fourier.sample(&l, wo, vec(0, 0, 1), u, wi);
}

static const char LAYERED[] = "scenes/features/layered.bsdf";
static const double MU[] = {-1, -0.9, -0.7, -0.5, -0.3, -0.1, 0.1, 0.3, 0.5, 0.7, 0.9, 1}, ETA = 1.25;
enum { N_MU = 12, ORDERS = 3, CHANNELS = 3, COEFFICIENTS = N_MU * N_MU * ORDERS * CHANNELS };
enum { SIZE = 64 + 4 * (N_MU + 3 * N_MU * N_MU + COEFFICIENTS) };

/* Coefficient k of f for importance, of colour (0.65, 0.5, 0.2) reflected and of all alike let through: what refraction
 * does to radiance is missing. */
static double coefficient(double mu_i, double mu_o, int c, int k)
{
    static const double REFLECTED[] = {0.5, 0.65, 0.2}; /* the first is of green, below of luminance */
    double sines = sqrt((1 - mu_i * mu_i) * (1 - mu_o * mu_o)), part[] = {1, 0.5 * sines, 0.3 * sines * sines};
    double through = mu_i > 0 ? 0.2 * ETA * ETA : 0.2, colour = mu_i * mu_o < 0 ? REFLECTED[c] : through;
    return part[k] * colour * INV_PI;
}

static double closed_form(double mu_i, double mu_o, int c, double phi)
{
    double f = 0;
    for (int k = 0; k < ORDERS; k++)
        f += coefficient(mu_i, mu_o, c, k) * cos(k * phi);
    return f;
}

static uint8_t *put(uint8_t *at, uint32_t bits)
{
    bytes_of_bits(bits, at, 4, false);
    return at + 4;
}

static uint8_t *put_float(uint8_t *at, double x) { return put(at, bits_of_float((float)x)); }

/* Coefficient k as the file has it: times the cosine, and the first of three is of luminance. */
static double stored(double mu_i, double mu_o, int c, int k)
{
    double a[CHANNELS];
    for (int j = 0; j < CHANNELS; j++)
        a[j] = coefficient(mu_i, mu_o, j, k) * fabs(mu_i);
    a[0] = (a[0] + 0.100913 * a[2] + 0.297375 * a[1]) / 1.39829;
    return a[c];
}

/* What pbrt-v3 draws by: up to each cosine of wi the integral of the spline through the means over all azimuths. */
static uint8_t *put_integrals(uint8_t *at, double mu_o)
{
    double y[N_MU], slope[N_MU], sum = 0;
    for (int i = 0; i < N_MU; i++)
        y[i] = stored(MU[i], mu_o, 0, 0);
    for (int i = 0; i < N_MU; i++) {
        int before = i > 0 ? i - 1 : 0, after = i < N_MU - 1 ? i + 1 : i;
        slope[i] = (y[after] - y[before]) / (MU[after] - MU[before]);
    }
    at = put_float(at, 0);
    for (int i = 1; i < N_MU; i++) {
        double width = MU[i] - MU[i - 1];
        sum += width * ((y[i - 1] + y[i]) / 2 + width * (slope[i - 1] - slope[i]) / 12);
        at = put_float(at, sum);
    }
    return at;
}

static void make(uint8_t byte[SIZE])
{
    const uint32_t header[] = {1, N_MU, COEFFICIENTS, ORDERS, CHANNELS, 1, 0, 0, 0};
    memset(byte, 0, SIZE);
    memcpy(byte, "SCATFUN\1", 8);
    uint8_t *at = byte + 8;
    for (int i = 0; i < 9; i++)
        at = put(at, header[i]);
    at = put_float(at, ETA) + 16;
    for (int i = 0; i < N_MU; i++)
        at = put_float(at, MU[i]);
    for (int o = 0; o < N_MU; o++)
        at = put_integrals(at, MU[o]);
    for (uint32_t i = 0; i < N_MU * N_MU; i++)
        at = put(put(at, i * ORDERS * CHANNELS), ORDERS);
    for (int i = 0; i < N_MU * N_MU; i++)
        for (int c = 0; c < CHANNELS; c++)
            for (int k = 0; k < ORDERS; k++)
                at = put_float(at, stored(MU[i % N_MU], MU[i / N_MU], c, k));
}

static void file_is_made_here(struct test *t)
{
    uint8_t byte[SIZE], *file;
    size_t size;
    struct error err = {.text = ""};
    make(byte);
    if (!CHECK(t, file_read(LAYERED, &file, &size, &err), "%s", err.text))
        return;
    CHECK(t, size == SIZE && memcmp(file, byte, SIZE) == 0, "%s is not what this test makes", LAYERED);
    free(file);
}

static vec3 direction(double z, double phi) { return cylindrical(sqrt(1 - z * z), phi, z); }

static void values(struct test *t)
{
    struct fourier_table table;
    struct error err = {.text = ""};
    if (!CHECK(t, fourier_read(LAYERED, &table, &err), "%s", err.text))
        return;
    for (int n = 0; n < N_MU * N_MU * 4; n++) {
        double mu_i = MU[n % N_MU], mu_o = MU[n / N_MU % N_MU], phi = 1.3 * (n / (N_MU * N_MU));
        bool pole = fabs(mu_i) == 1 || fabs(mu_o) == 1; /* where there is no azimuth */
        double scale = mu_i * mu_o < 0 ? 1 : mu_i > 0 ? 1 / sqr(ETA) : sqr(ETA), turn = pole ? 0 : phi;
        rgb f = scattered(&table, direction(mu_o, 0.4), neg(direction(mu_i, 0.4 + phi))).f;
        double g = closed_form(mu_i, mu_o, 0, turn) * scale, r = closed_form(mu_i, mu_o, 1, turn) * scale;
        CHECK(t, fabs(f.g - g) < 1e-6 && fabs(f.r - r) < 1e-6, "at %g %g %g: %g, not %g", mu_i, mu_o, phi, f.g, g);
    }
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 71, 0);
    for (int n = 0; n < 2000; n++) {
        double mu_i = (0.35 + 0.5 * rng_uniform(&r)) * (n % 2 ? 1 : -1), mu_o = (0.35 + 0.5 * rng_uniform(&r));
        double phi = 7 * rng_uniform(&r), blue = closed_form(mu_i, mu_o, 2, phi);
        vec3 wo = direction(mu_o, 2), wi = neg(direction(mu_i, 2 + phi));
        double there = scattered(&table, wo, wi).f.b * (mu_i > 0 ? sqr(ETA) : 1);
        double back = scattered(&table, wi, wo).f.b;
        CHECK(t, fabs(there / blue - 1) < 0.03, "between: %g, not %g", there, blue);
        CHECK(t, fabs(back / blue - 1) < 0.03, "importance: %g, not %g", back, blue);
        CHECK(t, scattered(&table, wo, wi).pdf > 0.04 * fabs(wi.z) * INV_PI, "drawn everywhere");
    }
    /* A fifth of the way from one cosine to the next, that one's row is drawn from by a fifth of what is not even. */
    vec3 wo = direction(0.92, 0), last, wi;
    double u[3] = {0.9999, 0.4, 0.3};
    int same = 0;
    draw(&table, wo, u, &last);
    for (int n = 0; n < 1000; n++) {
        u[0] = 0.1 + 0.9 * (n + 0.5) / 1000;
        same += draw(&table, wo, u, &wi) && near3(wi, last, 1e-12);
    }
    CHECK(t, same > 795 && same < 805, "%d of 1000 from the row below", same);
    fourier_free(&table);
}

static bool read_bytes(struct test *t, const uint8_t *byte, size_t size, struct fourier_table *table)
{
    char path[256];
    struct error err;
    snprintf(path, sizeof path, "%s/table.bsdf", test_tmp(t));
    write_bytes(path, byte, size);
    bool ok = fourier_read(path, table, &err);
    remove(path);
    return ok;
}

/* One word of the file changed. */
static void damaged(struct test *t)
{
    static const struct {
        int at;
        uint32_t word;
        const char *what;
    } CASES[] = {{0, 0x54414353, NULL},
                 {4, 0x024e5546, "another version"},
                 {8, 3, "harmonic extrapolation"},
                 {12, 1, "one cosine"},
                 {12, 0xffffffff, "more cosines than the file has bytes"},
                 {16, COEFFICIENTS + 1, "more coefficients than there are"},
                 {16, 0xfffffff0, "absurdly many coefficients"},
                 {24, 2, "two channels"},
                 {28, 2, "two bases"},
                 {44, 0, "no index"},
                 {64, 0xbf8ccccd, "a cosine below -1"},
                 {72, 0xbf800000, "cosines that fall"},
                 {64 + 4 * (N_MU - 2), 0x3f800000, "the last cosine twice"},
                 {64 + 4 * (N_MU + N_MU * N_MU), COEFFICIENTS - 8, "a series that ends behind all coefficients"},
                 {64 + 4 * (N_MU + N_MU * N_MU), 0xffffffff, "a series that begins there"},
                 {64 + 4 * (N_MU + N_MU * N_MU) + 4, ORDERS + 1, "series that share coefficients"},
                 {SIZE - 4, 0x7fc00000, "a coefficient that is no number"}};
    uint8_t byte[SIZE];
    struct fourier_table table;
    for (size_t i = 0; i < sizeof CASES / sizeof CASES[0]; i++) {
        make(byte);
        put(byte + CASES[i].at, CASES[i].word);
        bool ok = read_bytes(t, byte, SIZE, &table);
        CHECK(t, ok == (CASES[i].what == NULL), "%s is accepted", CASES[i].what != NULL ? CASES[i].what : "nothing");
        if (ok)
            fourier_free(&table);
    }
    make(byte);
    for (size_t size = 0; size < SIZE; size += size < 80 ? 7 : 501)
        CHECK(t, !read_bytes(t, byte, size, &table), "%d bytes are accepted", (int)size);
}

/* Tables of random coefficients: negative values, black rows, and the horizon twice, as files of pbrt-v3 have it. */
static void wild(struct test *t)
{
    uint8_t byte[SIZE];
    struct rng r = rng_stream(test_seed(t), RNG_TEST, 72, 0);
    for (int n = 0; n < 20; n++) {
        struct fourier_table table;
        make(byte);
        for (int i = 0; i < COEFFICIENTS; i++)
            put_float(byte + SIZE - 4 * (i + 1), n == 0 ? 0 : (rng_uniform(&r) - 0.4) * (n == 1 ? 1e9 : 3));
        for (int i = 0; n % 3 == 2 && i < 2; i++)
            put_float(byte + 64 + 4 * (N_MU / 2 - i), 0);
        if (!CHECK(t, read_bytes(t, byte, SIZE, &table), "table %d", n))
            continue;
        for (int k = 0; k < 200; k++) {
            double u[3] = {rng_uniform(&r), rng_uniform(&r), rng_uniform(&r)};
            vec3 wo = k == 0 ? vec(0, 0, 1) : k == 1 ? vec(1, 0, 0) : warp_sphere(rng_uniform(&r), rng_uniform(&r)), wi;
            bool drawn = draw(&table, wo, u, &wi);
            CHECK(t, drawn || n == 0 || u[0] > 0.1, "nothing is drawn");
            CHECK(t, !drawn || (fabs(length(wi) - 1) < 1e-9 && scattered(&table, wo, wi).pdf > 0), "a direction");
            rgb f = drawn ? scattered(&table, wo, wi).f : rgb_black();
            CHECK(t, rgb_is_finite(f) && f.r >= 0 && f.g >= 0 && f.b >= 0, "%g %g %g", f.r, f.g, f.b);
        }
        fourier_free(&table);
    }
}

void test_fourier(struct test *t)
{
    file_is_made_here(t);
    values(t);
    damaged(t);
    wild(t);
}
