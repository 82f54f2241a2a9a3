/* light.h: the emitters and how to sample them: emission for light sub-paths, and a fresh end point for s = 1.
 *
 * Five kinds. Area lights are one per primitive. A light's end point y0 is a point in space (area, point, spot) or a
 * direction (distant, infinite): then y0 lies "at infinity" and its density is per steradian.
 *
 * Lights are chosen in proportion to their power, or uniformly, by an alias table; s = 1 and emission use the same
 * choice and the same density of y0, so one number serves both in the MIS weights.
 *
 * A ray that leaves the scene meets all infinite lights at once. So they are one light, the sky, which is the sum of
 * its layers. Its directions have one density, whichever layer sends light from there.
 *
 * Tests: test_light.c.
 */
#ifndef ASBDPT_LIGHT_H
#define ASBDPT_LIGHT_H

#include "base/alias.h"
#include "base/rgb.h"
#include "base/transform.h"
#include "geometry/shape.h"
#include "scene/envmap.h"

enum light_kind {
    LIGHT_AREA,
    LIGHT_POINT,
    LIGHT_SPOT,
    LIGHT_DISTANT,
    LIGHT_INFINITE
};
extern const char *const LIGHT_KINDS[]; /* by enum light_kind: "area" */

/* A light. What its fields mean depends on its kind; a dash: not used.
 *
 *              area                point              spot                  distant                infinite
 *   L          radiance,           intensity, W/sr    intensity, W/sr       irradiance on a        factor of the map,
 *              W/(m^2 sr)                                                   facing surface, W/m^2  else radiance
 *   prim       the surface         -                  -                     -                      -
 *   two_sided  emits on both       -                  -                     -                      -
 *  and of its frame, which area lights have none of:
 *   to_world   -                   -                  light space to world  -                      light space to world
 *   position   -                   where it is        where it is           -                      -
 *   cos_total  -                   -                  dark beyond it        -                      -
 *   cos_falloff  -                 -                  full within it        -                      -
 *   direction  -                   -                  -                     unit, towards it       -
 *   env        -                   map, see below     picture, see below    -                      map, NULL: constant
 *   screen     -                   -                  see below             -                      -
 *
 * The beam of a spot runs along z in light space, and what a direction gets is asked there, as in pbrt-v3, so that an
 * uneven scale makes the beam elliptic. Two kinds of pbrt-v3 are these with a picture: a "goniometric" light is a point
 * with a map around it, whose intensity is a factor; to_world leads from the map's space. A "projection" light is a spot
 * that shines through a screen at distance 1, which reaches from -screen to screen on each axis and holds a picture, or
 * nothing; screen[0] is 0 of other spots. cos_total then is of the cone through the screen's corners.
 *
 * A light point (struct light_point) is a position (area, point, spot) or a direction (distant, infinite), and its
 * densities are per measure of that, which is why their names carry none:
 *
 *              area                point              spot                  distant                infinite
 *   p          on the surface      position           position              -                      -
 *   n          emitting side       0                  0                     0                      0
 *   w          -                   -                  -                     unit, towards it       unit, towards it
 *   prim_id    shape_prim_id       0                  0                     0                      0
 *   pdf_cell   1/m^2               1                  1                     1                      1/sr
 *   pdf_cell   (this, times the probability of the light in its cell)
 *   pdf        pdf_cell times the probability of the cell under `choice`, in all kinds
 *   emission's second draw is      a direction, 1/sr (area, point, spot)    an origin on a disk, 1/m^2
 */
struct light_frame {
    struct transform to_world;
    double volume;                 /* that to_world makes of 1; set by light_add */
    double cos_total, cos_falloff;
    vec3 position, direction;
    const struct envmap *env;      /* the set's */
    double screen[2];
};

struct light {
    enum light_kind kind;
    bool two_sided;
    bool hidden; /* from the lens: no path of two vertices has its light */
    int prim;
    int medium;              /* around it; area: unless its shape bounds media */
    int group;               /* see light_group */
    int cell;                /* its cell, see below; of the sky the first; set by light_prepare */
    rgb L;
    double power;            /* W, luminance: by it lights are chosen; set by light_prepare. See light_watts */
    struct light_frame *frame; /* owned by the set; area: NULL, for there may be one for each triangle of a mesh */
};

/* Lights whose contributions a film can keep apart from others' (film.h). The sky is of one group. */
struct light_group {
    char *name; /* owned; NULL: it has none */
    enum light_kind kind; /* of its first light */
};
enum { LIGHT_MAX_GROUPS = 64 }; /* that films keep */

/* The sky is cut into cells of directions, at most SKY_CELLS. Every other light is in one cell, alone or with its
 * neighbours if there are more than LAMP_CELLS. Where the sky stands between them, one cell more. */
struct light_cell {
    int light, n; /* the first light and how many; of the sky 1 */
};
enum { LAMP_CELLS = 256, SKY_CELLS = 512, LIGHT_CELLS = LAMP_CELLS + 1 + SKY_CELLS };

/* All lights of a scene and what sampling them needs. A cell is chosen first, then a light in it, then a point on the
 * light. */
struct light_set {
    struct light *light; /* [n], owned */
    int n;
    int sky;             /* number of the sky among them, if there are layers */
    struct light *layer; /* [n_layers] infinite lights; owned */
    int n_layers;
    struct envmap *sum;  /* for drawing directions of several layers; NULL if there are fewer; owned */
    struct envmap **map; /* [n_maps], each of any number of lights; owned with what they point to */
    int n_maps;
    struct light_group *group; /* [n_groups], owned */
    int n_groups;
    struct light_cell *cell;   /* [n_cells], owned */
    int n_cells;
    double *before;            /* [n] weight (weight_of) of the lights before this one in its cell; owned */
    bool uniform;              /* lights are chosen uniformly; else by power */
    struct alias_table choice; /* of a cell, by that */
    vec3 center;               /* bounding sphere of the scene */
    double radius;             /* > 0 */
};

/* Every ray that leaves the scene asks all of them. */
enum { LIGHT_MAX_LAYERS = 1 << 12 };

/* light_add: returns the number of the light; of an infinite light that of the sky.
 *   frame  copied; NULL for area lights */
int light_add(struct light_set *set, struct light l, const struct light_frame *frame);

/* light_group: the group of that name, or, if there is none, or the name is NULL, a new one. Names are looked for among
 * the first LIGHT_MAX_GROUPS groups alone: if there are more, no film keeps any. */
int light_group(struct light_set *set, const char *name, enum light_kind kind);

/* light_read_map: the number of a map that is read from this file, which may use this memory; -1 with a message. */
int light_read_map(struct light_set *set, const char *path, const struct budget *memory, struct error *err);

/* light_watts: what a light of a prepared set sends into the scene, W, luminance: of one at infinity, what enters the
 * scene's sphere. `power` is of a sky only what crosses a disk, pi R^2 pi L. All directions w cross a disk each,
 * pi R^2 4 pi L. */
static inline double light_watts(const struct light *l) { return l->power * (l->kind == LIGHT_INFINITE ? 4 : 1); }

/* light_prepare: powers, the choice table, the scene's sphere. Call once the geometry is complete. */
void light_prepare(struct light_set *set, const struct geometry *geo, vec3 center, double radius);
void light_set_free(struct light_set *set);

/* light_uniform: *out becomes a set of the same lights that chooses all that emit with the same probability, as
 * pbrt-v3 does by "uniform". A layer of the sky counts as a light; a light's own cells are chosen by power. *out shares
 * all else with the prepared *set, which must outlive it; light_uniform_free releases it. */
void light_uniform(const struct light_set *set, struct light_set *out);
void light_uniform_free(struct light_set *set);

/* Delta lights cannot be hit (s = 0 is impossible). */
static inline bool light_is_delta(const struct light *l)
{
    return l->kind != LIGHT_AREA && l->kind != LIGHT_INFINITE;
}

/* Lights whose end point is a direction. */
static inline bool light_at_infinity(const struct light *l)
{
    return l->kind == LIGHT_DISTANT || l->kind == LIGHT_INFINITE;
}

/* A light's end point y0; see the table above. */
struct light_point {
    int light, cell;
    vec3 p, n, w;
    uint64_t prim_id;
    double pdf_cell, pdf;
};

/* light_sample_cell: draw a light point from a cell. False where none can be drawn, or where an area light has a hole
 * (its alpha texture is 0): nothing is emitted there, and the sample counts as black.
 *   u  uniform numbers, for the light and for the point */
bool light_sample_cell(const struct light_set *set, const struct geometry *geo, int cell, const double u[3],
                       struct light_point *out);

/* light_sample_emission: given y0, draw the direction (or, at infinity, the origin on a disk) of an emitted ray.
 *   ray    out: origin and unit direction of travel
 *   pdf    out: density of the second draw: 1/sr, or at infinity 1/m^2 on the disk
 * Returns emitted radiance times cosine at the light (1/sr-free: area: Le |cos|; point, spot: intensity; at
 * infinity: Le), so beta_1 = returned / (y0.pdf * pdf); black when nothing is emitted. */
rgb light_sample_emission(const struct light_set *set, const struct light_point *y0, const double u[2],
                          struct ray *ray, double *pdf);

/* light_pdf_emission: density of that second draw for a given direction w of travel, 1/sr; at infinity 1/m^2. */
double light_pdf_emission(const struct light_set *set, const struct light_point *y0, vec3 w);

/* light_emission_numbers: the u in [0,1)^2 for which light_sample_emission draws the ray of direction w from y0.
 *   p  at infinity: a point of that ray; else of no use */
void light_emission_numbers(const struct light_set *set, const struct light_point *y0, vec3 p, vec3 w, double u[2]);

/* light_Le: what y0 sends in the unit direction w of travel: area, infinite: radiance; point, spot etc.: intensity
 * (its inverse square law is the connection's G); distant: irradiance. */
rgb light_Le(const struct light_set *set, const struct light_point *y0, vec3 w);

/* light_Le_sky: radiance of the sky, or of those layers alone that the lens sees, for a ray leaving the scene in unit
 * direction w. */
rgb light_Le_sky(const struct light_set *set, vec3 w, bool seen);

/* light_pdf_sky: density of the light point in direction w (from the scene towards the sky), cells being chosen by
 * power, 1/sr; 0 if there is no sky.
 *   cell  out, the one it lies in; -1 if there is no sky */
double light_pdf_sky(const struct light_set *set, vec3 w, int *cell);

/* light_pdf_surface: the same of this point of an area light, 1/m^2; 0 on other surfaces. */
double light_pdf_surface(const struct light_set *set, const struct geometry *geo, const struct surface *at);

#endif
