/* conform.h: do the pictures that some renderer made of a scene agree with a reference, and if not, which of the
 * usual mistakes would explain it?
 *
 * The test is that of verify.h. Four things are added for pictures by strangers:
 *
 *     directions     a mistake that changes what is rendered has a reference of its own. How much of the difference
 *                    between the two references is in a picture, by least squares, is one number a picture, 0 or 1 on
 *                    average: Student's test of these sees what no tile shows, as another filter.
 *     few pictures   fewer than four say little of their own variance. Pixels that lie alike in blocks of 4x4 pixels
 *                    become batches instead: 16 of each picture. This takes errors of pixels for independent.
 *     rounding       formats of few digits round all pixels of an even picture alike. Differences of CONFORM_ROUNDING,
 *                    relative, are forgiven: a common factor so close to 1, and tiles that are so close and so exact.
 *     doubt          where the pictures cannot decide the verdict is "cannot tell": the mean is known to 1 % at best,
 *                    one tile of one picture has a third of all squared noise, or only rare samples that have been
 *                    missed keep Welch's test from finding a difference.
 *
 * Tests: test_conform.c.
 */
#ifndef ASBDPT_LAB_CONFORM_H
#define ASBDPT_LAB_CONFORM_H

#include "lab/sides.h"

static const double CONFORM_ROUNDING = 5e-4; /* a half has 11 bits */

/* conform_tiles: the pictures' means over square tiles, as batches or, of fewer than CONFORM_FEW pictures, from blocks.
 * conform_distinct: keep one of every picture that is there twice, as by a program that ignores its seed. Returns how
 * many others there were. */
enum { CONFORM_FEW = 4 };
struct batches conform_tiles(const struct side *pictures, const struct side *reference, int tile);
int conform_distinct(struct side *pictures);

enum finding { FINDS_AGREEMENT, FINDS_DOUBT, FINDS_DIFFERENCE };

struct judgement {
    struct verdict verdict;
    enum finding finding;
    const char *why; /* of doubt and of what was found without a test; else "" */
};

/* A usual mistake: it shows another picture, which the sheet of references has, or changes what it shows. */
struct mistake {
    const char *words;
    int picture; /* from the left, in the sheet; 0: the right one */
    bool flip_x, flip_y, srgb;
    double factor; /* 0: none */
};
extern const struct mistake CONFORM_MISTAKES[]; /* ended by words NULL */

/* What is known of a scene. */
enum { CONFORM_MOST = 20 };
struct conform_references {
    struct side right, wrong[CONFORM_MOST]; /* of every mistake; without pixels where it has none in this scene */
};

/* The references of the kit, one picture: a row of square pictures for each scene. From the left the right one, its
 * standard errors, and one for each mistake that shows another; what is not there is negative. */
enum { CONFORM_ACROSS = 9, CONFORM_WRONG = 3 /* times those errors are the errors of a mistake's picture */ };
struct conform_sheet {
    float *pixels; /* [n * side * CONFORM_ACROSS * side * 3] */
    int side;
};

/* conform_sheet_read: of n scenes; pixels are to be given to free(). Returns false with a message.
 * conform_row: what is known of the scene in a row; to be released by conform_free.
 *   closed  the right one has no errors */
bool conform_sheet_read(const char *path, int n, struct conform_sheet *out, struct error *err);
struct conform_references conform_row(const struct conform_sheet *sheet, int row, bool closed);
void conform_free(struct conform_references *r);

/* conform_judge: at this level of false alarms. */
struct judgement conform_judge(const struct side *pictures, const struct conform_references *r, double level,
                               uint64_t seed);

/* conform_fit_p: p-value of "these are pictures by a renderer that makes the mistake of this number"; -1 where that is
 * not known. */
double conform_fit_p(const struct side *pictures, const struct conform_references *r, int mistake);

#endif
