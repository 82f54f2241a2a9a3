/* slide.c: see slide.h. Goniometric and projection lights as [PBRT3 12.3.2-12.3.3] and pbrt-v3 define them. */
#include "scene/slide.h"

#include <stdlib.h>

#include "base/maths.h"
#include "base/mem.h"
#include "base/number.h"
#include "material/texture.h"

/* The picture at (u,v) in [0,1]^2; its margins wrap round, as pbrt-v3 has it. */
static rgb lookup(const struct slide *s, double u, double v)
{
    return image_bilinear(&s->image, u, 1 - v, WRAP_REPEAT, false);
}

struct slide *slide_load(const char *path, struct error *err)
{
    struct slide *s = mem_alloc(1, sizeof *s);
    if (!image_read(path, &s->image, err)) {
        free(s);
        return NULL;
    }
    image_mend(&s->image, true);
    int width = s->image.width, height = s->image.height;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            s->mean = rgb_add(s->mean, lookup(s, (x + 0.5) / width, (y + 0.5) / height));
    s->mean = rgb_scale(s->mean, 1 / ((double)width * height));
    return s;
}

void slide_free(struct slide *s)
{
    if (s == NULL)
        return;
    image_free(&s->image);
    free(s);
}

rgb slide_goniometric(const struct slide *s, vec3 w)
{
    if (s == NULL)
        return rgb_grey(1);
    double phi = m_atan2(w.z, w.x);
    return lookup(s, (phi < 0 ? phi + 2 * PI : phi) / (2 * PI), m_acos(clamp(w.y, -1, 1)) / PI);
}

/* Half the picture's sides at z = 1. */
static void half_sides(const struct slide *s, double tan_half, double *x, double *y)
{
    double aspect = s != NULL ? (double)s->image.width / s->image.height : 1;
    *x = tan_half * (aspect > 1 ? aspect : 1);
    *y = tan_half * (aspect > 1 ? 1 : 1 / aspect);
}

rgb slide_projection(const struct slide *s, double tan_half, vec3 w)
{
    double x, y;
    half_sides(s, tan_half, &x, &y);
    if (!(w.z > 0 && fabs(w.x) <= x * w.z && fabs(w.y) <= y * w.z))
        return rgb_black();
    return s != NULL ? lookup(s, 0.5 + 0.5 * w.x / (w.z * x), 0.5 + 0.5 * w.y / (w.z * y)) : rgb_grey(1);
}

double slide_cos_corner(const struct slide *s, double tan_half)
{
    double x, y;
    half_sides(s, tan_half, &x, &y);
    return 1 / sqrt(1 + x * x + y * y);
}
