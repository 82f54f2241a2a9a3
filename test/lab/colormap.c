/* colormap.c: colours for numbers; see sheet.h. */
#include "lab/sheet.h"

#include "image/image.h"

/* At equal distances, sRGB bytes; between two of them the map is linear in these. */
enum { VIRIDIS_STOPS = 10 };
static const uint8_t VIRIDIS[VIRIDIS_STOPS][3] = {{68, 1, 84},    {72, 40, 120},  {62, 73, 137},  {49, 104, 142},
                                           {38, 130, 142}, {31, 158, 137}, {53, 183, 121}, {110, 206, 88},
                                           {181, 222, 43}, {253, 231, 37}};

void viridis(double t, float out[3])
{
    double at = t > 0 ? (t < 1 ? t : 1) * (VIRIDIS_STOPS - 1) : 0; /* NaN too */
    int i = at < VIRIDIS_STOPS - 2 ? (int)at : VIRIDIS_STOPS - 2;
    for (int c = 0; c < 3; c++)
        out[c] = (float)srgb_decode((VIRIDIS[i][c] + (at - i) * (VIRIDIS[i + 1][c] - VIRIDIS[i][c])) / 255);
}
