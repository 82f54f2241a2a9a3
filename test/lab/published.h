/* published.h: the root mean square errors that the dissertation printed, to be laid beside ours.             [S24 4]
 *
 * Tests: test_report.c.
 */
#ifndef ASBDPT_PUBLISHED_H
#define ASBDPT_PUBLISHED_H

enum { PUBLISHED_STEPS = 5 };

/* One scene's column: errors on the 8-bit scale, against 16384 samples of pbrt-v3's bdpt, in Bitterli's models. */
struct published {
    const char *scene; /* our name of the same situation */
    double asbdpt[PUBLISHED_STEPS], bdpt[PUBLISHED_STEPS];
};

/* published_spp: samples per pixel of entry i, 0 <= i < PUBLISHED_STEPS: 32, 64 ... 512. */
long published_spp(int i);

/* published_find: by scene name; NULL for a scene the dissertation does not have. */
const struct published *published_find(const char *scene);

#endif
