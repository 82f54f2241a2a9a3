/* cmd_compare.c: asbdpt-lab compare IMAGE REFERENCE: how far apart two pictures are. */
#include <stdio.h>
#include <stdlib.h>

#include "base/mem.h"
#include "lab/commands.h"
#include "image/image.h"
#include "lab/compare.h"
#include "lab/sheet.h"

enum { PERCENTILE = 99, GAP = 5, WIDE = 320 }; /* between map and colour bar; what is narrower is enlarged */

struct compare_options {
    const char *image, *reference, *heatmap;
    double most;     /* of the heat map's colours; 0: PERCENTILE decides */
    double max_rmse; /* 0: any will do */
};

#define AT(member) offsetof(struct compare_options, member)
static const struct option OPTIONS[] = {
    {"IMAGE", NULL, OPTION_TEXT, AT(image), 1, .help = "a picture"},
    {"REFERENCE", NULL, OPTION_TEXT, AT(reference), 1, .help = "a picture of the same size"},
    {"--heatmap", "FILE.png", OPTION_TEXT, AT(heatmap), .written = true,
     .help = "write where they differ, as colours (viridis) with a colour bar: of each pixel the root mean square of "
             "its channels' linear errors"},
    {"--max", "X", OPTION_NUMBER, AT(most), 1e-30, 1e30,
     .help = "the brightest colour stands for this error (default: what 99 % of all errors are below)"},
    {"--max-rmse", "X", OPTION_NUMBER, AT(max_rmse), 1e-30, 1e30,
     .help = "exit with status 1 if rmse is larger, or if a value is NaN or infinite"},
    {.name = NULL},
};

static void print(const struct difference *d, double blocks)
{
    const struct {
        const char *name;
        double value;
    } lines[] = {{"rmse", d->rmse}, {"rmse8", d->rmse8}, {"relmse", d->relmse}, {"relmse8x8", blocks},
                 {"mean_ratio", d->mean_ratio}, {"nonfinite", (double)d->nonfinite}, {"psnr", d->psnr}};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++)
        printf("%-10s %.6g\n", lines[i].name, lines[i].value);
}

/* The map, each pixel a square if there are few, and below it what its colours stand for. */
static struct sheet map_with_bar(const float *map, int width, int height, double most)
{
    struct sheet s;
    char text[32];
    int k = (WIDE + width - 1) / width;
    snprintf(text, sizeof text, "%.3g", most);
    sheet_init(&s, width * k, height * k + GAP + SHEET_BAR, SHEET_PAPER);
    sheet_paste(&s, 0, 0, map, width, height, k);
    sheet_bar(&s, 0, height * k + GAP, width * k, "0", "linear rmse", text);
    return s;
}

/* Into a file that is open. */
static bool write_heatmap(const struct compare_options *o, struct file_output *f, const float *x, const float *r,
                          int width, int height, struct error *err)
{
    long pixels = (long)width * height;
    float *error = mem_alloc((size_t)pixels, sizeof *error), *map = mem_alloc((size_t)pixels * 3, sizeof *map);
    compare_errors(x, r, pixels, error);
    double most = o->most > 0 ? o->most : picture_percentile(error, pixels, PERCENTILE);
    compare_heatmap(error, pixels, most, map);
    struct sheet sheet = map_with_bar(map, width, height, most);
    const struct raster picture = {{0, 0, 0, 0}, sheet.width, sheet.height, sheet.pixels, NULL, 0, false};
    bool ok = image_finish(f, &picture, err);
    sheet_free(&sheet);
    if (ok)
        printf("heatmap    0 to %.6g%s\n", most, o->most > 0 ? "" : " (percentile)");
    free(error);
    free(map);
    return ok;
}

/* What 8 bits cut off and round counts as error. */
static void warn_of_display(const char *display, const char *linear)
{
    say_line("asbdpt: warning: %s holds sRGB values from 0 to 1, %s linear ones: what the first cut off and rounded "
             "counts as error", display, linear);
}

static bool compare_files(const struct compare_options *o, struct error *err)
{
    int w1, h1, w2, h2;
    struct file_output map;
    bool mapped = o->heatmap != NULL;
    if (mapped && !image_create(o->heatmap, &map, err))
        return false;
    struct image about1, about2;
    float *x = image_read_linear(o->image, &w1, &h1, &about1, err), *r = NULL;
    bool ok = x != NULL && (r = image_read_linear(o->reference, &w2, &h2, &about2, err)) != NULL;
    if (ok && (w1 != w2 || h1 != h2))
        ok = error_set(err, "%s is %dx%d but %s is %dx%d: only images of equal size can be compared; render with --res "
                       "%dx%d --filter box", o->image, w1, h1, o->reference, w2, h2, w2, h2);
    if (ok) {
        struct difference d = compare_pixels(x, r, (long)w1 * h1 * 3);
        double square[N_SQUARES];
        compare_squares(x, r, r, w1, h1, square);
        if (about1.linear != about2.linear)
            warn_of_display(about1.linear ? o->reference : o->image, about1.linear ? o->image : o->reference);
        print(&d, square[SQUARE_BLOCKS]);
        ok = !mapped || write_heatmap(o, &map, x, r, w1, h1, err);
        mapped = false;
        if (ok && o->max_rmse > 0 && d.nonfinite > 0)
            ok = error_set(err, "%s and %s: NaN or infinite values: %ld", o->image, o->reference, d.nonfinite);
        if (ok && o->max_rmse > 0 && !(d.rmse <= o->max_rmse))
            ok = error_set(err, "%s and %s: rmse %.6g is more than %.6g", o->image, o->reference, d.rmse, o->max_rmse);
    }
    if (mapped)
        file_abandon(&map);
    free(x);
    free(r);
    return ok;
}

static int run(void *options)
{
    const struct compare_options *o = options;
    struct error err;
    char known[IMAGE_LIST_TEXT];
    if (o->heatmap != NULL && !image_writable(o->heatmap))
        return usage_error(&command_compare, "--heatmap %s: an image to write ends in one of %s", o->heatmap,
                           image_list_written(known));
    return compare_files(o, &err) ? EXIT_OK : fail(&err);
}

const struct command command_compare = {
    "compare", "how far apart two pictures are", {"IMAGE REFERENCE [options]"}, OPTIONS,
    sizeof(struct compare_options), run, true,
    "compare doc/bathroom-bdpt.png doc/bathroom-asbdpt.png --heatmap out/heat.png"};
