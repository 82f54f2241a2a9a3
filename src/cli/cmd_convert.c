/* cmd_convert.c: asbdpt convert IN -o OUT: a picture in other formats. */
#include "cli/command.h"
#include "cli/outputs.h"
#include "image/image.h"

struct convert_options {
    const char *in;
    struct texts out;
    struct tone_options tone;
    bool linear, quiet;
};

#define AT(member) offsetof(struct convert_options, member)
static const struct option OPTIONS[] = {
    {"IN", NULL, OPTION_TEXT, AT(in), 1,
     .help = "an image to read, - for .pfm from standard input", .list = image_list_read},
    {"--weights", .kind = OPTION_ELSEWHERE, .help = "asbdpt-lab sum adds up images"},
    {"-o", "FILE", OPTION_TEXTS, AT(out), 1, .alias = "--outfile", .written = true,
     .help = IMAGE_HELP, .list = image_list_written},
    {"--linear", NULL, OPTION_ON, AT(linear),
     .help = "take the values of 8-bit formats as light, as \"mapname\" does (default: they are sRGB)"},
    TONE_ROWS,
    {"--quiet", NULL, OPTION_ON, AT(quiet), .help = "do not print what was written"}, {.name = NULL}};

static int run(void *options)
{
    const struct convert_options *o = options;
    struct error err;
    struct outputs out;
    struct image about;
    int width, height;
    if (!outputs_open(&o->out, &o->tone, false, &out, &err))
        return fail(&err);
    float *pixels = (o->linear ? image_read_values : image_read_linear)(o->in, &width, &height, &about, &err);
    return outputs_end(&out, &about, width, height, pixels, o->quiet, &err) ? EXIT_OK : fail(&err);
}

const struct command command_convert = {
    "convert", "write an image in other formats", {"IN -o FILE... [options]"}, OPTIONS, sizeof(struct convert_options),
    run, false,
    "convert ref/bathroom.pfm -o out/bathroom.png --exposure 1 --tonemap filmic"};
