/* gather.c: see gather.h. */
#include "transport/gather.h"

static rgb take(struct gather *g, struct connection c, int s, int t, double scale)
{
    if (rgb_is_black(c.value))
        return rgb_black();
    rgb value = rgb_scale(c.value, scale * g->filter_weight);
    if (g->tile->keep_records)
        tile_record_own(g->tile, g->x, g->y, s, t, value, c.weight);
    return rgb_scale(value, c.weight);
}

rgb gather_eye(struct gather *g, const struct vertex *eye, int n)
{
    rgb sum = rgb_black();
    for (int t = 2; t <= n; t++) {
        const struct vertex *z = &eye[t - 1];
        if (t == 2 || g->counts->hit > 0)
            sum = rgb_add(sum, take(g, connect_hit(g->scene, g->counts, z, t), 0, t, 1));
        if (g->counts->direct > 0 && t <= g->max_depth + 1 && z->kind == VERTEX_SURFACE)
            sum = rgb_add(sum, take(g, connect_direct(g->scene, g->counts, z, &g->sampler, NULL), 1, t, 1));
    }
    return sum;
}

rgb gather_pair(struct gather *g, const struct vertex *y, int s, const struct vertex *z, int t, double scale)
{
    return take(g, connect_pair(g->scene, g->counts, y, z), s, t, scale);
}

rgb gather_pairs(struct gather *g, const struct vertex *eye, int n_eye, const struct vertex *light, int n_light,
                 double scale)
{
    rgb sum = rgb_black();
    for (int t = 2; t <= n_eye; t++)
        for (int s = 2; s <= n_light && s + t <= g->max_depth + 2; s++)
            sum = rgb_add(sum, gather_pair(g, &light[s - 1], s, &eye[t - 1], t, scale));
    return sum;
}

void gather_splats(struct gather *g, const struct vertex *light, int n_light, double scale)
{
    double each = scale / g->counts->splat;
    for (int s = 2; s <= n_light && s <= g->max_depth + 1; s++) {
        struct connection c = connect_lens(g->scene, g->counts, &light[s - 1], &g->sampler);
        if (rgb_is_black(c.value))
            continue;
        if (g->tile->keep_records)
            tile_record_splat(g->tile, c.px, c.py, s, 1, rgb_scale(c.value, each), c.weight);
        tile_add_splat(g->tile, c.px, c.py, rgb_scale(c.value, each * c.weight));
    }
}
