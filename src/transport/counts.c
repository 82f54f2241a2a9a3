/* counts.c: see counts.h. */
#include "transport/counts.h"

struct counts counts_of(struct numbers n, double direct, const double draw[EYE_HITS], double M, double pixels,
                        const struct tables *tables)
{
    struct counts c = {.tables = tables};
    c.lens = n.path_pixels > 0 ? pixels / n.path_pixels / numbers_every(&n) : 0;
    for (int hit = 0; hit < EYE_HITS; hit++) {
        double credit = hit == FIRST_HIT ? direct : 1;
        c.s0[hit] = n.light_points > 0 ? credit : 0;
        c.light_points[hit] = hit == FIRST_HIT ? n.light_points : n.light_points > 0;
        c.s1[hit] = credit * c.light_points[hit];
        double x = n.path_pixels > 0 ? n.draws[hit] * draw[hit] : 0; /* at ratio 1 */
        c.pair[hit] = x / numbers_every(&n);
        c.bound[hit] = M > 0 ? x / M : 0;
    }
    return c;
}
