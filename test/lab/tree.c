/* tree.c: see tree.h. */
#include "lab/tree.h"

#include "base/sampler.h"
#include "base/warp.h"
#include "geometry/kd_block.h"
#include "geometry/kd_plane.h"

/* --- figures ----------------------------------------------------------------------------------------- */

static size_t references(const struct kdtree *kd, struct kd_node leaf)
{
    const struct kd_block *block = &kd->block[leaf.at.first];
    size_t n = 0;
    for (uint32_t i = 0; i < KD_LANES * kd_blocks(leaf); i++)
        n += block[i / KD_LANES].prim[i % KD_LANES] != KD_NONE;
    return n;
}

/* The cost of a ray that crosses a node with this box. */
static double ray_cost(const struct kdtree *kd, uint32_t number, const struct box *box, int depth,
                       struct tree_figures *out)
{
    struct kd_node node = kd->node[number];
    if (depth > out->depth)
        out->depth = depth;
    if (kd_is_leaf(node)) {
        size_t n = references(kd, node);
        out->references += n;
        return kd_leaf_cost(n);
    }
    double area = kd_half_area(box), cost = KD_VISIT_COST;
    struct box part[2] = {*box, *box};
    part[0].hi[node.word & 3] = part[1].lo[node.word & 3] = node.at.split;
    for (uint32_t s = 0; s < 2; s++)
        cost += ray_cost(kd, kd_children(node) + s, &part[s], depth + 1, out) *
                (area > 0 ? kd_half_area(&part[s]) / area : 1);
    return cost;
}

struct tree_figures tree_figures(const struct kdtree *kd)
{
    struct tree_figures out = {0, 0, 0};
    struct box box;
    for (int k = 0; k < 3; k++) {
        box.lo[k] = kd->lo[k];
        box.hi[k] = kd->hi[k];
    }
    if (kd->n_nodes > 0)
        out.cost = ray_cost(kd, 0, &box, 0, &out);
    return out;
}

/* --- rays -------------------------------------------------------------------------------------------- */

static vec3 cosine_direction(struct sampler *sampler, vec3 n)
{
    struct frame f = frame_from_normal(n);
    double u[2];
    sampler_pair(sampler, DRAW_SCATTERING, u);
    return to_world(&f, warp_cos_hemisphere(u[0], u[1]));
}

/* Replace the ray by one leaving the surface it meets. False if it meets none. */
static bool bounce(const struct scene *s, struct ray *ray, struct sampler *sampler)
{
    struct surface at;
    if (!scene_intersect(s, ray, &at))
        return false;
    struct ray next = {at.p, cosine_direction(sampler, faceforward(at.ng, neg(ray->d))), ray_margin(at.p), INFINITY,
                       at.prim_id, 0};
    *ray = next;
    return true;
}

int bench_rays(const struct scene *s, struct ray *out)
{
    int n = 0;
    for (int i = 0; n < N_RAYS && i < 8 * N_RAYS; i++) {
        struct sampler sampler = sampler_start(0, RNG_TEST, (uint64_t)i, 0);
        double u[2];
        sampler_pair(&sampler, DRAW_FILM_POINT, u);
        out[n] = camera_ray(&s->camera, u[0] * s->width, u[1] * s->height, 0.5, 0.5);
        n += bounce(s, &out[n], &sampler) && bounce(s, &out[n], &sampler);
    }
    return n;
}
