/* published.c: see published.h. */
#include "lab/published.h"

#include <stddef.h>
#include <string.h>

static const struct published TABLE[] = {
    {"veach-ajar", {28.3020, 19.1206, 13.2645, 9.4453, 6.9799}, {28.7123, 20.1449, 14.2145, 10.1481, 7.2419}},
    {"cornell-box", {2.8022, 2.2055, 1.9630, 1.8629, 1.8169}, {2.7836, 1.9842, 1.4369, 1.0609, 0.8086}},
    {"cornell-box-modified", {3.3398, 2.4268, 1.8763, 1.5464, 1.3567}, {3.3369, 2.3851, 1.7241, 1.2604, 0.9453}},
    {"bathroom", {17.3230, 13.8195, 11.7632, 10.6083, 10.0122}, {17.3743, 13.9254, 11.8313, 10.6455, 10.0004}},
    {"living-room", {8.2173, 5.8870, 4.3207, 3.2946, 2.6155}, {8.2646, 5.9254, 4.2720, 3.0800, 2.2604}},
};

long published_spp(int i) { return 32L << i; }

const struct published *published_find(const char *scene)
{
    for (size_t i = 0; i < sizeof TABLE / sizeof TABLE[0]; i++)
        if (strcmp(TABLE[i].scene, scene) == 0)
            return &TABLE[i];
    return NULL;
}
