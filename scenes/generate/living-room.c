/* living-room.c: meshes, pictures and the sky of scenes/living-room.pbrt, written to scenes/living-room/. Metres, y
 * up, the camera looks along +z. The room is x -3 .. 3, y 0 .. 2.7, z -5 .. 0, its windows in the left wall. */
#include <math.h>

#include "model.h"

#define DIR "living-room/"

static void box(struct model *m, double x0, double y0, double z0, double x1, double y1, double z1, double radius)
{
    double lo[3] = {x0, y0, z0}, hi[3] = {x1, y1, z1};
    model_box(m, lo, hi, radius, radius > 0.05 ? 3 : radius > 0.01 ? 2 : 1);
}

static void pillow_at(struct model *m, const double at[3], const double h[3], double turn, double lean, double spin)
{
    model_home(m);
    model_translate(m, at[0], at[1], at[2]);
    model_rotate(m, 1, turn);
    model_rotate(m, 0, lean);
    model_rotate(m, 2, spin);
    model_pillow(m, h, 0.5, 12, 24);
}

/* ---- sofa: around x = 0, its back at z = 0, its front at z = -0.92 ---- */

/* A cushion: a rounded box whose large faces bulge. */
static void cushion(const void *context, double u, double v, double p[3])
{
    const double *h = context;
    double theta = (u - 0.5) * TAU / 2, phi = v * TAU;
    double c = cos(theta), s = sin(theta), a = cos(phi), b = sin(phi);
    double r = pow(c, 0.22), x = (a < 0 ? -1 : 1) * pow(fabs(a), 0.22), z = (b < 0 ? -1 : 1) * pow(fabs(b), 0.22);
    p[0] = h[0] * r * x;
    p[2] = h[2] * r * z;
    double bulge = 1 + 0.28 * (1 - r * r * x * x) * (1 - r * r * z * z);
    p[1] = h[1] * (s < 0 ? -1 : 1) * pow(fabs(s), 0.35) * bulge;
}

static void sofa(void)
{
    static const double seat[3] = {0.47, 0.075, 0.38}, back[3] = {0.46, 0.085, 0.25};
    static const double foot[][2] = {{0.014, 0}, {0.024, 0.12}};
    static const double throw_at[2][3] = {{-0.76, 0.66, -0.34}, {0.70, 0.655, -0.36}},
                        throw_size[3] = {0.21, 0.20, 0.075};
    struct model m;
    model_begin(&m);
    box(&m, -1.10, 0.12, -0.90, 1.10, 0.32, -0.02, 0.03);
    box(&m, -1.10, 0.12, -0.16, 1.10, 0.74, 0.0, 0.055);
    box(&m, -1.16, 0.12, -0.92, -0.95, 0.60, 0.0, 0.06);
    box(&m, 0.95, 0.12, -0.92, 1.16, 0.60, 0.0, 0.06);
    model_write(&m, DIR "sofa.ply");
    model_patch(&m, cushion, seat, 12, 28);
    model_write(&m, DIR "sofa-seat.ply");
    model_rotate(&m, 0, -76);
    model_patch(&m, cushion, back, 12, 28);
    model_write(&m, DIR "sofa-back.ply");
    for (int i = 0; i < 4; i++) {
        model_home(&m);
        model_translate(&m, i % 2 ? 1.02 : -1.02, 0, i / 2 ? -0.80 : -0.12);
        model_lathe(&m, foot, 2, 1, 10);
    }
    model_write(&m, DIR "sofa-feet.ply");
    pillow_at(&m, throw_at[0], throw_size, 22, 24, 14);
    model_write(&m, DIR "pillow-1.ply");
    pillow_at(&m, throw_at[1], throw_size, -26, 26, -12);
    model_write(&m, DIR "pillow-2.ply");
}

/* ---- coffee table, lamp, sideboard and what stands on them ---- */

static void coffee_table(void)
{
    static const double top[][2] = {{0, 0},         {0.466, 0},     {0.466, 0},     {0.472, 0.003},
                                    {0.472, 0.011}, {0.466, 0.014}, {0.466, 0.014}, {0, 0.014}};
    struct model m;
    model_begin(&m);
    model_lathe(&m, top, 8, 2, 48);
    model_write(&m, DIR "glass-top.ply");
    for (int i = 0; i < 3; i++) {
        double a = TAU * (i + 0.2) / 3, c = cos(a), s = sin(a);
        double leg[4][4] = {{0.36 * c, 0, 0.36 * s, 0.011}, {0.30 * c, 0.20, 0.30 * s, 0.013},
                            {0.31 * c, 0.36, 0.31 * s, 0.013}, {0.36 * c, 0.398, 0.36 * s, 0.016}};
        model_home(&m);
        model_tube(&m, (const double (*)[4])leg, 4, 2, 8);
    }
    double ring[17][4];
    for (int i = 0; i <= 16; i++) {
        ring[i][0] = 0.30 * cos(TAU * i / 16);
        ring[i][1] = 0.20;
        ring[i][2] = 0.30 * sin(TAU * i / 16);
        ring[i][3] = 0.008;
    }
    model_tube(&m, (const double (*)[4])ring, 17, 1, 8);
    model_write(&m, DIR "table-legs.ply");
}

static void vessels(void)
{
    static const double bowl[][2] = {{0, 0},        {0.05, 0},      {0.05, 0},      {0.052, 0.012}, {0.09, 0.03},
                                     {0.135, 0.07}, {0.148, 0.10},  {0.146, 0.103}, {0.142, 0.10},  {0.128, 0.072},
                                     {0.084, 0.036}, {0, 0.024}};
    static const double vase[][2] = {{0, 0},        {0.055, 0},    {0.068, 0.006}, {0.092, 0.09},  {0.085, 0.17},
                                     {0.045, 0.25}, {0.036, 0.31}, {0.052, 0.36},  {0.054, 0.363}, {0.050, 0.362},
                                     {0.030, 0.31}, {0.039, 0.25}, {0.079, 0.17},  {0.085, 0.09},  {0.062, 0.018},
                                     {0, 0.014}};
    struct model m;
    model_begin(&m);
    model_lathe(&m, bowl, 12, 2, 24);
    model_write(&m, DIR "bowl.ply");
    model_lathe(&m, vase, 16, 2, 24);
    model_write(&m, DIR "vase.ply");
}

static void lamp(void)
{
    static const double stand[][2] = {{0.15, 0},     {0.15, 0.012}, {0.145, 0.02}, {0.03, 0.03},
                                      {0.012, 0.05}, {0.012, 0.05}, {0.012, 1.50}, {0.012, 1.50},
                                      {0.02, 1.505}, {0.02, 1.56},  {0, 1.565}};
    static const double shade[][2] = {{0.235, 1.36}, {0.165, 1.70}};
    struct model m;
    model_begin(&m);
    model_lathe(&m, stand, 11, 2, 24);
    model_write(&m, DIR "lamp-stand.ply");
    model_lathe(&m, shade, 2, 1, 36);
    model_write(&m, DIR "lamp-shade.ply");
}

static void sideboard(void)
{
    struct model m;
    model_begin(&m);
    box(&m, -0.85, 0.16, -0.44, 0.85, 0.19, 0, 0.004);
    box(&m, -0.85, 0.66, -0.44, 0.85, 0.69, 0, 0.004);
    box(&m, -0.85, 0.19, -0.44, -0.82, 0.66, 0, 0.004);
    box(&m, 0.82, 0.19, -0.44, 0.85, 0.66, 0, 0.004);
    box(&m, -0.82, 0.19, -0.02, 0.82, 0.66, -0.005, 0);
    for (int i = 0; i < 2; i++) box(&m, i ? 0.004 : -0.816, 0.196, -0.435, i ? 0.816 : -0.004, 0.654, -0.415, 0.004);
    for (int i = 0; i < 4; i++) {
        double x = i % 2 ? 0.72 : -0.72, z = i / 2 ? -0.38 : -0.06;
        double leg[2][4] = {{x * 1.06, 0, z, 0.012}, {x, 0.165, z, 0.02}};
        model_tube(&m, (const double (*)[4])leg, 2, 1, 10);
    }
    model_write(&m, DIR "sideboard.ply");
    for (int kind = 0; kind < 3; kind++) {
        static const char *const path[3] = {DIR "books-1.ply", DIR "books-2.ply", DIR "books-3.ply"};
        double x = 0;
        for (unsigned i = 0; i < 11; i++) {
            double w = 0.022 + 0.022 * scatter(i, 1), h = 0.20 + 0.09 * scatter(i, 2), d = 0.13 + 0.05 * scatter(i, 3);
            if ((int)(3 * scatter(i, 6)) == kind) box(&m, x, 0, -d, x + w - 0.001, h, 0, 0.003);
            x += w;
        }
        model_write(&m, path[kind]);
    }
}

/* ---- plant ---- */

struct leaf {
    double rise, reach, width, twist;
};

/* An arching blade with a fold along its middle; u from stalk to tip, v across. */
static void leaf_blade(const void *context, double u, double v, double p[3])
{
    const struct leaf *l = context;
    double across = (v - 0.5) * l->width * (u < 0.25 ? 0.12 : 0.12 + 0.88 * pow(sin(TAU / 2 * (u - 0.25) / 0.75), 0.8));
    double up = l->rise * u * (1.9 - 0.9 * u * u), out = l->reach * (0.35 * u + 0.65 * u * u * u);
    p[0] = out - 0.25 * fabs(across);
    p[1] = up - l->reach * 0.25 * u * u * u + 0.35 * fabs(across);
    p[2] = across + l->twist * u * u;
}

static void plant(void)
{
    static const double pot[][2] = {{0, 0},       {0.13, 0},    {0.13, 0},    {0.14, 0.01}, {0.18, 0.27}, {0.18, 0.27},
                                    {0.195, 0.275}, {0.195, 0.31}, {0.185, 0.315}, {0.172, 0.31}, {0.17, 0.28}};
    static const double soil[][2] = {{0.174, 0.284}, {0.08, 0.30}, {0, 0.302}};
    struct model m;
    model_begin(&m);
    model_lathe(&m, pot, 11, 2, 32);
    model_write(&m, DIR "plant-pot.ply");
    model_lathe(&m, soil, 3, 2, 20);
    model_write(&m, DIR "plant-soil.ply");
    for (unsigned i = 0; i < 34; i++) {
        double ring = (double)i / 33;
        struct leaf l = {0.42 + 0.42 * (1 - ring) + 0.15 * scatter(i, 1), 0.10 + 0.60 * ring + 0.10 * scatter(i, 2),
                         0.075 + 0.035 * scatter(i, 3), 0.12 * (scatter(i, 4) - 0.5)};
        model_home(&m);
        model_translate(&m, 0, 0.29, 0);
        model_rotate(&m, 1, 137.5 * i + 14 * scatter(i, 5));
        model_translate(&m, 0.02 + 0.05 * ring, 0, 0);
        model_patch(&m, leaf_blade, &l, 9, 2);
    }
    model_write(&m, DIR "plant-leaves.ply");
}

/* ---- windows, curtains, skirting, picture frame ---- */

static void windows(void)
{
    struct model m;
    model_begin(&m);
    for (int i = 0; i < 2; i++) {
        double a = i ? -2.3 : -4.2, b = a + 1.3, mid = (a + b) / 2;
        box(&m, -3.16, 0.25, a, -3.10, 2.30, a + 0.06, 0.006);
        box(&m, -3.16, 0.25, b - 0.06, -3.10, 2.30, b, 0.006);
        box(&m, -3.16, 0.25, a + 0.06, -3.10, 0.31, b - 0.06, 0.006);
        box(&m, -3.16, 2.24, a + 0.06, -3.10, 2.30, b - 0.06, 0.006);
        box(&m, -3.15, 0.31, mid - 0.025, -3.11, 2.24, mid + 0.025, 0.005);
        box(&m, -3.145, 1.60, a + 0.06, -3.115, 1.64, b - 0.06, 0.005);
        box(&m, -3.24, 0.225, a - 0.03, -2.94, 0.25, b + 0.03, 0.006);
    }
    box(&m, -3, 0, -5, -2.985, 0.10, 0, 0.005);
    box(&m, -2.985, 0, -0.015, 3, 0.10, 0, 0.005);
    model_write(&m, DIR "windows.ply");
    box(&m, -0.68, -0.49, -0.03, 0.68, -0.45, 0, 0.006);
    box(&m, -0.68, 0.45, -0.03, 0.68, 0.49, 0, 0.006);
    box(&m, -0.68, -0.45, -0.03, -0.64, 0.45, 0, 0.006);
    box(&m, 0.64, -0.45, -0.03, 0.68, 0.45, 0, 0.006);
    model_write(&m, DIR "picture-frame.ply");
}

/* u down, v along z: folds that open a little downwards. */
static void curtain_cloth(const void *context, double u, double v, double p[3])
{
    double phase = *(const double *)context;
    double fold = sin(TAU * 6 * v + phase) + 0.35 * sin(TAU * 11 * v + 2.5 * phase + 1.5 * u);
    p[0] = 0.035 * (0.7 + 0.5 * u) * fold;
    p[1] = 2.48 * (1 - u) + 0.02;
    p[2] = 0.52 * v + 0.012 * u * sin(TAU * 12 * v + phase);
}

static void curtains(void)
{
    static const double at[3] = {-2.82, -1.0, -3.22}, phase[3] = {0.3, 1.9, 4.0};
    static const double rod[][4] = {{-2.88, 2.52, -4.6, 0.012}, {-2.88, 2.52, -0.35, 0.012}};
    struct model m;
    model_begin(&m);
    for (int i = 0; i < 3; i++) {
        model_home(&m);
        model_translate(&m, -2.88, 0, i == 0 ? at[0] : i == 1 ? at[1] : -4.72);
        model_patch(&m, curtain_cloth, &phase[i], 3, 56);
    }
    model_write(&m, DIR "curtains.ply");
    model_tube(&m, rod, 2, 1, 10);
    model_write(&m, DIR "curtain-rod.ply");
}

/* ---- pictures ---- */

/* Eight planks of staggered lengths; repeats. Grain runs along x. */
static void planks(void)
{
    static const double dark[3] = {0.42, 0.27, 0.16}, light[3] = {0.70, 0.50, 0.33}, gap[3] = {0.16, 0.10, 0.06};
    struct picture p;
    const int n = 144, plank = 18;
    picture_begin(&p, n, n);
    for (int y = 0; y < n; y++) {
        for (int x = 0; x < n; x++) {
            int row = y / plank, shift = (row * 61) % n, along = (x + shift) % n;
            double tone = scatter((unsigned)(row * 2 + (along >= n / 2)), 5), c[3];
            double ring = 2.2 * fractal(3.0 * x / n + 5 * tone, 16.0 * y / n, 48, (unsigned)row);
            double line = 0.5 + 0.5 * sin(TAU * 3 * ring), fibre = noise(10.0 * x / n, 72.0 * y / n, 720, 3);
            mix3(light, dark, 0.55 * tone + 0.22 * line + 0.22 * fibre, c);
            if (y % plank == 0 || along % (n / 2) == 0) mix3(c, gap, 0.75, c);
            picture_set(&p, x, y, c);
        }
    }
    picture_write(&p, DIR "planks.tga");
}

/* Overlapping discs and bars on a pale ground. */
static void painting(void)
{
    static const double ground[3] = {0.90, 0.86, 0.77};
    static const double disc[6][3] = {{0.36, 0.56, 0.30}, {0.62, 0.40, 0.19}, {0.72, 0.70, 0.13},
                                      {0.22, 0.24, 0.10}, {0.50, 0.80, 0.07}, {0.60, 0.40, 0.08}};
    static const double colour[6][3] = {{0.80, 0.34, 0.20}, {0.13, 0.26, 0.38}, {0.88, 0.66, 0.25},
                                        {0.18, 0.42, 0.40}, {0.15, 0.15, 0.17}, {0.93, 0.90, 0.84}};
    struct picture p;
    const int w = 144, h = 101;
    picture_begin(&p, w, h);
    for (int y = 0; y < h; y++) {
        for (int x = 0; x < w; x++) {
            double u = (x + 0.5) / w, v = (y + 0.5) / w, c[3];
            mix3(ground, ground, 0, c);
            for (int i = 0; i < 6; i++) {
                double dx = u - disc[i][0], dy = v * 1.4 - disc[i][1] * 1.0 + 0.02, r = sqrt(dx * dx + dy * dy);
                mix3(c, colour[i], 0.9 * smooth(disc[i][2] + 0.005, disc[i][2] - 0.005, r), c);
            }
            if (fabs(v - 0.56 + 0.18 * u) < 0.008) mix3(c, colour[4], 0.9, c);
            double grain = 0.93 + 0.07 * fractal(u * 50, v * 50, 512, 3);
            for (int k = 0; k < 3; k++) c[k] *= grain;
            picture_set(&p, x, y, c);
        }
    }
    picture_write(&p, DIR "painting.tga");
}

static void rug(void)
{
    static const double ground[3] = {0.80, 0.76, 0.68}, blue[3] = {0.20, 0.30, 0.42}, red[3] = {0.62, 0.27, 0.20};
    struct picture p;
    const int w = 168, h = 120;
    picture_begin(&p, w, h);
    for (int y = 0; y < h; y++) {
        for (int x = 0; x < w; x++) {
            double d = fmin(fmin(x, w - 1 - x), fmin(y, h - 1 - y)), c[3];
            double a = fabs(fmod(x, 24) - 12) + fabs(fmod(y, 24) - 12);
            mix3(ground, blue, a > 9.5 && a < 12 && d > 12 ? 1 : 0, c);
            mix3(c, red, a < 4 && d > 12 ? 1 : 0, c);
            mix3(c, blue, d > 3 && d < 9 ? 1 : 0, c);
            double grain = 0.84 + 0.16 * scatter((unsigned)(y * w + x), 2);
            for (int k = 0; k < 3; k++) c[k] *= grain;
            picture_set(&p, x, y, c);
        }
    }
    picture_write(&p, DIR "rug.tga");
}

/* ---- the sky: latitude and longitude, the zenith at the top ---- */

static void sky_colour(const double d[3], double out[3])
{
    static const double sun[3] = {-0.767, 0.500, -0.402};
    static const double zenith[3] = {0.55, 0.95, 1.75}, horizon[3] = {2.1, 2.2, 2.2}, ground[3] = {0.30, 0.31, 0.22};
    static const double warm[3] = {1.0, 0.86, 0.62}, cloud[3] = {2.6, 2.6, 2.55};
    double c = d[0] * sun[0] + d[1] * sun[1] + d[2] * sun[2], angle = acos(c > 1 ? 1 : c < -1 ? -1 : c) * 360 / TAU;
    mix3(horizon, zenith, pow(d[1] > 0 ? d[1] : 0, 0.55), out);
    if (d[1] > 0.02) {
        double k = 1 / (0.25 + d[1]);
        mix3(out, cloud, 0.7 * smooth(0.5, 0.68, fractal(2 * d[0] * k + 9, 2 * d[2] * k + 9, 64, 12)), out);
    }
    double glow = 420 * exp(-angle * angle / (2 * 3.2 * 3.2)) + 6 * exp(-angle / 9);
    for (int i = 0; i < 3; i++) out[i] += glow * warm[i];
    mix3(out, ground, smooth(0.0, -0.05, d[1]), out);
}

int main(void)
{
    sofa();
    coffee_table();
    vessels();
    lamp();
    sideboard();
    plant();
    windows();
    curtains();
    planks();
    painting();
    rug();
    sky_write(DIR "sky.pfm", 128, 64, sky_colour);
    return 0;
}
