/* reference.h: the picture that errors are measured against, and how far it may itself be off.
 *
 * A stored reference is a picture NAME.pfm with, beside it, an optional text NAME.txt of lines "key value", of which
 *     content     H   the scene it is of: the hash of its files, hexadecimal, as the parts of its renders have it
 *     maxdepth    N   it holds paths up to this length
 *     noise8      X   root mean square of the standard errors of its 8-bit values
 *     mean_error  X   standard error of its mean, relative to the mean
 * are read and the others kept for people. It fits a wanted size when its own is the same or a whole multiple: with a
 * box filter the mean of k x k pixels is exactly the pixel of the smaller picture.
 *
 * Where none is stored, one is rendered by bdpt in two independent halves A and B. Their mean is the reference, and
 *     E (A - B)^2 = 2 var A = 4 var (A + B)/2,   so that   noise8 = rmse8(A, B) / 2.
 * Its mean_error is an upper bound, by the variances of pixels over samples, which err together less than that.
 *
 * Tests: test_report.c.
 */
#ifndef ASBDPT_REFERENCE_H
#define ASBDPT_REFERENCE_H

#include "base/error.h"
#include "render/render.h"

struct reference {
    float *pixels;     /* [height*width*3] linear; owned; NULL: there is none */
    int width, height;
    long max_depth;    /* 0: not said */
    uint64_t content;  /* of the scene; 0: not said */
    double noise8;     /* of its 8-bit values; NaN when unknown */
    double mean_error; /* relative standard error of its mean; NaN when unknown */
    char origin[1200]; /* one sentence for readers */
};

/* reference_find: read the stored reference of a scene.
 *   given  a file, a directory that holds NAME.pfm, or NULL to look for ref/NAME.pfm beside the scene and one
 *          directory up; then out->pixels is NULL if there is none
 * Returns false with a message when `given` cannot be read. */
bool reference_find(const char *given, const char *scene_path, const char *name, struct reference *out,
                    struct error *err);

/* reference_is_of: is it of this scene? One that somebody has given need not say so, but may not say otherwise; one
 * that was found must. False with a message. */
bool reference_is_of(const struct reference *r, const struct scene *scene, bool given, struct error *err);

/* reference_fit: shrink it to this size. Returns false with a message, and leaves it as it is, when its own is no whole
 * multiple of that or it holds paths of other lengths. */
bool reference_fit(struct reference *r, int width, int height, int max_depth, struct error *err);

/* reference_render: render one of `spp` samples per pixel, of the whole scene, paths up to options->max_depth; progress
 * as render_options has it, over both halves.
 * Returns false with a message. */
bool reference_render(const struct scene *scene, const struct render_options *options, long spp, struct reference *out,
                      struct error *err);

/* reference_write / reference_read: keep it as DIRECTORY/NAME.pfm and .txt; the key says what it depends on, size and
 * depth too, and only a reference with the same key is read back. */
bool reference_write(const struct reference *r, const char *directory, const char *name, const char *key,
                     struct error *err);
bool reference_read(const char *directory, const char *name, const char *key, struct reference *out);

void reference_free(struct reference *r);

#endif
