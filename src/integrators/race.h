/* race.h: should there be a light sub-path for each pixel of this scene, for every four, or none? And are connections
 * at first hits enough? A race before the render decides it.
 *
 * Runners differ in their numbers of samples (struct numbers). The first has the most. It takes SAMPLES samples of some
 * pixels with random numbers that the render does not use, and as many with others. The difference shows its variance.
 * Each pixel is one of a cell of pixels, and splats anywhere in the cell count as its own.
 *
 * What another runner would have made of the same paths follows from their weights [Grittmann 2022]. Let S be the sum
 * in (1) of mis.h, of p_i over all strategies i of a path. Let S_k be that of runner k, and x what the path
 * contributes to the first runner. To runner k it contributes x S / S_k, in S_k / S times as many samples. So its
 * second moment, x^2, becomes x^2 S / S_k. Three kinds of strategies have other counts: connections at a first hit,
 * later connections, and splats. Their shares in S are measured: the race takes the same samples again, each time with
 * half the count of one kind. S_k / S follows, if the bound of draws stays that of the first runner (counts.h). What a
 * draw made changes the variance by less: the change is divided by the credit of a draw.
 *
 * Few contributions of more than FIREFLY times the brightness of their pixel would decide everything. Their squares are
 * replaced by a line, as in the loss of [Huber 1964]. Direct light at a first hit has less variance than its second
 * moment says, since its samples are stratified. Its growth is multiplied by the share that is variance. A path tracer
 * that chooses lights by power has other direct light, so it takes samples of its own. Light that the camera sees
 * directly is left out: it is the same for all runners, and a pixel on a light's edge would hide all other noise.
 *
 * The runner of the least variance times price wins. The price counts vertices and connections, so the same runner wins
 * on every machine.
 *
 * Tests: test_race.c.
 */
#ifndef ASBDPT_RACE_H
#define ASBDPT_RACE_H

#include "integrators/method.h"

/* The runners that there are, as `info --race` calls them, and what each is for users. */
struct runner_kind {
    const char *name, *help;
};
extern const struct runner_kind runner_kinds[MAX_RUNNERS];

/* race: add the runners to *p, which is prepared for the first, with what is predicted of them, and choose the winner.
 * If job->watch ends the race, the first wins. */
void race(const struct render_job *job, struct prepared *p);

/* race_path_tracer_sees_all: are s = 0 and s = 1 enough? They miss light from a delta light that reaches a surface
 * through a delta lobe. */
bool race_path_tracer_sees_all(const struct scene *scene);

#endif
