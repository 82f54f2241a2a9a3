/* spcbpt_learn.c: see spcbpt.h. */
#include "rivals/spcbpt.h"

#include <stdlib.h>

#include "base/alias.h"
#include "base/mem.h"

/* Bound of what a path contributes to trees and to the first Gamma: ten times the mean. */
static double most_of_path(const struct lessons *all)
{
    double sum = 0;
    for (size_t i = 0; i < all->n; i++)
        sum += all->lesson[i].x;
    return 10 * sum / (double)(all->n + 1);
}

/* --- trees ------------------------------------------------------------------------------------------- */

struct sample {
    struct place at;
    double weight;
};

/* A leaf of the growing tree, with the box of its samples; its subspace is its number. */
struct leaf {
    struct sample *sample; /* [n] */
    int n, node, halved;   /* halved: how often the box was */
    double weight;
    struct place low, high;
};

/* Halve the leaf's box along x, y, z and the axes of normals in turn, until that parts its samples. Then it keeps those
 * below, and the others are *other. False if nothing parts them. */
static bool part(struct leaf *leaf, struct leaf *other, struct tree_node *node)
{
    enum { DEEPEST = 72 };
    while (leaf->halved < DEEPEST) {
        int axis = leaf->halved++ % 6, front = 0;
        double at = (leaf->low.x[axis] + leaf->high.x[axis]) / 2, weight = 0;
        for (int i = 0; i < leaf->n; i++)
            if (leaf->sample[i].at.x[axis] < at) {
                struct sample below = leaf->sample[i];
                leaf->sample[i] = leaf->sample[front];
                leaf->sample[front++] = below;
                weight += below.weight;
            }
        *other = *leaf;
        leaf->high.x[axis] = other->low.x[axis] = at;
        *node = (struct tree_node){axis, {0, 0}, 0, at};
        if (front == 0)
            *leaf = *other;
        if (front > 0 && front < leaf->n) {
            *other = (struct leaf){leaf->sample + front, leaf->n - front, 0, leaf->halved, leaf->weight - weight,
                                   other->low, other->high};
            leaf->n = front;
            leaf->weight = weight;
            return true;
        }
    }
    return false;
}

struct tree_node *learn_tree(struct lessons *all, int end, int classes, vec3 center, double radius)
{
    struct sample *sample = mem_alloc(all->n_links, sizeof *sample);
    struct tree_node *tree = mem_alloc(2 * (size_t)classes, sizeof *tree);
    struct leaf *leaf = mem_alloc((size_t)classes, sizeof *leaf);
    vec3 low = sub(center, vec(radius, radius, radius)), high = add(center, vec(radius, radius, radius));
    const struct link *link = all->link;
    double most = most_of_path(all);
    leaf[0].sample = sample;
    leaf[0].low = (struct place){{low.x, low.y, low.z, -1, -1, -1}};
    leaf[0].high = (struct place){{high.x, high.y, high.z, 1, 1, 1}};
    for (size_t i = 0; i < all->n; i++)
        for (int k = 0; k < all->lesson[i].n_links; k++, link++) {
            sample[leaf[0].n++] = (struct sample){link->end[end], fmin(all->lesson[i].x, most)};
            leaf[0].weight += fmin(all->lesson[i].x, most);
        }
    tree[0] = (struct tree_node){-1, {0, 0}, 0, 0};
    for (int n = 1, n_nodes = 1; n < classes;) {
        struct leaf *heaviest = leaf;
        for (int i = 1; i < n; i++)
            heaviest = leaf[i].weight > heaviest->weight ? &leaf[i] : heaviest;
        struct tree_node *node = &tree[heaviest->node], parted;
        if (!(heaviest->weight > 0))
            break;
        if (!part(heaviest, &leaf[n], &parted)) {
            heaviest->weight = 0;
            continue;
        }
        parted.child[0] = heaviest->node = n_nodes++;
        parted.child[1] = leaf[n].node = n_nodes++;
        tree[parted.child[0]] = *node;
        tree[parted.child[1]] = (struct tree_node){-1, {0, 0}, n++, 0};
        *node = parted;
    }
    for (size_t i = 0; i < all->n_links; i++)
        all->link[i].label[end] = tree_find(tree, all->link[i].end[end]);
    free(sample);
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
    double *gamma = mem_alloc((size_t)classes * (size_t)classes, sizeof *gamma), most = most_of_path(all);
    const struct link *link = all->link;
    for (size_t i = 0; i < all->n; i++)
        for (int k = 0; k < all->lesson[i].n_links; k++, link++)
            gamma[cell_of(link, classes)] += fmin(all->lesson[i].x, most);
    normalise(gamma, classes);
    for (int i = 0; i < steps && all->n_links > 0; i++)
        improve(all, classes, each, K, gamma);
    return gamma;
}
