/* bdpt.c: Veach's bidirectional path tracing, and its two halves, path tracing and light tracing.           [V97 10]
 *
 * A pixel has an eye sub-path, a light sub-path and all their connections. The halves trace the same sub-paths. They
 * use different strategies, so they differ in their numbers of samples (counts.h). Light tracing uses the eye sub-path
 * only for lights that the camera sees directly (s = 0, t = 2). Where a scene has several lights, s = 1 chooses them by
 * the guide unless the user says otherwise; without it they are chosen by power.
 *
 * Tests: test_render.c (they agree with each other and with analytic scenes).
 */
#include "integrators/loop.h"

static const struct field PARAMETERS[] = {PARAMETER_GUIDE(true), {.name = NULL}};

const struct method method_pt = {
    .name = "pt", .help = "path tracing: light found by chance (s = 0) or sampled (s = 1)", .parameters = PARAMETERS,
    .numbers = NUMBERS_OF_PT, .rr_threshold = DEFAULT_RR_THRESHOLD, .render = loop_render};

const struct method method_lt = {
    .name = "lt", .help = "light tracing: light sub-paths connected to the lens (t = 1); cannot see mirrors",
    .numbers = {.path_pixels = 1}, .rr_threshold = DEFAULT_RR_THRESHOLD, .render = loop_render};

const struct method method_bdpt = {
    .name = "bdpt", .help = "bidirectional path tracing [Veach 1997]: all strategies", .parameters = PARAMETERS,
    .numbers = NUMBERS_OF_BDPT, .rr_threshold = DEFAULT_RR_THRESHOLD, .render = loop_render, .draw = loop_own};
