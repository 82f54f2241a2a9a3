/* outputs.h: the pictures that a subcommand is to write, opened before the work begins.
 *
 * What is wrong with a name, a directory or its rights is thus said at once. Files that the work does not come to
 * write are removed. Tests: test/run/cli.sh. */
#ifndef ASBDPT_OUTPUTS_H
#define ASBDPT_OUTPUTS_H

#include <stdbool.h>

#include "base/file.h"
#include "library/options.h"
#include "image/image.h"
#include "image/tone.h"
#include "render/part.h"

struct output {
    struct file_output file;
    bool is_part;
};

struct outputs {
    struct output *item; /* [n], owned */
    int n;
    struct tone tone; /* of 8-bit pictures */
    /* Set before outputs_write: */
    struct placement place;  /* where the pictures lie in their whole */
    const struct part *part; /* what is written into parts; borrowed */
    const struct film *film;
    bool unclamped;          /* pictures keep values below 0 */
    bool preview;            /* no warnings */
};

/* What the options --exposure and --tonemap say; and rows of options that several tables have, for members `tone` and
 * `unclamped` of the struct that AT is about. */
struct tone_options {
    double exposure;
    const char *curve; /* one of TONE_NAMES */
};
#define TONE_ROWS \
    {"--exposure", "EV", OPTION_NUMBER, AT(tone.exposure), -100, 100, .fallback = "0", \
     .help = "make 8-bit images brighter by EV stops, a factor of 2 each"}, \
    {"--tonemap", "NAME", OPTION_WORD, AT(tone.curve), .fallback = "none", .words = TONE_NAMES, \
     .help = "tone curve of 8-bit images"}
#define UNCLAMPED_ROW \
    {"--unclamped", NULL, OPTION_ON, AT(unclamped), \
     .help = "keep negative values in linear images, for images that are averaged (default: 0 instead)"}
#define IMAGE_HELP "image to write, repeatable; 8-bit formats are sRGB, others linear; - is .pfm to standard output"

/* outputs_possible: can a file of this name be made? False with a message. */
bool outputs_possible(const char *name, struct error *err);

/* outputs_open: begin to write pictures of these names, which differ.
 *   tone   of the 8-bit pictures, or NULL: as they are; if it changes anything, one of the pictures must be such
 *   parts  may a name that ends in .part be that of a part (render/part.h)?
 * Returns false with a message; nothing is open then. After success outputs_abandon must follow in the end. */
bool outputs_open(const struct texts *names, const struct tone_options *tone, bool parts, struct outputs *out,
                  struct error *err);

/* outputs_develop: film_develop of the film, where values below 0 become 0 as in pbrt-v3's files, unless `unclamped`.
 * Only pictures are cut: cut parts would add up to a biased whole.
 * outputs_write: the picture into all of them; unless `quiet` a line on stderr names each. One that fails does not
 * keep the others from being written: the first message is kept and false returned.
 * outputs_preview: the film as it is now into the file of the first, which outputs_write replaces in the end;
 * outputs_previews: can it be? False with a message.
 * outputs_abandon: remove what outputs_write has not written.
 * outputs_end: write a picture that was read from a file, of which `about` tells the place, unless `pixels` is NULL,
 * whose message *err has then. Releases the outputs and the pixels. False with a message. */
long outputs_develop(const struct outputs *o, float *out);
bool outputs_write(struct outputs *o, int width, int height, const float *pixels, bool quiet, struct error *err);
bool outputs_preview(const struct outputs *o, struct error *err);
bool outputs_previews(const struct outputs *o, struct error *err);
void outputs_abandon(struct outputs *o);
bool outputs_end(struct outputs *o, const struct image *about, int width, int height, float *pixels, bool quiet,
                 struct error *err);

#endif
