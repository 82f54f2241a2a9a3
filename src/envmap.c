/* envmap.c: see envmap.h. */
#include "envmap.h"

#include <stdlib.h>

#include "mem.h"
#include "texture.h"

/* Light of texel (x,y), at its own area of the sphere up to a constant. */
static rgb texel(const struct envmap *e, int x, int y)
{
    double s = (x + 0.5) / e->image.width, v = (y + 0.5) / e->image.height;
    return image_bilinear(&e->image, s, 1 - v, WRAP_REPEAT, !e->image.linear);
}

/* The lookup interpolates between texels, so a texel's cell holds light of its eight neighbours too. Its weight is the
 * integral of the interpolated luminance over the cell: the kernel (1 6 1)/8 on both axes. */
static double cell_weight(const double *luminance, int width, int height, int x, int y)
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

static void build_tables(struct envmap *e)
{
    int width = e->image.width, height = e->image.height;
    double *luminance = mem_alloc((size_t)width * (size_t)height, sizeof *luminance);
    double *row = mem_alloc((size_t)width, sizeof *row), *row_total = mem_alloc((size_t)height, sizeof *row_total);
    rgb sum = rgb_black();
    double solid_angle = 0;
    for (int y = 0; y < height; y++) {
        double sin_theta = sin(PI * (y + 0.5) / height);
        for (int x = 0; x < width; x++) {
            rgb c = texel(e, x, y);
            luminance[(size_t)y * (size_t)width + (size_t)x] = fmax(0, rgb_luminance(c));
            sum = rgb_add(sum, rgb_scale(c, sin_theta));
        }
        solid_angle += sin_theta * width;
    }
    e->mean = rgb_scale(sum, 1 / solid_angle);
    e->columns = mem_alloc((size_t)height, sizeof *e->columns);
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++)
            row[x] = cell_weight(luminance, width, height, x, y);
        alias_build(&e->columns[y], row, width);
        row_total[y] = e->columns[y].total * sin(PI * (y + 0.5) / height);
    }
    alias_build(&e->rows, row_total, height);
    free(row_total);
    free(row);
    free(luminance);
}

struct envmap *envmap_load(const char *path, struct error *err)
{
    struct envmap *e = mem_alloc(1, sizeof *e);
    if (!image_read(path, &e->image, err)) {
        free(e);
        return NULL;
    }
    build_tables(e);
    return e;
}

void envmap_free(struct envmap *e)
{
    if (e == NULL)
        return;
    alias_free(&e->rows);
    for (int y = 0; e->columns != NULL && y < e->image.height; y++)
        alias_free(&e->columns[y]);
    free(e->columns);
    image_free(&e->image);
    free(e);
}

static void direction_to_map(vec3 w, double *s, double *v)
{
    double phi = atan2(w.y, w.x);
    *s = (phi < 0 ? phi + 2 * PI : phi) / (2 * PI);
    *v = acos(clamp(w.z, -1, 1)) / PI;
}

rgb envmap_lookup(const struct envmap *e, vec3 w)
{
    double s, v;
    direction_to_map(w, &s, &v);
    return image_bilinear(&e->image, s, 1 - v, WRAP_REPEAT, !e->image.linear);
}

/* Uniform density over the cells' (s,v) square, carried to the sphere: dw = 2 pi^2 sin(theta) ds dv. */
static double cell_pdf(const struct envmap *e, double pmf, double sin_theta)
{
    return sin_theta > 0 ? pmf * e->image.width * e->image.height / (2 * PI * PI * sin_theta) : 0;
}

vec3 envmap_sample(const struct envmap *e, double u1, double u2, double *pdf_w)
{
    *pdf_w = 0;
    if (e->rows.n == 0)
        return vec(0, 0, 1);
    double pmf_row, pmf_column, dx, dy;
    int y = alias_sample(&e->rows, u1, &pmf_row, &dy);
    int x = alias_sample(&e->columns[y], u2, &pmf_column, &dx);
    double phi = 2 * PI * (x + dx) / e->image.width, theta = PI * (y + dy) / e->image.height;
    double sin_theta = sin(theta);
    *pdf_w = cell_pdf(e, pmf_row * pmf_column, sin_theta);
    return vec(sin_theta * cos(phi), sin_theta * sin(phi), cos(theta));
}

double envmap_pdf(const struct envmap *e, vec3 w)
{
    if (e->rows.n == 0)
        return 0;
    double s, v;
    direction_to_map(w, &s, &v);
    int x = (int)(s * e->image.width), y = (int)(v * e->image.height);
    x = x >= e->image.width ? e->image.width - 1 : x;
    y = y >= e->image.height ? e->image.height - 1 : y;
    double pmf = alias_pmf(&e->rows, y) * alias_pmf(&e->columns[y], x);
    return cell_pdf(e, pmf, safe_sqrt(1 - w.z * w.z));
}
