/* web.c: what the page (page.html) calls of the renderer, built as WebAssembly by doc/web/build.sh.
 *
 *   web_words    where the page puts words: the words of a command line, each ended by a zero byte
 *   web_command  run them as asbdpt would
 *   web_render   render with the options of `asbdpt render`, and show the page the picture after every iteration
 *
 * The page gives web_show. All files are the page's: scenes, references, and what is written.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/os.h"
#include "cli/command.h"
#include "cli/job_options.h"
#include "lab/commands.h"
#include "image/picture.h"
#include "lab/compare.h"
#include "lab/sheet.h"
#include "render/parameters.h"

char *web_words(int size);
int web_command(int n);
int web_render(int n);

/* web_show: the page's. A picture as it is now; it returns whether to go on.
 *   rgba     [height*width*4] 8-bit sRGB, as a PNG of it would have it
 *   pixels   [height*width*3] linear
 *   seconds  since the render began, without those spent here
 *   rmse8, mean_ratio  against the reference, see compare.h; NaN without one */
extern int web_show(const uint8_t *rgba, const float *pixels, int width, int height, int iterations, double seconds,
                    double rmse8, double mean_ratio);

static const struct command *const COMMANDS[] = {&command_trace, NULL};
const struct program program = {"asbdpt", "the page that renders", "Renders, and tells of a sample.", COMMANDS, NULL};

static char *words; /* of the page; one buffer for all calls */

char *web_words(int size)
{
    free(words);
    words = mem_alloc((size_t)size + 1, 1);
    return words;
}

/* The words as main receives them. [n] */
static char **arguments(int n)
{
    char **argv = mem_alloc((size_t)n + 1, sizeof *argv), *word = words;
    for (int i = 0; i < n; i++, word += strlen(word) + 1)
        argv[i] = word;
    return argv;
}

int web_command(int n)
{
    char **argv = arguments(n);
    int status = command_line(n, argv);
    fflush(stdout); /* nobody else does: the program does not end here */
    free(argv);
    return status;
}

/* --- a render that is watched ------------------------------------------------------------------------ */

struct watch {
    const struct scene *scene;
    struct film *film;
    long shown; /* iterations */
    double start, lost;
    float *reference; /* NULL: none; of a k-th of the picture's width and height */
    int k;
    float *pixels;
    uint8_t *rgba;
};

/* Squares of k x k pixels are compared with one of the reference. */
static struct difference compare(const struct watch *w)
{
    struct difference none = {.rmse8 = NAN, .mean_ratio = NAN};
    int width = w->scene->width, height = w->scene->height;
    if (w->reference == NULL)
        return none;
    float *small = sheet_shrink(w->pixels, width, height, w->k);
    struct difference d = compare_pixels(small, w->reference, 3L * (width / w->k) * (height / w->k));
    free(small);
    return d;
}

static enum render_wish show(void *context, double done)
{
    struct watch *w = context;
    double now = os_wall_seconds();
    (void)done;
    if (w->film->passes > 0 || w->film->iterations == w->shown)
        return RENDER_GO_ON;
    w->shown = w->film->iterations;
    film_develop(w->film, w->scene->film_scale, w->pixels);
    int width = w->scene->width, height = w->scene->height;
    for (int i = 0; i < width * height; i++) {
        for (int c = 0; c < 3; c++)
            w->rgba[4 * i + c] = srgb_byte((double)w->pixels[3 * i + c]);
        w->rgba[4 * i + 3] = 255;
    }
    struct difference d = compare(w);
    bool go_on = web_show(w->rgba, w->pixels, width, height, (int)w->shown, now - w->start - w->lost, d.rmse8,
                          d.mean_ratio);
    w->lost += os_wall_seconds() - now;
    return go_on ? RENDER_GO_ON : RENDER_END_BLOCK;
}

static bool read_reference(struct watch *w, const char *path, struct error *err)
{
    int width, height;
    if (path[0] == '\0')
        return true;
    w->reference = image_read_linear(path, &width, &height, NULL, err);
    if (w->reference == NULL)
        return false;
    w->k = w->scene->width / width;
    return (w->k > 0 && w->k * width == w->scene->width && w->k * height == w->scene->height) ||
           error_set(err, "%s: the picture is no whole number of times as large", path);
}

static bool render(const struct job_options *o, const struct scene *scene, const struct method *integrator,
                   const char *reference, struct error *err)
{
    struct film film;
    struct watch w = {.scene = scene, .film = &film, .start = os_wall_seconds()};
    struct render_options options = job_render(o, scene, integrator);
    size_t n = (size_t)scene->width * (size_t)scene->height;
    options.block = 1;
    options.n_threads = 1;
    options.progress = show;
    options.progress_context = &w;
    film_init(&film, render_crop(scene), scene->width, scene->height);
    w.pixels = mem_alloc(3 * n, sizeof *w.pixels);
    w.rgba = mem_alloc(4 * n, sizeof *w.rgba);
    bool ok = read_reference(&w, reference, err) && render_scene(scene, &options, &film, err);
    film_free(&film);
    free(w.reference);
    free(w.pixels);
    free(w.rgba);
    return ok;
}

static const struct option OPTIONS[] = {
    {"SCENE.pbrt", NULL, OPTION_TEXT, offsetof(struct job_options, scene_path), 1, .help = "a scene file"},
    {.others = RUN_OPTIONS},
};

/* The first word is the reference, or empty; those after it are as for `asbdpt render`: its name, the scene, options
 * but for outputs and --cropwindow. */
int web_render(int n)
{
    char **argv = arguments(n);
    struct job_options o = {0};
    struct scene scene;
    const struct method *integrator;
    struct error err;
    bool ok = options_read(OPTIONS, n - 1, argv + 1, &o, &err);
    int status = !ok ? usage_error(NULL, "%s", err.text) : job_load(&o, &scene, &integrator);
    if (status == EXIT_OK) {
        if (!render(&o, &scene, integrator, argv[0], &err))
            status = fail(&err);
        scene_free(&scene);
    }
    options_free(OPTIONS, &o);
    free(argv);
    return status;
}
