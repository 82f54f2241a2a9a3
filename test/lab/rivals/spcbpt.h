/* spcbpt.h: what spcbpt.c learns: classification trees, and the matrix Gamma, from paths of a path tracer. Nothing here
 * knows how paths are traced. Tests: test_rival_parts.c. */
#ifndef ASBDPT_SPCBPT_H
#define ASBDPT_SPCBPT_H

#include "transport/vertex.h"

/* What is classified: a point of a surface, and its normal. */
struct place {
    double x[6];
};
static inline struct place place_of(const struct vertex *v)
{
    vec3 n = vertex_side(v);
    return (struct place){{v->p.x, v->p.y, v->p.z, n.x, n.y, n.z}};
}

/* A node sends places with x[axis] >= at to child[1], others to child[0]. */
struct tree_node {
    int axis, child[2]; /* axis -1: a leaf */
    int label;          /* its subspace */
    double at;
};

/* tree_find: the subspace of a place; 0 without a tree. */
static inline int tree_find(const struct tree_node *node, struct place at)
{
    int i = 0;
    while (node != NULL && node[i].axis >= 0)
        i = node[i].child[at.x[node[i].axis] >= node[i].at];
    return node != NULL ? node[i].label : 0;
}

/* An edge of a training path: strategy i would connect its ends. */
struct link {
    struct place end[2]; /* eye end, light end */
    int label[2];        /* their subspaces */
    double ratio, x;     /* p_i / p; what the path contributes, w f / p */
};

/* A training path, made with density p by s = 0 or s = 1; w is its weight as if these two were the only strategies. */
struct lesson {
    double square; /* w (f / p)^2 over the number of samples */
    double fixed;  /* sum of n_i p_i / p over the strategies that do not draw */
    int n_links;   /* next in the list */
};

struct lessons {
    struct lesson *lesson; /* [n], owned */
    struct link *link;     /* [n_links], owned */
    size_t n, n_links;
    double sum; /* of what all paths contribute */
};

/* learn_tree: classify the eye ends (0) or light ends (1) of all links in at most `classes` subspaces, and set their
 * labels. They lie in a sphere. Returns the nodes, owned by the caller. */
struct tree_node *learn_tree(struct lessons *all, int end, int classes, vec3 center, double radius);

/* learn_gamma: Gamma(e,l) [classes^2], owned by the caller.
 *   each  [classes] number of samples in the weights if Gamma were 1, for pools without end
 *   K     sub-paths of a pool */
double *learn_gamma(const struct lessons *all, int classes, const double *each, double K, int steps);

#endif
