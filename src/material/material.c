/* material.c: see material.h. */
#include "material/material.h"

#include <math.h>

/* All materials. A new one is a row of simple.c, or of a file of its own, and a line here. */
extern const struct material_row material_matte, material_mirror, material_glass, material_metal, material_plastic,
    material_substrate, material_uber, material_translucent, material_subsurface, material_kdsubsurface,
    material_disney, material_fourier, material_mix;

const struct material_row *const material_rows[] = {
    &material_matte,   &material_mirror, &material_glass,       &material_metal,      &material_plastic,
    &material_substrate, &material_uber, &material_translucent, &material_subsurface, &material_kdsubsurface,
    &material_disney,  &material_fourier, &material_mix,        NULL};

static int *place_of(struct material *m, const struct field *f) { return (int *)(void *)((char *)m + f->place); }

struct material *material_new(const struct material_row *row)
{
    struct material *m = mem_alloc(1, row->size);
    m->row = row;
    m->bump = m->rough.u = m->rough.v = -1;
    m->reads_uv = m->reads_partials = true;
    for (const struct field *f = row->fields; f->name != NULL; f++)
        if (f->kind == FIELD_FLOAT_TEXTURE || f->kind == FIELD_RGB_TEXTURE)
            *place_of(m, f) = -1;
    return m;
}

void material_settle(struct material *m, struct material *const *materials)
{
    const struct material *first = NULL;
    m->most_lobes = m->row->most_lobes;
    for (const struct field *f = m->row->fields; f->name != NULL; f++)
        if (f->kind == FIELD_PART) {
            const struct material *part = materials[*place_of(m, f)];
            m->most_lobes += part->most_lobes;
            if (first == NULL)
                first = part;
        }
    if (first != NULL)
        m->bump = first->bump;
    if (m->rough.v < 0)
        m->rough.v = m->rough.u;
}

/* Is, or may it be, another along u than along v? */
static bool is_brushed(const struct material *m, const struct texture_set *textures)
{
    if (m->row->may_be_brushed || m->rough.u == m->rough.v)
        return m->row->may_be_brushed;
    const struct texture *u = &textures->texture[m->rough.u], *v = &textures->texture[m->rough.v];
    return u->kind != TEXTURE_CONSTANT || v->kind != TEXTURE_CONSTANT || u->constant.r != v->constant.r;
}

/* The lobes at a point. */
static void make_lobes(const struct material *m, struct lobe_list list, struct arena *arena, struct bsdf *out)
{
    list.lobe = arena_alloc(arena, (size_t)m->most_lobes * sizeof *list.lobe);
    m->row->lobes(&list, m);
    bsdf_make(out, list.lobe, list.n);
}

void material_prepare(struct material *const *materials, int id, const struct texture_set *textures,
                      struct arena *arena)
{
    struct material *m = materials[id];
    m->reads_partials = m->bump >= 0 || is_brushed(m, textures);
    m->reads_uv = false;
    for (const struct field *f = m->row->fields; f->name != NULL; f++) {
        bool texture = f->kind == FIELD_FLOAT_TEXTURE || f->kind == FIELD_RGB_TEXTURE;
        if (f->kind == FIELD_PART)
            m->reads_uv |= materials[*place_of(m, f)]->reads_uv;
        else if (texture && *place_of(m, f) >= 0)
            m->reads_uv |= textures->texture[*place_of(m, f)].kind != TEXTURE_CONSTANT;
    }
    if (!m->reads_uv)
        make_lobes(m, (struct lobe_list){.materials = materials, .textures = textures}, arena, &m->same);
}

void material_bsdf(struct material *const *materials, int id, const struct texture_set *textures,
                   const struct surface *at, struct arena *arena, struct bsdf *out)
{
    const struct material *m = materials[id];
    if (m->same.lobe != NULL)
        *out = m->same;
    else
        make_lobes(m, (struct lobe_list){.materials = materials, .textures = textures, .at = at}, arena, out);
    out->ng = at->ng;
    out->shading = m->bump >= 0           ? bump_frame(textures, m->bump, at)
                   : m->reads_partials ? frame_from_tangent(at->ns, at->dpdu)
                                       : frame_from_normal(at->ns);
}

/* --- bump maps --------------------------------------------------------------------------------------- */

/* Texture coordinates by which the displacement is differenced: pbrt-v3's choice for rays without differentials. */
static const double BUMP_STEP = 0.0005;

/* The displacement a step away from the point. */
static double displaced(const struct texture_set *textures, int id, const struct surface *at, double du, double dv)
{
    struct surface shifted = *at;
    shifted.p = add(at->p, add(mul(at->dpdu, du), mul(at->dpdv, dv)));
    shifted.u = at->u + du;
    shifted.v = at->v + dv;
    return texture_float(textures, id, &shifted);
}

/* Partial derivative of the displaced point p + d ns: dp + (dd) ns + d (dns). */
static vec3 partial(vec3 dp, vec3 dn, vec3 ns, double d, double d_shifted)
{
    return add(add(dp, mul(ns, (d_shifted - d) / BUMP_STEP)), mul(dn, d));
}

struct frame bump_frame(const struct texture_set *textures, int displacement, const struct surface *at)
{
    double d = texture_float(textures, displacement, at);
    vec3 dpdu = partial(at->dpdu, at->dndu, at->ns, d, displaced(textures, displacement, at, BUMP_STEP, 0));
    vec3 dpdv = partial(at->dpdv, at->dndv, at->ns, d, displaced(textures, displacement, at, 0, BUMP_STEP));
    vec3 n = normalize(cross(dpdu, dpdv));
    if (!(fabs(length2(n) - 1) < 1e-6)) /* zero, NaN, or lost in under- or overflow */
        return frame_from_tangent(at->ns, at->dpdu);
    return frame_from_tangent(faceforward(n, at->ng), dpdu);
}
