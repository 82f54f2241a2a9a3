/* mapping.c: see mapping.h. */
#include "material/mapping.h"

#include "base/maths.h"

static struct st st_of(double s, double t)
{
    struct st st = {s, t};
    return st;
}

struct st map_point(const struct mapping *m, const struct transform *spaces, const struct surface *at)
{
    switch (m->kind) {
    case MAPPING_UV: return st_of(m->su * at->u + m->du, m->sv * at->v + m->dv);
    case MAPPING_SPHERICAL: {
        vec3 w = normalize(transform_point_back(&spaces[m->space], at->p));
        double turns = m_atan2(w.y, w.x) / (2 * PI);
        return st_of(m_acos(clamp(w.z, -1, 1)) / PI, turns < 0 ? turns + 1 : turns);
    }
    case MAPPING_CYLINDRICAL: {
        vec3 w = normalize(transform_point_back(&spaces[m->space], at->p));
        return st_of(0.5 + m_atan2(w.y, w.x) / (2 * PI), w.z);
    }
    case MAPPING_PLANAR: return st_of(dot(at->p, m->v1) + m->du, dot(at->p, m->v2) + m->dv);
    }
    return st_of(0, 0);
}
