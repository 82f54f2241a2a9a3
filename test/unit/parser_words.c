/* parser_words.c: a scene in words, and what its comments say that it holds. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "parser/parse.h"
#include "parser_parts.h"

/* A scene in words, as far as these tests look at it. */
struct words {
    char text[16384];
    size_t n;
};

static void put(struct words *w, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int n = vsnprintf(w->text + w->n, sizeof w->text - w->n, format, args);
    va_end(args);
    w->n = w->n + (size_t)n < sizeof w->text ? w->n + (size_t)n : sizeof w->text - 1;
}

/* To nine digits behind the point, and no number is -0. */
static void put3(struct words *w, const char *name, double x, double y, double z)
{
    put(w, " %s %g %g %g", name, rint(x * 1e9) / 1e9 + 0, rint(y * 1e9) / 1e9 + 0, rint(z * 1e9) / 1e9 + 0);
}

/* A texture parameter: its value if that is constant, else the texture's number; nothing for -1. */
static void put_texture(struct words *w, const struct scene *s, const char *name, int id)
{
    const struct texture *t = &s->textures.texture[id];
    if (id >= 0 && t->kind == TEXTURE_CONSTANT)
        put3(w, name, t->constant.r, t->constant.g, t->constant.b);
    else if (id >= 0)
        put(w, " %s texture %d", name, id);
}

static const char *kind_name(const struct object_type *types, int kind, const char *fallback)
{
    while (types->name != NULL && types->kind != kind)
        types++;
    return types->name != NULL ? types->name : fallback;
}

static void put_options(struct words *w, const struct scene *s)
{
    const struct camera *c = &s->camera;
    const struct filter *f = &s->filter;
    put(w, "film %dx%d scale %g crop %g %g %g %g file %s\n", s->width, s->height, s->film_scale, s->crop[0], s->crop[1],
        s->crop[2], s->crop[3], s->film_filename != NULL ? s->film_filename : "none");
    vec3 world = transform_point(&c->world_to_camera, neg(s->origin));
    put(w, "camera %d fov %g aspect %g lens %g %g window %d %g %g %g %g", (int)c->kind, c->fov, c->frame_aspect_ratio,
        c->lens_radius, c->focal_distance, c->has_screen_window, c->screen_window[0], c->screen_window[1],
        c->screen_window[2], c->screen_window[3]);
    put3(w, "world at", world.x, world.y, world.z);
    put(w, "\nfilter %d radius %g %g alpha %g B %g C %g tau %g\n", (int)f->kind, f->radius[0], f->radius[1], f->alpha,
        f->B, f->C, f->tau);
    put(w, "spp %d integrator %s\n", s->spp, s->integrator != NULL ? s->integrator : "none");
    for (const struct setting *i = s->settings.item; i < s->settings.item + s->settings.n; i++)
        put(w, "setting %s %s %s is %.17g\n", i->name, i->value, i->origin, i->number);
}

/* Where the origin of a texture's space lies. */
static void put_space(struct words *w, const struct texture_set *set, int space)
{
    vec3 o = space < set->n_spaces ? transform_point(&set->space[space], vec(0, 0, 0)) : vec(0, 0, 0);
    put3(w, "space", o.x, o.y, o.z);
    put(w, "\n");
}

static void put_textures(struct words *w, const struct scene *s)
{
    for (int i = 0; i < s->textures.n_textures; i++) {
        const struct texture *t = &s->textures.texture[i];
        if (t->kind == TEXTURE_CONSTANT)
            continue;
        put(w, "texture %d %s", i, kind_name(TEXTURE_TYPES, (int)t->kind, "cubes"));
        if (t->kind == TEXTURE_IMAGEMAP)
            put(w, " image %d wrap %d scale %g gamma %d", t->image, (int)t->wrap, t->scale, t->gamma);
        else if (t->kind == TEXTURE_BILERP) {
            const rgb v[4] = {t->v00, t->v01, t->v10, t->v11};
            for (int k = 0; k < 4; k++)
                put3(w, k == 0 ? "values" : "and", v[k].r, v[k].g, v[k].b);
        } else {
            put_texture(w, s, "tex1", t->tex1);
            put_texture(w, s, "tex2", t->tex2);
        }
        if (t->kind == TEXTURE_MIX)
            put_texture(w, s, "amount", t->amount);
        const struct mapping *m = &t->map;
        put(w, " mapping %d %g %g %g %g", (int)m->kind, m->su, m->sv, m->du, m->dv);
        put3(w, "v1", m->v1.x, m->v1.y, m->v1.z);
        put3(w, "v2", m->v2.x, m->v2.y, m->v2.z);
        put(w, " noise %d %g %g %g", t->octaves, t->omega, t->scale, t->variation);
        bool round = m->kind == MAPPING_SPHERICAL || m->kind == MAPPING_CYLINDRICAL;
        put_space(w, &s->textures, round ? m->space : t->space);
    }
}

static const struct field *first_at(const struct field *f, size_t place)
{
    while (f->place != place)
        f++;
    return f;
}

static void put_material(struct words *w, const struct scene *s, int i)
{
    const struct material *m = s->material[i];
    put(w, "material %d %s", i, m->row->name);
    for (const struct field *f = m->row->fields; f->name != NULL; f++) {
        if (first_at(m->row->fields, f->place) != f) /* another name of what is there already */
            continue;
        const void *place = (const char *)m + f->place;
        if (f->kind == FIELD_FLOAT_TEXTURE || f->kind == FIELD_RGB_TEXTURE)
            put_texture(w, s, f->name, *(const int *)place);
        else if (f->kind == FIELD_PART)
            put(w, " %s %d", f->name, *(const int *)place);
        else if (f->kind == FIELD_SWITCH)
            put(w, " %s %d", f->name, *(const bool *)place);
    }
    put(w, "\n");
}

static void put_media(struct words *w, const struct scene *s)
{
    put(w, "the lens is in medium %d\n", s->camera.medium);
    for (int i = 0; s->space != NULL && i < s->space->n; i++) {
        const struct medium *m = &s->space->medium[i];
        put(w, "medium of material %d", m->material);
        put3(w, "s", m->sigma_s.r, m->sigma_s.g, m->sigma_s.b);
        put3(w, "t", m->sigma_t.r, m->sigma_t.g, m->sigma_t.b);
        put(w, "\n");
    }
}

static void put_shapes(struct words *w, const struct scene *s)
{
    const struct geometry *geo = &s->geo;
    for (int i = 0; i < geo->n_groups; i++) {
        const struct shape_group *g = &geo->group[i];
        put(w, "group of material %d light %d flip %d N %d uv %d", g->material, g->first_light, g->flip, g->has_n,
            g->has_uv);
        put_texture(w, s, "alpha", g->alpha);
        put(w, " media %d %d tangents %d\n", g->medium[0], g->medium[1], g->has_s);
    }
    for (int i = 0; i < geo->n_quadrics; i++) {
        const struct quadric *q = &geo->quadric[i];
        vec3 at = transform_point(&q->to_world, vec(0, 0, 0));
        put(w, "quadric %d radius %g inner %g z %g %g phi %g", (int)q->kind, q->radius, q->inner_radius, q->zmin,
            q->zmax, q->phi_max);
        put3(w, "at", at.x, at.y, at.z);
        put3(w, "from", q->p1.x, q->p1.y, q->p1.z);
        put3(w, "to", q->p2.x, q->p2.y, q->p2.z);
        put(w, "\n");
    }
    for (int i = 0; i < geo->curves.n; i++) {
        const struct curve *c = &geo->curves.curve[i];
        put(w, "curve %d: %d pieces ribbon %d radius %g %g u %g %g", i, c->net.pieces, c->net.ribbon,
            (double)c->net.radius[0], (double)c->net.radius[1], (double)c->net.u[0], (double)c->net.u[1]);
        put3(w, "from", (double)c->P[0][0], (double)c->P[0][1], (double)c->P[0][2]);
        put3(w, "to", (double)c->P[3][0], (double)c->P[3][1], (double)c->P[3][2]);
        put3(w, "guide", (double)c->net.guide[0][0], (double)c->net.guide[0][1], (double)c->net.guide[0][2]);
        put(w, "\n");
    }
    put(w, "%d triangles of %d points\n", geo->n_triangles, geo->n_vertices);
    for (int i = 0; i < geo->n_vertices; i++) {
        const float *P = geo->P + 3 * i, *uv = geo->UV + 2 * i;
        put(w, "point %d: %.9g %.9g %.9g uv %g %g\n", i, (double)P[0], (double)P[1], (double)P[2], (double)uv[0],
            (double)uv[1]);
    }
    for (const uint32_t *k = geo->index; k < geo->index + 3 * geo->n_triangles; k += 3)
        put(w, "triangle %d %d %d\n", (int)k[0], (int)k[1], (int)k[2]);
}

/* All lights, and the sky's layers. */
static void put_lights(struct words *w, const struct scene *s)
{
    for (int i = 0; i < s->lights.n + s->lights.n_layers; i++) {
        int layer = i - s->lights.n;
        const struct light *l = layer < 0 ? &s->lights.light[i] : &s->lights.layer[layer];
        const struct light_frame none = {.to_world = transform_identity()}, *f = l->frame != NULL ? l->frame : &none;
        vec3 axis = transform_vector(&f->to_world, vec(0, 0, 1));
        put(w, "%s %d %s", layer < 0 ? "light" : "layer", layer < 0 ? i : layer,
            kind_name(LIGHT_DIRECTIVES[1].types, (int)l->kind, "area"));
        put3(w, "L", l->L.r, l->L.g, l->L.b);
        put3(w, "at", f->position.x, f->position.y, f->position.z);
        put3(w, "towards", f->direction.x, f->direction.y, f->direction.z);
        put3(w, "axis", axis.x, axis.y, axis.z);
        put(w, " cosines %.4f %.4f two-sided %d prim %d picture %d", f->cos_total, f->cos_falloff, l->two_sided,
            l->prim, f->env != NULL);
        if (f->env != NULL)
            put3(w, "mean", f->env->mean.r, f->env->mean.g, f->env->mean.b);
        put(w, " medium %d hidden %d group %s\n", l->medium, l->hidden,
            s->lights.group[l->group].name != NULL ? s->lights.group[l->group].name : "none");
    }
}

char *scene_in_words(struct test *t, const struct scene *s)
{
    struct words *w = mem_alloc(1, sizeof *w);
    put_options(w, s);
    put_textures(w, s);
    for (int i = 0; i < s->n_materials; i++)
        put_material(w, s, i);
    put_media(w, s);
    put_shapes(w, s);
    put_lights(w, s);
    leave_out_directory(t, w->text);
    char *text = mem_copy_text(w->text);
    free(w);
    return text;
}

/* "# has: ..." in a scene's comments are parts of its words, in their order. */
void check_contents(struct test *t, const char *name, const char *text, const struct scene *s)
{
    char *words = scene_in_words(t, s);
    const char *from = words;
    for (const char *p = strstr(text, "# has: "); p != NULL; p = strstr(p + 1, "# has: ")) {
        char want[TEXT];
        snprintf(want, sizeof want, "%.*s", (int)strcspn(p + 7, "\n"), p + 7);
        const char *found = strstr(from, want);
        if (CHECK(t, found != NULL, "%s: no \"%s\" in\n%s", name, want, from))
            from = found + strlen(want);
    }
    free(words);
}
