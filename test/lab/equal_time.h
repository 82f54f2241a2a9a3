/* equal_time.h: methods that were given the same CPU time: what came of it, its statistics and its files.
 *
 * The first renders N samples per pixel, which takes T seconds; each of the others is given the samples that take it T,
 * what it learns beforehand included. Samples are whole and clocks restless, so the time t that was really taken
 * differs a little. The squared error is brought from t to T by the law of its surroundings,
 *     error^2 ~ 1 / samples   and   samples ~ time^growth,   hence   error^2(T) = error^2(t) (t / T)^growth,
 * where growth is measured between two renders: 1 where every sample costs the same, more where something has to be
 * paid before the first.
 *
 * Files: equal-time.csv has one line per scene, method and seed; equal-time.md the table; runs/ holds finished renders.
 *
 * Tests: test_equal_time.c.
 */
#ifndef ASBDPT_EQUAL_TIME_H
#define ASBDPT_EQUAL_TIME_H

#include "lab/results.h"

/* One render in about the time that was given. */
struct equal_render {
    long seed, spp;
    double seconds;       /* t: of CPU, preparation included, scene loading not */
    double target;        /* T */
    double growth;        /* d ln samples / d ln time nearby */
    double rmse8, relmse; /* measured after `seconds` */
    double blocks, shown_blocks; /* see compare_blocks, compare_shown_blocks; the second is not kept in files */
    long nonfinite;       /* values that could not be compared */
};

struct equal_scene {
    const char *path;
    char name[256];
    int width, height, max_depth;
    double noise8; /* of the reference; NaN when unknown */
    struct equal_render render[METHODS_MAX][PLAN_MAX_SEEDS];
};

struct equal_time {
    const struct plan *plan;   /* borrowed; the last of its steps is the first method's samples */
    double seconds;            /* T; 0: what the first takes for its samples */
    struct equal_scene *scene; /* [n_scenes], owned */
    int n_scenes;              /* done so far */
    bool pictures;             /* keep those of the first seeds and of the references, as equal_picture says */
};

/* The first guess at the samples is made by the time that so few take; a time so near to the given one is met. One
 * farther off than EQUAL_FARTHEST per cent is not accounted for: the law holds nearby. */
enum { EQUAL_CALIBRATION = 4, EQUAL_PERCENT = 3, EQUAL_FARTHEST = 25 };

/* equal_met: is the time as good as the one given? equal_comparable: is it near enough to be accounted for? */
bool equal_met(double seconds, double target);
bool equal_comparable(double seconds, double target);

/* equal_seed: of repetition i = 1, 2, ... of a method: those of no other experiment, and of no other method. */
long equal_seed(int method, int i);

/* equal_growth: d ln samples / d ln time at the second of two renders, by the line through both, kept between 1 and 4;
 * 1 where it cannot be told. */
double equal_growth(long spp0, double seconds0, long spp1, double seconds1);

/* equal_samples: how many samples per pixel take `target`, at least 1, if spp of them take `seconds`, by the line that
 * has this growth there: farther away the law of powers would overshoot. */
long equal_samples(long spp, double seconds, double growth, double target);

enum equal_error { EQUAL_RMSE8, EQUAL_RELMSE, EQUAL_BLOCKS, N_EQUAL_ERRORS };
extern const char *const EQUAL_NAMES[N_EQUAL_ERRORS];

/* equal_square: the squared error of a render at T: rmse8^2 - noise8^2, the reference's own error being no fault of
 * the render; the others as they are. NaN if the time is not comparable. */
double equal_square(const struct equal_render *r, double noise8, enum equal_error which);

/* equal_ratio: mean over seeds of a method's squared error over that of the first, with the interval of results_ratio.
 * */
struct interval equal_ratio(const struct equal_time *e, const struct equal_scene *s, int method,
                            enum equal_error which);

/* equal_summarize: a method in all scenes together; those without a ratio are left out. */
struct equal_summary {
    double mean, best, worst;             /* geometric mean; smallest and largest ratio */
    const char *best_scene, *worst_scene; /* "-" if there is none */
    int n;                                /* scenes with a ratio */
};
struct equal_summary equal_summarize(const struct equal_time *e, int method, enum equal_error which);

/* equal_keep: keep a render in a file, with a key that says all that its numbers depend on. equal_recall: read it back;
 * false, without a message, when there is no such file, its key differs or it is damaged. */
enum { EQUAL_KEY = 1024 }; /* a key has fewer characters */
bool equal_keep(const char *path, const char *key, const struct equal_render *r, struct error *err);
bool equal_recall(const char *path, const char *key, struct equal_render *r);

void equal_csv(FILE *f, const struct equal_time *e);
void equal_table(FILE *f, const struct equal_time *e); /* Markdown: the table and its notes */
void equal_notes(FILE *f, const struct equal_time *e); /* how the numbers came to be */

/* equal_picture: images/..., below the plan's directory; of the reference if the method is below 0. */
void equal_picture(const struct equal_time *e, const struct equal_scene *s, int method, char *out, size_t size);

/* equal_write_file: what `write` writes, as a file of plan->directory. equal_write: both files. Both return false with
 * a message. */
bool equal_write_file(const struct equal_time *e, const char *name, void (*write)(FILE *, const struct equal_time *),
                      struct error *err);
bool equal_write(const struct equal_time *e, struct error *err);

void equal_free(struct equal_time *e);

#endif
