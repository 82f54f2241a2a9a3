/* test_closed.c: scenes along the axes, where radiance is known in closed form: directions are exactly perpendicular,
 * parallel or at 45 degrees. Lights, views, faces and mirrors are in one of the 24 rotations that exchange axes. What
 * all methods miss alike no comparison of methods shows. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/maths.h"
#include "helpers.h"
#include "tests.h"

enum { TEXT = 2048, BATCHES = 12 };

static const char *const WAYS[] = {"pt", "lt", "bdpt", "asbdpt", "asbdpt race=off", "asbdpt select=pool",
                                   "asbdpt select=vertices", "lvc", "cbdpt", "mbdpt", "pssmlt", "mmlt"};
enum { N_WAYS = sizeof WAYS / sizeof WAYS[0] };

static bool is_chain(const char *way) { return strstr(way, "mlt") != NULL; }

/* --- rotations --------------------------------------------------------------------------------------- */

/* Number k of the 24: which axis x, y and z become, and with what sign; the third makes it a rotation. */
static vec3 turned(int k, vec3 p)
{
    const double from[3] = {p.x, p.y, p.z};
    double to[3];
    int first = k % 3, second = (first + 1 + k / 3 % 2) % 3, third = 3 - first - second;
    double a = k / 6 % 2 == 0 ? 1 : -1, b = k / 12 % 2 == 0 ? 1 : -1;
    to[first] = a * from[0];
    to[second] = b * from[1];
    to[third] = (second == (first + 1) % 3 ? a * b : -a * b) * from[2];
    return vec(to[0], to[1], to[2]);
}

/* A scene's text, whose points "<x y z>" are turned. */
static void turn_text(const char *text, int k, char out[TEXT])
{
    size_t n = 0;
    for (const char *p = text; *p != '\0'; p++) {
        vec3 v;
        if (sscanf(p, "<%lf %lf %lf>", &v.x, &v.y, &v.z) != 3) {
            out[n++] = *p;
            continue;
        }
        v = turned(k, v);
        n += (size_t)snprintf(out + n, TEXT - n, "%.9g %.9g %.9g", v.x, v.y, v.z);
        p = strchr(p, '>');
    }
    out[n] = '\0';
}

/* --- scenes ------------------------------------------------------------------------------------------ */

#define LOOK(eye, at, up)                                                                                              \
    "Film \"image\" \"integer xresolution\" 2 \"integer yresolution\" 2 PixelFilter \"box\" Integrator \"bdpt\"\n"     \
    "LookAt " eye " " at " " up "\n"
#define CAMERA(half)                                                                                                   \
    "Camera \"orthographic\" \"float screenwindow\" [-" half " " half " -" half " " half "]\n"
#define VIEW(eye, at, up, half) LOOK(eye, at, up) CAMERA(half)
#define FOG                                                                                                            \
    VIEW("<0 0 -5>", "<0 0 0>", "<0 1 0>", "1")                                                                        \
    "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\n"                                                        \
    "\"rgb sigma_a\" [.1 .2 .5] \"rgb sigma_s\" [.3 .5 1] \"float g\" .5 WorldBegin Material \"\"\n"                   \
    "MediumInterface \"fog\" \"\" Shape \"trianglemesh\" \"integer indices\" [0 3 2 0 2 1 4 5 6 4 6 7 0 1 5 0 5 4\n"   \
    "3 7 6 3 6 2 0 4 7 0 7 3 1 2 6 1 6 5] \"point P\" [<-1 -1 -1> <1 -1 -1> <1 1 -1> <-1 1 -1> <-1 -1 1> <1 -1 1>\n"   \
    "<1 1 1> <-1 1 1>] MediumInterface \"\"\n"
#define FACE(a, b, c, d) QUAD(a " " b " " c " " d)
#define SUN(from) "LightSource \"distant\" \"rgb L\" [2 2 2] \"point from\" [" from "] \"point to\" [<0 0 0>]\n"
#define FLOOR "Material \"matte\" \"rgb Kd\" [.5 .5 .5]\n" FACE("<-1 -2 -1>", "<1 -2 -1>", "<1 -2 1>", "<-1 -2 1>")
#define LAMP                                                                                                           \
    "AreaLightSource \"diffuse\" \"rgb L\" [2 2 2] \"bool twosided\" \"true\" Material \"matte\" \"rgb Kd\" [0 0 0]\n"

/* What fog sends on of a sun that turns by an angle of this cosine, on average over the box and the channels. */
static double fog(double cosine)
{
    static const double S[3] = {0.3, 0.5, 1}, T[3] = {0.4, 0.7, 1.5};
    const double g = 0.5, phase = (1 - g * g) / (4 * PI * pow(1 + g * g - 2 * g * cosine, 1.5));
    double sum = 0;
    for (int c = 0; c < 3; c++) {
        double once = (1 - exp(-2 * T[c])) / T[c];
        double way = cosine > 0 ? 2 * exp(-2 * T[c]) : cosine < 0 ? (1 - exp(-4 * T[c])) / (2 * T[c]) : once * once / 2;
        sum += 2 * S[c] * phase * way / 3;
    }
    return sum;
}

static double fog_across(void) { return fog(0); }
static double fog_back(void) { return fog(-1); }
static double fog_forward(void) { return fog(1); }
static double floor_below(void) { return 0.5 * 2 / PI; }
static double mirror_lamp(void) { return 0.9 * 2; }
static double mirror_sun(void) { return 0.9 * 0.5 * 2 / PI; }
static double glass_lamp(void) { return 2 * (1 - 0.04) / (1 + 0.04); } /* of all reflections between the faces */
static double glass_sun(void) { return 0.96 * 0.96 * 0.5 * 2 / PI; }   /* of the straight way alone */

/* A point light 2 above a square of side 2: what it sends into the square's solid angle. */
static double point_above(void) { return 0.5 / PI * 2 * 4 * atan(1 / (2 * sqrt(6))) / 4; }

static const struct {
    const char *name, *text;
    double (*mean)(void);
    int depth, spp;
    const char *without; /* methods that cannot make this light, or hardly ever do */
} SCENES[] = {
    {"fog, sun across the view", FOG SUN("<0 1 0>") "WorldEnd", fog_across, 1, 16, ""},
    {"fog, sun from behind", FOG SUN("<0 0 -1>") "WorldEnd", fog_back, 1, 16, ""},
    {"fog, sun from the front", FOG SUN("<0 0 1>") "WorldEnd", fog_forward, 1, 16, ""},
    {"floor, sun and view from above",
     VIEW("<0 4 0>", "<0 0 0>", "<0 0 1>", "1") "WorldBegin\n" SUN("<0 1 0>") FLOOR "WorldEnd", floor_below, 2, 16, ""},
    {"floor, point light above it",
     VIEW("<0 4 0>", "<0 0 0>", "<0 0 1>", "1") "WorldBegin LightSource \"point\" \"rgb I\" [2 2 2]\n" FLOOR "WorldEnd",
     point_above, 1, 32, ""},
    {"lamp in a mirror at 45 degrees",
     VIEW("<0 0 -5>", "<0 0 0>", "<0 1 0>", ".5") "WorldBegin Material \"mirror\"\n"
     FACE("<-1 -1 -1>", "<1 -1 -1>", "<1 1 1>", "<-1 1 1>")
     LAMP FACE("<-2 3 -2>", "<2 3 -2>", "<2 3 2>", "<-2 3 2>") "WorldEnd", mirror_lamp, 3, 4, "lt"},
    {"sun by a mirror at 45 degrees",
     VIEW("<0 -1 0>", "<0 -2 0>", "<0 0 1>", "1") "WorldBegin Material \"mirror\"\n"
     FACE("<-1 1 -1>", "<1 1 -1>", "<1 -1 1>", "<-1 -1 1>") SUN("<0 0 -1>") FLOOR "WorldEnd", mirror_sun, 2, 64, "pt"},
    {"lamp behind glass, head-on",
     VIEW("<0 0 -5>", "<0 0 0>", "<0 1 0>", ".5") "WorldBegin Material \"glass\"\n"
     FACE("<-1 -1 0>", "<-1 1 0>", "<1 1 0>", "<1 -1 0>") FACE("<-1 -1 1>", "<1 -1 1>", "<1 1 1>", "<-1 1 1>")
     LAMP FACE("<-2 -2 3>", "<2 -2 3>", "<2 2 3>", "<-2 2 3>") "WorldEnd", glass_lamp, 12, 32, "lt"},
    {"sun through glass, head-on",
     VIEW("<0 -1 0>", "<0 -2 0>", "<0 0 1>", "1") "WorldBegin Material \"glass\"\n"
     FACE("<-1 0 -1>", "<1 0 -1>", "<1 0 1>", "<-1 0 1>") FACE("<-1 1 -1>", "<-1 1 1>", "<1 1 1>", "<1 1 -1>")
     SUN("<0 1 0>") FLOOR "WorldEnd", glass_sun, 3, 64, "pt"}};
enum { N_SCENES = sizeof SCENES / sizeof SCENES[0] };

static void check(struct test *t, struct scene *scene, int i, const char *way)
{
    double wanted = SCENES[i].mean();
    const char *m = set_method(scene, way);
    int depth = SCENES[i].depth, spp = SCENES[i].spp;
    struct batches b = is_chain(way) ? independent_batches(t, scene, m, depth, spp, BATCHES / 2, 2, 877)
                                     : render_batches(t, scene, m, depth, 2 * spp, BATCHES, 2, 877);
    double mean = batches_mean(&b, NULL);
    bool exact = fabs(mean - wanted) < 1e-6 * wanted; /* of what does not vary chains have rounding errors alone */
    TEST_ACCEPT(t, exact ? 1 : mean_p(&b, wanted), "%s: %s: %.5f, not %.5f", SCENES[i].name, way, mean, wanted);
    if (!is_chain(way))
        TEST_REJECT(t, mean_p(&b, 1.3 * wanted), "%s: %s: 30 %% more than %.5f", SCENES[i].name, way, wanted);
    batches_free(&b);
}

/* Every scene by every method, each pair in a rotation of its own. */
static void test_positions(struct test *t)
{
    for (int i = 0, k = 0; i < N_SCENES; i++)
        for (int w = 0; w < N_WAYS; w++, k++) {
            char text[TEXT];
            struct scene scene;
            if (SCENES[i].without[0] != '\0' && strcmp(WAYS[w], SCENES[i].without) == 0)
                continue;
            turn_text(SCENES[i].text, k % 24, text);
            if (!scene_from_text(t, text, &scene))
                return;
            check(t, &scene, i, WAYS[w]);
            scene_free(&scene);
        }
}

/* --- size and brightness ------------------------------------------------------------------------------ */

/* A room, so many times as large and as bright: the picture must be as many times as bright, though throughputs pass
 * what a float holds. Powers of two leave all else as it is. */
static double brightness(struct test *t, const char *way, double size, double light)
{
    char scaled[TEXT];
    struct scene scene;
    snprintf(scaled, sizeof scaled, LOOK("0 0 -5", "0 0 0", "0 1 0") "Scale %.17g %.17g %.17g\n" CAMERA("1")
             "WorldBegin Scale %.17g %.17g %.17g\n" FLOOR FACE("-1 -2 1", "1 -2 1", "1 2 1", "-1 2 1")
             "AreaLightSource \"diffuse\" \"rgb L\" [%.17g %.17g %.17g]\n" FACE("-1 2 -1", "1 2 -1", "1 2 1", "-1 2 1")
             "WorldEnd", 1 / size, 1 / size, 1 / size, size, size, size, light, light, light);
    char text[TEXT];
    turn_text(scaled, 0, text);
    if (!scene_from_text(t, text, &scene))
        return 0;
    struct batches b = render_batches(t, &scene, set_method(&scene, way), 4, 16, 2, 2, 878);
    double mean = batches_mean(&b, NULL);
    batches_free(&b);
    scene_free(&scene);
    return mean;
}

static void test_scaled(struct test *t)
{
    for (int w = 0; w < N_WAYS; w++)
        if (!is_chain(WAYS[w])) {
            double plain = brightness(t, WAYS[w], 1, 1),
                   ratio = brightness(t, WAYS[w], 0x1p20, 0x1p98) / 0x1p98 / plain;
            CHECK(t, plain > 0.01 && fabs(ratio - 1) < 1e-3, "%s: %g of %g is left", WAYS[w], ratio, plain);
        }
}

void test_closed(struct test *t)
{
    test_positions(t);
    test_scaled(t);
}
