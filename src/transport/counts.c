/* counts.c: see counts.h. */
#include "transport/counts.h"

struct counts counts_of(struct numbers n, double direct, double pair, double pixels, const struct tables *tables)
{
    struct counts c = {.tables = tables};
    c.lens = n.path_pixels > 0 ? pixels / n.path_pixels / numbers_every(&n) : 0;
    for (int end = 0; end < EYE_ENDS; end++) {
        double credit = end == FIRST_HIT ? direct : 1;
        c.s0[end] = n.light_points > 0 ? credit : 0;
        c.light_points[end] = end == FIRST_HIT ? n.light_points : n.light_points > 0;
        c.s1[end] = credit * c.light_points[end];
        c.pair[end] = n.path_pixels > 0 ? n.draws[end] * pair / numbers_every(&n) : 0;
    }
    return c;
}
