/* kd_build.c: the kd-tree's builder, [Wald & Havran 2006], O(N log N).
 *
 * Where a ray that crosses a cell of surface S meets a part of it of surface S' with probability S'/S, a cell
 * cut into parts with n0 and n1 primitives costs
 *     C = TRAVERSE + TEST (n0 S0 + n1 S1) / S,        against TEST n if it stays a leaf          [W&H eq. 2, 5]
 * C has its minima where a primitive's box begins or ends. These places are the events, kept sorted for each
 * axis. They are sorted once: a primitive on one side of the plane keeps its events and their order; only one
 * that the plane cuts is clipped to each side, and its few new events are sorted and merged in.
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
#ifndef KT
#define KT 1.0
#define KI 1.5
#define KE 0.8
#endif
static const double TRAVERSE = KT, TEST = KI, EMPTY_FACTOR = KE;

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

enum side { SIDE_BOTH, SIDE_LOWER, SIDE_UPPER };

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
    l->e = mem_grow(l->e, &l->capacity, l->n + 1, sizeof *l->e);
    l->e[l->n++] = e;
}

/* Merge sort that starts from short runs sorted by insertion. */
static void sort_events(struct list *l, struct list *spare)
{
    enum { RUN = 12 };
    size_t n = l->n;
    spare->e = mem_grow(spare->e, &spare->capacity, n, sizeof *spare->e);
    for (size_t start = 0; start < n; start += RUN)
        for (size_t i = start + 1; i < n && i < start + RUN; i++) {
            uint64_t x = l->e[i];
            size_t k = i;
            for (; k > start && l->e[k - 1] > x; k--)
                l->e[k] = l->e[k - 1];
            l->e[k] = x;
        }
    uint64_t *from = l->e, *to = spare->e;
    for (size_t run = RUN; run < n; run *= 2) {
        for (size_t start = 0; start < n; start += 2 * run) {
            size_t middle = start + run < n ? start + run : n, end = middle + run < n ? middle + run : n;
            size_t a = start, b = middle;
            for (size_t k = start; k < end; k++)
                to[k] = b == end || (a < middle && from[a] < from[b]) ? from[a++] : from[b++];
        }
        uint64_t *swap = from;
        from = to;
        to = swap;
    }
    if (from != l->e)
        memcpy(l->e, from, n * sizeof *from);
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

/* Cost of a cut, times S. */
static double cut_cost(double s, double s0, double s1, size_t n0, size_t n1)
{
    double cost = TRAVERSE * s + TEST * (s0 * (double)n0 + s1 * (double)n1);
    return n0 == 0 || n1 == 0 ? EMPTY_FACTOR * cost : cost;
}

/* Sweep one axis; n items lie in the cell. */
static void sweep(const uint64_t *e, size_t n_events, size_t n, const struct box *cell, int axis, struct plane *best)
{
    double lo = cell->lo[axis], hi = cell->hi[axis];
    double a = (double)cell->hi[(axis + 1) % 3] - cell->lo[(axis + 1) % 3];
    double b = (double)cell->hi[(axis + 2) % 3] - cell->lo[(axis + 2) % 3];
    double s = a * b + (a + b) * (hi - lo);
    if (!(hi > lo))
        return;
    size_t below = 0, above = n; /* items not entirely above, not entirely below the plane; without flat ones */
    for (size_t i = 0; i < n_events;) {
        uint32_t place = event_place(e[i]);
        size_t count[3] = {0, 0, 0};
        for (; i < n_events && event_place(e[i]) == place; i++)
            count[event_type(e[i])]++;
        size_t flat = count[EVENT_FLAT];
        above -= count[EVENT_END] + flat;
        double x = place_position(place);
        double s0 = a * b + (a + b) * (x - lo), s1 = a * b + (a + b) * (hi - x);
        /* A plane on the cell's own face is of use only to put what lies flat in it into a cell of its own. */
        bool inside = x > lo && x < hi;
        if (inside || (flat > 0 && x <= lo)) {
            double c = cut_cost(s, s0, s1, below + flat, above);
            if (c < best->cost) {
                struct plane p = {axis, place, true, c};
                *best = p;
            }
        }
        if (flat > 0 && (inside || x >= hi)) {
            double c = cut_cost(s, s0, s1, below, above + flat);
            if (c < best->cost) {
                struct plane p = {axis, place, false, c};
                *best = p;
            }
        }
        below += count[EVENT_START] + flat;
    }
}

/* --- cutting ------------------------------------------------------------------------------------------ */

/* Mark every item of the cell as lower, upper or both, and list the last. */
static void classify(struct builder *b, const uint64_t *e, size_t n, const struct plane *p)
{
    b->cut.n = 0;
    for (size_t i = 0; i < n; i++) {
        uint32_t place = event_place(e[i]), item = event_item(e[i]);
        switch (event_type(e[i])) {
        case EVENT_START: b->side[item] = place < p->place ? SIDE_BOTH : SIDE_UPPER; break;
        case EVENT_FLAT:
            b->side[item] = place < p->place || (place == p->place && p->flat_below) ? SIDE_LOWER : SIDE_UPPER;
            break;
        case EVENT_END:
            if (place <= p->place)
                b->side[item] = SIDE_LOWER;
            else if (b->side[item] == SIDE_BOTH)
                push(&b->cut, item);
            break;
        }
    }
}

/* Bounds of the part of an item that lies in a cell. */
static bool clip_item(const struct geometry *geo, uint32_t item, const struct box *cell, struct box *out)
{
    if (item < (uint32_t)geo->n_triangles) {
        float v[9];
        shape_vertices(geo, (int)item, v);
        return kd_clip_triangle(v, cell, out);
    }
    shape_bounds(geo, FIRST_QUADRIC + (int)item - geo->n_triangles, out->lo, out->hi);
    for (int k = 0; k < 3; k++) {
        out->lo[k] = fmaxf(out->lo[k], cell->lo[k]);
        out->hi[k] = fminf(out->hi[k], cell->hi[k]);
        if (out->lo[k] > out->hi[k])
            return false;
    }
    return true;
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

/* New events of all items that are cut, in builder.fresh. */
static void clip_cut_items(struct builder *b, const struct box cell[2])
{
    for (int s = 0; s < 2; s++) {
        for (int k = 0; k < 3; k++)
            b->fresh[s][k].n = 0;
        for (size_t i = 0; i < b->cut.n; i++) {
            struct box part;
            if (clip_item(b->geo, (uint32_t)b->cut.e[i], &cell[s], &part))
                push_item(b->fresh[s], (uint32_t)b->cut.e[i], &part);
        }
        for (int k = 0; k < 3; k++)
            sort_events(&b->fresh[s][k], &b->spare);
    }
}

/* Append to builder.work what one side inherits from e[0..n), merged with its fresh events. */
static size_t inherit(struct builder *b, size_t at, size_t n, enum side side, const struct list *fresh)
{
    struct list *w = &b->work;
    size_t start = w->n, f = 0;
    w->e = mem_grow(w->e, &w->capacity, w->n + n + fresh->n, sizeof *w->e);
    uint64_t *out = w->e + start;
    for (const uint64_t *e = w->e + at, *end = e + n; e < end; e++) {
        if (b->side[event_item(*e)] != side)
            continue;
        while (f < fresh->n && fresh->e[f] < *e)
            *out++ = fresh->e[f++];
        *out++ = *e;
    }
    while (f < fresh->n)
        *out++ = fresh->e[f++];
    w->n = (size_t)(out - w->e);
    return w->n - start;
}

/* Replace the cell's events, the top of the stack, by the upper part's and, on top, the lower part's. */
static void distribute(struct builder *b, const struct span *whole, struct span part[2])
{
    size_t base = whole->at[0], top = b->work.n;
    for (int s = 1; s >= 0; s--)
        for (int k = 0; k < 3; k++) {
            part[s].at[k] = b->work.n - (top - base);
            part[s].n[k] = inherit(b, whole->at[k], whole->n[k], s == 0 ? SIDE_LOWER : SIDE_UPPER, &b->fresh[s][k]);
        }
    memmove(b->work.e + base, b->work.e + top, (b->work.n - top) * sizeof *b->work.e);
    b->work.n -= top - base;
}

/* --- the tree ----------------------------------------------------------------------------------------- */

/* Items of a cell: each has one START or FLAT event on every axis. */
static size_t count_items(const uint64_t *e, size_t n)
{
    size_t items = 0;
    for (size_t i = 0; i < n; i++)
        items += event_type(e[i]) != EVENT_END;
    return items;
}

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

/* Build the cell whose events are on top of the stack; they are gone afterwards. */
static void build_cell(struct builder *b, uint32_t node, struct box cell, struct span span, int depth)
{
    const uint64_t *e = b->work.e;
    size_t n = count_items(e + span.at[0], span.n[0]);
    double s = half_area(&cell), share = b->root_area > 0 ? s / b->root_area : 1;
    struct plane p = {-1, 0, false, TEST * (double)n * s};
    if (depth < b->max_depth)
        for (int k = 0; k < 3; k++)
            sweep(e + span.at[k], span.n[k], n, &cell, k, &p);
    if (depth > b->kd->depth)
        b->kd->depth = depth;
    if (p.axis < 0) {
        make_leaf(b, node, e + span.at[0], span.n[0], n);
        b->kd->cost += share * TEST * (double)n;
        b->work.n = span.at[0];
        return;
    }
    struct box part[2] = {cell, cell};
    struct span events[2];
    part[0].hi[p.axis] = part[1].lo[p.axis] = place_position(p.place);
    classify(b, e + span.at[p.axis], span.n[p.axis], &p);
    clip_cut_items(b, part);
    distribute(b, &span, events);
    b->kd->cost += share * TRAVERSE;
    uint32_t child = add_children(b, node, &p);
    build_cell(b, child, part[0], events[0], depth + 1);
    build_cell(b, child + 1, part[1], events[1], depth + 1);
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
        build_cell(&b, 0, bounds, span, 0);
        kd->item = mem_alloc((size_t)kd->n_items, sizeof *kd->item);
        for (int i = 0; i < kd->n_items; i++)
            kd->item[i] = make_item(geo, b.leaf_item[i]);
    }
    memcpy(kd->lo, bounds.lo, sizeof kd->lo);
    memcpy(kd->hi, bounds.hi, sizeof kd->hi);
    free_builder(&b);
}
