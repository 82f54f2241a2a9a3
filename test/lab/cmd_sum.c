/* cmd_sum.c: asbdpt-lab sum IN... -o OUT: pictures added up, each times a weight: of those that asbdpt-lab render
 * --lights writes the picture under other lights. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/mem.h"
#include "base/number.h"
#include "cli/outputs.h"
#include "image/image.h"
#include "lab/commands.h"

struct sum_options {
    struct texts in, out;
    const char *weights; /* numbers with commas between them, or NULL: all 1 */
    bool quiet;
};

#define AT(member) offsetof(struct sum_options, member)
static const struct option OPTIONS[] = {
    {"IN", NULL, OPTION_TEXTS, AT(in), 1, .help = "an image to add up", .list = image_list_read},
    {"--weights", "LIST", OPTION_TEXT, AT(weights), .help = "factor of each image, as 1,0.5,2 (default: 1)"},
    {"-o", "FILE", OPTION_TEXTS, AT(out), 1, .alias = "--outfile", .written = true,
     .help = IMAGE_HELP, .list = image_list_written},
    {"--quiet", NULL, OPTION_ON, AT(quiet), .help = "do not print what was written"}, {.name = NULL}};

/* A weight of the list at *text, which moves behind it. */
static bool next_weight(const char **text, bool last, double *out)
{
    char *end;
    *out = strtod(*text, &end);
    bool ok = end != *text && fabs(*out) <= NUMBER_MAX && *end == (last ? '\0' : ',');
    *text = end + !last;
    return ok;
}

/* Add picture k times a weight to the sum, which the first one begins. */
static bool add_picture(const struct sum_options *o, int k, double weight, double **sum, int *width, int *height,
                        struct image *about, struct error *err)
{
    int w, h;
    struct image this;
    float *pixels = image_read_linear(o->in.item[k], &w, &h, &this, err);
    if (pixels == NULL)
        return false;
    *about = *sum == NULL ? this : *about;
    size_t n = 3 * (size_t)w * (size_t)h;
    bool fits = *sum == NULL || (w == *width && h == *height);
    if (*sum == NULL)
        *sum = mem_alloc(n, sizeof **sum);
    for (size_t i = 0; fits && i < n; i++)
        (*sum)[i] += weight * (double)pixels[i];
    free(pixels);
    if (!fits)
        return error_set(err, "%s is %dx%d, the images before it %dx%d", o->in.item[k], w, h, *width, *height);
    *width = w;
    *height = h;
    return true;
}

/* All pictures, added up; to be given to free(). NULL with a message. */
static float *add_up(const struct sum_options *o, int *width, int *height, struct image *about, struct error *err)
{
    const char *text = o->weights;
    double weight = 1, *sum = NULL;
    bool ok = true;
    for (int i = 0; ok && i < o->in.n; i++)
        ok = (text == NULL || next_weight(&text, i + 1 == o->in.n, &weight) ||
              error_usage(err, "--weights %s: expected a number for each image (%d), with commas between them",
                          o->weights, o->in.n)) &&
             add_picture(o, i, weight, &sum, width, height, about, err);
    size_t n = ok ? 3 * (size_t)*width * (size_t)*height : 0;
    float *out = ok ? mem_alloc(n, sizeof *out) : NULL;
    long unusable = 0;
    for (size_t i = 0; i < n; i++) {
        unusable += !fits_float(sum[i]);
        out[i] = fits_float(sum[i]) ? (float)sum[i] : sum[i] > 0 ? INFINITY : sum[i] < 0 ? -INFINITY : NAN;
    }
    if (unusable > 0)
        say_line("asbdpt: warning: %ld values of the sum are NaN or infinite", unusable);
    free(sum);
    return out;
}

static int run(void *options)
{
    const struct sum_options *o = options;
    struct error err;
    struct outputs out;
    struct image about;
    int width = 0, height = 0;
    if (!outputs_open(&o->out, NULL, false, &out, &err))
        return fail(&err);
    float *pixels = add_up(o, &width, &height, &about, &err);
    return outputs_end(&out, &about, width, height, pixels, o->quiet, &err) ? EXIT_OK : fail(&err);
}

const struct command command_sum = {
    "sum", "add up images, each times a weight", {"IN... -o FILE... [options]"}, OPTIONS, sizeof(struct sum_options),
    run, false, "sum out/forest/light00_infinite.pfm out/forest/light01_distant.pfm --weights 3,0.2 -o out/cloudy.png"};
