/* fourier.c: see fourier.h. */
#include "material/fourier.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/alias.h"
#include "base/file.h"
#include "base/maths.h"
#include "base/mem.h"
#include "base/number.h"
#include "base/warp.h"

/* Tables of more cosines, or longer series, than anybody makes: looking them up could take any time. */
enum { MOST_COSINES = 4096, MOST_COEFFICIENTS = 4096, HEADER = 64 };

/* This share of all samples is drawn from no table, so that every direction is. */
static const double EVEN = 0.1;

/* --- look-up ----------------------------------------------------------------------------------------- */

/* A series in cos(phi) at once for all channels, by the recurrence of Chebyshev's polynomials. */
static void series(const struct fourier_table *t, int o, int i, double cos_phi, double sum[3])
{
    size_t pair = (size_t)(o * t->n_mu + i), m = t->length[pair];
    const double *a = t->a + t->first[pair];
    double before = cos_phi, cos_k = 1;
    sum[0] = sum[1] = sum[2] = 0;
    for (size_t k = 0; k < m; k++) {
        for (size_t c = 0; c < (size_t)t->channels; c++)
            sum[c] += a[c * m + k] * cos_k;
        double next = 2 * cos_phi * cos_k - before;
        before = cos_k;
        cos_k = next;
    }
}

/* The interval that a cosine is in, never one without width, or -1, and where in it. */
static int interval(const struct fourier_table *t, double mu, double *where)
{
    mu = clamp(mu, -1, 1);
    if (!(mu >= t->mu[0] && mu <= t->mu[t->n_mu - 1]))
        return -1;
    int low = cumulative_find(t->mu, t->n_mu - 1, mu);
    *where = (mu - t->mu[low]) / (t->mu[low + 1] - t->mu[low]);
    return low;
}

/* The weights of the four cosines from *first on whose Catmull-Rom spline is at mu. Beyond the first and the last the
 * slope is that of their interval. False beyond the table. [PBRT3 8.6.1] */
static bool spline(const struct fourier_table *t, double mu, int *first, double w[4])
{
    double x;
    int i = interval(t, mu, &x);
    if (i < 0)
        return false;
    double width = t->mu[i + 1] - t->mu[i], x2 = x * x, x3 = x2 * x;
    double rise = x3 - 2 * x2 + x, fall = x3 - x2; /* what the slopes at both ends count */
    double left = i > 0 ? rise * width / (t->mu[i + 1] - t->mu[i - 1]) : rise;
    double right = i + 2 < t->n_mu ? fall * width / (t->mu[i + 2] - t->mu[i]) : fall;
    w[0] = i > 0 ? -left : 0;
    w[1] = 2 * x3 - 3 * x2 + 1 - right - (i > 0 ? 0 : left);
    w[2] = -2 * x3 + 3 * x2 + left + (i + 2 < t->n_mu ? 0 : right);
    w[3] = i + 2 < t->n_mu ? right : 0;
    *first = i - 1;
    return true;
}

/* The cosine of the difference of the azimuths of -wi and wo. */
static double cos_azimuth(vec3 wo, vec3 wi)
{
    double l = sqrt((wo.x * wo.x + wo.y * wo.y) * (wi.x * wi.x + wi.y * wi.y));
    return l > 0 ? clamp(-(wo.x * wi.x + wo.y * wi.y) / l, -1, 1) : 1;
}

/* What of radiance from wi goes to wo. Refraction is the one asymmetry of what is in the file. [PBRT3 8.6] */
static rgb value(const struct fourier_table *t, vec3 wo, vec3 wi)
{
    int o, i;
    double wo_weight[4], wi_weight[4], sum[3] = {0}, one[3], cos_phi = cos_azimuth(wo, wi);
    if (!spline(t, wo.z, &o, wo_weight) || !spline(t, -wi.z, &i, wi_weight))
        return rgb_black();
    for (int k = 0; k < 16; k++) {
        double weight = wo_weight[k / 4] * wi_weight[k % 4];
        if (weight == 0)
            continue;
        series(t, o + k / 4, i + k % 4, cos_phi, one);
        for (int c = 0; c < 3; c++)
            sum[c] += weight * one[c];
    }
    double eta = wi.z < 0 ? 1 / t->eta : t->eta, y = fmax(0, sum[0]);
    double scale = (wo.z * wi.z < 0 ? eta * eta : 1) / fabs(wi.z);
    if (t->channels == 1)
        return rgb_grey(y * scale);
    double g = 1.39829 * y - 0.100913 * sum[2] - 0.297375 * sum[1];
    return rgb_scale(rgb_make(fmax(0, sum[1]), fmax(0, g), fmax(0, sum[2])), scale);
}

/* --- sampling ---------------------------------------------------------------------------------------- */

/* The row of a cosine of wo. */
static float *row_of(const struct fourier_table *t, int o)
{
    return t->cdf + (size_t)o * ((size_t)(t->n_mu - 1) * FOURIER_AZIMUTHS + 1);
}

/* Each cell in proportion to the luminance in the middle of its azimuths, at both of its cosines. */
static void make_row(const struct fourier_table *t, int o)
{
    float *cdf = row_of(t, o);
    int n = (t->n_mu - 1) * FOURIER_AZIMUTHS;
    double *sum = mem_alloc((size_t)n + 1, sizeof *sum), total = 0, y[3];
    for (int p = 0; p < FOURIER_AZIMUTHS; p++)
        for (int i = 0; i < t->n_mu; i++) {
            series(t, o, i, m_cos(PI * (p + 0.5) / FOURIER_AZIMUTHS), y);
            for (int cell = i - 1; cell <= i; cell++)
                if (cell >= 0 && cell < t->n_mu - 1 && y[0] > 0)
                    sum[cell * FOURIER_AZIMUTHS + p + 1] += y[0] * (t->mu[cell + 1] - t->mu[cell]);
        }
    for (int k = 1; k <= n; k++)
        total += sum[k];
    for (int k = 1; k <= n; k++) {
        sum[k] += sum[k - 1];
        cdf[k] = total > 0 ? (float)(sum[k] / total) : 0;
    }
    free(sum);
}

/* Whose cosine counts is drawn by where in its interval wo's is. */
static bool sample(const struct lobe *l, vec3 wo, vec3 ng, const double u[3], vec3 *wi)
{
    (void)ng;
    const struct fourier_table *t = l->of.table;
    double where, choice = (u[0] - EVEN) / (1 - EVEN);
    if (choice < 0) {
        *wi = warp_cos_hemisphere(u[1], u[2]);
        *wi = u[0] < EVEN / 2 ? *wi : neg(*wi);
        return true;
    }
    int o = interval(t, wo.z, &where), low = 0, high = (t->n_mu - 1) * FOURIER_AZIMUTHS;
    if (o < 0)
        return false;
    const float *cdf = row_of(t, choice < where ? o + 1 : o);
    if (!(u[1] < cdf[high]))
        return false;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        *(cdf[middle] <= u[1] ? &low : &high) = middle;
    }
    const double *mu = t->mu + low / FOURIER_AZIMUTHS;
    double within = (u[1] - cdf[low]) / (cdf[low + 1] - cdf[low]), z = mu[0] + within * (mu[1] - mu[0]);
    double side = u[2] < 0.5 ? 2 * u[2] : 1 - 2 * u[2]; /* in the cell, and its sign which of the two azimuths */
    double phi = PI / FOURIER_AZIMUTHS * (low % FOURIER_AZIMUTHS + fabs(side));
    double azimuth = wo.x != 0 || wo.y != 0 ? m_atan2(wo.y, wo.x) : 0;
    *wi = neg(cylindrical(safe_sqrt(1 - z * z), azimuth + copysign(phi, side), z));
    return true;
}

/* The density with which wi is drawn. */
static double density(const struct fourier_table *t, vec3 wo, vec3 wi)
{
    double where, unused, pdf = EVEN * fabs(wi.z) * INV_PI / 2, x = m_acos(cos_azimuth(wo, wi)) * INV_PI;
    int o = interval(t, wo.z, &where), i = interval(t, -wi.z, &unused), p = (int)(x * FOURIER_AZIMUTHS);
    if (o < 0 || i < 0)
        return pdf;
    int cell = i * FOURIER_AZIMUTHS + (p < FOURIER_AZIMUTHS ? p : FOURIER_AZIMUTHS - 1);
    const float *a = row_of(t, o) + cell, *b = row_of(t, o + 1) + cell;
    double mass = (1 - where) * ((double)a[1] - a[0]) + where * ((double)b[1] - b[0]);
    return pdf + (1 - EVEN) * mass * FOURIER_AZIMUTHS / (2 * PI * (t->mu[i + 1] - t->mu[i]));
}

/* Of importance as of radiance with wo and wi exchanged: files are reciprocal only as well as their splines are. */
static struct bsdf_value eval(const struct lobe *l, vec3 wo, vec3 wi, bool reflect, enum transport mode)
{
    (void)reflect;
    const struct fourier_table *t = l->of.table;
    rgb f = mode == RADIANCE ? value(t, wo, wi) : value(t, wi, wo);
    return (struct bsdf_value){f, density(t, wo, wi), density(t, wi, wo)};
}

static double guess(const struct lobe *l) { return 0.5 * rgb_mean(rgb_mul(l->scale, l->R)); }

const struct lobe_form form_fourier = {guess, eval, sample, true};

/* --- files ------------------------------------------------------------------------------------------- */

static uint32_t word(const uint8_t *byte) { return (uint32_t)bits_of_bytes(byte, 4, false); }

/* n floats as numbers; false unless all of them are in [low, high]. */
static bool numbers(const uint8_t *byte, size_t n, double low, double high, double *out)
{
    for (size_t i = 0; i < n; i++) {
        out[i] = (double)float_of_bits(word(byte + 4 * i));
        if (!(out[i] >= low && out[i] <= high))
            return false;
    }
    return true;
}

/* Cosines, the cumulative sums of pbrt-v3's sampling, which is not ours, the places of the series, and the series. No
 * two of them share coefficients, so that a file costs no more than its size. */
static bool read_body(const uint8_t *byte, size_t n_a, struct fourier_table *t)
{
    size_t n = (size_t)t->n_mu, pairs = n * n, used = 0;
    t->mu = mem_alloc(n, sizeof *t->mu);
    t->first = mem_alloc(pairs, sizeof *t->first);
    t->length = mem_alloc(pairs, sizeof *t->length);
    t->a = mem_alloc(n_a, sizeof *t->a);
    bool ok = numbers(byte, n, -1, 1, t->mu);
    for (size_t i = 1; i < n; i++) /* the horizon is there twice, for what is above it and below; the last only once */
        ok = ok && (i < n - 1 ? t->mu[i - 1] <= t->mu[i] : t->mu[i - 1] < t->mu[i]);
    byte += 4 * (n + pairs);
    for (size_t i = 0; i < pairs && ok; i++, byte += 8) {
        size_t length = t->length[i] = word(byte + 4);
        t->first[i] = word(byte);
        ok = length <= MOST_COEFFICIENTS && t->first[i] <= n_a && length * (size_t)t->channels <= n_a - t->first[i];
        used += length * (size_t)t->channels;
    }
    return ok && used <= n_a && numbers(byte, n_a, -1e9, 1e9, t->a);
}

static bool read_table(const uint8_t *byte, size_t size, struct fourier_table *t)
{
    double eta;
    if (size < HEADER || memcmp(byte, "SCATFUN\1", 8) != 0 || word(byte + 8) != 1 || word(byte + 28) != 1)
        return false;
    size_t n = word(byte + 12), n_a = word(byte + 16), channels = word(byte + 24);
    if (n < 2 || n > MOST_COSINES || (channels != 1 && channels != 3) || n_a > size / 4 ||
        size / 4 - n_a < HEADER / 4 + n + 3 * n * n)
        return false;
    t->n_mu = (int)n;
    t->channels = (int)channels;
    if (!numbers(byte + 44, 1, 0.01, 100, &eta) || !read_body(byte + HEADER, n_a, t))
        return false;
    t->eta = eta;
    t->cdf = mem_alloc(n * ((n - 1) * FOURIER_AZIMUTHS + 1), sizeof *t->cdf);
    for (int o = 0; o < t->n_mu; o++)
        make_row(t, o);
    return true;
}

bool fourier_read(const char *path, struct fourier_table *out, struct error *err)
{
    uint8_t *byte;
    memset(out, 0, sizeof *out);
    if (!file_read(path, &byte, &out->file_size, err))
        return false;
    out->content = hash_content(byte, out->file_size);
    bool ok = read_table(byte, out->file_size, out);
    free(byte);
    if (!ok)
        fourier_free(out);
    return ok || error_set(err, "%s: not a .bsdf file that pbrt-v3 reads, or damaged", path);
}

void fourier_free(struct fourier_table *t)
{
    free(t->mu);
    free(t->first);
    free(t->length);
    free(t->a);
    free(t->cdf);
    memset(t, 0, sizeof *t);
}
