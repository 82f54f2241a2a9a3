/* regions.h: regions of surface points, about which something can be learnt.
 *
 * Space is divided into cubes, and the surface points in a cube are divided by the direction of their normals, because
 * the two sides of a wall have different light (vertex_side of vertex.h chooses the side). The cubes of a level are
 * twice as wide as those of the level below. A hash table with open addressing has only those regions that a vertex has
 * been found in. Another point belongs to the finest known region that contains it, or to region 0, the whole scene.
 * Regions of all levels are numbered in the order in which they are added, a region after those that contain it.
 *
 * Counts in the MIS weights depend on regions (counts.h), so both walks that can make a path must find the same region
 * for a vertex. They compute its position in different ways, and rounding may carry a point on the border of two cubes
 * into either. Scenes have floors and tables at round heights. So cubes are shifted by an irrational fraction of their
 * width: no flat surface at a round coordinate lies on a border.
 *
 * Tests: test_regions.c.
 */
#ifndef ASBDPT_TABLES_REGIONS_H
#define ASBDPT_TABLES_REGIONS_H

#include <stddef.h>
#include <stdint.h>

#include "base/vec.h"
#include "tables/table.h"

enum { REGION_LEVELS = 4 };

struct regions {
    vec3 origin;              /* corner of cube (0,0,0) */
    double per_metre;         /* cubes of level 0 per unit of length */
    int last[3];              /* the last cube along each axis */
    int limit;                /* largest number of regions */
    uint64_t *key;            /* [n_slots] level, coordinates of the cube and face, packed; 0: free; owned */
    int *number;              /* [n_slots] of the region with this key; owned */
    size_t n_slots;           /* a power of 2, at least 2 limit; 0: there is only region 0 */
    int *above, *level;       /* [limit] the tree of regions (struct axis); owned */
    int n;                    /* number of regions of all levels, >= 1 */
};

static inline struct axis regions_axis(const struct regions *r) { return (struct axis){r->n, r->above, r->level}; }

/* regions_init: start with region 0 alone. The diagonal of the box from `low` to `high` is `cubes` cubes of level 0
 * long. Points outside the box belong to the outermost cubes. */
void regions_init(struct regions *r, vec3 low, vec3 high, int cubes, int limit);
void regions_free(struct regions *r);

/* regions_key: the key of the region of level 0 of a surface point. `side` is the unit normal of its side, or 0 for a
 * point within a medium. */
uint64_t regions_key(const struct regions *r, vec3 p, vec3 side);

/* regions_add: the number of a region of level 0. If it is new, add it and those that contain it. If that exceeds the
 * limit, return the finest known region that contains it. */
int regions_add(struct regions *r, uint64_t key);

/* regions_find: the number of the finest known region that contains the region of a key. */
int regions_find(const struct regions *r, uint64_t key);

/* region_at: the same for a surface point. */
static inline int region_at(const struct regions *r, vec3 p, vec3 side)
{
    return r->n_slots > 0 ? regions_find(r, regions_key(r, p, side)) : 0;
}

#endif
