/* curve.c: see curve.h. A ray meets a curve as in [Nakamaru & Ohno 2002]: seen along the ray, a curve lies within the
 * hull of its control points. If that is farther from the ray than the curve is wide, the ray misses; else both halves
 * are asked, down to single pieces. Of these the ray meets the triangles, by the test of triangle.h.
 */
#include "geometry/curve.h"

#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/number.h"

vec3 curve_point(const vec3 P[4], double u, vec3 *tangent)
{
    vec3 q[3], r[2];
    for (int i = 0; i < 3; i++)
        q[i] = lerp3(u, P[i], P[i + 1]);
    for (int i = 0; i < 2; i++)
        r[i] = lerp3(u, q[i], q[i + 1]);
    vec3 d = sub(r[1], r[0]), chord = sub(P[3], P[0]);
    d = length2(d) > 0 ? d : chord;
    *tangent = length2(d) > 0 ? normalize(d) : vec(0, 0, 1);
    return lerp3(u, r[0], r[1]);
}

/* --- all of a scene ----------------------------------------------------------------------------------- */

/* The root of the largest row sum of M^T M: exact where M keeps angles, never too small. */
static double stretch_of(const struct transform *t)
{
    vec3 column[3];
    double most = 0;
    for (int i = 0; i < 3; i++)
        column[i] = vec(t->m[0][i], t->m[1][i], t->m[2][i]);
    for (int i = 0; i < 3; i++)
        most = fmax(most, fabs(dot(column[i], column[0])) + fabs(dot(column[i], column[1])) +
                              fabs(dot(column[i], column[2])));
    return sqrt(most);
}

/* Curves of one file mostly follow each other in the same place. */
static int32_t add_place(struct curves *all, const struct transform *to_world, bool reverse)
{
    const struct curve_place *last = all->n_places > 0 ? &all->place[all->n_places - 1] : NULL;
    if (last != NULL && last->reverse == reverse && memcmp(&last->to_world, to_world, sizeof *to_world) == 0)
        return all->n_places - 1;
    all->place = mem_append(all->place, (size_t)all->n_places, sizeof *all->place);
    all->place[all->n_places] = (struct curve_place){*to_world, stretch_of(to_world), reverse};
    return all->n_places++;
}

/* Are all points of a strand, placed, where something can be? */
static bool strand_fits(const struct strand *s, const struct transform *to_world, vec3 P[4], struct error *err)
{
    double radius = stretch_of(to_world) * fmax(s->net.radius[0], s->net.radius[1]);
    for (int i = 0; i < 4; i++) {
        P[i] = transform_point(to_world, s->P[i]);
        if (!is_place(add(P[i], vec(copysign(radius, P[i].x), copysign(radius, P[i].y), copysign(radius, P[i].z)))))
            return error_set(err, "this curve is (%g, %g, %g) from the camera, and %g wide: places go up to 1e12",
                             P[i].x, P[i].y, P[i].z, 2 * radius);
    }
    return true;
}

bool curves_add(struct curves *all, const struct strand *s, int n, const struct transform *to_world, bool reverse,
                int group, struct error *err)
{
    int32_t place = add_place(all, to_world, reverse);
    all->curve = mem_grow(all->curve, &all->capacity, (size_t)all->n + (size_t)n, sizeof *all->curve);
    for (int i = 0; i < n; i++) {
        struct curve *c = &all->curve[all->n + i];
        double reach = all->place[place].stretch * fmax(s[i].net.radius[0], s[i].net.radius[1]);
        vec3 P[4];
        if (!strand_fits(&s[i], to_world, P, err))
            return false;
        *c = (struct curve){.net = s[i].net, .place = place, .group = group};
        for (size_t k = 0; k < 4; k++)
            store3(c->P[0], k, P[k]);
        for (size_t k = 0; k < 4; k++)
            reach = fmax(reach, length(P[k]));
        c->slack = (float)(4e-7 * reach);
    }
    all->n += n;
    return true;
}

void curves_free(struct curves *all)
{
    free(all->curve);
    free(all->place);
    memset(all, 0, sizeof *all);
}

/* --- rows of points --------------------------------------------------------------------------------------- */

/* Of a row: the middle in the world, a normal of the curve and the direction across both in object space, and the
 * distance of its points. */
struct row {
    vec3 p, x, y;
    double radius;
};

static double mean_at(const float end[2], double along) { return (1 - along) * end[0] + along * end[1]; }

static void load_points(const struct curve *c, vec3 P[4])
{
    for (size_t i = 0; i < 4; i++)
        P[i] = load3(c->P[0], i);
}

/* A tube's guide needs no more than to be on the way; a ribbon's turns evenly. */
static vec3 guide_at(const struct net *n, double along)
{
    vec3 a = load3(n->guide[0], 0), b = load3(n->guide[1], 0);
    if (!((double)n->turn > 1e-6))
        return lerp3(along, a, b);
    return add(mul(a, m_sin((1 - along) * n->turn)), mul(b, m_sin(along * n->turn)));
}

static struct row row_at(const struct curves *all, const struct curve *c, int i)
{
    const struct net *n = &c->net;
    double along = (double)i / n->pieces;
    vec3 P[4], tangent, guide;
    struct row row;
    load_points(c, P);
    row.p = curve_point(P, along, &tangent);
    row.radius = mean_at(n->radius, along);
    if (i == 0 || i == n->pieces) {
        tangent = load3(n->tangent[i > 0], 0);
        guide = load3(n->guide[i > 0], 0);
    } else {
        tangent = transform_vector_back(&all->place[c->place].to_world, tangent);
        guide = guide_at(n, along);
    }
    tangent = normalize(tangent);
    row.x = frame_from_tangent(tangent, guide).s;
    row.y = cross(row.x, tangent);
    return row;
}

#define SQRT_HALF 0.70710678118654752440

/* The direction from a row's middle to its point j, and the normal there, both in object space. */
static vec3 point_direction(bool ribbon, const struct row *row, int j, vec3 *normal)
{
    static const double COSINE[CURVE_SIDES] = {1, SQRT_HALF, 0, -SQRT_HALF, -1, -SQRT_HALF, 0, SQRT_HALF};
    if (ribbon) {
        *normal = row->x;
        return mul(row->y, 2 * j - 1);
    }
    vec3 d = add(mul(row->x, COSINE[j % CURVE_SIDES]), mul(row->y, COSINE[(j + 6) % CURVE_SIDES]));
    return *normal = d;
}

static int columns_of(const struct curve *c) { return c->net.ribbon ? 1 : CURVE_SIDES; }

/* The points of a row in the world: the corners of triangles, for all who ask. */
struct row_points {
    float p[CURVE_SIDES + 1][3];
};

static struct row_points points_of(const struct curves *all, const struct curve *c, const struct row *row)
{
    struct row_points out;
    for (int j = 0; j <= columns_of(c); j++) {
        vec3 unused, d = mul(point_direction(c->net.ribbon, row, j, &unused), row->radius);
        store3(out.p[j], 0, add(row->p, transform_vector(&all->place[c->place].to_world, d)));
    }
    return out;
}

/* --- bounds --------------------------------------------------------------------------------------------- */

/* Half the side of a cube around a row and its points. */
static double reach_at(const struct curves *all, const struct curve *c, double along)
{
    return all->place[c->place].stretch * mean_at(c->net.radius, along) + c->slack;
}

bool curve_bounds(const struct curves *all, int curve, const float cell_lo[3], const float cell_hi[3], float lo[3],
                  float hi[3])
{
    const struct curve *c = &all->curve[curve];
    double p[2][3], r[2]; /* of both rows of a piece */
    bool any = false;
    vec3 P[4], unused;
    load_points(c, P);
    for (int i = 0; i <= c->net.pieces; i++) {
        double along = (double)i / c->net.pieces, *now = p[i % 2], *before = p[(i + 1) % 2];
        vec3 middle = curve_point(P, along, &unused);
        float from[3], to[3]; /* of the piece, in the cell */
        bool there = i > 0;
        r[i % 2] = reach_at(all, c, along);
        now[0] = middle.x;
        now[1] = middle.y;
        now[2] = middle.z;
        for (int k = 0; k < 3 && there; k++) {
            double wide = fmax(r[0], r[1]);
            from[k] = fmaxf(cell_lo[k], float_below(fmin(now[k], before[k]) - wide));
            to[k] = fminf(cell_hi[k], float_above(fmax(now[k], before[k]) + wide));
            there = from[k] <= to[k];
        }
        for (int k = 0; k < 3 && there; k++) {
            lo[k] = any ? fminf(lo[k], from[k]) : from[k];
            hi[k] = any ? fmaxf(hi[k], to[k]) : to[k];
        }
        any = any || there;
    }
    return any;
}

/* --- where a ray meets a curve ---------------------------------------------------------------------------- */

/* What is looked for: of the hits between lo and hi, except two, that which is nearest to a place on the ray. */
struct search {
    const struct curves *all;
    const struct curve *curve;
    struct ray ray;           /* without ends */
    struct triangle_ray line; /* of it */
    double wide[3];           /* so much wider than 1 is what is 1 wide, in each coordinate of a seen point */
    double reach, dz;         /* of the curve; the ray's direction along its longest axis */
    double lo, hi, place, except[2];
    struct hit *hit;
    bool found;
};

/* A point as it is seen along the ray, which is (0, 0, z). The names are those of triangle_hit. */
static void see(const struct triangle_ray *r, const float p[3], double out[3])
{
    out[2] = p[r->kz] - r->oz;
    out[0] = (p[r->kx] - r->ox) - r->sx * out[2];
    out[1] = (p[r->ky] - r->oy) - r->sy * out[2];
}

/* The control points of a part of a curve, as they are seen. */
struct hull {
    double p[4][3];
};

static void split(const struct hull *h, double u, struct hull *below, struct hull *above)
{
    for (int k = 0; k < 3; k++) {
        double q[4] = {h->p[0][k], h->p[1][k], h->p[2][k], h->p[3][k]};
        for (int i = 0; i < 4; i++) {
            below->p[i][k] = q[0];
            above->p[3 - i][k] = q[3 - i];
            for (int j = 0; j < 3 - i; j++)
                q[j] = (1 - u) * q[j] + u * q[j + 1];
        }
    }
}

/* Is what lies around the curve with these control points farther away than it is wide? */
static bool misses(const struct search *q, const struct hull *h)
{
    const double z[2] = {q->lo * q->dz, q->hi * q->dz};
    const double from[3] = {0, 0, fmin(z[0], z[1])}, to[3] = {0, 0, fmax(z[0], z[1])};
    for (int k = 0; k < 3; k++) {
        double lo = h->p[0][k], hi = lo, r = q->reach * q->wide[k];
        for (int i = 1; i < 4; i++) {
            lo = h->p[i][k] < lo ? h->p[i][k] : lo;
            hi = h->p[i][k] > hi ? h->p[i][k] : hi;
        }
        if (lo - r > to[k] || hi + r < from[k])
            return true;
    }
    return false;
}

/* Take note of a hit of a triangle of the square (row, column), the upper or the lower one. */
static void note(struct search *q, const struct hit *h, int row, int column, bool upper)
{
    if (!(h->t > q->lo && h->t < q->hi) || h->t == q->except[0] || h->t == q->except[1])
        return;
    double off = fabs(h->t - q->place);
    q->found = true;
    q->lo = fmax(q->lo, q->place - off);
    q->hi = fmin(q->hi, q->place + off);
    q->hit->t = h->t;
    q->hit->b1 = row + (upper ? h->b2 : h->b1 + h->b2);
    q->hit->b2 = column + (upper ? h->b1 + h->b2 : h->b1);
}

static void meet_piece(struct search *q, int i)
{
    const struct row row[2] = {row_at(q->all, q->curve, i), row_at(q->all, q->curve, i + 1)};
    const struct row_points near = points_of(q->all, q->curve, &row[0]), far = points_of(q->all, q->curve, &row[1]);
    for (int j = 0; j < columns_of(q->curve); j++) {
        const float *corner[4] = {near.p[j], near.p[j + 1], far.p[j + 1], far.p[j]};
        for (int half = 0; half < 2; half++) {
            float v[9];
            struct hit h;
            for (int k = 0; k < 9; k++)
                v[k] = corner[k < 3 ? 0 : k / 3 + half][k % 3];
            if (triangle_hit(&q->line, v, INFINITY, &h))
                note(q, &h, i, j, half == 0);
        }
    }
}

/* n pieces from number i on. */
static void meet_pieces(struct search *q, const struct hull *h, int i, int n)
{
    struct hull below, above;
    if (misses(q, h))
        return;
    if (n == 1) {
        meet_piece(q, i);
        return;
    }
    split(h, (double)(n / 2) / n, &below, &above);
    meet_pieces(q, &below, i, n / 2);
    meet_pieces(q, &above, i + n / 2, n - n / 2);
}

/* Fills hit, if there is one between lo and hi: that which is nearest to the place. */
static bool meets(struct search *q, const struct hull *h, double lo, double hi, double place)
{
    q->lo = lo;
    q->hi = hi;
    q->place = place;
    q->found = false;
    meet_pieces(q, h, 0, q->curve->net.pieces);
    return q->found;
}

bool curve_intersect(const struct curves *all, int curve, const struct ray *ray, bool begins, bool ends,
                     struct hit *hit)
{
    struct search q = {.all = all, .curve = &all->curve[curve], .ray = *ray, .except = {NAN, NAN}, .hit = hit};
    const double place[2] = {0, ray->tmax}, d[3] = {ray->d.x, ray->d.y, ray->d.z};
    double except[2] = {NAN, NAN};
    struct hull h;
    q.ray.tmin = -INFINITY;
    q.line = triangle_ray(&q.ray);
    q.wide[0] = sqrt(1 + q.line.sx * q.line.sx);
    q.wide[1] = sqrt(1 + q.line.sy * q.line.sy);
    q.wide[2] = 1;
    q.dz = d[q.line.kz];
    q.reach = fmax(reach_at(all, q.curve, 0), reach_at(all, q.curve, 1));
    for (int i = 0; i < 4; i++)
        see(&q.line, q.curve->P[i], h.p[i]);
    double near = q.reach / length(ray->d); /* the other side of a tube is farther away */
    for (int i = 0; i < 2; i++)
        if ((i == 0 ? begins : ends) && meets(&q, &h, place[i] - near, place[i] + near, place[i]))
            except[i] = hit->t;
    memcpy(q.except, except, sizeof except);
    return meets(&q, &h, ray->tmin, ray->tmax, ray->tmin);
}

/* --- the surface ------------------------------------------------------------------------------------------- */

void curve_triangle(const struct curves *all, int curve, const struct hit *hit, struct triangle *tri, double *b1,
                    double *b2)
{
    const struct curve *c = &all->curve[curve];
    const struct curve_place *place = &all->place[c->place];
    int i = (int)fmin(hit->b1, c->net.pieces - 1), j = (int)fmin(hit->b2, columns_of(c) - 1);
    double along = hit->b1 - i, across = hit->b2 - j;
    bool upper = across >= along;
    const struct row row[2] = {row_at(all, c, i), row_at(all, c, i + 1)};
    const struct row_points points[2] = {points_of(all, c, &row[0]), points_of(all, c, &row[1])};
    const int at[3][2] = {{0, 0}, {!upper, 1}, {1, upper}};
    for (int k = 0; k < 3; k++) {
        int number = at[k][0], column = j + at[k][1];
        vec3 normal;
        point_direction(c->net.ribbon, &row[number], column, &normal);
        tri->p[k] = load3(points[number].p[0], (size_t)column);
        tri->n[k] = mul(transform_normal(&place->to_world, normal), place->reverse ? -1 : 1);
        tri->uv[k][0] = mean_at(c->net.u, (double)(i + number) / c->net.pieces);
        tri->uv[k][1] = (double)column / columns_of(c);
    }
    *b1 = upper ? across - along : across;
    *b2 = upper ? along : along - across;
}
