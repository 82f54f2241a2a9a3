/* chosen.h: what a method has chosen for a scene, as --stats and traces name it.
 *
 * Tests: test_library.c, test/run/cli.sh.
 */
#ifndef ASBDPT_CHOSEN_H
#define ASBDPT_CHOSEN_H

#include "integrators/method.h"

enum { CHOSEN_NUMBERS = 16 };
struct chosen_number {
    char name[32]; /* empty: the one before was the last */
    double value;
};

/* chosen_numbers: those of a method that is prepared; runners with variance times price over the winner's. */
void chosen_numbers(const struct prepared *p, struct chosen_number out[CHOSEN_NUMBERS]);

#endif
