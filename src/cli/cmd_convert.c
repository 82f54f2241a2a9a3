/* cmd_convert.c: asbdpt convert IN OUT...: a picture in other formats. */
#include <stdlib.h>

#include "cli/command.h"
#include "cli/outputs.h"
#include "lab/compare.h"

struct convert_options {
    const char *in;
    struct texts out;
    struct tone_options tone;
};

#define AT(member) offsetof(struct convert_options, member)
static const struct option OPTIONS[] = {
    {"IN", NULL, OPTION_TEXT, AT(in), 1, .help = "a picture to read: .exr .pfm .hdr .pic .png .tga .ppm .pgm"},
    {"OUT", NULL, OPTION_TEXTS, AT(out), 1, .help = "a picture to write: linear .pfm .exr .hdr, sRGB .png .ppm .tga"},
    {"--exposure", "EV", OPTION_NUMBER, AT(tone.exposure), -100, 100, .fallback = "0", .help = EXPOSURE_HELP},
    {"--tonemap", "NAME", OPTION_TEXT, AT(tone.curve), .help = TONEMAP_HELP},
    {.name = NULL},
};

static int run(void *options)
{
    const struct convert_options *o = options;
    struct error err;
    struct outputs out;
    int width, height;
    if (!outputs_open(&o->out, &o->tone, PARTS_NONE, &out, &err))
        return fail(&err);
    float *pixels = load_linear(o->in, &width, &height, NULL, &err);
    bool ok = pixels != NULL;
    if (ok)
        ok = outputs_write(&out, width, height, pixels, true, &err);
    else
        outputs_abandon(&out);
    free(pixels);
    return ok ? EXIT_OK : fail(&err);
}

const struct command command_convert = {
    "convert", "a picture in other formats", {"IN OUT... [--exposure EV] [--tonemap NAME]"}, OPTIONS,
    sizeof(struct convert_options), run};
