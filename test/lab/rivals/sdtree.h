/* sdtree.h: where light comes from, by place and direction.                                         [Mueller 2017 3]
 *
 * A binary tree halves a cube of space, along x, y, z in turn. Each of its leaves has quadtrees over the square of all
 * directions, (u,v) = ((1 - cos theta) / 2, phi / 2 pi), where equal areas are equal solid angles. Directions are drawn
 * from `known`, which is from the pass before. `next` is filled by the running pass and then becomes `known`. Sums
 * depend on the order in which records are added, which the caller has to fix.
 *
 * Tests: test_rival_parts.c.
 */
#ifndef ASBDPT_SDTREE_H
#define ASBDPT_SDTREE_H

#include "base/vec.h"

struct quadtree {
    struct quad {
        double sum[4]; /* of light in each quarter: number 1 has the larger u, 2 the larger v, 3 both */
        int child[4];  /* 0: none, the quarter is a cell */
    } *node;           /* [n], the first is the whole square; owned */
    int n;
    double total;
};

struct sd_leaf {
    struct quadtree known, next;
    double records;     /* of this pass; just after the leaf was halved, half of them */
    double share;       /* of directions that the BSDF draws; 1: all, no light is known */
    double slope, bend; /* derivatives of what the share should maximise, sums over the records */
};

struct sdtree {
    vec3 low;
    double side; /* of the cube */
    struct sd_node {
        int child[2]; /* 0: none, the node has a leaf */
        struct sd_leaf leaf;
    } *node; /* [n], owned */
    int n;
};

/* sdtree_init: one leaf without records, the cube around a box. sdtree_free releases what the tree owns. */
void sdtree_init(struct sdtree *t, vec3 low, vec3 high);
void sdtree_free(struct sdtree *t);

/* sdtree_find: the number of the leaf's node at p; outside the cube, at its nearest point.
 *   size  out, edges of the leaf's box; may be NULL */
int sdtree_find(const struct sdtree *t, vec3 p, vec3 *size);

/* sd_add_record: a path left the place in some direction.
 *   contribution  radiance from there times BSDF and cosine, over density
 *   odds          p_bsdf / (p_bsdf + p_guide), of the densities with which each alone would draw it
 * sd_add_light: and radiance over density is not 0. */
void sd_add_record(struct sd_leaf *leaf, double contribution, double odds);
void sd_add_light(struct sd_leaf *leaf, double u, double v, double light);

/* sdtree_build: the pass is over: `next` becomes `known`, unless it has no light. Then, for another pass, halve leaves
 * until none has more than `most` records, and divide `next` until no cell has much of the light that is known. */
void sdtree_build(struct sdtree *t, double most);

/* quadtree_draw: a direction, unit, by two uniform numbers in [0,1); total > 0.
 * quadtree_pdf: its density, 1/sr; 0 where no light came from. */
vec3 quadtree_draw(const struct quadtree *q, const double u[2]);
double quadtree_pdf(const struct quadtree *q, vec3 w);

#endif
