/* equal_run.h: render by every method in the same CPU time.
 *
 * Per scene and seed the first method comes first and its time is what the others are given, or all are given as many
 * seconds as were asked for. A method renders 4 samples per pixel, by which its samples are chosen; it renders them,
 * and unless that took the given time within 3 %, it renders again with the samples corrected, at most three times. The
 * render whose time is nearest counts. No choice looks at an error. Times are CPU times of the process.
 * Renders are kept in plan->directory/runs and used again when the same is started once more.
 *
 * Tests: test_equal_time.c, test_pictures.c, test/cli.sh.
 */
#ifndef ASBDPT_EQUAL_RUN_H
#define ASBDPT_EQUAL_RUN_H

#include "lab/equal_time.h"
#include "base/progress.h"
#include "scene/scene.h"

/* A scene being measured; methods have their default parameters beside what they are given. */
struct subject {
    struct scene scene;
    struct reference reference;
    int scale; /* the scene's picture is so many times as wide and high as the reference */
    int max_depth, n_threads;
    struct progress *bar;    /* NULL: none. It goes from `done` on, by `share` while a method renders */
    double done, share;
};

/* subject_render: r->spp samples with r->seed; the rest of *r but target and growth is filled.
 *   pixels  the picture, to be freed; NULL: not wanted
 * subject_render_in_time: as many as take r->target. Both return false with a message. */
bool subject_render(struct subject *s, const struct measured *m, struct equal_render *r, float **pixels,
                    struct error *err);
bool subject_render_in_time(struct subject *s, const struct measured *m, struct equal_render *r, float **pixels,
                            struct error *err);

/* equal_run: carry out out->plan, whose width 0 stands for the size of each scene's stored reference and whose
 * max_depth 0 for that reference's, on one thread. Both files are written after each scene. `out` is to be released
 * with equal_free also on failure. Returns false with a message. */
bool equal_run(struct equal_time *out, struct error *err);

#endif
