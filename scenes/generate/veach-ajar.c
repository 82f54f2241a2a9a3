/* veach-ajar.c: meshes and pictures of scenes/veach-ajar.pbrt, written to scenes/veach-ajar/. Metres, y up, the
 * camera looks along +z. The room is x -2.3 .. 2.3, y 0 .. 2.6, z -4.8 .. 0; its back wall, 0.12 thick, has the
 * door. */
#include <math.h>

#include "model.h"

#define DIR "veach-ajar/"

static void box(struct model *m, double x0, double y0, double z0, double x1, double y1, double z1, double radius)
{
    double lo[3] = {x0, y0, z0}, hi[3] = {x1, y1, z1};
    model_box(m, lo, hi, radius, radius > 0.01 ? 2 : 1);
}

/* ---- the table: a board with round edges on four turned legs ---- */

static void table(void)
{
    static const double leg[][2] = {{0.019, 0},     {0.024, 0.01},  {0.026, 0.05}, {0.02, 0.09},  {0.02, 0.09},
                                    {0.03, 0.105},  {0.02, 0.12},   {0.02, 0.12},  {0.027, 0.3},  {0.034, 0.45},
                                    {0.024, 0.54},  {0.024, 0.54},  {0.037, 0.56}, {0.024, 0.58}, {0.024, 0.58},
                                    {0.036, 0.61},  {0.036, 0.61},  {0.036, 0.69}};
    struct model m;
    model_begin(&m);
    box(&m, -1.0, 0.70, -0.45, 1.0, 0.745, 0.45, 0.016);
    model_write(&m, DIR "table-top.ply");
    model_lathe(&m, leg, 18, 2, 16);
    model_write(&m, DIR "table-leg.ply");
    box(&m, -0.86, 0.61, -0.352, 0.86, 0.70, -0.328, 0);
    box(&m, -0.86, 0.61, 0.328, 0.86, 0.70, 0.352, 0);
    box(&m, -0.892, 0.61, -0.32, -0.868, 0.70, 0.32, 0);
    box(&m, 0.868, 0.61, -0.32, 0.892, 0.70, 0.32, 0);
    model_write(&m, DIR "table-frame.ply");
}

/* ---- three pots ---- */

static void tea_pot(void)
{
    static const double body[][2] = {{0, 0},        {0.085, 0},     {0.085, 0},     {0.093, 0.006}, {0.088, 0.014},
                                     {0.088, 0.014}, {0.14, 0.05},  {0.168, 0.105}, {0.158, 0.165}, {0.115, 0.208},
                                     {0.098, 0.214}, {0.098, 0.214}, {0.098, 0.222}, {0.092, 0.225}};
    static const double lid[][2] = {{0.098, 0.223}, {0.096, 0.230}, {0.075, 0.245}, {0.035, 0.258}, {0.014, 0.264},
                                    {0.010, 0.272}, {0.020, 0.284}, {0.022, 0.296}, {0.012, 0.306}, {0, 0.308}};
    static const double spout[][4] = {{0.12, 0.075, 0, 0.040}, {0.19, 0.095, 0, 0.030}, {0.225, 0.15, 0, 0.020},
                                      {0.25, 0.205, 0, 0.015}, {0.285, 0.225, 0, 0.013}};
    static const double handle[][4] = {{-0.14, 0.175, 0, 0.012}, {-0.21, 0.195, 0, 0.012}, {-0.255, 0.155, 0, 0.012},
                                       {-0.24, 0.095, 0, 0.012}, {-0.155, 0.06, 0, 0.011}};
    struct model m;
    model_begin(&m);
    model_lathe(&m, body, 14, 2, 32);
    model_lathe(&m, lid, 10, 2, 24);
    model_tube(&m, spout, 5, 3, 12);
    model_tube(&m, handle, 5, 3, 8);
    model_write(&m, DIR "tea-pot.ply");
}

static void coffee_pot(void)
{
    static const double body[][2] = {{0, 0},         {0.10, 0},      {0.10, 0},     {0.108, 0.008}, {0.098, 0.02},
                                     {0.098, 0.02},  {0.118, 0.07},  {0.122, 0.12}, {0.098, 0.21},  {0.072, 0.30},
                                     {0.070, 0.345}, {0.070, 0.345}, {0.078, 0.352}, {0.070, 0.36}};
    static const double lid[][2] = {{0.072, 0.358}, {0.066, 0.372}, {0.040, 0.395}, {0.014, 0.408}, {0.009, 0.416},
                                    {0.018, 0.428}, {0.017, 0.442}, {0, 0.452}};
    static const double spout[][4] = {{0.09, 0.12, 0, 0.034}, {0.15, 0.135, 0, 0.026}, {0.185, 0.20, 0, 0.018},
                                      {0.20, 0.28, 0, 0.013}, {0.235, 0.325, 0, 0.011}};
    static const double handle[][4] = {{-0.075, 0.31, 0, 0.010}, {-0.15, 0.335, 0, 0.011}, {-0.20, 0.28, 0, 0.012},
                                       {-0.195, 0.18, 0, 0.011}, {-0.11, 0.10, 0, 0.010}};
    struct model m;
    model_begin(&m);
    model_lathe(&m, body, 14, 2, 32);
    model_lathe(&m, lid, 8, 2, 24);
    model_tube(&m, spout, 5, 3, 12);
    model_tube(&m, handle, 5, 3, 8);
    model_write(&m, DIR "coffee-pot.ply");
}

/* A carafe: one closed skin of glass, outside up and inside down, and a ground-in stopper. */
static void carafe(void)
{
    static const double skin[][2] = {{0, 0},          {0.100, 0},     {0.118, 0.004}, {0.142, 0.03}, {0.150, 0.075},
                                     {0.128, 0.135},  {0.075, 0.19},  {0.048, 0.24},  {0.046, 0.29}, {0.062, 0.335},
                                     {0.066, 0.340},  {0.061, 0.342}, {0.055, 0.333}, {0.040, 0.29}, {0.042, 0.24},
                                     {0.069, 0.187},  {0.121, 0.133}, {0.143, 0.076}, {0.135, 0.034}, {0.112, 0.012},
                                     {0, 0.010}};
    static const double stopper[][2] = {{0, 0.285}, {0.036, 0.287}, {0.038, 0.29}, {0.046, 0.338}, {0.030, 0.352},
                                        {0.034, 0.372}, {0.044, 0.398}, {0.034, 0.424}, {0, 0.434}};
    struct model m;
    model_begin(&m);
    model_lathe(&m, skin, 21, 2, 36);
    model_write(&m, DIR "carafe.ply");
    model_lathe(&m, stopper, 9, 2, 24);
    model_write(&m, DIR "stopper.ply");
}

/* ---- door, its frame, handle; the picture's frame; skirting ---- */

/* One leaf 0.85 x 2.05, hinge edge at x = 0, with raised stiles and rails on both sides of a thin panel. */
static void door(void)
{
    struct model m;
    model_begin(&m);
    box(&m, 0.004, 0.008, 0.012, 0.846, 2.046, 0.028, 0);
    for (int side = 0; side < 2; side++) {
        double a = side ? 0.024 : 0, b = a + 0.016;
        box(&m, 0.002, 0.006, a, 0.13, 2.048, b, 0.005);
        box(&m, 0.72, 0.006, a, 0.848, 2.048, b, 0.005);
        box(&m, 0.125, 0.006, a, 0.725, 0.22, b, 0.005);
        box(&m, 0.125, 0.90, a, 0.725, 1.03, b, 0.005);
        box(&m, 0.125, 1.90, a, 0.725, 2.048, b, 0.005);
        double p = side ? 0.024 : 0.004;
        box(&m, 0.19, 0.28, p, 0.66, 0.84, p + 0.012, 0.005);
        box(&m, 0.19, 1.09, p, 0.66, 1.84, p + 0.012, 0.005);
    }
    model_write(&m, DIR "door.ply");
}

static void door_handle(void)
{
    static const double rosette[][2] = {{0.026, 0}, {0.026, 0.004}, {0.022, 0.008}, {0, 0.008}};
    static const double lever[][4] = {
        {0, 0, 0, 0.009},          {0, 0, -0.04, 0.009},          {-0.012, 0, -0.054, 0.009},
        {-0.04, 0, -0.057, 0.010}, {-0.08, 0.003, -0.055, 0.009}, {-0.125, 0, -0.052, 0.007}};
    struct model m;
    model_begin(&m);
    model_tube(&m, lever, 6, 3, 12);
    model_rotate(&m, 0, -90);
    model_lathe(&m, rosette, 4, 2, 20);
    model_write(&m, DIR "door-handle.ply");
}

static void trim(void)
{
    struct model m;
    model_begin(&m);
    box(&m, 0.66, 0, -0.018, 0.75, 2.05, 0.0, 0.005); /* casing of the door on the room's side */
    box(&m, 1.60, 0, -0.018, 1.69, 2.05, 0.0, 0.005);
    box(&m, 0.64, 2.05, -0.024, 1.71, 2.15, 0.0, 0.006);
    box(&m, -2.3, 0, -0.014, 0.66, 0.11, 0.0, 0.005); /* skirting */
    box(&m, 1.69, 0, -0.014, 2.3, 0.11, 0.0, 0.005);
    box(&m, -2.3, 0, -4.8, -2.286, 0.11, 0.0, 0.005);
    box(&m, 2.286, 0, -4.8, 2.3, 0.11, 0.0, 0.005);
    model_write(&m, DIR "trim.ply");

    box(&m, -0.56, -0.42, -0.03, 0.56, -0.36, 0, 0.008); /* frame of the picture, around 1.0 x 0.72 */
    box(&m, -0.56, 0.36, -0.03, 0.56, 0.42, 0, 0.008);
    box(&m, -0.56, -0.36, -0.03, -0.50, 0.36, 0, 0.008);
    box(&m, 0.50, -0.36, -0.03, 0.56, 0.36, 0, 0.008);
    model_write(&m, DIR "picture-frame.ply");
}

/* A stool: a cushion on a turned pillar and a round foot. */
static void stool(void)
{
    static const double foot[][2] = {{0.20, 0},      {0.20, 0.012},  {0.19, 0.022}, {0.06, 0.035}, {0.028, 0.06},
                                     {0.024, 0.20},  {0.034, 0.24},  {0.024, 0.28}, {0.026, 0.38}, {0.07, 0.41},
                                     {0.07, 0.41},   {0.17, 0.415}};
    static const double h[3] = {0.21, 0.05, 0.21};
    struct model m;
    model_begin(&m);
    model_lathe(&m, foot, 12, 2, 28);
    model_write(&m, DIR "stool-foot.ply");
    model_translate(&m, 0, 0.455, 0);
    model_pillow(&m, h, 0.45, 14, 32);
    model_write(&m, DIR "stool-cushion.ply");
}

/* ---- pictures ---- */

/* Evening on a lake: sky, two ranges of hills, and their reflection broken by ripples. */
static void landscape(void)
{
    static const double high[3] = {0.30, 0.45, 0.66}, low[3] = {0.98, 0.78, 0.50}, far[3] = {0.42, 0.42, 0.58},
                        near[3] = {0.16, 0.24, 0.22}, sun[3] = {1, 0.93, 0.72};
    struct picture p;
    const int w = 160, h = 115;
    picture_begin(&p, w, h);
    for (int y = 0; y < h; y++) {
        for (int x = 0; x < w; x++) {
            double u = (x + 0.5) / w, v = 1 - (y + 0.5) / h, horizon = 0.36, c[3];
            double depth = horizon - v, above = depth > 0 ? depth * 1.25 : -depth;
            if (depth > 0) u += 0.03 * (noise(u * 6, 90 * sqrt(depth), 997, 9) - 0.5) * (0.3 + 4 * depth);
            double ridge1 = 0.10 + 0.20 * fractal(u * 4 + 1.3, 0.5, 64, 3),
                   ridge2 = 0.01 + 0.22 * fractal(u * 3, 7.5, 64, 5) * u;
            mix3(low, high, smooth(0, 0.55, above), c);
            double dx = u - 0.33, dy = above - 0.27;
            mix3(c, sun, exp(-(dx * dx + dy * dy) * 160) * 0.9 + (dx * dx + dy * dy < 0.0018 ? 0.6 : 0), c);
            double cloud = smooth(0.52, 0.75, fractal(u * 5, above * 18, 64, 21));
            mix3(c, sun, 0.45 * cloud, c);
            mix3(c, far, smooth(-0.006, 0.006, ridge1 - above), c);
            mix3(c, near, smooth(-0.006, 0.006, ridge2 - above), c);
            if (depth > 0) {
                for (int i = 0; i < 3; i++) c[i] *= 0.82 - 0.35 * depth;
            }
            for (int i = 0; i < 3; i++) c[i] *= 0.94 + 0.1 * noise(x * 0.9, y * 0.9, 512, 31 + (unsigned)i);
            picture_set(&p, x, y, c);
        }
    }
    picture_write(&p, DIR "landscape.tga");
}

/* Straight grain along x; repeats. */
static void wood(void)
{
    static const double dark[3] = {0.47, 0.29, 0.17}, light[3] = {0.76, 0.55, 0.36};
    struct picture p;
    const int n = 128;
    picture_begin(&p, n, n);
    for (int y = 0; y < n; y++) {
        for (int x = 0; x < n; x++) {
            double u = (double)x / n, v = (double)y / n, c[3];
            double ring = 10 * v + 1.6 * fractal(2 * u, 4 * v, 4, 1);
            double line = 0.5 + 0.5 * sin(TAU * ring), fibre = noise(12 * u, 128 * v, 128, 8);
            mix3(light, dark, 0.45 * line * line + 0.35 * fibre, c);
            picture_set(&p, x, y, c);
        }
    }
    picture_write(&p, DIR "wood.tga");
}

int main(void)
{
    table();
    tea_pot();
    coffee_pot();
    carafe();
    door();
    door_handle();
    trim();
    stool();
    landscape();
    wood();
    return 0;
}
