/* forest.c: trunk, leaves and the places of the trees of scenes/forest.pbrt, written to scenes/forest/. Metres, y up. A
 * tree is about 7 high and stands at the origin; its leaves are squares with a picture of a twig, most of which is a
 * hole. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "model.h"

#define DIR "forest/"

enum { BRANCHES = 14, TUFTS = 26, TREES = 90 };

/* A point of branch i, from the trunk (s = 0) to its end (s = 1). */
static void branch_at(int i, double s, double p[3])
{
    double height = 2.3 + 4.0 * i / BRANCHES, angle = 2.4 * i + 0.8 * scatter((unsigned)i, 1);
    double length = (1.9 - 0.9 * i / BRANCHES) * (0.8 + 0.4 * scatter((unsigned)i, 2));
    p[0] = length * s * cos(angle);
    p[1] = height + length * (0.55 * s - 0.2 * s * s);
    p[2] = length * s * sin(angle);
}

static void wood(void)
{
    static const double trunk[][4] = {{0, -0.1, 0, 0.24},
                                      {0.02, 0.3, 0, 0.17},
                                      {0.05, 2.2, 0.04, 0.13},
                                      {-0.04, 4.4, 0.02, 0.08},
                                      {0.02, 6.6, -0.02, 0.02}};
    struct model m;
    model_begin(&m);
    model_tube(&m, trunk, 5, 2, 8);
    for (int i = 0; i < BRANCHES; i++) {
        double path[3][4];
        for (int k = 0; k < 3; k++) {
            branch_at(i, 0.5 * k, path[k]);
            path[k][3] = 0.045 - 0.018 * k;
        }
        model_tube(&m, (const double (*)[4])path, 3, 1, 5);
    }
    model_write(&m, DIR "wood.ply");
}

/* Squares along the outer parts of the branches, every way round. */
static void leaves(void)
{
    struct model m;
    model_begin(&m);
    for (int i = 0; i < BRANCHES; i++) {
        for (int k = 0; k < TUFTS; k++) {
            unsigned n = (unsigned)(i * TUFTS + k);
            double at[3], size = 0.30 + 0.22 * scatter(n, 3), spread = 0.8, h = size / 2;
            double a[3] = {-h, -h, 0}, e[3] = {2 * h, 0, 0}, f[3] = {0, 2 * h, 0};
            branch_at(i, 0.3 + 0.75 * scatter(n, 4), at);
            for (int c = 0; c < 3; c++) at[c] += spread * (scatter(n, 5 + (unsigned)c) - 0.5);
            model_home(&m);
            model_translate(&m, at[0], at[1], at[2]);
            model_rotate(&m, 1, 360 * scatter(n, 8));
            model_rotate(&m, 0, 180 * scatter(n, 9) - 90);
            m.uv_scale = 1 / size; /* the picture once on every square */
            model_quad(&m, a, e, f);
        }
    }
    model_write(&m, DIR "leaves.ply");
}

/* A twig with seven leaves: 1 where there is leaf, 0 for the holes. */
static void twig(void)
{
    static const double leaf[7][3] = {{0.50, 0.80, 90}, {0.28, 0.62, 150}, {0.72, 0.62, 30}, {0.26, 0.38, 160},
                                      {0.74, 0.38, 20}, {0.32, 0.16, 190}, {0.68, 0.16, -10}}; /* centre, direction */
    struct picture p;
    const int n = 32;
    picture_begin(&p, n, n);
    for (int y = 0; y < n; y++) {
        for (int x = 0; x < n; x++) {
            double u = (x + 0.5) / n, v = 1 - (y + 0.5) / n, on = fabs(u - 0.5) < 0.02 && v < 0.7 ? 1 : 0;
            for (int i = 0; i < 7; i++) {
                double c = cos(leaf[i][2] * TAU / 360), s = sin(leaf[i][2] * TAU / 360);
                double along = (u - leaf[i][0]) * c + (v - leaf[i][1]) * s,
                       across = (v - leaf[i][1]) * c - (u - leaf[i][0]) * s;
                if (fabs(along) < 0.19 && fabs(across) < 0.105 * (1 - along * along / (0.19 * 0.19))) on = 1;
            }
            double c[3] = {on, on, on};
            picture_set(&p, x, y, c);
        }
    }
    picture_write(&p, DIR "twig.tga");
}

/* A tree in each of the fields of a jittered grid, none on the path that leads away from the camera. */
static void places(void)
{
    FILE *f = fopen(DIR "trees.inc", "w");
    if (f == NULL) exit(1);
    fprintf(f, "# where the trees stand (written by generate/forest.c)\n");
    for (int i = 0; i < TREES; i++) {
        unsigned n = (unsigned)i;
        double x = 3.6 * (i % 9 - 4 + 0.7 * (scatter(n, 11) - 0.5)), z = 3.4 * (i / 9 + 0.7 * (scatter(n, 12) - 0.5));
        double size = 0.75 + 0.55 * scatter(n, 14);
        if (fabs(x - 1.2 * sin(0.25 * z)) < 1.5) continue;
        fprintf(f,
                "AttributeBegin Translate %.2f 0 %.2f Rotate %.0f 0 1 0 Scale %.2f %.2f %.2f ObjectInstance \"tree\" "
                "AttributeEnd\n",
                x, z, 360 * scatter(n, 13), size, size * (0.9 + 0.3 * scatter(n, 15)), size);
    }
    if (fclose(f) != 0) exit(1);
}

int main(void)
{
    wood();
    leaves();
    twig();
    places();
    return 0;
}
