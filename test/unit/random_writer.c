/* random_writer.c: see random_writer.h. */
#include "random_writer.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "base/maths.h"
#include "base/mem.h"
#include "fuzz/hostile.h"
#include "lab/numbers.h"

/* --- text and numbers ----------------------------------------------------------------------------------- */

void put(struct writer *w, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int n = vsnprintf(NULL, 0, format, args);
    va_end(args);
    size_t size = n > 0 ? (size_t)n : 0;
    w->text = mem_grow(w->text, &w->capacity, w->used + size + 1, 1);
    va_start(args, format);
    vsnprintf(w->text + w->used, size + 1, format, args);
    va_end(args);
    w->used += size;
}

void put_numbers(struct writer *w, int n, const double *x)
{
    for (int i = 0; i < n; i++)
        if (w->evil && chance(w, 0.02))
            put(w, "%s ", hostile_number(rng_u32(&w->rng)));
        else
            put(w, "%.9g ", x[i]);
}

void put_vec(struct writer *w, vec3 v)
{
    const double x[3] = {v.x, v.y, v.z};
    put_numbers(w, 3, x);
}

void put_list(struct writer *w, const char *kind, const char *name, int n, const double *x)
{
    put(w, "\"%s %s\" [ ", kind, name);
    put_numbers(w, n, x);
    put(w, "] ");
}

void put_float(struct writer *w, const char *name, double value) { put_list(w, "float", name, 1, &value); }

void put_point(struct writer *w, const char *kind, const char *name, vec3 v)
{
    const double x[3] = {v.x, v.y, v.z};
    put_list(w, kind, name, 3, x);
}

void put_rgb(struct writer *w, const char *name, double r, double g, double b)
{
    put_point(w, "rgb", name, vec(r, g, b));
}

int pick(struct writer *w, int n) { return (int)rng_below(&w->rng, (uint32_t)n); }
bool chance(struct writer *w, double probability) { return rng_uniform(&w->rng) < probability; }
double between(struct writer *w, double low, double high) { return low + (high - low) * rng_uniform(&w->rng); }
double across(struct writer *w, double low, double high) { return low * pow(high / low, rng_uniform(&w->rng)); }

vec3 direction(struct writer *w)
{
    double z = between(w, -1, 1), phi = between(w, 0, 2 * PI), r = sqrt(1 - z * z);
    return vec(r * cos(phi), r * sin(phi), z);
}

vec3 within(struct writer *w, vec3 low, vec3 high)
{
    double x = between(w, low.x, high.x), y = between(w, low.y, high.y), z = between(w, low.z, high.z);
    return vec(x, y, z);
}

vec3 stretches(struct writer *w, double low, double high)
{
    double x = across(w, low, high), y = across(w, low, high), z = across(w, low, high);
    return vec(x, y, z);
}

/* --- linear maps ---------------------------------------------------------------------------------------- */

struct map map_identity(void)
{
    struct map m = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    return m;
}

vec3 map_apply(const struct map *m, vec3 v) { return add(add(mul(m->x, v.x), mul(m->y, v.y)), mul(m->z, v.z)); }

static double determinant(const struct map *m) { return dot(cross(m->x, m->y), m->z); }

vec3 map_back(const struct map *m, vec3 v)
{
    vec3 at = vec(dot(cross(m->y, m->z), v), dot(cross(m->z, m->x), v), dot(cross(m->x, m->y), v));
    return mul(at, 1 / determinant(m));
}

vec3 map_normal(const struct map *m, vec3 n)
{
    vec3 sum = add(add(mul(cross(m->y, m->z), n.x), mul(cross(m->z, m->x), n.y)), mul(cross(m->x, m->y), n.z));
    return mul(sum, 1 / determinant(m));
}

struct map map_then(struct map first, struct map second)
{
    struct map m = {map_apply(&second, first.x), map_apply(&second, first.y), map_apply(&second, first.z)};
    return m;
}

struct map map_scaled(struct map m, double factor)
{
    struct map scaled = {mul(m.x, factor), mul(m.y, factor), mul(m.z, factor)};
    return scaled;
}

struct map map_frame(vec3 z)
{
    vec3 x = normalize(cross(fabs(z.y) < 0.9 ? vec(0, 1, 0) : vec(1, 0, 0), z));
    struct map m = {x, cross(z, x), z};
    return m;
}

struct map map_uneven(struct writer *w)
{
    double mirror = chance(w, 0.25) ? -1 : 1;
    vec3 s = stretches(w, 0.5, 1.7);
    struct map m = {vec(mirror * s.x, 0, 0), vec(0, s.y, 0), vec(0, 0, s.z)};
    if (chance(w, 0.5))
        m.y.x = between(w, -0.6, 0.6);
    if (chance(w, 0.5))
        m.y.z = between(w, -0.3, 0.3);
    return chance(w, 0.15) ? map_identity() : m;
}

struct map map_random(struct writer *w)
{
    struct map uneven = map_uneven(w);
    return map_then(uneven, map_frame(direction(w)));
}

void put_map(struct writer *w, const struct map *m)
{
    const double all[16] = {m->x.x, m->x.y, m->x.z, 0, m->y.x, m->y.y, m->y.z, 0,
                            m->z.x, m->z.y, m->z.z, 0, 0,      0,      0,      1};
    put(w, "ConcatTransform [ ");
    put_numbers(w, 16, all);
    put(w, "]\n");
}

void put_quad(struct writer *w, vec3 a, vec3 u, vec3 v)
{
    put(w, "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ ");
    put_vec(w, a);
    put_vec(w, add(a, u));
    put_vec(w, add(add(a, u), v));
    put_vec(w, add(a, v));
    put(w, "]\n");
}
