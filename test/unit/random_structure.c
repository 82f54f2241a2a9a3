/* random_structure.c: see random_structure.h. Lengths are metres, y is up, the camera looks along z in the main. No two
 * numbers are drawn in one expression, so that all compilers make the same scenes. */
#include "random_structure.h"

#include <math.h>
#include <string.h>

#include "base/maths.h"
#include "random_writer.h"

enum { MOST_LAMPS = 80 };

/* --- pieces --------------------------------------------------------------------------------------------- */

static vec3 part(vec3 s, double x, double y, double z) { return vec(x * s.x, y * s.y, z * s.z); }
static double area(vec3 s) { return 2 * (s.x * s.y + s.y * s.z + s.z * s.x); }

static void colour(struct writer *w, const char *name, double value)
{
    vec3 c = mul(within(w, vec(0.6, 0.6, 0.6), vec(1, 1, 1)), value);
    put_rgb(w, name, c.x, c.y, c.z);
}

enum material { GLASS, MIRROR, METAL, PLASTIC, MATTE };
static void material(struct writer *w, enum material kind, double eta)
{
    static const char *const NAMES[] = {"glass", "mirror", "metal", "plastic", "matte"};
    put(w, "Material \"%s\" ", NAMES[kind]);
    if (kind == MATTE)
        colour(w, "Kd", between(w, 0.3, 0.95));
    else if (kind != MIRROR)
        put_float(w, kind == GLASS ? "eta" : "roughness", kind == GLASS ? eta : across(w, 0.002, 0.4));
    put(w, "\n");
}

/* One with a hole from (x0, y0) to (x1, y1), shares of u and v; y0 may be 0. */
static void pierced(struct writer *w, vec3 a, vec3 u, vec3 v, double x0, double x1, double y0, double y1)
{
    put_quad(w, a, mul(u, x0), v);
    put_quad(w, add(a, mul(u, x1)), mul(u, 1 - x1), v);
    if (y0 > 0)
        put_quad(w, add(a, mul(u, x0)), mul(u, x1 - x0), mul(v, y0));
    put_quad(w, add(a, add(mul(u, x0), mul(v, y1))), mul(u, x1 - x0), mul(v, 1 - y1));
}

/* The sides of a box: the corner that each begins at and two edges, of which 1, 2 and 4 are x, y and z. */
enum { SIDES = 6, CEILING = 2, LEFT = 4, FRONT = 16 }; /* bits of sides */
static const int SIDE[SIDES][3] = {{0, 4, 1}, {2, 1, 4}, {0, 2, 4}, {1, 4, 2}, {0, 1, 2}, {4, 2, 1}};
static vec3 corner(vec3 s, int bits) { return part(s, bits & 1, bits >> 1 & 1, bits >> 2); }

/* A room from 0 to s without some sides, with mirrors for others. */
static void room(struct writer *w, vec3 s, int without, int mirrors)
{
    for (int i = 0; i < SIDES; i++) {
        material(w, mirrors >> i & 1 ? MIRROR : MATTE, 0);
        if (!(without >> i & 1))
            put_quad(w, corner(s, SIDE[i][0]), corner(s, SIDE[i][1]), corner(s, SIDE[i][2]));
    }
}

static void box(struct writer *w, vec3 low, vec3 high)
{
    vec3 s = sub(high, low);
    for (int i = 0; i < SIDES; i++)
        put_quad(w, add(low, corner(s, SIDE[i][0])), corner(s, SIDE[i][2]), corner(s, SIDE[i][1]));
}

/* A light that gives about so much power, a little below `at`: a spot, a ball, or a square that shines down. */
enum lamp { SPOT, BALL, SQUARE };
static void lamp(struct writer *w, enum lamp kind, vec3 at, double size, double power)
{
    put(w, "AttributeBegin Translate ");
    put_vec(w, sub(at, vec(0, 0.02, 0)));
    if (kind == SPOT) {
        double cone = between(w, 20, 80);
        put(w, "LightSource \"spot\" ");
        put_point(w, "point", "to", within(w, vec(-0.5, -1, -0.5), vec(0.5, -1, 0.5)));
        put_float(w, "coneangle", cone);
        colour(w, "I", power / (2 * PI * (1 - cos(cone * PI / 180))));
    } else {
        put(w, "Material \"matte\" AreaLightSource \"diffuse\" ");
        colour(w, "L", power / (PI * size * size * (kind == BALL ? PI : 1)));
        if (kind == BALL)
            put(w, "Translate 0 %.4g 0 Shape \"sphere\" \"float radius\" %.4g\n", -size / 2, size / 2);
        else
            put_quad(w, vec(-size / 2, 0, -size / 2), vec(size, 0, 0), vec(0, 0, size));
    }
    put(w, "AttributeEnd\n");
}

/* So many, together of about such power, the brightest of them up to `unlike` times as bright as the faintest. */
static void lamps(struct writer *w, int n, vec3 low, vec3 high, double large, double power, double unlike)
{
    double share[MOST_LAMPS], sum = 0, size = across(w, large / 8, large);
    power *= between(w, 0.7, 2);
    for (int i = 0; i < n; i++)
        sum += share[i] = across(w, 1, unlike);
    for (int i = 0; i < n; i++) {
        static const enum lamp KINDS[] = {SPOT, BALL, BALL, SQUARE, SQUARE, SQUARE, SQUARE, SQUARE};
        vec3 at = within(w, low, high);
        lamp(w, KINDS[pick(w, 8)], at, size, power * share[i] / sum);
    }
}

/* So many balls and blocks that stand on the floor; caustics: of glass and metal. */
static void things(struct writer *w, int n, vec3 low, vec3 high, bool caustics)
{
    static const enum material KINDS[] = {GLASS, GLASS, METAL, MIRROR, PLASTIC, PLASTIC, MATTE, MATTE, MATTE};
    for (; n > 0; n--) {
        double r = fmin(high.x - low.x, high.z - low.z) * across(w, 0.05, 0.2), h = r * across(w, 0.5, 5);
        put(w, "AttributeBegin ");
        material(w, KINDS[pick(w, caustics ? 3 : 9)], 1.5);
        put(w, "Translate ");
        put_vec(w, within(w, vec(low.x + r, 0.003, low.z + r), vec(high.x - r, 0.003, high.z - r)));
        put(w, "Rotate %.3g 0 1 0 ", between(w, 0, 90));
        if (chance(w, 0.5))
            put(w, "Translate 0 %.4g 0 Shape \"sphere\" \"float radius\" %.4g\n", r, r);
        else
            box(w, vec(-0.7 * r, 0, -0.7 * r), vec(0.7 * r, fmin(h, 0.7 * high.y), 0.7 * r));
        put(w, "AttributeEnd\n");
    }
}

/* Sky, sun or both. */
static void daylight(struct writer *w, double strength)
{
    int kind = pick(w, 4);
    if (kind > 0) {
        put(w, "LightSource \"infinite\" ");
        colour(w, "L", strength * between(w, 0.3, 1));
    }
    if (kind < 3) {
        put(w, "LightSource \"distant\" ");
        colour(w, "L", strength * across(w, 0.5, 5));
        put_point(w, "point", "from", within(w, vec(-1, 0.4, -0.8), vec(-0.3, 1, 0.8)));
        put(w, "\"point to\" [ 0 0 0 ]\n");
    }
}

/* --- what is special about each kind, in a room of size s ----------------------------------------------- */

/* Many rooms without a roof, with a lamp each. */
static void rooms(struct writer *w, vec3 s)
{
    int nx = 3 + pick(w, 8), nz = 3 + pick(w, 8);
    double h = between(w, 0.2, 0.6), large = 0.3 * s.x / nx, power = 3 * s.x * s.z / (nx * nz);
    for (int i = 1; i < nx; i++)
        put_quad(w, part(s, (double)i / nx, 0, 0), part(s, 0, h, 0), part(s, 0, 0, 1));
    for (int i = 1; i < nz; i++)
        put_quad(w, part(s, 0, 0, (double)i / nz), part(s, 1, 0, 0), part(s, 0, h, 0));
    for (int i = 0; i < nx * nz; i++) {
        vec3 low = part(s, (i % nx + 0.2) / nx, 0.5 * h, (i / nx + 0.2) / nz);
        lamps(w, 1, low, add(low, part(s, 0.6 / nx, 0.4 * h, 0.6 / nz)), large, power * across(w, 0.3, 5), 1);
    }
}

/* A pane before the camera, or water below it with lamps within. */
static void pane(struct writer *w, vec3 s)
{
    double at = between(w, 0.15, 0.3);
    material(w, GLASS, 1 + across(w, 1e-4, 0.6));
    if (chance(w, 0.3)) {
        put_quad(w, part(s, 0, at, 0), part(s, 0, 0, 1), part(s, 1, 0, 0));
        lamps(w, 2, part(s, 0.1, 0, 0.5), part(s, 0.9, at, 0.9), 0.5, area(s), 10);
    } else {
        put_quad(w, part(s, 0, 0, at), part(s, 0, 1, 0), part(s, 1, 0, 0));
        put_quad(w, vec(0, 0, s.z * at + across(w, 0.003, 0.3)), part(s, 1, 0, 0), part(s, 0, 1, 0));
    }
}

/* Rooms in a row, a door from each to the next, a lamp in one of those behind. */
static void doors(struct writer *w, vec3 s)
{
    int n = 2 + pick(w, 4), lit = 1 + pick(w, n - 1);
    double wide = between(w, 0.25, 0.5), tall = between(w, 0.6, 0.95), dark = pow(0.5 * wide * tall, 1 - lit);
    for (int i = 1; i < n; i++) {
        double x = between(w, 0.2, 0.8 - wide);
        pierced(w, part(s, 0, 0, (double)i / n), part(s, 1, 0, 0), part(s, 0, 1, 0), x, x + wide, 0, tall);
    }
    lamps(w, 2, part(s, 0.1, 1, (lit + 0.2) / n), part(s, 0.9, 1, (lit + 0.8) / n), 0.8, area(s) * dark, 10);
}

/* Sun and sky through openings in a wall, some with glass before them. */
static void windows(struct writer *w, vec3 s)
{
    int n = 1 + pick(w, 4);
    double wide = between(w, 0.2, 0.7), low = between(w, 0.1, 0.5), high = between(w, low + 0.2, 0.9);
    for (int i = 0; i < n; i++)
        pierced(w, part(s, 0, 0, (double)i / n), part(s, 0, 0, 1.0 / n), part(s, 0, 1, 0), 0.5 - wide / 2,
                0.5 + wide / 2, low, high);
    daylight(w, 0.2 * area(s) / (s.y * s.z * wide * (high - low)));
    put_quad(w, vec(-100, -0.1, -100), vec(0, 0, 200), vec(200, 0, 0));
    material(w, GLASS, 1.5);
    if (chance(w, 0.25))
        box(w, vec(-0.1, 0, 0), vec(-0.05, s.y, s.z));
}

/* Open above, with an arcade along its back. */
static void yard(struct writer *w, vec3 s)
{
    double z = between(w, 0.5, 0.9), y = between(w, 0.3, 0.8);
    box(w, part(s, 0, y, z), part(s, 1, y + 0.1, 1));
    for (int i = 1 + pick(w, 6); i > 0; i--)
        box(w, part(s, i / 7.0, 0, z), part(s, i / 7.0 + 0.04, y, z + 0.04));
    daylight(w, across(w, 0.5, 2));
    if (chance(w, 0.4))
        lamps(w, 1 + pick(w, 3), part(s, 0.1, y, z + 0.05), part(s, 0.9, y, 0.95), 0.5, s.x * s.z, 10);
}

/* Lamps shut into cabinets whose doors are ajar or which are open above. */
static void cabinets(struct writer *w, vec3 s)
{
    int n = 1 + pick(w, 4);
    for (int i = 0; i < n; i++) {
        bool above = chance(w, 0.3);
        double gap = between(w, 0.08, 0.5), x = between(w, 0.02, 0.9 - gap), y = between(w, 0.02, 0.25);
        vec3 c = part(s, 0.7 / n, between(w, 0.4, 0.7), 0.25);
        put(w, "AttributeBegin Translate ");
        put_vec(w, part(s, (i + 0.15) / n, y, 0.65));
        room(w, c, above ? CEILING : FRONT, 0);
        if (!above)
            pierced(w, vec(0, 0, 0), vec(c.x, 0, 0), vec(0, c.y, 0), x, x + gap, 0.03, 0.97);
        lamps(w, 1, part(c, 0.4, 0.7, 0.4), part(c, 0.6, 0.95, 0.6), 0.4 * fmin(c.x, c.z), 3 * area(s) / n, 1);
        put(w, "AttributeEnd\n");
    }
}

/* Pillars and screens. */
static void hall(struct writer *w, vec3 s)
{
    for (int i = pick(w, 9); i > 0; i--) {
        vec3 at = within(w, part(s, 0.05, 0, 0.2), part(s, 0.9, 0, 0.9));
        double x = across(w, 0.01, 0.1), y = between(w, 0.3, 1);
        box(w, at, add(at, part(s, x, y, across(w, 0.01, 0.1))));
    }
}

static void fog(struct writer *w, vec3 s)
{
    put(w, "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" ");
    colour(w, "sigma_s", across(w, 0.1, 1.5) / s.z);
    colour(w, "sigma_a", across(w, 0.01, 0.2) / s.z);
    put_float(w, "g", between(w, -0.3, 0.8));
    put(w, "\nMediumInterface \"fog\" \"fog\"\n");
}

/* Stairs up to the back wall, below balls that shine at the ceiling from a trough along a side. */
static void terraces(struct writer *w, vec3 s)
{
    int n = 4 + pick(w, 12);
    double rise = between(w, 0.2, 0.6) / n, y = between(w, 0.6, 0.8), deep = between(w, 0.1, 0.25);
    double size = 0.3 * deep * s.x;
    for (int i = 1; i < n; i++)
        box(w, part(s, 0, rise * (i - 1), 0.2 + 0.8 * i / n), part(s, 1, rise * i, 1));
    put_quad(w, part(s, 0, y, 0.1), part(s, deep, 0, 0), part(s, 0, 0, 0.8));
    put_quad(w, part(s, deep, y, 0.1), vec(0, size + 0.05, 0), part(s, 0, 0, 0.8));
    for (double z = 0.2; z < 0.9; z += across(w, 0.1, 0.5))
        lamp(w, BALL, add(part(s, deep / 2, y, z), vec(0, size + 0.04, 0)), size, area(s) * between(w, 0.3, 1));
}

/* Metal plates, rough and less so, each of which mirrors balls that shine towards the camera. */
static void plates(struct writer *w, vec3 s)
{
    int n = 3 + pick(w, 4), m = 2 + pick(w, 5);
    for (int i = 0; i < n; i++) {
        vec3 at = part(s, 0.2, 0.05 + 0.35 * i / n, 0.3 + 0.5 * i / n), u = part(s, 0.6, 0, 0);
        vec3 up = add(normalize(sub(part(s, 0.2, 0.5, 0), at)), normalize(sub(part(s, 0.2, 0.75, 0.9), at)));
        material(w, METAL, 0);
        put_quad(w, at, u, mul(normalize(cross(u, up)), between(w, 0.05, 0.1) * s.z));
    }
    for (int i = 0; i < m; i++)
        lamp(w, BALL, part(s, 0.2 + 0.6 * (i + 0.5) / m, 0.75, 0.9), s.x * across(w, 0.01, 0.1), area(s) / m);
}

static const struct kind {
    const char *name;
    void (*special)(struct writer *w, vec3 s);
    double most, eye;     /* metres that the room may be wide; about how high the camera is, a share */
    int depth, without;   /* of paths, at least; sides that are left out */
    int things, lamps[2]; /* at most; at least and at most, in this part of the room: */
    vec3 low, high;
    double large, unlike; /* metres, at most; see lamps */
} KINDS[N_STRUCTURES] = {
    {"rooms", rooms, 12, 1.7, 2, CEILING, 0, {0, 0}, {0, 0, 0}, {0, 0, 0}, 0, 0},
    {"pane", pane, 7, 0.5, 4, 0, 5, {1, 4}, {0.1, 0.5, 0.4}, {0.9, 1, 0.9}, 0.8, 10},
    {"mirrors", NULL, 8, 0.5, 4, 0, 6, {1, 4}, {0.1, 1, 0.2}, {0.9, 1, 0.9}, 1, 10},
    {"doors", doors, 7, 0.5, 6, 0, 4, {0, 0}, {0, 0, 0}, {0, 0, 0}, 0, 0},
    {"windows", windows, 8, 0.5, 4, LEFT, 6, {0, 0}, {0, 0, 0}, {0, 0, 0}, 0, 0},
    {"yard", yard, 15, 0.6, 3, CEILING, 8, {0, 0}, {0, 0, 0}, {0, 0, 0}, 0, 0},
    {"cabinets", cabinets, 6, 0.5, 4, 0, 4, {0, 0}, {0, 0, 0}, {0, 0, 0}, 0, 0},
    {"hall", hall, 25, 0.5, 3, 0, 8, {4, MOST_LAMPS}, {0.05, 0.6, 0.1}, {0.95, 1, 0.95}, 0.6, 3000},
    {"fog", fog, 7, 0.5, 4, 0, 5, {1, 4}, {0.1, 0.8, 0.3}, {0.9, 1, 0.9}, 0.8, 30},
    {"caustics", NULL, 6, 0.5, 5, 0, 7, {1, 2}, {0.1, 0.8, 0.2}, {0.9, 1, 0.9}, 0.5, 4},
    {"terraces", terraces, 8, 0.5, 5, 0, 0, {0, 0}, {0, 0, 0}, {0, 0, 0}, 0, 0},
    {"plates", plates, 8, 0.5, 2, 0, 0, {1, 1}, {0.4, 1, 0.1}, {0.6, 1, 0.2}, 1, 1},
};

/* A room with a camera near its front. */
static void furnish(struct writer *w, const struct kind *k)
{
    vec3 s = within(w, vec(0.35 * k->most, 2, 0.4 * k->most), vec(k->most, fmax(3, 0.5 * k->most), 1.5 * k->most));
    put(w, "Film \"image\" \"integer xresolution\" %d ", 96 + pick(w, 225));
    put(w, "\"integer yresolution\" %d PixelFilter \"box\"\n", 72 + pick(w, 169));
    put(w, "Sampler \"sobol\" \"integer pixelsamples\" 64\n");
    put(w, "Integrator \"asbdpt\" \"integer maxdepth\" %d\nLookAt ", k->depth + pick(w, 6));
    put_vec(w, within(w, part(s, 0.3, 0.7 * k->eye, 0.02), part(s, 0.7, 1.5 * k->eye, 0.08)));
    put_vec(w, within(w, part(s, 0.3, 0.1, k->eye > 1 ? 0.3 : 0.6), part(s, 0.7, 0.5, k->eye > 1 ? 0.5 : 1)));
    put(w, "0 1 0\nCamera \"perspective\" \"float fov\" %.3g\nWorldBegin\n", between(w, 45, 75));
    room(w, s, k->without, strcmp(k->name, "mirrors") == 0 ? 1 + pick(w, 63) : 0);
    if (k->special != NULL)
        k->special(w, s);
    things(w, k->things > 0 ? 1 + pick(w, k->things) : 0, part(s, 0, 0, 0.3), s, strcmp(k->name, "caustics") == 0);
    if (k->lamps[1] > 0)
        lamps(w, (int)across(w, k->lamps[0], k->lamps[1] + 1), part(s, k->low.x, k->low.y, k->low.z),
              part(s, k->high.x, k->high.y, k->high.z), k->large, area(s), k->unlike);
}

char *random_structure(uint64_t number, const char **kind)
{
    struct writer order = {.rng = rng_stream(number / N_STRUCTURES, RNG_TEST, 8, 0)};
    struct writer w = {.rng = rng_stream(number, RNG_TEST, 8, 1)};
    int place[N_STRUCTURES];
    for (int i = 0; i < N_STRUCTURES; i++) {
        int j = pick(&order, i + 1);
        place[i] = place[j];
        place[j] = i;
    }
    const struct kind *k = &KINDS[place[number % N_STRUCTURES]];
    put(&w, "# structure %llu: %s\n", (unsigned long long)number, k->name);
    furnish(&w, k);
    put(&w, "WorldEnd\n");
    *kind = k->name;
    return w.text;
}
