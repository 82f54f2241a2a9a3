/* model.h: triangle meshes and pictures for the scenes, made from a few numbers.
 *
 * Pieces (boxes with rounded edges, surfaces of revolution, tubes, any parametric surface) are appended to one
 * mesh per material under a current placement, then written as a PLY file with normals and texture coordinates.
 * Pictures are written as TGA, skies as PFM. Numbers are rounded before they are written, so that every machine writes
 * the same files. Build and run everything with scenes/generate/make-all.sh.
 */
#ifndef SCENES_MODEL_H
#define SCENES_MODEL_H

#include <stddef.h>

#define TAU 6.283185307179586

/* Where the next piece goes: p -> m p + t, columns of m in m[0..2], m[3..5], m[6..8]. */
struct placement {
    double m[9], t[3];
};

struct model {
    double *vertex; /* [n_vertices * 8]: position, unit normal, u v */
    int *face;      /* [n_faces * 3] */
    size_t n_vertices, n_faces, vertex_capacity, face_capacity;
    struct placement at;
    double uv_scale; /* texture units per metre (boxes, quads) or per patch; 1 at first */
};

void model_begin(struct model *m);

/* Placement: each call acts on pieces before those already given, as nested transforms in a scene file do. */
void model_home(struct model *m);
void model_translate(struct model *m, double x, double y, double z);
void model_rotate(struct model *m, int axis, double degrees); /* axis 0, 1, 2 */
void model_scale(struct model *m, double x, double y, double z);

/* One flat quadrilateral a, a+e, a+e+f, a+f; its normal is e x f, its texture runs along e and f in metres. */
void model_quad(struct model *m, const double a[3], const double e[3], const double f[3]);

/* A box from lo to hi whose edges are rounded with this radius, in `steps` steps; radius 0 gives a plain box. */
void model_box(struct model *m, const double lo[3], const double hi[3], double radius, int steps);

/* A parametric surface over [0,1]^2 of nu x nv cells. Its normal is dp/du x dp/dv. */
typedef void surface_function(const void *context, double u, double v, double p[3]);
void model_patch(struct model *m, surface_function *f, const void *context, int nu, int nv);

/* A surface of revolution about y through `n` points (radius, height), smooth but where a point is repeated.
 * Going upwards the normal points away from the axis. */
void model_lathe(struct model *m, const double (*profile)[2], int n, int steps, int around);

/* A tube along a smooth curve through `n` points (x, y, z, radius), with flat ends. */
void model_tube(struct model *m, const double (*path)[4], int n, int steps, int around);

/* A pillow within +-h: a superellipsoid, from an ellipsoid (power 1) towards a box (power 0). */
void model_pillow(struct model *m, const double h[3], double power, int nu, int nv);

/* Write the mesh, tell its size, and release it. Ends the program when the file cannot be written. */
void model_write(struct model *m, const char *path);

/* Pictures: sRGB bytes, top row first. */
struct picture {
    unsigned char *rgb;
    int width, height;
};

void picture_begin(struct picture *p, int width, int height);
void picture_set(struct picture *p, int x, int y, const double rgb[3]); /* sRGB encoded, 0..1 */
void picture_write(struct picture *p, const char *path);

/* A sky as PFM: light by direction (unit, y up), the zenith in the top row. The scene's infinite light is to be turned
 * by -90 degrees about x, so that the map's z points up. */
typedef void sky_function(const double d[3], double rgb[3]);
void sky_write(const char *path, int width, int height, sky_function *f);

/* Noise in [0,1], smooth, repeating every `period` units in x and y; fractal sum of four octaves. */
double noise(double x, double y, int period, unsigned seed);
double fractal(double x, double y, int period, unsigned seed);

/* A number in [0,1) that depends on (i, seed) alone. */
double scatter(unsigned i, unsigned seed);

double mixed(double a, double b, double t);
double smooth(double lo, double hi, double x);
void mix3(const double a[3], const double b[3], double t, double out[3]);

#endif
