/* kd_build.c: the kd-tree's builder, [Wald & Havran 2006], O(N log N).
 *
 * Where a ray that crosses a cell of surface S meets a part of it of surface S' with probability S'/S, a cell
 * cut into parts with n0 and n1 primitives costs
 *     C = TRAVERSE + TEST (n0 S0 + n1 S1) / S,        against TEST n if it stays a leaf          [W&H eq. 2, 5]
 * C has its minima where a primitive's box begins or ends. These places are the events, kept sorted for each
 * axis. They are sorted once: a primitive on one side of the plane keeps its events and their order; only one
 * that the plane cuts is clipped to each side, and its few new events are sorted and merged in.
 *
 * The costs are in units of one triangle test; TRAVERSE stands for a node's visit with its share of cache misses.
 *
 * An event is one 64-bit number whose order is the order wanted: the position's bits, made monotonic, then the
 * type, then the item (triangles first, then quadrics, numbered without a gap).
 */
#include <stdlib.h>
#include <string.h>

#include "kd_clip.h"
#include "kd_node.h"
#include "kdtree.h"
#include "mem.h"

/* Costs relative to each other, found by measurement, and what cutting off empty space is worth. */
static const double TRAVERSE = 1, TEST = 1, EMPTY_FACTOR = 0.8;

/* References per item at most. Meshes need 2 to 4; a heap of long needles would ask for ever more. */
static const double MAX_REFERENCES = 32;

enum event_type { EVENT_END, EVENT_FLAT, EVENT_START }; /* in the order in which a sweep must meet them */

static uint64_t event(float position, enum event_type type, uint32_t item)
{
    uint32_t bits;
    position += 0.0f; /* makes -0 equal to 0 */
    memcpy(&bits, &position, sizeof bits);
    bits ^= bits >> 31 ? 0xffffffffu : 0x80000000u;
    return (uint64_t)bits << 32 | (uint64_t)type << 30 | item;
}

static uint32_t event_place(uint64_t e) { return (uint32_t)(e >> 32); }
static enum event_type event_type(uint64_t e) { return (enum event_type)(e >> 30 & 3); }
static uint32_t event_item(uint64_t e) { return (uint32_t)e & 0x3fffffffu; }

static float place_position(uint32_t place)
{
    float position;
    place ^= place >> 31 ? 0x80000000u : 0xffffffffu;
    memcpy(&position, &place, sizeof position);
    return position;
}

/* A growing list of events. */
struct list {
    uint64_t *e;
    size_t n, capacity;
};

/* The events of a cell for the three axes: parts of builder.work, which may move. */
struct span {
    size_t at[3], n[3];
};

enum side { SIDE_LOWER, SIDE_UPPER, SIDE_BOTH };

struct builder {
    const struct geometry *geo;
    struct kdtree *kd;
    struct list work;        /* the events of the cells still to be cut, a stack */
    struct list fresh[2][3]; /* new events of clipped items: side, axis */
    struct list spare;       /* for sorting */
    struct list cut;         /* items the plane cuts */
    unsigned char *side;     /* [items] enum side, valid during one cut */
    uint32_t *leaf_item;     /* [kd->n_items] */
    size_t node_capacity, item_capacity;
    double root_area;
    int max_depth;
};

static void push(struct list *l, uint64_t e)
{
    if (l->n == l->capacity)
        l->e = mem_grow(l->e, &l->capacity, l->n + 1, sizeof *l->e);
    l->e[l->n++] = e;
}

/* Sort by position and type (the order of items does not matter): short lists by insertion, long ones by four
 * stable passes over 9 of the upper 34 bits each. */
static void sort_events(struct list *l, struct list *spare)
{
    enum { SHORT = 48, BITS = 9, BUCKETS = 1 << BITS, FIRST_BIT = 64 - 4 * BITS };
    if (l->n <= SHORT) {
        for (size_t i = 1; i < l->n; i++) {
            uint64_t x = l->e[i];
            size_t k = i;
            for (; k > 0 && l->e[k - 1] > x; k--)
                l->e[k] = l->e[k - 1];
            l->e[k] = x;
        }
        return;
    }
    spare->e = mem_grow(spare->e, &spare->capacity, l->n, sizeof *spare->e);
    for (int shift = FIRST_BIT; shift < 64; shift += BITS) {
        size_t start[BUCKETS + 1] = {0};
        for (size_t i = 0; i < l->n; i++)
            start[(l->e[i] >> shift & (BUCKETS - 1)) + 1]++;
        for (int k = 0; k < BUCKETS; k++)
            start[k + 1] += start[k];
        for (size_t i = 0; i < l->n; i++)
            spare->e[start[l->e[i] >> shift & (BUCKETS - 1)]++] = l->e[i];
        struct list swap = *l;
        l->e = spare->e;
        l->capacity = spare->capacity;
        spare->e = swap.e;
        spare->capacity = swap.capacity;
    }
}

/* --- which plane -------------------------------------------------------------------------------------- */

struct plane {
    int axis; /* -1: none */
    uint32_t place;
    bool flat_below; /* primitives lying in the plane go to the lower cell */
    double cost;
};

static double half_area(const struct box *b)
{
    double x = (double)b->hi[0] - b->lo[0], y = (double)b->hi[1] - b->lo[1], z = (double)b->hi[2] - b->lo[2];
    return x * y + y * z + z * x;
}

/* Cost of a cut, times the cell's area, as a function of its position and the items on both sides. */
struct cost {
    double fixed;         /* TRAVERSE times the cell's half area */
    double below0, slope; /* TEST times the half area below x is below0 + slope x */
    double above0;        /* and above it above0 - slope x */
};

static struct cost cost_along(const struct box *cell, int axis)
{
    double a = (double)cell->hi[(axis + 1) % 3] - cell->lo[(axis + 1) % 3];
    double b = (double)cell->hi[(axis + 2) % 3] - cell->lo[(axis + 2) % 3];
    double slope = TEST * (a + b), face = TEST * a * b;
    struct cost c = {TRAVERSE * half_area(cell), face - slope * cell->lo[axis], slope,
                     face + slope * cell->hi[axis]};
    return c;
}

static inline double cut_cost(const struct cost *c, double x, double below, double above)
{
    double cost = c->fixed + (c->below0 + c->slope * x) * below + (c->above0 - c->slope * x) * above;
    return below * above == 0 ? EMPTY_FACTOR * cost : cost;
}

static inline void consider(struct plane *best, double cost, int axis, uint32_t place, bool flat_below)
{
    if (cost < best->cost) {
        best->cost = cost;
        best->axis = axis;
        best->place = place;
        best->flat_below = flat_below;
    }
}

/* Count the flat items at the position of e[*i] and move *i behind them. */
static double skip_flat(const uint64_t *e, size_t n, size_t *i)
{
    size_t start = *i;
    while (*i < n && e[*i] >> 30 == e[start] >> 30)
        ++*i;
    return (double)(*i - start);
}

/* Sweep one axis of a cell of n_items for a plane cheaper than *best. Where several items begin or end at one
 * position, all but one of the costs computed there are too high, which does no harm and saves looking ahead. A
 * plane on the cell's own face is of use only to put what lies flat in it into a cell of its own. */
static void sweep(const uint64_t *e, size_t n, double n_items, const struct box *cell, int axis, struct plane *best)
{
    const struct cost c = cost_along(cell, axis);
    const uint32_t first = event_place(event(cell->lo[axis], EVENT_END, 0));
    const uint32_t last = event_place(event(cell->hi[axis], EVENT_END, 0));
    double below = 0, above = n_items; /* items with a part below, above the plane */
    size_t i = 0;
    if (first == last)
        return;
    while (i < n && event_place(e[i]) < last) {
        enum event_type type = event_type(e[i]);
        uint32_t place = event_place(e[i]);
        double x = place_position(place);
        if (type == EVENT_FLAT) {
            double flat = skip_flat(e, n, &i);
            above -= flat;
            consider(best, cut_cost(&c, x, below + flat, above), axis, place, true);
            if (place > first)
                consider(best, cut_cost(&c, x, below, above + flat), axis, place, false);
            below += flat;
        } else {
            above -= type == EVENT_END;
            if (place > first)
                consider(best, cut_cost(&c, x, below, above), axis, place, true);
            below += type == EVENT_START;
            i++;
        }
    }
    while (i < n && event_type(e[i]) == EVENT_END)
        i++;
    if (i < n)
        consider(best, cut_cost(&c, cell->hi[axis], below, skip_flat(e, n, &i)), axis, last, false);
}

/* --- cutting ------------------------------------------------------------------------------------------ */

/* Mark every item of the cell as lower, upper or both, and list the last; n[side] counts the others. */
static void classify(struct builder *b, const uint64_t *e, size_t n_events, const struct plane *p, size_t n[2])
{
    b->cut.n = n[SIDE_LOWER] = n[SIDE_UPPER] = 0;
    for (size_t i = 0; i < n_events; i++) {
        uint32_t place = event_place(e[i]), item = event_item(e[i]);
        switch (event_type(e[i])) {
        case EVENT_START:
            b->side[item] = place < p->place ? SIDE_BOTH : SIDE_UPPER;
            n[SIDE_UPPER] += place >= p->place;
            break;
        case EVENT_FLAT:
            b->side[item] = place < p->place || (place == p->place && p->flat_below) ? SIDE_LOWER : SIDE_UPPER;
            n[b->side[item]]++;
            break;
        case EVENT_END:
            if (place <= p->place) {
                b->side[item] = SIDE_LOWER;
                n[SIDE_LOWER]++;
            } else if (b->side[item] == SIDE_BOTH) {
                push(&b->cut, item);
            }
            break;
        }
    }
}

/* Bounds of the two parts of an item that the plane cuts; a quadric is represented by its bounding box. */
static void split_item(const struct geometry *geo, uint32_t item, const struct box *cell, int axis, float split,
                       struct box part[2], bool filled[2])
{
    if (item < (uint32_t)geo->n_triangles) {
        float v[9];
        shape_vertices(geo, (int)item, v);
        kd_split_triangle(v, cell, axis, split, part, filled);
        return;
    }
    struct box box;
    shape_bounds(geo, FIRST_QUADRIC + (int)item - geo->n_triangles, box.lo, box.hi);
    for (int k = 0; k < 3; k++) {
        box.lo[k] = fmaxf(box.lo[k], cell->lo[k]);
        box.hi[k] = fminf(box.hi[k], cell->hi[k]);
    }
    filled[0] = filled[1] = true;
    part[0] = part[1] = box;
    part[0].hi[axis] = part[1].lo[axis] = split;
}

static void push_item(struct list lists[3], uint32_t item, const struct box *bounds)
{
    for (int k = 0; k < 3; k++) {
        if (bounds->lo[k] < bounds->hi[k]) {
            push(&lists[k], event(bounds->lo[k], EVENT_START, item));
            push(&lists[k], event(bounds->hi[k], EVENT_END, item));
        } else {
            push(&lists[k], event(bounds->lo[k], EVENT_FLAT, item));
        }
    }
}

/* New events of all items that are cut, in builder.fresh; counts the items of the two parts in n. */
static void split_cut_items(struct builder *b, const struct box *cell, int axis, float split, size_t n[2])
{
    for (int i = 0; i < 6; i++)
        b->fresh[i / 3][i % 3].n = 0;
    for (size_t i = 0; i < b->cut.n; i++) {
        struct box part[2];
        bool filled[2];
        split_item(b->geo, (uint32_t)b->cut.e[i], cell, axis, split, part, filled);
        for (int s = 0; s < 2; s++)
            if (filled[s]) {
                push_item(b->fresh[s], (uint32_t)b->cut.e[i], &part[s]);
                n[s]++;
            }
    }
    for (int i = 0; i < 6; i++)
        sort_events(&b->fresh[i / 3][i % 3], &b->spare);
}

/* Merge fresh events into the sorted e[0..n), from the back; the room is there. Returns the new length. */
static size_t merge(uint64_t *e, size_t n, const struct list *fresh)
{
    size_t total = n + fresh->n, to = total;
    for (size_t f = fresh->n; f > 0;)
        e[--to] = n > 0 && e[n - 1] > fresh->e[f - 1] ? e[--n] : fresh->e[--f];
    return total;
}

/* Deal the events e[0..n) of uncut items out to the two sides, and add the fresh ones. out[s] is moved to the end
 * of what was written; the place it points to may be written to as well. */
static void deal(const struct builder *b, int axis, const uint64_t *e, size_t n, uint64_t *out[2])
{
    uint64_t *lower = out[0], *upper = out[1];
    for (size_t i = 0; i < n; i++) {
        int side = b->side[event_item(e[i])];
        *lower = *upper = e[i];
        lower += side == SIDE_LOWER;
        upper += side == SIDE_UPPER;
    }
    out[0] += merge(out[0], (size_t)(lower - out[0]), &b->fresh[0][axis]);
    out[1] += merge(out[1], (size_t)(upper - out[1]), &b->fresh[1][axis]);
}

/* Replace the cell's events, the top of the stack, by the upper part's and, on top, the lower part's; n[s] items
 * are in part s, so it has at most twice as many events on each axis. */
static void distribute(struct builder *b, const struct span *whole, const size_t n[2], struct span part[2])
{
    struct list *w = &b->work;
    size_t base = whole->at[0], top = w->n, room[2] = {6 * n[0] + 1, 6 * n[1] + 1};
    w->e = mem_grow(w->e, &w->capacity, top + room[0] + room[1], sizeof *w->e);
    uint64_t *out[2] = {w->e + top + room[1], w->e + top};
    for (int k = 0; k < 3; k++) {
        const uint64_t *start[2] = {out[0], out[1]};
        deal(b, k, w->e + whole->at[k], whole->n[k], out);
        for (int s = 0; s < 2; s++) {
            part[s].at[k] = (size_t)(start[s] - w->e);
            part[s].n[k] = (size_t)(out[s] - start[s]);
        }
    }
    for (int s = 1; s >= 0; s--) {
        size_t from = part[s].at[0], size = (size_t)(out[s] - w->e) - from;
        memmove(w->e + base, w->e + from, size * sizeof *w->e);
        for (int k = 0; k < 3; k++)
            part[s].at[k] -= from - base;
        base += size;
    }
    w->n = base;
}

/* --- the tree ----------------------------------------------------------------------------------------- */

/* Each item has one START or FLAT event on every axis. */
static void make_leaf(struct builder *b, uint32_t node, const uint64_t *e, size_t n_events, size_t n)
{
    struct kdtree *kd = b->kd;
    b->leaf_item = mem_grow(b->leaf_item, &b->item_capacity, (size_t)kd->n_items + n, sizeof *b->leaf_item);
    kd->node[node].word = (uint32_t)n << 2 | KD_LEAF;
    kd->node[node].at.first = (uint32_t)kd->n_items;
    for (size_t i = 0; i < n_events; i++)
        if (event_type(e[i]) != EVENT_END)
            b->leaf_item[kd->n_items++] = event_item(e[i]);
}

/* Two neighbouring nodes; returns the first. */
static uint32_t add_children(struct builder *b, uint32_t parent, const struct plane *p)
{
    struct kdtree *kd = b->kd;
    uint32_t first = (uint32_t)kd->n_nodes;
    kd->node = mem_grow(kd->node, &b->node_capacity, (size_t)kd->n_nodes + 2, sizeof *kd->node);
    kd->n_nodes += 2;
    kd->node[parent].word = first << 2 | (uint32_t)p->axis;
    kd->node[parent].at.split = place_position(p->place);
    return first;
}

/* A cell still to be built; its events are on top of the stack. */
struct cell {
    struct box box;
    struct span span;
    size_t n;    /* items */
    double room; /* how many references its leaves may hold together */
    int depth;
};

/* The cheapest way to cut a cell, or axis -1 if a leaf is cheaper. */
static struct plane best_plane(const struct builder *b, const struct cell *cell)
{
    struct plane best = {-1, 0, false, TEST * (double)cell->n * half_area(&cell->box)};
    for (int k = 0; k < 3 && cell->depth < b->max_depth; k++)
        sweep(b->work.e + cell->span.at[k], cell->span.n[k], (double)cell->n, &cell->box, k, &best);
    return best;
}

/* Cut a cell in two, and its room in proportion; false, with nothing changed, where it is to be a leaf. */
static bool cut_cell(struct builder *b, const struct cell *cell, struct plane *p, struct cell part[2])
{
    size_t n[2];
    struct span span[2];
    *p = best_plane(b, cell);
    if (p->axis < 0)
        return false;
    classify(b, b->work.e + cell->span.at[p->axis], cell->span.n[p->axis], p, n);
    if ((double)(n[0] + n[1] + 2 * b->cut.n) > cell->room)
        return false;
    part[0] = part[1] = *cell;
    float split = part[0].box.hi[p->axis] = part[1].box.lo[p->axis] = place_position(p->place);
    split_cut_items(b, &cell->box, p->axis, split, n);
    distribute(b, &cell->span, n, span);
    for (int s = 0; s < 2; s++) {
        part[s].span = span[s];
        part[s].n = n[s];
        part[s].room = cell->room * (double)n[s] / (double)(n[0] + n[1]);
        part[s].depth = cell->depth + 1;
    }
    return true;
}

/* Build what is below a node, taking the cell's events from the stack. */
static void build_cell(struct builder *b, uint32_t node, const struct cell *cell)
{
    struct plane p;
    struct cell part[2];
    double share = b->root_area > 0 ? half_area(&cell->box) / b->root_area : 1;
    if (cell->depth > b->kd->depth)
        b->kd->depth = cell->depth;
    if (!cut_cell(b, cell, &p, part)) {
        make_leaf(b, node, b->work.e + cell->span.at[0], cell->span.n[0], cell->n);
        b->kd->cost += share * TEST * (double)cell->n;
        b->work.n = cell->span.at[0];
        return;
    }
    b->kd->cost += share * TRAVERSE;
    uint32_t child = add_children(b, node, &p);
    build_cell(b, child, &part[0]);
    build_cell(b, child + 1, &part[1]);
}

static int prim_of_item(const struct geometry *geo, uint32_t item)
{
    return item < (uint32_t)geo->n_triangles ? (int)item : FIRST_QUADRIC + (int)item - geo->n_triangles;
}

/* Bounds of everything, and the events of all items. */
static struct span start_events(struct builder *b, struct box *bounds)
{
    struct list lists[3] = {{0}};
    struct span span;
    for (int i = 0; i < geometry_primitives(b->geo); i++) {
        struct box box;
        shape_bounds(b->geo, prim_of_item(b->geo, (uint32_t)i), box.lo, box.hi);
        push_item(lists, (uint32_t)i, &box);
        for (int k = 0; k < 3; k++) {
            bounds->lo[k] = i == 0 ? box.lo[k] : fminf(bounds->lo[k], box.lo[k]);
            bounds->hi[k] = i == 0 ? box.hi[k] : fmaxf(bounds->hi[k], box.hi[k]);
        }
    }
    for (int k = 0; k < 3; k++) {
        struct list *w = &b->work;
        sort_events(&lists[k], &b->spare);
        span.at[k] = w->n;
        span.n[k] = lists[k].n;
        w->e = mem_grow(w->e, &w->capacity, w->n + lists[k].n, sizeof *w->e);
        memcpy(w->e + w->n, lists[k].e, lists[k].n * sizeof *w->e);
        w->n += lists[k].n;
        free(lists[k].e);
    }
    return span;
}

static struct kd_item make_item(const struct geometry *geo, uint32_t item)
{
    struct kd_item out = {{0}, 0};
    int prim = prim_of_item(geo, item);
    out.prim = (uint32_t)prim;
    if (prim < FIRST_QUADRIC) {
        const struct shape_group *group = shape_group_of(geo, prim);
        shape_vertices(geo, prim, out.v);
        if (geo->opaque != NULL && (group->alpha >= 0 || group->shadow_alpha >= 0))
            out.prim |= KD_ALPHA;
    }
    return out;
}

static void free_builder(struct builder *b)
{
    for (int i = 0; i < 6; i++)
        free(b->fresh[i / 3][i % 3].e);
    free(b->work.e);
    free(b->spare.e);
    free(b->cut.e);
    free(b->side);
    free(b->leaf_item);
}

void kd_build(struct kdtree *kd, const struct geometry *geo)
{
    struct kdtree empty = {0};
    struct builder b = {0};
    struct box bounds = {{1, 1, 1}, {-1, -1, -1}};
    int n = geometry_primitives(geo);
    *kd = empty;
    b.geo = geo;
    b.kd = kd;
    if (n > 0) {
        b.side = mem_alloc((size_t)n, 1);
        struct span span = start_events(&b, &bounds);
        b.root_area = half_area(&bounds);
        b.max_depth = (int)fmin(KD_MAX_DEPTH, 8 + 2.0 * log2(n));
        kd->node = mem_grow(NULL, &b.node_capacity, 1, sizeof *kd->node);
        kd->n_nodes = 1;
        struct cell root = {bounds, span, (size_t)n, MAX_REFERENCES * n, 0};
        build_cell(&b, 0, &root);
        kd->item = mem_alloc((size_t)kd->n_items, sizeof *kd->item);
        for (int i = 0; i < kd->n_items; i++)
            kd->item[i] = make_item(geo, b.leaf_item[i]);
    }
    memcpy(kd->lo, bounds.lo, sizeof kd->lo);
    memcpy(kd->hi, bounds.hi, sizeof kd->hi);
    for (int k = 0; k < 3; k++)
        kd->reach = fmax(kd->reach, fmax(fabs((double)kd->lo[k]), fabs((double)kd->hi[k])));
    free_builder(&b);
}
