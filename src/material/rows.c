/* rows.c: the materials; see material.h. A new one is a row of simple.c, or of a file of its own, and a line here. */
#include "material/material.h"

extern const struct material_row material_matte, material_mirror, material_glass, material_metal, material_plastic,
    material_substrate, material_uber, material_translucent, material_subsurface, material_kdsubsurface,
    material_disney, material_fourier, material_mix;

const struct material_row *const material_rows[] = {
    &material_matte,   &material_mirror, &material_glass,       &material_metal,      &material_plastic,
    &material_substrate, &material_uber, &material_translucent, &material_subsurface, &material_kdsubsurface,
    &material_disney,  &material_fourier, &material_mix,        NULL};
