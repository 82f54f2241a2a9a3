/* kd_build.c: the kd-tree's builder: cells are cut where the surface-area heuristic says so (kd_plane.h), until a leaf
 * is cheaper. A triangle that the plane cuts is clipped to both parts, so that a cell holds only what really passes. */
#include <stdlib.h>
#include <string.h>

#include "base/maths.h"
#include "base/mem.h"
#include "geometry/kd_block.h"
#include "geometry/kd_plane.h"
#include "geometry/kdtree.h"

/* References per item at most. Meshes need 2 to 4; a heap of long needles would ask for ever more. And of all, so that
 * blocks and nodes can be numbered. */
static const double MAX_REFERENCES = 32, MOST_REFERENCES = 1u << 31;
enum { MOST_NODES = 1 << 30 };

struct builder {
    const struct geometry *geo;
    struct kdtree *kd;
    uint32_t *leaf_item; /* the primitives of the leaves in blocks of KD_LANES, filled up with KD_NONE */
    size_t n_leaf_items, node_capacity, leaf_capacity;
    int max_depth;
};

/* A cell still to be built. */
struct kd_cell {
    struct box box;
    struct kd_ref *ref; /* [n] its items, owned */
    size_t n;
    double room; /* how many references its leaves may hold together */
    int depth;
};

/* The two parts of an item that the plane cuts; a quadric or instance is represented by its bounding box. */
static void split_item(const struct geometry *geo, const struct kd_ref *whole, const struct box *cell,
                       const struct kd_plane *p, struct kd_ref half[2], bool filled[2])
{
    if (whole->item < FIRST_QUADRIC) {
        float v[9];
        struct box part[2];
        shape_vertices(geo, (int)whole->item, v);
        kd_split_triangle(v, cell, p->axis, p->at, part, filled);
        half[0].box = part[0];
        half[1].box = part[1];
        return;
    }
    half[0].box.hi[p->axis] = half[1].box.lo[p->axis] = p->at;
    if (whole->item < FIRST_CURVE || whole->item >= FIRST_INSTANCE)
        return;
    for (int i = 0; i < 2; i++) {
        const struct box in = half[i].box;
        filled[i] = curve_bounds(&geo->curves, (int)whole->item - FIRST_CURVE, in.lo, in.hi, half[i].box.lo,
                                 half[i].box.hi);
    }
}

/* Split the items of a cell between its parts, which have room for them. */
static void split_items(const struct geometry *geo, const struct kd_cell *cell, const struct kd_plane *p,
                        struct kd_cell part[2])
{
    part[0].n = part[1].n = 0;
    for (const struct kd_ref *whole = cell->ref; whole < cell->ref + cell->n; whole++) {
        bool in[2] = {kd_is_below(whole, p), kd_is_above(whole, p)};
        struct kd_ref half[2] = {*whole, *whole};
        if (in[0] && in[1])
            split_item(geo, whole, &cell->box, p, half, in);
        for (int s = 0; s < 2; s++)
            if (in[s])
                part[s].ref[part[s].n++] = half[s];
    }
}

/* The blocks of a leaf: first those of triangles, then those of quadrics and curves, then those of instances. */
static void make_leaf(struct builder *b, uint32_t node, const struct kd_cell *cell)
{
    struct kdtree *kd = b->kd;
    const struct kd_ref *ref = cell->ref;
    size_t first = b->n_leaf_items, n = 0;
    b->leaf_item = mem_grow(b->leaf_item, &b->leaf_capacity, first + cell->n + 3 * KD_LANES, sizeof *b->leaf_item);
    for (int kind = 0; kind < 3; kind++) {
        for (size_t i = 0; i < cell->n; i++)
            if ((ref[i].item >= FIRST_QUADRIC) + (ref[i].item >= FIRST_INSTANCE) == kind)
                b->leaf_item[first + n++] = ref[i].item;
        while (n % KD_LANES != 0)
            b->leaf_item[first + n++] = KD_NONE;
    }
    kd->node[node].word = (uint32_t)(n / KD_LANES) << 2 | KD_LEAF;
    kd->node[node].at.first = (uint32_t)(first / KD_LANES);
    b->n_leaf_items += n;
}

/* Two neighbouring nodes; returns the first. */
static uint32_t add_children(struct builder *b, uint32_t parent, const struct kd_plane *p)
{
    struct kdtree *kd = b->kd;
    uint32_t first = (uint32_t)kd->n_nodes;
    kd->node = mem_grow(kd->node, &b->node_capacity, (size_t)kd->n_nodes + 2, sizeof *kd->node);
    kd->n_nodes += 2;
    kd->node[parent].word = (first >> 1) << 2 | (uint32_t)p->axis;
    kd->node[parent].at.split = p->at;
    return first;
}

/* Cut a cell in two, and its room in proportion; false, with nothing changed, where it is to be a leaf. */
static bool cut_cell(struct builder *b, const struct kd_cell *cell, struct kd_plane *p, struct kd_cell part[2])
{
    size_t n[2] = {0, 0};
    if (cell->depth >= b->max_depth || b->kd->n_nodes >= MOST_NODES)
        return false;
    *p = kd_best_plane(cell->ref, cell->n, &cell->box);
    if (p->axis < 0)
        return false;
    for (size_t i = 0; i < cell->n; i++) {
        n[0] += kd_is_below(&cell->ref[i], p);
        n[1] += kd_is_above(&cell->ref[i], p);
    }
    if ((double)(n[0] + n[1]) > cell->room)
        return false;
    part[0] = part[1] = *cell;
    part[0].box.hi[p->axis] = part[1].box.lo[p->axis] = p->at;
    for (int s = 0; s < 2; s++) {
        part[s].ref = mem_alloc(n[s], sizeof *part[s].ref);
        part[s].room = cell->room * (double)n[s] / (double)(n[0] + n[1]);
        part[s].depth = cell->depth + 1;
    }
    split_items(b->geo, cell, p, part);
    return true;
}

/* Build what is below a node, and free the cell's items. */
static void build_cell(struct builder *b, uint32_t node, const struct kd_cell *cell)
{
    struct kd_plane p;
    struct kd_cell part[2];
    bool cut = cut_cell(b, cell, &p, part);
    if (!cut)
        make_leaf(b, node, cell);
    free(cell->ref);
    if (!cut)
        return;
    uint32_t child = add_children(b, node, &p);
    for (uint32_t s = 0; s < 2; s++)
        build_cell(b, child + s, &part[s]);
}

static bool has(enum kd_of kind, const struct shape_group *group)
{
    if (kind == KD_SURFACES || group->material >= 0)
        return kind == KD_SURFACES && group->material >= 0;
    return kind == KD_LAMPS ? group->first_light >= 0 : shape_is_interface(group);
}

/* Add primitives to the cell of everything. */
static void add_prims(const struct geometry *geo, int first, int n, struct kd_cell *root)
{
    for (int i = 0; i < n; i++) {
        struct box *all = &root->box, *box = &root->ref[root->n].box;
        root->ref[root->n].item = (uint32_t)(first + i);
        shape_bounds(geo, first + i, box->lo, box->hi);
        for (int k = 0; k < 3; k++) {
            all->lo[k] = root->n == 0 || box->lo[k] < all->lo[k] ? box->lo[k] : all->lo[k];
            all->hi[k] = root->n == 0 || box->hi[k] > all->hi[k] ? box->hi[k] : all->hi[k];
        }
        root->n++;
    }
}

/* Of an object, or of the world (NULL). */
static struct kd_cell root_cell(const struct geometry *geo, enum kd_of kind, const struct object *object)
{
    struct kd_cell root = {.box = {{1, 1, 1}, {-1, -1, -1}}};
    int first = object != NULL ? object->first_group : 0, end = object != NULL ? object->end_group : geo->n_groups;
    size_t most = (size_t)geo->n_instances;
    for (int g = first; g < end; g++)
        most += (size_t)geo->group[g].n_prims;
    root.ref = mem_alloc(most, sizeof *root.ref);
    for (int g = first; g < end; g++)
        if (has(kind, &geo->group[g]) && geo->group[g].shared == (object != NULL))
            add_prims(geo, geo->group[g].first_prim, geo->group[g].n_prims, &root);
    if (kind == KD_SURFACES && object == NULL)
        add_prims(geo, FIRST_INSTANCE, geo->n_instances, &root);
    root.room = fmin(MAX_REFERENCES * (double)root.n, MOST_REFERENCES);
    return root;
}

/* n <= KD_LANES primitives of one kind. */
static void fill_block(struct kd_block *b, const struct geometry *geo, const int *prim, int n)
{
    for (int lane = 0; lane < KD_LANES; lane++) {
        bool triangle = lane < n && prim[lane] < FIRST_QUADRIC;
        float v[9] = {0};
        b->prim[lane] = lane < n ? (uint32_t)prim[lane] : KD_NONE;
        if (triangle) {
            const struct shape_group *group = shape_group_of(geo, prim[lane]);
            if (geo->opaque != NULL && group->alpha >= 0)
                b->prim[lane] |= KD_ALPHA;
            shape_vertices(geo, prim[lane], v);
        }
        b->reach[lane] = KD_TINY;
        for (int i = 0; i < 9; i++)
            b->reach[lane] = fmaxf(b->reach[lane], 8 * fabsf(v[i] - v[(i + 3) % 9]));
        for (int i = 0; i < 9; i++)
            b->v[i / 3][i % 3][lane] = lane < n ? v[i] : NAN;
    }
}

static void fill_blocks(struct builder *b)
{
    struct kdtree *kd = b->kd;
    kd->n_blocks = (int)(b->n_leaf_items / KD_LANES);
    kd->block = mem_alloc((size_t)kd->n_blocks, sizeof *kd->block);
    for (size_t i = 0; i < b->n_leaf_items; i += KD_LANES) {
        int prim[KD_LANES], n = 0;
        while (n < KD_LANES && b->leaf_item[i + (size_t)n] != KD_NONE) {
            prim[n] = (int)b->leaf_item[i + (size_t)n];
            n++;
        }
        fill_block(&kd->block[i / KD_LANES], b->geo, prim, n);
    }
}

/* The tree of an object, or of the world (NULL). */
static void build(struct kdtree *kd, const struct geometry *geo, enum kd_of kind, const struct object *object)
{
    struct builder b = {.geo = geo, .kd = kd};
    struct kd_cell root = root_cell(geo, kind, object);
    struct box bounds = root.box;
    memset(kd, 0, sizeof *kd);
    if (root.n > 0) {
        /* n is 1 to 2^31, so this is 8 to KD_MAX_DEPTH. */
        b.max_depth = (int)fmin(KD_MAX_DEPTH, 8 + 2.0 * m_log2((double)root.n));
        kd->node = mem_grow(NULL, &b.node_capacity, 2, sizeof *kd->node);
        kd->n_nodes = 2;
        build_cell(&b, 0, &root);
        fill_blocks(&b);
        free(b.leaf_item);
    } else {
        free(root.ref);
    }
    memcpy(kd->lo, bounds.lo, sizeof kd->lo);
    memcpy(kd->hi, bounds.hi, sizeof kd->hi);
    for (int k = 0; k < 3; k++)
        kd->reach = fmax(kd->reach, fmax(fabs((double)kd->lo[k]), fabs((double)kd->hi[k])));
}

void kd_build(struct kdtree *kd, const struct geometry *geo, enum kd_of kind)
{
    build(kd, geo, kind, NULL);
    if (kind != KD_SURFACES)
        return;
    kd->n_objects = geo->n_objects;
    kd->object = mem_alloc((size_t)geo->n_objects, sizeof *kd->object);
    for (int i = 0; i < geo->n_objects; i++)
        build(&kd->object[i], geo, kind, &geo->object[i]);
}
