/* race_table.h: what the race before a render (integrators/race.h) has predicted, and who has won.
 *
 * Tests: test/run/cli.sh.
 */
#ifndef ASBDPT_LAB_RACE_TABLE_H
#define ASBDPT_LAB_RACE_TABLE_H

#include <stdio.h>

#include "integrators/method.h"

struct race_result {
    struct runner runner[RUNNERS];
    int winner;
};
struct race_result race_result(const struct prepared *p);

/* race_print_winner: who, and the others; nothing if there was no race, or if it was cut short.
 * race_print_table: a line for each runner. */
void race_print_winner(FILE *f, const struct race_result *r);
void race_print_table(FILE *f, const struct race_result *r);

#endif
