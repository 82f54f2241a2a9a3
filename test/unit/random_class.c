/* random_class.c: see random_class.h. Base j lies about (2j, -1) or, if j is odd, (2j, 1); light and lens are in the
 * place of the first and the last. Along z the corridor reaches from -DEPTH to DEPTH. */
#include "random_class.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "random_writer.h"

static const double DEPTH = 1.4, HOLE = 0.42, PANE = 0.02; /* half of all; hole, as a share of a side; half of a pane's
                                                          * distance from the next */
/* Most of a word: letters after which many directions are possible; chains of others between two of these; mirrors, in
 * all and in such a chain. Hardly a walk finds through more. */
enum { MOST_ROUGH = 3, MOST_CHAINS = 1, MOST_MIRRORS = 3, MOST_INNER = 1 };

enum light { POINT, SPOT, SQUARE, BALL, SUN, SKY, LIGHTS };
enum camera { PINHOLE, THIN_LENS, ORTHOGRAPHIC, ENVIRONMENT, CAMERAS };
static const char *const LIGHT_NAMES[] = {"point", "spot", "square", "ball", "sun", "sky"};
static const char *const CAMERA_NAMES[] = {"pinhole", "thin lens", "orthographic", "environment"};

static bool is_delta(enum light kind) { return kind == POINT || kind == SPOT || kind == SUN; }

/* --- words ---------------------------------------------------------------------------------------------- */

static bool is_rough(char letter) { return letter != 'S' && letter != 'T'; }

/* Can paths of the word be made, and easily? Light and lens are rough as far as they can be joined to. */
static bool fits(const char *word, enum light light)
{
    bool before = true, found = !is_delta(light);
    int rough = 0, mirrors = 0, chains = 0, inner = 0;
    for (const char *c = word; *c != '\0'; before = is_rough(*c++)) {
        found |= before && is_rough(*c);
        chains += rough > 0 && is_rough(*c) && !before;
        mirrors += *c == 'S';
        if (is_rough(*c) && rough++ > 0 && inner > MOST_INNER)
            return false;
        inner = is_rough(*c) ? 0 : inner + (*c == 'S');
    }
    bool starts = light != SUN || is_rough(word[0]); /* hardly a ray from the sun finds the way in */
    return (found || before) && starts && rough <= MOST_ROUGH && chains <= MOST_CHAINS && mirrors <= MOST_MIRRORS;
}

/* Are later draws needed for it, if the light is a delta light? The pair of rough letters that is joined has a chain
 * after it and then another rough letter. */
static bool is_sealed(const char *word)
{
    const char *c = strpbrk(word, "DGM");
    bool pair = false, chain = false;
    for (; c != NULL && c[1] != '\0'; c++) {
        pair |= !chain && is_rough(c[0]) && is_rough(c[1]);
        chain |= pair && !is_rough(c[0]) && is_rough(c[1]);
    }
    return chain && !is_rough(word[0]) && !is_rough(word[strlen(word) - 1]);
}

/* A word of n letters. */
static void draw_word(struct writer *w, enum light light, int n, bool sealed, char *word)
{
    do {
        for (int i = 0; i < n; i++)
            word[i] = "DDDGGSSTTTMM"[pick(w, 12)];
        word[n] = '\0';
    } while (!fits(word, light) || (sealed && !is_sealed(word)));
}

/* --- where things are ----------------------------------------------------------------------------------- */

static vec3 base_at(int j) { return vec(2 * j, j % 2 ? 1 : -1, 0); }
static vec3 hole_at(int j) { return vec(2 * j + 1, 0, 0); } /* between bases j and j + 1 */
static vec3 light_along(int j) { return normalize(sub(base_at(j + 1), base_at(j))); }

/* From hole j's middle to the end of its screen; from there to its edge, and half its depth. */
static vec3 screen_half(int j) { return vec(1, j % 2 ? 1 : -1, 0); }
static vec3 hole_half(int j) { return mul(screen_half(j), HOLE); }
static const vec3 HOLE_DEEP = {0, 0, 0.7};

/* A parallelogram about `at`, by half its sides; its normal is on the side of `facing`. */
static void plate(struct writer *w, vec3 at, vec3 u, vec3 v, vec3 facing)
{
    vec3 first = dot(cross(u, v), facing) > 0 ? u : v, second = dot(cross(u, v), facing) > 0 ? v : u;
    put_quad(w, sub(sub(at, u), v), mul(first, 2), mul(second, 2));
}

static void black(struct writer *w) { put(w, "Material \"matte\" \"rgb Kd\" [ 0 0 0 ]\n"); }

/* The black screen in hole j's place, with the hole or without. */
static void screen(struct writer *w, int j, bool hole)
{
    const vec3 deep = vec(0, 0, DEPTH), along = light_along(j), half = hole_half(j);
    vec3 rest = mul(sub(screen_half(j), half), 0.5), beside = mul(sub(deep, HOLE_DEEP), 0.5);
    black(w);
    for (int side = -1; side <= 1; side += 2) {
        plate(w, add(hole_at(j), mul(add(half, rest), side)), rest, deep, along);
        plate(w, add(hole_at(j), mul(add(HOLE_DEEP, beside), side)), half, beside, along);
    }
    if (!hole)
        plate(w, hole_at(j), half, HOLE_DEEP, along);
}

/* --- letters -------------------------------------------------------------------------------------------- */

static void surface(struct writer *w, char letter)
{
    vec3 colour = within(w, vec(0.5, 0.5, 0.5), vec(0.9, 0.9, 0.9));
    if (letter == 'G') {
        put(w, "Material \"metal\" \"bool remaproughness\" \"false\" ");
        put_float(w, "roughness", across(w, 0.02, 0.3));
    } else if (letter == 'D') {
        put(w, "Material \"matte\" ");
        put_point(w, "rgb", "Kd", colour);
    } else if (chance(w, 0.7)) {
        put(w, "Material \"mirror\" ");
        put_point(w, "rgb", "Kr", colour);
    } else { /* also somewhat diffuse */
        put(w, "Material \"uber\" \"rgb Kd\" [ .15 .15 .15 ] \"rgb Ks\" [ 0 0 0 ] ");
        put_point(w, "rgb", "Kr", colour);
    }
    put(w, "\n");
}

/* Part of an ellipsoid with its foci in the two holes. */
static void mirror(struct writer *w, int j)
{
    put(w, "AttributeBegin Translate %d 0 0 Scale 1.41421356 1 1 Rotate %d 1 0 0 ", 2 * j, j % 2 ? -90 : 90);
    put(w, "Shape \"sphere\" \"float zmin\" .3 AttributeEnd\n");
}

static void cloud(struct writer *w, int j)
{
    put(w, "AttributeBegin Material \"none\" MediumInterface \"cloud\" \"\" Translate ");
    put_vec(w, base_at(j));
    put(w, "Shape \"sphere\" \"float radius\" .6 AttributeEnd\n");
}

/* Base j; '#': black; '.': open in the middle. */
static void base(struct writer *w, int j, char letter)
{
    const vec3 deep = vec(0, 0, DEPTH), inwards = vec(0, j % 2 ? -1 : 1, 0), quarter = vec(0.5, 0, 0);
    vec3 at = base_at(j);
    black(w);
    plate(w, sub(at, mul(quarter, 3)), quarter, deep, inwards);
    plate(w, add(at, mul(quarter, 3)), quarter, deep, inwards);
    if (letter == 'D' || letter == 'G')
        surface(w, letter);
    if (letter != '.')
        plate(w, at, mul(quarter, 2), deep, inwards);
    if (letter == 'M')
        cloud(w, j);
    if (letter == 'S') {
        surface(w, letter);
        mirror(w, j);
    }
}

/* So many panes in hole j, in a frame. What the first leads into the second leads out of. */
static void panes(struct writer *w, int j, int n)
{
    vec3 along = light_along(j), half = hole_half(j), thick = mul(along, (n + 1) * PANE);
    black(w);
    for (int side = -1; side <= 1; side += 2) {
        plate(w, add(hole_at(j), mul(half, side)), thick, HOLE_DEEP, mul(half, -side));
        plate(w, add(hole_at(j), mul(HOLE_DEEP, side)), thick, half, mul(HOLE_DEEP, -side));
    }
    put(w, "Material \"glass\" ");
    put_float(w, "eta", chance(w, 0.3) ? 1 : between(w, 1.1, 1.6));
    put(w, chance(w, 0.5) ? "\"rgb Kr\" [ 0 0 0 ]\n" : "\n");
    for (int i = 0; i < n; i++)
        plate(w, add(hole_at(j), mul(along, (2 * i - n + 1) * PANE)), half, HOLE_DEEP, mul(along, i % 2 ? 1 : -1));
}

/* --- light and camera ----------------------------------------------------------------------------------- */

static void light(struct writer *w, enum light kind, bool narrow)
{
    vec3 at = lerp3(0.3, base_at(0), hole_at(0)), along = light_along(0), side = mul(screen_half(0), 0.3);
    black(w);
    put(w, "AttributeBegin ");
    switch (kind) {
    case POINT:
    case SPOT:
        put(w, kind == POINT ? "LightSource \"point\" " : "LightSource \"spot\" ");
        put_rgb(w, "I", 10, 9, 8);
        put_point(w, "point", "from", at);
        if (kind == SPOT) {
            put_float(w, "coneangle", narrow ? 8 : 30);
            put_point(w, "point", "to", add(at, along));
        }
        break;
    case SQUARE:
        put(w, "AreaLightSource \"diffuse\" \"rgb L\" [ 10 9 8 ] ");
        put_quad(w, sub(at, add(side, vec(0, 0, 0.2))), vec(0, 0, 0.4), mul(side, 2));
        break;
    case BALL:
        put(w, "AreaLightSource \"diffuse\" \"rgb L\" [ 10 9 8 ] Translate ");
        put_vec(w, at);
        put(w, "Shape \"sphere\" \"float radius\" .2");
        break;
    case SUN:
        put(w, "LightSource \"distant\" \"rgb L\" [ 5 5 4 ] \"point to\" [ 0 0 0 ] ");
        put_point(w, "point", "from", neg(along));
        break;
    case SKY: put(w, "LightSource \"infinite\" \"rgb L\" [ 1 1 1.2 ]"); break;
    default: break;
    }
    put(w, " AttributeEnd\n");
}

/* Before the last base, looking through the hole that leads there; narrow: through its middle. SIZE pixels wide, of an
 * environment camera as a crop of its film. */
static void camera(struct writer *w, enum camera kind, int last, bool narrow)
{
    enum { SIZE = 8 };
    static const char *const FILTERS[] = {"box", "triangle", "gaussian"};
    int cut = kind == ENVIRONMENT ? narrow ? 30 : 8 : 1; /* how many of the crop would fit into the film's width */
    double half = narrow ? 0.12 : 0.4, part = 0.5 / cut;
    put(w, "Film \"image\" \"integer xresolution\" %d \"integer yresolution\" %d ", SIZE * cut,
        kind == ENVIRONMENT ? SIZE * cut / 2 : SIZE);
    if (kind == ENVIRONMENT) {
        const double crop[4] = {0.25 - part, 0.25 + part, 0.5 - 2 * part, 0.5 + 2 * part};
        put_list(w, "float", "cropwindow", 4, crop);
    }
    put(w, "PixelFilter \"%s\"\nLookAt ", FILTERS[pick(w, 3)]);
    put_vec(w, lerp3(0.3, base_at(last), hole_at(last - 1)));
    put_vec(w, hole_at(last - 1));
    put(w, "0 0 1 Camera \"%s\" ", kind == ORTHOGRAPHIC || kind == ENVIRONMENT ? CAMERA_NAMES[kind] : "perspective");
    if (kind != ENVIRONMENT)
        put(w, "\"float screenwindow\" [ %g %g %g %g ] ", -half, half, -half, half);
    if (kind == PINHOLE || kind == THIN_LENS)
        put_float(w, "fov", 90);
    if (kind == THIN_LENS)
        put(w, "\"float lensradius\" .05 \"float focaldistance\" 1.5");
    put(w, "\n");
}

/* --- the scene ------------------------------------------------------------------------------------------ */

/* The letters of bases 0 .. last - 1, '#' for the black first one, and the number of panes in each hole. Returns
 * `last`. */
static int lay_out(const char *word, char *letter, int *n_panes)
{
    int last = 1;
    letter[0] = '#';
    memset(n_panes, 0, (CLASS_LETTERS + 1) * sizeof *n_panes);
    for (; *word != '\0'; word++)
        if (*word == 'T')
            n_panes[last - 1]++;
        else
            letter[last++] = *word;
    return last;
}

static void world(struct writer *w, const char *word, enum light kind)
{
    char letter[CLASS_LETTERS + 2];
    int n_panes[CLASS_LETTERS + 1], last = lay_out(word, letter, n_panes);
    letter[0] = kind == SUN || kind == SKY ? '.' : letter[0];
    letter[last] = '#';
    put(w, "WorldBegin\n");
    light(w, kind, letter[1] == 'S');
    for (int j = 0; j <= last; j++)
        base(w, j, letter[j]);
    for (int j = 0; j < last; j++)
        if (n_panes[j] > 0)
            panes(w, j, n_panes[j]);
    for (int j = -1; j <= last; j++)
        screen(w, j, j >= 0 && j < last);
    for (int side = -1; side <= 1; side += 2)
        put_quad(w, vec(-2, -1, side * DEPTH), vec(2 * last + 4, 0, 0), vec(0, 2, 0));
    put(w, "WorldEnd\n");
}

struct random_class random_class(uint64_t number, int n)
{
    enum { LENGTHS = CLASS_LETTERS - CLASS_LEAST_LETTERS + 1, PATIENCE = 12, SEALED = 6 };
    struct random_class c = {.text = NULL};
    struct writer w = {.rng = rng_stream(number, RNG_TEST, 10, (uint64_t)n)};
    enum light kind = (enum light)(number % LIGHTS);
    enum camera lens = (enum camera)((number + number / 4) % CAMERAS);
    char letter[CLASS_LETTERS + 2];
    int n_panes[CLASS_LETTERS + 1];
    bool sealed = number % 7 == 1 && kind != SUN && n < 4 * PATIENCE;
    int longest = CLASS_LEAST_LETTERS + (int)(7 * number % LENGTHS), least = sealed ? SEALED : CLASS_LEAST_LETTERS;
    draw_word(&w, kind, int_within(longest - n / PATIENCE, least, longest), sealed, c.word);
    c.light = LIGHT_NAMES[kind];
    c.camera = CAMERA_NAMES[lens];
    c.delta_light = is_delta(kind);
    c.far_light = kind == SUN || kind == SKY;
    c.max_depth = (int)strlen(c.word) + (chance(&w, 0.5) ? 0 : 2);
    put(&w, "Integrator \"bdpt\" \"integer maxdepth\" %d\n", c.max_depth);
    int last = lay_out(c.word, letter, n_panes);
    camera(&w, lens, last, letter[last - 1] == 'S');
    if (strchr(c.word, 'M') != NULL) {
        put(&w, "MakeNamedMedium \"cloud\" \"string type\" \"homogeneous\" \"rgb sigma_s\" [ 2.5 2.2 2 ] "
                "\"rgb sigma_a\" [ .2 .2 .2 ] ");
        put_float(&w, "g", between(&w, -0.5, 0.5));
        put(&w, "\n");
    }
    world(&w, c.word, kind);
    c.text = w.text;
    return c;
}
