/* spcbpt_learn.c: see spcbpt.h. */
#include "rivals/spcbpt.h"

#include <stdlib.h>

#include "base/alias.h"
#include "base/mem.h"

/* What the path of a link contributes, at most ten times the mean: for trees and for the first Gamma. */
static double weight_of(const struct lessons *all, const struct link *link)
{
    return fmin(link->x, 10 * all->sum / (double)all->n);
}

/* --- trees ------------------------------------------------------------------------------------------- */

/* A leaf of the growing tree, with its box. The links in it have its number for their label. */
struct leaf {
    int node, halved; /* halved: how often the box was */
    double weight;
    struct place low, high;
};

/* Halve the box of a leaf along x, y, z and the axes of normals in turn, until that parts its links. Those above become
 * the leaf `other`. False if nothing parts them. */
static bool part(struct lessons *all, int end, struct leaf *leaf, int number, int other, struct tree_node *node)
{
    enum { DEEPEST = 72 };
    struct leaf *below = &leaf[number], *above = &leaf[other];
    while (below->halved < DEEPEST) {
        int axis = below->halved++ % 6, n[2] = {0, 0};
        double at = (below->low.x[axis] + below->high.x[axis]) / 2, weight[2] = {0, 0};
        for (const struct link *k = all->link; k < all->link + all->n_links; k++)
            if (k->label[end] == number) {
                n[k->end[end].x[axis] >= at]++;
                weight[k->end[end].x[axis] >= at] += weight_of(all, k);
            }
        *above = *below;
        below->high.x[axis] = above->low.x[axis] = at;
        if (n[0] == 0)
            *below = *above;
        if (n[0] == 0 || n[1] == 0)
            continue;
        below->weight = weight[0];
        above->weight = weight[1];
        for (struct link *k = all->link; k < all->link + all->n_links; k++)
            if (k->label[end] == number && k->end[end].x[axis] >= at)
                k->label[end] = other;
        *node = (struct tree_node){axis, {0, 0}, 0, at};
        return true;
    }
    return false;
}

struct tree_node *learn_tree(struct lessons *all, int end, int classes, vec3 center, double radius)
{
    struct tree_node *tree = mem_alloc(2 * (size_t)classes, sizeof *tree), parted;
    struct leaf *leaf = mem_alloc((size_t)classes, sizeof *leaf);
    vec3 low = sub(center, vec(radius, radius, radius)), high = add(center, vec(radius, radius, radius));
    leaf[0].low = (struct place){{low.x, low.y, low.z, -1, -1, -1}};
    leaf[0].high = (struct place){{high.x, high.y, high.z, 1, 1, 1}};
    leaf[0].weight = (double)all->n_links;
    tree[0] = (struct tree_node){-1, {0, 0}, 0, 0};
    for (int n = 1, n_nodes = 1; n < classes;) {
        int heaviest = 0;
        for (int i = 1; i < n; i++)
            heaviest = leaf[i].weight > leaf[heaviest].weight ? i : heaviest;
        if (!(leaf[heaviest].weight > 0))
            break;
        if (!part(all, end, leaf, heaviest, n, &parted)) {
            leaf[heaviest].weight = 0;
            continue;
        }
        struct tree_node *node = &tree[leaf[heaviest].node];
        parted.child[0] = leaf[heaviest].node = n_nodes++;
        parted.child[1] = leaf[n].node = n_nodes++;
        tree[parted.child[0]] = *node;
        tree[parted.child[1]] = (struct tree_node){-1, {0, 0}, n++, 0};
        *node = parted;
    }
    free(leaf);
    return tree;
}

/* --- Gamma ------------------------------------------------------------------------------------------- */

static size_t cell_of(const struct link *link, int classes)
{
    return (size_t)link->label[0] * (size_t)classes + (size_t)link->label[1];
}

/* Make rows sum to 1; a row of zeros becomes uniform. */
static void normalise(double *gamma, int classes)
{
    for (int e = 0; e < classes; e++, gamma += classes) {
        double sum = sum_of(gamma, classes);
        for (int l = 0; l < classes; l++)
            gamma[l] = sum > 0 ? gamma[l] / sum : 1.0 / classes;
    }
}

/* Replace Gamma by Gamma sqrt(g), normalised, g = -dJ/dGamma. At the minimum of J all g of a row are equal. */
static void improve(const struct lessons *all, int classes, const double *each, double K, double *gamma)
{
    size_t size = (size_t)classes * (size_t)classes;
    double *g = mem_alloc(size, sizeof *g);
    const struct link *link = all->link;
    for (size_t i = 0; i < all->n; link += all->lesson[i++].n_links) {
        double sum = all->lesson[i].fixed;
        for (const struct link *k = link; k < link + all->lesson[i].n_links; k++) {
            double x = each[k->label[1]] * gamma[cell_of(k, classes)];
            sum += k->ratio * x * K / (x + K);
        }
        for (const struct link *k = link; k < link + all->lesson[i].n_links; k++) {
            double each_l = each[k->label[1]], x = each_l * gamma[cell_of(k, classes)];
            g[cell_of(k, classes)] += all->lesson[i].square / sqr(sum) * k->ratio * each_l * sqr(K / (x + K));
        }
    }
    for (size_t i = 0; i < size; i++)
        gamma[i] *= sqrt(g[i]);
    normalise(gamma, classes);
    free(g);
}

double *learn_gamma(const struct lessons *all, int classes, const double *each, double K, int steps)
{
    double *gamma = mem_alloc((size_t)classes * (size_t)classes, sizeof *gamma);
    for (size_t i = 0; i < all->n_links; i++)
        gamma[cell_of(&all->link[i], classes)] += weight_of(all, &all->link[i]);
    normalise(gamma, classes);
    for (int i = 0; i < steps && all->n_links > 0; i++)
        improve(all, classes, each, K, gamma);
    return gamma;
}
