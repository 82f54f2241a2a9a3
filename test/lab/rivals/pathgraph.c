/* pathgraph.c: eye vertices nearby take each other's light for their own. Biased.
 *
 * Path graphs [Deng 2021]. From each vertex j of an eye sub-path two edges lead: one to a point on a light, drawn with
 * density q (1/sr), and the one along which the walk went on, with density p. Vertices of a tile that lie in one cell
 * of a grid and face one way form clusters, in which each takes over the edges of all M, as if what comes along an edge
 * to one came to the others, too. Over the edges i, of direction w_i,
 *     L_j = sum f_j(w_i) |cos| Le_i / sum_m (p_m + q_m)(w_i) + sum f_j(w_i) |cos| L_i / sum_m p_m(w_i),
 * Le_i being what lights send along the edge and L_i, of edges of the second kind, what the next vertex sends on: the
 * balance heuristic over members m. The bias is that of another's light and visibility; it falls with the radius, and
 * in a cluster of one L_j is what path tracing finds.
 *
 * The graph has circles, since a cluster has vertices of any depth. So L begins black and is made again by the L of the
 * iteration before: after n iterations it has what comes over up to n edges. There are as many as paths may have, which
 * leaves out longer ones as pt does, or `iterations` if that is less. With iterations=0 clusters are of equal depth and
 * one sweep from the last vertices to the first has it all. The last vertices of the longest walks have no second edge:
 * they take over those of others, but do not count in sum_m p_m. What the camera sees, itself or in mirrors, is in no
 * cluster: pixels share what lies behind it, so that edges stay sharp. The grid lies elsewhere in every sample.
 *
 * Light that comes over an edge has the length of the path that found it. To strategies and trace the first vertex is
 * the light.
 *
 * Tests: test_rivals.c.
 */
#include <stdlib.h>

#include "caustics/surfaces.h"
#include "rivals/together.h"

enum { LARGEST_CLUSTER = 64, ALONE = 6 };

struct pathgraph {
    int cluster;    /* most vertices of one */
    int iterations; /* 0: clusters are of equal depth */
    double radius; /* side of the grid's cells over the radius of the scene's bounding sphere */
};

struct node {
    const struct vertex *z;
    bool ends;       /* there is no next vertex: else it is z + 1, and the next node is its own */
    bool led;        /* there could be one */
    vec3 w;          /* to the point on a light, unit */
    rgb Le;          /* what comes from there; black if nothing does */
    double q;        /* of w, 1/sr; 0: of a light without extent, and Le is over its density */
    rgb direct;      /* what it sends on of light from points on lights, */
    rgb L, before;   /* and of all; after the iteration before */
    vec3 cell;       /* of the grid */
    int face;        /* which way it faces, ALONE: it is in no cluster; */
    int number;      /* so that no two are equal */
    rgb f;           /* at work: towards an edge, with the cosine; */
    double p;        /* and the density of the walk's going there */
};

/* --- edges ------------------------------------------------------------------------------------------- */

/* The edge to a light: as connect_s1 draws it, but that others may scatter where this vertex has f = 0. */
static void draw_light(struct sample *sample, struct node *node)
{
    const struct scene *scene = sample->pass->job->scene;
    const struct vertex *z = node->z;
    struct lit l = {.z = z};
    if (!lamp_draw(scene, &sample->sampler, &l.at) || !vertex_connectible(z) || !(l.at.pdf > 0))
        return;
    const struct light *light = &scene->lights.light[l.at.light];
    const struct lamp_way way = lamp_way(scene, z->p, &l.at);
    if (!(way.d2 > 0))
        return;
    node->w = way.w;
    rgb Le = light_Le(&scene->lights, &l.at, neg(node->w));
    double at_light = (light->kind == LIGHT_AREA ? abs_dot(l.at.n, node->w) : 1) / way.d2;
    double density = l.at.pdf / at_light;
    if (rgb_is_black(Le) || !(at_light > 0) || !bsdf_may_scatter(&z->bsdf, z->wo, node->w) || !reuse_sees(scene, &l))
        return;
    bool delta = light_is_delta(light);
    node->Le = delta ? rgb_scale(Le, 1 / density) : Le;
    node->q = delta ? 0 : density;
}

/* Ask the members for f and p towards w. Returns the sum of the p by which they could go there; *able: how many take
 * light from there. */
static double ask(struct node **member, int n, vec3 w, int *able)
{
    double sum = 0;
    *able = 0;
    for (int m = 0; m < n; m++) {
        const struct vertex *z = member[m]->z;
        struct bsdf_value b = bsdf_eval(&z->bsdf, z->wo, w, RADIANCE);
        member[m]->f = rgb_scale(b.f, scatter_cosine(z, w, RADIANCE));
        member[m]->p = b.pdf;
        sum += member[m]->led ? b.pdf : 0;
        *able += bsdf_may_scatter(&z->bsdf, z->wo, w);
    }
    return sum;
}


/* The edge of one member to a light, to all. */
static void aggregate_light(struct node **member, int n, const struct node *from)
{
    int able;
    double sum = ask(member, n, from->w, &able);
    rgb light = rgb_scale(from->Le, from->q > 0 ? 1 / (sum + able * from->q) : 1.0 / able);
    for (int m = 0; m < n; m++)
        member[m]->direct = rgb_add(member[m]->direct, rgb_mul(member[m]->f, light));
}

/* The edge that leads on, to all; to the member alone if it left by a delta lobe. */
static void aggregate_next(const struct sample *sample, struct node **member, int n, struct node *from)
{
    const struct vertex *next = from->z + 1;
    const struct connection hit = reuse_hit(sample, from->z, next, rgb_grey(1));
    int able;
    double roulette, sum = ask(member, n, neg(next->wo), &able);
    double all = sum + able * from->p * reuse_hit_density(sample, from->z, next);
    rgb step = reuse_step(from->z, next, &roulette);
    rgb light = rgb_scale(rgb_add(rgb_scale(hit.value, sum / all), from[1].before), roulette / sum);
    if (next->prev_delta)
        from->L = rgb_add(from->L, rgb_mul(step, rgb_add(hit.value, from[1].before)));
    for (int m = 0; m < n && !next->prev_delta; m++)
        member[m]->L = rgb_add(member[m]->L, rgb_mul(member[m]->f, light));
}

/* --- clusters ---------------------------------------------------------------------------------------- */

static int by_number(double a, double b) { return (a > b) - (a < b); }

static int by_place(const void *a, const void *b)
{
    const struct node *x = *(struct node *const *)a, *y = *(struct node *const *)b;
    int order[] = {x->face - y->face, by_number(x->cell.x, y->cell.x), by_number(x->cell.y, y->cell.y),
                   by_number(x->cell.z, y->cell.z), x->number - y->number};
    int k = 0;
    while (k < 4 && order[k] == 0)
        k++;
    return order[k];
}

/* Which cell, and which of the six ways its side that is seen faces. */
static void place(struct node *node, const struct scene *scene, double side, vec3 shift)
{
    node->face = ALONE;
    if (node->z->eye_hit == FIRST_HIT || !vertex_connectible(node->z))
        return;
    vec3 p = add(mul(sub(node->z->p, scene->lights.center), 1 / side), shift);
    vec3 n = dot(node->z->ng, node->z->wo) < 0 ? neg(node->z->ng) : node->z->ng;
    vec3 cell = {floor(p.x), floor(p.y), floor(p.z)}, a = {fabs(n.x), fabs(n.y), fabs(n.z)};
    node->cell = cell;
    if (a.x >= a.y && a.x >= a.z)
        node->face = n.x > 0;
    else
        node->face = a.y >= a.z ? 2 + (n.y > 0) : 4 + (n.z > 0);
}

static bool together(const struct node *a, const struct node *b)
{
    return a->face == b->face && a->cell.x == b->cell.x && a->cell.y == b->cell.y && a->cell.z == b->cell.z;
}

/* The clusters of n vertices, one after another. */
struct clusters {
    const struct pathgraph *s;
    struct node **node; /* [n] sorted */
    int n;
};

static struct clusters find_clusters(const struct pathgraph *s, const struct scene *scene, struct node **node, int n,
                                     vec3 shift)
{
    for (int i = 0; i < n; i++)
        place(node[i], scene, s->radius * scene->lights.radius, shift);
    qsort(node, (size_t)n, sizeof *node, by_place);
    return (struct clusters){s, node, n};
}

/* The end of the cluster that begins with vertex i. */
static int cluster_end(const struct clusters *c, int i)
{
    int end = i + 1;
    while (c->node[i]->face != ALONE && end < c->n && end - i < c->s->cluster && together(c->node[i], c->node[end]))
        end++;
    return end;
}

/* What all send on by direct light; then by all light, `times` in succession. */
static void aggregate(const struct clusters *c, const struct sample *sample, int times)
{
    for (int i = 0, end; i < c->n; i = end) {
        end = cluster_end(c, i);
        for (int k = i; k < end; k++)
            if (!rgb_is_black(c->node[k]->Le))
                aggregate_light(&c->node[i], end - i, c->node[k]);
    }
    while (times-- > 0 && !pass_cancelled(sample->pass)) {
        for (int i = 0; i < c->n; i++)
            c->node[i]->L = c->node[i]->direct;
        for (int i = 0, end; i < c->n; i = end) {
            end = cluster_end(c, i);
            for (int k = i; k < end; k++)
                if (!c->node[k]->ends)
                    aggregate_next(sample, &c->node[i], end - i, c->node[k]);
        }
        for (int i = 0; i < c->n; i++)
            c->node[i]->before = c->node[i]->L;
    }
}

/* --- tiles ------------------------------------------------------------------------------------------- */

/* All vertices of the tile, at once, or of one depth after another from the last; longest: vertices of the longest eye
 * sub-path. */
static void sweep(const struct pathgraph *s, struct pixel *pixel, struct node **of, int n, int longest,
                  const struct tile_pass *pass, vec3 shift)
{
    bool at_once = s->iterations > 0;
    int most = pass->job->max_depth;
    struct node **node = arena_alloc(&pass->work->arena, (size_t)n * (size_t)(at_once ? longest : 1) * sizeof *node);
    for (int t = longest, here = 0; t >= 2 && !pass_cancelled(pass); t--) {
        for (int i = 0; i < n; i++)
            if (t <= pixel[i].n && pixel[i].sample.eye[t - 1].kind == VERTEX_SURFACE)
                node[here++] = &of[i][t - 1];
        if (at_once && t > 2)
            continue;
        const struct clusters c = find_clusters(s, pass->job->scene, node, here, shift);
        aggregate(&c, &pixel[0].sample, !at_once ? 1 : s->iterations < most ? s->iterations : most);
        here = 0;
    }
}

/* What the first vertex shines, and sends on. */
static void add_pixel(struct pixel *p, const struct node *first)
{
    struct sample *sample = &p->sample;
    const struct vertex *z = first->z;
    struct connection c = {.value = rgb_mul(z->beta, first->L), .weight = 1, .light = -1};
    sample_s0(sample, 2);
    sample_add(sample, (struct joined){.t = 2, .z = z, .c = &c, .pmf = 1, .scale = 1});
}

static void connect_all(const struct prepared *p, const struct tile_pass *pass, const struct cache *cache,
                        struct pixel *pixel, int n)
{
    const struct pathgraph *s = p->own;
    struct arena *arena = &pass->work->arena;
    struct node **of = arena_alloc(arena, (size_t)n * sizeof *of);
    int longest = 0;
    (void)cache;
    for (int i = 0; i < n; i++) {
        if (pass_cancelled(pass))
            return;
        struct pixel *x = &pixel[i];
        of[i] = arena_alloc(arena, (size_t)x->n * sizeof **of);
        for (int t = 1; t <= x->n; t++) {
            bool last = t > pass->job->max_depth + 1;
            struct node node = {.z = &x->sample.eye[t - 1], .ends = t == x->n, .led = !last,
                                .number = i * (pass->job->max_depth + 2) + t};
            if (node.z->kind == VERTEX_SURFACE && (!last || s->iterations > 0))
                draw_light(&x->sample, &node);
            of[i][t - 1] = node;
        }
        longest = x->n > longest ? x->n : longest;
    }
    vec3 shift;
    shift.x = sampler_number(&pixel[0].sample.choice, DRAW_ORDER);
    shift.y = sampler_number(&pixel[0].sample.choice, DRAW_ORDER);
    shift.z = sampler_number(&pixel[0].sample.choice, DRAW_ORDER);
    sweep(s, pixel, of, n, longest, pass, shift);
    for (int i = 0; i < n; i++)
        if (pixel[i].n >= 2)
            add_pixel(&pixel[i], &of[i][1]);
}

static void render(const struct prepared *p, const struct tile_pass *pass) { together_render(p, pass, connect_all); }

static const struct field OWN[] = {
    {"cluster", FIELD_INTEGER, offsetof(struct pathgraph, cluster), 16, 1, LARGEST_CLUSTER,
     "most vertices that share their light; 1: pt", NULL},
    {"iterations", FIELD_INTEGER, offsetof(struct pathgraph, iterations), 100, 0, 100,
     "most edges that light goes over in clusters of all depths; 0: clusters are of equal depth", NULL},
    {"radius", FIELD_NUMBER, offsetof(struct pathgraph, radius), 0.05, 1e-6, 10,
     "how far apart they may be, in radii of the scene", NULL},
    {.name = NULL}};

const struct method method_pathgraph = {
    .name = "pathgraph", .check = surfaces_alone,
    .help = "path graphs [Deng 2021]: pt whose vertices share what lights them with others; biased",
    .own = OWN, .own_size = sizeof(struct pathgraph), .numbers = NUMBERS_OF_PT, .rr_threshold = DEFAULT_RR_THRESHOLD,
    .prepare = reuse_prepare, .render = render};
