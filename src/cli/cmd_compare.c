/* cmd_compare.c: asbdpt compare IMAGE REFERENCE: how far apart two pictures are. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/mem.h"
#include "cli/command.h"
#include "image/image.h"
#include "lab/compare.h"

struct compare_options {
    const char *image, *reference, *heatmap;
    bool json;
};

#define AT(member) offsetof(struct compare_options, member)
static const struct option OPTIONS[] = {
    {"IMAGE", NULL, OPTION_TEXT, AT(image), 1, .help = "a picture"},
    {"REFERENCE", NULL, OPTION_TEXT, AT(reference), 1, .help = "a picture of the same size"},
    {"--heatmap", "FILE.png", OPTION_TEXT, AT(heatmap), .help = "write where they differ"},
    {"--json", NULL, OPTION_ON, AT(json), .help = "print an object of JSON"},
    {.name = NULL},
};

static void print(const struct difference *d, bool json)
{
    static const char *const names[] = {"rmse", "rmse8", "relmse", "mean_ratio"};
    const double values[] = {d->rmse, d->rmse8, d->relmse, d->mean_ratio};
    for (int i = 0; i < 4; i++)
        if (!json)
            printf("%-10s %.6g\n", names[i], values[i]);
        else if (isfinite(values[i]))
            printf("%s\"%s\": %.9g", i == 0 ? "{" : ", ", names[i], values[i]);
        else /* JSON has no infinity or NaN */
            printf("%s\"%s\": null", i == 0 ? "{" : ", ", names[i]);
    printf(json ? ", \"nonfinite\": %ld}\n" : "nonfinite  %ld\n", d->nonfinite);
}

static bool write_heatmap(const char *path, const float *x, const float *r, int width, int height, struct error *err)
{
    float *map = mem_alloc((size_t)width * (size_t)height * 3, sizeof *map);
    compare_heatmap(x, r, (long)width * height, map);
    bool ok = image_write(path, width, height, map, err);
    free(map);
    return ok;
}

static bool compare_files(const struct compare_options *o, struct error *err)
{
    int w1, h1, w2, h2;
    float *x = load_linear(o->image, &w1, &h1, err), *r = NULL;
    bool ok = x != NULL && (r = load_linear(o->reference, &w2, &h2, err)) != NULL;
    if (ok && (w1 != w2 || h1 != h2))
        ok = error_set(err, "%s is %dx%d but %s is %dx%d; only images of equal size can be compared", o->image, w1, h1,
                       o->reference, w2, h2);
    if (ok) {
        struct difference d = compare_pixels(x, r, (long)w1 * h1 * 3);
        print(&d, o->json);
        ok = o->heatmap == NULL || write_heatmap(o->heatmap, x, r, w1, h1, err);
    }
    free(x);
    free(r);
    return ok;
}

static int run(void *options)
{
    struct error err;
    return compare_files(options, &err) ? EXIT_OK : fail(&err);
}

const struct command command_compare = {
    "compare", "how far apart two pictures are", {"IMAGE REFERENCE [--heatmap FILE.png] [--json]"}, OPTIONS,
    sizeof(struct compare_options), run};
