/* web.c: what the page (page.html) calls of the renderer, built as WebAssembly by doc/web/build.sh.
 *
 *   web_words    where the page puts words: the words of a command line, each ended by a zero byte
 *   web_command  run them as asbdpt would
 *   web_begin    load a scene for a render with the options of `asbdpt render`
 *   web_step     learn, or render one block of iterations more, and show the page the picture: a worker that is to be paused must
 *                return between them, since it hears nothing while it computes. Ends the program with a message if it fails
 *
 * The page gives web_show and web_learns. All files are the page's: scenes, references, and what is written.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/mem.h"
#include "base/number.h"
#include "base/os.h"
#include "cli/command.h"
#include "image/image.h"
#include "lab/commands.h"
#include "lab/compare.h"
#include "lab/sheet.h"
#include "library/job_options.h"
#include "library/state.h"

char *web_words(int size);
int web_command(int n);
int web_begin(int n);
int web_step(void);

/* web_show: the page's. A picture as it is now.
 *   rgba     [height*width*4] 8-bit sRGB, as a PNG of it would have it
 *   pixels   [height*width*3] linear
 *   seconds  that the render has taken, learning included
 *   rmse8, mean_ratio  against the reference, see compare.h; NaN without one */
extern void web_show(const uint8_t *rgba, const float *pixels, int width, int height, int iterations, double seconds,
                     double rmse8, double mean_ratio);

/* web_learns: the page's. The share of what is to be learnt before the render. */
extern void web_learns(double share);

static const struct command *const COMMANDS[] = {&command_trace, NULL};
const struct program program = {"asbdpt", "the page that renders", "Renders, and tells of a sample.", COMMANDS, NULL, ""};

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

static struct watch {
    struct asbdpt of; /* first: options lead into it */
    float *reference; /* NULL: none; of a k-th of the picture's width and height */
    int k;
    float *pixels;
    uint8_t *rgba;
    double shown; /* when the page was shown something, by the clock */
    bool begun;   /* the block of this step, after learning */
} watched; /* one to a worker, which ends with it */

/* Squares of k x k pixels are compared with one of the reference. */
static struct difference compare(const struct watch *w)
{
    struct difference none = {.rmse8 = NAN, .mean_ratio = NAN};
    int width = w->of.scene.width, height = w->of.scene.height;
    if (w->reference == NULL)
        return none;
    float *small = sheet_shrink(w->pixels, width, height, w->k);
    struct difference d = compare_pixels(small, w->reference, 3L * (width / w->k) * (height / w->k));
    free(small);
    return d;
}

/* The pixels of a square without a sample get the mean of those with one, if there are any. */
static void fill_square(struct watch *w, int x0, int y0, int size)
{
    int width = w->of.scene.width, known = 0;
    int x1 = int_within(x0 + size, 0, width), y1 = int_within(y0 + size, 0, w->of.scene.height);
    float mean[3] = {0, 0, 0};
    for (int pass = 0; pass < 2; pass++)
        for (int y = y0; y < y1; y++)
            for (int x = x0; x < x1; x++) {
                bool in = w->of.film.block.in[y * width + x];
                float *pixel = &w->pixels[3 * (y * width + x)];
                known += pass == 0 && in;
                for (int c = 0; c < 3; c++)
                    if (pass == 0 && in)
                        mean[c] += pixel[c];
                    else if (pass == 1 && !in && known > 0)
                        pixel[c] = mean[c] / (float)known;
            }
}

/* In the first iteration the picture comes coarse, and becomes fine. */
static void fill(struct watch *w)
{
    for (int size = 256; size > 1; size /= 2)
        for (int y = 0; y < w->of.scene.height; y += size)
            for (int x = 0; x < w->of.scene.width; x += size)
                fill_square(w, x, y, size);
}

static void show(struct watch *w)
{
    int width = w->of.scene.width, height = w->of.scene.height;
    asbdpt_read(&w->of, w->pixels);
    if (w->of.film.iterations == 0)
        fill(w);
    for (int i = 0; i < width * height; i++) {
        for (int c = 0; c < 3; c++)
            w->rgba[4 * i + c] = srgb_byte((double)w->pixels[3 * i + c]);
        w->rgba[4 * i + 3] = 255;
    }
    struct difference d = compare(w);
    web_show(w->rgba, w->pixels, width, height, (int)w->of.film.iterations, w->of.wall, d.rmse8, d.mean_ratio);
    w->shown = os_wall_seconds();
}

/* While it learns, the page hears how far; in the first block it sees what there is. */
static void progress(void *context, double learnt, double done)
{
    struct watch *w = context;
    w->begun |= done > 0;
    if (os_wall_seconds() - w->shown < 0.1)
        return;
    w->shown = os_wall_seconds();
    if (done == 0)
        web_learns(learnt);
    else if (w->of.film.iterations == 0)
        show(w);
}

/* All learning, and one block. */
static int enough(void *context)
{
    const struct watch *w = context;
    return w->begun ? ASBDPT_END_BLOCK : ASBDPT_CONTINUE;
}

static bool read_reference(struct watch *w, const char *path, struct error *err)
{
    int width, height;
    if (path[0] == '\0')
        return true;
    w->reference = image_read_linear(path, &width, &height, NULL, err);
    if (w->reference == NULL)
        return false;
    w->k = w->of.scene.width / width;
    return (w->k > 0 && w->k * width == w->of.scene.width && w->k * height == w->of.scene.height) ||
           error_set(err, "%s: the picture is no whole number of times as large", path);
}

static bool begin(struct watch *w, const char *reference, struct error *err)
{
    size_t n = (size_t)w->of.scene.width * (size_t)w->of.scene.height;
    if (!read_reference(w, reference, err))
        return false;
    w->pixels = mem_alloc(3 * n, sizeof *w->pixels);
    w->rgba = mem_alloc(4 * n, sizeof *w->rgba);
    w->of.job.n_threads = 1;
    w->of.job.block = 1; /* unless the method has blocks of its own */
    return true;
}

int web_step(void)
{
    struct watch *w = &watched;
    w->begun = false;
    if (asbdpt_render(&w->of, 0, progress, enough, w) != 0) {
        say_line("asbdpt: %s", asbdpt_message(&w->of));
        exit(EXIT_FAILURE);
    }
    show(w);
    return w->of.film.iterations < w->of.part.end;
}

static const struct option OPTIONS[] = {
    {"SCENE.pbrt", NULL, OPTION_TEXT, offsetof(struct asbdpt, job.scene_path), 1, .help = "a scene file"},
    {.others = RUN_OPTIONS},
};

/* The first word is the reference, or empty; those after it are as for `asbdpt render`: its name, the scene, options
 * but for outputs and --cropwindow. */
int web_begin(int n)
{
    char **argv = arguments(n);
    struct watch *w = &watched;
    struct error err;
    bool ok = options_read(OPTIONS, n - 1, argv + 1, &w->of, &err);
    int status = !ok ? usage_error(NULL, "%s", err.text) : state_open(&w->of, &err) ? EXIT_OK : job_failed(&err);
    if (status == EXIT_OK && !begin(w, argv[0], &err))
        status = fail(&err);
    free(argv);
    return status;
}
