/* sides.h: the two sides of a verification, rendered in batches or read from pictures, and the reference that is stored
 * once they agree.
 *
 * Tests: test_verify.c, test_reference.c, test/run/cli.sh.
 */
#ifndef ASBDPT_SIDES_H
#define ASBDPT_SIDES_H

#include <stdio.h>

#include "lab/verify.h"
#include "render/render.h"

struct side {
    const char *name; /* of a method, or the first of its pictures; borrowed */
    int width, height;
    struct batches pixels; /* [height*width*3] values; owned, to be released also when reading or rendering failed */
};

/* side_text: open the text about NAME.pfm or NAME.error.pfm: NAME.txt, or else what is below "== NAME" in made.txt of its
 * folder. NULL if there is none; to be given to fclose.
 *   path  out, [SIDE_PATH]: the file
 * side_line: the next line of it, without its end. False after the last. */
enum { SIDE_PATH = 4096 };
FILE *side_text(const char *picture, char *path);
bool side_line(FILE *text, char *line, int size);

/* side_intact: is NAME.pfm, or NAME.error.pfm, the file that its text was written for? image.h tells `content`. A text
 * that does not say so, or none, is no reason to doubt it. Returns false with a message. */
bool side_intact(const char *path, uint64_t content, struct error *err);

/* side_read: n pictures of one size as batches; with_errors: a picture and its standard errors, both intact.
 *   like  they must also have its size; NULL: any
 * Returns false with a message. */
bool side_read(const char *const *file, int n, bool with_errors, const struct side *like, struct side *out,
               struct error *err);

/* side_errors_path: of NAME.pfm the picture of its standard errors, NAME.error.pfm. Returns false with a message. */
bool side_errors_path(const char *path, char *out, size_t size, struct error *err);

/* side_render: independent batches of options->end samples per pixel.
 *   number  0 or 1: which side; the batches' seeds are hashes of it, of the batch and of options->seed
 *   quiet   show no progress
 * Returns false with a message. */
bool side_render(const struct scene *scene, const struct render_job *options, int number, int n_batches, bool quiet,
                 struct side *out, struct error *err);

/* side_choose_resolution: the scene becomes as large as `like`, or for NULL keeps its shape with about 1000 pixels.
 * Returns false with a message when a crop window leaves less than `like` has. */
bool side_choose_resolution(struct scene *scene, const struct side *like, struct error *err);

/* side_choose_spp: samples per pixel so that the batches take about `seconds`; 0 with a message when they cannot be
 * rendered. */
long side_choose_spp(const struct scene *scene, const struct render_job *options, int n_batches, double seconds,
                     struct error *err);

/* side_choose_tile: side of tiles that are large enough for means that are nearly normal, and not too many. */
int side_choose_tile(const struct side *s);

/* What is told of a stored reference, besides its pixels. */
struct provenance {
    const char *note, *scene_path;
    uint64_t content; /* of the scene's files */
    int max_depth;
    const struct verdict *verdict; /* NULL: no test was made, as both sides are by one method; they count alike */
};

/* sides_store: the mean of both sides as NAME.pfm, its standard errors as NAME.error.pfm, and NAME.txt, which
 * reference.h reads. Returns false with a message. */
bool sides_store(const char *name, const struct side *a, const struct side *b, const struct provenance *from,
                 struct error *err);

#endif
