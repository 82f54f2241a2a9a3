/* counts.h: how many samples a strategy takes for a path (mis.h): n of its connecting edge, from the edge's two
 * ends. */
#ifndef ASBDPT_COUNTS_H
#define ASBDPT_COUNTS_H

#include "transport/vertex.h"

/* mis_connect_count: n of the strategy s >= 2, t >= 2 whose light end is in region y and whose eye end in region e. */
static inline double mis_connect_count(const struct mis_counts *c, int y, int e, enum eye_end end)
{
    double n = c->connect[end];
    return c->model != 0 && c->model->connect != 0 ? n * c->model->connect(c->model->learnt, y, e) : n;
}

/* mis_direct_count: n of the strategy s = 1, t >= 2 that joins a surface point in region e to the end point y0.
 *   cell, w  of y0, see count_model */
static inline double mis_direct_count(const struct mis_counts *c, const struct light_set *lights, int e,
                                      enum eye_end end, int cell, vec3 w)
{
    bool delta = cell >= 0 && light_is_delta(&lights->light[lights->light_of_cell[cell]]);
    double n = (delta ? c->delta : c->direct)[end];
    return c->model != 0 && c->model->direct != 0 && n > 0 ? n * c->model->direct(c->model->learnt, lights, e, cell, w)
                                                           : n;
}

/* mis_count_before: c_e of a light sub-path's vertex y with prev before it: n of the strategy that joins prev to y, y
 * being an eye end of the given kind; 0 after a delta lobe. mis_count_behind: c_e of an eye sub-path's vertex z: n of
 * the strategy that joins z, as its light end, to prev. */
double mis_count_before(const struct mis_counts *c, const struct light_set *lights, const struct vertex *prev,
                        const struct vertex *y, enum eye_end end);
double mis_count_behind(const struct mis_counts *c, const struct vertex *prev, const struct vertex *z);

#endif
