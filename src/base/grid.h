/* grid.h: numbers the cells of space that something was found in.
 *
 * Space is cut into cubes; a cell may be split further by the side a surface faces. Only cells met so far exist, in a
 * hash table with open addressing, and get numbers 0, 1, 2 ... in the order they were met.
 */
#ifndef ASBDPT_GRID_H
#define ASBDPT_GRID_H

#include <stddef.h>
#include <stdint.h>

#include "base/vec.h"

struct grid_slot {
    uint64_t key; /* packed cell coordinates and face, + 1; 0: free */
    int32_t number;
};

struct grid {
    vec3 origin;            /* corner of cell (0,0,0) */
    double per_metre;       /* cells per unit of length */
    struct grid_slot *slot; /* [n_slots], owned */
    size_t n_slots;         /* a power of 2, or 0 */
    int n;                  /* cells met */
};

/* grid_init: an empty grid of `cells` cells along the diameter of a sphere that holds everything. */
void grid_init(struct grid *g, vec3 center, double radius, int cells);
void grid_free(struct grid *g);

/* grid_copy: make *to, which must be empty, the same grid with memory of its own. */
void grid_copy(struct grid *to, const struct grid *from);

/* grid_key: the cell of a point; `face` 0..7 splits it further (0 if unused). Points outside share the border cells. */
uint64_t grid_key(const struct grid *g, vec3 p, int face);

/* grid_face: 1..6, the axis and sign a unit normal is nearest to. */
int grid_face(vec3 n);

/* grid_find: the number of a cell, or -1 if it was never met. */
int grid_find(const struct grid *g, uint64_t key);

/* grid_insert: the number of a cell, a new one if it was never met. */
int grid_insert(struct grid *g, uint64_t key);

#endif
