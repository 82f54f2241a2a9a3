/* visible.h: visibility alone, between two points, by scene_edge. Primitives as shape_prim_id numbers them; 0: none.
 */
#ifndef CAUSTICS_VISIBLE_H
#define CAUSTICS_VISIBLE_H

#include "scene/scene.h"

/* scene_lit_from: does light from infinity, in unit direction w, reach a? */
static inline bool scene_lit_from(const struct scene *s, vec3 a, uint64_t from, vec3 w)
{
    struct ray ray = {a, w, 0, INFINITY, from, 0};
    struct edge edge;
    return scene_edge(s, &ray, 0, true, &edge);
}

static inline bool scene_reaches(const struct scene *s, vec3 a, uint64_t from, vec3 b, uint64_t to, bool emitted)
{
    vec3 d = sub(b, a);
    double distance = length(d);
    struct ray ray = {a, mul(d, 1 / distance), 0, distance, from, to};
    struct edge edge;
    return scene_edge(s, &ray, 0, emitted, &edge);
}

/* scene_lit: does light that is emitted at b reach a? scene_visible: the same of light that is scattered there. */
static inline bool scene_lit(const struct scene *s, vec3 a, uint64_t from, vec3 b, uint64_t to)
{
    return scene_reaches(s, a, from, b, to, true);
}
static inline bool scene_visible(const struct scene *s, vec3 a, uint64_t from, vec3 b, uint64_t to)
{
    return scene_reaches(s, a, from, b, to, false);
}

#endif
