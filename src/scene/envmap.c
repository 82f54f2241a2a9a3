/* envmap.c: see envmap.h. */
#include "scene/envmap.h"

#include <stdlib.h>

#include "base/maths.h"
#include "base/mem.h"
#include "base/number.h"
#include "material/texture.h"

/* The lookup interpolates between texels, so a texel holds light of its eight neighbours too. Its weight is the
 * integral of the interpolated luminance over it: the kernel (1 6 1)/8 on both axes. */
static double texel_weight(const double *luminance, int width, int height, int x, int y)
{
    static const double kernel[3] = {0.125, 0.75, 0.125};
    double sum = 0;
    for (int j = -1; j <= 1; j++)
        for (int i = -1; i <= 1; i++) {
            int xx = (x + i + width) % width, yy = (y + j + height) % height;
            sum += kernel[i + 1] * kernel[j + 1] * luminance[(size_t)yy * (size_t)width + (size_t)xx];
        }
    return sum;
}

/* Texels of block b: [x0,x1) x [y0,y1). */
static void block_range(const struct envmap *e, int b, int *x0, int *x1, int *y0, int *y1)
{
    *x0 = b % e->blocks_u * e->block_width;
    *y0 = b / e->blocks_u * e->block_height;
    *x1 = *x0 + e->block_width < e->image.width ? *x0 + e->block_width : e->image.width;
    *y1 = *y0 + e->block_height < e->image.height ? *y0 + e->block_height : e->image.height;
}

static void build_blocks(struct envmap *e, const double *luminance)
{
    enum { ACROSS = 32, DOWN = 16 };
    int width = e->image.width, height = e->image.height;
    e->block_width = (width + ACROSS - 1) / ACROSS;
    e->block_height = (height + DOWN - 1) / DOWN;
    e->blocks_u = (width + e->block_width - 1) / e->block_width;
    e->blocks_v = (height + e->block_height - 1) / e->block_height;
    e->block = mem_alloc((size_t)envmap_blocks(e), sizeof *e->block);
    double *weight = mem_alloc((size_t)e->block_width * (size_t)e->block_height, sizeof *weight);
    for (int b = 0; b < envmap_blocks(e); b++) {
        int x0, x1, y0, y1, n = 0;
        block_range(e, b, &x0, &x1, &y0, &y1);
        for (int y = y0; y < y1; y++)
            for (int x = x0; x < x1; x++)
                weight[n++] = texel_weight(luminance, width, height, x, y) * m_sin(PI * (y + 0.5) / height);
        alias_build(&e->block[b], weight, n);
    }
    free(weight);
}

static void build_tables(struct envmap *e)
{
    int width = e->image.width, height = e->image.height;
    double *luminance = mem_alloc((size_t)width * (size_t)height, sizeof *luminance);
    rgb sum = rgb_black();
    double solid_angle = 0;
    for (int y = 0; y < height; y++) {
        double sin_theta = m_sin(PI * (y + 0.5) / height);
        for (int x = 0; x < width; x++) {
            rgb c = image_bilinear(&e->image, (x + 0.5) / width, 1 - (y + 0.5) / height, WRAP_REPEAT, false);
            double l = rgb_luminance(c);
            luminance[(size_t)y * (size_t)width + (size_t)x] = l > 0 ? l : 0;
            sum = rgb_add(sum, rgb_scale(c, sin_theta));
        }
        solid_angle += sin_theta * width;
    }
    e->mean = rgb_scale(sum, 1 / solid_angle);
    build_blocks(e, luminance);
    free(luminance);
}

struct envmap *envmap_load(const char *path, const struct budget *memory, struct error *err)
{
    struct error reason;
    struct envmap *e = mem_alloc(1, sizeof *e);
    bool read = image_read(path, memory, &e->image, err);
    bool ok = read && budget_has(memory, (double)image_bytes(&e->image) + (double)envmap_bytes(e), &reason);
    if (read && !ok)
        error_set(err, "%s: %s", path, reason.text);
    if (!ok) {
        image_free(&e->image);
        free(e);
        return NULL;
    }
    image_mend(&e->image, true); /* light that is negative or not finite has no place in a table of choices */
    build_tables(e);
    return e;
}

struct envmap *envmap_of(const double *luminance, int width, int height)
{
    struct envmap *e = mem_alloc(1, sizeof *e);
    e->image.width = width;
    e->image.height = height;
    build_blocks(e, luminance);
    return e;
}

void envmap_free(struct envmap *e)
{
    if (e == NULL)
        return;
    for (int b = 0; b < envmap_blocks(e); b++)
        alias_free(&e->block[b]);
    free(e->block);
    image_free(&e->image);
    free(e);
}

static void direction_to_map(vec3 w, double *s, double *v)
{
    double phi = m_atan2(w.y, w.x);
    *s = (phi < 0 ? phi + 2 * PI : phi) / (2 * PI);
    *v = m_acos(clamp(w.z, -1, 1)) / PI;
}

vec3 envmap_direction(double s, double v)
{
    double sin_theta, cos_theta;
    m_sincos(PI * v, &sin_theta, &cos_theta);
    return cylindrical(sin_theta, 2 * PI * s, cos_theta);
}

rgb envmap_picture(const struct envmap *e, double s, double v)
{
    return image_bilinear(&e->image, s, 1 - v, WRAP_REPEAT, false);
}

rgb envmap_lookup(const struct envmap *e, vec3 w)
{
    double s, v;
    direction_to_map(w, &s, &v);
    return envmap_picture(e, s, v);
}

/* Uniform density over a texel's square of (s,v), carried to the sphere: dw = 2 pi^2 sin(theta) ds dv.
 * [PBRT3 14.2.4] */
static double texel_pdf(const struct envmap *e, double pmf, double sin_theta)
{
    return sin_theta > 0 ? pmf * e->image.width * e->image.height / (2 * PI * PI * sin_theta) : 0;
}

vec3 envmap_sample(const struct envmap *e, int block, double u1, double u2, double *pdf_dir)
{
    double pmf, du;
    int x0, x1, y0, y1, i = alias_sample(&e->block[block], u1, &pmf, &du);
    block_range(e, block, &x0, &x1, &y0, &y1);
    int x = x0 + i % (x1 - x0), y = y0 + i / (x1 - x0);
    vec3 w = envmap_direction((x + du) / e->image.width, (y + u2) / e->image.height);
    *pdf_dir = texel_pdf(e, pmf, safe_sqrt(1 - w.z * w.z));
    return w;
}

double envmap_pdf(const struct envmap *e, vec3 w, int *block)
{
    double s, v;
    direction_to_map(w, &s, &v);
    int x = int_within(s * e->image.width, 0, e->image.width - 1);
    int y = int_within(v * e->image.height, 0, e->image.height - 1);
    *block = y / e->block_height * e->blocks_u + x / e->block_width;
    int x0, x1, y0, y1;
    block_range(e, *block, &x0, &x1, &y0, &y1);
    double pmf = alias_pmf(&e->block[*block], (y - y0) * (x1 - x0) + x - x0);
    return texel_pdf(e, pmf, safe_sqrt(1 - w.z * w.z));
}
