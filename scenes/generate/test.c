/* test.c: the pictures of the scenes in scenes/test. */
#include <math.h>

#include "model.h"

#define DIR "test/"

static void waves(void)
{
    struct picture p;
    const int n = 32;
    picture_begin(&p, n, n);
    for (int y = 0; y < n; y++) {
        for (int x = 0; x < n; x++) {
            double v = 0.5 + 0.25 * sin(TAU * x / n) + 0.25 * sin(TAU * y / n), c[3] = {v, v, v};
            picture_set(&p, x, y, c);
        }
    }
    picture_write(&p, DIR "waves.tga");
}

/* Holes (0) in a full field (1): rounds, and half a border. */
static void mask(void)
{
    struct picture p;
    const int n = 64;
    picture_begin(&p, n, n);
    for (int y = 0; y < n; y++) {
        for (int x = 0; x < n; x++) {
            double dx = x % 16 - 7.5, dy = y % 16 - 7.5, v = dx * dx + dy * dy < 30 ? 0 : 1, c[3] = {v, v, v};
            picture_set(&p, x, y, c);
        }
    }
    picture_write(&p, DIR "mask.tga");
}

/* Four by four fields of different colours, so that every turn and mirroring shows. */
static void colours(void)
{
    struct picture p;
    const int n = 16;
    picture_begin(&p, n, n);
    for (int y = 0; y < n; y++) {
        for (int x = 0; x < n; x++) {
            unsigned i = (unsigned)(y / 4 * 4 + x / 4);
            double c[3] = {0.1 + 0.8 * scatter(i, 1), 0.1 + 0.8 * scatter(i, 2), 0.1 + 0.8 * scatter(i, 3)};
            picture_set(&p, x, y, c);
        }
    }
    picture_write(&p, DIR "colours.tga");
}

int main(void)
{
    waves();
    mask();
    colours();
    return 0;
}
