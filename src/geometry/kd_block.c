/* kd_block.c: see kd_block.h. */
#include "geometry/kd_block.h"

/* The number of a primitive that is a triangle, KD_NONE of another: quadrics see to themselves. */
static uint32_t own_triangle(uint32_t id) { return id - 1 < FIRST_QUADRIC ? id - 1 : KD_NONE; }

void kd_block_ray(struct kd_block_ray *r, const struct ray *ray, double size)
{
    r->exact = triangle_ray(ray);
    r->ox = (float)r->exact.ox;
    r->oy = (float)r->exact.oy;
    r->oz = (float)r->exact.oz;
    r->sx = (float)r->exact.sx;
    r->sy = (float)r->exact.sy;
    r->slack = (float)(64 * 0x1p-24 * size);
    r->from = own_triangle(ray->from);
    r->to = own_triangle(ray->to);
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
    struct hit h;
    bool found = false;
    for (int i = 0; i < KD_LANES && b->prim[i] != KD_NONE; i++)
        if (shape_intersect(geo, (int)b->prim[i], ray, &h) && h.t < tmax) {
            *hit = h;
            tmax = h.t;
            found = true;
        }
    return found;
}

bool kd_block_hit(const struct kd_block *b, const int near[KD_LANES], const struct geometry *geo,
                  const struct kd_block_ray *r, double tmax, bool shadow, struct hit *hit)
{
    bool found = false;
    if ((b->prim[0] & ~KD_ALPHA) >= FIRST_QUADRIC)
        return quadrics_hit(b, geo, r->exact.ray, tmax, hit);
    for (int i = 0; i < KD_LANES; i++)
        if (near[i] && lane_hit(b, i, geo, r, tmax, shadow, hit)) {
            tmax = hit->t;
            found = true;
        }
    return found;
}
