/* regions.h: surface points sorted into regions of the scene, so that something can be learnt about each.
 *
 * Space is cut into cubes, and a cube is split by the side that surfaces in it face: the two sides of a wall have
 * nothing in common (vertex_side of vertex.h says on which of them a walk is). Cubes come in levels, each twice as wide
 * as the one below; a region that was never met is represented by the finest known one that holds it, at last by the
 * whole scene, which is region 0. Only regions met so far exist, in a hash table with open addressing; they are
 * numbered in the order they were met, those of all levels together, a region after those that hold it.
 */
#ifndef ASBDPT_TABLES_REGIONS_H
#define ASBDPT_TABLES_REGIONS_H

#include <stddef.h>
#include <stdint.h>

#include "base/vec.h"

struct region_slot {
    uint64_t key; /* level, coordinates of the cube and face, packed; 0: free */
    int32_t number;
};

struct region {
    int above; /* the region of the next level that holds it; -1 for region 0 */
    int level; /* 0: the finest; n_levels: region 0 */
};

struct regions {
    vec3 origin;              /* corner of cube (0,0,0) */
    double per_metre;         /* cubes of level 0 per unit of length */
    int last[3];              /* the last cube along each axis */
    int n_levels;             /* 1 .. REGION_LEVELS */
    int limit;                /* no more regions than these */
    struct region_slot *slot; /* [n_slots], owned */
    size_t n_slots;           /* a power of 2, at least 2 limit; 0: no regions, region 0 stands for all */
    struct region *region;    /* [limit], owned */
    int n;                    /* regions known, of all levels, >= 1 */
};

enum { REGION_LEVELS = 4 };

/* regions_init: the whole scene only; `cells` cubes of level 0 along the diagonal of the box from `low` to `high`. What
 * lies outside it joins the outermost cubes. They are shifted by an irrational share of a cube, so that floors and
 * tables at round heights do not straddle two. */
void regions_init(struct regions *r, vec3 low, vec3 high, int cells, int n_levels, int limit);
void regions_free(struct regions *r);

/* regions_key: names the region of level 0 of a surface point, `side` being the unit normal of the side it is on, or,
 * 0, of a point within a medium, which has none. */
uint64_t regions_key(const struct regions *r, vec3 p, vec3 side);

/* regions_add: the number of a region of level 0, a new one, with those that hold it, if it was never met; beyond the
 * limit that of the finest known region that holds it. */
int regions_add(struct regions *r, uint64_t key);

/* regions_find: the number of the finest known region that holds it. */
int regions_find(const struct regions *r, uint64_t key);

/* region_at: the same for a surface point. */
static inline int region_at(const struct regions *r, vec3 p, vec3 side)
{
    return r->n_slots > 0 ? regions_find(r, regions_key(r, p, side)) : 0;
}

#endif
