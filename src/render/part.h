/* part.h: films as files: a checkpoint of a render under way, or a part of a picture's samples, to be added to others.
 *
 * A file begins with lines of text, each ended by a line feed:
 *
 *     asbdpt part 9                    the format and its version
 *     samples A B                      samples A .. B-1 of each pixel are to be in the file when it is complete,
 *     done N P                         the first N of them are, and P tile passes of the next block
 *     left-out K                       contributions that were not finite or too large
 *     halves N                         1: also the sums of half the samples (render/noise_estimate.h), 0: not
 *     size W H                         pixels of the film's rectangle
 *     film W H, window X Y             the whole frame, and where in it the rectangle begins
 *     scale X                          by which pixels are multiplied when they are written
 *     spp N                            samples per pixel of the whole picture
 *     version asbdpt 0.1, estimator 1  what was rendered, in some lines, each a word and what it says:
 *     ...                              program, scene, integrator and its parameters, seed, filter
 *     check XXXXXXXX                   CRC-32 of all lines before, hexadecimal
 *
 * The lines from `size` on must agree between parts of one picture. A file's lines must be those that the program
 * would write for what they say, to the byte. The file goes on with the sums (scene/film.h), pixel by pixel, row by row
 * from the top, red, green and blue: 255 for an empty sum, else a byte `top` and three digits (exact_sum.h), the
 * highest first. Those of half the samples follow, and if P is not 0, of the next block: what light sub-paths have sent
 * to the lens, and the samples of each pixel. A digit d is written as the whole number 2d, or -2d - 1 if it is
 * negative, seven bits to the byte from the lowest on, 128 being added to all bytes but the last. The CRC-32 of these
 * bytes follows, four bytes, the lowest first. Nothing depends on the machine's byte order.
 *
 * The same film gives the same bytes, and sums are exact, so parts added up in any order give the bytes of the whole.
 * Parts are read as a stream: adding them needs the memory of one film. Files appear whole or not at all.
 *
 * Tests: test_part.c, test/run/checkpoint.sh.
 */
#ifndef ASBDPT_PART_H
#define ASBDPT_PART_H

#include <stdio.h>

#include "base/file.h"
#include "image/image.h"
#include "render/job.h"

/* What a file says of itself. */
struct part {
    char *identity; /* the lines from "version" on; owned */
    int width, height;
    struct placement place; /* of these in the film */
    double scale;
    long planned;          /* samples per pixel of the whole picture */
    long first, end, done; /* samples first .. first + done - 1 of first .. end - 1 */
    int64_t passes;
    long left_out;
    bool halves; /* the sums of one half are there, too */
};

/* part_describe: the part that this job, settled, is to fill, nothing being done yet. Threads, names of files
 * and what is written do not belong to it; what the scene's files hold does. To be released with part_free. */
struct part part_describe(const struct render_job *job);
void part_free(struct part *p);

/* part_possible: do the film's samples go with those of other parts? False with a message if learning was cut short. */
bool part_possible(const struct film *film, const char *path, struct error *err);

/* part_write: the film into a file that was begun; file_commit or file_abandon is to follow. */
void part_write(struct file_output *file, const struct part *p, const struct film *film);

/* part_open: read what a file says of itself.
 *   out  to be released with part_free after success
 * Returns the file, open behind the text, or NULL with a message. */
FILE *part_open(const char *path, struct part *out, struct error *err);

/* part_add: add the sums of an open part to a film of its size, count its samples, and close the file. False with a
 * message if it is damaged; the film is of no use then. */
bool part_add(FILE *file, const char *path, const struct part *p, struct film *film, struct error *err);

/* part_same: were both made of the same picture? If not, a message names the line that differs. */
bool part_same(const struct part *p, const char *path, const struct part *wanted, struct error *err);

#endif
