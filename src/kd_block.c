/* kd_block.c: see kd_block.h. */
#include "kd_block.h"

#include <float.h>

struct kd_block_ray kd_block_ray(const struct ray *ray, double size)
{
    struct triangle_ray e = triangle_ray(ray);
    struct kd_block_ray r = {ray,         e,           (float)e.ox, (float)e.oy,
                             (float)e.oz, (float)e.sx, (float)e.sy, (float)(64 * 0x1p-24 * size)};
    return r;
}

void kd_block_fill(struct kd_block *b, const struct geometry *geo, const int *prim, int n)
{
    const struct kd_block empty = {{{{0}}}, {KD_NONE, KD_NONE, KD_NONE, KD_NONE}};
    *b = empty;
    for (int lane = 0; lane < n; lane++) {
        b->prim[lane] = (uint32_t)prim[lane];
        if (prim[lane] >= FIRST_QUADRIC)
            continue;
        const struct shape_group *group = shape_group_of(geo, prim[lane]);
        if (geo->opaque != NULL && (group->alpha >= 0 || group->shadow_alpha >= 0))
            b->prim[lane] |= KD_ALPHA;
        float v[9];
        shape_vertices(geo, prim[lane], v);
        for (int i = 0; i < 9; i++)
            b->v[i / 3][i % 3][lane] = v[i];
    }
}

/* Which lanes may the ray hit? Returns whether there are any. The names are those of triangle_hit. */
static inline bool lanes_near(const struct kd_block *b, const struct kd_block_ray *r, int near[KD_LANES])
{
    const float *a_x = b->v[0][r->exact.kx], *a_y = b->v[0][r->exact.ky], *a_z = b->v[0][r->exact.kz];
    const float *b_x = b->v[1][r->exact.kx], *b_y = b->v[1][r->exact.ky], *b_z = b->v[1][r->exact.kz];
    const float *c_x = b->v[2][r->exact.kx], *c_y = b->v[2][r->exact.ky], *c_z = b->v[2][r->exact.kz];
    const float ox = r->ox, oy = r->oy, oz = r->oz, sx = r->sx, sy = r->sy, factor = r->slack;
    const uint32_t *prim = b->prim;
    int any = 0;
    for (int i = 0; i < KD_LANES; i++) {
        float az = a_z[i] - oz, bz = b_z[i] - oz, cz = c_z[i] - oz;
        float ax = (a_x[i] - ox) - sx * az, ay = (a_y[i] - oy) - sy * az;
        float bx = (b_x[i] - ox) - sx * bz, by = (b_y[i] - oy) - sy * bz;
        float cx = (c_x[i] - ox) - sx * cz, cy = (c_y[i] - oy) - sy * cz;
        float ea = cx * by - cy * bx, eb = ax * cy - ay * cx, ec = bx * ay - by * ax;
        float sum = fabsf(ax) + fabsf(ay) + fabsf(bx) + fabsf(by) + fabsf(cx) + fabsf(cy);
        float slack = factor * sum + FLT_MIN;
        float least = ea < eb ? ea : eb, most = ea < eb ? eb : ea;
        least = ec < least ? ec : least;
        most = ec > most ? ec : most;
        near[i] = (prim[i] != KD_NONE) & !((least < -slack) & (most > slack));
        any |= near[i];
    }
    return any != 0;
}

static bool lane_hit(const struct kd_block *b, int lane, const struct geometry *geo, const struct kd_block_ray *r,
                     double tmax, bool shadow, struct hit *hit)
{
    float v[9];
    struct hit h;
    for (int i = 0; i < 9; i++)
        v[i] = b->v[i / 3][i % 3][lane];
    if (!triangle_hit(&r->exact, v, tmax, &h))
        return false;
    h.prim = (int)(b->prim[lane] & ~KD_ALPHA);
    if ((b->prim[lane] & KD_ALPHA) && !geo->opaque(geo->opaque_context, geo, &h, shadow))
        return false;
    *hit = h;
    return true;
}

static bool quadrics_hit(const struct kd_block *b, const struct geometry *geo, const struct ray *ray, double tmax,
                         struct hit *hit)
{
    struct ray shorter = *ray;
    struct hit h;
    bool found = false;
    shorter.tmax = tmax;
    for (int i = 0; i < KD_LANES && b->prim[i] != KD_NONE; i++)
        if (shape_intersect(geo, (int)b->prim[i], &shorter, &h)) {
            *hit = h;
            shorter.tmax = h.t;
            found = true;
        }
    return found;
}

bool kd_block_hit(const struct kd_block *b, const struct geometry *geo, const struct kd_block_ray *r, double tmax,
                  bool shadow, struct hit *hit)
{
    int near[KD_LANES];
    bool found = false;
    if ((b->prim[0] & ~KD_ALPHA) >= FIRST_QUADRIC)
        return quadrics_hit(b, geo, r->ray, tmax, hit);
    if (!lanes_near(b, r, near))
        return false;
    for (int i = 0; i < KD_LANES; i++)
        if (near[i] && lane_hit(b, i, geo, r, tmax, shadow, hit)) {
            tmax = hit->t;
            found = true;
        }
    return found;
}
