/* random_structure.h: a scene from a number, for tests that ask how efficient methods are: twelve kinds of structure,
 * of which every twelve numbers in a row from a multiple of twelve have each once, in random order.
 *
 * All else is drawn, independently of the kind's order: sizes, albedos, roughness, how many lamps there are, how large
 * and of what power, camera, longest path, and the film from 96x72 to 320x240. Nothing is read from other files.
 *
 * Tests: test_random.c. `build/test --structure N` prints scene N.
 */
#ifndef ASBDPT_TEST_RANDOM_STRUCTURE_H
#define ASBDPT_TEST_RANDOM_STRUCTURE_H

#include <stdint.h>

enum { N_STRUCTURES = 12 };

/* random_structure: scene number `number`, to be given to free(); *kind: the name of its structure. */
char *random_structure(uint64_t number, const char **kind);

#endif
