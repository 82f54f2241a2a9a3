/* triangle.c: see triangle.h. The rules are those of [PBRT3 3.6], except the tangents under vertex normals:
 * pbrt-v3 turns them by 180 degrees and makes them unit vectors, so that its bump maps come out inverted and scaled
 * there. */
#include "geometry/triangle.h"

/* Two unit vectors that make an orthogonal system with v (any length but 0): pbrt-v3's choice. [PBRT3 2.2.4] */
static void tangents_of(vec3 v, vec3 *s, vec3 *t)
{
    *s = normalize(fabs(v.x) > fabs(v.y) ? vec(-v.z, 0, v.x) : vec(0, v.z, -v.y));
    *t = cross(normalize(v), *s);
}

/* The part of v that is orthogonal to the unit vector n. */
static vec3 reject(vec3 v, vec3 n) { return sub(v, mul(n, dot(v, n))); }

/* Derivatives by (u,v) of a quantity linear over the triangle, from its values at the vertices; false where
 * (u,v) are degenerate. */
static bool linear_partials(const struct triangle *tri, const vec3 *value, vec3 *du, vec3 *dv)
{
    double u02 = tri->uv[0][0] - tri->uv[2][0], v02 = tri->uv[0][1] - tri->uv[2][1];
    double u12 = tri->uv[1][0] - tri->uv[2][0], v12 = tri->uv[1][1] - tri->uv[2][1];
    double det = u02 * v12 - v02 * u12;
    if (!(fabs(det) >= 1e-8))
        return false;
    vec3 d02 = sub(value[0], value[2]), d12 = sub(value[1], value[2]);
    *du = mul(sub(mul(d02, v12), mul(d12, v02)), 1 / det);
    *dv = mul(sub(mul(d12, u02), mul(d02, u12)), 1 / det);
    return true;
}

/* Tangents orthogonal to a shading normal from vertex normals, whose mean has this length, and how that normal
 * changes. */
static void partials_by_vertex_normals(const struct triangle *tri, double size, struct surface *out)
{
    vec3 du = reject(out->dpdu, out->ns), dv = reject(out->dpdv, out->ns);
    if (length2(cross(du, dv)) > 0) {
        out->dpdu = du;
        out->dpdv = dv;
    } else {
        tangents_of(out->ns, &out->dpdu, &out->dpdv);
    }
    if (linear_partials(tri, tri->n, &out->dndu, &out->dndv)) {
        out->dndu = mul(reject(out->dndu, out->ns), 1 / size);
        out->dndv = mul(reject(out->dndv, out->ns), 1 / size);
    } else {
        vec3 dn = cross(sub(tri->n[2], tri->n[0]), sub(tri->n[1], tri->n[0]));
        if (length2(dn) > 0)
            tangents_of(dn, &out->dndu, &out->dndv);
    }
}

/* As pbrt-v3's "S": where its mean is 0, or along ns, all stays. Lengths stay, by which bumps are as high. */
static void turn_tangents(vec3 s, struct surface *out)
{
    double handed = dot(cross(out->dpdu, out->dpdv), out->ns) < 0 ? -1 : 1;
    s = reject(s, out->ns);
    if (!(length2(s) > 0))
        return;
    s = normalize(s);
    out->dpdu = mul(s, length(out->dpdu));
    out->dpdv = mul(cross(out->ns, s), handed * length(out->dpdv));
}

void triangle_partials(const struct triangle *tri, double b1, double b2, struct surface *out)
{
    out->u = (1 - b1 - b2) * tri->uv[0][0] + b1 * tri->uv[1][0] + b2 * tri->uv[2][0];
    out->v = (1 - b1 - b2) * tri->uv[0][1] + b1 * tri->uv[1][1] + b2 * tri->uv[2][1];
    out->dpdu = out->dpdv = out->dndu = out->dndv = vec(0, 0, 0);
    if (tri->skip_partials)
        return;
    if (!linear_partials(tri, tri->p, &out->dpdu, &out->dpdv) || !(length2(cross(out->dpdu, out->dpdv)) > 0))
        tangents_of(cross(sub(tri->p[2], tri->p[0]), sub(tri->p[1], tri->p[0])), &out->dpdu, &out->dpdv);
    double size = tri->has_n ? length(barycentric3(tri->n, b1, b2)) : 0;
    if (size > 0)
        partials_by_vertex_normals(tri, size, out);
    if (tri->has_s)
        turn_tangents(barycentric3(tri->s, b1, b2), out);
}
