/* random_class.h: a scene from a number, most of whose light takes paths of one class: a kind of light, a word, a kind
 * of camera. A letter of the word is a bounce, from the light to the lens:
 *
 *     D diffuse    G glossy    S specular reflection    T specular transmission    M scattering in a medium
 *
 * The scene is a corridor of triangular cells, in which light goes to and fro between floor and ceiling. The base of a
 * cell lies on one of them and scatters as the letter says. The other two sides are black screens, each with a hole.
 *
 *        ___1___ ___3___          1, 2, 3: bases. The light is in the first cell, the lens in the last
 *     \    / \    / \    /
 *      \  /   \  /   \  /         No straight line leads through two holes,
 *      _\/__2__\/__4__\/         so hardly a path misses a letter or has one more
 *
 * T is a pane in a hole. M is a cloud before a black base. S is a concave mirror that images one hole in the other.
 *
 * Tests: test_classes.c. `build/test --class N` prints scene N.
 */
#ifndef ASBDPT_TEST_RANDOM_CLASS_H
#define ASBDPT_TEST_RANDOM_CLASS_H

#include <stdbool.h>
#include <stdint.h>

enum { CLASS_LETTERS = 12, CLASS_LEAST_LETTERS = 2 };

struct random_class {
    char word[CLASS_LETTERS + 1];
    const char *light, *camera; /* kinds */
    bool delta_light, far_light; /* no ray meets it; light sub-paths hardly ever find the way in */
    int max_depth;
    char *text; /* owned */
};

/* random_class: class `number`, drawn for the n-th time, n from 0, which changes the word, but not the kinds; of many
 * drawings later ones are shorter. Some method can make paths of the word: it has two
 * neighbours, lens and light among them, that no single direction joins to the next, or a light that rays can meet.
 * To be given to free(): text. */
struct random_class random_class(uint64_t number, int n);

#endif
