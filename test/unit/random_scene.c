/* random_scene.c: see random_scene.h. */
#include "random_scene.h"

#include <math.h>
#include <stdlib.h>

#include "base/maths.h"
#include "random_parts.h"

/* --- before the world ----------------------------------------------------------------------------------- */

/* How the scene is seen. `unit` is how long a unit is in the world. */
struct view {
    vec3 eye, look;
    double fov; /* degrees, of the perspective camera, which `plain` asks for; below 1: all rays are the same */
    double unit;
    bool plain;
};

/* Directions ahead stay ahead under this map of camera space, and about where they were. */
static struct map before_camera(struct writer *w)
{
    vec3 s = stretches(w, 0.6, 1.7);
    struct map m = {vec(s.x, 0, 0), vec(0, s.y, 0), vec(0, 0, s.z)};
    if (chance(w, 0.3))
        m.x = neg(m.x);
    if (chance(w, 0.4))
        m.y.x = between(w, -0.5, 0.5);
    if (chance(w, 0.4))
        m.x.z = between(w, -0.2, 0.2);
    return chance(w, 0.3) ? map_identity() : m;
}

/* Move what follows, or, by -1, back. The parser takes lengths up to 1e12. */
static void move(struct writer *w, double unit, double sign)
{
    put(w, "Translate ");
    put_vec(w, mul(vec(0.6, -0.48, 0.64), sign * fmin(w->away * unit, 5e11)));
}

static void camera(struct writer *w, const struct view *v)
{
    struct map m = before_camera(w);
    int kind = v->plain ? 0 : pick(w, 5);
    double distance = length(sub(v->look, v->eye)) * length(m.z);
    put_map(w, &m);
    put(w, "LookAt ");
    put_vec(w, mul(v->eye, v->unit));
    put_vec(w, mul(v->look, v->unit));
    put_vec(w, fabs(normalize(sub(v->look, v->eye)).y) < 0.95 ? vec(0.1, 1, 0) : vec(1, 0, 0.1));
    move(w, v->unit, -1);
    put(w, "\nCamera ");
    if (kind == 3) {
        const double window[4] = {-1.5 * v->unit, 1.7 * v->unit, -1.6 * v->unit, 1.4 * v->unit};
        put(w, "\"orthographic\" ");
        put_list(w, "float", "screenwindow", 4, window);
    } else if (kind == 4) {
        put(w, "\"environment\" ");
    } else {
        put(w, "\"perspective\" ");
        put_float(w, "fov", v->fov);
        if (!v->plain && chance(w, 0.2))
            put(w, "\"float screenwindow\" [ -.9 1.1 -1.2 .8 ] ");
    }
    if (!v->plain && kind < 4 && chance(w, 0.3)) {
        put_float(w, "lensradius", between(w, 0.05, 0.3) * v->unit);
        put_float(w, "focaldistance", distance * between(w, 0.7, 1.3) * v->unit);
    }
    put(w, "\n");
}

static void film(struct writer *w, bool tiny)
{
    static const char *const FILTERS[] = {"box", "triangle", "gaussian", "mitchell", "sinc"};
    if (tiny) {
        put(w, "Film \"image\" \"integer xresolution\" 2 \"integer yresolution\" 2 PixelFilter \"box\"\n");
        return;
    }
    put(w, "Film \"image\" \"integer xresolution\" %d ", 10 + pick(w, 8));
    put(w, "\"integer yresolution\" %d ", 10 + pick(w, 8));
    if (chance(w, 0.25)) {
        vec3 low = within(w, vec(0, 0, 0), vec(0.4, 0.4, 0)), high = within(w, vec(0.6, 0.6, 0), vec(1, 1, 0));
        const double crop[4] = {low.x, high.x, low.y, high.y};
        put_list(w, "float", "cropwindow", 4, crop);
    }
    put(w, "\nPixelFilter \"%s\" ", FILTERS[pick(w, 5)]);
    if (chance(w, 0.5)) {
        put_float(w, "xwidth", between(w, 0.5, 3));
        put_float(w, "ywidth", between(w, 0.5, 3));
    }
    put(w, "\n");
}

static void begin(struct writer *w, const struct view *v, int max_depth)
{
    film(w, v->fov < 1);
    put(w, "Sampler \"halton\" \"integer pixelsamples\" 4 Accelerator \"bvh\"\n");
    put(w, "Integrator \"bdpt\" \"integer maxdepth\" %d\n", max_depth);
    if (w->media)
        put_media(w, v->unit);
    camera(w, v);
    put(w, "WorldBegin\n");
    move(w, v->unit, 1);
    put(w, "Scale ");
    put_vec(w, vec(v->unit, v->unit, v->unit));
    put(w, "\n");
}

/* Mostly 1; else anything from a hundredth of a millimetre to a hundred kilometres. */
static double unit(struct writer *w) { return chance(w, 0.6) ? 1 : across(w, 1e-5, 1e5); }

static void seen_by(struct writer *w, struct random_scene *s, struct view *v, double distance)
{
    v->look = mul(direction(w), 0.2);
    v->eye = mul(direction(w), distance);
    v->fov = between(w, 25, 45);
    v->unit = s->unit = unit(w);
}

/* --- furnaces ------------------------------------------------------------------------------------------- */

/* All that can be seen shines with e and reflects a share a of what comes, so that after d reflections a ray has met
 * e (1 + a + ... + a^d). */
static void closed_furnace(struct writer *w, struct random_scene *s)
{
    struct view v;
    double a = between(w, 0.2, 0.6), e = between(w, 0.5, 2);
    seen_by(w, s, &v, 2);
    v.plain = chance(w, 0.4);
    s->max_depth = 1 + pick(w, 5);
    s->known = true;
    s->low = s->high = e * (1 - pow(a, s->max_depth + 1)) / (1 - a);
    begin(w, &v, s->max_depth);
    put(w, "AreaLightSource \"diffuse\" \"bool twosided\" \"true\" ");
    put_rgb(w, "L", e, e, e);
    put(w, "\nMaterial \"matte\" ");
    put_rgb(w, "Kd", a, a, a);
    for (int i = pick(w, 3); i >= 0; i--) {
        bool outer = i == 0;
        struct map any = map_random(w), m = map_scaled(any, outer ? 8 : between(w, 0.2, 0.4));
        put(w, "\nAttributeBegin ");
        if (!outer) {
            put(w, "Translate ");
            put_vec(w, mul(direction(w), 0.4));
        }
        put_map(w, &m);
        if (outer && chance(w, 0.5))
            put(w, "Shape \"trianglemesh\" \"integer indices\" "
                   "[ 0 1 3 0 3 2 4 5 7 4 7 6 0 1 5 0 5 4 2 3 7 2 7 6 0 2 6 0 6 4 1 3 7 1 7 5 ]\n"
                   "  \"point P\" [ -1 -1 -1 1 -1 -1 -1 1 -1 1 1 -1 -1 -1 1 1 -1 1 -1 1 1 1 1 1 ]\n");
        else
            put(w, "Shape \"sphere\"\n");
        put(w, "AttributeEnd\n");
    }
}

/* Under a sky of 1 a convex thing of albedo a shows a; here a is 1, so nothing can be seen of it. Maps are constant. */
static void open_furnace(struct writer *w, struct random_scene *s)
{
    struct view v;
    struct map m = map_random(w);
    seen_by(w, s, &v, 4);
    v.plain = chance(w, 0.4);
    s->max_depth = 1 + pick(w, 3);
    s->known = true;
    s->low = s->high = 1;
    begin(w, &v, s->max_depth);
    put(w, "AttributeBegin ");
    put_map(w, &m);
    if (chance(w, 0.3))
        put(w, "LightSource \"infinite\" \"rgb L\" [ 1 1 1 ] AttributeEnd\n");
    else
        put(w, "LightSource \"infinite\" \"string mapname\" \"%stest/data/fixtures/parts/ones.pfm\" AttributeEnd\n", w->top);
    if (chance(w, 0.2)) {
        put(w, "Material \"mirror\" \"rgb Kr\" [ 1 1 1 ]\n");
        s->specular = true;
    } else {
        put(w, "Material \"matte\" \"rgb Kd\" [ 1 1 1 ]\n");
    }
    m = map_random(w);
    put_map(w, &m);
    put(w, "Shape \"%s\"\n", chance(w, 0.5) ? "sphere" : "disk");
}

/* --- direct light --------------------------------------------------------------------------------------- */

/* A patch about the origin of its space: normal, and shading normal where the camera looks. */
struct patch {
    vec3 at, n, ns; /* in the world */
};

static struct patch triangle_patch(struct writer *w, const struct map *m, vec3 at)
{
    vec3 z = direction(w), N[3];
    struct map flat = map_frame(z);
    struct patch p = {at, map_normal(m, z), {0, 0, 0}};
    put(w, "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 ] \"point P\" [ ");
    for (int i = 0; i < 3; i++)
        put_vec(w, map_apply(&flat, cylindrical(0.5, i * 2 * PI / 3, 0)));
    put(w, "] ");
    if (chance(w, 0.6)) {
        put(w, "\"normal N\" [ ");
        for (int i = 0; i < 3; i++) {
            N[i] = add(z, mul(direction(w), 0.3));
            N[i] = mul(N[i], across(w, 0.5, 2));
            put_vec(w, N[i]);
            p.ns = add(p.ns, map_normal(m, N[i]));
        }
        put(w, "] ");
    } else {
        p.ns = p.n;
    }
    put(w, "\n");
    p.n = normalize(p.n);
    p.ns = normalize(p.ns);
    return p;
}

static struct patch sphere_patch(struct writer *w, const struct map *m, vec3 at)
{
    vec3 z = direction(w);
    struct patch p = {add(at, map_apply(m, z)), normalize(map_normal(m, z)), {0, 0, 0}};
    p.ns = p.n;
    put(w, "Shape \"sphere\"\n");
    return p;
}

/* pbrt-v3's: the cosines are of the cone and of the cone less the soft edge, whatever its sign, in light space. */
static double spot_at(double cosine, double cone, double edge)
{
    double total = cos(cone * PI / 180), falloff = cos((cone - edge) * PI / 180);
    double share = (cosine - total) / (falloff - total);
    return cosine < total ? 0 : cosine >= falloff ? 1 : pow(share, 4);
}

/* A light that shines on the patch from direction wi: what arrives there per area that faces it. */
static double shine(struct writer *w, const struct patch *p, vec3 wi, double unit)
{
    double distance = between(w, 1, 3), strength = across(w, 1, 10);
    struct map m = map_random(w);
    put(w, "AttributeBegin ");
    if (chance(w, 0.25)) {
        put_map(w, &m);
        put(w, "LightSource \"distant\" ");
        put_rgb(w, "L", strength, strength, strength);
        put_point(w, "point", "from", map_back(&m, wi));
        put(w, "\"point to\" [ 0 0 0 ] AttributeEnd\n");
        return strength;
    }
    /* The cone's axis misses the patch by a share of the cone. */
    double cone = across(w, 1, 80), edge = chance(w, 0.5) ? 5 : across(w, 1, 80), miss = cone * between(w, 0, 0.9);
    struct map towards = map_frame(normalize(map_back(&m, neg(wi))));
    double phi = between(w, 0, 2 * PI);
    vec3 axis = map_apply(&towards, cylindrical(sin(miss * PI / 180), phi, cos(miss * PI / 180)));
    put(w, "Translate ");
    put_vec(w, add(p->at, mul(wi, distance)));
    put_map(w, &m);
    put(w, "LightSource \"spot\" ");
    put_rgb(w, "I", strength * unit * unit, strength * unit * unit, strength * unit * unit);
    put_float(w, "coneangle", cone);
    if (edge != 5)
        put_float(w, "conedeltaangle", edge);
    put_point(w, "point", "to", axis);
    put(w, "AttributeEnd\n");
    return strength * spot_at(cos(miss * PI / 180), cone, edge) / (distance * distance);
}

/* A square about `at` that faces n. */
static void black_square(struct writer *w, vec3 at, vec3 n, double half)
{
    struct map m = map_scaled(map_frame(n), half);
    put(w, "AttributeBegin Material \"matte\" \"rgb Kd\" [ 0 0 0 ] Translate ");
    put_vec(w, at);
    put_map(w, &m);
    put(w, "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -1 -1 0 1 -1 0 1 1 0 -1 1 0 ]\n"
           "AttributeEnd\n");
}

/* Unit vector at this angle to n, in degrees. */
static vec3 leaning(struct writer *w, vec3 n, double degrees)
{
    struct map m = map_frame(n);
    return map_apply(&m, cylindrical(sin(degrees * PI / 180), between(w, 0, 2 * PI), cos(degrees * PI / 180)));
}

/* The world is written before its options, which want to know where the patch has come to lie. */
static void direct(struct writer *w, struct random_scene *s)
{
    double k = unit(w), a = between(w, 0.2, 0.9);
    struct map m = map_random(w);
    vec3 at = direction(w);
    struct writer world = *w;
    world.text = NULL;
    world.used = world.capacity = 0;
    put(&world, "AttributeBegin Material \"matte\" ");
    put_rgb(&world, "Kd", a, a, a);
    put(&world, "Translate ");
    put_vec(&world, at);
    put_map(&world, &m);
    struct patch p = chance(&world, 0.7) ? triangle_patch(&world, &m, at) : sphere_patch(&world, &m, at);
    put(&world, "AttributeEnd\n");
    struct map facing = map_frame(p.n);
    vec3 wi = leaning(&world, p.n, between(&world, 0, 40)), wo = map_apply(&facing, cylindrical(0.98, 0, 0.2));
    double E = shine(&world, &p, wi, k) * fabs(dot(p.ns, wi));
    if (chance(&world, 0.4)) /* far larger than all else, behind the patch */
        black_square(&world, sub(p.at, mul(p.n, 20)), p.n, across(&world, 1e2, 1e7));
    if (chance(&world, 0.4)) { /* a shadow */
        double h = across(&world, 0.005, 0.3);
        black_square(&world, add(p.at, mul(wi, h)), wi, 0.3 * h);
        E = 0;
    }
    struct view v = {add(p.at, mul(wo, 4)), p.at, 0.001, k, true};
    w->rng = world.rng;
    s->max_depth = 1;
    s->known = s->one_ray = s->delta_light = true;
    s->low = a / PI * E * (1 - 5e-3);
    s->high = a / PI * E * (1 + 5e-3);
    begin(w, &v, s->max_depth);
    put(w, "%s", world.text);
    free(world.text);
}

/* --- anything ------------------------------------------------------------------------------------------- */

static void thing(struct writer *w)
{
    struct map any = map_random(w), m = map_scaled(any, between(w, 0.3, 0.7));
    vec3 way = direction(w);
    put(w, "AttributeBegin Translate ");
    put_vec(w, mul(way, between(w, 0.2, 1.1)));
    put_map(w, &m);
    if (!w->media && chance(w, 0.15)) {
        put_area_light(w);
    } else {
        put_material(w, false);
        put_shape(w, false);
    }
    put(w, "AttributeEnd\n");
}

static void instances(struct writer *w)
{
    struct map m = map_random(w);
    put(w, "AttributeBegin Identity "); /* the unit is that of the instances */
    put_map(w, &m);
    put(w, "ObjectBegin \"o\"\n");
    for (int n = 1 + pick(w, 2); n > 0; n--)
        thing(w);
    put(w, "ObjectEnd AttributeEnd\n");
    for (int n = 1 + pick(w, 2); n > 0; n--) {
        m = map_random(w);
        put(w, "AttributeBegin ");
        put_map(w, &m);
        put(w, "ObjectInstance \"o\" AttributeEnd\n");
    }
}

/* Walls or a ground far enough from the things to leave room for lights, and from the eye: light sub-paths that are
 * joined to the lens from close by are rare and bright. */
static void surroundings(struct writer *w, vec3 eye, bool walls)
{
    vec3 up = direction(w);
    while (fabs(dot(eye, up) + 1.6) < 1)
        up = direction(w);
    struct map m = map_frame(up);
    put(w, "AttributeBegin ");
    put_material(w, false);
    if (walls) {
        m = map_scaled(m, 8);
        put_map(w, &m);
        put(w, "Shape \"sphere\"\n");
    } else {
        put_map(w, &m);
        put(w, "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -4 -4 -1.6 4 -4 -1.6 4 4 -1.6 "
               "-4 4 -1.6 ]\n");
        if (w->boxes)
            put_boxes(w);
    }
    put(w, "AttributeEnd\n");
}

/* --- in one place ---------------------------------------------------------------------------------------- */

/* A square or a disk in the plane z = 0, about (x, y). */
static void flat(struct writer *w, double x, double y, double half, bool disk)
{
    put(w, "AttributeBegin Translate ");
    put_vec(w, vec(x, y, 0));
    put(w, "Scale ");
    put_vec(w, vec(half, half, 1));
    put(w, disk ? "Shape \"disk\"" : "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] "
           "\"point P\" [ -1 -1 0 1 -1 0 1 1 0 -1 1 0 ]");
    put(w, " AttributeEnd\n");
}

/* What comes next shines. Through lamps of which one is to be seen on one side, one on the other, no light goes. */
static void shining(struct writer *w, bool opaque)
{
    vec3 L = within(w, vec(0.3, 0.3, 1), vec(8, 8, 8));
    put(w, "%s", chance(w, 0.5) ? "ReverseOrientation " : "");
    put(w, "AreaLightSource \"diffuse\" \"bool twosided\" \"%s\" ", chance(w, 0.5) ? "true" : "false");
    put_point(w, "rgb", "L", L);
    if (opaque)
        put(w, chance(w, 0.3) ? "Material \"none\"\n" : "Material \"matte\" \"rgb Kd\" [ .2 .3 .4 ]\n");
    else
        put_material(w, true);
}

/* Two surfaces in one plane, of which one lies in the other or is the same, or that overlap. The first is a `lamp` or
 * none, the second as often as not like it. Numbers are such that the plane is the same in float, too; only that of a
 * disk is not rounded. */
static void in_one_place(struct writer *w, bool lamp)
{
    static const char *const AXES[] = {"0 1 0 0 0 0 1 0 1 0 0 0", "0 0 1 0 1 0 0 0 0 1 0 0", "1 0 0 0 0 1 0 0 0 0 1 0"};
    bool lamps[2] = {lamp, lamp && chance(w, 0.5)}, same = chance(w, 0.3), later = chance(w, 0.5);
    vec3 way = direction(w), at = mul(way, between(w, 1.2, 1.5));
    double x = same ? 0 : between(w, -0.6, 0.6), y = same ? 0 : between(w, -0.6, 0.6);
    put(w, "AttributeBegin Translate ");
    put_vec(w, at);
    put(w, "ConcatTransform [ %s 0 0 0 1 ]\n", AXES[pick(w, 3)]);
    for (int i = 0; i < 2; i++) {
        int k = later ? 1 - i : i;
        put(w, "AttributeBegin ");
        if (lamps[k])
            shining(w, lamps[1]);
        else
            put_material(w, false);
        bool disk = lamp && !same && chance(w, 0.3);
        flat(w, k * x, k * y, k == 0 || same ? 0.7 : 0.5, disk);
        put(w, "AttributeEnd\n");
    }
    put(w, "AttributeEnd\n");
}

static void anything(struct writer *w, struct random_scene *s)
{
    struct view v = {.plain = false};
    seen_by(w, s, &v, between(w, 4.5, 5.5));
    s->max_depth = 1 + pick(w, 4);
    begin(w, &v, s->max_depth);
    put_textures(w);
    bool lamp = w->placed && chance(w, 0.75);
    for (int n = lamp ? 0 : 1 + pick(w, 2); n > 0; n--)
        put_light(w, v.unit);
    bool walls = chance(w, 0.35);
    if (!walls) { /* what no light reaches is not governed by the tails of rough lobes */
        double L = lamp ? 0.02 : across(w, 0.02, 0.3);
        put(w, "AttributeBegin LightSource \"infinite\" ");
        put_rgb(w, "L", L, L, L);
        put(w, "AttributeEnd\n");
    }
    for (int n = 1 + pick(w, 3); n > 0; n--)
        thing(w);
    if (chance(w, 0.2))
        instances(w);
    if (walls || chance(w, 0.7))
        surroundings(w, v.eye, walls);
    if (w->media) {
        put_bound(w);
        put_milk(w);
    }
    if (w->placed)
        in_one_place(w, lamp);
}

static struct random_scene scene_away(uint64_t number, const char *top, bool evil, double away)
{
    static const struct {
        const char *name;
        void (*write)(struct writer *w, struct random_scene *s);
    } FAMILIES[] = {{"any", anything}, {"closed furnace", closed_furnace}, {"any", anything}, {"any", anything},
                    {"direct", direct}, {"any", anything}, {"open furnace", open_furnace}, {"any", anything}};
    struct random_scene s = {.text = NULL};
    struct writer w = {.rng = rng_stream(number, RNG_TEST, 7, evil), .top = top, .evil = evil, .away = away};
    int family = (int)(number % (sizeof FAMILIES / sizeof FAMILIES[0]));
    s.family = FAMILIES[family].name;
    w.media = FAMILIES[family].write == anything && number / 8 % 3 == 1;
    w.placed = FAMILIES[family].write == anything && number / 8 % 3 == 2;
    w.around = "";
    FAMILIES[family].write(&w, &s);
    put(&w, "WorldEnd\n");
    s.text = w.text;
    s.specular |= w.specular;
    s.delta_light |= w.delta_light;
    s.rare = w.rare;
    s.media = w.media;
    s.placed = w.placed;
    s.fog = w.around[0] != '\0';
    s.known &= !evil;
    return s;
}

struct random_scene random_scene(uint64_t number, const char *top, bool evil)
{
    struct writer w = {.rng = rng_stream(number, RNG_TEST, 9, evil)};
    return scene_away(number, top, evil, chance(&w, 0.5) ? 0 : across(&w, 1, 1e8));
}

struct random_scene random_scene_moved(uint64_t number, const char *top, double away)
{
    return scene_away(number, top, false, away);
}
