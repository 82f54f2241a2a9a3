/* bdpt.c: Veach's bidirectional path tracing, and its two halves, path tracing and light tracing.           [V97 10]
 *
 * One iteration of one pixel consists of an eye sub-path, a light sub-path and all their connections. All three methods
 * trace the same sub-paths. They use different strategies, so they differ in their sample counts (mis.h).
 *
 * Tests: test_render.c (they agree with each other and with analytic scenes).
 */
#include "integrators/method.h"

static void render_pixel(const struct tile_pass *pass, const struct frozen *f, int x, int y, long iteration)
{
    struct workspace *work = pass->work;
    arena_reset(&work->arena);
    struct pixel_sample sample = pixel_sample_begin(pass, &f->counts, x, y, iteration);
    /* Light tracing uses the eye sub-path only for lights that the camera sees directly (s = 0, t = 2). */
    int longest = f->numbers.path_tracing ? sample.max_depth + 2 : 2, n_light = 0;
    int n_eye = pixel_eye_path(pass, &sample, work->eye, longest);
    if (f->numbers.path_pixels > 0)
        n_light = pixel_light_path(pass, &f->counts, x, y, (uint64_t)iteration, &work->arena, work->light);

    pixel_sum_eye(&sample, work->eye, n_eye);
    if (f->numbers.draws[FIRST_HIT] > 0)
        pixel_sum_pairs(&sample, work->eye, n_eye, work->light, n_light, NO_CHOICE);
    pixel_splat_path(&sample, work->light, n_light, 1);
    pixel_sample_end(&sample);
}

static void render(const struct preparation *m, const struct tile_pass *pass)
{
    for (long iteration = pass->first; iteration < pass->end; iteration++)
        for (int i = 0, x, y; pass_pixel(pass, i, &x, &y); i++)
            render_pixel(pass, m->state, x, y, iteration);
}

const struct method method_pt = {
    .name = "pt", .help = "path tracing: light found by chance (s = 0) or sampled (s = 1)",
    .numbers = {.light_points = 1, .path_tracing = true}, .state_size = sizeof(struct frozen),
    .rr_threshold = DEFAULT_RR_THRESHOLD, .render = render};

const struct method method_lt = {
    .name = "lt", .help = "light tracing: light sub-paths connected to the lens (t = 1); cannot see mirrors",
    .numbers = {.path_pixels = 1}, .state_size = sizeof(struct frozen), .rr_threshold = DEFAULT_RR_THRESHOLD,
    .render = render};

const struct method method_bdpt = {
    .name = "bdpt", .help = "bidirectional path tracing [Veach 1997]: all strategies",
    .numbers = NUMBERS_OF_BDPT, .state_size = sizeof(struct frozen), .rr_threshold = DEFAULT_RR_THRESHOLD,
    .render = render};
