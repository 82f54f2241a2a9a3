/* bdpt.c: Veach's bidirectional path tracing, and its two halves, path tracing and light tracing.           [V97 10]
 *
 * A pixel has an eye sub-path, a light sub-path and all their connections. The halves have one of the two. Light
 * tracing has an eye sub-path, too, but only for lights that the camera sees directly (s = 0, t = 2). What a method
 * does follows from its numbers of samples (counts.h). Where a scene has several lights, s = 1 chooses them by the
 * guide unless the user says otherwise; without it they are chosen by power.
 *
 * Tests: test_render.c (they agree with each other and with analytic scenes).
 */
#include "integrators/method.h"

static void render_pixel(const struct prepared *p, const struct tile_pass *pass, int i, long iteration)
{
    const struct numbers *numbers = &p->numbers;
    const int max_vertices = pass->job->max_depth + 1; /* of a light sub-path; an eye sub-path has one more */
    struct arena *arena = &pass->work->arena;
    struct vertex *light_path = NULL;
    arena_reset(arena);
    struct sample sample = sample_begin(pass, i, iteration);
    int n_eye = sample_eye_path(&sample, numbers->light_points > 0 ? max_vertices + 1 : 2), n_light = 0;
    if (numbers->path_pixels > 0) {
        light_path = arena_alloc(arena, (size_t)max_vertices * sizeof *light_path);
        n_light = sample_light_path(pass, i, (uint64_t)iteration, arena, light_path);
    }
    for (int t = 2; t <= n_eye; t++) {
        const struct vertex *z = &sample.eye[t - 1];
        sample_s0(&sample, t);
        sample_s1(&sample, t);
        if (numbers->draws[z->eye_hit] > 0 && vertex_connectible(z)) /* s >= 2 */
            sample_pairs(&sample, &(struct drawn){.path = light_path, .first = 1, .end = n_light, .pmf = 1}, t, 1);
    }
    if (numbers->path_pixels > 0) /* t = 1 */
        sample_lens(&sample, light_path, n_light, 1);
    sample_end(&sample);
}

static void render(const struct prepared *p, const struct tile_pass *pass)
{
    for (long iteration = pass->first; iteration < pass->end; iteration++)
        for (int i = 0; pass_goes_on(pass, i); i++)
            render_pixel(p, pass, i, iteration);
}

static const struct field PARAMETERS[] = {PARAMETER_GUIDE(true), {.name = NULL}};

const struct method method_pt = {
    .name = "pt", .help = "path tracing: light found by chance (s = 0) or sampled (s = 1)", .parameters = PARAMETERS,
    .numbers = NUMBERS_OF_PT, .rr_threshold = DEFAULT_RR_THRESHOLD, .render = render};

const struct method method_lt = {
    .name = "lt", .help = "light tracing: light sub-paths connected to the lens (t = 1); cannot see mirrors",
    .numbers = {.path_pixels = 1}, .rr_threshold = DEFAULT_RR_THRESHOLD, .render = render};

const struct method method_bdpt = {
    .name = "bdpt", .help = "bidirectional path tracing [Veach 1997]: all strategies", .parameters = PARAMETERS,
    .numbers = NUMBERS_OF_BDPT, .rr_threshold = DEFAULT_RR_THRESHOLD, .render = render};
