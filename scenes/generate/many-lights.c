/* many-lights.c: shelves and lamps of scenes/many-lights.pbrt, written to scenes/many-lights/. Metres, y up, the camera
 * looks along +z. The hall is x -2 .. 2, z 0 .. 14; on both sides it has 20 bays of 5 niches, a lamp in each. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "model.h"

#define DIR "many-lights/"

static const double BAY = 0.7, ROW = 0.6, DEPTH = 0.55, SIDE = 2, THICK = 0.03, VALANCE = 0.15, JAMB = 0.08;
enum { BAYS = 20, ROWS = 5 };

static void box(struct model *m, double x0, double y0, double z0, double x1, double y1, double z1)
{
    double lo[3] = {x0, y0, z0}, hi[3] = {x1, y1, z1};
    model_box(m, lo, hi, 0, 1);
}

static void shelves(void)
{
    struct model m;
    model_begin(&m);
    for (int side = -1; side <= 1; side += 2) {
        double x0 = side < 0 ? -SIDE - DEPTH : SIDE, x1 = x0 + DEPTH;
        for (int i = 0; i <= BAYS; i++) box(&m, x0, 0, BAY * i - THICK / 2, x1, ROW * ROWS, BAY * i + THICK / 2);
        /* the front: niches open by a window lower and narrower than they are */
        double face = side < 0 ? -SIDE - THICK : SIDE;
        for (int i = 0; i <= BAYS; i++) box(&m, face, 0, BAY * i - JAMB, face + THICK, ROW * ROWS, BAY * i + JAMB);
        for (int j = 1; j <= ROWS; j++) box(&m, face, ROW * j - VALANCE, 0, face + THICK, ROW * j, BAY * BAYS);
        for (int j = 0; j <= ROWS; j++) box(&m, x0, ROW * j - THICK / 2, 0, x1, ROW * j + THICK / 2, BAY * BAYS);
    }
    model_write(&m, DIR "shelves.ply");
}

/* A lamp: a small square under the niche's upper shelf, set back from its edge, its radiance between 1 and 100 times
 * the least. */
static void lamp(FILE *f, int side, int bay, int row, unsigned i)
{
    static const double warm[3] = {1.0, 0.62, 0.28}, cold[3] = {0.62, 0.82, 1.0};
    double h = 0.02 + 0.025 * scatter(i, 1), back = 0.12 + 0.36 * scatter(i, 2);
    double x = side * (SIDE + back), z = BAY * (bay + 0.3 + 0.4 * scatter(i, 3));
    double y = ROW * (row + 1) - THICK / 2 - 0.002, bright = 11 * pow(100, pow(scatter(i, 4), 2)), c[3];
    mix3(warm, cold, smooth(0.55, 0.9, scatter(i, 5)), c);
    fprintf(f, "AreaLightSource \"diffuse\" \"rgb L\" [%.1f %.1f %.1f]\n", bright * c[0], bright * c[1], bright * c[2]);
    fprintf(f, "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [%.3f %.3f %.3f %.3f %.3f %.3f",
            x - h, y, z - h, x + h, y, z - h);
    fprintf(f, " %.3f %.3f %.3f %.3f %.3f %.3f]\n", x + h, y, z + h, x - h, y, z + h);
}

/* What stands in a niche: a ball of one of four colours, or nothing. */
static void thing(FILE *f, int side, int bay, int row, unsigned i)
{
    static const char *const names[] = {"red", "blue", "white", "gold"};
    double r = 0.08 + 0.08 * scatter(i, 6);
    if (scatter(i, 7) < 0.4) return;
    fprintf(f,
            "AttributeBegin NamedMaterial \"%s\" Translate %.3f %.3f %.3f Shape \"sphere\" \"float radius\" %.3f "
            "AttributeEnd\n",
            names[(int)(4 * scatter(i, 8))], side * (SIDE + 0.25 + 0.1 * scatter(i, 9)), ROW * row + THICK / 2 + r,
            BAY * (bay + 0.35 + 0.3 * scatter(i, 10)), r);
}

static void niches(const char *path, void (*put)(FILE *f, int side, int bay, int row, unsigned i), const char *heading)
{
    FILE *f = fopen(path, "w");
    if (f == NULL) exit(1);
    fprintf(f, "# %s (written by generate/many-lights.c)\n", heading);
    for (int bay = 0; bay < BAYS; bay++)
        for (int row = 0; row < ROWS; row++)
            for (int side = -1; side <= 1; side += 2)
                put(f, side, bay, row, (unsigned)((bay * ROWS + row) * 2 + (side + 1) / 2));
    if (fclose(f) != 0) exit(1);
}

int main(void)
{
    shelves();
    niches(DIR "lamps.inc", lamp, "200 lamps, one in each niche");
    niches(DIR "things.inc", thing, "What stands in the niches");
    return 0;
}
