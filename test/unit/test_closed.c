/* test_closed.c: scenes along the axes, where radiance is known in closed form: directions are exactly perpendicular,
 * parallel or at 45 degrees. Lights, views, faces and mirrors are in one of the 24 rotations that exchange axes. What
 * all methods miss alike no comparison of methods shows. Most of the scenes are those of scenes/conform. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/maths.h"
#include "helpers.h"
#include "suites.h"

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

/* The words that points follow. */
static const char *points_follow(const char *p)
{
    static const char *const words[] = {"LookAt ", "\"point P\" [", "\"point from\" [", "\"point to\" ["};
    for (int i = 0; i < 4; i++)
        if (strncmp(p, words[i], strlen(words[i])) == 0)
            return words[i];
    return NULL;
}

/* A scene's text, whose points are turned. */
static void turn_text(const char *text, int k, char out[TEXT])
{
    size_t n = 0;
    for (const char *p = text; *p != '\0' && n < TEXT - 100;) {
        const char *words = points_follow(p);
        vec3 v;
        int length;
        if (words == NULL) {
            out[n++] = *p++;
            continue;
        }
        n += (size_t)snprintf(out + n, TEXT - n, "%s", words);
        for (p += strlen(words); sscanf(p, "%lf %lf %lf%n", &v.x, &v.y, &v.z, &length) == 3; p += length) {
            v = turned(k, v);
            n += (size_t)snprintf(out + n, TEXT - n, "%.9g %.9g %.9g ", v.x, v.y, v.z);
        }
    }
    out[n] = '\0';
}

/* --- scenes ------------------------------------------------------------------------------------------ */

#define LOOK(eye, at, up)                                                                                              \
    "Film \"image\" \"integer xresolution\" 2 \"integer yresolution\" 2 PixelFilter \"box\" Integrator \"bdpt\"\n"     \
    "LookAt " eye " " at " " up "\n"
#define CAMERA(half)                                                                                                   \
    "Camera \"orthographic\" \"float screenwindow\" [-" half " " half " -" half " " half "]\n"
#define FOG                                                                                                            \
    LOOK("0 0 -5", "0 0 0", "0 1 0") CAMERA("1")                                                                       \
    "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\n"                                                        \
    "\"rgb sigma_a\" [.1 .2 .5] \"rgb sigma_s\" [.3 .5 1] \"float g\" .5 WorldBegin Material \"\"\n"                   \
    "MediumInterface \"fog\" \"\" Shape \"trianglemesh\" \"integer indices\" [0 3 2 0 2 1 4 5 6 4 6 7 0 1 5 0 5 4\n"   \
    "3 7 6 3 6 2 0 4 7 0 7 3 1 2 6 1 6 5] \"point P\" [-1 -1 -1  1 -1 -1  1 1 -1  -1 1 -1  -1 -1 1  1 -1 1\n"          \
    "1 1 1  -1 1 1] MediumInterface \"\"\n"
#define SUN(from) "LightSource \"distant\" \"rgb L\" [2 2 2] \"point from\" [" from "] \"point to\" [0 0 0]\n"

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

static const struct {
    const char *name, *text; /* NULL: that of scenes/conform/NAME.pbrt, which says its closed form */
    double (*mean)(void);
    int depth, spp;
    const char *without; /* methods that cannot make this light, or hardly ever do */
} SCENES[] = {{"fog, sun across the view", FOG SUN("0 1 0") "WorldEnd", fog_across, 1, 16, ""},
              {"fog, sun from behind", FOG SUN("0 0 -1") "WorldEnd", fog_back, 1, 16, ""},
              {"fog, sun from the front", FOG SUN("0 0 1") "WorldEnd", fog_forward, 1, 16, ""},
              {"floor-sun", NULL, NULL, 2, 16, ""},
              {"floor-point", NULL, NULL, 1, 32, ""},
              {"mirror-lamp", NULL, NULL, 3, 4, "lt"},
              {"mirror-sun", NULL, NULL, 2, 64, "pt"},
              {"glass-lamp", NULL, NULL, 12, 32, "lt"},
              {"glass-sun", NULL, NULL, 3, 64, "pt"}};
enum { N_SCENES = sizeof SCENES / sizeof SCENES[0] };

/* What the comment of a scene says that its pixels are, or are on average; NaN if it does not. */
static double said(const char *text)
{
    const char *at = strstr(text, "# closed form");
    return at != NULL ? strtod(strchr(at, ':') + 1, NULL) : NAN;
}

static void check(struct test *t, struct scene *scene, int i, const char *way, double wanted)
{
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

/* Every scene by every method, each pair in a rotation of its own, as 2x2 pixels. */
static void test_positions(struct test *t)
{
    for (int i = 0, k = 0; i < N_SCENES; i++) {
        char name[64], text[TEXT], *stored = NULL;
        snprintf(name, sizeof name, "%s.pbrt", SCENES[i].name);
        const char *from = SCENES[i].text != NULL ? SCENES[i].text : (stored = text_of(t, "scenes/conform", name));
        for (int w = 0; w < N_WAYS; w++, k++) {
            struct scene scene;
            if (SCENES[i].without[0] != '\0' && strcmp(WAYS[w], SCENES[i].without) == 0)
                continue;
            turn_text(from, k % 24, text);
            if (!scene_from_text(t, text, &scene))
                break;
            scene.width = scene.height = 2;
            camera_prepare(&scene.camera, scene.width, scene.height);
            check(t, &scene, i, WAYS[w], SCENES[i].mean != NULL ? SCENES[i].mean() : said(from));
            scene_free(&scene);
        }
        free(stored);
    }
}

/* --- size and brightness ------------------------------------------------------------------------------ */

/* A room, so many times as large and as bright: the picture must be as many times as bright, though throughputs pass
 * what a float holds. Powers of two leave all else as it is. */
static double brightness(struct test *t, const char *way, double size, double light)
{
    char text[TEXT];
    struct scene scene;
    snprintf(text, sizeof text, LOOK("0 0 -5", "0 0 0", "0 1 0") "Scale %.17g %.17g %.17g\n" CAMERA("1")
             "WorldBegin Scale %.17g %.17g %.17g\n" "Material \"matte\" \"rgb Kd\" [.5 .5 .5]\n"
             QUAD("-1 -2 -1  1 -2 -1  1 -2 1  -1 -2 1") QUAD("-1 -2 1  1 -2 1  1 2 1  -1 2 1")
             "AreaLightSource \"diffuse\" \"rgb L\" [%.17g %.17g %.17g]\n" QUAD("-1 2 -1  1 2 -1  1 2 1  -1 2 1")
             "WorldEnd", 1 / size, 1 / size, 1 / size, size, size, size, light, light, light);
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
