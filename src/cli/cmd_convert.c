/* cmd_convert.c: asbdpt convert IN -o OUT: a picture in other formats. */
#include <stdio.h>
#include <stdlib.h>

#include "cli/command.h"
#include "cli/outputs.h"
#include "image/image.h"

struct convert_options {
    const char *in;
    struct texts out;
    struct tone_options tone;
};

#define AT(member) offsetof(struct convert_options, member)
static const struct option OPTIONS[] = {
    {"IN", NULL, OPTION_TEXT, AT(in), 1, .file = FILE_READ,
     .help = "a picture to read: .exr .pfm .hdr .pic .png .tga .ppm .pgm"},
    {"-o", "FILE", OPTION_TEXTS, AT(out), 1, .alias = "--outfile", .file = FILE_WRITTEN,
     .help = "a picture to write: linear .pfm .exr, sRGB .png .ppm; repeatable"},
    {"--exposure", "EV", OPTION_NUMBER, AT(tone.exposure), -100, 100, .fallback = "0", .help = EXPOSURE_HELP},
    {"--tonemap", "NAME", OPTION_TEXT, AT(tone.curve), .help = TONEMAP_HELP},
    {.name = NULL},
};

/* Of a part of a whole only some formats say where it lies. */
static void warn_of_place(const struct convert_options *o, const struct placement *at, int width, int height)
{
    bool part = at->width > 0 && (at->x != 0 || at->y != 0 || at->width != width || at->height != height);
    for (int i = 0; part && i < o->out.n; i++)
        if (!image_keeps_place(o->out.item[i]))
            fprintf(stderr, "asbdpt: warning: %s lies at %d,%d of a picture of %dx%d, as %s does not say\n", o->in,
                    at->x, at->y, at->width, at->height, o->out.item[i]);
}

static int run(void *options)
{
    const struct convert_options *o = options;
    struct error err;
    struct outputs out;
    struct image about;
    int width, height;
    if (!outputs_open(&o->out, &o->tone, PARTS_NONE, &out, &err))
        return fail(&err);
    float *pixels = image_read_linear(o->in, &width, &height, &about, &err);
    bool ok = pixels != NULL;
    if (ok) {
        out.place = about.place;
        warn_of_place(o, &about.place, width, height);
        ok = outputs_write(&out, width, height, pixels, true, &err);
    }
    outputs_abandon(&out); /* unless they are written */
    free(pixels);
    return ok ? EXIT_OK : fail(&err);
}

const struct command command_convert = {
    "convert", "a picture in other formats", {"IN -o FILE... [--exposure EV] [--tonemap NAME]"}, OPTIONS,
    sizeof(struct convert_options), run, false,
    "convert picture.exr -o picture.png --exposure 1 --tonemap filmic"};
