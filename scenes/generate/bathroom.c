/* bathroom.c: meshes and pictures of scenes/bathroom.pbrt, written to scenes/bathroom/. Metres, y up, the camera
 * looks along +z. The room is x -1.5 .. 1.5, y 0 .. 2.5, z -3.2 .. 0, its window in the left wall. */
#include <math.h>

#include "model.h"

#define DIR "bathroom/"

static void box(struct model *m, double x0, double y0, double z0, double x1, double y1, double z1, double radius)
{
    double lo[3] = {x0, y0, z0}, hi[3] = {x1, y1, z1};
    model_box(m, lo, hi, radius, radius > 0.01 ? 2 : 1);
}

/* ---- the blinds: bowed slats from z = -1.98 to -0.72, hung at x = -1.58 ---- */

/* u across the slat, outside to inside; v along it. */
static void slat(const void *context, double u, double v, double p[3])
{
    const double width = 0.066, bow = 0.006;
    (void)context;
    p[0] = (u - 0.5) * width;
    p[1] = bow * (1 - 4 * (u - 0.5) * (u - 0.5));
    p[2] = -1.98 + 1.26 * v;
}

static void blinds(void)
{
    struct model m;
    model_begin(&m);
    for (int i = 0; i < 22; i++) {
        model_home(&m);
        model_translate(&m, -1.58, 1.085 + 0.048 * i, 0);
        model_rotate(&m, 2, -18 + 1.6 * (scatter((unsigned)i, 4) - 0.5)); /* inner edge down; none quite alike */
        model_patch(&m, slat, NULL, 5, 1);
    }
    model_home(&m);
    box(&m, -1.615, 2.105, -1.985, -1.545, 2.148, -0.715, 0.006);
    box(&m, -1.605, 1.052, -1.98, -1.555, 1.064, -0.72, 0.004);
    model_write(&m, DIR "blinds.ply");

    static const double cord[][4] = {{-1.58, 1.06, 0, 0.0016}, {-1.58, 2.11, 0, 0.0016}};
    for (int i = 0; i < 3; i++) {
        model_home(&m);
        model_translate(&m, 0, 0, -1.80 + 0.45 * i);
        model_tube(&m, cord, 2, 1, 5);
    }
    model_home(&m);
    box(&m, -1.70, 1.03, -2.02, -1.465, 1.05, -0.68, 0.004); /* sill and frame of the window */
    box(&m, -1.515, 1.05, -2.06, -1.485, 2.15, -2.00, 0.005);
    box(&m, -1.515, 1.05, -0.70, -1.485, 2.15, -0.64, 0.005);
    box(&m, -1.515, 2.15, -2.06, -1.485, 2.21, -0.64, 0.005);
    model_write(&m, DIR "window.ply");
}

/* ---- the tub: a rounded plan, its wall drawn in by `inset` at each height ---- */

static void tub_shell(const void *context, double u, double v, double p[3])
{
    static const double wall[][2] = {{0.080, 0.0},  {0.060, 0.10},  {0.035, 0.40},  {0.022, 0.515}, {0.001, 0.535},
                                     {0.000, 0.555}, {0.030, 0.570}, {0.062, 0.560}, {0.072, 0.53}, {0.085, 0.40},
                                     {0.110, 0.20},  {0.160, 0.13},  {0.250, 0.115}, {0.365, 0.115}};
    const double *half = context;
    double s = u * 13;
    int i = s >= 13 ? 12 : (int)s;
    double t = s - i, inset = mixed(wall[i][0], wall[i + 1][0], t), y = mixed(wall[i][1], wall[i + 1][1], t);
    double c = cos(TAU * v), n = sin(TAU * v);
    p[0] = (half[0] - inset) * (c < 0 ? -pow(-c, 0.55) : pow(c, 0.55));
    p[1] = y;
    p[2] = (half[1] - inset) * (n < 0 ? -pow(-n, 0.4) : pow(n, 0.4));
}

/* Averages the shell over a little of its height: round where the list of points has corners. */
static void tub_smooth(const void *context, double u, double v, double p[3])
{
    double q[3];
    p[0] = p[1] = p[2] = 0;
    for (int i = -2; i <= 2; i++) {
        double w = u + i * 0.017;
        tub_shell(context, w < 0 ? 0 : w > 1 ? 1 : w, v, q);
        for (int k = 0; k < 3; k++) p[k] += q[k] / 5;
    }
}

static void tub(void)
{
    static const double half[2] = {0.37, 0.86};
    static const double spout[][4] = {{0, 0.62, 0.05, 0.016}, {0, 0.75, 0.05, 0.016}, {0, 0.80, 0.02, 0.016},
                                      {0, 0.80, -0.06, 0.016}, {0, 0.77, -0.10, 0.015}};
    static const double knob[][2] = {{0.022, 0}, {0.022, 0.01}, {0.012, 0.02}, {0.012, 0.05}, {0.026, 0.055},
                                     {0.028, 0.075}, {0.02, 0.085}, {0, 0.087}};
    struct model m;
    model_begin(&m);
    model_patch(&m, tub_smooth, half, 28, 48);
    model_write(&m, DIR "tub.ply");
    model_tube(&m, spout, 5, 3, 12);
    for (int i = -1; i <= 1; i += 2) {
        model_home(&m);
        model_translate(&m, i * 0.10, 0.565, 0.05);
        model_lathe(&m, knob, 8, 2, 16);
    }
    model_home(&m);
    box(&m, -0.14, 0.56, 0.02, 0.14, 0.58, 0.08, 0.008);
    box(&m, -0.018, 0.575, 0.032, 0.018, 0.63, 0.068, 0.006);
    model_write(&m, DIR "tub-tap.ply");
}

/* ---- wash stand, mirror, bulbs' holder, rail, towel ---- */

static void wash_stand(void)
{
    static const double basin[][2] = {{0, 0.0},      {0.09, 0.0},    {0.09, 0.0},    {0.13, 0.03},  {0.185, 0.10},
                                      {0.200, 0.135}, {0.199, 0.142}, {0.190, 0.140}, {0.170, 0.10}, {0.12, 0.040},
                                      {0.04, 0.022}, {0, 0.02}};
    static const double tap[][4] = {{0, 0, 0, 0.018}, {0, 0.20, 0, 0.015}, {0, 0.27, -0.03, 0.014},
                                    {0, 0.285, -0.09, 0.014}, {0, 0.255, -0.14, 0.013}};
    static const double lever[][4] = {{0, 0.25, 0.015, 0.008}, {0, 0.29, 0.03, 0.007}, {0, 0.325, 0.05, 0.006}};
    struct model m;
    model_begin(&m);
    box(&m, -0.55, 0.30, -0.46, 0.55, 0.80, 0.0, 0.004);
    for (int i = 0; i < 2; i++) {
        double x = i ? 0.0 : -0.55;
        box(&m, x + 0.012, 0.555, -0.478, x + 0.538, 0.79, -0.458, 0.006);
        box(&m, x + 0.012, 0.31, -0.478, x + 0.538, 0.545, -0.458, 0.006);
    }
    model_write(&m, DIR "cabinet.ply");
    box(&m, -0.58, 0.80, -0.49, 0.58, 0.835, 0.0, 0.008);
    model_write(&m, DIR "counter.ply");
    model_lathe(&m, basin, 12, 2, 40);
    model_write(&m, DIR "basin.ply");
    model_tube(&m, tap, 5, 3, 12);
    model_tube(&m, lever, 3, 2, 8);
    model_write(&m, DIR "tap.ply");
    for (int i = 0; i < 4; i++) {
        double x = i % 2 ? 0.27 : -0.27, y = i / 2 ? 0.675 : 0.43;
        double grip[4][4] = {{x - 0.06, y, -0.478, 0.005}, {x - 0.058, y, -0.503, 0.005},
                             {x + 0.058, y, -0.503, 0.005}, {x + 0.06, y, -0.478, 0.005}};
        model_tube(&m, (const double (*)[4])grip, 4, 2, 6);
    }
    model_write(&m, DIR "grips.ply");
}

static void wall_things(void)
{
    static const double bar[][4] = {{-0.45, 0, 0, 0.012}, {0.45, 0, 0, 0.012}};
    static const double socket[][2] = {{0.014, -0.01}, {0.022, 0}, {0.024, 0.035}, {0.02, 0.045}};
    static const double rail[][4] = {{-0.30, 0, 0, 0.010},     {-0.30, 0, -0.055, 0.010}, {-0.285, 0, -0.07, 0.010},
                                     {0.285, 0, -0.07, 0.010}, {0.30, 0, -0.055, 0.010},  {0.30, 0, 0, 0.010}};
    struct model m;
    model_begin(&m);
    box(&m, -0.50, -0.43, -0.022, 0.50, -0.40, 0, 0.006); /* frame of the mirror, around 0.94 x 0.80 */
    box(&m, -0.50, 0.40, -0.022, 0.50, 0.43, 0, 0.006);
    box(&m, -0.50, -0.40, -0.022, -0.47, 0.40, 0, 0.006);
    box(&m, 0.47, -0.40, -0.022, 0.50, 0.40, 0, 0.006);
    model_write(&m, DIR "mirror-frame.ply");
    model_tube(&m, bar, 2, 1, 12);
    for (int i = -1; i <= 1; i++) {
        model_home(&m);
        model_translate(&m, 0.32 * i, 0, 0);
        model_rotate(&m, 0, 180);
        model_lathe(&m, socket, 4, 2, 16);
    }
    model_home(&m);
    box(&m, -0.05, -0.03, 0.0, 0.05, 0.03, 0.07, 0.006);
    model_write(&m, DIR "lamp-bar.ply");
    model_tube(&m, rail, 6, 3, 10);
    model_write(&m, DIR "rail.ply");
}

/* A towel over the rail: up at the back, over, and down at the front, with soft folds that grow downwards. */
static void towel_cloth(const void *context, double u, double v, double p[3])
{
    const double back = 0.42, front = 0.58, r = 0.018, arc = r * TAU / 2, length = back + arc + front;
    double s = u * length, below, side, y, z;
    (void)context;
    if (s < back) {
        y = s - back;
        z = r;
        below = -y;
        side = 1;
    } else if (s < back + arc) {
        double a = (s - back) / r;
        y = r * sin(a);
        z = r * cos(a);
        below = 0;
        side = 0;
    } else {
        y = back + arc - s;
        z = -r;
        below = -y;
        side = -1;
    }
    double fold = sin(TAU * 2.5 * v + 0.8) + 0.5 * sin(TAU * 4.3 * v + 2 * u);
    p[0] = (v - 0.5) * (0.36 - 0.03 * below);
    p[1] = y - (side < 0 ? 0.012 * below * v : 0);
    p[2] = z + 0.012 * fold * smooth(0, 0.5, below) * (side > 0 ? 0.3 : 1) - (side < 0 ? 0.01 * below : 0);
}

static void towel(void)
{
    struct model m;
    model_begin(&m);
    model_patch(&m, towel_cloth, NULL, 28, 24);
    model_write(&m, DIR "towel.ply");
}

/* ---- the door that the mirror shows ---- */

static void door(void)
{
    struct model m;
    model_begin(&m);
    box(&m, -0.42, 0, 0, 0.42, 2.03, 0.03, 0.004);
    for (int i = 0; i < 4; i++) {
        double y = 0.16 + 0.47 * i;
        box(&m, -0.32, y, 0.02, 0.32, y + 0.40, 0.045, 0.01);
    }
    box(&m, -0.50, 0, 0, -0.43, 2.11, 0.035, 0.005);
    box(&m, 0.43, 0, 0, 0.50, 2.11, 0.035, 0.005);
    box(&m, -0.43, 2.04, 0, 0.43, 2.11, 0.035, 0.005);
    model_write(&m, DIR "door.ply");
}

/* ---- small things ---- */

static void pillow_at(struct model *m, double x, double y, double z, double a, double b, double c, double tilt)
{
    double h[3] = {a, b, c};
    model_home(m);
    model_translate(m, x, y, z);
    model_rotate(m, 2, tilt);
    model_pillow(m, h, 1, 8, 14);
}

static void duck(void)
{
    struct model m;
    model_begin(&m);
    pillow_at(&m, 0, 0.035, 0, 0.055, 0.036, 0.042, 0);
    pillow_at(&m, -0.052, 0.050, 0, 0.024, 0.012, 0.018, -35);
    pillow_at(&m, 0.030, 0.088, 0, 0.029, 0.029, 0.027, 0);
    pillow_at(&m, -0.008, 0.042, -0.038, 0.030, 0.018, 0.010, -10);
    pillow_at(&m, -0.008, 0.042, 0.038, 0.030, 0.018, 0.010, -10);
    model_write(&m, DIR "duck.ply");
    pillow_at(&m, 0.062, 0.082, 0, 0.016, 0.005, 0.014, 5);
    model_write(&m, DIR "duck-beak.ply");
}

static void bottles(void)
{
    static const double tall[][2] = {{0, 0},         {0.030, 0},     {0.034, 0.004}, {0.034, 0.12},
                                     {0.030, 0.14},  {0.012, 0.152}, {0.011, 0.175}, {0.011, 0.175},
                                     {0.014, 0.176}, {0.014, 0.20},  {0, 0.20}};
    static const double cup[][2] = {{0, 0},        {0.030, 0},    {0.033, 0.003}, {0.038, 0.10}, {0.037, 0.102},
                                    {0.0355, 0.10}, {0.031, 0.012}, {0, 0.010}};
    struct model m;
    model_begin(&m);
    model_lathe(&m, tall, 11, 2, 20);
    model_write(&m, DIR "bottle.ply");
    model_lathe(&m, cup, 8, 2, 24);
    model_write(&m, DIR "cup.ply");
}

/* ---- pictures ---- */

/* One wall tile with half a joint on every side, its edges shaded as if rounded. */
static void tile(void)
{
    static const double face[3] = {0.90, 0.92, 0.91}, joint[3] = {0.66, 0.65, 0.62}, edge[3] = {0.80, 0.84, 0.83};
    struct picture p;
    const int n = 48;
    picture_begin(&p, n, n);
    for (int y = 0; y < n; y++) {
        for (int x = 0; x < n; x++) {
            double dx = fmin(x + 0.5, n - x - 0.5) / n, dy = fmin(y + 0.5, n - y - 0.5) / n, d = fmin(dx, dy), c[3];
            mix3(edge, face, smooth(0.018, 0.06, d), c);
            mix3(joint, c, smooth(0.012, 0.022, d), c);
            picture_set(&p, x, y, c);
        }
    }
    picture_write(&p, DIR "tile.tga");
}

/* A rug with a border, rounds of colour and a woven grain. */
static void rug(void)
{
    static const double ground[3] = {0.82, 0.78, 0.70}, line[3] = {0.20, 0.36, 0.42}, spot[3] = {0.76, 0.42, 0.28};
    struct picture p;
    const int w = 128, h = 80;
    picture_begin(&p, w, h);
    for (int y = 0; y < h; y++) {
        for (int x = 0; x < w; x++) {
            double d = fmin(fmin(x, w - 1 - x), fmin(y, h - 1 - y)), c[3];
            double cx = fmod(x - 8, 16) - 8, cy = fmod(y, 16) - 8, r = sqrt(cx * cx + cy * cy);
            mix3(ground, spot, d > 12 ? smooth(6, 5, r) : 0, c);
            mix3(c, line, d > 12 ? smooth(3.2, 2.4, r) : d > 4 && d < 8 ? 1 : 0, c);
            double grain = 0.86 + 0.14 * scatter((unsigned)(y * w + x), 2);
            for (int k = 0; k < 3; k++) c[k] *= grain;
            picture_set(&p, x, y, c);
        }
    }
    picture_write(&p, DIR "rug.tga");
}

int main(void)
{
    blinds();
    tub();
    wash_stand();
    wall_things();
    towel();
    door();
    duck();
    bottles();
    tile();
    rug();
    return 0;
}
