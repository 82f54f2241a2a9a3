/* grid.c: see grid.h. */
#include "base/grid.h"

#include <stdlib.h>
#include <string.h>

#include "base/bits.h"
#include "base/mem.h"
#include "base/number.h"

void grid_init(struct grid *g, vec3 center, double radius, int cells)
{
    memset(g, 0, sizeof *g);
    g->per_metre = cells / (2 * radius);
    g->origin = sub(center, vec(radius, radius, radius));
}

void grid_free(struct grid *g)
{
    free(g->slot);
    memset(g, 0, sizeof *g);
}

void grid_copy(struct grid *to, const struct grid *from)
{
    *to = *from;
    to->slot = mem_alloc(from->n_slots, sizeof *to->slot);
    if (from->n_slots > 0)
        memcpy(to->slot, from->slot, from->n_slots * sizeof *to->slot);
}

uint64_t grid_key(const struct grid *g, vec3 p, int face)
{
    const int top = 1048575; /* 20 bits per axis */
    vec3 c = mul(sub(p, g->origin), g->per_metre);
    uint64_t x = (uint64_t)int_within(c.x, 0, top), y = (uint64_t)int_within(c.y, 0, top);
    uint64_t z = (uint64_t)int_within(c.z, 0, top);
    return ((x << 43) | (y << 23) | (z << 3) | (uint64_t)face) + 1;
}

int grid_face(vec3 n)
{
    double x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
    if (x >= y && x >= z)
        return n.x > 0 ? 1 : 2;
    if (y >= z)
        return n.y > 0 ? 3 : 4;
    return n.z > 0 ? 5 : 6;
}

/* The slot that holds the key, or the free one where it belongs. */
static struct grid_slot *slot_of(const struct grid *g, uint64_t key)
{
    size_t mask = g->n_slots - 1, i = (size_t)hash_mix(key) & mask;
    while (g->slot[i].key != 0 && g->slot[i].key != key)
        i = (i + 1) & mask;
    return &g->slot[i];
}

int grid_find(const struct grid *g, uint64_t key)
{
    if (g->n_slots == 0)
        return -1;
    const struct grid_slot *s = slot_of(g, key);
    return s->key == key ? s->number : -1;
}

static void grow(struct grid *g)
{
    struct grid old = *g;
    g->n_slots = old.n_slots == 0 ? 1024 : 2 * old.n_slots;
    g->slot = mem_alloc(g->n_slots, sizeof *g->slot);
    for (size_t i = 0; i < old.n_slots; i++)
        if (old.slot[i].key != 0)
            *slot_of(g, old.slot[i].key) = old.slot[i];
    free(old.slot);
}

int grid_insert(struct grid *g, uint64_t key)
{
    if (2 * (size_t)g->n >= g->n_slots)
        grow(g);
    struct grid_slot *s = slot_of(g, key);
    if (s->key == 0) {
        s->key = key;
        s->number = g->n++;
    }
    return s->number;
}
