/* identity.h: what a picture is of, whatever its number of samples: all that changes a byte of a sample. */
#ifndef ASBDPT_IDENTITY_H
#define ASBDPT_IDENTITY_H

#include "scene/film.h"
#include "scene/scene.h"

/* What comes from options. */
struct picture_options {
    const char *integrator;
    int max_depth;
    uint64_t seed;
};

/* identity_text: lines, each a word and what it says, to be given to free(). Threads, names of files and what is
 * written do not belong to it; what the scene's files hold does. */
char *identity_text(const struct scene *scene, struct picture_options o);

/* picture_number: a hash of these and of the film's size and window. */
uint64_t picture_number(const struct scene *scene, struct picture_options o, struct pixel_rect window);

#endif
