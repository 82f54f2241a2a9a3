/* sdtree.c: see sdtree.h. */
#include "rivals/sdtree.h"

#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/number.h"
#include "base/warp.h"

enum { QUAD_DEPTH = 20, NODES_MOST = 8192 }; /* about 40 MiB */
static const double QUAD_SHARE = 0.04;       /* rho: most of the light in a cell [Mueller 2017] */
static const double FIRST_SHARE = 0.5, LEAST_SHARE = 0.1, MOST_SHARE = 0.9;

/* --- directions -------------------------------------------------------------------------------------- */

/* In which half is x, the first having the part p? x becomes the place within it. */
static int halve(double *x, double p)
{
    bool second = *x >= p;
    *x = below_one(second ? (*x - p) / (1 - p) : *x / p);
    return second;
}

vec3 quadtree_draw(const struct quadtree *q, const double u[2])
{
    double x = u[0], y = u[1], low[2] = {0, 0}, side = 1;
    int node = 0;
    do {
        const double *s = q->node[node].sum;
        double left = s[0] + s[2], right = s[1] + s[3];
        int i = halve(&x, left / (left + right)), j = halve(&y, s[i] / (s[i] + s[i + 2]));
        side /= 2;
        low[0] += i * side;
        low[1] += j * side;
        node = q->node[node].child[i + 2 * j];
    } while (node > 0);
    return warp_sphere(low[0] + side * x, low[1] + side * y);
}

/* The side of the cell at (u,v). *density: of what is drawn there, per area of the square. */
static double look_up(const struct quadtree *q, double u, double v, double *density)
{
    double side = 1;
    int node = 0;
    *density = 1;
    do {
        const double *s = q->node[node].sum;
        double all = s[0] + s[1] + s[2] + s[3];
        int k = halve(&u, 0.5) + 2 * halve(&v, 0.5);
        *density *= all > 0 ? 4 * s[k] / all : 0;
        side /= 2;
        node = q->node[node].child[k];
    } while (node > 0);
    return side;
}

double quadtree_pdf(const struct quadtree *q, vec3 w)
{
    double u, v, density = 0;
    warp_sphere_inverse(w, &u, &v);
    if (q->total > 0)
        look_up(q, u, v, &density);
    return density * warp_sphere_pdf_w();
}

static void add_point(struct quadtree *q, double u, double v, double light)
{
    int node = 0;
    do {
        int k = halve(&u, 0.5) + 2 * halve(&v, 0.5);
        q->node[node].sum[k] += light;
        node = q->node[node].child[k];
    } while (node > 0);
    q->total += light;
}

/* It is divided among four points that are a quarter of the cell away, much as a box filter of the size of the cell
 * would spread it. [Mueller 2019] */
void sd_add_light(struct sd_leaf *leaf, double u, double v, double light)
{
    double density, side = look_up(&leaf->next, u, v, &density);
    for (int i = 0; i < 4; i++) {
        double x = u + (i % 2 - 0.5) * side / 2, y = v + (i / 2 - 0.5) * side / 2;
        add_point(&leaf->next, below_one(fmax(x, 0)), below_one(fmax(y, 0)), light / 4);
    }
}

/* Add an empty node for the part `share` of the light: where node number `node` of `from` is, or, if that is -1, within
 * one of its cells. Returns its number. */
static int divide(struct quadtree *q, const struct quadtree *from, int node, double share, int depth)
{
    int made = q->n++;
    q->node = mem_append(q->node, (size_t)made, sizeof *q->node);
    memset(&q->node[made], 0, sizeof *q->node);
    for (int k = 0; k < 4; k++) {
        double part = node < 0 ? share / 4 : from->node[node].sum[k] / from->total;
        int below = node < 0 || from->node[node].child[k] == 0 ? -1 : from->node[node].child[k];
        if (part > QUAD_SHARE && depth < QUAD_DEPTH) {
            int child = divide(q, from, below, part, depth + 1);
            q->node[made].child[k] = child;
        }
    }
    return made;
}

/* --- space ------------------------------------------------------------------------------------------- */

/* The Kullback-Leibler divergence of the mixture from the contributions is least where the sum over records of
 *     contribution log(share odds + (1 - share) (1 - odds))
 * is greatest [Mueller 2019]. The sum is concave, so a step of Newton's method in each pass is enough. */
void sd_add_record(struct sd_leaf *leaf, double contribution, double odds)
{
    double slope = (2 * odds - 1) / (leaf->share * odds + (1 - leaf->share) * (1 - odds));
    leaf->records++;
    leaf->slope += contribution * slope;
    leaf->bend += contribution * slope * slope;
}

static double next_share(const struct sd_leaf *leaf)
{
    double best = leaf->bend > 0 ? leaf->share + leaf->slope / leaf->bend : leaf->share;
    return leaf->known.total > 0 ? fmin(fmax(best, LEAST_SHARE), MOST_SHARE) : FIRST_SHARE;
}

static void empty(struct sd_leaf *leaf)
{
    leaf->records = leaf->slope = leaf->bend = leaf->next.total = 0;
    leaf->next.n = 0;
    divide(&leaf->next, &leaf->known, leaf->known.total > 0 ? 0 : -1, 1, 1);
}

void sdtree_init(struct sdtree *t, vec3 low, vec3 high)
{
    vec3 size = sub(high, low);
    t->low = low;
    t->side = fmax(fmax(size.x, fmax(size.y, size.z)), 1e-30);
    t->node = mem_alloc(1, sizeof *t->node);
    t->n = 1;
    t->node->leaf.share = 1;
    empty(&t->node->leaf);
}

void sdtree_free(struct sdtree *t)
{
    for (int i = 0; i < t->n; i++) {
        free(t->node[i].leaf.known.node);
        free(t->node[i].leaf.next.node);
    }
    free(t->node);
}

int sdtree_find(const struct sdtree *t, vec3 p, vec3 *size)
{
    vec3 at = mul(sub(p, t->low), 1 / t->side);
    double x[3] = {at.x, at.y, at.z}, edge[3] = {t->side, t->side, t->side};
    int node = 0;
    for (int k = 0; k < 3; k++)
        x[k] = below_one(fmax(x[k], 0));
    for (int axis = 0; t->node[node].child[0] > 0; axis = (axis + 1) % 3) {
        node = t->node[node].child[halve(&x[axis], 0.5)];
        edge[axis] /= 2;
    }
    if (size != NULL)
        *size = vec(edge[0], edge[1], edge[2]);
    return node;
}

/* Halve a leaf, and the halves, which know what it knew. The first half takes over what the leaf owns. */
static void split(struct sdtree *t, int node, double most)
{
    if (!(t->node[node].leaf.records > most) || t->n > NODES_MOST)
        return;
    for (int k = 0; k < 2; k++) {
        t->node = mem_append(t->node, (size_t)t->n, sizeof *t->node);
        t->node[node].child[k] = t->n;
        t->node[t->n++] = (struct sd_node){.leaf = t->node[node].leaf};
        t->node[t->n - 1].leaf.records /= 2;
    }
    struct sd_leaf *second = &t->node[t->n - 1].leaf;
    size_t size = (size_t)second->known.n * sizeof *second->known.node;
    second->next.node = NULL;
    if (size > 0)
        second->known.node = memcpy(mem_alloc(1, size), second->known.node, size);
    t->node[node].leaf = (struct sd_leaf){.records = 0};
    for (int k = 0; k < 2; k++)
        split(t, t->node[node].child[k], most);
}

void sdtree_build(struct sdtree *t, double most)
{
    for (int node = 0, n = t->n; node < n; node++) {
        struct sd_leaf *leaf = &t->node[node].leaf;
        struct quadtree before = leaf->known;
        if (leaf->next.total > 0) {
            leaf->share = next_share(leaf);
            leaf->known = leaf->next;
            leaf->next = before;
        }
        split(t, node, most);
    }
    for (int node = 0; node < t->n; node++)
        if (t->node[node].child[0] == 0)
            empty(&t->node[node].leaf);
}
