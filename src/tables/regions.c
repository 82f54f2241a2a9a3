/* regions.c: see regions.h. */
#include "tables/regions.h"

#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/mem.h"
#include "base/number.h"

/* A key: level (2 bits), face (3 bits, never 0), x, y, z (19 bits each). */
enum { AXIS_BITS = 19, FACE_SHIFT = 3 * AXIS_BITS, LEVEL_SHIFT = FACE_SHIFT + 3 };

void regions_init(struct regions *r, vec3 low, vec3 high, int cubes, int limit)
{
    const double SHIFT = 0.3819660112501051; /* in cubes; 2 minus the golden ratio */
    vec3 size = sub(high, low);
    double diagonal = sqrt(length2(size));
    memset(r, 0, sizeof *r);
    r->per_metre = diagonal > 0 ? cubes / diagonal : 1;
    double shift = SHIFT / r->per_metre;
    r->origin = sub(low, vec(shift, shift, shift));
    r->last[0] = int_within((size.x + shift) * r->per_metre, 0, cubes);
    r->last[1] = int_within((size.y + shift) * r->per_metre, 0, cubes);
    r->last[2] = int_within((size.z + shift) * r->per_metre, 0, cubes);
    r->limit = limit;
    for (r->n_slots = 1; r->n_slots < 2 * (size_t)limit; r->n_slots *= 2)
        ;
    r->key = mem_alloc(r->n_slots, sizeof *r->key);
    r->number = mem_alloc(r->n_slots, sizeof *r->number);
    r->above = mem_alloc((size_t)limit, sizeof *r->above);
    r->level = mem_alloc((size_t)limit, sizeof *r->level);
    r->level[r->n++] = REGION_LEVELS;
}

void regions_free(struct regions *r)
{
    free(r->key);
    free(r->number);
    free(r->above);
    free(r->level);
}

/* 1..6: the axis and sign nearest to a unit normal; 7 if there is no normal. */
static uint64_t face_of(vec3 n)
{
    double x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
    if (x >= y && x >= z)
        return n.x > 0 ? 1 : n.x < 0 ? 2 : 7;
    if (y >= z)
        return n.y > 0 ? 3 : 4;
    return n.z > 0 ? 5 : 6;
}

uint64_t regions_key(const struct regions *r, vec3 p, vec3 side)
{
    vec3 c = mul(sub(p, r->origin), r->per_metre);
    uint64_t x = (uint64_t)int_within(c.x, 0, r->last[0]), y = (uint64_t)int_within(c.y, 0, r->last[1]);
    uint64_t z = (uint64_t)int_within(c.z, 0, r->last[2]);
    return face_of(side) << FACE_SHIFT | x << 2 * AXIS_BITS | y << AXIS_BITS | z;
}

/* The key of the region of the next level that contains it: all coordinates halved. */
static uint64_t key_above(uint64_t key)
{
    const uint64_t HALF = ((uint64_t)1 << (AXIS_BITS - 1)) - 1, XYZ = ((uint64_t)1 << FACE_SHIFT) - 1;
    const uint64_t HALVES = HALF << 2 * AXIS_BITS | HALF << AXIS_BITS | HALF;
    return (key >> 1 & HALVES) | ((key & ~XYZ) + ((uint64_t)1 << LEVEL_SHIFT));
}

/* The slot of the key, or the free slot for it. */
static size_t slot_of(const struct regions *r, uint64_t key)
{
    size_t mask = r->n_slots - 1, i = (size_t)hash_mix(key) & mask;
    while (r->key[i] != 0 && r->key[i] != key)
        i = (i + 1) & mask;
    return i;
}

/* Add a region of the given level, after those that contain it. */
static int add_region(struct regions *r, uint64_t key, int level)
{
    size_t slot = slot_of(r, key);
    if (r->key[slot] == key)
        return r->number[slot];
    int above = level + 1 < REGION_LEVELS ? add_region(r, key_above(key), level + 1) : 0;
    if (r->n >= r->limit)
        return above;
    slot = slot_of(r, key); /* which those above may have taken */
    r->key[slot] = key;
    r->number[slot] = r->n;
    r->above[r->n] = above;
    r->level[r->n] = level;
    return r->n++;
}

int regions_add(struct regions *r, uint64_t key) { return add_region(r, key, 0); }

int regions_find(const struct regions *r, uint64_t key)
{
    for (int level = 0; level < REGION_LEVELS; level++, key = key_above(key)) {
        size_t slot = slot_of(r, key);
        if (r->key[slot] == key)
            return r->number[slot];
    }
    return 0;
}
