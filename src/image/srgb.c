/* srgb.c: see srgb.h. */
#include "image/srgb.h"

#include <math.h>

double srgb_encode(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

double srgb_decode(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

uint8_t srgb_byte(double linear)
{
    if (!(linear > 0)) /* NaN too */
        return 0;
    return linear >= 1 ? 255 : (uint8_t)(255 * srgb_encode(linear) + 0.5);
}
