/* reference.h: the picture that errors are measured against, and how far it may itself be off.
 *
 * A stored reference is a picture NAME.pfm with an optional text (side_text) of lines "key value", of which
 *     content     H   the scene it is of: the hash of its files, hexadecimal, as the parts of its renders have it
 *     files     H H   hashes of NAME.pfm and NAME.error.pfm: a file with another hash is refused
 *     maxdepth    N   it holds paths up to this length
 *     noise8      X   root mean square of the standard errors of its 8-bit values
 *     noise_relmse X, noise_8x8 X   its own part of these squared errors (compare.h)
 *     mean_error  X   standard error of its mean, relative to the mean
 * are read and the others kept for people, and a picture NAME.error.pfm of its standard errors. Noise that the text
 * does not tell comes from these errors, or is unknown. A reference fits a wanted size when its own is the same or a
 * whole multiple: with a box filter the mean of k x k pixels is exactly the pixel of the smaller picture.
 *
 * Where none is stored, one is rendered: two sides of independent batches (sides.h), their mean, and the errors that
 * follow from how the batches scatter, stored as any other.
 *
 * Tests: test_plan.c, test_coverage.c.
 */
#ifndef ASBDPT_REFERENCE_H
#define ASBDPT_REFERENCE_H

#include "base/error.h"
#include "lab/compare.h"
#include "render/render.h"

struct reference {
    float *pixels;     /* [height*width*3] linear; owned; NULL: there is none */
    float *variance;   /* [height*width*3] squares of their standard errors; owned; NULL: unknown */
    int width, height;
    long max_depth;    /* 0: not said */
    uint64_t content;  /* of the scene; 0: not said */
    double noise8;     /* of its 8-bit values; NaN when unknown */
    double noise[N_SQUARES]; /* its own part of squared errors against it; NaN when unknown */
    double mean_error; /* relative standard error of its mean; NaN when unknown */
    const char *kind;  /* "stored picture" or "rendered here" */
    char origin[1200]; /* one sentence for readers */
};

/* reference_find: read the stored reference of a scene.
 *   given  a file, a directory that holds NAME.pfm, or NULL to look for ref/NAME.pfm next to the scene and one
 *          directory up; then out->pixels is NULL if there is none
 * Returns false with a message when it cannot be read, is damaged, or holds NaN. */
bool reference_find(const char *given, const char *scene_path, const char *name, struct reference *out,
                    struct error *err);

/* reference_is_of: is it of this scene? One that somebody has given need not say so, but may not say otherwise; one
 * that was found must. False with a message. */
bool reference_is_of(const struct reference *r, const struct scene *scene, bool given, struct error *err);

/* reference_fit: shrink it to this size. Returns false with a message, and leaves it as it is, when its own is no whole
 * multiple of that or it holds paths of other lengths. */
bool reference_fit(struct reference *r, int width, int height, int max_depth, struct error *err);

/* reference_method: the method that finds most of the scene's light: METHOD_REFERENCE, or METHOD_CAUSTICS where a light
 * that nothing can hit is behind mirrors or glass. *all becomes false if it does not find all: it joins points to such
 * lights through SPECULAR_LONGEST of these at most, and not within media. */
const char *reference_method(const struct scene *scene, bool *all);

/* reference_make: render one of about `spp` samples per pixel, of the whole scene, and store it as DIRECTORY/NAME.pfm,
 * .error.pfm and .txt, or read back the one that is stored there with the same key, which says what it depends on, size
 * and depth too.
 *   options    who renders it, from which seed, how deep, on how many threads
 * Returns false with a message. */
bool reference_make(const struct scene *scene, const struct render_job *options, long spp, const char *directory,
                    const char *name, const char *key, struct reference *out, struct error *err);

void reference_free(struct reference *r);

#endif
