/* spd.h: the numbers of an .spd file, which holds pairs of wavelength and value.
 *
 * As in pbrt-v3 [pbrt-v3 core/floatfile.cpp] a number ends at any character that it cannot have, # begins a comment,
 * and other text is passed over, with a warning for the first of each line. Tests: test_parser.c. */
#ifndef ASBDPT_SPD_H
#define ASBDPT_SPD_H

#include <stddef.h>

#include "parser/messages.h"

/* spd_numbers: *n of them, to be given to free(); *at: where the last one is. */
double *spd_numbers(struct messages *m, struct source_file *file, struct source_position *at, size_t *n);

#endif
