/* counts.c: see counts.h. */
#include "transport/counts.h"

struct counts counts_of(struct numbers n, double direct, double pair, double pixels, const struct tables *tables)
{
    struct counts c = {.tables = tables};
    c.lens = n.path_pixels > 0 ? pixels / n.path_pixels / numbers_every(&n) : 0;
    for (int hit = 0; hit < EYE_HITS; hit++) {
        double credit = hit == FIRST_HIT ? direct : 1;
        c.s0[hit] = n.light_points > 0 ? credit : 0;
        c.light_points[hit] = hit == FIRST_HIT ? n.light_points : n.light_points > 0;
        c.s1[hit] = credit * c.light_points[hit];
        c.pair[hit] = n.path_pixels > 0 ? n.draws[hit] * pair / numbers_every(&n) : 0;
    }
    return c;
}
