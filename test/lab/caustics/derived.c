/* derived.c: see derived.h. */
#include "caustics/derived.h"

double light_distance(const struct light_set *set, vec3 p, vec3 w)
{
    return fmax(set->radius - dot(sub(p, set->center), w), 0);
}

static double lens_distance(const struct scene *scene, vec3 p)
{
    return length(sub(p, camera_sample_lens(&scene->camera, p, 0.5, 0.5)));
}

static double edge_length(const struct scene *scene, const struct vertex *a, const struct vertex *b)
{
    bool through_lens = a->kind == VERTEX_LENS && scene->camera.lens_radius > 0;
    if (vertex_at_infinity(scene, a))
        return light_distance(&scene->lights, b->p, a->wo);
    if (b->kind == VERTEX_ESCAPED)
        return light_distance(&scene->lights, through_lens ? scene->camera.position : a->p, neg(b->wo));
    return a->kind == VERTEX_LENS ? lens_distance(scene, b->p) : length(sub(b->p, a->p));
}

double subpath_length(const struct scene *scene, const struct vertex *path, int n)
{
    double sum = 0;
    for (int i = 1; i < n; i++)
        sum += edge_length(scene, &path[i - 1], &path[i]);
    return sum;
}

double path_length(const struct scene *scene, const struct joined *j)
{
    if ((j->t > 1 && j->z == NULL) || (j->s > 0 && j->path == NULL))
        return NAN;
    double light = j->s > 1 ? subpath_length(scene, j->path, j->s) : 0;
    if (j->t == 1)
        return light + lens_distance(scene, j->path[j->s - 1].p);
    const struct vertex *eye = j->z + 1 - j->t, *z = j->z;
    if (j->s == 0)
        return subpath_length(scene, eye, j->t - 1) + edge_length(scene, z - 1, z->lamp != NULL ? z->lamp : z);
    return light + subpath_length(scene, eye, j->t) + edge_length(scene, &j->path[j->s - 1], z);
}

vec3 lens_drawn(const struct camera *camera, vec3 p, struct sampler sampler)
{
    double u[2] = {0, 0};
    if (camera->lens_radius > 0)
        sampler_pair(&sampler, DRAW_LENS_POINT, u);
    return camera_sample_lens(camera, p, u[0], u[1]);
}

const char *vertex_material(const struct scene *scene, const struct vertex *v)
{
    return scene->material[shape_group_of(&scene->geo, shape_prim(v->prim_id))->material]->row->name;
}

/* --- the other walk ------------------------------------------------------------------------------------------- */

bool bsdf_delta(const struct bsdf *b, vec3 wo, bool transmit, enum transport mode, struct bsdf_sample *out)
{
    vec3 o = to_local(&b->shading, wo);
    bool found = false;
    for (const struct lobe *l = b->lobe; o.z != 0 && l < b->lobe + b->n_lobes; l++) {
        struct bsdf_sample s;
        if (!lobe_is_delta(l->kind) || !lobe_sample_delta(l, o, transmit ? below_one(1) : 0, mode, &s) ||
            (s.wi.z * o.z < 0) != transmit || rgb_is_black(s.f) || (found && length2(sub(s.wi, out->wi)) > 1e-24))
            continue;
        s.f = rgb_scale(s.f, fabs(s.wi.z));
        s.pdf *= l->choice;
        s.pdf_rev *= l->choice;
        if (found) {
            s.f = rgb_add(s.f, out->f);
            s.pdf += out->pdf;
            s.pdf_rev += out->pdf_rev;
        }
        *out = s;
        found = true;
    }
    if (found)
        out->wi = to_world(&b->shading, out->wi);
    return found;
}

/* All delta lobes with one direction have the same ratio of the two densities. */
static double delta_pdf_rev(const struct vertex *v, const struct vertex *next, enum transport mode)
{
    vec3 w = neg(next->wo), o = to_local(&v->bsdf.shading, v->wo), i = to_local(&v->bsdf.shading, w);
    double falloff = next->kind == VERTEX_ESCAPED ? 1 : 1 / length2(sub(next->p, v->p));
    double pdf = next->pdf_fwd / (vertex_cosine(next, w) * falloff);
    for (const struct lobe *l = v->bsdf.lobe; l < v->bsdf.lobe + v->bsdf.n_lobes; l++) {
        struct bsdf_sample s;
        if (lobe_is_delta(l->kind) && lobe_sample_delta(l, o, i.z * o.z < 0 ? below_one(1) : 0, mode, &s) &&
            length2(sub(s.wi, i)) < 1e-16)
            return pdf * s.pdf_rev / s.pdf;
    }
    return 0;
}

double vertex_pdf_rev(const struct vertex *v, const struct vertex *next, enum transport mode)
{
    if (v->kind != VERTEX_SURFACE && v->kind != VERTEX_MEDIUM)
        return 0;
    return next->prev_delta ? delta_pdf_rev(v, next, mode) : bsdf_eval(&v->bsdf, v->wo, neg(next->wo), mode).pdf_rev;
}
