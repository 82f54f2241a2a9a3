/* test_far.c: scenes far from the origin of their file: moved with its camera, a scene has the image that it had, by
 * the same random numbers.
 *
 * Rounding may still send some samples elsewhere: a few pixels may differ. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "helpers.h"
#include "random_scene.h"
#include "random_writer.h"
#include "suites.h"

enum { SPP = 4 };

/* The share of pixels that differ by more than a thousandth of both. */
static double different(struct test *t, const char *near, const char *far)
{
    const char *const text[2] = {near, far};
    float *pixel[2] = {NULL, NULL};
    size_t n = 0, differ = 0;
    for (int i = 0; i < 2; i++) {
        struct render_job o = {.integrator = method_named("bdpt"), .end = SPP};
        struct scene scene;
        if (!scene_from_text(t, text[i], &scene))
            break;
        n = rect_pixels(render_crop(&scene)) * 3;
        pixel[i] = mem_alloc(n, sizeof *pixel[i]);
        render_pixels(t, &scene, &o, pixel[i]);
        scene_free(&scene);
    }
    for (size_t i = 0; i < n && pixel[1] != NULL; i++) {
        double a = (double)pixel[0][i], b = (double)pixel[1][i];
        differ += !(fabs(a - b) <= 1e-3 * (fabs(a) + fabs(b)));
    }
    double share = pixel[1] == NULL ? 1 : (double)differ / (double)n;
    free(pixel[0]);
    free(pixel[1]);
    return share;
}

/* --- whatever has a place ------------------------------------------------------------------------------- */

static void put_move(struct writer *w, vec3 by) { put(w, "Translate %.17g %.17g %.17g ", by.x, by.y, by.z); }

/* A list of points, moved. */
static void put_points(struct writer *w, int n, const vec3 *p, vec3 by)
{
    put(w, "\"point P\" [ ");
    for (int i = 0; i < n; i++)
        put(w, "%.17g %.17g %.17g ", by.x + p[i].x, by.y + p[i].y, by.z + p[i].z);
    put(w, "]\n");
}

/* Textures that see places: in the texture's own space, of which pbrt-v3 takes the current transform for what leads
 * there, about its origin, and along vectors of the world. */
static void put_textures_of_places(struct writer *w, vec3 by)
{
    static const char *const FORWARD[] = {"cubes\" \"spectrum\" \"checkerboard\" \"integer dimension\" 3",
                                          "fbm\" \"spectrum\" \"fbm\"", "marble\" \"spectrum\" \"marble\""};
    static const char *const AROUND[] = {"spherical", "cylindrical"};
    for (int i = 0; i < 3; i++) {
        put(w, "TransformBegin Scale 3 3 3 ");
        put_move(w, neg(by));
        put(w, "Texture \"%s TransformEnd\n", FORWARD[i]);
    }
    for (int i = 0; i < 2; i++) {
        put(w, "TransformBegin ");
        put_move(w, by);
        put(w, "Translate .1 .4 .2 Texture \"%s\" \"spectrum\" \"checkerboard\" \"string mapping\" \"%s\" "
               "\"float uscale\" 9 \"float vscale\" 9 TransformEnd\n", AROUND[i], AROUND[i]);
    }
    put(w, "Texture \"planar\" \"spectrum\" \"checkerboard\" \"string mapping\" \"planar\" \"vector v1\" [ 1 0 0 ] "
           "\"vector v2\" [ 0 0 1 ] \"float udelta\" %.17g \"float vdelta\" %.17g\n", -by.x, -by.z);
}

static char *everything(vec3 by)
{
    static const vec3 FLOOR[] = {{-4, 0, -4}, {4, 0, -4}, {4, 0, 4}, {-4, 0, 4}};
    static const vec3 PYRAMID[] = {{1, 0, 1}, {2, 0, 1}, {1.5, 0, 2}, {1.5, 1, 1.3}};
    static const vec3 HAIR[] = {{-1, 0, 1}, {-1.3, 1, 1}, {-0.8, 1.5, 1}, {-1, 2.1, 1.2}};
    struct writer w = {.top = ""};
    put(&w, "Film \"image\" \"integer xresolution\" 24 \"integer yresolution\" 18 PixelFilter \"box\"\n"
            "Integrator \"bdpt\" \"integer maxdepth\" 4\nLookAt 0.3 3 -6  0 0.5 0  0 1 0 ");
    put_move(&w, neg(by));
    put(&w, "Camera \"perspective\" \"float fov\" 45 WorldBegin\n"
            "MakeNamedMedium \"milk\" \"string type\" \"homogeneous\" \"rgb sigma_s\" [2 2 2]\n");
    put_textures_of_places(&w, by);
    put(&w, "Material \"matte\" \"texture Kd\" \"planar\" Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] ");
    put_points(&w, 4, FLOOR, by);
    put(&w, "Material \"matte\" Shape \"loopsubdiv\" \"integer indices\" [ 0 1 2 0 3 1 1 3 2 2 3 0 ] ");
    put_points(&w, 4, PYRAMID, by);
    put(&w, "Shape \"curve\" \"float width\" .1 ");
    put_points(&w, 4, HAIR, by);
    put(&w, "AttributeBegin Translate 0 .5 0 ObjectBegin \"balls\" Material \"matte\" \"texture Kd\" \"cubes\"\n"
            "Shape \"sphere\" \"float radius\" .3 Translate .6 0 0 Material \"matte\" \"texture Kd\" \"fbm\"\n"
            "Shape \"sphere\" \"float radius\" .3 ObjectEnd AttributeEnd\nAttributeBegin CoordSysTransform \"camera\"\n"
            "Material \"mirror\" Translate .7 .5 5 Shape \"disk\" \"float radius\" .4 AttributeEnd\n"
            "AttributeBegin Transform [ 1 0 0 0 0 1 0 0 0 0 1 0 %.17g %.17g %.17g 1 ]\n"
            "Material \"matte\" \"texture Kd\" \"spherical\" Shape \"sphere\" \"float radius\" .5 AttributeEnd\n",
        by.x - 1.5, by.y + 0.5, by.z - 0.7);
    put_move(&w, by);
    put(&w, "CoordinateSystem \"here\" AttributeBegin Translate -.4 0 0 ObjectInstance \"balls\" AttributeEnd\n"
            "AttributeBegin Identity CoordSysTransform \"here\" Translate 1.3 .6 -1 Rotate 70 1 0 0 Material \"matte\" "
            "\"texture Kd\" \"cylindrical\" Shape \"cylinder\" \"float radius\" .4 AttributeEnd\n"
            "AttributeBegin MediumInterface \"milk\" \"\" Material \"\" Translate 0 .5 -1 Shape \"sphere\" "
            "\"float radius\" .4 AttributeEnd\nMaterial \"matte\" \"texture Kd\" \"marble\"\n"
            "Shape \"disk\" \"float height\" -1 \"float radius\" 9\n"
            "LightSource \"point\" \"point from\" [ 2 3 -2 ] \"rgb I\" [ 9 5 5 ]\n"
            "LightSource \"spot\" \"point from\" [ -2 3 -2 ] \"point to\" [ 0 0 0 ] \"rgb I\" [ 5 9 5 ]\n"
            "LightSource \"distant\" \"point from\" [ 1 2 3 ] \"rgb L\" [ .3 .3 .6 ]\n"
            "LightSource \"infinite\" \"rgb L\" [ .1 .1 .2 ]\n"
            "AttributeBegin Translate 0 4 0 AreaLightSource \"diffuse\" Shape \"sphere\" AttributeEnd WorldEnd\n");
    return w.text;
}

static void test_everything(struct test *t)
{
    static const double AWAY[] = {1e4, 3e7, 1e8, 1e9};
    char *near = everything(vec(0, 0, 0));
    for (size_t i = 0; i < sizeof AWAY / sizeof AWAY[0]; i++) {
        char *far = everything(mul(vec(1, -0.75, 0.5), AWAY[i]));
        double share = different(t, near, far);
        CHECK(t, share < 0.02, "moved by %g: %.2g %% of the pixels differ", AWAY[i], 100 * share);
        free(far);
    }
    /* What is moved alone is elsewhere. */
    char *far = everything(vec(0.01, 0, 0)), *camera = strstr(far, "Translate ");
    memcpy(camera, "Translate 0.00", 14);
    CHECK(t, different(t, near, far) > 0.3, "a camera that stays sees the same");
    free(far);
    free(near);
}

/* --- random scenes -------------------------------------------------------------------------------------- */

/* Those of textures that see places are moved without these; the last bit of the scene's radius makes another alias
 * table of the cells of a map that is the same everywhere. */
static bool left_out(const char *text)
{
    static const char *const WORDS[] = {"\"fbm\"", "\"wrinkled\"", "\"marble\"", "dimension", "\"planar\"",
                                        "mapname"};
    for (size_t i = 0; i < sizeof WORDS / sizeof WORDS[0]; i++)
        if (strstr(text, WORDS[i]) != NULL)
            return true;
    return false;
}

static void test_moved(struct test *t)
{
    enum { SCENES = 60 };
    static const double AWAY[] = {1, 10, 1e2, 1e3, 1e4, 1e5, 1e6, 1e8};
    char top[1024];
    int n = 0;
    top_directory(top, sizeof top);
    for (uint64_t i = 0; i < SCENES; i++) {
        struct random_scene near = random_scene_moved(i, top, 0), far = random_scene_moved(i, top, AWAY[i % 8]);
        if (!left_out(near.text)) {
            double share = different(t, near.text, far.text);
            CHECK(t, share < 0.02, "scene %d: %.2g %% of the pixels differ", (int)i, 100 * share);
            n++;
        }
        free(near.text);
        free(far.text);
    }
    CHECK(t, n > SCENES / 3, "only %d scenes", n);
}

void test_far(struct test *t)
{
    test_everything(t);
    test_moved(t);
}
